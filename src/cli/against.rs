//! A plan against the scenario that it should be a plan of, or the plan that it should be a dry run of.

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
    other: Other,
    terms: JobTerms,
    /// Its arm.
    pub arm: Arc<RobotModel>,
}

/// Where a plan is another one than it should be.
#[derive(Debug, Serialize)]
pub struct Against {
    #[serde(flatten)]
    other: Other,
    differences: Vec<Difference>,
}

/// What a plan should be of.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
enum Other {
    Scenario { scenario: String, seed: u64 },
    Parent { hash: Option<String> },
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
                other: Other::Scenario {
                    scenario: scenario.name.clone(),
                    seed: scenario.seed,
                },
                arm,
            })
        });
        asked.map_err(|failure| options.failure(failure))
    }

    /// Compares every field of a job with what is asked for.
    pub fn compare(&self, found: &JobTerms) -> Against {
        Against {
            other: self.other.clone(),
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
    /// The fields in which a dry run differs from one of the plan with a hash.
    pub fn parent(hash: Option<String>, differences: Vec<Difference>) -> Self {
        let other = Other::Parent { hash };
        Self { other, differences }
    }

    /// Whether the plan is what it should be.
    pub fn agrees(&self) -> bool {
        self.differences.is_empty()
    }

    /// What stands before everything else; nothing where they agree.
    pub fn first_words(&self) -> String {
        let count = fields_differ(self.differences.len());
        match &self.other {
            _ if self.agrees() => String::new(),
            Other::Scenario { .. } => format!("OTHER JOB than that of {}: {count}; ", self.other),
            Other::Parent { .. } => format!("NO DRY RUN of the plan given: {count}; "),
        }
    }
}

impl fmt::Display for Other {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scenario { scenario, seed } => write!(f, "{}, seed {seed}", quoted(scenario)),
            Self::Parent { hash } => f.write_str(hash.as_deref().unwrap_or("without a hash")),
        }
    }
}

impl fmt::Display for Against {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { other, differences } = self;
        let count = fields_differ(differences.len());
        let says = match other {
            Other::Scenario { .. } => {
                writeln!(f, "against {other}: {count}")?;
                "the scenario"
            }
            Other::Parent { .. } => {
                let from = if self.agrees() {
                    " from what a dry run must have"
                } else {
                    ""
                };
                writeln!(
                    f,
                    "dry run of {other}: {count}{from}; that plan itself is not proved here"
                )?;
                "a dry run"
            }
        };
        differences.iter().try_for_each(|difference| {
            let Difference { key, found, expected } = difference;
            writeln!(f, "  {key}: the plan says {found}, {says} {expected}")
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
