/** Signs over plates, of one size on the screen, before everything else: a cross, a question mark. */
import { CanvasTexture, Group, Sprite, SpriteMaterial } from "three";
import type { Palette } from "./palette.ts";
import type { Solid } from "./pick.ts";

export type SignKind = "unclear" | "unwashable";

const LETTERS: Record<SignKind, string> = { unclear: "?", unwashable: "×" };
/** Of the picture that is shrunk to the sign. */
const PIXELS = 96;
/** Of the sign on the page [CSS px]. */
const SIZE_PX = 26;
/** How far over the plate it is [m]. */
const LIFT_M = 0.01;

/** A white letter on a disc. */
function drawn(letter: string, colour: string): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = PIXELS;
  const context = canvas.getContext("2d");
  if (context === null) return canvas;
  const [middle, radius] = [PIXELS / 2, 0.42 * PIXELS];
  context.beginPath();
  context.arc(middle, middle, radius, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
  context.lineWidth = 6;
  context.strokeStyle = "white";
  context.stroke();
  context.fillStyle = "white";
  context.font = `bold ${0.62 * PIXELS}px sans-serif`;
  context.textAlign = "center";
  const { actualBoundingBoxAscent: up, actualBoundingBoxDescent: down } = context.measureText(letter);
  context.fillText(letter, middle, middle + (up - down) / 2);
  return canvas;
}

export class Signs {
  readonly root = new Group();
  readonly #materials: Record<SignKind, SpriteMaterial>;
  readonly #sprites: Sprite[] = [];

  constructor() {
    const material = (): SpriteMaterial => new SpriteMaterial({ sizeAttenuation: false, depthTest: false, depthWrite: false, toneMapped: false });
    this.#materials = { unclear: material(), unwashable: material() };
    for (const kind of ["unclear", "unwashable"] as const) this.#materials[kind].map = new CanvasTexture(document.createElement("canvas"));
  }

  setPalette(palette: Palette): void {
    for (const kind of ["unclear", "unwashable"] as const) {
      this.#materials[kind].map?.dispose();
      const texture = new CanvasTexture(drawn(LETTERS[kind], palette.sign[kind]));
      texture.colorSpace = "srgb";
      this.#materials[kind].map = texture;
    }
  }

  /** Puts signs over plates, and takes all others away. */
  show(list: readonly { kind: SignKind; solid: Solid }[]): void {
    while (this.#sprites.length < list.length) {
      const sprite = new Sprite(this.#materials.unclear);
      sprite.renderOrder = 8;
      this.#sprites.push(sprite);
      this.root.add(sprite);
    }
    this.#sprites.forEach((sprite, index) => {
      const sign = list[index];
      sprite.visible = sign !== undefined;
      if (sign === undefined) return;
      sprite.material = this.#materials[sign.kind];
      sprite.position.set(0, 0, sign.solid.top_m + LIFT_M).applyMatrix4(sign.solid.pose);
    });
  }

  /** Keeps their size where a CSS pixel is so much of the picture at distance 1. No allocation. */
  setScale(pixel: number): void {
    for (const sprite of this.#sprites) sprite.scale.setScalar(SIZE_PX * pixel);
  }
}
