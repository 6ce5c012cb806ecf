//! How a run went: per plate and over the whole, for people and as data.

mod finding;
mod motion;
mod text;
mod waypoints;

pub use finding::PaperFinding;
pub use motion::{ClosestApproach, MotionReport, Violation, ViolationKind};
pub use waypoints::{PlateReport, UnreachedWaypoint, WaypointReport};

use crate::error::PaperError;
use crate::run::PaperRun;
use finding::findings;
use motion::nearnesses;
use platewash_bodies::clearance::ClearanceModel;
use platewash_kinematics::words::percent;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::verdict::Verdict;
use platewash_workcell::words::part_of;
use serde::Serialize;
use waypoints::{plates, transits};

/// Report of a run. Lengths in metres, angles in radians, times in seconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PaperReport {
    /// Name of the scenario.
    pub scenario: String,
    /// Seed of the job.
    pub seed: u64,
    /// Name of the arm.
    pub robot: String,
    /// Verdict on the run.
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
    /// The transits between them.
    #[serde(rename = "transitions")]
    pub transits: WaypointReport,
    /// The commanded motion against the limits.
    pub planned: MotionReport,
    /// The executed motion against the limits.
    pub executed: MotionReport,
    /// Further findings.
    pub findings: Vec<PaperFinding>,
    /// The pairs of bodies that were checked for clearance, by name.
    pub clearance_pairs: Vec<[String; 2]>,
    /// Duration \[s\].
    pub duration_s: f64,
}

impl PaperRun {
    /// Judges the run: waypoints reached, distances kept, plates covered.
    ///
    /// # Errors
    /// [`PaperError::Clearance`] or [`PaperError::Coverage`].
    pub fn report(&self) -> Result<PaperReport, PaperError> {
        self.report_with(&CancelToken::new())
    }

    /// Judges the run; a token can cancel it.
    ///
    /// # Errors
    /// As [`PaperRun::report`], and [`PaperError::Cancelled`].
    pub fn report_with(&self, cancel: &CancelToken) -> Result<PaperReport, PaperError> {
        let job = &self.job;
        let clearance = ClearanceModel::new(&job.arm, &job.workcell, &job.layout.plates)?;
        let near = nearnesses(self, &clearance, cancel)?;
        let (plates, transits) = (plates(self, &near)?, transits(self, &near));
        let planned = MotionReport::new(self, &self.planned, near.iter().map(|step| &step[0]));
        let executed = MotionReport::new(self, &self.executed, near.iter().map(|step| &step[1]));
        let coverage_required = job.requirements.coverage;
        let (verdict, headline) = judged(&plates, &transits, [&planned, &executed], coverage_required);
        let pairs = clearance.pair_names().into_iter();
        Ok(PaperReport {
            scenario: job.name.clone(),
            seed: job.seed,
            robot: job.arm.name().to_owned(),
            verdict,
            headline,
            sponge_radius_m: job.workcell.tool.sponge.radius_m,
            clearance_required_m: job.requirements.clearance_m,
            coverage_required,
            findings: findings(self, &plates),
            plates,
            transits,
            planned,
            executed,
            clearance_pairs: pairs.map(|(a, b)| [a.to_owned(), b.to_owned()]).collect(),
            duration_s: self.planned.duration_s(),
        })
    }
}

impl PaperReport {
    /// Number of plates that count as washed.
    #[must_use]
    pub fn plates_washed(&self) -> usize {
        sum(&self.plates, |plate| plate.washed.into())
    }

    /// Waypoints solved and asked.
    #[must_use]
    pub fn waypoints_reached(&self) -> [usize; 2] {
        [
            sum(&self.plates, |plate| plate.reached) + self.transits.reached,
            sum(&self.plates, |plate| plate.waypoints) + self.transits.waypoints,
        ]
    }
}

fn sum(plates: &[PlateReport], of: fn(&PlateReport) -> usize) -> usize {
    plates.iter().map(of).sum()
}

/// Returns the verdict on the run, and the first line of its report: does it wash, and the main reasons if not.
fn judged(
    plates: &[PlateReport],
    transits: &WaypointReport,
    [planned, executed]: [&MotionReport; 2],
    required_coverage: f64,
) -> (Verdict, String) {
    let all_washed = plates.iter().all(|plate| plate.washed);
    let washed = part_of(sum(plates, |plate| plate.washed.into()), plates.len(), "plate");
    let asked = sum(plates, |plate| plate.waypoints);
    let unreached = asked - sum(plates, |plate| plate.reached);
    let unreached_between = transits.waypoints - transits.reached;
    let violations = planned.violations.iter().chain(&executed.violations);
    let (too_near, broken): (Vec<_>, Vec<_>) = violations.partition(|v| v.kind == ViolationKind::Clearance);
    if all_washed && unreached_between == 0 && too_near.is_empty() && broken.is_empty() {
        let headline = format!("SWEPT: {washed}, every limit kept; contact was not judged.");
        return (Verdict::Swept, headline);
    }
    let mut reasons = Vec::new();
    if unreached > 0 {
        reasons.push(format!("{unreached} of {asked} washing waypoints out of reach"));
    }
    if unreached_between > 0 {
        let of = transits.waypoints;
        reasons.push(format!(
            "{unreached_between} of {of} waypoints between plates out of reach"
        ));
    }
    let off = asked - sum(plates, |plate| plate.in_contact);
    if off > 0 {
        reasons.push(format!("the sponge off the plate at {off} of {asked} waypoints"));
    }
    if !too_near.is_empty() {
        reasons.push("too little clearance".to_owned());
    }
    let least = plates.iter().map(|p| p.executed_coverage.lower).fold(1.0, f64::min);
    if least < required_coverage {
        reasons.push(format!("as little as {} % of a plate swept", percent(least)));
    }
    if !broken.is_empty() {
        reasons.push("joint limits broken".to_owned());
    }
    let word = if all_washed {
        "SWEPT, LIMITS BROKEN"
    } else {
        "NOT SWEPT"
    };
    let comes_too_near = planned.violations.iter().any(|v| v.kind == ViolationKind::Clearance);
    let verdict = if unreached + unreached_between > 0 || comes_too_near {
        Verdict::Infeasible
    } else {
        Verdict::NotVerified
    };
    (verdict, format!("{word}: {washed} swept; {}.", reasons.join(", ")))
}
