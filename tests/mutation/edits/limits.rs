//! Limits: stated alone, asked alone, and both.

use crate::edit::{Edits, Expected, Kind};
use crate::good::good;
use platewash::Plan;
use platewash::planner::certificate::PromiseName::{
    self, Clearance, ContactSpeed, Coverage, JointAcceleration, Limits, Tilt, TipAcceleration, TipSpeed,
    WashAcceleration, WashSpeed,
};
use platewash::planner::plan::PlanLimits;
use platewash::planner::scenario::Scenario;

pub fn add(edits: &mut Edits) {
    stated(edits);
    asked(edits);
}

/// What is stated and not asked for changes nothing but the promise that names it.
fn stated(edits: &mut Edits) {
    let mut fails = |what, apply| edits.fails(Kind::LimitsStated, what, &[Limits], apply);
    fails("a joint's range", |p| p.limits.upper_rad[2] = None);
    fails("a joint's lowest position", |p| p.limits.lower_rad[0] = Some(-7.0));
    fails("a joint's speed", |p| p.limits.velocity_rad_s[4] *= 2.0);
    fails("a joint's acceleration", |p| p.limits.acceleration_rad_s2[1] = 0.1);
    fails("speed of the tip", |p| p.limits.tip_speed_m_s = 0.5);
    fails("acceleration of the tip", |p| p.limits.tip_acceleration_m_s2 += 1e-12);
    fails("speed of washing", |p| p.limits.wash_speed_m_s *= 3.0);
    fails("acceleration of washing", |p| p.limits.wash_acceleration_m_s2 = 1e9);
    fails("tilt", |p| p.limits.tilt_rad = 1.0);
    fails("clearance", |p| p.limits.clearance_m = 0.0);
    fails("coverage", |p| p.limits.coverage = 0.5);
}

type Change = fn(&mut Scenario);

/// Numbers that the motion does not keep, and numbers that it keeps.
const ASKED: [(&str, Option<PromiseName>, Change); 17] = [
    ("a slower joint", Some(JointAcceleration), |s| {
        s.limits.joint_acceleration_rad_s2[2] = 3.9
    }),
    ("much slower joints", Some(JointAcceleration), |s| {
        s.limits.joint_acceleration_rad_s2 = [0.5; 6]
    }),
    ("a slower tip", Some(TipSpeed), |s| s.limits.tip_speed_m_s = 0.95),
    ("a smoother tip", Some(TipAcceleration), |s| {
        s.limits.tip_acceleration_m_s2 = 3.0
    }),
    ("slower washing", Some(WashSpeed), |s| s.wash.speed_m_s = 0.249),
    ("washing slower than it lifts off", Some(ContactSpeed), |s| {
        s.wash.speed_m_s = 0.03
    }),
    ("smoother washing", Some(WashAcceleration), |s| {
        s.wash.acceleration_m_s2 = 2.0
    }),
    ("less tilt", Some(Tilt), |s| s.wash.tilt_max_deg = 13.9),
    ("no tilt", Some(Tilt), |s| s.wash.tilt_max_deg = 0.0),
    ("more clearance", Some(Clearance), |s| s.wash.clearance_m = 0.0201),
    ("much more clearance", Some(Clearance), |s| s.wash.clearance_m = 0.1),
    ("all of the plate, with a smaller sponge", Some(Coverage), |s| {
        s.tool.sponge_radius_m = 0.012
    }),
    ("no tilt but what there is", None, |s| s.wash.tilt_max_deg = 13.96),
    ("a little more clearance", None, |s| s.wash.clearance_m = 0.019),
    ("no clearance", None, |s| s.wash.clearance_m = 0.0),
    ("faster washing", None, |s| s.wash.speed_m_s = 0.3),
    ("less coverage", None, |s| s.job.required_coverage = 0.5),
];

fn asked(edits: &mut Edits) {
    let wrong = vec![Limits, Tilt];
    edits.add(
        Kind::LimitsAsked,
        "less tilt, not stated",
        Expected::Fails(wrong),
        |p, _| {
            p.scenario.wash.tilt_max_deg = 10.0;
        },
    );
    for (what, broken, change) in ASKED {
        let expected = broken.map_or(Expected::Harmless, |name| Expected::Fails(vec![name]));
        edits.add(Kind::LimitsAsked, what, expected, move |p, _| ask(p, change));
    }
}

/// Asks for something else and states what follows.
fn ask(plan: &mut Plan, change: Change) {
    change(&mut plan.scenario);
    plan.tool = plan.scenario.tool.clone();
    plan.limits = PlanLimits::new(&plan.scenario, good()[0].robot);
}
