/** The IRB 120 and a straight tool, for tests. */
import { matrixOf } from "../src/motion.ts";
import type { Arm, Pose, Tool } from "../src/view.ts";

const H = Math.SQRT1_2;

export function pose(position_m: [number, number, number], quaternion_wxyz: [number, number, number, number] = [1, 0, 0, 0]): Pose {
  return { position_m, quaternion_wxyz };
}

/** z turned to y, and back; z turned to x, and back. */
const TO_Y: [number, number, number, number] = [H, -H, 0, 0];
const FROM_Y: [number, number, number, number] = [H, H, 0, 0];
const TO_X: [number, number, number, number] = [H, 0, H, 0];
const FROM_X: [number, number, number, number] = [H, 0, -H, 0];

function after(first: Pose, second: Pose): Pose {
  const product = matrixOf(first).multiply(matrixOf(second)).elements;
  const [w1, x1, y1, z1] = first.quaternion_wxyz;
  const [w2, x2, y2, z2] = second.quaternion_wxyz;
  return pose(
    [product[12]!, product[13]!, product[14]!],
    [
      w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2,
      w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
      w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
      w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2,
    ],
  );
}

/** The IRB 120: origins of its URDF, each joint's axis turned to z. */
export function irb120(mount: Pose): Arm {
  const axes: { at: [number, number, number]; to: typeof TO_Y; from: typeof TO_Y }[] = [
    { at: [0, 0, 0], to: [1, 0, 0, 0], from: [1, 0, 0, 0] },
    { at: [0, 0, 0.29], to: TO_Y, from: FROM_Y },
    { at: [0, 0, 0.27], to: TO_Y, from: FROM_Y },
    { at: [0, 0, 0.07], to: TO_X, from: FROM_X },
    { at: [0.302, 0, 0], to: TO_Y, from: FROM_Y },
    { at: [0.072, 0, 0], to: TO_X, from: FROM_X },
  ];
  const joints = axes.map(({ at, to }, i) => {
    const origin = after(pose([0, 0, 0], i === 0 ? [1, 0, 0, 0] : axes[i - 1]!.from), after(pose(at), pose([0, 0, 0], to)));
    return { name: `joint_${i + 1}`, origin, position_rad: [-7, 7] as [number, number], speed_rad_s: 4, acceleration_rad_s2: null };
  });
  const flange = after(pose([0, 0, 0], FROM_X), pose([0, 0, 0], [H, 0, H, 0]));
  return { name: "irb120", mount, joints, links: [], flange };
}

/** A sponge at 0.15 m. */
export const TOOL: Tool = {
  bodies: [],
  sponge: { radius_m: 0.025, height_m: 0.025, compression_m: 0.005, pose: pose([0, 0, 0.1375]) },
  tip: pose([0, 0, 0.15]),
  mass: null,
};
