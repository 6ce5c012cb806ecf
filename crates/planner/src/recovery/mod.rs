//! Going on after a stop: from wherever the arm stands a motion up from the plate, clear of everything, home; then the plates that are left.
//!
//! | concept | file |
//! | --- | --- |
//! | moment of the stop, plates washed by then | `stop.rs` |
//! | way to the nearest place that is clear | `retreat.rs` |
//! | both plans | here |
//! | reasons that there is no recovery | `error.rs` |
//!
//! The certificate judges both as it judges any plan. Where the sponge is at a plate, it may touch that plate until it is up, slowly and
//! along the plate's normal. Other pairs that are nearer than the job asks keep what they have at the start: the plan names them. Where
//! one of them touches, there is no recovery.

mod error;
mod retreat;
mod stop;

use crate::error::PlanError;
use crate::pipeline::motion::{WholeMotion, one_after_the_other};
use crate::pipeline::plan_in_order;
use crate::pipeline::shared::Pipeline;
use crate::recovery::retreat::{Start, Way};
use crate::transit::{self, LiftLine, Transit};
use crate::watch::{Activity, Watch};
use platewash_bodies::clearance::PairClearance;
use platewash_bodies::job::{JobError, WashJob};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::{Knots, Plan, PlanParts, Process, Provenance};
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::ReducedClearance;
use platewash_workcell::job::{NEARER_M, Recovery, RecoveryPart, RetreatLine};
use platewash_workcell::random;
use std::sync::Arc;

pub use crate::recovery::error::RecoveryError;
pub use crate::recovery::stop::Stop;

/// Times about the stop at which the plan may have the arm clear \[s\].
const ABOUT_S: [f64; 7] = [0.0, -0.1, 0.1, -0.3, 0.3, -0.8, 0.8];

/// Recovery from a stop, planned and not proved.
#[derive(Debug, Clone)]
pub struct Recovered {
    /// The stop.
    pub stop: Stop,
    /// Pairs that are nearer at the stop than the job asks, without the sponge and the plate that it is at; the nearest first.
    pub near: Vec<PairClearance>,
    /// Plan of the motion home.
    pub home: Plan,
    /// Plan of the plates that are left: the stopped plan itself where none was washed, `None` where all were.
    pub rest: Option<Plan>,
}

/// Plans the way home from where the arm stands, `at` \[rad\], and the washing of the plates that are left.
///
/// `time_s` is the time in the plan at which it was stopped \[s\], where that is known. The joints must fit the plan then, if they fit it at
/// any time. Without it the joints tell, and the earliest moment that fits them counts.
///
/// # Errors
/// [`RecoveryError`]; it is cancelled with [`PlanError::Cancelled`].
pub fn recover(
    plan: &Plan,
    arm: &Arc<RobotModel>,
    at: &JointVector,
    time_s: Option<f64>,
    watch: &Watch<'_>,
) -> Result<Recovered, RecoveryError> {
    check(plan, arm, at)?;
    let motion = plan.knots.motion().map_err(PlanError::from)?;
    let stop = Stop::new(plan, &motion, at, time_s)?;
    let job = WashJob::new(arm.clone(), plan.job.clone()).map_err(PlanError::from)?;
    let pipeline = Pipeline::here(&job, watch)?;
    let placed = pipeline.placed()?;
    (watch.tell)(&Activity::Transit { turn: 1, of: 1 });
    let about = |after_s: &f64| Some(motion.at(stop.time_s? + after_s)?.q);
    let on_plan = ABOUT_S.iter().filter_map(about).collect();
    let start = Start::new(&pipeline, &placed, at, stop.at_plate, on_plan);
    let near = start.too_near();
    if let Some(pair) = near.iter().find(|pair| pair.distance_m <= NEARER_M) {
        let pair = Box::new(pair.clone());
        return Err(RecoveryError::Touching { pair });
    }
    let (way, transit) = way_home(&start)?;
    Ok(Recovered {
        home: motion_home(plan, &start, way, &transit)?,
        rest: rest(plan, arm, &stop, watch)?,
        stop,
        near,
    })
}

fn check(plan: &Plan, arm: &RobotModel, at: &JointVector) -> Result<(), RecoveryError> {
    if plan.process == Process::Paper {
        return Err(RecoveryError::PaperRun);
    }
    if plan.job.is_motion_home() {
        return Err(RecoveryError::MotionHome);
    }
    if plan.job.dry_run.is_some() {
        return Err(RecoveryError::DryRun);
    }
    if !plan.is_sealed() {
        return Err(RecoveryError::NotSealed);
    }
    if !at.iter().all(|q| q.is_finite()) {
        return Err(RecoveryError::NotFinite);
    }
    arm.limits()
        .violation(at)
        .map_or(Ok(()), |violation| Err(RecoveryError::Limit(violation)))
}

/// The plan of the motion from the stop to the start of a plan.
fn motion_home(plan: &Plan, start: &Start<'_>, way: Option<Way>, transit: &Transit) -> Result<Plan, PlanError> {
    let retreat = start.plate.zip(way.as_ref()).map(|(plate, way)| RetreatLine {
        plate,
        length_m: way.whole_m(),
    });
    let up = way.map(|way| way.timed(start)).transpose()?;
    let of = retreat.map_or(0, |line| line.plate);
    let kind = if retreat.is_some() {
        SegmentKind::Retreat
    } else {
        SegmentKind::Return
    };
    let parts = up
        .iter()
        .map(|up| (kind, up))
        .chain([(SegmentKind::Return, &transit.timed)]);
    let WholeMotion { motion, segments } = one_after_the_other(parts, of)?;
    let recovery = Recovery {
        parent: plan.hash.clone().unwrap_or_default(),
        left_out: (0..plan.job.plates.len()).collect(),
        part: RecoveryPart::Home { retreat },
    };
    let near = near_pairs(&start.near, plan.job.requirements.clearance_m);
    let terms = plan.job.recovered(recovery, start.at, near);
    terms.validate().map_err(JobError::from)?;
    let parts = PlanParts {
        provenance: Provenance::new(&format!("{}-home", plan.provenance.scenario)),
        order: Vec::new(),
        wash_paths: Vec::new(),
        segments,
        knots: Knots::from(&motion),
    };
    Ok(Plan::sealed(terms, parts)?)
}

/// The way to a clear place, if the start is not clear, and the free motion home from there.
fn way_home(start: &Start<'_>) -> Result<(Option<Way>, Transit), RecoveryError> {
    if start.plate.is_none() && start.near.is_empty() {
        return Ok((None, transit_home(start, &start.at)?));
    }
    let mut last = RecoveryError::NoWay {
        plate: start.plate,
        pair: start.near.first().cloned().map(Box::new),
    };
    for way in start.ways() {
        match transit_home(start, &way.top()) {
            Ok(transit) => return Ok((Some(way), transit)),
            Err(error @ PlanError::Cancelled(_)) => return Err(error.into()),
            Err(error) => last = error.into(),
        }
    }
    Err(last)
}

fn transit_home(start: &Start<'_>, from: &JointVector) -> Result<Transit, PlanError> {
    let terms = start.pipeline.terms;
    let mut rng = random::stream(terms.seed, "recovery");
    let [from, to] = [*from, terms.home_rad[0]].map(LiftLine::home);
    let rules = start.pipeline.transit_rules(start.placed);
    Ok(transit::plan(&rules, &from, &to, &mut rng)?)
}

/// Clearances of the pairs that are near at the start: they keep what they have.
fn near_pairs(near: &[PairClearance], clearance_m: f64) -> Vec<ReducedClearance> {
    let reduced = near
        .iter()
        .map(|pair| (pair, clearance_m - (pair.distance_m - NEARER_M)));
    let nearer = reduced.filter(|(pair, by_m)| *by_m > pair.reduced_by_m);
    let stated = nearer.map(|(pair, by_m)| ReducedClearance {
        pair: [pair.a.clone(), pair.b.clone()],
        by_m,
        at_stop: true,
    });
    stated.collect()
}

/// The plan of the plates that are left, in the order and along the paths of the stopped one.
fn rest(plan: &Plan, arm: &Arc<RobotModel>, stop: &Stop, watch: &Watch<'_>) -> Result<Option<Plan>, PlanError> {
    let is_left = |plate: &usize| !stop.washed.contains(plate);
    let order: Vec<usize> = plan.order.iter().copied().filter(is_left).collect();
    if order.is_empty() {
        return Ok(None);
    }
    if stop.washed.is_empty() {
        return Ok(Some(plan.clone()));
    }
    let left_out = (0..plan.job.plates.len())
        .filter(|plate| !order.contains(plate))
        .collect();
    let recovery = Recovery {
        parent: plan.hash.clone().unwrap_or_default(),
        left_out,
        part: RecoveryPart::Rest,
    };
    let terms = plan.job.recovered(recovery, plan.job.home_rad[0], Vec::new());
    let job = WashJob::new(arm.clone(), terms)?.named(&format!("{}-rest", plan.provenance.scenario));
    let paths: Vec<_> = plan
        .wash_paths
        .iter()
        .filter(|path| is_left(&path.plate))
        .copied()
        .collect();
    Ok(Some(plan_in_order(&job, &order, &paths, watch)?.plan))
}
