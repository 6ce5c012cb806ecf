//! `platewash align`: where the arm stands at a table, from points touched with its tip.

use super::failure::ExitCode;
use super::frame_pose::FramePose;
use super::numbers::{coordinate, within};
use super::options::Options;
use anyhow::{Context, Result, anyhow, ensure};
use clap::Args;
use platewash::cli::alignment::{
    Alignment, DrawnPoint, Touch, TouchedPoint, align, drawn_points, fitting_order, touched_points,
};
use platewash::kinematics::urdf::file::read_text;
use platewash::kinematics::words::fixed;
use platewash::scenario::{OriginLink, RobotSection, load_arm};
use platewash::workcell::number_table::TableError;
use platewash::workcell::words::{millimetres, printable};
use platewash::{Failure, RobotModel, Scenario};
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Longest file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 20;

/// Smallest stretch that a note reports \[share\]: 1 mm in 100 mm.
const STRETCHED: f64 = 0.01;

/// Smallest tilt that a note reports \[rad\]: 1 mm over the width of a plate of 290 mm.
const TILTED_RAD: f64 = 0.0035;

/// Tilt above which a note gives degrees in place of a slope \[rad\].
const STEEP_RAD: f64 = 0.1;

/// Smallest turn that a note reports, about the line through the points, which an error of the tolerance may hide \[rad\].
const HIDDEN_RAD: f64 = 0.02;

/// Largest accepted tolerance \[m\]; a larger one is probably in millimetres, and too coarse for a table.
const GREATEST_TOLERANCE_M: f64 = 0.05;

/// Largest turn or distance that counts as zero \[rad, m\].
const NOTHING: f64 = 1e-9;

/// Arguments of `align`.
#[derive(Debug, Args)]
pub struct AlignArguments {
    /// CSV of touched points: columns x_m,y_m,z_m (in the drawing: world frame, metres) and touched_x_mm,touched_y_mm,touched_z_mm (the
    /// tip in the controller's base frame as the pendant shows it, millimetres); a column name is allowed
    pub file: PathBuf,
    /// Largest accepted residual in metres, at most 0.05
    #[arg(long, value_name = "M", default_value_t = 0.001, value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: f64,
    /// Point of the drawing in metres, to convert to the frames of the arm and the pendant (may be repeated)
    #[arg(long, num_args = 3, allow_negative_numbers = true, value_names = ["X", "Y", "Z"], value_parser = coordinate)]
    pub point: Vec<f64>,
    /// CSV of such points: columns x_m,y_m,z_m and name
    #[arg(long, value_name = "FILE")]
    pub points: Option<PathBuf>,
}

/// Answer of `align`.
#[derive(Debug, Serialize)]
struct Answer {
    /// True where every residual is within the tolerance.
    fits: bool,
    tolerance_m: f64,
    /// Mount of the root link, or of the controller's base where no arm is given.
    mount: FramePose,
    /// The mount as a scenario's keys in `[robot]` state it.
    robot: MountKeys,
    /// Link whose mount that is, in words.
    link: String,
    /// Mount of the controller's base, from which the pendant counts.
    controller_base: FramePose,
    /// Link that is the controller's base, in words, where it lies apart from the root link.
    #[serde(skip_serializing_if = "Option::is_none")]
    base_link: Option<String>,
    /// Angle between the world's z axis and that of the mounted link.
    tilt_rad: f64,
    /// True where that angle is so small that plates may be taken to lie level without the keys of the mount.
    level: bool,
    rms_m: f64,
    largest_m: f64,
    touches: Vec<Residual>,
    /// Spread of the drawn points about their middle, root mean square, along their longest direction and beside it.
    spread_m: [f64; 2],
    /// Ratio of touched to drawn lengths.
    stretch: f64,
    notes: Vec<String>,
    points: Vec<AlignedPoint>,
}

/// A mount as a scenario states it, to micrometres and 1e-7°.
#[derive(Debug, Serialize)]
struct MountKeys {
    mount_m: [f64; 3],
    mount_rpy_deg: [f64; 3],
    mount_link: OriginLink,
}

/// Residual of a touched point under the fitted mount.
#[derive(Debug, Serialize)]
struct Residual {
    line: usize,
    name: Option<String>,
    residual_m: [f64; 3],
    length_m: f64,
}

/// A point of the drawing in the frame of the mounted link, and in that of the controller's base, as the pendant shows it.
#[derive(Debug, Serialize)]
struct AlignedPoint {
    name: Option<String>,
    drawn_m: [f64; 3],
    base_m: [f64; 3],
    pendant_mm: [f64; 3],
}

/// A tolerance \[m\].
fn tolerance(text: &str) -> Result<f64> {
    let expected = format!("must be above 0 and at most {GREATEST_TOLERANCE_M} m (it is in metres: 0.001 is 1 mm)");
    within(text, f64::MIN_POSITIVE..=GREATEST_TOLERANCE_M, &expected)
}

/// Finds the mount, tells how well it fits, and carries points over.
pub fn run(options: &Options, arguments: &AlignArguments) -> Result<ExitCode> {
    let touched = in_file(&arguments.file, touched_points)?;
    let wanted = points_to_map(arguments)?;
    let arm = arm(options)?;
    let touches: Vec<Touch> = touched.iter().map(|point| point.touch).collect();
    let order = fitting_order(&touches, arguments.tolerance).map(|order| {
        let order: Vec<String> = order.iter().map(usize::to_string).collect();
        format!("such as {} (points count from 0)", order.join(", "))
    });
    let order = order.as_deref();
    let alignment = align(&touches).map_err(|error| {
        let reordered = order.map(|order| format!("; {}", reordered(order)));
        anyhow!("{}: {error}{}", name_of(&arguments.file), reordered.unwrap_or_default())
    })?;
    let answer = Answer::new(&alignment, arm.as_ref(), &touched, order, &wanted, arguments.tolerance);
    options.print(&answer, || answer.text())?;
    Ok(ExitCode::NotVerified.unless(answer.fits && answer.level))
}

fn name_of(file: &Path) -> String {
    printable(&file.display().to_string())
}

/// The points in a file.
fn in_file<T>(file: &Path, points: fn(&str) -> Result<Vec<T>, TableError>) -> Result<Vec<T>> {
    let text = read_text(file, MAX_BYTES).with_context(|| format!("{}: cannot be read", name_of(file)))?;
    points(&text).with_context(|| name_of(file))
}

/// The arm of `--urdf`, `--arm` or `--scenario`, if one is given.
fn arm(options: &Options) -> Result<Option<RobotModel>> {
    let scenario = options.scenario.as_deref().map(Scenario::load).transpose()?;
    if scenario.is_none() && options.urdf.is_none() {
        ensure!(
            options.fix.is_empty(),
            "--fix: is for an arm; give its description as --urdf FILE, or --arm NAME"
        );
        return Ok(None);
    }
    let mut stated = scenario.map_or_else(RobotSection::default, |scenario| scenario.robot);
    stated.fixed.extend(options.fixed());
    let section = match options.urdf {
        Some(_) => options.robot_section(stated),
        None => stated,
    };
    Ok(Some(load_arm(&section, &options.files).map_err(Failure::from)?))
}

/// The points that shall be told in the frames of arm and pendant.
fn points_to_map(arguments: &AlignArguments) -> Result<Vec<DrawnPoint>> {
    let given = arguments.point.chunks_exact(3).map(|point| DrawnPoint {
        line: 0,
        name: None,
        drawn_m: [point[0], point[1], point[2]],
    });
    let listed = arguments.points.as_ref().map(|file| in_file(file, drawn_points));
    Ok(given.chain(listed.transpose()?.into_iter().flatten()).collect())
}

/// Message that the points fit in another order.
fn reordered(order: &str) -> String {
    format!("the touched points fit the drawn ones in another order, {order}")
}

impl Answer {
    /// The pendant counts from the controller's base, so that `pendant` is aligned for it.
    fn new(
        pendant: &Alignment,
        arm: Option<&RobotModel>,
        touched: &[TouchedPoint],
        order: Option<&str>,
        wanted: &[DrawnPoint],
        tolerance_m: f64,
    ) -> Self {
        let base = arm.and_then(RobotModel::controller_base);
        let alignment = &arm.map_or_else(|| pendant.clone(), |arm| pendant.of_root(arm));
        let (_, largest_m) = alignment.worst();
        let left = touched.iter().zip(&alignment.residuals_m);
        let left = left.map(|(point, residual_m)| Residual {
            line: point.line,
            name: point.name.clone(),
            residual_m: *residual_m,
            length_m: nalgebra::Vector3::from(*residual_m).norm(),
        });
        let carried = wanted.iter().map(|point| AlignedPoint {
            name: point.name.clone(),
            drawn_m: point.drawn_m,
            base_m: alignment.in_base(point.drawn_m),
            pendant_mm: pendant.in_base(point.drawn_m).map(|m| 1e3 * m),
        });
        let mount = FramePose::from(&alignment.mount);
        let rounded = |numbers: [f64; 3], unit: f64| numbers.map(|v| (v * unit).round() / unit + 0.0);
        Self {
            fits: largest_m <= tolerance_m,
            tolerance_m,
            robot: MountKeys {
                mount_m: rounded(mount.position_m, 1e6),
                mount_rpy_deg: rounded(mount.rpy_deg, 1e7),
                mount_link: arm.map_or(OriginLink::Base, |_| OriginLink::Root),
            },
            mount,
            link: match arm.and_then(|arm| arm.links().first()) {
                None => "the base from which the pendant counts".to_owned(),
                Some(root) => format!("link '{}'", printable(&root.name)),
            },
            controller_base: FramePose::from(&pendant.mount),
            base_link: base.map(|base| base.to_string()),
            tilt_rad: alignment.tilt_rad(),
            level: alignment.tilt_rad() <= TILTED_RAD,
            rms_m: alignment.rms_m,
            largest_m,
            touches: left.collect(),
            spread_m: alignment.spread_m,
            stretch: alignment.stretch,
            notes: [notes(alignment, touched, order, tolerance_m), note_on_link(arm)].concat(),
            points: carried.collect(),
        }
    }

    fn text(&self) -> String {
        let mm = |length_m: f64| fixed(1e3 * length_m, 3);
        let row = |numbers: [f64; 3], digits| numbers.map(|v| fixed(v, digits)).join(", ");
        let verdict = match (self.fits, self.level) {
            (true, true) => "ALIGNED",
            (true, false) => "ALIGNED, OUT OF LEVEL",
            (false, _) => "NOT ALIGNED",
        };
        let count = self.touches.len();
        let [rms, largest, tolerance] = [self.rms_m, self.largest_m, self.tolerance_m].map(mm);
        let (position, turn) = (row(self.mount.position_m, 6), row(self.mount.rpy_deg, 5));
        let quaternion = self.mount.quaternion_wxyz.map(|v| fixed(v, 9)).join(", ");
        let MountKeys {
            mount_m,
            mount_rpy_deg,
            mount_link,
        } = &self.robot;
        let (link, mount_link) = (&self.link, mount_link.name());
        let base = self.base_link.as_ref().map_or_else(String::new, |base| {
            let place = row(self.controller_base.position_m, 6);
            format!("  controller's base  {base}; it stands at {place} m\n")
        });
        let tilt = fixed(self.tilt_rad.to_degrees(), 4);
        let mut text = format!(
            "{verdict}: {count} points, off by {rms} mm rms and {largest} mm at most; tolerance {tolerance} mm\n\n\
             T_world_base, where {link} stands in the drawing\n  \
               position, m        {position}\n  \
               roll pitch yaw, °  {turn}\n  \
               quaternion wxyz    {quaternion}\n  \
               in a scenario      [robot]\n                     \
                                  mount_m = {mount_m:?}\n                     \
                                  mount_rpy_deg = {mount_rpy_deg:?}\n                     \
                                  mount_link = \"{mount_link}\"\n\
             {base}  \
               tilt of the table against the base, °  {tilt}\n\n\
             line   residual of           x, mm      y, mm      z, mm    all, mm\n"
        );
        // A String takes whatever is written.
        for touch in &self.touches {
            let [x, y, z] = touch.residual_m.map(mm);
            let name = touch.name.as_deref().map_or_else(String::new, printable);
            let all = mm(touch.length_m);
            let _ = writeln!(text, "{:<6} {name:<16} {x:>10} {y:>10} {z:>10} {all:>10}", touch.line);
        }
        if !self.points.is_empty() {
            let _ = writeln!(
                text,
                "\npoint            in the drawing, m                  in the frame of {link}, m; and mm, as a pendant shows it"
            );
        }
        for (k, point) in self.points.iter().enumerate() {
            let name = point.name.as_deref().map_or_else(|| k.to_string(), printable);
            let (drawn, base) = (row(point.drawn_m, 6), row(point.base_m, 6));
            let pendant = row(point.pendant_mm, 3);
            let _ = writeln!(text, "{name:<16} {drawn:<34} {base}; {pendant}");
        }
        text.push('\n');
        self.notes.iter().for_each(|note| text += &format!("note: {note}\n"));
        text
    }
}

/// Note on the point with the largest residual.
fn farthest_off(point: &TouchedPoint) -> String {
    let name = point.name.as_deref().map(|name| format!(", {}", printable(name)));
    format!(
        "the point of line {}{} is farthest off: touch it again, or look at that line",
        point.line,
        name.unwrap_or_default()
    )
}

/// Note that the mount is the pendant's, where no arm is given.
fn note_on_link(arm: Option<&RobotModel>) -> Vec<String> {
    let words = "the mount is that of the base from which the pendant counts, as mount_link = \"base\" says; many arms have that base above or turned \
                 against the root link of their description: give it as --urdf FILE, --arm NAME or --scenario FILE for the mount of the root link";
    arm.is_none().then(|| words.to_owned()).into_iter().collect()
}

/// Notes on a fitted mount.
fn notes(alignment: &Alignment, touched: &[TouchedPoint], order: Option<&str>, tolerance_m: f64) -> Vec<String> {
    let stretch = alignment.stretch - 1.0;
    let is_stretched = stretch.abs() > STRETCHED;
    let (worst, largest_m) = alignment.worst();
    let is_fit = largest_m <= tolerance_m;
    let is_one_off = !is_fit && !is_stretched && touched.len() > 3;
    let mut notes = Vec::new();
    match order {
        Some(order) if is_fit => notes.push(format!(
            "the marks look alike: the points fit in another order as well, {order}, with the arm elsewhere; make sure that they were touched in the order \
             of the file, or touch one more"
        )),
        Some(order) => notes.push(reordered(order)),
        None => notes.extend(touched.get(worst).filter(|_| is_one_off).map(farthest_off)),
    }
    let mut tell = |is_so: bool, words: &str| notes.extend(is_so.then(|| words.to_owned()));
    tell(
        touched.len() == 3,
        "three points: an error of height cannot show in the residuals; touch a fourth one",
    );
    let [_, beside_m] = alignment.spread_m;
    let hidden_rad = tolerance_m / beside_m;
    let (beside, off) = (millimetres(beside_m), millimetres(tolerance_m));
    let turned = fixed(hidden_rad.to_degrees(), 1);
    tell(
        hidden_rad > HIDDEN_RAD,
        &format!(
            "the points lie within {beside} of one line: {off} of error beside it turns the table by {turned}° about it; touch one \
             farther away"
        ),
    );
    let than = if stretch > 0.0 { "longer" } else { "shorter" };
    let percent = 100.0 * stretch.abs();
    tell(
        is_stretched,
        &format!(
            "lengths as touched are {percent:.2} % {than} than as drawn: look at the units, and at the points' lines"
        ),
    );
    let mount = &alignment.mount;
    tell(
        mount.translation.vector.norm() > NOTHING || mount.rotation.angle() > NOTHING,
        "a scenario with the keys above states plates by their places in the drawing; one without them by those in the frame of \
         the arm's root link (--point, --points)",
    );
    let tilt_rad = alignment.tilt_rad();
    let by = match tilt_rad > STEEP_RAD {
        true => format!("{}°", fixed(tilt_rad.to_degrees(), 1)),
        false => format!("{:.1} mm in a metre", 1e3 * tilt_rad),
    };
    tell(
        tilt_rad > TILTED_RAD,
        &format!(
            "the table is out of level by {by}; without robot.mount_m and robot.mount_rpy_deg plates are taken to lie level with the base: \
             state both, or level the table or the base"
        ),
    );
    notes
}
