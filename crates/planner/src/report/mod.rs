//! What a job came to: per plate and over the whole, for people and as data.

mod motion;
mod plate;
mod text;

pub use motion::{MotionReport, Violation, ViolationKind};
pub use plate::{ClosestApproach, PlateReport, Unreached};

use crate::error::PlanError;
use crate::job::Job;
use crate::plan::Summary;
use crate::scenario::Interpolation;
use crate::tool_path::SegmentKind;
use crate::tracking::Step;
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::layout;
use serde::Serialize;

/// How a job ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every plate is washed and every limit kept.
    Washed,
    /// The job cannot be done, or the plan itself fails: a waypoint out of reach, or too little clearance.
    Infeasible,
    /// No way to do the job was found; there may be one.
    NotFound,
    /// The plan would do, but its execution fails: coverage, limits or clearance.
    NotVerified,
}

/// Something worth knowing that no figure shows.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum JobFinding {
    /// About the plates.
    Layout {
        /// The finding.
        finding: layout::Finding,
    },
    /// The first waypoint is commanded from where the arm stands, without an approach.
    NoApproach {
        /// Where the program believes to be (base frame, m).
        believed_m: [f64; 3],
        /// Where the tip is (base frame, m).
        tip_m: [f64; 3],
        /// How far the first waypoint is from the tip \[m\].
        distance_m: f64,
    },
    /// Cubics at rest at every waypoint: acceleration jumps there.
    StopsAtWaypoints {
        /// Waypoints of each transition.
        waypoints: usize,
    },
    /// The sponge is not on the plates while it should wash them.
    NoContact {
        /// Washing waypoints without contact.
        waypoints: usize,
        /// Washing waypoints in all.
        of: usize,
        /// Whether there is a tool body at all.
        tool: bool,
    },
    /// The description has no `tool0`: the tool is assumed to leave the flange along its x axis.
    AssumedMount,
    /// Links without collision geometry, which nothing checks.
    Unchecked {
        /// Their names.
        links: Vec<String>,
    },
}

/// Waypoints and nearness of the ways between plates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TransitionReport {
    /// Waypoints asked.
    pub waypoints: usize,
    /// Waypoints solved.
    pub reached: usize,
    /// The unreached waypoint that is farthest away, counted over all transitions.
    pub worst_unreached: Option<Unreached>,
    /// Distance of the executed tip from the path, root mean square \[m\].
    pub tracking_rms_m: f64,
    /// The same, at most \[m\].
    pub tracking_max_m: f64,
    /// Nearest approach of the commanded motion.
    pub planned_clearance: Option<ClosestApproach>,
    /// Nearest approach of the executed motion.
    pub executed_clearance: Option<ClosestApproach>,
}

/// What a job came to. Lengths in metres, angles in radians, times in seconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JobReport {
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// Name of the arm.
    pub robot: String,
    /// How it ended.
    pub verdict: Verdict,
    /// The first line: whether it washed.
    pub headline: String,
    /// Radius of the sponge that coverage is measured with \[m\].
    pub sponge_radius_m: f64,
    /// Least clearance that counts as free \[m\].
    pub clearance_required_m: f64,
    /// Share of a plate that must be covered.
    pub coverage_required: f64,
    /// One entry a plate, in the order of washing.
    pub plates: Vec<PlateReport>,
    /// The ways between them.
    pub transitions: TransitionReport,
    /// The commanded motion against the limits.
    pub planned: MotionReport,
    /// The executed motion against the limits.
    pub executed: MotionReport,
    /// What else is to be said.
    pub findings: Vec<JobFinding>,
    /// The pairs of bodies that were checked for clearance, by name.
    pub clearance_pairs: Vec<[String; 2]>,
    /// Duration \[s\].
    pub duration_s: f64,
}

impl JobReport {
    pub(crate) fn new(job: &Job, clearance: &ClearanceModel) -> Result<Self, PlanError> {
        let approaches = plate::approaches(job, clearance);
        let plates = plate::plates(job, &approaches)?;
        let transitions = transitions(job, &approaches);
        let planned = MotionReport::new(job, &job.planned, approaches.iter().map(|a| &a.planned));
        let executed = MotionReport::new(job, &job.executed, approaches.iter().map(|a| &a.executed));
        let findings = findings(job, &plates);
        let required = job.scenario.job.required_coverage;
        let verdict = verdict(&plates, &transitions, &planned, &executed);
        Ok(Self {
            scenario: job.scenario.name.clone(),
            seed: job.scenario.seed,
            robot: job.robot.name().to_owned(),
            verdict,
            headline: text::headline(verdict, &plates, &transitions, &planned, &executed, required),
            sponge_radius_m: job.scenario.tool.sponge_radius_m,
            clearance_required_m: job.scenario.wash.clearance_m,
            coverage_required: required,
            plates,
            transitions,
            planned,
            executed,
            findings,
            clearance_pairs: clearance
                .pair_names()
                .into_iter()
                .map(|(a, b)| [a.to_owned(), b.to_owned()])
                .collect(),
            duration_s: job.planned.duration_s(),
        })
    }

    /// The plan file's summary.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let sum = |of: fn(&PlateReport) -> usize| self.plates.iter().map(of).sum::<usize>();
        Summary {
            headline: self.headline.clone(),
            plates_washed: sum(|p| usize::from(p.washed)),
            duration_s: self.duration_s,
            waypoints_reached: [
                sum(|p| p.reached) + self.transitions.reached,
                sum(|p| p.waypoints) + self.transitions.waypoints,
            ],
        }
    }
}

fn verdict(
    plates: &[PlateReport],
    transitions: &TransitionReport,
    plan: &MotionReport,
    done: &MotionReport,
) -> Verdict {
    let reached = plates.iter().all(|p| p.reached == p.waypoints) && transitions.reached == transitions.waypoints;
    let clear = !plan.violations.iter().any(|v| v.kind == ViolationKind::Clearance);
    if !reached || !clear {
        Verdict::Infeasible
    } else if plates.iter().all(|p| p.washed) && plan.violations.is_empty() && done.violations.is_empty() {
        Verdict::Washed
    } else {
        Verdict::NotVerified
    }
}

fn transitions(job: &Job, approaches: &[plate::StepApproach]) -> TransitionReport {
    let between = |step: &Step| job.tool_path.segments[step.segment].kind == SegmentKind::Transition;
    let steps: Vec<_> = job.steps.iter().filter(|s| between(s)).collect();
    let (tracking_rms_m, tracking_max_m) = plate::tracking_errors(steps.iter().copied());
    let nearest = |of: fn(&plate::StepApproach) -> Option<&ClosestApproach>| {
        plate::nearest(
            job.steps
                .iter()
                .zip(approaches)
                .filter(|(s, _)| between(s))
                .filter_map(|(_, a)| of(a)),
        )
    };
    TransitionReport {
        waypoints: steps.len(),
        reached: steps.iter().filter(|s| s.reached()).count(),
        worst_unreached: plate::worst_unreached(&steps),
        tracking_rms_m,
        tracking_max_m,
        planned_clearance: nearest(|a| a.planned.nearest.as_ref()),
        executed_clearance: nearest(|a| a.executed.nearest.as_ref()),
    }
}

/// A first waypoint nearer than this needs no approach \[m\].
const APPROACHED_M: f64 = 1e-3;

fn findings(job: &Job, plates: &[PlateReport]) -> Vec<JobFinding> {
    let of_layout = job.layout.findings.iter().cloned();
    let mut findings: Vec<_> = of_layout.map(|finding| JobFinding::Layout { finding }).collect();
    findings.extend(no_approach(job));
    findings.extend(stops_at_waypoints(job));
    findings.extend(no_contact(job, plates));
    if !job.robot.states_its_mounting_frame() {
        findings.push(JobFinding::AssumedMount);
    }
    let bare = |child: &str| {
        job.robot
            .links()
            .iter()
            .any(|l| l.name == child && l.collision.is_empty())
    };
    let children = job.robot.joints().iter().map(|j| &j.child);
    let links: Vec<_> = children.filter(|child| bare(child)).cloned().collect();
    if !links.is_empty() {
        findings.push(JobFinding::Unchecked { links });
    }
    findings
}

fn no_approach(job: &Job) -> Option<JobFinding> {
    let (start, first) = (job.planned.positions().first()?, job.steps.first()?);
    let tip = platewash_workcell::tool::tip_frame(&job.robot, &job.scenario.tool);
    let tip = job.robot.fk(start).rigid(&tip).translation;
    let distance_m = (tip - first.target).norm();
    (distance_m > APPROACHED_M).then(|| JobFinding::NoApproach {
        believed_m: [0.0; 3],
        tip_m: tip.into(),
        distance_m,
    })
}

fn stops_at_waypoints(job: &Job) -> Option<JobFinding> {
    let transition = &job.scenario.transition;
    let any = job.tool_path.segments.iter().any(|s| s.kind == SegmentKind::Transition);
    let waypoints = transition.mid_points + 2;
    (any && transition.interpolation == Interpolation::ZeroVelocity)
        .then_some(JobFinding::StopsAtWaypoints { waypoints })
}

fn no_contact(job: &Job, plates: &[PlateReport]) -> Option<JobFinding> {
    let of: usize = plates.iter().map(|p| p.waypoints).sum();
    let waypoints = of - plates.iter().map(|p| p.in_contact).sum::<usize>();
    let tool = job.scenario.tool.length_m > 0.0;
    (waypoints > 0).then_some(JobFinding::NoContact { waypoints, of, tool })
}
