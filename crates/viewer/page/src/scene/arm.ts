/** The arm in the scene graph: a group a joint frame, one mesh a link. */
import { BufferGeometry, Color, Group, Matrix4, Mesh } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { matrixOf } from "../kinematics.ts";
import type { Arm, Body, Link } from "../view.ts";
import { fix } from "./graph.ts";
import { colouredBy, geometryOf } from "./shapes.ts";
import type { Studio } from "./studio.ts";

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
