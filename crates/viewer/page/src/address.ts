/** The page's address says where in the film it stands: `#t=12.5&speed=2&show=executed&panel=plots&camera=above`. */

/** Where a link points to. What does not fit is ignored. */
export interface Place {
  /** [s] */
  t: number | null;
  speed: number | null;
  show: "planned" | "executed" | null;
  panel: string | null;
  camera: string | null;
}

const WORD = /^[a-z-]{1,24}$/;

function number(text: string | null): number | null {
  if (text === null || !/^\d{1,9}(\.\d{1,9})?$/.test(text)) return null;
  return Number(text);
}

function word(text: string | null): string | null {
  return text !== null && WORD.test(text) ? text : null;
}

/** Reads a URL's hash. */
export function parseLink(hash: string): Place {
  const entries = new URLSearchParams(hash.replace(/^#/, ""));
  const show = entries.get("show");
  return {
    t: number(entries.get("t")),
    speed: number(entries.get("speed")),
    show: show === "planned" || show === "executed" ? show : null,
    panel: word(entries.get("panel")),
    camera: word(entries.get("camera")),
  };
}

/** The hash of a place, without what is null, and of further entries. */
export function linkTo(place: Place, further: Readonly<Record<string, string>> = {}): string {
  const text = (value: number | string): string => (typeof value === "number" ? String(Number(value.toFixed(3))) : value);
  const entries = Object.entries(place).flatMap(([key, value]) => (value === null ? [] : [[key, text(value)]]));
  return `#${new URLSearchParams([...entries, ...Object.entries(further)])}`;
}

/** How long the page rests before its address is changed [ms]. */
const SETTLED_MS = 400;

export class Address {
  readonly #current: () => Place | null;
  #timer = 0;
  #written = location.hash;
  #further: Readonly<Record<string, string>> = {};

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
    this.#timer = window.setTimeout(() => this.#write(this.#current()), SETTLED_MS);
  }

  /** Writes further entries, now and whenever the address changes. */
  keep(further: Readonly<Record<string, string>>): void {
    this.#further = further;
    this.#write(this.#current() ?? this.place);
  }

  /** Someone has changed the address by hand or by a link. */
  onChange(go: (place: Place) => void): void {
    addEventListener("hashchange", () => {
      if (location.hash !== this.#written) go(this.place);
    });
  }

  #write(place: Place | null): void {
    if (place === null) return;
    this.#written = linkTo(place, this.#further);
    try {
      history.replaceState(history.state, "", this.#written);
    } catch {
      // A page inside another one may have no address to change.
    }
  }
}
