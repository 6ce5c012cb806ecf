//! The scenario file: everything that decides a job, in TOML with the unit in every key's name.
//!
//! [`keys`] is the one table of keys, units, ranges and meanings: it checks files and makes
//! `docs/scenario.md`. The defaults are those of the types here.

mod certified;
mod control;
mod document;
mod error;
mod ik;
mod job;
mod key;
pub mod keys;
mod layout;
mod limits;
mod load;
mod paths;
mod plant;
mod robot;
mod shipped;
mod transition;
mod units;
mod wash;
mod work;

pub use control::{ControlLawName, ControlSection, FeedForward, TIME_STEPS_S};
pub use document::reference;
pub use error::{Problem, ScenarioError};
pub use ik::{IkMethod, IkSection, IkSeed};
pub use job::{JobSection, OnFailure, OrderRule, Program};
pub use layout::{LayoutSection, Overlap, RegionName};
pub use limits::LimitsSection;
pub(crate) use load::check_seed;
pub use plant::{Integrator, PlantSection};
pub use platewash_workcell::tool::Tool;
pub use robot::{BuiltInArm, RobotSection};
pub use shipped::{SHIPPED, ShippedScenario};
pub use transition::{Interpolation, TransitionSection};
pub use units::UnitNote;
pub use wash::WashSection;
pub use work::{MAX_PLATE_CHECKS, MAX_STROKE_CHECKS, MAX_WAYPOINTS};

use platewash_kinematics::JointVector;
use platewash_workcell::arc::Arc;
use serde::{Deserialize, Serialize};

/// The largest seed: up to here every whole number is a JSON number of its own (RFC 8785 writes them all as doubles), so that no two
/// seeds are the same text in a plan file.
pub const MAX_SEED: u64 = (1 << 53) - 1;

/// A job in full: what a scenario file states, with defaults filled in. Ranges are checked by
/// [`Scenario::parse`] and [`Scenario::validate`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scenario {
    /// Name, for reports.
    pub name: String,
    /// Seed of every random stream.
    pub seed: u64,
    /// What counts as done.
    pub job: JobSection,
    /// The arm.
    pub robot: RobotSection,
    /// What it holds.
    pub tool: Tool,
    /// Where the plates lie.
    pub layout: LayoutSection,
    /// The path on a plate.
    pub wash: WashSection,
    /// Inverse kinematics along the path.
    pub ik: IkSection,
    /// The way between plates.
    pub transition: TransitionSection,
    /// Limits beyond those of the arm's description.
    pub limits: LimitsSection,
    /// How the arm follows.
    pub control: ControlSection,
    /// The arm as a physical system.
    pub plant: PlantSection,
}

impl Scenario {
    /// Joint positions at the start and at the end \[rad\].
    #[must_use]
    pub fn homes(&self) -> [JointVector; 2] {
        let start = self.robot.start_deg;
        [start, self.robot.home_deg.unwrap_or(start)].map(|deg| JointVector::from(deg).map(f64::to_radians))
    }

    /// Largest angle of the tool from a plate's normal \[rad\]: `wash.tilt_max_deg`, and no more than the sponge allows.
    ///
    /// The free sponge is a cylinder of height `h` and radius `s`, tilted by τ about the middle of its far face, which is in the
    /// plate's plane. The middle of its near face is at the height `h cos τ`, and the lowest point of the rim there `s sin τ` below:
    /// it is above the plate while `tan τ < h / s`. Beyond `atan(h / s)` the rim, and with it what holds the sponge, would have to
    /// go through the plate.
    #[must_use]
    pub fn tilt_max_rad(&self) -> f64 {
        let asked = self.wash.tilt_max_deg.to_radians();
        asked.min(crate::trig::atan2(self.tool.sponge_height_m, self.tool.sponge_radius_m))
    }

    /// The control law: the one stated, otherwise the paper's for the paper's program and computed torque for a certified job.
    #[must_use]
    pub fn law(&self) -> ControlLawName {
        self.control.law.unwrap_or(match self.job.program {
            Program::Paper => ControlLawName::Paper,
            Program::Certified => ControlLawName::ComputedTorque,
        })
    }

    /// The arc round the base.
    #[must_use]
    pub fn arc(&self) -> Arc {
        let section = &self.transition;
        Arc {
            points: section.mid_points,
            radius_m: section
                .mid_radius_m
                .unwrap_or((self.layout.base_radius_m + 0.1).max(0.3)),
            height_m: section.mid_height_m,
        }
    }
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            name: "unnamed".to_owned(),
            seed: 1,
            job: JobSection::default(),
            robot: RobotSection::default(),
            tool: Tool::default(),
            layout: LayoutSection::default(),
            wash: WashSection::default(),
            ik: IkSection::default(),
            transition: TransitionSection::default(),
            limits: LimitsSection::default(),
            control: ControlSection::default(),
            plant: PlantSection::default(),
        }
    }
}
