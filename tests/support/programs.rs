//! Programs to be written: a job of the UR5, and points that need not be a plan's.

use platewash_export::Joint3;
use platewash_export::program::{Point, Program, ProgramFile};
use platewash_fixtures::{kitchen_plates, kitchen_terms};
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::{Knots, Plan, PlanParts, Provenance};
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use proptest::prelude::*;

pub const UR5: &str = include_str!("../../crates/kinematics/tests/fixtures/ur5_lengths.urdf");

pub fn ur5() -> RobotModel {
    RobotModel::from_urdf(UR5, &MeshSource::none()).unwrap()
}

/// A plan with two segments, and nothing that moves: what a dialect takes of it besides the points.
pub fn plan(arm: &RobotModel) -> Plan {
    let segment = |kind, plate, t_start_s, t_end_s| PlanSegment {
        kind,
        plate,
        t_start_s,
        t_end_s,
    };
    let parts = PlanParts {
        provenance: Provenance::new("two segments"),
        order: vec![2],
        wash_paths: Vec::new(),
        segments: vec![
            segment(SegmentKind::Depart, 2, 0.0, 0.1),
            segment(SegmentKind::Wash, 2, 0.1, 0.2),
        ],
        knots: Knots {
            t_s: vec![0.0, 0.2],
            q_rad: vec![JointVector::zeros(); 2],
            qd_rad_s: vec![JointVector::zeros(); 2],
        },
    };
    Plan::sealed(kitchen_terms(arm, kitchen_plates()), parts).unwrap()
}

/// A program of these points.
pub fn program<'a>(plan: &'a Plan, arm: &'a RobotModel, points: Vec<Point>, speed_share: f64) -> Program<'a> {
    Program {
        name: "small".to_owned(),
        plan,
        arm,
        points,
        speed_share,
        joint_3: Joint3::Independent,
        corner_m: 0.005,
        header: vec!["PROVED: two segments".to_owned(), "within 0.5° # of \"it\"".to_owned()],
    }
}

/// Points a few milliseconds apart, some of which are rests, from 0.
pub fn points() -> impl Strategy<Value = (Vec<Point>, f64)> {
    let joints = || proptest::array::uniform6(-6.2..6.2_f64);
    let point = (
        1e-4..0.008_f64,
        joints(),
        proptest::array::uniform6(-3.0..3.0_f64),
        any::<bool>(),
    );
    (proptest::collection::vec(point, 2..40), 0.3..=1.0_f64).prop_map(|(steps, share)| {
        let mut t_s = 0.0;
        let count = steps.len();
        let points = steps.into_iter().enumerate().map(|(k, (step_s, q, qd, rests))| {
            t_s += if k == 0 { 0.0 } else { step_s * share };
            let rests = rests || k == 0 || k + 1 == count;
            Point {
                t_s,
                q_rad: JointVector::from(q),
                qd_rad_s: if rests {
                    JointVector::zeros()
                } else {
                    JointVector::from(qd)
                },
                rests,
                segment: usize::from(2 * k > count),
            }
        });
        (points.collect(), share)
    })
}

/// A file.
pub fn file(name: &str, text: &str) -> ProgramFile {
    let (name, text) = (name.to_owned(), text.to_owned());
    ProgramFile { name, text }
}

/// The text with one line changed; `from` must stand in it.
pub fn edited(text: &str, line: usize, from: &str, to: &str) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let changed = lines[line - 1].replacen(from, to, 1);
    assert_ne!(changed, lines[line - 1], "line {line} has no {from:?}");
    lines[line - 1] = changed;
    lines.join("\n") + "\n"
}

/// Texts that are near a good one: bytes, lines and stretches of it replaced, doubled, left out.
pub fn damaged(good: &'static str) -> impl Strategy<Value = String> {
    let pieces = prop_oneof![
        "\\PC{0,6}",
        Just("[".repeat(3000)),
        Just("(".repeat(300)),
        Just("-".repeat(900)),
        Just("1e999".to_owned()),
        Just("NaN".to_owned()),
        Just("\r\n".to_owned()),
        Just("end\n".to_owned()),
        Just("def x():\n".repeat(40)),
        Just("if True:\n".repeat(40)),
        Just("\0".to_owned()),
    ];
    proptest::collection::vec((0..good.len(), 0..60_usize, pieces), 1..5).prop_map(move |edits| {
        let mut text = good.to_owned();
        for (at, length, piece) in edits {
            let boundary = |k: usize| {
                (0..=k.min(text.len()))
                    .rev()
                    .find(|&k| text.is_char_boundary(k))
                    .unwrap_or(0)
            };
            let (from, to) = (boundary(at), boundary(at + length));
            text.replace_range(from..to, &piece);
        }
        text
    })
}
