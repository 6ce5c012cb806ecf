/** The page, put together: a player, a scene, and everything around them that shows a moment or asks for one. */
import { Address, type Place } from "./address.ts";
import { Controls } from "./controls.ts";
import { PLATE_KEYS } from "./edit/commands.ts";
import { Editor, type Playground } from "./edit/editor.ts";
import type { EditDocument } from "./edit/protocol.ts";
import { quantity } from "./format.ts";
import { type Handle, handleOf } from "./handle.ts";
import { Feed } from "./live.ts";
import { Loop } from "./loop.ts";
import { Player } from "./player.ts";
import { BesidePanel } from "./shell/beside.ts";
import { announce, byId, el, keepingFocus } from "./shell/dom.ts";
import { Banner, Header } from "./shell/header.ts";
import { Help, listenToKeys } from "./shell/keys.ts";
import { type Panel, Panels } from "./shell/panels.ts";
import { Coverages, Plates } from "./shell/plates.ts";
import { Plots } from "./shell/plots.ts";
import { configuration, Readout } from "./shell/readout.ts";
import { about, Requirements } from "./shell/requirements.ts";
import { listenToPrint, Stage } from "./shell/stage.ts";
import { ThemeControl } from "./shell/theme.ts";
import { Tour } from "./shell/tour.ts";
import { Transport } from "./shell/transport.ts";
import type { Check, LiveEnd, View } from "./view.ts";

/** Width of plots on paper [px]. */
const PAPER_PX = 680;
/** How long a document stands before its curves are drawn [ms]. */
const PLOTS_MS = 250;

export class App {
  readonly #editor: Editor | null;
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
  readonly #beside: BesidePanel | null;
  readonly #tour: Tour | null;
  readonly #about = el("div");
  /** Plots wait until documents no longer follow each other. */
  #plotsTimer = 0;
  /** Everything has to be shown anew with the next frame. */
  #anew = true;

  /** `edit`: what makes the page one of a live cell; null where it only shows. `playground`: what stands in the place of a server. */
  constructor(view: View, edit: EditDocument | null, playground: Playground | null = null) {
    this.#player = new Player(view);
    // A live cell's film comes and goes: its place is always there.
    const film = this.#player.duration > 0 || edit !== null;
    let drawn = (): void => undefined;
    this.#ready = new Promise<void>((resolve) => (drawn = resolve)).then(() => {
      // Before its first frame the canvas is black.
      this.#stage.canvas.dataset["drawn"] = "";
      this.#panels.start();
    });
    // The timer lets the browser show the first frame before panels are filled.
    this.#loop = new Loop({ advance: (now) => this.#advance(now), draw: () => this.#draw() }, () => setTimeout(drawn));
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
    const coverages = coveragesOf(view);
    this.#banner = new Banner(this.#player, () => this.#controls.toNewest());
    this.#readout = film ? new Readout(this.#player, this.#shareIn(coverages)) : null;
    this.#stage = new Stage(view, this.#theme.theme, this.#banner.element, this.#readout?.element ?? null, {
      changed: () => this.#show(),
      heat: (on) => this.#controls.heat(on),
      follow: view.execution === null ? null : (motion) => this.#controls.follow(motion),
    });
    this.#help = new Help(film, edit === null ? [] : PLATE_KEYS);
    this.#header = new Header(view, [this.#theme.button, this.#help.button()], () => this.#panels.show("about"));
    this.#transport = film ? this.#makeTransport() : null;
    this.#requirements = new Requirements(view, (check) => this.#choose(check));
    this.#plots = new Plots(this.#player, () => this.#theme.palette, (t) => this.#controls.seek(t));
    this.#plates = new Plates(this.#player, coverages, (plate) => this.#toPlate(plate));
    this.#stage.cover(this.#plates.scale);
    this.#editor = edit === null ? null : this.#makeEditor(edit, view, playground);
    this.#about.replaceChildren(about(view));
    const { scene } = this.#stage;
    this.#beside = view.beside === null || scene === null ? null : new BesidePanel(this.#player, view.beside, scene, () => this.#show());
    if (this.#beside !== null) this.#stage.addTool(this.#beside.button, this.#beside.element);
    this.#tour = !film || scene === null ? null : new Tour(this.#player, this.#controls, scene, (check) => this.#mark(check, false));
    if (this.#tour !== null) this.#stage.addTool(this.#tour.button, this.#tour.element, this.#tour.label);
    this.#panels = new Panels([...(this.#editor?.panels ?? []), ...this.#makePanels(film)], this.#address.place.panel, () => this.#address.touch());
    this.#listen();
    this.#go(this.#address.place);
  }

  /** The first frame, then all that follows it. */
  start(): void {
    this.#stage.fit();
    this.#stage.showMotion(this.#player.follows, this.#player.shown.heat);
    const quiet = matchMedia("(prefers-reduced-motion: reduce)").matches || this.#editor !== null;
    if (!quiet && !this.#player.live && this.#address.place.t === null) this.#controls.play();
    this.#loop.start();
    this.#feed.start();
    this.#editor?.start(this.#stage.canvas);
  }

  get handle(): Handle {
    return handleOf({ ready: this.#ready, player: this.#player, controls: this.#controls, stage: this.#stage, loop: this.#loop, edit: this.#editor?.handle ?? null });
  }

  /** Shows another document in place of this one: time, camera, panels, scroll and focus stay. */
  replace(view: View): void {
    keepingFocus(byId("panels"), () => {
      const coverages = coveragesOf(view);
      const { motion, clearance } = this.#player.view;
      this.#player.replace(view, this.#loop.now());
      this.#stage.replace(view);
      this.#header.replace(view);
      this.#readout?.replace(this.#shareIn(coverages));
      this.#transport?.replace(view, this.#player.duration);
      this.#requirements.replace(view);
      this.#tour?.replaced();
      this.#plates.replace(coverages);
      if (this.#panels.shows("plates")) this.#plates.show();
      this.#about.replaceChildren(about(view));
      if (view.motion !== motion || view.clearance !== clearance) this.#renewPlots();
    });
    this.#changed();
  }

  /** Curves take longer than a frame. */
  #renewPlots(): void {
    this.#plots.replace();
    clearTimeout(this.#plotsTimer);
    this.#plotsTimer = window.setTimeout(() => {
      if (this.#panels.shows("plots")) this.#plots.show();
    }, PLOTS_MS);
  }

  #shareIn(coverages: Coverages): (plate: number, t: number) => number | null {
    return (plate, t) => coverages.shareAt(plate, this.#player.coverageKind, t);
  }

  #makeEditor(edit: EditDocument, view: View, playground: Playground | null): Editor {
    const { canvas, scene } = this.#stage;
    return new Editor(edit, view, {
      edit: (actions) => scene?.edit(actions) ?? null,
      size: () => [canvas.clientWidth, canvas.clientHeight],
      replace: (next) => this.replace(next),
      say: (said, stale) => {
        this.#header.say(said, stale);
        this.#hold(stale);
      },
      link: (entries) => this.#address.keep(entries),
      time: () => this.#player.time,
      seek: (t) => this.#controls.seek(t),
    }, playground);
  }

  /** While something is changed that the plan does not have, its film stands still. */
  #hold(stale: boolean): void {
    document.documentElement.toggleAttribute("data-stale", stale);
    this.#controls.hold(stale);
    this.#stage.scene?.setStale(stale);
    this.#transport?.hold(stale);
    this.#requirements.showInstead(stale ? this.#header.valid : null);
  }

  #makeTransport(): Transport {
    const controls = this.#controls;
    return new Transport(this.#player.view, this.#player.duration, this.#theme.palette, {
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
      film ? null : { id: "joints", title: "Joints", content: configuration(this.#player.view) },
      film ? { id: "requirements", title: this.#editor === null ? "Requirements" : "Proof", content: this.#requirements.element } : null,
      film ? { id: "plots", title: "Plots", content: this.#plots.element, onShow: () => this.#plots.show() } : null,
      this.#player.view.coverage.length > 0 || this.#editor !== null
        ? { id: "plates", title: "Plates", content: this.#plates.element, onShow: () => this.#plates.show() }
        : null,
      { id: "about", title: "About", content: this.#about },
    ];
    return panels.filter((panel) => panel !== null);
  }

  #advance(now: number): boolean {
    this.#editor?.advance(now);
    const ran = this.#player.tick(now);
    this.#tour?.advance(now);
    const anew = this.#anew;
    this.#anew = false;
    if (this.#player.phase !== null) this.#grow(now);
    if (!ran && !anew) return false;
    this.#stage.scene?.show(this.#player.show());
    this.#beside?.update();
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
    const draws = scene !== null && scene.needsRender();
    if (draws) scene.render();
    this.#editor?.drawn(performance.now());
    return draws;
  }

  /** Shows everything anew with the next frame. */
  #show(): void {
    this.#anew = true;
  }

  #changed(): void {
    this.#transport?.setSpeed(this.#player.clock.speed);
    this.#stage.showMotion(this.#player.follows, this.#player.shown.heat);
    this.#plates.showScale(this.#player.shown.heat);
    this.#show();
    this.#address.touch();
  }

  /** Marks a requirement's worst place, or none. */
  #mark(check: Check | null, looks = true): void {
    const { place_m = null, plate, time_s } = check?.worst ?? {};
    // What is worst at no moment is worst of a plate's face.
    const face = time_s !== undefined || plate === undefined ? null : (this.#player.view.plates[plate] ?? null);
    this.#stage.scene?.focus(place_m, looks, face);
    // Under the scene, a row in sight would take the scene out of it.
    this.#requirements.mark(check, looks || matchMedia("(min-width: 880px)").matches);
  }

  /** Goes to where a requirement is worst; to the end of the washing where that is a place of a plate at no moment. */
  #choose(check: Check): void {
    const { time_s, plate } = check.worst;
    this.#controls.pause();
    const washed = this.#player.view.segments.findLast((one) => one.kind === "wash" && one.plate === plate)?.t_end_s;
    const t = time_s ?? washed;
    if (t !== undefined) this.#controls.seek(t);
    this.#panels.show("requirements");
    this.#mark(check);
    this.#stage.root.scrollIntoView({ block: "nearest" });
    this.#show();
    announce(`${check.words}, worst${time_s === undefined ? "" : ` at ${quantity(time_s, 2, "seconds")}`}: ${check.place}`);
  }

  #toPlate(plate: number): void {
    const start = this.#controls.toPlate(plate);
    if (start !== null) announce(`${this.#player.view.plates[plate]?.name ?? "plate"}, at ${quantity(start, 2, "seconds")}`);
  }

  /** Where the page stands; null while that changes by itself. */
  #place(): Place | null {
    const { time, clock, follows, live } = this.#player;
    if (this.#controls.playing || live) return null;
    const { panel, camera } = this.#address.place;
    const speed = clock.speed === 1 ? null : clock.speed;
    return { t: this.#transport === null || this.#player.duration === 0 ? null : time, speed, show: follows === "executed" ? follows : null, panel, camera };
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
      picture: () => stage.savePicture(),
      fullscreen: () => stage.toggleFullscreen(),
      help: () => this.#help.toggle(),
    });
    this.#address.onChange((place) => this.#go(place));
    this.#theme.onChange = (theme) => {
      stage.scene?.setTheme(theme);
      this.#transport?.setPalette(this.#theme.palette);
      this.#plots.recolour();
      this.#show();
    };
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
    const execution = this.#player.view.execution;
    if (execution === null) return;
    execution.headline = end.headline;
    execution.washed = end.washed;
    this.#header.update();
    this.#changed();
    announce(end.headline);
  }
}

function coveragesOf(view: View): Coverages {
  return new Coverages(view.coverage, view.execution?.coverage ?? []);
}
