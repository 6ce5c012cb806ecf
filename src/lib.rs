//! platewash plans, checks and reports the washing of plates by an ABB IRB 120 or another six-axis arm.
//!
//! This crate is a façade: it re-exports the nouns that users need and holds no logic of its own. Units are SI
//! and radians, poses are `T_base_frame`; see the conventions in [`kinematics`].
//!
//! ```
//! use platewash::{Job, Scenario};
//!
//! let scenario = Scenario::load("paper-appendix")?;
//! let job = Job::run(&scenario)?;
//! let report = job.report()?;
//! assert!(report.headline.starts_with("NOT WASHED")); // what the paper's program really does
//! for plate in &report.plates {
//!     let (reached, asked) = (plate.reached, plate.waypoints);
//!     let swept = 100.0 * plate.executed_coverage.fraction;
//!     assert!(reached <= asked && swept < 60.0);
//! }
//! # Ok::<(), platewash::PlanError>(())
//! ```

#[cfg(feature = "command")]
pub mod cli;

// The command is written as a user of this library would write it.
#[cfg(feature = "command")]
extern crate self as platewash;

pub use platewash_kinematics as kinematics;
pub use platewash_planner as planner;
pub use platewash_simulator as simulator;
pub use platewash_workcell as workcell;

pub use platewash_kinematics::ik::{IkError, IkFailure, IkSettings, IkSolution, IkSolver};
pub use platewash_kinematics::{Axes, Frame, Jacobian, JointLimits, JointVector, Pose, RobotModel, ToolFrame};
pub use platewash_planner::certificate::{Certificate, Promise, VerifyError};
pub use platewash_planner::cycle::{Cycle, CycleReport};
pub use platewash_planner::job::{Job, PlanError};
pub use platewash_planner::plan::Plan;
pub use platewash_planner::report::{JobReport, Verdict};
pub use platewash_planner::reproduce::{Reproduction, reproduce};
pub use platewash_planner::scenario::Scenario;
pub use platewash_planner::tool_path::ToolPath;
pub use platewash_simulator::{
    DynamicsError, DynamicsModel, Energy, Execution, Setup, SimulationError, SimulationReport, SimulationVerdict,
    simulate, tune,
};
pub use platewash_workcell::clearance::{ClearanceModel, PairClearance};
pub use platewash_workcell::coverage::{Coverage, coverage};
pub use platewash_workcell::layout::{Layout, Plate, Region};
pub use platewash_workcell::trajectory::Trajectory;

/// The example in the README, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeExample;
