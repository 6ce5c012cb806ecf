/** `window.platewash`: the page in the hands of a test, or of whoever opens the console. */
import type { Controls } from "./controls.ts";
import type { EditHandle } from "./edit/handle.ts";
import type { LivePhase } from "./live.ts";
import type { FrameStatistics, Loop } from "./loop.ts";
import type { Player } from "./player.ts";
import type { Layer } from "./scene/index.ts";
import type { Stage } from "./shell/stage.ts";
import type { View } from "./view.ts";

export interface Handle {
  /** The first frame was drawn. */
  readonly ready: Promise<void>;
  readonly view: View;
  /** [s] */
  readonly duration: number;
  /** The time shown [s]. */
  time(): number;
  seek(t_s: number): void;
  play(): void;
  pause(): void;
  isPlaying(): boolean;
  speed(): number;
  setSpeed(speed: number): void;
  /** Drives the film by a clock [ms] instead of the browser's; frames come only by `step`. Null for the browser's again. */
  setClock(now_ms: (() => number) | null): void;
  /** One frame. */
  step(): void;
  /** Whose motion the arm shows. */
  follow(motion: "planned" | "executed"): void;
  /** Where the tip is in the scene graph, world frame [m]; null without a scene. */
  tip(): [number, number, number] | null;
  /** Where a place of the world is on the scene's canvas [CSS px]; null where it is not, or without a scene. */
  project(place_m: [number, number, number]): [number, number] | null;
  camera(view: string): void;
  layers(): { id: Layer; label: string; on: boolean }[];
  setLayer(layer: Layer, on: boolean): void;
  /** Draws the objects of a layer in one colour, without light. */
  setMarker(layer: Layer, colour: string): void;
  heat(on: boolean): void;
  readonly frame: FrameStatistics;
  /** `recorded`, or how a live run stands. */
  readonly state: "recorded" | LivePhase;
  /** Null in a page that only shows. */
  readonly edit: EditHandle | null;
}

declare global {
  interface Window {
    platewash?: Handle;
  }
}

/** What a handle is of. */
export interface Parts {
  ready: Promise<void>;
  player: Player;
  controls: Controls;
  stage: Stage;
  loop: Loop;
  edit: EditHandle | null;
}

export function handleOf({ ready, player, controls, stage, loop, edit }: Parts): Handle {
  return {
    ready,
    get view() {
      return player.view;
    },
    get duration() {
      return player.duration;
    },
    time: () => player.time,
    seek: (t) => controls.seek(t),
    play: () => controls.play(),
    pause: () => controls.pause(),
    isPlaying: () => controls.playing,
    speed: () => player.clock.speed,
    setSpeed: (speed) => controls.setSpeed(speed),
    setClock: (now) => {
      loop.setClock(now);
      player.clock.resume(loop.now());
    },
    step: () => loop.step(),
    follow: (motion) => controls.follow(motion),
    tip: () => stage.scene?.tip() ?? null,
    project: (place) => stage.scene?.project(place) ?? null,
    camera: (preset) => stage.camera(preset),
    layers: () => stage.scene?.layers() ?? [],
    setLayer: (layer, on) => stage.setLayer(layer, on),
    setMarker: (layer, colour) => stage.scene?.setMarker(layer, colour),
    heat: (on) => controls.heat(on),
    get frame() {
      return loop.statistics;
    },
    get state() {
      return player.phase ?? "recorded";
    },
    edit,
  };
}
