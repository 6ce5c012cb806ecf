/** What is proved as a card to share: a picture with the scene, and the same as text. */
import { fixedShort } from "../format.ts";
import { grouped, measureWords } from "../limits.ts";
import { assumptions, summary, VERDICT, verdict } from "../verdict.ts";
import type { View } from "../view.ts";
import { announce, button, el } from "./dom.ts";

const [WIDTH, HEIGHT, MARGIN] = [1200, 675, 36];
/** Requirements with a number that a card names. */
const NAMED = 7;

/** What a card says of a proved plan, never more than its certificate. */
export function cardWords(view: View) {
  const certificate = view.certificate!;
  const { word, sentence } = verdict(view);
  const measured = grouped(certificate.checks).flatMap(({ checks }) => checks.filter(({ measure }) => measure !== undefined).slice(0, 3));
  const [first = "nothing assumed", ...others] = assumptions(certificate);
  const { scenario, robot, hash, seed } = view.heading;
  return {
    badge: word,
    headline: sentence.replace(VERDICT, ""),
    measures: [summary(certificate), ...measured.slice(0, NAMED).map(({ words, measure }) => `${words}: ${measureWords(measure!)}`)],
    rests: `Assumed: ${first}${others.length > 0 ? `; ${others.length} more` : ""}`,
    origin: `${robot}, scenario “${scenario}”, seed ${fixedShort(seed, 0)}, hash ${(hash ?? "none").slice(0, 16)}; platewash ${view.version}`,
  };
}

export function cardText({ badge, headline, measures, rests, origin }: ReturnType<typeof cardWords>): string {
  return [`${badge.toUpperCase()}: ${headline}`, ...measures.map((line) => `- ${line}`), rests, origin, "Check it: platewash verify plan.json"].join("\n");
}

/** Writes words in lines of a width from (x, y) on; where the next line would be. */
function write(context: CanvasRenderingContext2D, words: string, x: number, y: number, width: number, height: number): number {
  let line = "";
  for (const word of words.split(" ")) {
    const longer = line === "" ? word : `${line} ${word}`;
    if (line !== "" && context.measureText(longer).width > width) {
      context.fillText(line, x, y);
      y += height;
      line = word;
    } else line = longer;
  }
  context.fillText(line, x, y);
  return y + height;
}

function draw(canvas: HTMLCanvasElement, view: View, scene: HTMLImageElement): void {
  const context = canvas.getContext("2d");
  if (context === null) return;
  const style = getComputedStyle(document.documentElement);
  const { badge, headline, measures, rests, origin } = cardWords(view);
  const { tone } = verdict(view);
  const pen = (size: number, weight: number, colour: string): void => {
    context.font = `${weight} ${size}px system-ui, sans-serif`;
    context.fillStyle = style.getPropertyValue(colour).trim();
  };
  pen(34, 750, "--surface");
  context.fillRect(0, 0, WIDTH, HEIGHT);
  const half = WIDTH / 2;
  const scale = Math.max(half / scene.width, HEIGHT / scene.height);
  const [width, height] = [half / scale, HEIGHT / scale];
  context.drawImage(scene, (scene.width - width) / 2, (scene.height - height) / 2, width, height, 0, 0, half, HEIGHT);
  const [x, room] = [half + MARGIN, half - 2 * MARGIN];
  pen(34, 750, tone === "none" ? "--muted" : `--status-${tone}`);
  let y = write(context, badge.toUpperCase(), x, 74, room, 40);
  pen(23, 600, "--ink");
  y = write(context, headline, x, y, room, 31) + 14;
  pen(20, 400, "--ink");
  for (const line of measures) y = write(context, line, x, y, room, 31);
  pen(16, 400, "--muted");
  y = write(context, rests, x, y + 10, room, 21);
  write(context, origin, x, Math.max(y + 6, HEIGHT - 58), room, 20);
}

export class ProofCard {
  readonly #dialog: HTMLDialogElement;
  readonly #canvas = el("canvas", { class: "card-picture", set: { width: WIDTH, height: HEIGHT, role: "img" } });
  readonly #text = el("textarea", { set: { readonly: "", rows: 6, "aria-label": "The card as text" } });

  constructor(closed: () => void) {
    const save = button({ class: "button" }, () => this.#save(), "Save picture");
    const copy = button({ class: "button" }, () => this.#copy(), "Copy text");
    const close = button({ class: "button" }, () => this.#dialog.close(), "Close");
    this.#dialog = el("dialog", { class: "help proof-card", set: { "aria-label": "What is proved" } }, this.#canvas, el("div", { class: "card-tools" }, save, copy, close), this.#text);
    this.#dialog.addEventListener("close", closed);
    document.body.append(this.#dialog);
  }

  /** `picture`: of the scene, in a data URL. */
  show(view: View, picture: string): void {
    const text = cardText(cardWords(view));
    this.#text.value = text;
    this.#canvas.setAttribute("aria-label", text);
    const scene = el("img");
    scene.onload = () => draw(this.#canvas, view, scene);
    scene.src = picture;
    this.#dialog.showModal();
  }

  close(): void {
    if (this.#dialog.open) this.#dialog.close();
  }

  #save(): void {
    el("a", { set: { href: this.#canvas.toDataURL("image/png"), download: "platewash-proof.png" } }).click();
    announce("The card is saved as platewash-proof.png");
  }

  #copy(): void {
    this.#text.select();
    const done = navigator.clipboard?.writeText(this.#text.value) ?? Promise.reject(new Error("no clipboard"));
    done.then(() => announce("Text copied")).catch(() => announce("The browser does not let this page copy: the text is selected"));
  }
}
