//! What an arm did, however that is known: simulated, followed without a plant, recorded, or still to come.

use platewash_simulator::{Execution, SimulationReport};
use platewash_workcell::csv::{RecordedMotion, RecordedSample};
use platewash_workcell::simulation::ControlLawName;
use platewash_workcell::trajectory::Trajectory;
use serde::Serialize;

/// Where an execution comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// A simulation.
    Simulated,
    /// A recorded motion.
    Recorded,
    /// A simulation that is running: there are no samples yet.
    Live,
}

/// What an arm did with a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Executed {
    pub(super) source: Source,
    pub(super) law: Option<String>,
    pub(super) headline: Option<String>,
    pub(super) washed: Option<bool>,
    pub(super) samples: Vec<RecordedSample>,
    pub(super) torque_limit_n_m: Option<[f64; 6]>,
}

impl Executed {
    /// A simulation with its report. Under a kinematic law there are no torques.
    #[must_use]
    pub fn simulated(execution: &Execution, report: &SimulationReport) -> Self {
        let driven = !report.law.is_kinematic();
        let samples = execution.samples.iter().map(|sample| RecordedSample {
            t_s: sample.t_s,
            q: sample.state.q,
            qd: sample.state.qd,
            qdd: sample.qdd,
            torque: driven.then_some(sample.torque),
            force_n: None,
        });
        Self {
            headline: Some(report.headline.clone()),
            // Nothing is asked of a dry run that could be washed.
            washed: report.dry_run.is_none().then_some(report.verdict.is_done()),
            samples: samples.collect(),
            torque_limit_n_m: execution.limits.and_then(|limits| all(limits.0)),
            ..Self::of(Source::Simulated, Some(report.law))
        }
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
        Self {
            headline: Some(headline.to_owned()),
            washed: Some(washed),
            samples: samples.collect(),
            ..Self::of(Source::Simulated, Some(law))
        }
    }

    /// A recorded motion: nothing but its samples is known.
    #[must_use]
    pub fn recorded(motion: &RecordedMotion) -> Self {
        Self {
            samples: motion.samples.clone(),
            ..Self::of(Source::Recorded, None)
        }
    }

    /// A simulation under a law that begins now: its samples come as it runs.
    #[must_use]
    pub fn live(law: ControlLawName, torque_limit_n_m: [Option<f64>; 6]) -> Self {
        Self {
            torque_limit_n_m: all(torque_limit_n_m),
            ..Self::of(Source::Live, Some(law))
        }
    }

    /// An execution of which nothing is known but where it comes from.
    fn of(source: Source, law: Option<ControlLawName>) -> Self {
        Self {
            source,
            law: law.map(|law| law.name().to_owned()),
            headline: None,
            washed: None,
            samples: Vec::new(),
            torque_limit_n_m: None,
        }
    }
}

/// All six, or none.
fn all(limits: [Option<f64>; 6]) -> Option<[f64; 6]> {
    let known: Option<Vec<f64>> = limits.into_iter().collect();
    known.and_then(|known| known.try_into().ok())
}
