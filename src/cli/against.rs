//! A plan against the scenario that it should be a plan of.

use super::failure::Failure;
use super::options::Options;
use super::progress::Progress;
use platewash::certificate::{Difference, differences};
use platewash::planner::Watch;
use platewash::scenario::Program;
use platewash::workcell::words::{counted, quoted};
use platewash::{JobTerms, RobotModel, Scenario};
use serde::Serialize;
use std::fmt;
use std::sync::Arc;

/// What a scenario asks for, resolved, its plates placed again.
pub struct Asked {
    scenario: String,
    seed: u64,
    terms: JobTerms,
    /// Its arm.
    pub arm: Arc<RobotModel>,
}

/// Where a plan's job is another one than a scenario asks for.
#[derive(Debug, Serialize)]
pub struct Against {
    scenario: String,
    seed: u64,
    differences: Vec<Difference>,
}

impl Asked {
    /// Resolves a scenario by its name or file, with the seed of `--seed`, otherwise this one.
    pub fn resolve(options: &Options, name: &str, seed: u64) -> Result<Self, Failure> {
        let options = Options {
            scenario: Some(name.to_owned()),
            seed: options.seed.or(Some(seed)),
            ..options.clone()
        };
        let scenario = options.scenario()?;
        let asked = scenario.arm().and_then(|arm| {
            Ok(Self {
                terms: terms(&options, &scenario, &arm)?,
                scenario: scenario.name.clone(),
                seed: scenario.seed,
                arm,
            })
        });
        asked.map_err(|failure| options.failure(failure))
    }

    /// Compares every field of a job with what is asked for.
    pub fn compare(&self, found: &JobTerms) -> Against {
        Against {
            scenario: self.scenario.clone(),
            seed: self.seed,
            differences: differences(found, &self.terms),
        }
    }
}

fn terms(options: &Options, scenario: &Scenario, arm: &Arc<RobotModel>) -> Result<JobTerms, platewash::Failure> {
    let progress = Progress::new(options.quiet, "placing the plates");
    let watch = Watch {
        tell: &|activity| progress.say("placing the plates", activity),
        cancel: &options.cancel,
    };
    match scenario.job.program {
        Program::Certified => {
            let layout = scenario.place(arm, &watch)?;
            Ok(scenario.job_on(arm, &layout)?.terms().clone())
        }
        Program::Paper => {
            let layout = scenario.layout(arm)?;
            Ok(scenario.paper_job_on(arm, layout)?.terms()?)
        }
    }
}

impl Against {
    /// Whether the plan's job is the one that is asked for.
    pub fn agrees(&self) -> bool {
        self.differences.is_empty()
    }

    /// What stands before everything else; nothing where the jobs agree.
    pub fn first_words(&self) -> String {
        match self.differences.len() {
            0 => String::new(),
            _ => format!("OTHER JOB than that of {}: {}; ", self.name(), self.count()),
        }
    }

    fn name(&self) -> String {
        format!("{}, seed {}", quoted(&self.scenario), self.seed)
    }

    fn count(&self) -> String {
        fields_differ(self.differences.len())
    }
}

impl fmt::Display for Against {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "against {}: {}", self.name(), self.count())?;
        self.differences.iter().try_for_each(|difference| {
            let Difference { key, found, expected } = difference;
            writeln!(f, "  {key}: the plan says {found}, the scenario {expected}")
        })
    }
}

/// How many fields of two jobs differ.
pub fn fields_differ(count: usize) -> String {
    match count {
        0 => "no field differs".to_owned(),
        1 => "1 field differs".to_owned(),
        several => format!("{} differ", counted(several, "field")),
    }
}
