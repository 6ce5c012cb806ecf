/** A plate as triangles: turned from its meridian, with an attribute that tells the face from the rest. */
import { BufferGeometry, Float32BufferAttribute, LatheGeometry, Vector2 } from "three";
import type { Plate } from "../view.ts";
import { indexed } from "./indexed.ts";
import { segmentsRound } from "./round.ts";

/** Radius of the edge between face and side [m], at most. */
const EDGE_M = 0.002;

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
  const edge = level ? Math.min(EDGE_M, thickness / 4, (rim - before) / 2) : 0;
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

/** The triangles of a plate in its own frame, `most` of them round it. */
export function plateGeometry(plate: Plate, most: number): BufferGeometry {
  const { points, face } = outlineOf(plate);
  if (points.length === 0) return new BufferGeometry();
  const geometry = new LatheGeometry(points, segmentsRound(Math.max(...points.map(({ x }) => x)), most)).rotateX(Math.PI / 2);
  geometry.deleteAttribute("uv");
  const count = geometry.getAttribute("position").count;
  const flags = Float32Array.from({ length: count }, (_, i) => (i % points.length >= face ? 1 : 0));
  geometry.setAttribute("face", new Float32BufferAttribute(flags, 1));
  return indexed(geometry);
}
