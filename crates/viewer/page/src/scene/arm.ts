/** The arm in the scene graph: one group for each joint frame, one mesh for each link, and the axes of a frame. */
import { BufferGeometry, Color, ConeGeometry, CylinderGeometry, GreaterDepth, Group, Matrix4, Mesh, MeshBasicMaterial, RingGeometry } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { matrixOf } from "../motion.ts";
import type { Arm, Body, Link } from "../view.ts";
import { fix } from "./graph.ts";
import type { Palette } from "./palette.ts";
import { colouredBy, geometryOf } from "./shapes.ts";
import type { Studio } from "./stage.ts";

/** [m] */
const AXIS_M = 0.05;
const THICKNESS_M = 0.0011;
const AXES = ["#e0402f", "#2e9d46", "#2f6fe0"] as const;

/** One axis along y, then turned where it belongs. */
function arrow(index: number): BufferGeometry {
  const shaft = new CylinderGeometry(THICKNESS_M, THICKNESS_M, 0.82 * AXIS_M, 12).translate(0, 0.41 * AXIS_M, 0);
  const head = new ConeGeometry(2.8 * THICKNESS_M, 0.18 * AXIS_M, 16).translate(0, 0.91 * AXIS_M, 0);
  const geometry = mergeGeometries([shaft, head]);
  if (index === 0) geometry.rotateZ(-Math.PI / 2);
  if (index === 2) geometry.rotateX(Math.PI / 2);
  return colouredBy(new Color(AXES[index]), geometry);
}

export class FrameAxes {
  readonly root = new Group();

  constructor() {
    const geometry = mergeGeometries([arrow(0), arrow(1), arrow(2)]);
    const near = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, toneMapped: false }));
    const hidden = new Mesh(
      geometry,
      new MeshBasicMaterial({ vertexColors: true, toneMapped: false, transparent: true, opacity: 0.4, depthFunc: GreaterDepth, depthWrite: false }),
    );
    near.renderOrder = 5;
    hidden.renderOrder = 4;
    this.root.add(near, hidden);
  }
}

/** Where the tip should be: a ring about the commanded place. */
export class CommandedTip {
  readonly root = new Group();
  readonly #material = new MeshBasicMaterial({ toneMapped: false, transparent: true, opacity: 0.85, side: 2, depthTest: false });

  constructor(radius_m: number) {
    const ring = new Mesh(new RingGeometry(radius_m * 1.12, radius_m * 1.12 + 0.0022, 64), this.#material);
    ring.renderOrder = 5;
    this.root.matrixAutoUpdate = false;
    this.root.add(ring);
    this.root.visible = false;
  }

  setPalette(palette: Palette): void {
    this.#material.color.set(palette.commanded);
  }
}

/** Where the document states no colour: graphite white. */
const PLAIN: [number, number, number, number] = [0.773, 0.78, 0.769, 1];

/** A body's triangles in its parent's frame, coloured by vertex. */
function painted(body: Body): BufferGeometry {
  const geometry = geometryOf(body.shape, "rounded");
  for (const name of Object.keys(geometry.attributes)) {
    if (name !== "position" && name !== "normal") geometry.deleteAttribute(name);
  }
  geometry.applyMatrix4(matrixOf(body.pose));
  const [r, g, b] = body.rgba ?? PLAIN;
  return colouredBy(new Color().setRGB(r, g, b, "srgb"), geometry);
}

/** One mesh of bodies that share their opacity. */
function meshOf(bodies: readonly Body[], opacity: number, studio: Studio): Mesh | null {
  const parts = bodies.map(painted).filter((part) => (part.getAttribute("position")?.count ?? 0) > 0);
  if (parts.length === 0) return null;
  const merged = mergeGeometries(parts);
  for (const part of parts) part.dispose();
  const translucent = opacity < 1;
  const material = studio.material({
    vertexColors: true,
    roughness: 0.42,
    metalness: 0,
    opacity,
    transparent: translucent,
    depthWrite: !translucent,
  });
  const mesh = new Mesh(merged, material);
  mesh.castShadow = !translucent;
  mesh.receiveShadow = true;
  return mesh;
}

/** Bodies as few meshes, one an opacity. */
export function meshesOf(bodies: readonly Body[], studio: Studio): Mesh[] {
  const opacities = new Map<number, Body[]>();
  for (const body of bodies) {
    const opacity = Math.max(0, Math.min(1, body.rgba?.[3] ?? 1));
    opacities.set(opacity, [...(opacities.get(opacity) ?? []), body]);
  }
  return [...opacities].map(([opacity, group]) => meshOf(group, opacity, studio)).filter((mesh) => mesh !== null);
}

/** The arm's frames, moved by joint positions. */
export class ArmGraph {
  /** At `T_world_base`. */
  readonly root = new Group();
  /** At `T_base_flange` for the joints that are set. */
  readonly flange = new Group();
  /** What the arm looks like; to be hidden as a whole. */
  readonly visuals: Group[] = [];
  /** The base's frame, then the frame behind each joint. */
  readonly frames: Group[] = [];
  readonly #origins: Matrix4[];
  readonly #turn = new Matrix4();

  constructor(arm: Arm, studio: Studio) {
    fix(this.root, arm.mount);
    this.frames.push(this.root);
    this.#origins = arm.joints.map((joint) => matrixOf(joint.origin));
    for (const origin of this.#origins) {
      const frame = new Group();
      frame.matrixAutoUpdate = false;
      frame.matrix.copy(origin);
      this.frames[this.frames.length - 1]!.add(frame);
      this.frames.push(frame);
    }
    this.frames[this.frames.length - 1]!.add(fix(this.flange, arm.flange));
    for (const link of arm.links) this.#dress(link, link.visuals.length > 0 ? link.visuals : link.collision, studio);
  }

  #dress(link: Link, bodies: readonly Body[], studio: Studio): void {
    const meshes = meshesOf(bodies, studio);
    if (meshes.length === 0) return;
    const group = fix(new Group(), link.pose);
    group.add(...meshes);
    this.frameOf(link)?.add(group);
    this.visuals.push(group);
  }

  /** The frame to which a link is fixed. */
  frameOf(link: Link): Group | undefined {
    return this.frames[link.joints];
  }

  /** Moves the joints [rad]. No allocation. */
  set(q: ArrayLike<number>): void {
    for (let i = 0; i < this.#origins.length; i++) {
      const angle = q[i] ?? 0;
      const frame = this.frames[i + 1]!;
      frame.matrix.multiplyMatrices(this.#origins[i]!, this.#turn.makeRotationZ(Number.isFinite(angle) ? angle : 0));
      frame.matrixWorldNeedsUpdate = true;
    }
  }
}
