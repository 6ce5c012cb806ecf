/** Views: what the camera has to show, where it stands and how it gets there. */
import { Box3, Matrix4, PerspectiveCamera, Sphere, Vector3 } from "three";
import type { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Kinematics, matrixOf } from "../motion.ts";
import { floats } from "../numbers.ts";
import type { View } from "../view.ts";
import { patchAt } from "./floor.ts";

/** How thick an arm is reckoned about the frames of its joints [m]. */
const THICK_M = 0.09;
const ABOVE = [new Vector3(0, 0, THICK_M)];
const AROUND = [...ABOVE, ...[[0, 0, -1], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]].map((way) => new Vector3(...way).multiplyScalar(THICK_M))];
/** Places farther out are not shown [m]. */
const FARTHEST_M = 50;

export interface Extent {
  /** Places that have to be in the picture, world frame. */
  points: Vector3[];
  box: Box3;
  sphere: Sphere;
  /** How far the overview is turned about the vertical [rad]. */
  facing: number;
}

const UP = new Vector3(0, 0, 1);

/** The part of the canvas that nothing covers, as shares of it from its upper left corner. */
export interface Room {
  top: number;
  bottom: number;
}

/** How far beyond the rim a plate's number reaches [m]. */
const BEYOND_M = 0.03;

function platePoints(view: View): Vector3[] {
  return view.plates.flatMap((plate) => {
    const rim = plate.meridian_m[plate.meridian_m.length - 1] ?? [0, 0];
    const pose = matrixOf(plate.pose);
    return Array.from({ length: 8 }, (_, i) => {
      const angle = (i * Math.PI) / 4;
      const radius = rim[0] + BEYOND_M;
      return new Vector3(radius * Math.cos(angle), radius * Math.sin(angle), rim[1]).applyMatrix4(pose);
    });
  });
}

/** Where the arm gets to at up to 64 knots. */
function motionPoints(view: View): Vector3[] {
  const kinematics = new Kinematics(view.arm, view.tool);
  const rows = view.motion === null ? Float64Array.from(view.pose_rad) : floats(view.motion.q_rad);
  const axes = Math.max(1, view.arm.joints.length);
  const step = Math.max(1, Math.floor(rows.length / axes / 64));
  const pose = new Matrix4();
  const points: Vector3[] = [];
  // An arm that stands on the floor is seen from above; of others any side may be the outermost.
  const about = patchAt(view) === null ? AROUND : ABOVE;
  for (let k = 0; (k + 1) * axes <= rows.length; k += step) {
    kinematics.frames(rows, k * axes, (frame) => points.push(...about.map((way) => new Vector3().setFromMatrixPosition(frame).add(way))));
    points.push(new Vector3().setFromMatrixPosition(kinematics.tip(rows, pose, k * axes)));
  }
  return points;
}

/** Half of the edge of the square that an arm's foot is reckoned as [m]. */
const FOOT_M = 0.2;

function footPoints(view: View): Vector3[] {
  const mount = matrixOf(view.arm.mount);
  return [-FOOT_M, FOOT_M].flatMap((x) => [-FOOT_M, FOOT_M].map((y) => new Vector3(x, y, 0).applyMatrix4(mount)));
}

/** Corners of a box of a size that can be shown. */
function corners(box: Box3): Vector3[] {
  if (box.isEmpty()) return [];
  const ends = [box.min, box.max];
  return ends.flatMap(({ x }) => ends.flatMap(({ y }) => ends.map(({ z }) => new Vector3(x, y, z))));
}

/** How far beyond arm and plates obstacles are in the picture [m]. */
const BESIDE_M = 0.03;

/** What a document's picture has to hold: the arm's whole sweep, the plates, and what is beside them of a box about all `obstacles`. */
export function extentOf(view: View, obstacles: Box3): Extent {
  const drawable = (point: Vector3): boolean => point.toArray().every((x) => Number.isFinite(x) && Math.abs(x) < FARTHEST_M);
  const points = [...footPoints(view), ...platePoints(view), ...motionPoints(view)].filter(drawable);
  const near = new Box3().setFromPoints(points).expandByScalar(BESIDE_M);
  points.push(...corners(obstacles.clone().intersect(near)));
  const box = new Box3().setFromPoints(points);
  return { points, box, sphere: box.getBoundingSphere(new Sphere()), facing: facingOf(view) };
}

/** Turns of the overview about the vertical that are tried [deg], the preferred first. */
const TURNS_DEG = [0, -20, 20, -40, 40, -60, 60, -80, 80, -100, 100, -120, 120, -140, 140, -160, 160, 180];
/** Share of the faces that another turn has to show in addition, to the first and to one tried before. */
const WORTH = 0.15;
const WORTH_THEN = 0.01;
/** Half of the width of what an arm is taken to hide behind its foot [m]. */
const HIDES_M = 0.15;

/** The turn of the overview about the vertical from which the plates' faces are seen best [rad]. */
function facingOf(view: View): number {
  const foot = new Vector3(...view.arm.mount.position_m);
  const plates = view.plates.map(({ pose }) => ({ normal: new Vector3(0, 0, 1).transformDirection(matrixOf(pose)), at: new Vector3(...pose.position_m).sub(foot) }));
  const seen = (turn: number): number => {
    const eye = new Vector3(...DIRECTIONS.overview.from).normalize().applyAxisAngle(UP, turn);
    const side = UP.clone().cross(eye).normalize();
    const hidden = ({ at }: { at: Vector3 }): boolean => at.dot(eye.clone().setZ(0)) < 0 && Math.abs(at.dot(side)) < HIDES_M;
    return plates.reduce((sum, plate) => sum + (hidden(plate) ? 0 : Math.max(0, plate.normal.dot(eye))), 0) / Math.max(1, plates.length);
  };
  const turns = TURNS_DEG.map((turn) => ({ turn: (turn * Math.PI) / 180, share: seen((turn * Math.PI) / 180) }));
  const [first] = turns;
  return turns.reduce((best, one) => (one.share > best.share + (best === first ? WORTH : WORTH_THEN) ? one : best)).turn;
}

export type Preset = "overview" | "above" | "front" | "side" | "follow";

interface Direction {
  label: string;
  /** From what is looked at to the eye. */
  from: [number, number, number];
  /** Vertical angle of view [deg]; small ones look like a drawing without perspective. */
  fov_deg: number;
}

const DIRECTIONS: Record<Preset, Direction> = {
  overview: { label: "Overview", from: [1, -0.82, 0.78], fov_deg: 30 },
  above: { label: "From above", from: [0, -1e-4, 1], fov_deg: 7 },
  front: { label: "Front", from: [1, 0, 0.12], fov_deg: 12 },
  side: { label: "Side", from: [0, -1, 0.12], fov_deg: 12 },
  follow: { label: "Follow the tip", from: [0.9, -0.75, 0.62], fov_deg: 30 },
};

export const PRESETS: readonly { id: Preset; label: string }[] = (Object.keys(DIRECTIONS) as Preset[]).map((id) => ({ id, label: DIRECTIONS[id].label }));

/** Share of the picture that content fills. */
const FILL = 0.94;
/** Time of a flight from view to view [s]. */
const FLIGHT_S = 0.55;
/** Cosine of the angle to a face's normal from which the face is seen well, and how much of the direction of before is kept otherwise. */
const FACING = 0.75;
const ASIDE = 0.5;
/** How far off the tip is followed [m]. */
const FOLLOW_M = 0.62;

interface Stand {
  target: Vector3;
  eye: Vector3;
  fov_deg: number;
}

/** The middle along an axis from which the outermost points appear equally far off on either side, seen from the depth `d`. */
function centred(points: readonly Vector3[], axis: Vector3, back: Vector3, d: number, start: number): number {
  let middle = start;
  for (let round = 0; round < 20; round++) {
    let [high, low, depth] = [-Infinity, Infinity, 0];
    for (const point of points) {
      const away = Math.max(1e-3, d - point.dot(back));
      const at = (point.dot(axis) - middle) / away;
      high = Math.max(high, at);
      low = Math.min(low, at);
      depth = Math.max(depth, away);
    }
    if (points.length > 0) middle += (depth * (high + low)) / 4;
  }
  return middle;
}

/** The nearest stand in a direction from which all points are in a picture of that aspect, in the share `height` of its height. */
function standFor(points: readonly Vector3[], from: Vector3, fov_deg: number, aspect: number, height: number): Stand {
  const back = from.clone().normalize();
  const right = UP.clone().cross(back);
  if (right.lengthSq() < 1e-12) right.set(1, 0, 0);
  right.normalize();
  const up = back.clone().cross(right);
  const half = FILL * Math.tan((fov_deg * Math.PI) / 360);
  const [tall, wide] = [half * height, half * aspect];
  // Of x ≤ wide (d − depth) for all points on either side, d and the middle follow; likewise for y.
  let d = 0;
  const middle = [0, 0];
  for (const [axis, slope, k] of [[right, wide, 0], [up, tall, 1]] as const) {
    let high = -Infinity;
    let low = -Infinity;
    for (const point of points) {
      const [at, depth] = [point.dot(axis), point.dot(back)];
      high = Math.max(high, at + slope * depth);
      low = Math.max(low, -at + slope * depth);
    }
    d = Math.max(d, (high + low) / (2 * slope));
    middle[k] = (high - low) / 2;
  }
  middle[0] = centred(points, right, back, d, middle[0]!);
  middle[1] = centred(points, up, back, d, middle[1]!);
  const depths = points.map((point) => point.dot(back));
  const depth = points.length > 0 ? (Math.max(...depths) + Math.min(...depths)) / 2 : 0;
  const place = (along: number): Vector3 =>
    new Vector3().addScaledVector(right, middle[0]!).addScaledVector(up, middle[1]!).addScaledVector(back, along);
  return { target: place(depth), eye: place(Math.max(d, depth + 0.05)), fov_deg };
}

function ease(share: number): number {
  return share < 0.5 ? 4 * share ** 3 : 1 - (2 - 2 * share) ** 3 / 2;
}

/** Moves one camera. */
export class Views {
  readonly #camera: PerspectiveCamera;
  readonly #controls: OrbitControls;
  #extent: Extent;
  #preset: Preset = "overview";
  /** Whether a reader has moved the camera since a view was chosen. */
  #moved = false;
  #from: Stand | null = null;
  #to: Stand | null = null;
  #start_s: number | null = null;
  /** Whether the camera stands still whatever happens. */
  #held = false;
  /** Fits the camera to a size and room that came while it was held. */
  #owed: (() => void) | null = null;
  #placing = false;
  #room: Room = { top: 0, bottom: 1 };
  /** Whether a place is looked at that is none of the view's. */
  #looking = false;
  readonly #tip = new Vector3();
  readonly #step = new Vector3();

  constructor(camera: PerspectiveCamera, controls: OrbitControls, extent: Extent) {
    this.#camera = camera;
    this.#controls = controls;
    this.#extent = extent;
    controls.addEventListener("start", () => {
      this.#to = null;
      this.#moved = true;
    });
  }

  /** Whether it is here that the camera is moved right now, and no reader who moves it. */
  get placing(): boolean {
    return this.#placing;
  }

  /** Goes to a view, at once or in a flight. */
  go(preset: Preset, atOnce: boolean): void {
    this.#preset = preset;
    this.#moved = this.#looking = false;
    this.#fly(this.#standOf(preset), atOnce);
  }

  /**
   * The picture has another size or room, whose middle the camera looks at: shows all again, unless a reader has moved the camera.
   * While the camera is held, the room stays as it is.
   */
  resize(width: number, height: number, room: Room): void {
    this.#owed = this.#held ? () => this.resize(width, height, room) : null;
    if (this.#held) room = this.#room;
    this.#room = room;
    this.#camera.aspect = width / height;
    this.#camera.setViewOffset(width, height, 0, (height * (1 - room.top - room.bottom)) / 2, width, height);
    if (!this.#moved && !this.#held) this.go(this.#preset, true);
  }

  /** Keeps the camera where it is, as somebody drags something in the picture. */
  hold(on: boolean): void {
    this.#held = on;
    if (on) this.#to = null;
    else this.#owed?.();
  }

  /** There is something else to show. The camera moves only where it shows an overview, nobody has moved it, and not all is in it. */
  setExtent(extent: Extent, atOnce: boolean): void {
    const { radius } = this.#extent.sphere;
    this.#extent = extent;
    this.#clip();
    const alike = extent.sphere.radius < 1.4 * radius && extent.sphere.radius > radius / 1.4;
    if (this.#held || this.#moved || this.#preset !== "overview" || (alike && this.#holds(extent.points))) return;
    this.go(this.#preset, atOnce);
  }

  /** Whether places are in the picture that the camera takes, or will have taken when it arrives. */
  #holds(points: readonly Vector3[]): boolean {
    if (this.#to !== null) return false;
    this.#camera.updateMatrixWorld();
    return points.every((point) => {
      const { x, y } = this.#step.copy(point).project(this.#camera);
      const down = (1 - y) / 2;
      return Math.abs(x) <= 1 && down >= this.#room.top && down <= this.#room.bottom;
    });
  }

  /** Turns to a place and comes near; where it is on a face with that normal, from where the face is seen. */
  look(place: Vector3, normal: Vector3 | null, atOnce: boolean): void {
    const back = this.#camera.position.clone().sub(this.#controls.target).normalize();
    if (normal !== null && back.dot(normal) < FACING) back.multiplyScalar(ASIDE).add(normal).normalize();
    this.#looking = true;
    const near = Math.tan((DIRECTIONS.overview.fov_deg * Math.PI) / 360) / Math.tan((this.#camera.fov * Math.PI) / 360);
    this.#moved = true;
    this.#fly({ target: place.clone(), eye: place.clone().addScaledVector(back, 0.9 * near), fov_deg: this.#camera.fov }, atOnce);
  }

  /** Follows the tip again, where that is the view and something else was looked at. */
  lookAway(atOnce: boolean): void {
    if (this.#looking && this.#preset === "follow") this.go("follow", atOnce);
    this.#looking = false;
  }

  #standOf(preset: Preset): Stand {
    const { from, fov_deg } = DIRECTIONS[preset];
    const direction = new Vector3(...from);
    if (preset === "overview") direction.applyAxisAngle(UP, this.#extent.facing);
    if (preset !== "follow") {
      return standFor(this.#extent.points, direction, fov_deg, this.#camera.aspect, this.#room.bottom - this.#room.top);
    }
    const narrow = Math.max(1, 1 / this.#camera.aspect);
    return { target: this.#tip.clone(), eye: this.#tip.clone().addScaledVector(direction.normalize(), FOLLOW_M * narrow), fov_deg };
  }

  #fly(to: Stand, atOnce: boolean): void {
    if (atOnce) {
      this.#to = null;
      this.#place(to);
      return;
    }
    this.#from = { target: this.#controls.target.clone(), eye: this.#camera.position.clone(), fov_deg: this.#camera.fov };
    this.#to = to;
    this.#start_s = null;
  }

  #place(stand: Stand): void {
    this.#controls.target.copy(stand.target);
    this.#camera.position.copy(stand.eye);
    this.#camera.fov = stand.fov_deg;
    this.#clip();
    this.#placing = true;
    this.#controls.update();
    this.#placing = false;
  }

  /** Near and far planes about the content. No allocation. */
  #clip(): void {
    const { center, radius } = this.#extent.sphere;
    const distance = this.#camera.position.distanceTo(center);
    this.#camera.near = Math.max(0.01, 0.5 * (distance - radius - 1));
    this.#camera.far = distance + 8 * radius + 10;
    this.#camera.updateProjectionMatrix();
  }

  /** The tip has moved, and the camera with it where it follows. No allocation. */
  follow(tip: Vector3): void {
    this.#step.copy(tip).sub(this.#tip);
    this.#tip.copy(tip);
    if (this.#held || this.#looking || this.#preset !== "follow" || this.#step.lengthSq() < 1e-16) return;
    this.#camera.position.add(this.#step);
    this.#controls.target.add(this.#step);
    this.#from?.eye.add(this.#step);
    this.#from?.target.add(this.#step);
    this.#to?.eye.add(this.#step);
    this.#to?.target.add(this.#step);
  }

  /** Moves the camera on by the time `now` [s]; whether it has moved. */
  advance(now_s: number): boolean {
    if (this.#held) return false;
    if (this.#to === null || this.#from === null) {
      const moved = this.#controls.update();
      if (moved) this.#clip();
      return moved;
    }
    this.#start_s ??= now_s;
    const share = Math.max(0, Math.min(1, (now_s - this.#start_s) / FLIGHT_S));
    this.#between(this.#from, this.#to, ease(share));
    if (share >= 1) this.#to = null;
    return true;
  }

  /** A stand between two: what is looked at keeps its size in the picture, so the angle of view and the distance change together. */
  #between(a: Stand, b: Stand, share: number): void {
    const size = (stand: Stand): number => stand.eye.distanceTo(stand.target) * Math.tan((stand.fov_deg * Math.PI) / 360);
    const height = size(a) * (size(b) / size(a)) ** share;
    const fov_deg = a.fov_deg + (b.fov_deg - a.fov_deg) * share;
    const target = a.target.clone().lerp(b.target, share);
    const towards = a.eye.clone().sub(a.target).normalize().lerp(b.eye.clone().sub(b.target).normalize(), share);
    if (towards.lengthSq() < 1e-6) towards.set(0, -0.1, 1);
    const distance = height / Math.tan((fov_deg * Math.PI) / 360);
    this.#place({ target, eye: target.clone().addScaledVector(towards.normalize(), distance), fov_deg });
  }
}
