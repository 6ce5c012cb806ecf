/** Shapes of the document as triangles: bodies with edges rounded where that costs nothing, and plates, turned from their meridians. */
import { BoxGeometry, BufferAttribute, BufferGeometry, Float32BufferAttribute, LatheGeometry, PlaneGeometry, SphereGeometry, Vector2, Vector3, type Color } from "three";
import { ConvexGeometry } from "three/examples/jsm/geometries/ConvexGeometry.js";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { mergeGeometries, mergeVertices, toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { floats } from "../numbers.ts";
import type { Plate, Relief, Shape } from "../view.ts";

/** How far a chord may be off its arc: no farther than anybody sees [m]. */
const OFF_M = 0.00012;
const FEWEST = 16;

/** A geometry whose corners all have a colour. */
export function colouredBy(colour: Color, geometry: BufferGeometry): BufferGeometry {
  const colours = Array.from({ length: geometry.getAttribute("position")?.count ?? 0 }, () => colour.toArray());
  return geometry.setAttribute("color", new Float32BufferAttribute(colours.flat(), 3));
}

/** Segments round a circle: a multiple of four, so that it is as wide as it should be. */
export function segmentsRound(radius_m: number, most: number): number {
  if (!(radius_m > OFF_M)) return FEWEST;
  const enough = Math.PI / Math.acos(1 - OFF_M / radius_m);
  return Math.max(FEWEST, Math.min(most, 4 * Math.ceil(enough / 4)));
}

/** Segments of a quarter of a circle. */
export function segmentsOfQuarter(radius_m: number, most: number): number {
  if (!(radius_m > OFF_M)) return 1;
  return Math.max(1, Math.min(most, Math.ceil(Math.PI / 4 / Math.acos(1 - OFF_M / radius_m))));
}

/** Segments round a circle, at most. */
const ROUND = 48;
/** Edge radius of rounded bodies, and between a plate's face and its side, at most [m]. */
const EDGE_M = 0.004;
const RIM_M = 0.002;
/** Corners nearer to each other than this are one [m]. */
const SAME_M = 1e-6;
/** Meshes up to so many triangles get their edges kept sharp and the rest smooth. */
const CREASED = 40_000;
/** How far a half space is drawn [m]. */
const HALF_SPACE_M = 1.5;

/** A length that can be drawn. */
function length(value: number): number {
  return Number.isFinite(value) ? Math.max(1e-5, Math.min(1e3, value)) : 1e-5;
}

function edgeOf(...halves: number[]): number {
  return Math.min(EDGE_M, 0.25 * Math.min(...halves));
}

/** An outline (distance from the axis, height), from below upwards, turned about z in so many segments. */
function turned(outline: Vector2[], segments: number): BufferGeometry {
  return new LatheGeometry(outline, segments).rotateX(Math.PI / 2);
}

/** A quarter of a circle about (x, z), `from` 0 for the lower one that ends at the side, 1 for the upper one. */
function corner(x: number, z: number, radius: number, from: 0 | 1): Vector2[] {
  const steps = segmentsOfQuarter(radius, 4);
  return Array.from({ length: steps + 1 }, (_, i) => {
    const angle = ((i / steps + from - 1) * Math.PI) / 2;
    return new Vector2(x + radius * Math.cos(angle), z + radius * Math.sin(angle));
  });
}

function cylinder(radius: number, half: number, edge: number, segments: number): BufferGeometry {
  return turned([
    new Vector2(0, -half),
    new Vector2(radius - edge, -half),
    ...corner(radius - edge, -half + edge, edge, 0),
    ...corner(radius - edge, half - edge, edge, 1),
    new Vector2(radius - edge, half),
    new Vector2(0, half),
  ], segments);
}

function capsule(radius: number, half: number, segments: number): BufferGeometry {
  const quarter = Math.max(3, segments / 4);
  const arc = (centre: number, from: number): Vector2[] =>
    Array.from({ length: quarter + 1 }, (_, i) => {
      const angle = from + (i / quarter) * (Math.PI / 2);
      return new Vector2(Math.max(0, radius * Math.cos(angle)), centre + radius * Math.sin(angle));
    });
  return turned([...arc(-half, -Math.PI / 2), ...arc(half, 0)], segments);
}

function hull(points: [number, number, number][]): BufferGeometry {
  const finite = points.filter((point) => point.every(Number.isFinite)).map((point) => new Vector3(...point));
  if (finite.length < 4) return new BufferGeometry();
  try {
    return new ConvexGeometry(finite);
  } catch {
    return new BufferGeometry();
  }
}

/** Those that have triangles, as one. */
function merged(hulls: BufferGeometry[]): BufferGeometry {
  const solid = hulls.filter((one) => one.hasAttribute("position"));
  return solid.length === 0 ? new BufferGeometry() : mergeGeometries(solid);
}

function mesh(triangles: Float64Array): BufferGeometry {
  const geometry = new BufferGeometry();
  const corners = Float32Array.from(triangles.subarray(0, triangles.length - (triangles.length % 9)));
  for (let i = 0; i < corners.length; i++) if (!Number.isFinite(corners[i])) corners[i] = 0;
  geometry.setAttribute("position", new BufferAttribute(corners, 3));
  geometry.computeVertexNormals();
  return corners.length / 9 <= CREASED ? toCreasedNormals(geometry, Math.PI / 6) : geometry;
}

/** Whether edges are as the shape has them, or rounded to look well; or the shape with few triangles, to be drawn many times. */
export type Edges = "exact" | "rounded" | "coarse";

/** The triangles of a shape, in its own frame [m], with an index. */
export function geometryOf(shape: Shape, edges: Edges): BufferGeometry {
  const geometry = trianglesOf(shape, edges);
  // Nothing has a picture on it: without this, corners that look alike would differ.
  geometry.deleteAttribute("uv");
  return geometry.index !== null || !geometry.hasAttribute("position") ? geometry : mergeVertices(geometry, SAME_M);
}

function trianglesOf(shape: Shape, edges: Edges): BufferGeometry {
  if (shape === "half_space") return new PlaneGeometry(2 * HALF_SPACE_M, 2 * HALF_SPACE_M);
  if ("convex" in shape) return trianglesOf(shape.convex, edges);
  if ("parts" in shape) return merged(shape.parts.map(hull));
  if ("mesh" in shape) return mesh(floats(shape.mesh.triangles));
  const round = edges === "rounded";
  // Where edges are drawn as lines, sides of few segments would have such.
  const segments = (radius: number): number => (round ? segmentsRound(radius, ROUND) : edges === "coarse" ? FEWEST : ROUND);
  if ("box" in shape) {
    const [x, y, z] = shape.box.half_m.map(length) as [number, number, number];
    const edge = edgeOf(x, y, z);
    return round ? new RoundedBoxGeometry(2 * x, 2 * y, 2 * z, 2, edge) : new BoxGeometry(2 * x, 2 * y, 2 * z);
  }
  if ("cylinder" in shape) {
    const radius = length(shape.cylinder.radius_m);
    const half = length(shape.cylinder.half_length_m);
    return cylinder(radius, half, round ? edgeOf(radius, half) : 1e-6, segments(radius));
  }
  if ("sphere" in shape) {
    const radius = length(shape.sphere.radius_m);
    return new SphereGeometry(radius, segments(radius), segments(radius) / 2).rotateX(Math.PI / 2);
  }
  if ("capsule" in shape) {
    const radius = length(shape.capsule.radius_m);
    return capsule(radius, length(shape.capsule.half_length_m), segments(radius));
  }
  return hull(shape.hull.points);
}

/** The underside from the middle out, as the face is shifted by the thickness, with the foot below it. */
function underOf(plate: Plate, meridian: readonly [number, number][], thickness: number): Vector2[] {
  const under = meridian.map(([r, z]) => new Vector2(r, z - thickness));
  const { radius_m: radius = Number.NaN, height_m: height = Number.NaN } = plate.foot ?? {};
  if (!(radius > 0) || !(height > 0) || !Number.isFinite(radius + height)) return under;
  const bottom = under[0]!.y - height;
  const outside = under.findIndex(({ x }) => x > radius);
  const [low, high] = [under[outside - 1], under[outside]];
  // Where the side of the foot meets the body.
  const meets = low === undefined || high === undefined ? bottom : low.y + ((high.y - low.y) * (radius - low.x)) / (high.x - low.x);
  const rest = outside < 0 ? [] : under.slice(outside);
  return [new Vector2(0, bottom), new Vector2(radius, bottom), new Vector2(radius, Math.max(bottom, meets)), ...rest];
}

/** The outline of a plate from the middle of its underside to the pole, and from which point on it is the face. */
function outlineOf(plate: Plate): { points: Vector2[]; face: number } {
  const meridian = plate.meridian_m.filter(([r, z]) => Number.isFinite(r) && Number.isFinite(z) && r >= 0);
  if (meridian.length < 2) return { points: [], face: 0 };
  const thickness = Math.max(1e-4, Number.isFinite(plate.thickness_m) ? plate.thickness_m : 0);
  const [rim, rimHeight] = meridian[meridian.length - 1]!;
  const [before, beforeHeight] = meridian[meridian.length - 2]!;
  const level = Math.abs(rimHeight - beforeHeight) < 0.3 * (rim - before);
  const edge = level ? Math.min(RIM_M, thickness / 4, (rim - before) / 2) : 0;
  const under = underOf(plate, meridian, thickness);
  const side = new Vector2(rim, rimHeight - thickness);
  const turn = [0, 0.25, 0.5, 0.75, 1].map((share) => {
    const angle = (share * Math.PI) / 2;
    return new Vector2(rim - edge + edge * Math.cos(angle), rimHeight - edge + edge * Math.sin(angle));
  });
  const points = [...under, side, ...turn];
  const face = points.length;
  points.push(new Vector2(rim - edge, rimHeight));
  for (let k = meridian.length - 2; k >= 0; k--) points.push(new Vector2(...meridian[k]!));
  return { points, face };
}

/** A step of the heights of a relief [m]. */
const RELIEF_STEP_M = 1e-5;

/** The triangles of a plate as it was measured: both sides on a polar grid, and the edge between them. */
function reliefGeometry(plate: Plate, relief: Relief): BufferGeometry {
  const count = relief.azimuths;
  const edge: [number, number] = plate.meridian_m[plate.meridian_m.length - 1] ?? [0, 0];
  const points: number[] = [];
  const flags: number[] = [];
  /** From the middle out, the edge at a height over that of the face there. */
  const side = (heights: readonly number[], edgeOver: number, face: number): void => {
    const radii = [0, ...relief.radii_m, edge[0]];
    radii.forEach((radius, ring) => {
      for (let k = 0; k < count; k++) {
        const angle = (2 * Math.PI * k) / count;
        const at = Math.min(Math.max(ring - 1, 0), relief.radii_m.length - 1) * count + k;
        const z = ring === radii.length - 1 ? edge[1] + edgeOver : RELIEF_STEP_M * heights[at]!;
        points.push(radius * Math.cos(angle), radius * Math.sin(angle), z);
        flags.push(face);
      }
    });
  };
  const under = relief.lower.length === relief.upper.length ? relief.lower : relief.upper.map((height) => height - plate.thickness_m / RELIEF_STEP_M);
  const last = (relief.radii_m.length - 1) * count;
  side(relief.upper, 0, 1);
  side(under, RELIEF_STEP_M * (under[last]! - relief.upper[last]!), 0);
  const rings = relief.radii_m.length + 2;
  const index: number[] = [];
  const quad = (a: number, b: number, out: boolean): void => {
    for (let k = 0; k < count; k++) {
      const next = (k + 1) % count;
      const [p, q, r, s] = [a + k, b + k, b + next, a + next];
      index.push(...(out ? [p, q, r, p, r, s] : [p, r, q, p, s, r]));
    }
  };
  for (let ring = 0; ring + 1 < rings; ring++) {
    quad(ring * count, (ring + 1) * count, true);
    quad((rings + ring) * count, (rings + ring + 1) * count, false);
  }
  quad((rings - 1) * count, (2 * rings - 1) * count, true);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  geometry.setAttribute("face", new Float32BufferAttribute(flags, 1));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}

/** The triangles of a plate in its own frame, `most` of them round it. */
export function plateGeometry(plate: Plate, most: number): BufferGeometry {
  if (plate.relief !== undefined && plate.relief.radii_m.length > 0) return reliefGeometry(plate, plate.relief);
  const { points, face } = outlineOf(plate);
  if (points.length === 0) return new BufferGeometry();
  const geometry = new LatheGeometry(points, segmentsRound(Math.max(...points.map(({ x }) => x)), most)).rotateX(Math.PI / 2);
  geometry.deleteAttribute("uv");
  const count = geometry.getAttribute("position").count;
  const flags = Float32Array.from({ length: count }, (_, i) => (i % points.length >= face ? 1 : 0));
  geometry.setAttribute("face", new Float32BufferAttribute(flags, 1));
  return geometry;
}
