//! All phases, one after the other.

use crate::error::PlanError;
use crate::pace::{LimitShares, Pace};
use crate::pipeline::motion::assemble;
use crate::pipeline::shared::Pipeline;
use crate::pipeline::tour::least_time;
use crate::pipeline::visit::Visit;
use crate::placed_arm::TILT_RESERVE_RAD;
use crate::planned_job::{PlannedJob, TransitSummary, VisitSummary};
use crate::watch::Watch;
use platewash_bodies::job::WashJob;
use platewash_bodies::job::check_standing;
use platewash_bodies::job::overlaps_of_plates;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::{Knots, Plan, PlanParts, Provenance};
use platewash_motion::trajectory::Trajectory;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::{JobTerms, Overlap};
use platewash_workcell::wash_path::WashPath;

/// Factors on the reserve of tilt, for motions that use up more of it.
const MORE_TILT_RESERVE: [f64; 3] = [2.0, 5.0, 12.0];

/// Plans a job.
///
/// # Errors
/// [`PlanError`], one variant a phase.
pub fn plan(job: &WashJob) -> Result<PlannedJob, PlanError> {
    plan_with(job, &Watch::silent(&CancelToken::new()))
}

/// [`plan`], watched.
///
/// # Errors
/// As [`plan`], and [`PlanError::Cancelled`].
pub fn plan_with(job: &WashJob, watch: &Watch<'_>) -> Result<PlannedJob, PlanError> {
    planned(job, Pipeline::from_job(job, watch)?)
}

/// Plans as [`plan_with`], for callers that do not wait: where a plate cannot be washed, no other place is searched for, even if
/// the job asks for it. The result then has [`PlaceSearch::Later`](crate::PlaceSearch::Later);
/// [`nearest_place`](crate::nearest_place) is that search. Plans are the same, to the bit.
///
/// # Errors
/// As [`plan_with`].
pub fn plan_here(job: &WashJob, watch: &Watch<'_>) -> Result<PlannedJob, PlanError> {
    planned(job, Pipeline::here(job, watch)?)
}

/// Plans as [`plan_here`], for callers that only need to know if there is a plan: the cause is not investigated where a plate
/// cannot be washed.
///
/// # Errors
/// As [`plan_with`], without causes.
pub fn plan_unexplained(job: &WashJob, watch: &Watch<'_>) -> Result<PlannedJob, PlanError> {
    let mut pipeline = Pipeline::here(job, watch)?;
    pipeline.explains = false;
    planned(job, pipeline)
}

/// Plans as [`plan_here`], with the plates in a given order and along given curves, such as those of another plan; the job's
/// settings for both are ignored. Where no path is given for a plate, its curve is chosen.
///
/// # Errors
/// As [`plan_with`], and [`PlanError::Order`].
pub fn plan_in_order(
    job: &WashJob,
    order: &[usize],
    paths: &[WashPath],
    watch: &Watch<'_>,
) -> Result<PlannedJob, PlanError> {
    planned(job, Pipeline::in_order(job, order, paths, watch)?)
}

/// Plans near home; failing that, where joints of many turns are near a limit at home, some turns away from it.
fn planned(job: &WashJob, pipeline: Pipeline<'_>) -> Result<PlannedJob, PlanError> {
    let inside = pipeline.turned_inside();
    match (planned_there(job, pipeline), inside) {
        (Err(error), Some(inside)) if !matches!(error, PlanError::Cancelled(_)) => match planned_there(job, inside) {
            Err(other) if !matches!(other, PlanError::Cancelled(_)) => Err(error),
            planned => planned,
        },
        (planned, _) => planned,
    }
}

/// Plans with the usual reserve of tilt, and with more of it where the motion found uses up more.
fn planned_there(job: &WashJob, mut pipeline: Pipeline<'_>) -> Result<PlannedJob, PlanError> {
    let mut planned = planned_with(job, &pipeline);
    for more in MORE_TILT_RESERVE {
        if !matches!(planned, Err(PlanError::Tilt { .. })) {
            break;
        }
        pipeline.tilt_reserve_rad = more * TILT_RESERVE_RAD;
        planned = match planned_with(job, &pipeline) {
            Err(error) if !matches!(error, PlanError::Cancelled(_)) => planned,
            other => other,
        };
    }
    planned
}

fn planned_with(job: &WashJob, pipeline: &Pipeline<'_>) -> Result<PlannedJob, PlanError> {
    check_apart(job.arm(), job.terms())?;
    pipeline.check_homes()?;
    let placed = pipeline.placed()?;
    let (order, tour) = pipeline.order(&placed)?;
    let visits = pipeline.visits(&placed, &order)?;
    let lines: Vec<_> = visits.iter().map(|visit| visit.lines.each_ref()).collect();
    let transits = pipeline.transits(&placed, &lines, |_| true)?;
    let whole = assemble(&visits, &transits)?;
    // Every path states the widest cone that any of them needed: all of them keep it.
    let cone_rad = visits.iter().map(|visit| visit.path.cone_rad).fold(0.0, f64::max);
    let stated = |visit: &Visit| WashPath { cone_rad, ..visit.path };
    let wash_paths: Vec<WashPath> = visits.iter().map(stated).collect();
    pipeline.check_tilt(&placed, &whole, &wash_paths)?;
    let parts = PlanParts {
        provenance: Provenance::new(job.name()),
        order,
        wash_paths,
        segments: whole.segments,
        knots: Knots::from(&whole.motion),
    };
    let duration = |motion: &Trajectory| motion.duration_s();
    let visits = visits.iter().map(|visit| VisitSummary {
        plate: visit.path.plate,
        tilt: visit.washing.choice,
        aside_rad: visit.washing.aside_rad,
        cone_rad: visit.path.cone_rad,
        curve: visit.path.curve,
        wash_s: duration(&visit.wash.motion),
        pace: Pace::measure(
            &placed,
            &pipeline.plates[visit.path.plate],
            job.terms(),
            (&visit.path.curve, &visit.wash.motion),
            &pipeline.washing_of(visit.path.plate),
        ),
    });
    let transits = transits.iter().map(|transit| {
        let motion = &transit.timed.motion;
        let (from, to) = (motion.positions()[0], motion.positions()[motion.positions().len() - 1]);
        TransitSummary {
            kind: transit.kind,
            duration_s: duration(motion),
            least_s: least_time(&from, &to, &pipeline.transit),
            limits: LimitShares::measure(&placed, motion, &pipeline.transit),
        }
    });
    Ok(PlannedJob {
        plan: Plan::sealed(job.terms().clone(), parts)?,
        visits: visits.collect(),
        transits: transits.collect(),
        tour,
        largest_jerk: largest_jerk(&whole.motion),
    })
}

/// Refuses jobs that are known to fail before any search: an end configuration beyond its limits or too near a body, an arm
/// without a tool, obstacles that reach into plates or the base, plates that overlap where they must not. Plates may be left out
/// where they are not known yet.
///
/// # Errors
/// [`PlanError`].
pub fn check(arm: &RobotModel, terms: &JobTerms) -> Result<(), PlanError> {
    let cancel = CancelToken::new();
    let watch = Watch::silent(&cancel);
    let seen = &*terms.seen_from_base();
    check_standing(terms, arm)?;
    check_apart(arm, terms)?;
    Pipeline::new(arm, (seen, &terms.workcell.mount), &seen.plates, &watch)?.check_homes()
}

/// Refuses plates that share a place where no plan of them could be proved.
pub(crate) fn check_apart(arm: &RobotModel, terms: &JobTerms) -> Result<(), PlanError> {
    if terms.requirements.overlap == Overlap::Report {
        return Ok(());
    }
    match overlaps_of_plates(terms, arm) {
        none if none.is_empty() => Ok(()),
        overlaps => Err(PlanError::Overlap(overlaps)),
    }
}

fn largest_jerk(motion: &Trajectory) -> JointVector {
    let jerks = motion.extremes().map(|segment| segment.jerk);
    jerks.fold(JointVector::zeros(), |largest, jerk| largest.sup(&jerk))
}
