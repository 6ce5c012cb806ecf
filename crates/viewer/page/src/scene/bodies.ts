/** Shapes of the document as triangles, edges rounded where that costs nothing. */
import { BoxGeometry, BufferAttribute, BufferGeometry, LatheGeometry, PlaneGeometry, SphereGeometry, Vector2, Vector3 } from "three";
import { ConvexGeometry } from "three/examples/jsm/geometries/ConvexGeometry.js";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { floats } from "../numbers.ts";
import type { Shape } from "../view.ts";
import { indexed } from "./indexed.ts";
import { segmentsOfQuarter, segmentsRound } from "./round.ts";

/** Segments round a circle, at most. */
const ROUND = 48;
/** Edge radius of rounded bodies, at most [m]. */
const EDGE_M = 0.004;
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

function mesh(triangles: Float64Array): BufferGeometry {
  const geometry = new BufferGeometry();
  const corners = Float32Array.from(triangles.subarray(0, triangles.length - (triangles.length % 9)));
  for (let i = 0; i < corners.length; i++) if (!Number.isFinite(corners[i])) corners[i] = 0;
  geometry.setAttribute("position", new BufferAttribute(corners, 3));
  geometry.computeVertexNormals();
  return corners.length / 9 <= CREASED ? toCreasedNormals(geometry, Math.PI / 6) : geometry;
}

/** Whether edges are as the shape has them or rounded to look well. */
export type Edges = "exact" | "rounded";

/** The triangles of a shape, in its own frame [m], with an index. */
export function geometryOf(shape: Shape, edges: Edges): BufferGeometry {
  const geometry = trianglesOf(shape, edges);
  // Nothing has a picture on it: without this, corners that look alike would differ.
  geometry.deleteAttribute("uv");
  return indexed(geometry);
}

function trianglesOf(shape: Shape, edges: Edges): BufferGeometry {
  const round = edges === "rounded";
  // Where edges are drawn as lines, sides of few segments would have such.
  const segments = (radius: number): number => (round ? segmentsRound(radius, ROUND) : ROUND);
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
  if ("hull" in shape) return hull(shape.hull.points);
  if ("mesh" in shape) return mesh(floats(shape.mesh.triangles));
  return new PlaneGeometry(2 * HALF_SPACE_M, 2 * HALF_SPACE_M);
}
