//! Execution of a plan by an arm: simulated, followed without a plant, recorded, or still to come.

use super::coverage::{self, PlateCoverage};
use super::error::ViewError;
use super::numbers::Numbers;
use super::thin::thinned;
use super::tips::{Tip, Tips};
use platewash_certificate as proved;
use platewash_kinematics::JointVector;
use platewash_motion::csv::{RecordedMotion, RecordedSample};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::Trajectory;
use platewash_simulator::{self as simulator, SimulationReport};
use platewash_workcell::simulation::ControlLawName;
use serde::Serialize;
use ts_rs::TS;

/// Time between two samples at least \[s\].
const LEAST_STEP_S: f64 = 0.01;

/// Greatest number of samples: a base, and an addition per plate.
const MOST_SAMPLES: [usize; 2] = [1500, 250];

/// Time between two moments of a wash at least \[s\].
const WASH_STEP_S: f64 = 4e-3;

/// Largest delay of the end of a motion after the plan's end \[s\].
const SLACK_S: f64 = 1.0;

/// Source of an execution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// A simulation.
    Simulated,
    /// A recorded motion.
    Recorded,
    /// A simulation that is running: there are no samples yet.
    Live,
}

/// Facts about an execution besides its samples.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct ExecutionFacts {
    /// Source of the execution.
    pub source: Source,
    /// The control law, where it is known.
    pub law: Option<ControlLawName>,
    /// First line of its report, where there is one.
    pub headline: Option<String>,
    /// True where every plate is washed; `None` where that is not judged.
    pub washed: Option<bool>,
    /// Six limits \[N·m\]; `None` where not all are known.
    pub torque_limit_n_m: Option<[f64; 6]>,
}

impl ExecutionFacts {
    /// Facts about an execution of which only the source is known.
    fn new(source: Source, law: Option<ControlLawName>) -> Self {
        Self {
            source,
            law,
            headline: None,
            washed: None,
            torque_limit_n_m: None,
        }
    }
}

/// Executed motion, sample by sample.
#[derive(Debug, Clone, PartialEq)]
pub struct ExecutedMotion {
    facts: ExecutionFacts,
    samples: Vec<RecordedSample>,
}

impl ExecutedMotion {
    /// A simulation with its report. Under a kinematic law there are no torques.
    #[must_use]
    pub fn simulated(execution: &simulator::Execution, report: &SimulationReport) -> Self {
        let driven = !report.law.is_kinematic();
        let samples = execution.samples.iter().map(|sample| RecordedSample {
            t_s: sample.t_s,
            q: sample.state.q,
            qd: sample.state.qd,
            qdd: sample.qdd,
            torque: driven.then_some(sample.torque),
            force_n: None,
        });
        let told = ExecutionFacts {
            headline: Some(report.headline.clone()),
            // A dry run has no requirements on washing.
            washed: report.dry_run.is_none().then_some(report.verdict.is_done()),
            torque_limit_n_m: execution.limits.and_then(|limits| all(limits.0)),
            ..ExecutionFacts::new(Source::Simulated, Some(report.law))
        };
        let samples = samples.collect();
        Self { facts: told, samples }
    }

    /// A motion that a kinematic law made of the commands, as the paper's program does; `headline` is the first line of its report.
    #[must_use]
    pub fn followed(motion: &Trajectory, law: ControlLawName, headline: &str, washed: bool) -> Self {
        let states = motion.times().iter().filter_map(|t_s| Some((*t_s, motion.at(*t_s)?)));
        let samples = states.map(|(t_s, state)| RecordedSample {
            t_s,
            q: state.q,
            qd: state.qd,
            qdd: state.qdd,
            torque: None,
            force_n: None,
        });
        let told = ExecutionFacts {
            headline: Some(headline.to_owned()),
            washed: Some(washed),
            ..ExecutionFacts::new(Source::Simulated, Some(law))
        };
        let samples = samples.collect();
        Self { facts: told, samples }
    }

    /// A recorded motion: only its samples are known.
    #[must_use]
    pub fn recorded(motion: &RecordedMotion) -> Self {
        Self {
            facts: ExecutionFacts::new(Source::Recorded, None),
            samples: motion.samples.clone(),
        }
    }

    /// A simulation under a law that begins now: its samples come as it runs.
    #[must_use]
    pub fn live(law: ControlLawName, torque_limit_n_m: [Option<f64>; 6]) -> Self {
        let told = ExecutionFacts {
            torque_limit_n_m: all(torque_limit_n_m),
            ..ExecutionFacts::new(Source::Live, Some(law))
        };
        let samples = Vec::new();
        Self { facts: told, samples }
    }
}

/// All six, or none.
fn all(limits: [Option<f64>; 6]) -> Option<[f64; 6]> {
    let known: Option<Vec<f64>> = limits.into_iter().collect();
    known.and_then(|known| known.try_into().ok())
}

/// Executed motion, as it is shown.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Execution {
    /// Facts about it.
    #[serde(flatten)]
    pub told: ExecutionFacts,
    /// \[n\] \[s\].
    pub t_s: Numbers,
    /// \[n, 6\] \[rad\].
    pub q_rad: Numbers,
    /// \[n, 6\] \[rad/s\].
    pub qd_rad_s: Numbers,
    /// \[n, 6\] \[rad/s²\].
    pub qdd_rad_s2: Option<Numbers>,
    /// \[n, 6\] \[N·m\]; `None` where no torques are known.
    pub torque_n_m: Option<Numbers>,
    /// \[n\]: distance of the tip from where the plan has it at that time \[m\].
    pub error_m: Numbers,
    /// Swept area.
    pub coverage: Vec<PlateCoverage>,
}

impl Execution {
    /// `cells`: those of all coverage rasters together, about.
    ///
    /// # Errors
    /// [`ViewError::BeyondEnd`].
    pub(super) fn new(
        executed: &ExecutedMotion,
        plan: &Plan,
        tips: &Tips<'_>,
        certificate: Option<&proved::Certificate>,
        cells: usize,
    ) -> Result<Self, ViewError> {
        let (samples, plan_s) = (&executed.samples, plan.duration_s());
        let end_s = samples.last().map_or(0.0, |sample| sample.t_s);
        if end_s > plan_s + SLACK_S {
            let slack_s = SLACK_S;
            return Err(ViewError::BeyondEnd { end_s, plan_s, slack_s });
        }
        let shown = thinned_samples(samples, plan.job.plates.len());
        let off_m = |sample: &&RecordedSample| {
            let planned = tips.at(sample.t_s)?.at;
            Some((tips.tip(&sample.q, sample.t_s).at - planned).norm())
        };
        let coverage = if samples.is_empty() {
            Vec::new()
        } else {
            coverage::plates(plan, certificate, cells, |span| tip_between(samples, tips, span))
        };
        Ok(Self {
            told: executed.facts.clone(),
            t_s: Numbers::f64([shown.len()], shown.iter().map(|sample| sample.t_s)),
            q_rad: Numbers::f32_rows(shown.iter().map(|sample| &sample.q)),
            qd_rad_s: Numbers::f32_rows(shown.iter().map(|sample| &sample.qd)),
            qdd_rad_s2: column(&shown, |sample| Some(&sample.qdd)),
            torque_n_m: column(&shown, |sample| sample.torque.as_ref()),
            error_m: Numbers::f32(
                [shown.len()],
                shown.iter().map(|sample| off_m(sample).unwrap_or(f64::NAN) as f32),
            ),
            coverage,
        })
    }
}

/// The samples that are shown.
fn thinned_samples(samples: &[RecordedSample], plates: usize) -> Vec<&RecordedSample> {
    let most = MOST_SAMPLES[0] + MOST_SAMPLES[1] * plates;
    let [first_s, last_s] = [samples.first(), samples.last()].map(|sample| sample.map_or(0.0, |sample| sample.t_s));
    let step_s = LEAST_STEP_S.max((last_s - first_s) / (most - 1) as f64);
    thinned(samples, is_later(step_s))
}

/// A column that is shown where every sample has it, and there are samples.
fn column<'a>(
    samples: &[&'a RecordedSample],
    of: impl Fn(&'a RecordedSample) -> Option<&'a JointVector>,
) -> Option<Numbers> {
    let rows: Option<Vec<&JointVector>> = samples.iter().map(|sample| of(sample)).collect();
    rows.filter(|rows| !rows.is_empty())
        .map(|rows| Numbers::f32_rows(rows.into_iter()))
}

/// The executed tip from one time to another \[s\], as the samples have it.
fn tip_between(samples: &[RecordedSample], tips: &Tips<'_>, [from_s, to_s]: [f64; 2]) -> Vec<Tip> {
    let first = samples.partition_point(|sample| sample.t_s < from_s);
    let last = samples.partition_point(|sample| sample.t_s <= to_s);
    let during = thinned(samples.get(first..last).unwrap_or_default(), is_later(WASH_STEP_S));
    during
        .into_iter()
        .map(|sample| tips.tip(&sample.q, sample.t_s))
        .collect()
}

/// True from a time after a sample on, but for rounding.
fn is_later(step_s: f64) -> impl Fn(&RecordedSample, &RecordedSample) -> bool {
    move |last, sample| sample.t_s >= last.t_s + (1.0 - 1e-6) * step_s
}
