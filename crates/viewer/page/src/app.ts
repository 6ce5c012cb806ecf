/** The page, put together: a player, a scene, and everything around them that shows a moment or asks for one. */
import { Address } from "./address.ts";
import { Controls } from "./controls.ts";
import { Feed } from "./feed.ts";
import { quantity } from "./format.ts";
import type { Handle } from "./handle.ts";
import type { Place } from "./link.ts";
import { Loop } from "./loop.ts";
import { Player } from "./player.ts";
import { about } from "./shell/about.ts";
import { announce } from "./shell/announcer.ts";
import { Banner } from "./shell/banner.ts";
import { Header } from "./shell/header.ts";
import { Help } from "./shell/help.ts";
import { configuration } from "./shell/joints.ts";
import { listenToKeys } from "./shell/keys.ts";
import { Panels, type Panel } from "./shell/panels.ts";
import { Coverages, Plates } from "./shell/plates.ts";
import { Plots } from "./shell/plots.ts";
import { listenToPrint } from "./shell/print.ts";
import { Readout } from "./shell/readout.ts";
import { Requirements } from "./shell/requirements.ts";
import { Stage } from "./shell/stage.ts";
import { ThemeControl } from "./shell/theme.ts";
import { Transport } from "./shell/transport.ts";
import type { Check, LiveEnd, View } from "./view.ts";

/** Width of plots on paper [px]. */
const PAPER_PX = 680;

export class App {
  readonly #view: View;
  readonly #player: Player;
  readonly #controls: Controls;
  readonly #loop: Loop;
  readonly #ready: Promise<void>;
  readonly #address: Address;
  readonly #feed: Feed;
  readonly #theme = new ThemeControl();
  readonly #help: Help;
  readonly #header: Header;
  readonly #banner: Banner;
  readonly #stage: Stage;
  readonly #readout: Readout | null;
  readonly #transport: Transport | null;
  readonly #requirements: Requirements;
  readonly #plots: Plots;
  readonly #plates: Plates;
  readonly #panels: Panels;
  /** Everything has to be shown anew with the next frame. */
  #anew = true;

  constructor(view: View) {
    this.#view = view;
    this.#player = new Player(view);
    const film = this.#player.duration > 0;
    const { promise, resolve } = newPromise();
    this.#ready = promise;
    const afterFirst = (): void => {
      this.#panels.start();
      resolve();
    };
    // The timer lets the browser show the first frame before panels are filled.
    this.#loop = new Loop({ advance: (now) => this.#advance(now), draw: () => this.#draw() }, () => setTimeout(afterFirst));
    this.#controls = new Controls(this.#player, () => this.#loop.now(), {
      changed: () => this.#changed(),
      moved: () => this.#mark(null),
    });
    this.#address = new Address(() => this.#place());
    this.#feed = new Feed(this.#player, {
      changed: () => this.#show(),
      draw: (times, positions) => this.#stage.scene?.appendExecuted(times, positions),
      done: (end) => this.#done(end),
    });
    const coverages = new Coverages(view.coverage, view.execution?.coverage ?? []);
    this.#banner = new Banner(this.#player, () => this.#controls.toNewest());
    this.#readout = film ? new Readout(this.#player, (plate, t) => coverages.shareAt(plate, this.#player.coverageKind, t)) : null;
    this.#stage = new Stage(view, this.#theme.theme, this.#banner.element, this.#readout?.element ?? null, {
      changed: () => this.#show(),
      heat: (on) => this.#controls.heat(on),
      follow: view.execution === null ? null : (motion) => this.#controls.follow(motion),
    });
    this.#help = new Help(film);
    this.#header = new Header(view, [this.#theme.button(), this.#help.button()]);
    this.#transport = film ? this.#makeTransport() : null;
    this.#requirements = new Requirements(view, (check) => this.#choose(check));
    this.#plots = new Plots(this.#player, () => this.#theme.palette, (t) => this.#controls.seek(t));
    this.#plates = new Plates(this.#player, coverages, (plate) => this.#toPlate(plate));
    this.#panels = new Panels(this.#makePanels(film), this.#address.place.panel, () => this.#address.touch());
    this.#listen();
    this.#go(this.#address.place);
  }

  /** The first frame, then all that follows it. */
  start(): void {
    this.#stage.fit();
    const quiet = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (!quiet && !this.#player.live && this.#address.place.t === null) this.#controls.play();
    this.#loop.start();
    this.#feed.start();
  }

  get handle(): Handle {
    const [player, controls, stage, loop] = [this.#player, this.#controls, this.#stage, this.#loop];
    return {
      ready: this.#ready,
      view: this.#view,
      duration: player.duration,
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
      heat: (on) => controls.heat(on),
      get frame() {
        return loop.statistics;
      },
      get state() {
        return player.phase ?? "recorded";
      },
    };
  }

  #makeTransport(): Transport {
    const controls = this.#controls;
    return new Transport(this.#view, this.#player.duration, this.#theme.palette, {
      toggle: () => controls.toggle(),
      toStart: () => controls.seek(0),
      segment: (direction) => controls.toSegment(direction),
      speed: (speed) => controls.setSpeed(speed),
      seek: (t) => controls.seek(t),
      choose: (check) => this.#choose(check),
    });
  }

  #makePanels(film: boolean): Panel[] {
    const panels: (Panel | null)[] = [
      film ? null : { id: "joints", title: "Joints", content: configuration(this.#view) },
      film ? { id: "requirements", title: "Requirements", content: this.#requirements.element } : null,
      film ? { id: "plots", title: "Plots", content: this.#plots.element, onShow: () => this.#plots.show() } : null,
      this.#view.coverage.length > 0
        ? { id: "plates", title: "Plates", content: this.#plates.element, onShow: () => this.#plates.show() }
        : null,
      { id: "about", title: "About", content: about(this.#view) },
    ];
    return panels.filter((panel) => panel !== null);
  }

  #advance(now: number): boolean {
    const ran = this.#player.tick(now);
    const anew = this.#anew;
    this.#anew = false;
    if (this.#player.phase !== null) this.#grow(now);
    if (!ran && !anew) return false;
    this.#stage.scene?.show(this.#player.show());
    const { playing } = this.#controls;
    this.#transport?.update(this.#player.time, this.#player.edge, now);
    this.#transport?.setPlaying(playing);
    const still = anew || !playing;
    this.#readout?.update(now, still);
    if (this.#panels.shows("plots")) this.#plots.update(now, still);
    if (this.#panels.shows("plates")) this.#plates.update(now, still);
    if (ran && !playing) this.#address.touch();
    return ran;
  }

  /** What a live run changes, whether time runs or not. */
  #grow(now: number): void {
    this.#feed.flush(now);
    this.#banner.update();
    this.#transport?.update(this.#player.time, this.#player.edge, now);
    if (this.#panels.shows("plots")) this.#plots.grow();
  }

  #draw(): boolean {
    const scene = this.#stage.scene;
    if (scene === null || !scene.needsRender()) return false;
    scene.render();
    return true;
  }

  /** Shows everything anew with the next frame. */
  #show(): void {
    this.#anew = true;
  }

  #changed(): void {
    this.#transport?.setSpeed(this.#player.clock.speed);
    this.#stage.showMotion(this.#player.follows, this.#player.shown.heat);
    this.#show();
    this.#address.touch();
  }

  /** Marks a requirement's worst place, or none. */
  #mark(check: Check | null): void {
    this.#stage.scene?.focus(check?.worst?.place_m ?? null);
    this.#requirements.mark(check);
  }

  /** Goes to where a requirement is worst. */
  #choose(check: Check): void {
    const worst = check.worst;
    if (worst === null) return;
    this.#controls.pause();
    if (worst.time_s !== null) this.#controls.seek(worst.time_s);
    this.#panels.show("requirements");
    this.#mark(check);
    this.#stage.root.scrollIntoView({ block: "nearest" });
    this.#show();
    announce(`${check.words}, worst${worst.time_s === null ? "" : ` at ${quantity(worst.time_s, 2, "seconds")}`}: ${worst.words}`);
  }

  #toPlate(plate: number): void {
    const start = this.#controls.toPlate(plate);
    if (start !== null) announce(`${this.#view.plates[plate]?.name ?? "plate"}, at ${quantity(start, 2, "seconds")}`);
  }

  /** Where the page stands; null while that changes by itself. */
  #place(): Place | null {
    const { time, clock, follows, live } = this.#player;
    if (this.#controls.playing || live) return null;
    const { panel, camera } = this.#address.place;
    const speed = clock.speed === 1 ? null : clock.speed;
    return { t: this.#transport === null ? null : time, speed, show: follows === "executed" ? follows : null, panel, camera };
  }

  #go(place: Place): void {
    if (place.speed !== null) this.#controls.setSpeed(place.speed);
    if (place.show !== null) this.#controls.follow(place.show);
    if (place.camera !== null) this.#stage.camera(place.camera);
    if (place.panel !== null) this.#panels.show(place.panel);
    if (place.t === null) return;
    this.#controls.pause();
    this.#controls.seek(place.t);
  }

  #listen(): void {
    const [controls, stage] = [this.#controls, this.#stage];
    listenToKeys({
      toggle: () => controls.toggle(),
      step: (direction, coarse) => controls.step(direction, coarse),
      toStart: () => controls.seek(0),
      toEnd: () => controls.toEnd(),
      speed: (up) => controls.stepSpeed(up),
      plate: (number) => this.#toPlate(controls.plateWith(number)),
      layers: () => stage.toggleLayers(),
      camera: () => stage.nextCamera(),
      fullscreen: () => stage.toggleFullscreen(),
      help: () => this.#help.toggle(),
    });
    this.#address.onChange((place) => this.#go(place));
    this.#theme.onChange((theme) => {
      stage.scene?.setTheme(theme);
      this.#transport?.setPalette(this.#theme.palette);
      this.#plots.recolour();
      this.#show();
    });
    // A hidden page gets no frames: its film waits.
    document.addEventListener("visibilitychange", () => {
      if (!document.hidden) this.#player.clock.resume(this.#loop.now());
    });
    listenToPrint(stage.canvas, (printing) => this.#print(printing));
  }

  /** Everything at once, since the browser does not wait for a frame. */
  #print(printing: boolean): void {
    this.#theme.print(printing);
    this.#panels.print(printing);
    this.#plots.print(printing ? PAPER_PX : null);
    this.#plates.print();
    this.#stage.scene?.show(this.#player.show());
    this.#stage.scene?.render();
  }

  #done(end: LiveEnd): void {
    const execution = this.#view.execution;
    if (execution === null) return;
    execution.headline = end.headline;
    execution.washed = end.washed;
    this.#header.update();
    this.#changed();
    announce(end.headline);
  }
}

function newPromise(): { promise: Promise<void>; resolve: () => void } {
  let resolve = (): void => undefined;
  const promise = new Promise<void>((done) => {
    resolve = done;
  });
  return { promise, resolve };
}
