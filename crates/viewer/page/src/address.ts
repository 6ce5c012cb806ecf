/** The page's address: says where in the film it stands, once nothing changes any more. */
import { linkTo, parseLink, type Place } from "./link.ts";

/** How long the page rests before its address is changed [ms]. */
const SETTLED_MS = 400;

export class Address {
  readonly #current: () => Place | null;
  #timer = 0;
  #written = location.hash;

  /** `current` is null while there is no place to link to. */
  constructor(current: () => Place | null) {
    this.#current = current;
  }

  get place(): Place {
    return parseLink(location.hash);
  }

  /** Something has changed. */
  touch(): void {
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => this.#write(), SETTLED_MS);
  }

  /** Someone has changed the address by hand or by a link. */
  onChange(go: (place: Place) => void): void {
    addEventListener("hashchange", () => {
      if (location.hash !== this.#written) go(this.place);
    });
  }

  #write(): void {
    const place = this.#current();
    if (place === null) return;
    this.#written = linkTo(place);
    try {
      history.replaceState(history.state, "", this.#written);
    } catch {
      // A page inside another one may have no address to change.
    }
  }
}
