//! `platewash robot --suggest`: a home, where plates can be washed, and pairs of links that need no check.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output;
use super::progress::Progress;
use platewash::planner::Watch;
use platewash::planner::suggest::Sector;
use platewash::scenario::Suggestion;
use platewash::viewer::figures::{RegionMap, draw_region};
use platewash::{RobotModel, Scenario, Tool};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;

/// Folder that is written to without `--out`.
const DEFAULT_FOLDER: &str = "suggested";

/// What is suggested.
#[derive(Debug, Serialize)]
struct Answer {
    robot: String,
    scenario: String,
    /// Joint positions of a home \[deg\].
    start_deg: [f64; 6],
    /// The nearest bodies there, and their distance \[m\].
    nearest: Option<([String; 2], f64)>,
    /// How far the joint nearest to a limit is from it \[deg\].
    margin_deg: f64,
    /// The angle between the tool and the way straight onto the plates \[deg\].
    tilt_deg: f64,
    /// Clear configurations out of which home is the best.
    clear: usize,
    /// Radius of the plate \[m\].
    plate_radius_m: f64,
    /// z of its face \[m\].
    plate_height_m: f64,
    /// Distances from axis 1 at which the plate can be washed somewhere \[m\].
    washable_rho_m: Option<[f64; 2]>,
    /// What centres of washable plates cover \[m²\].
    washable_area_m2: f64,
    /// Edge of the finest squares that were looked at \[m\].
    square_m: f64,
    /// The largest sector of such centres, as `layout.rho_m` and `layout.azimuth_deg`.
    rho_m: Option<[f64; 2]>,
    azimuth_deg: Option<[f64; 2]>,
    neighbours: Vec<[String; 2]>,
    always_touching: Vec<[String; 2]>,
    samples: usize,
    has_srdf: bool,
    written: Vec<PathBuf>,
}

/// Looks for what suits the arm, the tool and the plates of the scenario, and writes the picture and the SRDF.
pub fn run(options: &Options) -> Result<ExitCode, Failure> {
    let folder = options.out.clone().unwrap_or_else(|| PathBuf::from(DEFAULT_FOLDER));
    let written = ["region.svg", "touching.srdf"].map(|name| folder.join(name));
    output::check_places(&written)?;
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let found = {
        let _progress = Progress::new(options.quiet, "looking where plates can be washed");
        let watch = Watch::silent(&options.cancel);
        scenario
            .suggest(&robot, &watch)
            .map_err(|error| options.failure(error))?
    };
    let tool = scenario.tool_on(&robot)?;
    let map = draw_region(&map(&scenario, &robot, &tool, &found));
    let [svg, srdf] = written.clone();
    let files = [output::file(svg, map), output::file(srdf, found.pairs.srdf())];
    output::write_files(&files, &options.cancel)?;
    let answer = answer(&scenario, &robot, found, written.into());
    output::print_either(options.json, &answer, || super::text::text(&text(&answer)))?;
    Ok(ExitCode::SUCCESS)
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

/// The sector in whole centimetres and degrees, no larger than it is.
fn inwards(sector: &Sector) -> ([f64; 2], [f64; 2]) {
    let within =
        |[from, to]: [f64; 2], unit: f64| [(from / unit - 1e-9).ceil() * unit, (to / unit + 1e-9).floor() * unit];
    let millimetres = |m: f64| (1e3 * m).round() / 1e3;
    (
        within(sector.rho_m, 0.01).map(millimetres),
        within(sector.azimuth_deg, 1.0),
    )
}

fn answer(scenario: &Scenario, robot: &RobotModel, found: Suggestion, written: Vec<PathBuf>) -> Answer {
    let Suggestion {
        home,
        region,
        pairs,
        plate,
    } = found;
    let sector = region.sector.as_ref().map(inwards);
    Answer {
        robot: robot.name().to_owned(),
        scenario: scenario.name.clone(),
        start_deg: home.q_deg,
        nearest: home.nearest.map(|pair| ([pair.a, pair.b], pair.distance_m)),
        margin_deg: home.margin_rad.to_degrees(),
        tilt_deg: home.tilt_rad.to_degrees(),
        clear: home.clear,
        plate_radius_m: plate.rim_m(),
        plate_height_m: plate.centre().z,
        washable_rho_m: region.rho_m,
        washable_area_m2: region.area_m2,
        square_m: region.step_m,
        rho_m: sector.map(|(rho_m, _)| rho_m),
        azimuth_deg: sector.map(|(_, azimuth_deg)| azimuth_deg),
        neighbours: pairs.neighbours,
        always_touching: pairs.always_touching,
        samples: pairs.samples,
        has_srdf: robot.disabled_pairs().is_some(),
        written,
    }
}

fn text(answer: &Answer) -> String {
    let mut text = format!(
        "{} with the tool of {}\n\nhome\n  start_deg = {:?}\n",
        answer.robot, answer.scenario, answer.start_deg
    );
    let near = answer.nearest.as_ref().map_or_else(
        || "nothing could touch".to_owned(),
        |([a, b], distance_m)| format!("nearest are {a} and {b}, {:.1} mm", 1e3 * distance_m),
    );
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "  {near}; {:.0}° from the nearest limit; the tool {:.1}° from straight onto the plates; the best of {} that are clear",
        answer.margin_deg, answer.tilt_deg, answer.clear
    );
    let _ = writeln!(
        text,
        "\nplates of radius {:.0} mm with their faces at {:.0} mm, by squares of {:.0} mm",
        1e3 * answer.plate_radius_m,
        1e3 * answer.plate_height_m,
        1e3 * answer.square_m
    );
    if answer.washable_area_m2 > 0.0 {
        let from_axis = answer.washable_rho_m.map_or_else(String::new, |[near, far]| {
            format!(" from {near:.2} to {far:.2} m from axis 1,")
        });
        let _ = writeln!(
            text,
            "  washed{from_axis} with centres over {:.2} m² in all: a guess, as transits are not looked at",
            answer.washable_area_m2
        );
    } else {
        text.push_str("  washed nowhere from this home\n");
    }
    if let (Some(rho_m), Some(azimuth_deg)) = (answer.rho_m, answer.azimuth_deg) {
        let _ = writeln!(
            text,
            "  largest sector of them: rho_m = {rho_m:?}, azimuth_deg = {azimuth_deg:?}"
        );
    }
    let _ = writeln!(
        text,
        "\npairs of links that need no check: {} adjacent, {} that touch in each of {} configurations{}",
        answer.neighbours.len(),
        answer.always_touching.len(),
        answer.samples,
        if answer.has_srdf {
            "; the arm has a list of its own"
        } else {
            ""
        }
    );
    for path in &answer.written {
        let _ = writeln!(text, "wrote {}", path.display());
    }
    text
}
