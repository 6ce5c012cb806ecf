/** `window.platewash`: the page in the hands of a test, or of whoever opens the console. */
import type { Controls } from "./controls.ts";
import type { Editor } from "./edit/editor.ts";
import type { LivePhase } from "./live.ts";
import type { FrameStatistics, Loop } from "./loop.ts";
import type { Player } from "./player.ts";
import type { Layer } from "./scene/index.ts";
import type { Stage } from "./shell/stage.ts";
import type { View } from "./view.ts";

export type Handle = ReturnType<typeof handleOf>;

declare global {
  interface Window {
    platewash?: Handle;
  }
}

/** What a handle is of. */
export interface Parts {
  /** The first frame was drawn. */
  ready: Promise<void>;
  player: Player;
  controls: Controls;
  stage: Stage;
  loop: Loop;
  /** Null in a page that only shows. */
  edit: Editor["handle"] | null;
}

export function handleOf({ ready, player, controls, stage, loop, edit }: Parts) {
  return {
    ready,
    get view(): View {
      return player.view;
    },
    /** [s] */
    get duration(): number {
      return player.duration;
    },
    /** The time shown [s]. */
    time: () => player.time,
    seek: (t_s: number) => controls.seek(t_s),
    play: () => controls.play(),
    pause: () => controls.pause(),
    isPlaying: () => controls.playing,
    speed: () => player.clock.speed,
    setSpeed: (speed: number) => controls.setSpeed(speed),
    /** Drives the film by a clock [ms] instead of the browser's; frames come only by `step`. Null for the browser's again. */
    setClock: (now_ms: (() => number) | null) => {
      loop.setClock(now_ms);
      player.clock.resume(loop.now());
    },
    /** One frame. */
    step: () => loop.step(),
    /** Whose motion the arm shows. */
    follow: (motion: "planned" | "executed") => controls.follow(motion),
    /** Where the tip is in the scene graph, world frame [m]; null without a scene. */
    tip: () => stage.scene?.tip() ?? null,
    /** Where a place of the world is on the scene's canvas [CSS px]; null where it is not, or without a scene. */
    project: (place_m: [number, number, number]) => stage.scene?.project(place_m) ?? null,
    camera: (view: string) => stage.camera(view),
    layers: () => stage.scene?.layers() ?? [],
    setLayer: (layer: Layer, on: boolean) => stage.setLayer(layer, on),
    /** Draws the objects of a layer in one colour, without light. */
    setMarker: (layer: Layer, colour: string) => stage.scene?.setMarker(layer, colour),
    heat: (on: boolean) => controls.heat(on),
    get frame(): FrameStatistics {
      return loop.statistics;
    },
    /** `recorded`, or how a live run stands. */
    get state(): "recorded" | LivePhase {
      return player.phase ?? "recorded";
    },
    edit,
  };
}
