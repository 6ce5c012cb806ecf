//! `platewash robot`: the arm as loaded, and with `--suggest` a home, where plates can be washed, and pairs of links that need no check.

use super::failure::ExitCode;
use super::files::Files;
use super::frame_pose::FramePose;
use super::options::Options;
use anyhow::{Context, Result};
use clap::Args;
use platewash::bodies::assembly;
use platewash::bodies::clearance::TouchingPairs;
use platewash::kinematics::controller_base::ControllerBase;
use platewash::kinematics::ik::analytic::AnalyticArm;
use platewash::kinematics::tool_mount::ToolMount;
use platewash::kinematics::urdf::{FixedJoints, FollowerLink, UnusedStatement};
use platewash::kinematics::words::{decimals_down, decimals_up};
use platewash::kinematics::{AXES, Link};
use platewash::planner::Watch;
use platewash::scenario::Suggestion;
use platewash::viewer::figures::{RegionMap, arm_outlines, draw_region};
use platewash::workcell::Obstacle;
use platewash::{ClearanceModel, DynamicsModel, Pose, RobotModel, Scenario, Tool, ToolFrame};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;
use std::time::Duration;

/// Time after which the map of `--suggest` is left as it is.
const MAP_TIME: Duration = Duration::from_secs(40);

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
    /// Joint accelerations that a plan keeps \[rad/s²\]: the lesser of the scenario's, which are assumed, and the description's.
    assumed_acceleration_rad_s2: [f64; AXES],
    /// Statements of the description that are not used.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unused_statements: Vec<UnusedStatement>,
    /// Joints that are held still, with their positions \[rad, or m for a prismatic joint\].
    #[serde(skip_serializing_if = "FixedJoints::is_empty")]
    fixed_joints: FixedJoints,
    /// Links that are left out, as joints carry them that follow an axis.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    left_out_links: Vec<FollowerLink>,
    links: Vec<LinkRow>,
    tool_mount: Option<ToolMountRow>,
    /// Reason that no link is known to carry the tool.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_tool_mount: Option<String>,
    /// Link from which the controller counts, where its frame is not that of the root link.
    #[serde(skip_serializing_if = "Option::is_none")]
    controller_base: Option<ControllerBaseRow>,
    inverse_kinematics: InverseKinematics,
    /// Reason that the arm cannot be simulated: masses that the description lacks.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_dynamics: Option<String>,
    /// Home of the scenario \[deg\]; without one, a clear home is looked for.
    start_deg: Option<[f64; AXES]>,
    reach_bound_m: f64,
    clearance_pairs: Vec<[String; 2]>,
}

/// Link of the description.
#[derive(Serialize)]
struct LinkRow {
    name: String,
    /// Number of the joint that moves it; 0 for the base.
    body: usize,
    collision_shapes: usize,
    /// True if convex parts that enclose a mesh are among these shapes.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_split: bool,
    visuals: usize,
    has_mass: bool,
}

/// The link that carries the tool.
#[derive(Serialize)]
struct ToolMountRow {
    link: String,
    /// Axis of the link along which the tool leaves it.
    axis: &'static str,
    /// True if the link is stated, or is `tool0`; false if names, axis 6 and shapes of the description tell it.
    is_stated: bool,
    /// True if that axis leads out of the arm along axis 6.
    leads_out: bool,
    /// Angle between that axis and the axis of joint 6 \[deg\].
    off_axis_6_deg: f64,
}

/// The controller's base, apart from the root link.
#[derive(Serialize)]
struct ControllerBaseRow {
    link: String,
    root: String,
    /// Pose of the link in the frame of the root link.
    #[serde(flatten)]
    pose: FramePose,
    words: String,
}

impl From<ControllerBase<'_>> for ControllerBaseRow {
    fn from(base: ControllerBase<'_>) -> Self {
        Self {
            link: base.link.to_owned(),
            root: base.root.to_owned(),
            pose: FramePose::from(&base.pose),
            words: base.to_string(),
        }
    }
}

/// Closed form of the inverse kinematics, or the reason that there is none.
#[derive(Serialize)]
struct InverseKinematics {
    closed_form: bool,
    /// Structure that makes the closed form possible.
    #[serde(skip_serializing_if = "Option::is_none")]
    structure: Option<&'static str>,
    /// First property that holds only up to the rounding of the description's numbers, or that does not hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
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
    /// Greatest acceleration of the description \[rad/s²\].
    #[serde(skip_serializing_if = "Option::is_none")]
    acceleration_rad_s2: Option<f64>,
    /// Greatest jerk of the description \[rad/s³\], which no plan keeps.
    #[serde(skip_serializing_if = "Option::is_none")]
    jerk_rad_s3: Option<f64>,
    /// True for a lower and an upper limit of a safety controller.
    #[serde(skip_serializing_if = "is_hard")]
    is_soft: [bool; 2],
    /// Friction of the description: torque per speed \[N·m·s/rad\], and torque against any motion \[N·m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    friction: Option<[f64; 2]>,
}

fn is_hard(is_soft: &[bool; 2]) -> bool {
    *is_soft == [false; 2]
}

/// Shows joints, limits, frames, what is known of the arm, and the pairs that are checked for clearance (the bare arm over the floor), or
/// suggests what suits the arm.
pub fn run(options: &Options, arguments: &RobotArguments) -> Result<ExitCode> {
    if arguments.suggest {
        return suggest(options);
    }
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let stated = scenario.tool.mounted_on.as_deref();
    let tool_mount = match stated {
        Some(text) => {
            robot.tool_mount(stated).context("tool.mounted_on")?;
            Ok(ToolMount::from_text(text))
        }
        None => robot.find_tool_mount().map_err(|error| error.to_string()),
    };
    let pairs = bare_clearance(&robot)?;
    let pairs = pairs.pair_names().into_iter();
    let answer = Answer {
        name: robot.name().to_owned(),
        urdf_sha256: robot.sha256().to_owned(),
        joints: (0..AXES).map(|i| JointRow::new(&robot, i)).collect(),
        assumed_acceleration_rad_s2: robot
            .limits()
            .within_acceleration(&scenario.limits.joint_acceleration_rad_s2.into())
            .into(),
        unused_statements: robot.unused_statements().to_vec(),
        fixed_joints: robot.fixed_joints().clone(),
        left_out_links: robot.left_out_links().to_vec(),
        links: robot.links().iter().map(|link| LinkRow::new(&robot, link)).collect(),
        no_tool_mount: tool_mount.as_ref().err().cloned(),
        tool_mount: tool_mount
            .ok()
            .map(|mount| ToolMountRow::new(&robot, mount, stated.is_some())),
        controller_base: robot.controller_base().map(ControllerBaseRow::from),
        inverse_kinematics: InverseKinematics::new(&robot),
        no_dynamics: DynamicsModel::new(&robot, None).err().map(|error| error.to_string()),
        start_deg: scenario.robot.start_deg,
        reach_bound_m: robot.reach_bound(&robot.last_link_frame()).1,
        clearance_pairs: pairs.map(|(a, b)| [a.to_owned(), b.to_owned()]).collect(),
    };
    options.print(&answer, || answer.text())?;
    Ok(ExitCode::Done)
}

impl LinkRow {
    fn new(robot: &RobotModel, link: &Link) -> Self {
        Self {
            name: link.name.clone(),
            body: link.frame.body(),
            collision_shapes: link.collision.len(),
            is_split: robot.split_links().contains(&link.name),
            visuals: link.visuals.len(),
            has_mass: link.inertial.is_some(),
        }
    }
}

impl ToolMountRow {
    fn new(robot: &RobotModel, mount: ToolMount<'_>, is_stated: bool) -> Self {
        let ToolMount { link, axis } = mount;
        let carrier = robot.links().iter().find(|other| other.name == link);
        let frame = robot.tool_mount(Some(&mount.to_string()));
        Self {
            link: link.to_owned(),
            axis: axis.name(),
            is_stated: is_stated || link == ToolFrame::Tool0.name(),
            leads_out: carrier.and_then(|link| robot.outward_axis(link)) == Some(axis),
            off_axis_6_deg: frame.map_or(f64::NAN, |frame| frame.tilt_rad().to_degrees()),
        }
    }

    fn text(&self) -> String {
        let Self { link, axis, .. } = self;
        let way = match self.leads_out {
            true => "out along axis 6".to_owned(),
            false => format!("{:.1}° from the axis of joint 6", self.off_axis_6_deg),
        };
        let found = match self.is_stated {
            true => "",
            false => "; found by names, axis 6 and shapes: check it, or state it as --tool-mount LINK:AXIS",
        };
        format!("tool mounted on link '{link}', along its {axis} axis, {way}{found}")
    }
}

impl InverseKinematics {
    fn new(robot: &RobotModel) -> Self {
        let (structure, reason) = match AnalyticArm::recognise(robot) {
            Ok(arm) => (
                Some(arm.structure()),
                arm.rounding().map(|rounding| rounding.to_string()),
            ),
            Err(mismatch) => (None, Some(mismatch.to_string())),
        };
        Self {
            closed_form: structure.is_some(),
            structure,
            reason,
        }
    }

    fn text(&self) -> String {
        match (self.structure, &self.reason) {
            (Some(structure), None) => format!("closed form ({structure})"),
            (Some(structure), Some(rounding)) => format!(
                "closed form ({structure}, but for rounded numbers: {rounding}), then Newton steps on the arm as described"
            ),
            (None, reason) => format!(
                "by iteration, no closed form, so that branches can be missed: {}",
                reason.as_deref().unwrap_or_default()
            ),
        }
    }
}

/// The clearances of an arm without a tool over the floor.
pub fn bare_clearance(robot: &RobotModel) -> Result<ClearanceModel, platewash::Failure> {
    let bare = assembly::workcell_without_tool(robot, Pose::identity(), vec![Obstacle::floor()])?;
    Ok(ClearanceModel::new(robot, &bare, &[])?)
}

impl JointRow {
    fn new(robot: &RobotModel, i: usize) -> Self {
        let (joint, limits) = (&robot.joints()[i], robot.limits());
        Self {
            name: joint.name.clone(),
            child: joint.child.clone(),
            lower_rad: limits.lower[i],
            upper_rad: limits.upper[i],
            lower_deg: limits.lower[i].to_degrees(),
            upper_deg: limits.upper[i].to_degrees(),
            velocity_rad_s: limits.velocity[i],
            velocity_deg_s: limits.velocity[i].to_degrees(),
            effort_n_m: limits.effort[i],
            acceleration_rad_s2: limits.acceleration[i],
            jerk_rad_s3: limits.jerk[i],
            is_soft: limits.is_soft[i],
            friction: Some([robot.friction().viscous[i], robot.friction().coulomb[i]]).filter(|both| *both != [0.0; 2]),
        }
    }
}

impl Answer {
    fn text(&self) -> String {
        let mut text = format!("{} (URDF SHA-256 {})\n\n", self.name, self.urdf_sha256);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{:<12} {:>23} {:>22} {:>10} {:>9}  moves",
            "joint", "limits, deg", "limits, rad", "deg/s", "rad/s"
        );
        for j in &self.joints {
            // Each end is inside the range when it is typed in.
            let range =
                |lower, upper, digits| format!("{} … {}", decimals_up(lower, digits), decimals_down(upper, digits));
            let degrees = range(j.lower_deg, j.upper_deg, 4);
            let radians = range(j.lower_rad, j.upper_rad, 5);
            let _ = writeln!(
                text,
                "{:<12} {degrees:>23} {radians:>22} {:>10.1} {:>9.4}  {}",
                j.name, j.velocity_deg_s, j.velocity_rad_s, j.child
            );
        }
        let tool_mount = self.tool_mount.as_ref().map(ToolMountRow::text);
        let base = self.controller_base.as_ref();
        let base = base.map(|base| format!("controller's base: {}\n", base.words));
        let nowhere = || {
            format!(
                "tool mounted nowhere: {}",
                self.no_tool_mount.as_deref().unwrap_or_default()
            )
        };
        let _ = writeln!(
            text,
            "\naccelerations {:?} rad/s², {}\n\
             {}\
             reach of the last link, at most {:.3} m\n\
             {}\n\
             {}{}\n\
             inverse kinematics: {}\n\
             simulation: {}\n\n{}\n\
             pairs checked for clearance ({}):",
            self.assumed_acceleration_rad_s2,
            self.acceleration_source(),
            self.stated_text(),
            self.reach_bound_m,
            tool_mount.unwrap_or_else(nowhere),
            base.unwrap_or_default(),
            match self.start_deg {
                Some(start_deg) => format!("home {start_deg:?}° (robot.start_deg)"),
                None => "home not stated: a clear one is looked for (robot --suggest shows it)".to_owned(),
            },
            self.inverse_kinematics.text(),
            match &self.no_dynamics {
                Some(reason) => format!("not possible: {reason}"),
                None => "possible, masses are stated".to_owned(),
            },
            self.links_text(),
            self.clearance_pairs.len()
        );
        let pairs = self.clearance_pairs.iter().map(|[a, b]| format!("  {a} – {b}\n"));
        text + &pairs.collect::<String>()
    }

    /// Source of the accelerations.
    fn acceleration_source(&self) -> String {
        let is_described = |(joint, kept): &(&JointRow, &f64)| joint.acceleration_rad_s2 == Some(**kept);
        let pairs = self.joints.iter().zip(&self.assumed_acceleration_rad_s2);
        let described: Vec<_> = pairs
            .filter(is_described)
            .map(|(joint, _)| joint.name.as_str())
            .collect();
        let is_stated = self.joints.iter().any(|joint| joint.acceleration_rad_s2.is_some());
        match (described.len(), is_stated) {
            (AXES, _) => "as the URDF states".to_owned(),
            (0, false) => "assumed: the URDF states none (limits.joint_acceleration_rad_s2)".to_owned(),
            (0, true) => "of the scenario, less than the URDF states (limits.joint_acceleration_rad_s2)".to_owned(),
            _ => format!(
                "as the URDF states for {}, the others assumed (limits.joint_acceleration_rad_s2)",
                described.join(", ")
            ),
        }
    }

    /// Lines on joints that do not move, links that are left out, soft limits, jerk and friction that the description states, and on what of it is not used.
    fn stated_text(&self) -> String {
        let of = |what: &dyn Fn(&JointRow) -> Option<String>| {
            let told = self
                .joints
                .iter()
                .filter_map(|joint| Some(format!("{} {}", joint.name, what(joint)?)));
            told.collect::<Vec<_>>().join(", ")
        };
        let soft = of(&|joint| match joint.is_soft {
            [false, false] => None,
            [true, true] => Some("(both)".to_owned()),
            [lower, _] => Some(if lower { "(lower)" } else { "(upper)" }.to_owned()),
        });
        let jerk = of(&|joint| Some(format!("{} rad/s³", joint.jerk_rad_s3?)));
        let friction = of(&|joint| {
            let [viscous, coulomb] = joint.friction?;
            Some(format!("{viscous} N·m·s/rad and {coulomb} N·m"))
        });
        let held = self.fixed_joints.iter().map(|(joint, at)| format!("{joint} at {at}"));
        let left_out = self.left_out_links.iter().map(ToString::to_string);
        let lines = [
            ("held still: ", held.collect::<Vec<_>>().join(", ")),
            (
                "links left out, as joints carry them that follow an axis: ",
                left_out.collect::<Vec<_>>().join(", "),
            ),
            ("position limits of the safety controller: ", soft),
            ("jerk limits, which nothing keeps: ", jerk),
            ("friction, used by simulations (plant.*): ", friction),
        ];
        let lines = lines.into_iter().filter(|(_, told)| !told.is_empty());
        let lines: String = lines.map(|(name, told)| format!("{name}{told}\n")).collect();
        let unused: String = self
            .unused_statements
            .iter()
            .map(|unused| format!("  {unused}\n"))
            .collect();
        match unused.is_empty() {
            true => lines,
            false => format!("{lines}stated, and not used or not complete:\n{unused}"),
        }
    }

    /// Table of the links.
    fn links_text(&self) -> String {
        let width = self
            .links
            .iter()
            .map(|link| link.name.chars().count())
            .max()
            .unwrap_or(0)
            .max(4);
        let mut text = format!(
            "{:<width$} {:>8} {:>16} {:>7}  mass\n",
            "link", "moved by", "collision shapes", "visuals"
        );
        for link in &self.links {
            let moved_by = match link.body {
                0 => "–".to_owned(),
                joint => format!("joint {joint}"),
            };
            let split = if link.is_split { "split mesh: " } else { "" };
            let shapes = format!("{split}{}", link.collision_shapes);
            let mass = if link.has_mass { "stated" } else { "–" };
            let _ = writeln!(
                text,
                "{:<width$} {moved_by:>8} {shapes:>16} {:>7}  {mass}",
                link.name, link.visuals
            );
        }
        text
    }
}

/// Suggestions for the arm.
#[derive(Debug, Serialize)]
struct RobotSuggestions {
    robot: String,
    scenario: String,
    /// Joint positions of a home \[deg\].
    start_deg: [f64; 6],
    /// The nearest bodies there, and their distance \[m\].
    nearest: Option<([String; 2], f64)>,
    /// Distance from the limit of the joint that is nearest to one \[deg\].
    margin_deg: f64,
    /// Angle between the tool and the direction straight onto the plates \[deg\].
    tilt_deg: f64,
    /// Number of clear configurations from which the home was chosen.
    clear: usize,
    /// Radius of the plate \[m\].
    plate_radius_m: f64,
    /// z of its face \[m\].
    plate_height_m: f64,
    /// Distances from axis 1 at which the plate can be washed somewhere \[m\].
    washable_rho_m: Option<[f64; 2]>,
    /// Area that the centres of washable plates cover \[m²\].
    washable_area_m2: f64,
    /// False where the map was stopped for lack of time: squares are missing.
    is_complete: bool,
    /// Edge of the finest squares examined \[m\].
    square_m: f64,
    /// The largest sector of such centres, as `layout.rho_m` and `layout.azimuth_deg`.
    rho_m: Option<[f64; 2]>,
    azimuth_deg: Option<[f64; 2]>,
    #[serde(flatten)]
    pairs: TouchingPairs,
    has_srdf: bool,
    written: Vec<PathBuf>,
}

/// Looks for what suits the arm, the tool and the plates of the scenario, and writes the picture and the SRDF.
fn suggest(options: &Options) -> Result<ExitCode> {
    let names = ["region.svg", "touching.srdf"];
    let mut files = Files::new(options.folder_or("suggested"), &names);
    files.check()?;
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let found = options.during("looking where plates can be washed", || {
        scenario.suggest(&robot, MAP_TIME, &Watch::silent(&options.cancel))
    });
    let found = found.map_err(|error| options.failure(error))?;
    let tool = scenario.tool_on(&robot)?;
    files.add("region.svg", draw_region(&map(&scenario, &robot, &tool, &found)));
    files.add("touching.srdf", found.pairs.srdf());
    files.write(&options.cancel)?;
    let answer = RobotSuggestions::new(&scenario, &robot, found, files.places(&names));
    options.print(&answer, || answer.text())?;
    Ok(ExitCode::Done)
}

fn map(scenario: &Scenario, robot: &RobotModel, tool: &Tool, found: &Suggestion) -> RegionMap {
    let (axis, _) = robot.reach_bound(&tool.tip_frame(robot));
    let axis = scenario.robot.mount(robot) * axis;
    let radius_m = found.plate.rim_m();
    let squares = found.region.squares.iter();
    RegionMap {
        subtitle: format!(
            "{} with the tool of {}, plates of radius {:.0} mm with their faces at {:.0} mm",
            robot.name(),
            scenario.name,
            1e3 * radius_m,
            1e3 * found.plate.centre().z
        ),
        squares: squares.map(|s| (s.centre_m, s.edge_m, s.is_washable)).collect(),
        sector: found.region.sector.map(|sector| (sector.rho_m, sector.azimuth_deg)),
        axis_m: [axis.x, axis.y],
        plate: (found.plate.centre_xy(), radius_m),
        arm_m: arm_outlines(robot, tool, &scenario.robot.mount(robot), &found.home.q_rad()),
    }
}

impl RobotSuggestions {
    fn new(scenario: &Scenario, robot: &RobotModel, found: Suggestion, written: Vec<PathBuf>) -> Self {
        let (home, region) = (found.home, found.region);
        let sector = region.sector.map(|sector| sector.in_whole_units());
        let (rho_m, azimuth_deg) = sector.map(|sector| (sector.rho_m, sector.azimuth_deg)).unzip();
        Self {
            robot: robot.name().to_owned(),
            scenario: scenario.name.clone(),
            start_deg: home.q_deg,
            nearest: home.nearest.map(|pair| ([pair.a, pair.b], pair.distance_m)),
            margin_deg: home.margin_rad.to_degrees(),
            tilt_deg: home.tilt_rad.to_degrees(),
            clear: home.clear,
            plate_radius_m: found.plate.rim_m(),
            plate_height_m: found.plate.centre().z,
            washable_rho_m: region.rho_m,
            washable_area_m2: region.area_m2,
            is_complete: region.is_complete,
            square_m: region.step_m,
            rho_m,
            azimuth_deg,
            pairs: found.pairs,
            has_srdf: robot.disabled_pairs().is_some(),
            written,
        }
    }

    fn text(&self) -> String {
        let near = match &self.nearest {
            Some(([a, b], distance_m)) => format!("nearest are {a} and {b}, {:.1} mm", 1e3 * distance_m),
            None => "nothing could touch".to_owned(),
        };
        let [radius, height, square] = [self.plate_radius_m, self.plate_height_m, self.square_m].map(|m| 1e3 * m);
        let (robot, scenario, start_deg, clear) = (&self.robot, &self.scenario, self.start_deg, self.clear);
        let (tilt, area) = (self.tilt_deg, self.washable_area_m2);
        let margin = match self.margin_deg.is_finite() {
            true => format!("{:.0}° from the nearest limit", self.margin_deg),
            false => "no joint has a limit".to_owned(),
        };
        let from_axis = self.washable_rho_m.map_or_else(String::new, |[near, far]| {
            format!(" from {near:.2} to {far:.2} m from axis 1,")
        });
        let partial = match self.is_complete {
            true => "",
            false => {
                "; the map is not complete, as it took too long: places far from the plate in front of the arm are missing"
            }
        };
        let washed = match area > 0.0 {
            true => format!(
                "washed{from_axis} with centres over {area:.2} m² in all: a guess, as transits are not looked at{partial}"
            ),
            false => format!("no place was found that is washed from this home: a guess{partial}"),
        };
        let sector = self
            .rho_m
            .zip(self.azimuth_deg)
            .map_or_else(String::new, |(rho_m, azimuth_deg)| {
                format!("  largest sector of them: rho_m = {rho_m:?}, azimuth_deg = {azimuth_deg:?}\n")
            });
        let (adjacent, touching, samples) = (
            self.pairs.neighbours.len(),
            self.pairs.always_touching.len(),
            self.pairs.samples,
        );
        let own = if self.has_srdf {
            "; the arm has a list of its own"
        } else {
            ""
        };
        let written = self.written.iter().map(|path| format!("wrote {}\n", path.display()));
        let written: String = written.collect();
        format!(
            "{robot} with the tool of {scenario}\n\n\
             home\n  start_deg = {start_deg:?}\n  {near}; {margin}; \
             the tool {tilt:.1}° from straight onto the plates; the best of {clear} that are clear\n\n\
             plates of radius {radius:.0} mm with their faces at {height:.0} mm, by squares of {square:.0} mm\n  {washed}\n{sector}\n\
             pairs of links that need no check: {adjacent} adjacent, {touching} that touch in each of {samples} configurations{own}\n\
             {written}"
        )
    }
}
