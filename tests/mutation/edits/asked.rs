//! Requirements and limits of the job: numbers that the motion keeps, and numbers that it does not.

use crate::mutation::edit::{Edits, ExpectedResult, Kind};
use platewash::certificate::Requirement::{
    self, Clearance, ContactSpeed, JointAcceleration, LineDeviation, PathDeviation, Reach, Swept, Tilt,
    TipAcceleration, TipSpeed, WashAcceleration, WashPaths, WashSpeed,
};
use platewash::{JobTerms, Plan};

type Change = fn(&mut JobTerms);

/// Numbers that the motion does not keep, and numbers that it keeps.
const ASKED: [(&str, Option<Requirement>, Change); 25] = [
    ("a slower joint", Some(JointAcceleration), |j| {
        j.limits.joint_acceleration_rad_s2[2] = 3.9
    }),
    ("much slower joints", Some(JointAcceleration), |j| {
        j.limits.joint_acceleration_rad_s2 = [0.5; 6]
    }),
    ("a slower tip", Some(TipSpeed), |j| j.limits.tip_speed_m_s = 0.95),
    ("a much slower tip", Some(WashSpeed), |j| j.limits.tip_speed_m_s = 0.2),
    ("a smoother tip", Some(TipAcceleration), |j| {
        j.limits.tip_acceleration_m_s2 = 3.0
    }),
    ("a much smoother tip", Some(WashAcceleration), |j| {
        j.limits.tip_acceleration_m_s2 = 2.0
    }),
    ("slower washing", Some(WashSpeed), |j| {
        j.requirements.wash_speed_m_s = 0.249
    }),
    ("washing slower than it lifts off", Some(ContactSpeed), |j| {
        j.requirements.wash_speed_m_s = 0.03
    }),
    ("smoother washing", Some(WashAcceleration), |j| {
        j.requirements.wash_acceleration_m_s2 = 2.0
    }),
    ("less tilt", Some(Tilt), |j| {
        j.requirements.tilt_rad = 13.9_f64.to_radians()
    }),
    ("no tilt", Some(Tilt), |j| j.requirements.tilt_rad = 0.0),
    ("more clearance", Some(Clearance), |j| {
        j.requirements.clearance_m = 0.0201
    }),
    ("much more clearance", Some(Clearance), |j| {
        j.requirements.clearance_m = 0.1
    }),
    ("all of the plate, with a smaller sponge", Some(Swept), |j| {
        j.workcell.tool.sponge.radius_m = 0.012
    }),
    ("all of the plate, with a path for less", Some(Swept), |j| {
        j.workcell.tool.sponge.radius_m = 0.015;
        j.requirements.coverage = 1.0;
    }),
    ("no tilt but what there is", None, |j| {
        j.requirements.tilt_rad = 13.96_f64.to_radians()
    }),
    ("a little more clearance", None, |j| j.requirements.clearance_m = 0.019),
    ("no clearance", None, |j| j.requirements.clearance_m = 0.0),
    ("faster washing", None, |j| j.requirements.wash_speed_m_s = 0.3),
    ("washing as fast as the tip may be", None, |j| {
        j.requirements.wash_speed_m_s = 5.0
    }),
    ("rougher washing", None, |j| {
        j.requirements.wash_acceleration_m_s2 = 100.0
    }),
    ("less coverage", None, |j| j.requirements.coverage = 0.5),
    ("no coverage at all", None, |j| j.requirements.coverage = 0.0),
    ("faster joints", None, |j| {
        j.limits.joint_acceleration_rad_s2 = [50.0; 6]
    }),
    ("a faster tip", None, |j| {
        (j.limits.tip_speed_m_s, j.limits.tip_acceleration_m_s2) = (3.0, 40.0)
    }),
];

pub fn add(edits: &mut Edits) {
    for (what, broken, change) in ASKED {
        let expected = broken.map_or(ExpectedResult::Harmless, |name| ExpectedResult::Fails(vec![name]));
        edits.add(Kind::LimitsAsked, what, expected, move |p, _| {
            change(&mut p.job);
            narrow(p);
        });
    }
    // A path whose tool may leave the cone that is allowed is none.
    let names = [WashPaths, PathDeviation, LineDeviation, Reach, Tilt];
    edits.fails(Kind::LimitsAsked, "less tilt, and paths as they were", &names, |p| {
        p.job.requirements.tilt_rad = 10_f64.to_radians();
    });
    edits.fails(Kind::LimitsAsked, "a flat sponge that allows less tilt", &[Tilt], |p| {
        let sponge = &mut p.job.workcell.tool.sponge;
        let lower = 0.5 * (sponge.height_m - 4e-3);
        sponge.height_m = 4e-3;
        sponge.compression_m = 1e-3;
        sponge.pose.translation.z += lower;
        narrow(p);
    });
}

/// The paths with the cone that is asked for.
pub fn narrow(plan: &mut Plan) {
    let most = plan.job.tilt_max_rad();
    plan.wash_paths.iter_mut().for_each(|path| path.cone_rad = most);
}
