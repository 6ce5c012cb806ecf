//! `platewash align`: where the arm stands at a table, from points touched with its tip.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::fk::FramePose;
use super::law::positive;
use super::options::Options;
use super::output;
use anyhow::{Context, anyhow, ensure};
use clap::Args;
use platewash::kinematics::urdf::file::read_text;
use platewash::kinematics::words::fixed;
use platewash::workcell::align::{
    Alignment, DrawnPoint, Touch, TouchedPoint, align, drawn_points, fitting_order, touched_points,
};
use platewash::workcell::words::{millimetres, printable};
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Longest file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 20;

/// A stretch that is told \[share\]: 1 mm in 100.
const STRETCHED: f64 = 0.01;

/// A tilt that is told \[rad\]: 1 mm over the width of a plate of 290 mm.
const TILTED_RAD: f64 = 0.0035;

/// A tilt from which on it is told in degrees, and not as a slope \[rad\].
const STEEP_RAD: f64 = 0.1;

/// A turn about the line through the points that an error of the tolerance may hide, and that is told \[rad\].
const HIDDEN_RAD: f64 = 0.02;

/// Largest tolerance that is taken \[m\]: more is one in millimetres, and no fit of a table.
const GREATEST_TOLERANCE_M: f64 = 0.05;

/// A turn, or a place, that is none \[rad, m\].
const NOTHING: f64 = 1e-9;

/// Arguments of `align`.
#[derive(Debug, Args)]
pub struct AlignArguments {
    /// CSV of touched points: columns x_m,y_m,z_m (in the drawing: world frame, metres) and touched_x_mm,touched_y_mm,touched_z_mm (the
    /// tip in the base frame as the pendant shows it, millimetres); a column name is allowed
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Largest accepted residual in metres, at most 0.05
    #[arg(long, value_name = "M", default_value_t = 0.001, value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: f64,
    /// Point of the drawing in metres, to convert to the base frame (may be repeated)
    #[arg(long, num_args = 3, allow_negative_numbers = true, value_names = ["X", "Y", "Z"])]
    pub point: Vec<f64>,
    /// CSV of such points: columns x_m,y_m,z_m and name
    #[arg(long, value_name = "FILE")]
    pub points: Option<PathBuf>,
}

/// What is said of the points.
#[derive(Debug, Serialize)]
struct Answer {
    /// Whether every residual is within the tolerance.
    fits: bool,
    tolerance_m: f64,
    mount: FramePose,
    /// The mount as a scenario's keys in `[robot]` state it.
    robot: MountKeys,
    /// Angle between the world's z and the base's.
    tilt_rad: f64,
    /// Whether that is so small that plates may be taken to lie level without the keys of the mount.
    level: bool,
    rms_m: f64,
    largest_m: f64,
    touches: Vec<Residual>,
    /// How far the drawn points are spread along their longest direction and beside it, root mean square.
    spread_m: [f64; 2],
    /// Lengths touched over lengths drawn.
    stretch: f64,
    notes: Vec<String>,
    points: Vec<Carried>,
}

/// A mount as a scenario states it, to micrometres and 1e-7°.
#[derive(Debug, Serialize)]
struct MountKeys {
    mount_m: [f64; 3],
    mount_rpy_deg: [f64; 3],
}

/// What is left of a touched point.
#[derive(Debug, Serialize)]
struct Residual {
    line: usize,
    name: Option<String>,
    residual_m: [f64; 3],
    length_m: f64,
}

/// A point of the drawing in the base frame.
#[derive(Debug, Serialize)]
struct Carried {
    name: Option<String>,
    drawn_m: [f64; 3],
    base_m: [f64; 3],
}

/// A tolerance \[m\].
fn tolerance(text: &str) -> anyhow::Result<f64> {
    let found = positive(text)?;
    ensure!(
        found <= GREATEST_TOLERANCE_M,
        "must be at most {GREATEST_TOLERANCE_M} m (it is in metres: 0.001 is 1 mm)"
    );
    Ok(found)
}

/// Finds the mount, tells how well it fits, and carries points over.
pub fn run(options: &Options, arguments: &AlignArguments) -> Result<ExitCode, Failure> {
    let touched = touched(&arguments.file).map_err(Failure::input)?;
    let wanted = wanted(arguments).map_err(Failure::input)?;
    let touches: Vec<Touch> = touched.iter().map(|point| point.touch).collect();
    let alignment = align(&touches)
        .map_err(|error| with_order(anyhow!(error), &touches, arguments.tolerance))
        .with_context(|| name_of(&arguments.file))
        .map_err(Failure::input)?;
    let answer = Answer::new(&alignment, (&touched, &touches), &wanted, arguments.tolerance);
    output::print_either(options.json, &answer, || answer.text())?;
    let outcome = if answer.fits && answer.level {
        Outcome::Good
    } else {
        Outcome::NotVerified
    };
    Ok(outcome.answer())
}

fn name_of(file: &Path) -> String {
    printable(&file.display().to_string())
}

fn text_of(file: &Path) -> anyhow::Result<String> {
    read_text(file, MAX_BYTES).with_context(|| format!("{}: cannot be read", name_of(file)))
}

fn touched(file: &Path) -> anyhow::Result<Vec<TouchedPoint>> {
    touched_points(&text_of(file)?).with_context(|| name_of(file))
}

/// The points that shall be told in the base frame.
fn wanted(arguments: &AlignArguments) -> anyhow::Result<Vec<DrawnPoint>> {
    let given = arguments.point.chunks_exact(3).map(|point| DrawnPoint {
        line: 0,
        name: None,
        drawn_m: [point[0], point[1], point[2]],
    });
    let mut all: Vec<DrawnPoint> = given.collect();
    if let Some(bad) = all.iter().flat_map(|p| p.drawn_m).find(|number| !number.is_finite()) {
        return Err(anyhow!("--point: expected three finite numbers; found {bad}"));
    }
    if let Some(file) = &arguments.points {
        all.extend(drawn_points(&text_of(file)?).with_context(|| name_of(file))?);
    }
    Ok(all)
}

/// An error with the order in which the points would fit, where there is one.
fn with_order(error: anyhow::Error, touches: &[Touch], tolerance_m: f64) -> anyhow::Error {
    match other_order(touches, tolerance_m) {
        Some(words) => anyhow!("{error}; {words}"),
        None => error,
    }
}

fn other_order(touches: &[Touch], tolerance_m: f64) -> Option<String> {
    let order = order(touches, tolerance_m)?;
    Some(format!(
        "the touched points fit the drawn ones in another order, such as {order} (points count from 0)"
    ))
}

/// Another order in which the points fit.
fn order(touches: &[Touch], tolerance_m: f64) -> Option<String> {
    let order = fitting_order(touches, tolerance_m)?;
    let order: Vec<String> = order.iter().map(usize::to_string).collect();
    Some(order.join(", "))
}

impl Answer {
    fn new(
        alignment: &Alignment,
        (touched, touches): (&[TouchedPoint], &[Touch]),
        wanted: &[DrawnPoint],
        tolerance_m: f64,
    ) -> Self {
        let (_, largest_m) = alignment.worst();
        let fits = largest_m <= tolerance_m;
        let left = touched.iter().zip(&alignment.residuals_m);
        let left = left.map(|(point, residual_m)| Residual {
            line: point.line,
            name: point.name.clone(),
            residual_m: *residual_m,
            length_m: nalgebra::Vector3::from(*residual_m).norm(),
        });
        let carried = wanted.iter().map(|point| Carried {
            name: point.name.clone(),
            drawn_m: point.drawn_m,
            base_m: alignment.in_base(point.drawn_m),
        });
        Self {
            fits,
            tolerance_m,
            robot: MountKeys::of(&FramePose::from(&alignment.mount)),
            mount: FramePose::from(&alignment.mount),
            tilt_rad: alignment.tilt_rad(),
            level: alignment.tilt_rad() <= TILTED_RAD,
            rms_m: alignment.rms_m,
            largest_m,
            touches: left.collect(),
            spread_m: alignment.spread_m,
            stretch: alignment.stretch,
            notes: notes(alignment, (touched, touches), (fits, tolerance_m)),
            points: carried.collect(),
        }
    }

    fn text(&self) -> String {
        let mm = |length_m: f64| fixed(1e3 * length_m, 3);
        let row = |numbers: [f64; 3], digits| numbers.map(|v| fixed(v, digits)).join(", ");
        let mut text = String::new();
        let verdict = match (self.fits, self.level) {
            (true, true) => "ALIGNED",
            (true, false) => "ALIGNED, OUT OF LEVEL",
            (false, _) => "NOT ALIGNED",
        };
        let count = self.touches.len();
        let (largest, tolerance) = (mm(self.largest_m), mm(self.tolerance_m));
        // A String takes whatever is written.
        let _ = writeln!(
            text,
            "{verdict}: {count} points, off by {} mm rms and {largest} mm at most; tolerance {tolerance} mm\n",
            mm(self.rms_m)
        );
        let [w, x, y, z] = self.mount.quaternion_wxyz.map(|v| fixed(v, 9));
        let _ = writeln!(text, "T_world_base, where the base stands in the drawing");
        let _ = writeln!(text, "  position, m        {}", row(self.mount.position_m, 6));
        let _ = writeln!(text, "  roll pitch yaw, °  {}", row(self.mount.rpy_deg, 5));
        let _ = writeln!(text, "  quaternion wxyz    {w}, {x}, {y}, {z}");
        let MountKeys { mount_m, mount_rpy_deg } = &self.robot;
        let _ = writeln!(
            text,
            "  in a scenario      [robot]\n                     mount_m = {mount_m:?}"
        );
        let _ = writeln!(text, "                     mount_rpy_deg = {mount_rpy_deg:?}");
        let _ = writeln!(
            text,
            "  tilt of the table against the base, °  {}\n",
            fixed(self.tilt_rad.to_degrees(), 4)
        );
        let _ = writeln!(
            text,
            "{:<6} {:<16} {:>10} {:>10} {:>10} {:>10}",
            "line", "residual of", "x, mm", "y, mm", "z, mm", "all, mm"
        );
        for touch in &self.touches {
            let [x, y, z] = touch.residual_m.map(mm);
            let name = touch.name.as_deref().map_or_else(String::new, printable);
            let all = mm(touch.length_m);
            let _ = writeln!(text, "{:<6} {name:<16} {x:>10} {y:>10} {z:>10} {all:>10}", touch.line);
        }
        if !self.points.is_empty() {
            let _ = writeln!(
                text,
                "\n{:<16} {:<34} in the base frame, m; and mm, as a pendant shows it",
                "point", "in the drawing, m"
            );
        }
        for (k, point) in self.points.iter().enumerate() {
            let name = point.name.as_deref().map_or_else(|| k.to_string(), printable);
            let (drawn, base) = (row(point.drawn_m, 6), row(point.base_m, 6));
            let pendant = row(point.base_m.map(|v| 1e3 * v), 3);
            let _ = writeln!(text, "{name:<16} {drawn:<34} {base}; {pendant}");
        }
        let _ = writeln!(text);
        for note in &self.notes {
            let _ = writeln!(text, "note: {note}");
        }
        text
    }
}

impl MountKeys {
    fn of(mount: &FramePose) -> Self {
        let rounded = |numbers: [f64; 3], unit: f64| numbers.map(|v| (v * unit).round() / unit + 0.0);
        Self {
            mount_m: rounded(mount.position_m, 1e6),
            mount_rpy_deg: rounded(mount.rpy_deg, 1e7),
        }
    }
}

/// What is to be said of a mount.
fn notes(
    alignment: &Alignment,
    (touched, touches): (&[TouchedPoint], &[Touch]),
    (fits, tolerance_m): (bool, f64),
) -> Vec<String> {
    let stretched = (alignment.stretch - 1.0).abs() > STRETCHED;
    let mut notes = Vec::new();
    if fits {
        notes.extend(look_alike(touches, tolerance_m));
    } else if let Some(words) = other_order(touches, tolerance_m) {
        notes.push(words);
    } else if let Some(worst) = touched
        .get(alignment.worst().0)
        .filter(|_| !stretched && touches.len() > 3)
    {
        let name = worst
            .name
            .as_deref()
            .map_or_else(String::new, |name| format!(", {}", printable(name)));
        notes.push(format!(
            "the point of line {}{name} is farthest off: touch it again, or look at that line",
            worst.line
        ));
    }
    if touches.len() == 3 {
        let words = "three points: an error of height cannot show in the residuals; touch a fourth one";
        notes.push(words.to_owned());
    }
    let [_, beside_m] = alignment.spread_m;
    let hidden_rad = tolerance_m / beside_m;
    if hidden_rad > HIDDEN_RAD {
        let (beside, off) = (millimetres(beside_m), millimetres(tolerance_m));
        let turned = fixed(hidden_rad.to_degrees(), 1);
        notes.push(format!(
            "the points lie within {beside} of one line: {off} of error beside it turns the table by {turned}° about it; touch one \
             farther away"
        ));
    }
    if stretched {
        let percent = 100.0 * (alignment.stretch - 1.0).abs();
        let than = if alignment.stretch > 1.0 { "longer" } else { "shorter" };
        notes.push(format!(
            "lengths as touched are {percent:.2} % {than} than as drawn: look at the units, and at the points' lines"
        ));
    }
    let at = alignment.mount.translation.vector;
    let stands_elsewhere = at.norm() > NOTHING || alignment.mount.rotation.angle() > NOTHING;
    if stands_elsewhere {
        let words = "a scenario with the keys above states plates by their places in the drawing; one without them by those in the base frame \
                     (--point, --points)";
        notes.push(words.to_owned());
    }
    notes.extend(out_of_level(alignment.tilt_rad()));
    notes
}

/// That the points fit in another order as well, which no residual tells apart.
fn look_alike(touches: &[Touch], tolerance_m: f64) -> Option<String> {
    let order = order(touches, tolerance_m)?;
    Some(format!(
        "the marks look alike: the points fit in another order as well, such as {order} (points count from 0), with the arm elsewhere; make \
         sure that they were touched in the order of the file, or touch one more"
    ))
}

/// That the table is tilted, where that matters.
fn out_of_level(tilt_rad: f64) -> Option<String> {
    let by = match tilt_rad {
        tilt if tilt > STEEP_RAD => format!("{}°", fixed(tilt.to_degrees(), 1)),
        tilt if tilt > TILTED_RAD => format!("{:.1} mm in a metre", 1e3 * tilt),
        _ => return None,
    };
    let words = "without robot.mount_m and robot.mount_rpy_deg plates are taken to lie level with the base: state both, or level the table or the base";
    Some(format!("the table is out of level by {by}; {words}"))
}
