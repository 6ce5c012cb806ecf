//! Jobs for tests: those of the shipped scenarios, without their files.
//!
//! Functions named `kitchen…` belong to `kitchen-spiral`, without contact requirements; `contact_kitchen…` belong to `kitchen`.

use crate::arc::Arc;
use crate::job::{
    ContactRequirements, JobTerms, Limits, OrderRule, Overlap, Planner, PlannerSettings, ReachBorders, Requirements,
    WashJob,
};
use crate::plate::Plate;
use crate::simulation::{ControlLawName, ControlSettings, FoamContact, PlantSettings, SimulationSettings};
use crate::tool::{StraightTool, Tool};
use crate::workcell::Workcell;
use platewash_kinematics::{JointVector, RobotModel};

/// Returns whether tests try all of their cases, as `PLATEWASH_THOROUGH=1` asks, and not the part that is enough for most changes.
#[must_use]
pub fn is_thorough() -> bool {
    std::env::var_os("PLATEWASH_THOROUGH").is_some()
}

/// Returns the kitchen's tool for jobs without contact requirements: 150 mm long, with a sponge of 25 mm.
#[must_use]
pub fn kitchen_tool() -> Tool {
    Tool::from(StraightTool {
        length_m: 0.15,
        ..StraightTool::default()
    })
}

/// Returns a plate of the kitchen with its centre at `[x, y]` \[m\].
#[must_use]
pub fn kitchen_plate([x, y]: [f64; 2]) -> Plate {
    Plate::level_disc([x, y, 0.03], 0.145, 0.02)
}

/// Returns the plates of the shipped scenarios `kitchen` and `kitchen-spiral`, seed 1.
#[must_use]
pub fn kitchen_plates() -> Vec<Plate> {
    let centres = [
        [0.265_793_545_653_285_45, -0.194_424_167_605_078_8],
        [0.104_474_020_185_935_73, 0.357_812_449_470_351_96],
        [0.292_301_782_633_575_1, 0.109_926_683_200_943_51],
        [0.008_604_206_487_816_731, -0.351_735_697_978_640_1],
    ];
    centres.into_iter().map(kitchen_plate).collect()
}

/// Returns an arm on the floor with a tool.
#[must_use]
#[allow(clippy::unwrap_used, reason = "fixtures are for tests")]
pub fn workcell(robot: &RobotModel, tool: Tool) -> Workcell {
    Workcell::on_floor(robot, tool).unwrap()
}

/// Returns the terms of the shipped scenario `kitchen-spiral`, for some plates.
#[must_use]
pub fn kitchen_terms(robot: &RobotModel, plates: Vec<Plate>) -> JobTerms {
    let home = JointVector::from([0.0, 0.0, 0.0, 0.0, 90.0, 0.0]).map(f64::to_radians);
    JobTerms {
        workcell: workcell(robot, kitchen_tool()),
        plates,
        requirements: Requirements {
            coverage: 0.995,
            clearance_m: 0.01,
            tilt_rad: 15_f64.to_radians(),
            wash_speed_m_s: 0.25,
            wash_acceleration_m_s2: 4.0,
            overlap: Overlap::Fail,
            as_listed: false,
            landing_m_s: None,
            lifting_m_s: None,
            wrist_rad: None,
            contact: None,
            holder: None,
        },
        limits: Limits {
            joint_acceleration_rad_s2: [4.0, 4.0, 4.0, 5.0, 5.0, 6.0],
            tip_speed_m_s: 1.0,
            tip_acceleration_m_s2: 8.0,
        },
        home_rad: [home; 2],
        planner: Planner::Wash(PlannerSettings {
            path_radius_m: Some(0.12385),
            turns: Some(3.5),
            closing_ring: Some(true),
            pattern: None,
            tilt_rad: None,
            axis_share: None,
            lift_m: 0.03,
            order: OrderRule::Fastest,
            arc: Arc {
                points: 5,
                radius_m: 0.38,
                height_m: 0.25,
            },
            reach: ReachBorders::IRB_120,
            relocate: false,
        }),
        seed: 1,
        simulation: SimulationSettings {
            law: ControlLawName::ComputedTorque,
            control: ControlSettings::default(),
            plant: PlantSettings::default(),
            payload_kg: None,
        },
        dry_run: None,
        recovery: None,
        soils: Vec::new(),
        measured: Vec::new(),
    }
}

/// Returns the job of the shipped scenario `kitchen-spiral` with seed 1.
#[must_use]
pub fn kitchen() -> WashJob {
    job(kitchen_terms)
}

/// Returns the kitchen's tool for jobs with contact requirements: its sponge is compressed by 6.5 mm, and its stiffness is stated.
#[must_use]
pub fn contact_kitchen_tool() -> Tool {
    Tool::from(StraightTool {
        length_m: 0.15,
        sponge_compression_m: 0.0065,
        sponge_stiffness_pa: Some([11e3, 44e3]),
        ..StraightTool::default()
    })
}

/// Returns the contact requirements of the shipped scenario `kitchen`.
#[must_use]
pub fn kitchen_contact() -> ContactRequirements {
    ContactRequirements {
        compression_m: 0.001,
        height_error_m: 0.001,
        share: 0.995,
        strain: 0.6,
        force_n: [1.0, 40.0],
        time_s: 0.05,
        time_share: 0.98,
        dose_pa_m: 25.0,
        dose_share: 0.98,
    }
}

/// Returns the terms of the shipped scenario `kitchen`, for some plates.
#[must_use]
pub fn contact_kitchen_terms(robot: &RobotModel, plates: Vec<Plate>) -> JobTerms {
    let spiral = kitchen_terms(robot, plates);
    let planner = spiral.planner_settings().map(|settings| PlannerSettings {
        path_radius_m: None,
        turns: None,
        closing_ring: None,
        ..*settings
    });
    JobTerms {
        workcell: workcell(robot, contact_kitchen_tool()),
        requirements: Requirements {
            landing_m_s: Some(0.05),
            lifting_m_s: Some(0.05),
            wrist_rad: Some(3_f64.to_radians()),
            contact: Some(kitchen_contact()),
            ..spiral.requirements
        },
        planner: planner.map_or(spiral.planner, Planner::Wash),
        simulation: SimulationSettings {
            control: ControlSettings {
                frequency_rad_s: 80.0,
                ..ControlSettings::default()
            },
            plant: PlantSettings {
                contact: Some(FoamContact {
                    stiffness_pa: 22e3,
                    damping_pa_s: 0.0,
                }),
                ..PlantSettings::default()
            },
            ..spiral.simulation
        },
        ..spiral
    }
}

/// Returns the job of the shipped scenario `kitchen` with seed 1.
#[must_use]
pub fn contact_kitchen() -> WashJob {
    job(contact_kitchen_terms)
}

#[allow(clippy::unwrap_used, reason = "fixtures are for tests")]
fn job(terms: impl Fn(&RobotModel, Vec<Plate>) -> JobTerms) -> WashJob {
    let robot = RobotModel::irb120().unwrap();
    let terms = terms(&robot, kitchen_plates());
    WashJob::new(std::sync::Arc::new(robot), terms).unwrap()
}
