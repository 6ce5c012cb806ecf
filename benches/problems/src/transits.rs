//! Each transit of a cell alone: how long it takes to plan, and to prove as a motion of its own.

use platewash_bodies::job::WashJob;
use platewash_certificate::{MotionProof, Requirement, Status, prove_motion};
use platewash_kinematics::JointVector;
use platewash_motion::plan::{Knots, Plan};
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_planner::{Activity, Watch, plan_here};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::words::plate_name;
use std::error::Error;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A transit, alone.
#[derive(Debug, Clone)]
pub struct AloneTransit {
    /// The plate that it leaves; `None` for home.
    pub from: Option<usize>,
    /// The plate that it leads to; `None` for home.
    pub to: Option<usize>,
    /// Where its free part begins and ends, over the plates or at home \[rad\].
    pub tops: [JointVector; 2],
    /// How long it took to plan, from plate to plate. The last one of a cell counts with what follows: the motions are joined, and the plan
    /// sealed.
    pub planning: Duration,
    /// How long it took to prove the same motion: limits of joints and tip, clearance of every pair.
    pub proving: Duration,
    /// Whether that is proved. The sponge and the plates that it comes from and goes to may touch.
    pub is_proved: bool,
}

/// Plans a job and looks at its transits one by one.
///
/// # Errors
/// Those of planning and of what is proved.
pub fn transits_alone(job: &WashJob) -> Result<Vec<AloneTransit>, Box<dyn Error>> {
    let begun = Mutex::new(Vec::new());
    let tell = |activity: &Activity| {
        if matches!(activity, Activity::Transit { .. }) {
            begun
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .push(Instant::now());
        }
    };
    let cancel = CancelToken::new();
    let watch = Watch {
        tell: &tell,
        cancel: &cancel,
    };
    let plan = plan_here(job, &watch)?.plan;
    let mut moments = begun.into_inner().unwrap_or_else(PoisonError::into_inner);
    moments.push(Instant::now());
    let planning = moments.windows(2).map(|pair| pair[1] - pair[0]);
    let stretches = plan.segments.split(|segment| segment.kind == SegmentKind::Wash);
    stretches
        .zip(planning)
        .map(|(stretch, planning)| alone(job, &plan, stretch, planning))
        .collect()
}

/// A transit of a plan, by its segments.
fn alone(
    job: &WashJob,
    plan: &Plan,
    stretch: &[PlanSegment],
    planning: Duration,
) -> Result<AloneTransit, Box<dyn Error>> {
    let plate_at = |kind| stretch.iter().find(|s| s.kind == kind).map(|s| s.plate);
    let (from, to) = (plate_at(SegmentKind::Retreat), plate_at(SegmentKind::Approach));
    let is_free = |s: &&PlanSegment| ![SegmentKind::Retreat, SegmentKind::Approach].contains(&s.kind);
    let free = stretch.iter().find(is_free).ok_or("a transit without a free part")?;
    let (first, last) = stretch.first().zip(stretch.last()).ok_or("a transit of nothing")?;
    let free = part(&plan.knots, [free.t_start_s, free.t_end_s]);
    let whole = part(&plan.knots, [first.t_start_s, last.t_end_s]);
    let tops = free.q_rad.first().zip(free.q_rad.last()).ok_or("no knots")?;
    let start = Instant::now();
    let proof = prove_motion(&whole, job.terms(), job.arm(), &CancelToken::new())?;
    Ok(AloneTransit {
        from,
        to,
        tops: [*tops.0, *tops.1],
        planning,
        proving: start.elapsed(),
        is_proved: is_proved(&proof, &[from, to]),
    })
}

/// The knots within a span of time \[s\].
fn part(knots: &Knots, [from, to]: [f64; 2]) -> Knots {
    let first = knots.t_s.partition_point(|t| *t < from);
    let end = knots.t_s.partition_point(|t| *t <= to);
    Knots {
        t_s: knots.t_s[first..end].iter().map(|t| t - from).collect(),
        q_rad: knots.q_rad[first..end].to_vec(),
        qd_rad_s: knots.qd_rad_s[first..end].to_vec(),
    }
}

/// Whether all is proved but for the sponge and these plates.
fn is_proved(proof: &MotionProof, plates: &[Option<usize>]) -> bool {
    let plates: Vec<_> = plates.iter().flatten().map(|plate| plate_name(*plate)).collect();
    let others = proof.checks.iter().filter(|c| c.requirement != Requirement::Clearance);
    let may_touch = |pair: &[String; 2]| pair.iter().any(|n| n == "sponge") && pair.iter().any(|n| plates.contains(n));
    let apart = proof.clearance.iter().filter(|line| !may_touch(&line.pair));
    others
        .map(|check| check.status)
        .chain(apart.map(|line| line.status))
        .all(Status::is_kept)
}
