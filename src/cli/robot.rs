//! `platewash robot`: the arm as loaded, and with `--suggest` a home, where plates can be washed, and pairs of links that need no check.

use super::failure::ExitCode;
use super::files::Files;
use super::options::Options;
use anyhow::{Result, bail};
use clap::Args;
use platewash::kinematics::AXES;
use platewash::kinematics::words::{decimals_down, decimals_up};
use platewash::planner::Watch;
use platewash::planner::suggest::Sector;
use platewash::scenario::Suggestion;
use platewash::viewer::figures::{RegionMap, draw_region};
use platewash::workcell::clearance::TouchingPairs;
use platewash::workcell::workcell::Obstacle;
use platewash::{ClearanceModel, Pose, RobotModel, Scenario, Tool, ToolFrame, Workcell};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;

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

/// Shows joints, limits, frames and the pairs that are checked for clearance (the bare arm over the floor), or suggests what suits the arm.
pub fn run(options: &Options, arguments: &RobotArguments) -> Result<ExitCode> {
    if arguments.suggest {
        return suggest(options);
    }
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let stated = scenario.tool.mounted_on.as_deref();
    let link = stated.unwrap_or(ToolFrame::Tool0.name()).to_owned();
    let (tool_mount, words) = match robot.tool_mount(stated) {
        Ok(frame) => {
            let off_axis_6_deg = frame.tilt_rad().to_degrees();
            let words = format!("on link '{link}', along its z axis, {off_axis_6_deg:.1}° from the axis of joint 6");
            (Some(ToolMount { link, off_axis_6_deg }), words)
        }
        Err(error) if stated.is_some() => bail!("tool.mounted_on: {error}"),
        Err(error) => (None, format!("nowhere: {error}")),
    };
    let pairs = bare_clearance(&robot)?;
    let pairs = pairs
        .pair_names()
        .into_iter()
        .map(|(a, b)| [a.to_owned(), b.to_owned()]);
    let answer = Answer {
        name: robot.name().to_owned(),
        urdf_sha256: robot.sha256().to_owned(),
        joints: (0..AXES).map(|i| JointRow::new(&robot, i)).collect(),
        frames: robot.links().iter().map(|l| l.name.clone()).collect(),
        tool_mount,
        reach_bound_m: robot.reach_bound(&robot.last_link_frame()).1,
        clearance_pairs: pairs.collect(),
    };
    options.print(&answer, || answer.text(&words))?;
    Ok(ExitCode::Done)
}

/// The clearances of an arm without a tool over the floor.
pub fn bare_clearance(robot: &RobotModel) -> Result<ClearanceModel, platewash::Failure> {
    let bare = Workcell::without_tool(robot, Pose::identity(), vec![Obstacle::floor()])?;
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
        }
    }
}

impl Answer {
    fn text(&self, tool_mount: &str) -> String {
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
        let _ = writeln!(
            text,
            "\nreach of the last link, at most {:.3} m\nframes: {}\ntool mounted {tool_mount}\n\npairs checked for clearance ({}):",
            self.reach_bound_m,
            self.frames.join(", "),
            self.clearance_pairs.len()
        );
        let pairs = self.clearance_pairs.iter().map(|[a, b]| format!("  {a} – {b}\n"));
        text + &pairs.collect::<String>()
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
        scenario.suggest(&robot, &Watch::silent(&options.cancel))
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
    let axis = scenario.robot.mount() * axis;
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
    }
}

/// The sector rounded inwards to whole centimetres and degrees.
fn whole_units(sector: &Sector) -> ([f64; 2], [f64; 2]) {
    let within =
        |[from, to]: [f64; 2], unit: f64| [(from / unit - 1e-9).ceil() * unit, (to / unit + 1e-9).floor() * unit];
    let millimetres = |m: f64| (1e3 * m).round() / 1e3;
    let rho_m = within(sector.rho_m, 0.01).map(millimetres);
    (rho_m, within(sector.azimuth_deg, 1.0))
}

impl RobotSuggestions {
    fn new(scenario: &Scenario, robot: &RobotModel, found: Suggestion, written: Vec<PathBuf>) -> Self {
        let (home, region) = (found.home, found.region);
        let (rho_m, azimuth_deg) = region.sector.as_ref().map(whole_units).unzip();
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
        let (margin, tilt, area) = (self.margin_deg, self.tilt_deg, self.washable_area_m2);
        let from_axis = self.washable_rho_m.map_or_else(String::new, |[near, far]| {
            format!(" from {near:.2} to {far:.2} m from axis 1,")
        });
        let washed = match area > 0.0 {
            true => format!(
                "washed{from_axis} with centres over {area:.2} m² in all: a guess, as transits are not looked at"
            ),
            false => "washed nowhere from this home".to_owned(),
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
             home\n  start_deg = {start_deg:?}\n  {near}; {margin:.0}° from the nearest limit; \
             the tool {tilt:.1}° from straight onto the plates; the best of {clear} that are clear\n\n\
             plates of radius {radius:.0} mm with their faces at {height:.0} mm, by squares of {square:.0} mm\n  {washed}\n{sector}\n\
             pairs of links that need no check: {adjacent} adjacent, {touching} that touch in each of {samples} configurations{own}\n\
             {written}"
        )
    }
}
