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
  /** Goes to the other theme. */
  readonly button = button({ class: "button icon-button" }, () => this.#toggle());
  /** Called with the theme that came. */
  onChange: (theme: Theme) => void = () => undefined;
  readonly #system = matchMedia("(prefers-color-scheme: dark)");
  #chosen: Theme | null = stored();
  /** While the page is printed, on white paper. */
  #printing = false;

  constructor() {
    this.#system.addEventListener("change", () => this.#changed());
    this.#apply();
  }

  get theme(): Theme {
    if (this.#printing) return "light";
    return this.#chosen ?? (this.#system.matches ? "dark" : "light");
  }

  get palette(): Palette {
    return palette(this.theme);
  }

  print(printing: boolean): void {
    this.#printing = printing;
    this.#changed();
  }

  #toggle(): void {
    this.#chosen = this.theme === "dark" ? "light" : "dark";
    store(this.#chosen);
    this.#changed();
  }

  #changed(): void {
    this.#apply();
    this.onChange(this.theme);
  }

  #apply(): void {
    apply(document.documentElement, this.theme);
    const label = this.theme === "dark" ? "Light colours" : "Dark colours";
    this.button.replaceChildren(icon(this.theme === "dark" ? "sun" : "moon"));
    this.button.setAttribute("aria-label", label);
    this.button.title = label;
  }
}
