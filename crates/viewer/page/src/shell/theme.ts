/** Light and dark: as the system has it until someone chooses. */
import { palette, type Palette, type Theme } from "../palette.ts";
import { button, icon } from "./dom.ts";

const KEY = "platewash-theme";

/** Pages without an address of their own may not store anything. */
function stored(): Theme | null {
  try {
    const value = localStorage.getItem(KEY);
    return value === "light" || value === "dark" ? value : null;
  } catch {
    return null;
  }
}

function store(theme: Theme): void {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Then it lasts as long as the page.
  }
}

/** The palette as custom properties, for the style sheet. */
function apply(root: HTMLElement, theme: Theme): void {
  const colours = palette(theme);
  root.dataset["theme"] = theme;
  const set = (name: string, value: string): void => root.style.setProperty(name, value);
  for (const key of ["ground", "surface", "ink", "muted", "line", "planned", "executed", "limit"] as const) set(`--${key}`, colours[key]);
  for (const [kind, colour] of Object.entries(colours.segments)) set(`--segment-${kind}`, colour);
  for (const [status, colour] of Object.entries(colours.statuses)) set(`--status-${status}`, colour);
  colours.joints.forEach((colour, j) => set(`--joint-${j}`, colour));
}

export class ThemeControl {
  readonly #system = matchMedia("(prefers-color-scheme: dark)");
  readonly #listeners: ((theme: Theme) => void)[] = [];
  #chosen: Theme | null = stored();
  /** While the page is printed, on white paper. */
  #printing = false;
  #button: HTMLButtonElement | null = null;

  constructor() {
    this.#system.addEventListener("change", () => this.#changed());
    apply(document.documentElement, this.theme);
  }

  get theme(): Theme {
    if (this.#printing) return "light";
    return this.#chosen ?? (this.#system.matches ? "dark" : "light");
  }

  get palette(): Palette {
    return palette(this.theme);
  }

  onChange(listener: (theme: Theme) => void): void {
    this.#listeners.push(listener);
  }

  choose(theme: Theme): void {
    this.#chosen = theme;
    store(theme);
    this.#changed();
  }

  print(printing: boolean): void {
    this.#printing = printing;
    this.#changed();
  }

  /** A button that goes to the other theme. */
  button(): HTMLButtonElement {
    this.#button = button({ class: "button icon-button" }, () => this.choose(this.theme === "dark" ? "light" : "dark"));
    this.#label();
    return this.#button;
  }

  #changed(): void {
    apply(document.documentElement, this.theme);
    this.#label();
    for (const listener of this.#listeners) listener(this.theme);
  }

  #label(): void {
    const label = this.theme === "dark" ? "Light colours" : "Dark colours";
    this.#button?.replaceChildren(icon(this.theme === "dark" ? "sun" : "moon"));
    this.#button?.setAttribute("aria-label", label);
    this.#button?.setAttribute("title", label);
  }
}
