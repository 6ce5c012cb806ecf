/** A mark at a place to look at: a ring with a dot, of one size on the screen, before everything else. */
import { CanvasTexture, Sprite, SpriteMaterial, type Vector3Tuple } from "three";
import type { Palette } from "./palette.ts";

/** Of the picture that is shrunk to the mark. */
const PIXELS = 128;
/** Of the mark on the page [CSS px]. */
const SIZE_PX = 44;

function drawn(): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = PIXELS;
  const context = canvas.getContext("2d");
  if (context === null) return canvas;
  const ring = (radius: number, width: number, colour: string): void => {
    context.beginPath();
    context.arc(PIXELS / 2, PIXELS / 2, radius, 0, 2 * Math.PI);
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.stroke();
  };
  ring(40, 20, "rgb(255 255 255 / 0.85)");
  ring(40, 10, "white");
  ring(6, 12, "white");
  return canvas;
}

export class Mark {
  readonly sprite: Sprite;
  readonly #texture = new CanvasTexture(drawn());

  constructor() {
    this.sprite = new Sprite(new SpriteMaterial({ map: this.#texture, sizeAttenuation: false, depthTest: false, depthWrite: false, toneMapped: false }));
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
    this.sprite.scale.setScalar(SIZE_PX * pixel);
  }
}
