//! The smallest distance of all pairs that count, over time: sampled to look at, not the proof.

use super::numbers::Numbers;
use nalgebra::{Point3, Vector3};
use platewash_bodies::clearance::NearestBodies;
use platewash_certificate::{self as proved, ClearanceRule, Requirement};
use platewash_kinematics::{Pose, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::Trajectory;
use rayon::prelude::*;
use serde::Serialize;
use ts_rs::TS;

/// Number of moments that are sampled, besides the boundaries of segments and the proof's worst one.
const MOMENTS: usize = 400;

/// Time between two moments at least \[s\].
const LEAST_STEP_S: f64 = 0.02;

/// The smallest distance over time.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Clearance {
    /// Clearance required \[m\].
    pub margin_m: f64,
    /// \[n\] \[s\].
    pub t_s: Numbers,
    /// \[n\] \[m\].
    pub distance_m: Numbers,
    /// \[n, 2, 3\]: the nearest point of either body, world frame \[m\].
    pub nearest_m: Numbers,
    /// \[n, 2\]: places in `names`.
    pub pair: Numbers,
    /// Names of the bodies.
    pub names: Vec<String>,
}

impl Clearance {
    /// Clearance along a plan, by the rule of its certificate. `None` where no pair counts or the job has no distances.
    pub(super) fn new(
        plan: &Plan,
        robot: &RobotModel,
        motion: &Trajectory,
        certificate: Option<&proved::Certificate>,
    ) -> Option<Self> {
        let rule = ClearanceRule::new(plan, robot).ok()?;
        let times = times(plan, certificate);
        let nearest = |t_s: f64| rule.nearest(&motion.at(t_s)?.q, segment_at(plan, t_s));
        let (terms, names) = (&plan.job, rule.body_names());
        Self::sampled(
            &times,
            nearest,
            &terms.workcell.mount,
            names,
            terms.requirements.clearance_m,
        )
    }

    /// Clearance at some times, from the nearest bodies at each, in the frame of the base.
    pub(super) fn sampled(
        times: &[f64],
        nearest: impl Fn(f64) -> Option<NearestBodies> + Sync,
        mount: &Pose,
        names: Vec<&str>,
        margin_m: f64,
    ) -> Option<Self> {
        let look = |t_s: &f64| Some((*t_s, nearest(*t_s)?));
        let found: Vec<(f64, NearestBodies)> = times.par_iter().filter_map(look).collect();
        let in_world = |at: &[f64; 3]| -> Vector3<f64> { mount.transform_point(&Point3::from(*at)).coords };
        let points = found.iter().flat_map(|(_, nearest)| nearest.points_m);
        let points = points.flat_map(|point| <[f64; 3]>::from(in_world(&point)));
        let pairs = found.iter().flat_map(|(_, nearest)| nearest.bodies);
        (!found.is_empty()).then(|| Self {
            margin_m,
            t_s: Numbers::f64([found.len()], found.iter().map(|(t_s, _)| *t_s)),
            distance_m: Numbers::f32(
                [found.len()],
                found.iter().map(|(_, nearest)| nearest.distance_m as f32),
            ),
            nearest_m: Numbers::f32([found.len(), 2, 3], points.map(|value| value as f32)),
            pair: Numbers::u16(
                [found.len(), 2],
                pairs.map(|body| u16::try_from(body).unwrap_or(u16::MAX)),
            ),
            names: names.into_iter().map(str::to_owned).collect(),
        })
    }
}

/// Moments from the start to the end in even steps, the boundaries of segments, at which other pairs count, and the worst one of the
/// proof \[s\].
fn times(plan: &Plan, certificate: Option<&proved::Certificate>) -> Vec<f64> {
    let boundaries = plan.segments.iter().map(|segment| segment.t_start_s);
    let worst = certificate.and_then(|certificate| certificate.check(Requirement::Clearance)?.worst.time_s);
    even_times(plan.duration_s(), boundaries.chain(worst))
}

/// Moments of a motion in even steps, and others \[s\].
pub(super) fn even_times(duration_s: f64, others: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let steps = (duration_s / LEAST_STEP_S).floor().clamp(1.0, MOMENTS as f64);
    let even = (0..=steps as usize).map(|k| duration_s * k as f64 / steps);
    let inside = |t: &f64| (0.0..=duration_s).contains(t);
    let mut times: Vec<f64> = even.chain(others).filter(inside).collect();
    times.sort_unstable_by(f64::total_cmp);
    times.dedup();
    times
}

/// The segment of a time \[s\]: at a boundary the later one.
fn segment_at(plan: &Plan, t_s: f64) -> Option<usize> {
    let begun = plan.segments.partition_point(|segment| segment.t_start_s <= t_s);
    begun.checked_sub(1)
}
