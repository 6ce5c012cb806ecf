//! The requirements about numbers, measured on dense samples of a plan: an opinion of its own on what is broken.
//!
//! With the certificate it shares forward kinematics and the distances at single configurations, no more. What it finds is
//! a lower bound of how bad things are: a requirement that it finds broken is broken.

mod clearance;
mod findings;
pub(crate) mod motion;
pub(crate) mod paths;
mod places;
mod tests;

pub use crate::mutation::sampler::findings::{Findings, WorstSample};
pub use crate::mutation::sampler::motion::pieces;
pub use crate::mutation::sampler::paths::is_sound;

use crate::mutation::sampler::clearance::Distances;
use crate::mutation::sampler::motion::{Arm, Moment, Piece};
use crate::mutation::sampler::paths::Curve;
use platewash::certificate::Requirement;
use platewash::motion::trajectory::SegmentKind;
use platewash::{Plan, RobotModel};

/// Distance of the tip from its wash path and from a plate's normal that every certified plan keeps \[m\].
const PATH_M: f64 = 2e-4;
const LINE_M: f64 = 1e-3;

/// What deviations are right to, as a part of them.
const DEVIATION: f64 = 1e-6;

/// Samples plans that come of one plan by edits.
pub struct Sampler<'a> {
    robot: &'a RobotModel,
    distances: Distances<'a>,
}

impl<'a> Sampler<'a> {
    pub fn new(origin: &'a Plan, robot: &'a RobotModel) -> Self {
        let distances = Distances::new(origin, robot);
        Self { robot, distances }
    }

    /// The worst of every requirement that can be judged: without sound segments those that hold everywhere. Moments at some
    /// times \[s\] are looked at besides its own.
    pub fn measure(&self, plan: &Plan, also_at: &[f64]) -> Findings {
        let (pieces, is_sound) = (pieces(&plan.knots), is_sound(plan));
        let moments = self.moments(plan, &pieces, is_sound, also_at);
        let mut findings = Findings::default();
        places::ends(plan, &mut findings);
        places::apart(plan, &mut findings);
        places::standing(plan, &mut findings);
        motion::joints(plan, self.robot, &pieces, &moments, &mut findings);
        motion::tip(plan, &moments, &mut findings);
        self.distances.look(plan, &pieces, is_sound, also_at, &mut findings);
        if is_sound {
            places::contacts(plan, &mut findings);
            let arm = Arm::new(self.robot, &plan.job.workcell.tool);
            places::touches(plan, &arm, &pieces, &moments, &mut findings);
            places::poses(plan, &moments, &mut findings);
            places::coverage(plan, &moments, &mut findings);
            places::reach(plan, &moments, &mut findings);
            deviations(plan, &moments, &mut findings);
        }
        findings
    }

    /// Whether no more can be proved of the coverage than too little, with the segments sound.
    pub fn least_coverage_is_short(&self, plan: &Plan) -> bool {
        places::least_coverage_is_short(plan, &self.moments(plan, &pieces(&plan.knots), true, &[]))
    }

    fn moments(&self, plan: &Plan, pieces: &[Piece], is_sound: bool, also_at: &[f64]) -> Vec<Moment> {
        let arm = Arm::new(self.robot, &plan.job.workcell.tool);
        motion::all(&arm, plan, pieces, is_sound, also_at)
    }
}

/// Whether the tip follows the curves stated.
fn deviations(plan: &Plan, moments: &[Moment], findings: &mut Findings) {
    for (i, segment) in plan.segments.iter().enumerate() {
        let path = paths::path_of(plan, segment.plate);
        let curve = path.and_then(|path| Curve::new(&plan.job.plates[segment.plate], path, segment.kind));
        let Some(curve) = curve else { continue };
        let here = moments.iter().filter(|m| m.stage == Some(i));
        let path: Vec<_> = here.map(|m| m.tip).collect();
        let (name, tolerance) = match segment.kind {
            SegmentKind::Wash => (Requirement::PathDeviation, PATH_M),
            _ => (Requirement::LineDeviation, LINE_M),
        };
        let (found, slack) = (curve.deviation(&path, tolerance), DEVIATION * tolerance);
        findings.at_most(name, found, tolerance, slack);
    }
}
