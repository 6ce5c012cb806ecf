//! `platewash fk`: where the arm is, and how near it comes to itself and its surroundings.

use super::angles::JointArguments;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output::{self, Reader};
use super::robot;
use clap::Args;
use platewash::kinematics::LimitViolation;
use platewash::kinematics::model::manipulability;
use platewash::kinematics::words::{fixed, not_as_zero};
use platewash::{Axes, ClearanceModel, JointVector, PairClearance, Pose, RobotModel, Scenario, ToolFrame};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

/// Arguments of `fk`.
#[derive(Debug, Args)]
pub struct FkArguments {
    #[command(flatten)]
    joints: JointArguments,
    /// File with one configuration of six numbers on each line
    #[arg(long, value_name = "FILE")]
    file: Option<PathBuf>,
}

#[derive(Serialize)]
struct Answer {
    robot: String,
    configurations: Vec<Configuration>,
}

#[derive(Serialize)]
struct Configuration {
    q_rad: JointVector,
    q_deg: JointVector,
    within_limits: bool,
    beyond_limits: Vec<LimitViolation>,
    limit_margins_rad: JointVector,
    manipulability: f64,
    frames: BTreeMap<String, FramePose>,
    clearance: Vec<PairClearance>,
}

/// A pose as people and programs read it.
#[derive(Debug, Serialize)]
pub struct FramePose {
    /// \[m\].
    pub position_m: [f64; 3],
    /// Rows of the rotation matrix.
    pub rotation: [[f64; 3]; 3],
    /// (w, x, y, z).
    pub quaternion_wxyz: [f64; 4],
    /// URDF's roll, pitch, yaw \[rad\].
    pub rpy_rad: [f64; 3],
    /// They \[deg\].
    pub rpy_deg: [f64; 3],
}

impl From<&Pose> for FramePose {
    fn from(pose: &Pose) -> Self {
        let matrix = pose.rotation.to_rotation_matrix();
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        let q = pose.rotation.quaternion();
        Self {
            position_m: pose.translation.vector.into(),
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)])),
            quaternion_wxyz: [q.w, q.i, q.j, q.k],
            rpy_rad: [roll, pitch, yaw],
            rpy_deg: [roll, pitch, yaw].map(f64::to_degrees),
        }
    }
}

/// Poses of all frames, limit margins, manipulability and clearances. With `--scenario`, its tool, plates and obstacles count too.
pub fn run(options: &Options, arguments: &FkArguments) -> Result<ExitCode, Failure> {
    let configurations = arguments.joints.configurations(arguments.file.as_ref())?;
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let clearance = clearances(options, &scenario, &robot)?;
    let mut answers = configurations.iter().map(|q| configuration(&robot, &clearance, q));
    if options.json {
        let answer = Answer {
            robot: robot.name().to_owned(),
            configurations: answers.collect(),
        };
        output::print(&output::json(&answer)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    // One by one, as long as anybody reads them.
    for answer in &mut answers {
        if output::print(&super::text::text(&text(&answer)))? == Reader::Gone {
            break;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The pairs that are looked at: those of the arm by itself, and where `--scenario` states a cell those of its tool, plates and obstacles, too.
pub fn clearances(options: &Options, scenario: &Scenario, robot: &RobotModel) -> Result<ClearanceModel, Failure> {
    let clearance = if options.scenario.is_some() {
        let layout = scenario.layout(robot).map_err(platewash::Failure::from)?;
        let workcell = scenario.workcell(robot, layout.plates.len())?;
        ClearanceModel::new(robot, &workcell, &layout.plates)
    } else {
        robot::clearance(robot, robot::bare(robot), &[])
    };
    Ok(clearance.map_err(platewash::Failure::from)?)
}

/// The pair that comes nearest, a line; nothing where no pair is looked at.
pub fn smallest(clearance: &[PairClearance]) -> String {
    let least = clearance.iter().min_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
    least.map_or_else(String::new, |least| {
        format!(
            "smallest clearance: {:.2} mm, {} – {}\n",
            1e3 * least.distance_m,
            least.a,
            least.b
        )
    })
}

fn configuration(robot: &RobotModel, clearance: &ClearanceModel, q: &JointVector) -> Configuration {
    let poses = robot.fk(q);
    let mut frames: BTreeMap<_, _> = robot
        .links()
        .iter()
        .map(|l| (l.name.clone(), FramePose::from(&poses.pose(&l.frame))))
        .collect();
    if let Ok(frame) = robot.tool_frame(ToolFrame::MatlabTool0) {
        frames.insert(
            ToolFrame::MatlabTool0.name().to_owned(),
            FramePose::from(&poses.pose(&frame)),
        );
    }
    Configuration {
        q_rad: *q,
        q_deg: q.map(f64::to_degrees),
        within_limits: robot.limits().contain(q),
        beyond_limits: robot.limits().violations(q),
        limit_margins_rad: robot.limits().margins(q),
        manipulability: manipulability(&poses.jacobian(&robot.last_link_frame(), Axes::Base)),
        frames,
        clearance: clearance.all(q),
    }
}

fn text(c: &Configuration) -> String {
    let mut text = both_units(&c.q_rad);
    // Writing to a String cannot fail.
    let within = if c.within_limits { "yes" } else { "NO" };
    let _ = writeln!(text, "within limits: {within}; manipulability {:.3e}", c.manipulability);
    for beyond in &c.beyond_limits {
        let by = not_as_zero((beyond.position_rad - beyond.limit_rad).abs().to_degrees(), 2);
        let _ = writeln!(text, "  {beyond}, by {by}°");
    }
    let _ = writeln!(
        text,
        "\n{:<14} {:>28}   {:>27}   {:>25}",
        "frame", "position, mm", "roll, pitch, yaw, deg", "rad"
    );
    for (name, pose) in &c.frames {
        let [x, y, z] = pose.position_m.map(|v| fixed(1e3 * v, 3));
        let ([r, p, w], [a, b, d]) = (pose.rpy_deg.map(|v| fixed(v, 4)), pose.rpy_rad.map(|v| fixed(v, 5)));
        let _ = writeln!(
            text,
            "{name:<14} {x:>9} {y:>9} {z:>9} {r:>10} {p:>9} {w:>9} {a:>9} {b:>8} {d:>8}"
        );
    }
    if !c.clearance.is_empty() {
        let _ = writeln!(text, "\n{}", smallest(&c.clearance));
    }
    text
}

/// Joint positions in degrees and radians, two lines.
pub fn both_units(q: &JointVector) -> String {
    let line = |v: &JointVector, digits: usize| {
        let all = v.iter().map(|x| format!(" {:>12}", fixed(*x, digits)));
        all.collect::<String>()
    };
    format!("q, deg {}\nq, rad {}\n", line(&q.map(f64::to_degrees), 6), line(q, 9))
}
