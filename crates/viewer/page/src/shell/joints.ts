/** Joint angles in words, for a page of one configuration. */
import { Matrix4 } from "three";
import { positionShare } from "../curves.ts";
import { degrees, fixed, millimetres, percent } from "../format.ts";
import { Kinematics } from "../kinematics.ts";
import type { View } from "../view.ts";
import { el, isolated } from "./dom.ts";

function jointRow(view: View, j: number): HTMLElement {
  const joint = view.arm.joints[j]!;
  const q = view.pose_rad[j] ?? Number.NaN;
  const share = positionShare(joint, q);
  const beyond = !(Math.abs(share) <= 1);
  const needle = el("span", { class: "range-needle" });
  needle.style.left = `${(50 + 50 * Math.max(-1, Math.min(1, share))).toFixed(2)}%`;
  return el(
    "tr",
    { class: beyond ? "bad" : "" },
    el("th", { set: { scope: "row" } }, isolated(joint.name)),
    el("td", {}, fixed(degrees(q), 3)),
    el("td", {}, fixed(q, 6)),
    el("td", { class: "range-cell" }, el("span", { class: "range", set: { "aria-hidden": "true" } }, needle), beyond ? "beyond its limit" : percent(share)),
  );
}

/** Joints, tip and clearance of the configuration. */
export function configuration(view: View): HTMLElement {
  const head = el("tr", {}, ...["joint", "deg", "rad", "of its range"].map((words) => el("th", { set: { scope: "col" } }, words)));
  const table = el(
    "table",
    { class: "joints" },
    el("thead", {}, head),
    el("tbody", {}, ...view.arm.joints.map((_, j) => jointRow(view, j))),
  );
  const tip = new Kinematics(view.arm, view.tool).tip(view.pose_rad, new Matrix4());
  const place = tip.elements.slice(12, 15).map((value) => fixed(value, 4)).join(", ");
  const list = el("dl", { class: "origin" }, el("dt", {}, view.tool === null ? "flange" : "tip"), el("dd", {}, `(${place}) m`));
  const clearance = view.clearance;
  if (clearance !== null) list.append(el("dt", {}, "margin"), el("dd", {}, millimetres(clearance.margin_m)));
  return el("div", {}, table, list);
}

