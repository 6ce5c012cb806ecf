//! Of the spiral points that an independent analytic check finds reachable, every one is solved.

use nalgebra::{Matrix3, Rotation3, Vector3};
use platewash::motion::trajectory::SegmentKind;
use platewash::paper::{PaperPart, ToolPath};
use platewash::workcell::tool::tool_down;
use platewash::{IkError, IkSolver, JointVector, RobotModel, ToolFrame};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn rx(a: f64) -> Matrix3<f64> {
    *Rotation3::from_axis_angle(&Vector3::x_axis(), a).matrix()
}
fn ry(a: f64) -> Matrix3<f64> {
    *Rotation3::from_axis_angle(&Vector3::y_axis(), a).matrix()
}
fn rz(a: f64) -> Matrix3<f64> {
    *Rotation3::from_axis_angle(&Vector3::z_axis(), a).matrix()
}

/// Limits of the IRB 120 in degrees, from its data sheet.
const LIMITS_DEG: [[f64; 2]; 6] = [
    [-165.0, 165.0],
    [-110.0, 110.0],
    [-110.0, 70.0],
    [-160.0, 160.0],
    [-120.0, 120.0],
    [-400.0, 400.0],
];

fn fits(joint: usize, angle: f64) -> bool {
    // The URDF states the limits with 5 decimals.
    let [low, high] = LIMITS_DEG[joint].map(|d| (d.to_radians() * 1e5).round() / 1e5);
    (-2..=2).any(|turn| (low..=high).contains(&(angle + TAU * f64::from(turn))))
}

/// Whether the IRB 120 can hold its flange at `p`, pointing straight down, by closed-form inverse kinematics over all
/// eight branches: shoulder at z = 0.290, links of 0.270 and √(0.302² + 0.070²), wrist to flange 0.072 m.
fn reachable(p: Vector3<f64>) -> bool {
    let (upper, fore) = (0.270, f64::hypot(0.302, 0.070));
    let bend = f64::atan2(0.070, 0.302);
    let wrist = p + Vector3::new(0.0, 0.0, 0.072);
    let target = ry(PI) * ry(-FRAC_PI_2); // link_6, whose x axis leaves the flange
    let shoulders = [f64::atan2(wrist.y, wrist.x), f64::atan2(-wrist.y, -wrist.x)];
    shoulders.into_iter().any(|q1| {
        let forward = rz(q1).transpose() * wrist;
        let (x, z) = (forward.x, forward.z - 0.290);
        let reach = f64::hypot(x, z);
        let cosine = (upper * upper + fore * fore - reach * reach) / (2.0 * upper * fore);
        if cosine.abs() > 1.0 {
            return false;
        }
        [1.0, -1.0].into_iter().any(|elbow| {
            // Angle between the links, opened one way or the other; angles are about +y, from +z (upper arm) and from
            // the forearm's straight line.
            let inner = elbow * cosine.acos();
            let offset = elbow
                * ((upper * upper + reach * reach - fore * fore) / (2.0 * upper * reach))
                    .clamp(-1.0, 1.0)
                    .acos();
            let q2 = f64::atan2(x, z) - offset;
            // At q3 = 0 the wrist is at (0.302, 0.070) from the elbow: 90° − bend from the upper arm's direction.
            let q3 = PI - inner - (FRAC_PI_2 - bend);
            if !(fits(0, q1) && fits(1, q2) && fits(2, q3)) {
                return false;
            }
            let check = rz(q1)
                * (Vector3::new(0.0, 0.0, 0.290)
                    + ry(q2) * (Vector3::new(0.0, 0.0, 0.270) + ry(q3) * Vector3::new(0.302, 0.0, 0.070)));
            assert!((check - wrist).norm() < 1e-12, "the closed form misses the wrist");
            let r = (rz(q1) * ry(q2) * ry(q3)).transpose() * target;
            let wrists = wrists(&r);
            let off = |[q4, q5, q6]: [f64; 3]| (rx(q4) * ry(q5) * rx(q6) - r).norm();
            assert!(
                wrists.into_iter().all(|w| off(w) < 1e-7),
                "the closed form misses the attitude"
            );
            wrists
                .into_iter()
                .any(|[q4, q5, q6]| fits(3, q4) && fits(4, q5) && fits(5, q6))
        })
    })
}

/// Both solutions of `Rx(q4) Ry(q5) Rx(q6) = R`.
fn wrists(r: &Matrix3<f64>) -> [[f64; 3]; 2] {
    let s5 = f64::hypot(r.m12, r.m13);
    let q5 = f64::atan2(s5, r.m11);
    if s5 < 1e-9 {
        let turn = f64::atan2(r.m32, r.m22);
        return [[0.0, q5, turn], [turn, q5, 0.0]];
    }
    let (q4, q6) = (f64::atan2(r.m21, -r.m31), f64::atan2(r.m12, r.m13));
    [[q4, q5, q6], [q4 + PI, -q5, q6 + PI]]
}

#[test]
fn every_reachable_spiral_point_of_a_thousand_layouts_is_solved() {
    let robot = RobotModel::irb120().unwrap();
    let settings = PaperPart::Appendix.settings();
    // The paper holds no tool.
    let tip = robot.tool_frame(ToolFrame::Tool0).unwrap();
    let solver = IkSolver::new(&robot, tip, settings.ik_settings()).unwrap();
    let (mut points, mut possible, mut solved, mut beyond) = (0, 0, 0, 0);
    for seed in 0..1000 {
        let layout = PaperPart::Appendix.draw(&robot, seed).unwrap();
        let path = ToolPath::new(&settings, &layout.plates);
        let mut q = JointVector::zeros();
        for target in path
            .segments
            .iter()
            .filter(|s| s.kind == SegmentKind::Wash)
            .flat_map(|s| &s.waypoints)
        {
            points += 1;
            let expected = reachable(*target);
            possible += usize::from(expected);
            match solver.solve(&tool_down(*target), &q) {
                Ok(answer) => {
                    assert!(answer.position_error_m <= 1e-6 && answer.orientation_error_rad <= 1e-6);
                    assert!(robot.limits().contain(&answer.q));
                    solved += usize::from(expected);
                    beyond += usize::from(!expected);
                    q = answer.q;
                }
                Err(IkError::NotSolved(failure)) => {
                    assert!(
                        !expected,
                        "seed {seed}: {target:?} is reachable but was not solved: {failure:?}"
                    );
                    q = failure.q;
                }
                Err(other) => panic!("{other}"),
            }
        }
    }
    println!("{points} points, {possible} reachable, {solved} of them solved, {beyond} solved that the check denies");
    assert_eq!(points, 1000 * 4 * 55);
    assert_eq!(solved, possible);
    // What the closed form denies may be solved only within the tolerance of 1e-6 at the edge of the reach.
    assert!(beyond <= 5, "{beyond}");
    assert!(
        possible > points * 98 / 100 && possible < points,
        "the layouts reach beyond the arm"
    );
}
