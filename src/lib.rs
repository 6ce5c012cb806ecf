//! platewash plans, proves, simulates and reports the washing of plates by an ABB IRB 120 or another six-axis arm.
//!
//! This crate is a façade: the nouns and verbs that users need stand at its root, the rest in a module a crate. Units are SI and
//! radians; see the conventions in [`kinematics`].
//!
//! ```
//! use platewash::{Scenario, plan, prove, simulate};
//!
//! let job = Scenario::load("kitchen")?.job()?;
//! let plan = plan(&job)?.plan;
//! let certificate = prove(&plan, job.arm())?;
//! assert!(certificate.headline.starts_with("PROVED"));
//! let execution = simulate(&plan, job.arm(), &plan.job.simulation)?;
//! assert!(execution.samples.len() > 1000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "command")]
pub mod cli;
mod report;
mod spirals;

// The command is written as a user of this library would write it.
#[cfg(feature = "command")]
extern crate self as platewash;

pub use platewash_bodies as bodies;
pub use platewash_certificate as certificate;
pub use platewash_editor as editor;
pub use platewash_export as export;
pub use platewash_kinematics as kinematics;
pub use platewash_motion as motion;
pub use platewash_motion_proof as motion_proof;
pub use platewash_paper as paper;
pub use platewash_planner as planner;
pub use platewash_scenario as scenario;
#[cfg(feature = "command")]
pub use platewash_server as server;
pub use platewash_simulator as simulator;
pub use platewash_study as study;
pub use platewash_viewer as viewer;
pub use platewash_workcell as workcell;

// The way through: a scenario states a job, a job is planned, a plan is proved and simulated.
pub use platewash_certificate::{Certificate, Certified, Check, ProveError, Requirement, certify, prove};
pub use platewash_motion_proof::{MotionReport, judged_motion, prove_motion};
pub use platewash_planner::{PlanError, PlannedJob, plan};
pub use platewash_scenario::{Failure, Scenario, ScenarioError};
pub use platewash_simulator::{Execution, SimulationError, SimulationReport, SimulationVerdict, simulate, tune};
pub use platewash_study::sweep;
pub use report::WashReport;
pub use spirals::paper_spirals;

// What they speak of.
pub use platewash_bodies::clearance::{ClearanceModel, PairClearance};
pub use platewash_bodies::job::WashJob;
pub use platewash_kinematics::ik::{IkError, IkFailure, IkSettings, IkSolution, IkSolver};
pub use platewash_kinematics::{Axes, Frame, Jacobian, JointVector, Pose, RobotModel, ToolFrame};
pub use platewash_motion::plan::Plan;
pub use platewash_motion::trajectory::Trajectory;
pub use platewash_paper::{PaperJob, PaperReport, PaperRun};
pub use platewash_simulator::{DynamicsError, DynamicsModel, Energy};
pub use platewash_workcell::Workcell;
pub use platewash_workcell::cancel::CancelToken;
pub use platewash_workcell::job::JobTerms;
pub use platewash_workcell::layout::Layout;
pub use platewash_workcell::plate::Plate;
pub use platewash_workcell::surface::Surface;
pub use platewash_workcell::tool::Tool;
pub use platewash_workcell::verdict::Verdict;

/// The example in the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeExample;
