//! The stages of a certified job on one core, each with what the stages before it made.

use nalgebra::Vector3;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_planner::certificate;
use platewash_planner::cycle::Cycle;
use platewash_planner::job;
use platewash_planner::joint_path::{Ends, JointPath};
use platewash_planner::plan::Plan;
use platewash_planner::posture::{Cell, PostureSettings, Washing, washing};
use platewash_planner::robot;
use platewash_planner::scenario::Scenario;
use platewash_planner::timing::{self, MotionLimits, TipLimits};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::layout::Layout;
use platewash_workcell::stroke::Stroke;
use platewash_workcell::tool;
use std::error::Error;
use std::hint::black_box;

/// One stage, or the whole of several.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The plates are placed.
    Layout,
    /// Tilt and branch along the stroke on one plate.
    Posture,
    /// The motion along one plate's stroke.
    Timing,
    /// All stages of planning: from the scenario to the motion of the whole cycle.
    Plan,
    /// The plan file's text, sealed.
    Seal,
    /// The text is read and checked.
    Read,
    /// The certificate.
    Verify,
}

impl Stage {
    /// All, in the order of the job, with the names that benchmarks give them.
    pub const ALL: [(Self, &'static str); 7] = [
        (Self::Layout, "layout"),
        (Self::Posture, "posture of one plate"),
        (Self::Timing, "timing of one wash"),
        (Self::Plan, "plan, whole cycle"),
        (Self::Seal, "seal and write"),
        (Self::Read, "read"),
        (Self::Verify, "verify"),
    ];
}

/// A job whose stages can be run again and again.
#[derive(Debug)]
pub struct Stages {
    scenario: Scenario,
    robot: RobotModel,
    layout: Layout,
    path: JointPath,
    limits: MotionLimits,
    cycle: Cycle,
    plan: Plan,
    text: String,
}

impl Stages {
    /// The stages of a shipped scenario.
    ///
    /// # Errors
    /// Those of planning.
    pub fn new(scenario: &str) -> Result<Self, Box<dyn Error>> {
        let scenario = Scenario::load(scenario)?;
        let robot = robot::load(&scenario.robot)?;
        let layout = job::place_plates(&scenario, &robot)?;
        let washed = posture(&scenario, &robot, &layout)?;
        let cycle = Cycle::plan(&scenario)?;
        let plan = cycle.to_plan()?;
        Ok(Self {
            path: JointPath::through(washed.theta, washed.q, Ends::Clamped(washed.end_slopes))?,
            limits: MotionLimits {
                velocity: robot.limits().velocity,
                acceleration: JointVector::from(scenario.limits.joint_acceleration_rad_s2),
                tip: Some(TipLimits {
                    speed_m_s: scenario.wash.speed_m_s,
                    acceleration_m_s2: scenario.wash.acceleration_m_s2,
                }),
            },
            text: plan.to_json()?,
            scenario,
            robot,
            layout,
            cycle,
            plan,
        })
    }

    /// Runs one stage.
    ///
    /// # Errors
    /// Those of the stage.
    pub fn run(&self, stage: Stage) -> Result<(), Box<dyn Error>> {
        match stage {
            Stage::Layout => drop(black_box(job::place_plates(&self.scenario, &self.robot)?)),
            Stage::Posture => drop(black_box(posture(&self.scenario, &self.robot, &self.layout)?)),
            Stage::Timing => {
                let tip = tool::tip_frame(&self.robot, &self.scenario.tool);
                drop(black_box(timing::time_optimal(
                    &self.path,
                    &self.robot,
                    &tip,
                    &self.limits,
                )?));
            }
            Stage::Plan => drop(black_box(Cycle::plan(&self.scenario)?)),
            Stage::Seal => drop(black_box(self.cycle.to_plan()?.to_json()?)),
            Stage::Read => drop(black_box(Plan::from_json(&self.text)?)),
            Stage::Verify => drop(black_box(certificate::verify(&self.plan, &self.robot)?)),
        }
        Ok(())
    }
}

/// The posture for washing the first plate.
fn posture(scenario: &Scenario, robot: &RobotModel, layout: &Layout) -> Result<Washing, Box<dyn Error>> {
    let clearance = ClearanceModel::new(robot, &scenario.tool, &layout.plates)?;
    let cell = Cell::new(robot, &scenario.tool, &clearance, &layout.plates)?;
    let plate = layout.plates.first().ok_or("there are no plates")?;
    let stroke = Stroke {
        radius_m: scenario.wash.path_radius_m,
        turns: scenario.wash.turns,
        start_angle_rad: 0.0,
        closing_ring: true,
    };
    let settings = PostureSettings {
        tilt_max_rad: scenario.wash.tilt_max_deg.to_radians(),
        clearance_m: scenario.wash.clearance_m,
    };
    let centre = Vector3::new(plate.x_m, plate.y_m, plate.z_m);
    let [home, _] = scenario.homes();
    Ok(washing(&cell, &stroke, centre, 0, &settings, &home)?)
}
