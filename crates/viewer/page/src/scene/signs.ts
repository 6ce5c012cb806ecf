/** Signs of one size on the screen, before everything else: over plates a cross or a question mark, and the mark at a place to look at. */
import { CanvasTexture, Group, type Matrix4, type Object3D, Sprite, SpriteMaterial, type Vector3, type Vector3Tuple } from "three";
import type { Solid } from "./handles.ts";
import type { Palette } from "./palette.ts";

export type SignKind = "unclear" | "unwashable";

const LETTERS: Record<SignKind, string> = { unclear: "?", unwashable: "×" };
/** Of the picture that is shrunk to a sign or the mark. */
const PIXELS = 128;
/** Of a sign and of the mark on the page [CSS px]. */
const SIGN_PX = 26;
const MARK_PX = 44;
/** How far over the plate a sign is [m]. */
const LIFT_M = 0.01;

/** A picture that `paint` draws about its middle. */
function picture(paint?: (context: CanvasRenderingContext2D) => void): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = PIXELS;
  const context = canvas.getContext("2d");
  context?.translate(PIXELS / 2, PIXELS / 2);
  if (context !== null) paint?.(context);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = "srgb";
  return texture;
}

function circle(context: CanvasRenderingContext2D, radius: number, width: number, colour: string, inside = "transparent"): void {
  context.beginPath();
  context.arc(0, 0, radius, 0, 2 * Math.PI);
  context.fillStyle = inside;
  context.fill();
  context.lineWidth = width;
  context.strokeStyle = colour;
  context.stroke();
}

/** A ring with a dot. */
function target(context: CanvasRenderingContext2D): void {
  circle(context, 40, 20, "rgb(255 255 255 / 0.85)");
  circle(context, 40, 10, "white");
  circle(context, 6, 12, "white");
}

/** White letters on a disc, so large as a share of it. */
function letter(context: CanvasRenderingContext2D, text: string, colour: string, size = 0.62): void {
  circle(context, 0.42 * PIXELS, 8, "white", colour);
  context.fillStyle = "white";
  context.font = `bold ${size * PIXELS}px sans-serif`;
  context.textAlign = "center";
  const { actualBoundingBoxAscent: up, actualBoundingBoxDescent: down } = context.measureText(text);
  context.fillText(text, 0, (up - down) / 2);
}

/** `over`: before everything else. */
function material(map: CanvasTexture, over = true): SpriteMaterial {
  return new SpriteMaterial({ map, sizeAttenuation: false, depthTest: !over, depthWrite: !over, toneMapped: false });
}

/** Marks a place to look at. */
export class Mark {
  readonly sprite = new Sprite(material(picture(target)));

  constructor() {
    this.sprite.renderOrder = 9;
    this.sprite.visible = false;
  }

  setPalette(palette: Palette): void {
    this.sprite.material.color.set(palette.mark);
  }

  show(place: Vector3Tuple | null): void {
    this.sprite.visible = place !== null;
    if (place !== null) this.sprite.position.set(...place);
  }

  /** Keeps the mark's size where a CSS pixel is so much of the picture at distance 1. No allocation. */
  setScale(pixel: number): void {
    this.sprite.scale.setScalar(MARK_PX * pixel);
  }
}

/** Of a plate's number [CSS px], and how far outside the rim it is [m]. */
const NUMBER_PX = 19;
const OUTSIDE_M = 0.016;
/** Numbers that are drawn: with more plates nobody reads them. */
const MOST_NUMBERS = 99;
const NUMBER_COLOUR = "#3a4651";

/** Plates' numbers at their rims. */
export class PlateNumbers {
  readonly #materials = new Map<string, SpriteMaterial>();
  #sprites: Sprite[] = [];

  /** Puts numbers beside plates, each within the object that draws its plate. `base` is where the arm stands, world frame. */
  replace(plates: readonly { number: string; object: Object3D; pose: Matrix4; rim_m: number }[], base: Vector3): void {
    for (const sprite of this.#sprites) sprite.removeFromParent();
    this.#sprites = plates.length > MOST_NUMBERS ? [] : plates.map(({ number, object, pose, rim_m }) => {
      const sprite = new Sprite(this.#materialOf(number));
      sprite.renderOrder = 7;
      sprite.position.copy(outwards(pose, base).multiplyScalar(rim_m + OUTSIDE_M));
      object.add(sprite);
      return sprite;
    });
  }

  #materialOf(number: string): SpriteMaterial {
    const size = number.length > 1 ? 0.46 : 0.62;
    const known = this.#materials.get(number) ?? material(picture((context) => letter(context, number, NUMBER_COLOUR, size)), false);
    this.#materials.set(number, known);
    return known;
  }

  /** Keeps their size where a CSS pixel is so much of the picture at distance 1. No allocation. */
  setScale(pixel: number): void {
    for (const sprite of this.#sprites) sprite.scale.setScalar(NUMBER_PX * pixel);
  }
}

/** The direction along a face, plate frame, that leads away from the base; upwards on a face that looks at the base. */
function outwards(pose: Matrix4, base: Vector3): Vector3 {
  const inverse = pose.clone().invert();
  const along = base.clone().applyMatrix4(inverse).negate().setZ(0);
  if (along.length() < 0.05) along.set(0, 0, 1).transformDirection(inverse).setZ(0);
  return along.length() < 1e-6 ? along.set(1, 0, 0) : along.normalize();
}

/** Signs over plates of which something is said. */
export class Signs {
  readonly root = new Group();
  readonly #materials: Record<SignKind, SpriteMaterial> = { unclear: material(picture()), unwashable: material(picture()) };
  readonly #sprites: Sprite[] = [];

  setPalette(palette: Palette): void {
    for (const kind of ["unclear", "unwashable"] as const) {
      this.#materials[kind].map?.dispose();
      this.#materials[kind].map = picture((context) => letter(context, LETTERS[kind], palette.sign[kind]));
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
    for (const sprite of this.#sprites) sprite.scale.setScalar(SIGN_PX * pixel);
  }
}
