//! What the tests of programs share.

use platewash_export::Joint3;
use platewash_export::dialect::{Dialect, ReadError};
use platewash_export::dialects::by_name;
use platewash_export::program::{Point, Program, ProgramFile};
use platewash_export::reading::Reading;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::Plan;
use std::sync::OnceLock;

/// The kitchen's plan, and its arm.
pub fn kitchen() -> &'static (Plan, RobotModel) {
    static KITCHEN: OnceLock<(Plan, RobotModel)> = OnceLock::new();
    KITCHEN.get_or_init(|| {
        let job = platewash_fixtures::kitchen();
        let planned = platewash_planner::plan(&job).unwrap();
        let certified = platewash_certificate::certify(planned.plan, job.arm()).unwrap();
        let arm = RobotModel::irb120().unwrap();
        (certified.into_parts().0, arm)
    })
}

/// RAPID.
pub fn rapid() -> &'static dyn Dialect {
    by_name("rapid").unwrap()
}

/// Every so manieth knot of the kitchen's plan, and all in which it rests.
pub fn every(step: usize) -> Vec<Point> {
    let plan = &kitchen().0;
    let knots = &plan.knots;
    let last = knots.t_s.len() - 1;
    let rests = |index: usize| knots.qd_rad_s[index] == JointVector::zeros();
    let chosen = (0..=last).filter(|index| index % step == 0 || *index == last || rests(*index));
    let points = chosen.map(|index| {
        let t_s = knots.t_s[index];
        let ends = |segment: &platewash_motion::trajectory::PlanSegment| t_s <= segment.t_end_s + 1e-9;
        let segment = plan.segments.iter().position(ends).unwrap_or(plan.segments.len() - 1);
        Point {
            t_s,
            q_rad: knots.q_rad[index],
            qd_rad_s: knots.qd_rad_s[index],
            rests: rests(index),
            segment,
        }
    });
    points.collect()
}

/// A program of those points.
pub fn program(points: Vec<Point>, speed_share: f64) -> Program<'static> {
    let (plan, arm) = kitchen();
    Program {
        name: "kitchen".to_owned(),
        plan,
        arm,
        points,
        speed_share,
        joint_3: Joint3::Independent,
        corner_m: 0.005,
        header: vec!["Verdict: certified. Joints at most 139.5°/s.".to_owned()],
    }
}

/// A module in a file.
pub fn file(text: &str) -> ProgramFile {
    ProgramFile {
        name: "program.mod".to_owned(),
        text: text.to_owned(),
    }
}

/// What a module does.
pub fn read(text: &str) -> Result<Reading, ReadError> {
    let arm = RobotModel::irb120().unwrap();
    rapid().read(&[file(text)], &arm)
}
