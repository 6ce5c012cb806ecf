//! The report of a run.

use super::finding::{PaperFinding, findings};
use super::headline::{headline, verdict};
use super::motion::MotionReport;
use super::nearness::approaches;
use super::plate::{PlateReport, plates};
use super::transits::{TransitReport, transits};
use crate::error::PaperError;
use crate::run::PaperRun;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::verdict::Verdict;
use serde::Serialize;

/// How a run went. Lengths in metres, angles in radians, times in seconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PaperReport {
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
    /// The transits between them.
    #[serde(rename = "transitions")]
    pub transits: TransitReport,
    /// The commanded motion against the limits.
    pub planned: MotionReport,
    /// The executed motion against the limits.
    pub executed: MotionReport,
    /// What else is to be said.
    pub findings: Vec<PaperFinding>,
    /// The pairs of bodies that were checked for clearance, by name.
    pub clearance_pairs: Vec<[String; 2]>,
    /// Duration \[s\].
    pub duration_s: f64,
}

impl PaperRun {
    /// Judges the run: what was reached, how near it came, what it covered.
    ///
    /// # Errors
    /// [`PaperError::Clearance`] or [`PaperError::Coverage`].
    pub fn report(&self) -> Result<PaperReport, PaperError> {
        self.report_with(&CancelToken::new())
    }

    /// Judges the run for somebody who may give it up.
    ///
    /// # Errors
    /// As [`PaperRun::report`], and [`PaperError::Cancelled`].
    pub fn report_with(&self, cancel: &CancelToken) -> Result<PaperReport, PaperError> {
        let job = &self.job;
        let clearance = ClearanceModel::new(&job.arm, &job.workcell, &job.layout.plates)?;
        let approaches = approaches(self, &clearance, cancel)?;
        let plates = plates(self, &approaches)?;
        let transits = transits(self, &approaches);
        let planned = MotionReport::new(self, &self.planned, approaches.iter().map(|a| &a.planned));
        let executed = MotionReport::new(self, &self.executed, approaches.iter().map(|a| &a.executed));
        let findings = findings(self, &plates);
        let required = job.requirements.coverage;
        let verdict = verdict(&plates, &transits, &planned, &executed);
        let pairs = clearance.pair_names().into_iter();
        Ok(PaperReport {
            scenario: job.name.clone(),
            seed: job.seed,
            robot: job.arm.name().to_owned(),
            verdict,
            headline: headline(verdict, &plates, &transits, &planned, &executed, required),
            sponge_radius_m: job.workcell.tool.sponge.radius_m,
            clearance_required_m: job.requirements.clearance_m,
            coverage_required: required,
            plates,
            transits,
            planned,
            executed,
            findings,
            clearance_pairs: pairs.map(|(a, b)| [a.to_owned(), b.to_owned()]).collect(),
            duration_s: self.planned.duration_s(),
        })
    }
}

impl PaperReport {
    /// How many plates count as washed.
    #[must_use]
    pub fn plates_washed(&self) -> usize {
        self.sum(|p| usize::from(p.washed))
    }

    /// Waypoints solved and asked.
    #[must_use]
    pub fn waypoints_reached(&self) -> [usize; 2] {
        [
            self.sum(|p| p.reached) + self.transits.reached,
            self.sum(|p| p.waypoints) + self.transits.waypoints,
        ]
    }

    fn sum(&self, of: fn(&PlateReport) -> usize) -> usize {
        self.plates.iter().map(of).sum()
    }
}
