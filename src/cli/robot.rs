//! `platewash robot`: the arm as loaded.

use super::angles::Unit;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output;
use anyhow::anyhow;
use clap::Args;
use platewash::kinematics::AXES;
use platewash::workcell::clearance::ClearanceError;
use platewash::workcell::tool::StraightTool;
use platewash::{ClearanceModel, Plate, RobotModel, Tool, ToolFrame, Workcell};
use serde::Serialize;
use std::fmt::Write;

/// Arguments of `robot`.
#[derive(Debug, Args)]
pub struct RobotArguments {
    /// Find a home position, where plates can be washed, and pairs of links that need no check
    #[arg(long)]
    pub suggest: bool,
}

#[derive(Serialize)]
struct Answer {
    name: String,
    urdf_sha256: String,
    joints: Vec<JointRow>,
    frames: Vec<String>,
    tool_mount: Option<ToolMount>,
    reach_bound_m: f64,
    clearance_pairs: Vec<[String; 2]>,
}

/// The link that carries the tool.
#[derive(Serialize)]
struct ToolMount {
    link: String,
    /// Angle between its z axis, along which the tool leaves it, and the axis of joint 6 \[deg\].
    off_axis_6_deg: f64,
}

#[derive(Serialize)]
struct JointRow {
    name: String,
    child: String,
    lower_rad: f64,
    upper_rad: f64,
    lower_deg: f64,
    upper_deg: f64,
    velocity_rad_s: f64,
    velocity_deg_s: f64,
    effort_n_m: Option<f64>,
}

/// Shows joints, limits, frames and the pairs that are checked for clearance (the bare arm over the floor).
pub fn run(options: &Options) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let stated = scenario.tool.mounted_on.as_deref();
    let mount = robot.tool_mount(stated);
    if let (Err(error), Some(_)) = (&mount, stated) {
        return Err(Failure::input(anyhow!("tool.mounted_on: {error}")));
    }
    let clearance = clearance(&robot, bare(&robot), &[]).map_err(platewash::Failure::from)?;
    let answer = Answer {
        name: robot.name().to_owned(),
        urdf_sha256: robot.sha256().to_owned(),
        joints: (0..AXES).map(|i| joint(&robot, i)).collect(),
        frames: robot.links().iter().map(|l| l.name.clone()).collect(),
        tool_mount: mount.as_ref().ok().map(|frame| ToolMount {
            link: stated.unwrap_or(ToolFrame::Tool0.name()).to_owned(),
            off_axis_6_deg: frame.tilt_rad().to_degrees(),
        }),
        reach_bound_m: robot.reach_bound(&robot.last_link_frame()).1,
        clearance_pairs: clearance
            .pair_names()
            .into_iter()
            .map(|(a, b)| [a.to_owned(), b.to_owned()])
            .collect(),
    };
    let words = match (&answer.tool_mount, mount) {
        (Some(mount), _) => format!(
            "on link '{}', along its z axis, {:.1}° from the axis of joint 6",
            mount.link, mount.off_axis_6_deg
        ),
        (None, Err(error)) => format!("nowhere: {error}"),
        (None, Ok(_)) => "nowhere".to_owned(),
    };
    output::print_either(options.json, &answer, || text(&answer, &words))?;
    Ok(ExitCode::SUCCESS)
}

/// No tool body.
pub fn bare(robot: &RobotModel) -> Tool {
    Tool {
        // No link needs to be named for a tool that is not there.
        mounted_on: Some(robot.joints()[AXES - 1].child.clone()),
        ..Tool::from(StraightTool {
            length_m: 0.0,
            ..StraightTool::default()
        })
    }
}

/// The clearances of an arm over the floor, with its tool, among plates.
pub fn clearance(robot: &RobotModel, tool: Tool, plates: &[Plate]) -> Result<ClearanceModel, ClearanceError> {
    ClearanceModel::new(robot, &Workcell::on_floor(robot, tool)?, plates)
}

fn joint(robot: &RobotModel, i: usize) -> JointRow {
    let (joint, limits) = (&robot.joints()[i], robot.limits());
    JointRow {
        name: joint.name.clone(),
        child: joint.child.clone(),
        lower_rad: limits.lower[i],
        upper_rad: limits.upper[i],
        lower_deg: limits.lower[i].to_degrees(),
        upper_deg: limits.upper[i].to_degrees(),
        velocity_rad_s: limits.velocity[i],
        velocity_deg_s: limits.velocity[i].to_degrees(),
        effort_n_m: limits.effort[i],
    }
}

/// A limit as a number of `decimals` decimals that is inside it when it is typed in: the nearest one, or the next one inwards.
fn inwards(limit: f64, decimals: usize, unit: Unit, limit_rad: f64, end: End) -> String {
    let nearest = format!("{limit:.decimals$}");
    let inside = |text: &str| {
        let typed_rad = text.parse().map_or(f64::NAN, |angle| unit.to_radians(angle));
        match end {
            End::Lower => typed_rad >= limit_rad,
            End::Upper => typed_rad <= limit_rad,
        }
    };
    if inside(&nearest) {
        return nearest;
    }
    let step = format!("1e-{decimals}").parse().unwrap_or(0.0);
    let nearest = nearest.parse().unwrap_or(limit);
    match end {
        End::Lower => format!("{:.decimals$}", nearest + step),
        End::Upper => format!("{:.decimals$}", nearest - step),
    }
}

/// An end of a joint's range.
#[derive(Debug, Clone, Copy)]
enum End {
    Lower,
    Upper,
}

fn text(answer: &Answer, tool_mount: &str) -> String {
    let mut text = format!("{} (URDF SHA-256 {})\n\n", answer.name, answer.urdf_sha256);
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{:<12} {:>23} {:>22} {:>10} {:>9}  moves",
        "joint", "limits, deg", "limits, rad", "deg/s", "rad/s"
    );
    for j in &answer.joints {
        let degrees = [
            (j.lower_deg, j.lower_rad, End::Lower),
            (j.upper_deg, j.upper_rad, End::Upper),
        ]
        .map(|(deg, rad, end)| inwards(deg, 4, Unit::Degrees, rad, end))
        .join(" … ");
        let radians = [(j.lower_rad, End::Lower), (j.upper_rad, End::Upper)]
            .map(|(rad, end)| inwards(rad, 5, Unit::Radians, rad, end))
            .join(" … ");
        let _ = writeln!(
            text,
            "{:<12} {degrees:>23} {radians:>22} {:>10.1} {:>9.4}  {}",
            j.name, j.velocity_deg_s, j.velocity_rad_s, j.child
        );
    }
    let _ = writeln!(
        text,
        "\nreach of the last link, at most {:.3} m\nframes: {}\ntool mounted {tool_mount}",
        answer.reach_bound_m,
        answer.frames.join(", ")
    );
    let pairs: Vec<_> = answer
        .clearance_pairs
        .iter()
        .map(|[a, b]| format!("{a} – {b}"))
        .collect();
    let _ = writeln!(
        text,
        "\npairs checked for clearance ({}):\n  {}",
        pairs.len(),
        pairs.join("\n  ")
    );
    text
}
