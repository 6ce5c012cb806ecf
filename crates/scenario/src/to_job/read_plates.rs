//! Plates out of files: meshes, points that a probe touched, a table of places; and kinds of soil.
//!
//! Once its files are read, a scenario is as if its text stated what they say: a profile for a mesh, a `[[plate]]` section for a row.

use crate::error::{Problem, ScenarioError, conflict};
use crate::measured::{self, FaceSide, MeasuredError, MeasuredPlate, Unit};
use crate::scenario::Scenario;
use crate::sections::layout::{LayoutSection, PlateSection, ProfileName};
use crate::sections::motion::Program;
use crate::sections::robot::OriginLink;
use crate::source::{MAX_BYTES, unread};
use crate::to_job::mount::place_words;
use crate::to_job::placement::ShapeKeys;
use crate::to_job::plate_files::ReadFiles;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::urdf::MeshSource;
use platewash_workcell::job::{MeasuredShape, Soil};
use platewash_workcell::layout::MAX_PLATES;
use platewash_workcell::number_table::{NumberTable, Row, TableError, TableShape};
use platewash_workcell::plate::PlateTerms;
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{PatternName, StatedNumbers};
use serde::Deserialize;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Longest table of plates or points that is read \[bytes\].
const MOST_TABLE_BYTES: u64 = 16 << 20;

/// Greatest length or angle in a table of plates.
const MOST: f64 = 1e5;

/// Greatest coordinate of a plate \[m\].
const FARTHEST_M: f64 = 10.0;

/// Keys of `[layout]` that state a measured shape.
const OF_LAYOUT: [&str; 5] = [
    "layout.plate_mesh",
    "layout.plate_points",
    "layout.plate_unit",
    "layout.plate_face",
    "layout.plate_ball_radius_m",
];

/// Measurement as its keys state it: mesh, points, unit, face, radius of the probe's ball \[m\].
type Measurement = (
    Option<PathBuf>,
    Option<PathBuf>,
    Option<Unit>,
    Option<FaceSide>,
    Option<f64>,
);

/// Columns of a table of plates.
const NAME: [&str; 1] = ["name"];
const PLACE: [&str; 3] = ["x_m", "y_m", "z_m"];
const TOUCHED: [&str; 3] = ["touched_x_mm", "touched_y_mm", "touched_z_mm"];
const TILT: [&str; 2] = ["tilt_deg", "tilt_azimuth_deg"];
const KIND: [&str; 1] = ["kind"];
const ERROR: [&str; 1] = ["height_error_mm"];
const SOIL: [&str; 1] = ["soil"];

impl Scenario {
    /// Kinds of soil, once their file was read.
    pub(crate) fn soils(&self) -> &[Soil] {
        self.plate_files.read.as_ref().map_or(&[], |files| &files.soils)
    }

    /// Shapes of plates that were measured, once their files were read.
    pub(crate) fn measured(&self) -> &[MeasuredShape] {
        self.plate_files.read.as_ref().map_or(&[], |files| &files.measured)
    }

    /// Terms of the plates of a `[[plate]]` section, or of `[layout]`, whose own keys `layout` has.
    pub(crate) fn plate_terms(&self, section: Option<usize>, layout: &LayoutSection) -> PlateTerms {
        let measured = self.plate_files.read.as_ref().and_then(|files| {
            let index = section.unwrap_or(0);
            files.of_section.get(index).copied().flatten()
        });
        let soil = layout.plate_soil.as_ref();
        PlateTerms {
            height_error_m: section.and_then(|index| self.plate.get(index)?.height_error_m),
            deviation_m: measured.map(|index| self.measured()[index].deviation_m),
            measured,
            soil: soil.and_then(|name| self.soils().iter().position(|soil| soil.name == *name)),
        }
    }

    /// Refuses keys of files, soils and height errors that contradict others.
    pub(crate) fn check_plate_files(&self) -> Result<(), Problem> {
        let (layout, wash) = (&self.layout, &self.wash);
        if self.job.program == Program::Paper && !self.plate_paths().is_empty() {
            let detail = "the paper's program washes flat plates that the text states, or job.program = \"certified\"";
            return conflict("layout.plate_file, layout.plate_mesh, wash.soil_file", detail);
        }
        if layout.plate_file.is_some() && layout.positions_m.is_some() {
            return conflict(
                "layout.plate_file, layout.positions_m",
                "both say where the plates are: leave one out",
            );
        }
        if layout.touched_from.is_some() && layout.plate_file.is_none() {
            return conflict(
                "layout.touched_from",
                "is of the touched places of layout.plate_file, and there is none",
            );
        }
        let rows = || self.plate.iter().enumerate();
        for (index, row) in rows() {
            let at = |name: &str| format!("plate[{index}].{name}");
            let is_measured = row.mesh.is_some() || row.points.is_some();
            for (key, is_stated) in [
                ("unit", row.unit.is_some()),
                ("face", row.face.is_some()),
                ("ball_radius_m", row.ball_radius_m.is_some()),
            ] {
                if is_stated && !is_measured {
                    conflict(
                        at(key),
                        format!("is the {key} of a mesh or of points, and there are none"),
                    )?;
                }
            }
            match (&row.kind, &layout.plate_file) {
                (Some(_), None) => conflict(
                    at("kind"),
                    "names a kind for the rows of layout.plate_file, and there is none",
                )?,
                (None, Some(_)) => conflict(
                    at("kind"),
                    "is missing: with layout.plate_file a [[plate]] section states a kind of plates, by its name",
                )?,
                (Some(_), Some(_)) if row.at_m.is_some() || row.count.is_some() => conflict(
                    at("kind"),
                    "a kind has no place and no count: the rows of layout.plate_file have theirs",
                )?,
                _ => {}
            }
            let twice = row.kind.is_some() && self.plate[..index].iter().any(|other| other.kind == row.kind);
            if twice {
                conflict(at("kind"), "another section has this name")?;
            }
            if row.height_error_m.is_some() && !wash.contact {
                conflict(at("height_error_m"), "is for a proof of contact, wash.contact = true")?;
            }
        }
        let of_rows = rows().filter_map(|(index, row)| Some((format!("plate[{index}].soil"), row.soil.as_ref()?)));
        let of_layout = layout.plate_soil.as_ref();
        for (key, name) in of_layout
            .map(|name| ("layout.plate_soil".to_owned(), name))
            .into_iter()
            .chain(of_rows)
        {
            if wash.soil_file.is_none() {
                conflict(
                    format!("{key}, wash.soil_file"),
                    format!("there is no file that states the soil \"{name}\""),
                )?;
            }
            self.check_soil(&key, name)?;
        }
        if wash.soil_file.is_some() && !wash.contact {
            return conflict(
                "wash.soil_file",
                "a soil asks for a dose and a force, which wash.contact = true proves",
            );
        }
        Ok(())
    }

    /// Refuses a soil that the file does not state, or that no path here can wash; nothing before the file is read.
    fn check_soil(&self, key: &str, name: &str) -> Result<(), Problem> {
        let Some(files) = &self.plate_files.read else {
            return Ok(());
        };
        let Some(soil) = files.soils.iter().find(|soil| soil.name == name) else {
            let all: Vec<_> = files.soils.iter().map(|soil| soil.name.as_str()).collect();
            let detail = format!("there is no soil \"{name}\" in the file; it has {}", all.join(", "));
            return conflict(format!("{key}, wash.soil_file"), detail);
        };
        let wash = &self.wash;
        let stated = StatedNumbers {
            turns: wash.turns,
            path_radius_m: wash.path_radius_m,
            closing_ring: wash.closing_ring,
        };
        let once = PatternName::asked(wash.pattern, &stated).filter(|pattern| !pattern.rules().repeats);
        if let Some(pattern) = once.filter(|_| soil.passes.is_some_and(|passes| passes > 1)) {
            let detail = format!(
                "the soil \"{name}\" asks for {} passes, and a {} passes each place once: wash.pattern = \"rings\" goes round each ring as often",
                soil.passes.unwrap_or(1),
                pattern.rules().name
            );
            return conflict(format!("{key}, wash.pattern"), detail);
        }
        Ok(())
    }

    /// Returns the scenario with its files of plates and soils read, or itself where there are none or they were read.
    ///
    /// # Errors
    /// [`ScenarioError`] with the key and the file: one that cannot be read, a mesh that is no round plate, a row that states none.
    pub fn plates_read(&self) -> Result<Cow<'_, Self>, ScenarioError> {
        if self.plate_files.are_read() || self.plate_paths().is_empty() {
            return Ok(Cow::Borrowed(self));
        }
        let refused = |problem| ScenarioError::new(&self.name, None, problem);
        let mut read = self.clone();
        let mut files = ReadFiles {
            paths: self.plate_paths().into_iter().cloned().collect(),
            soils: self.read_soils().map_err(refused)?,
            ..ReadFiles::default()
        };
        let layout = &mut read.layout;
        let stated = (
            layout.plate_mesh.take(),
            layout.plate_points.take(),
            layout.plate_unit.take(),
            layout.plate_face.take(),
            layout.plate_ball_radius_m.take(),
        );
        let plate = self.measure(stated, ShapeKeys(None), &mut files);
        let of_layout = plate.map_err(refused)?.map(|(index, shape)| {
            layout.plate_thickness_m = shape.thickness_m(layout.plate_thickness_m);
            (layout.plate_radius_m, layout.plate_knots) = (shape.radius_m, shape.knots);
            layout.plate_foot_m = shape.foot_m.or(layout.plate_foot_m);
            index
        });
        for (k, row) in read.plate.iter_mut().enumerate() {
            // A section without a shape of its own takes that of the layout.
            let has_own = row.has_shape();
            let stated = (
                row.mesh.take(),
                row.points.take(),
                row.unit.take(),
                row.face.take(),
                row.ball_radius_m.take(),
            );
            let plate = self.measure(stated, ShapeKeys(Some(k)), &mut files);
            let index = plate.map_err(refused)?.map(|(index, shape)| {
                // What was measured counts, so that the body holds the mesh.
                row.thickness_m = Some(shape.thickness_m(row.thickness_m.unwrap_or(self.layout.plate_thickness_m)));
                (row.radius_m, row.knots) = (shape.radius_m, shape.knots);
                row.foot_m = shape.foot_m.or(row.foot_m);
                index
            });
            files.of_section.push(if has_own { index } else { of_layout });
        }
        if self.plate.is_empty() {
            files.of_section.push(of_layout);
        }
        if let Some(path) = read.layout.plate_file.take() {
            read.layout.touched_from = None;
            files.have_places = true;
            let kinds = std::mem::take(&mut read.plate);
            let of_kinds = std::mem::take(&mut files.of_section);
            let key = "layout.plate_file";
            let text = self.text_of(&path, key, MOST_TABLE_BYTES).map_err(refused)?;
            let rows = self.table(&text, &kinds);
            let rows = rows.map_err(|error| refused(Problem::of_file(key, &path, error)))?;
            for (row, kind) in rows {
                let of_kind = kind.and_then(|kind| of_kinds[kind]);
                files.of_section.push(if row.has_shape() { of_kind } else { of_layout });
                read.plate.push(row);
            }
        }
        read.plate_files.read = Some(Arc::new(files));
        read.validate()?;
        read.check_plate_files().map_err(refused)?;
        Ok(Cow::Owned(read))
    }

    /// Measures the plate of a mesh or of points, if one of them is stated; adds it to the files, with its index, and tells its shape.
    fn measure(
        &self,
        (mesh, points, unit, face, ball_radius_m): Measurement,
        keys: ShapeKeys,
        files: &mut ReadFiles,
    ) -> Result<Option<(usize, Shape)>, Problem> {
        let is_probed = mesh.is_none();
        let keys = OF_LAYOUT.map(|key| keys.called(key));
        let [of_mesh, of_points, of_unit, of_side, of_ball] = keys.each_ref().map(String::as_str);
        let misfit = |key: &str, path: &Path, error: MeasuredError| {
            let hint = match error {
                MeasuredError::Unit { .. } => format!(" ({of_unit})"),
                MeasuredError::OtherSide { .. } | MeasuredError::FaceUnclear { .. } => format!(" ({of_side})"),
                _ => String::new(),
            };
            Problem::of_file(key, path, format_args!("{error}{hint}"))
        };
        if mesh.is_some() && ball_radius_m.is_some() {
            conflict(
                of_ball,
                "is the ball with which points were touched, and a mesh is stated",
            )?;
        }
        let (path, plate) = match (mesh, points) {
            (Some(path), _) => {
                let source = MeshSource::new(&self.robot.package_path, None).reading(&self.files);
                let scan = source
                    .scan(&path.to_string_lossy())
                    .map_err(|error| Problem::of_file(of_mesh, &path, error))?;
                // What states its unit comes in metres.
                let unit = match (unit, scan.unit_m) {
                    (Some(unit), Some(of_file_m)) if unit.length_m() != of_file_m => {
                        let unit = unit.name();
                        let detail = format_args!(
                            "the file states its unit, {of_file_m} m, and the unit {unit} is stated, too; leave it out"
                        );
                        return Err(Problem::of_file(of_unit, &path, detail));
                    }
                    (_, Some(_)) => Some(Unit::Metre),
                    (unit, None) => unit,
                };
                let plate = self.solids.plate(&scan.triangles, unit, face);
                let plate = plate.map_err(|error| misfit(of_mesh, &path, error))?;
                (path, plate)
            }
            (None, Some(path)) => {
                let text = self.text_of(&path, of_points, MOST_TABLE_BYTES)?;
                let touched = measured::probe_points(&text);
                let (touched, stated) = touched.map_err(|error| Problem::of_file(of_points, &path, error))?;
                if let (Some(unit), Some(of_file)) = (unit, stated)
                    && unit != of_file
                {
                    let [unit, of_file] = [unit, of_file].map(Unit::name);
                    let detail =
                        format_args!("its columns are in {of_file}, and the unit {unit} is stated, too; leave it out");
                    return Err(Problem::of_file(of_unit, &path, detail));
                }
                let unit = stated.or(unit);
                let plate = match ball_radius_m {
                    Some(radius_m) => measured::from_ball_centres(&touched, radius_m, unit, face),
                    None => measured::from_points(&touched, unit, face),
                };
                let plate = plate.map_err(|error| misfit(of_points, &path, error))?;
                (path, plate)
            }
            (None, None) => return Ok(None),
        };
        let guessed = if plate.unit_is_guessed { " (guessed)" } else { "" };
        let name = path.file_name().unwrap_or(path.as_os_str());
        files.measured.push(MeasuredShape {
            file: name.to_string_lossy().into_owned(),
            unit: format!("{}{guessed}", plate.unit.name()),
            is_probed,
            deviation_m: plate.deviation_m,
            out_of_round_m: plate.out_of_round_m,
            relief: plate.relief.clone(),
        });
        Ok(Some((files.measured.len() - 1, Shape::from_measured(&plate))))
    }

    /// The text of a file that a key names.
    fn text_of(&self, path: &Path, key: &str, limit: u64) -> Result<String, Problem> {
        let bytes = self.files.read_bytes(path, limit);
        let bytes = bytes.map_err(|error| Problem::of_file(key, path, unread(error)))?;
        String::from_utf8(bytes.to_vec()).map_err(|_| Problem::of_file(key, path, "is not UTF-8 text"))
    }

    /// The frames in which a touched place may be, in the world: that of the arm's root link, and that of the controller's base.
    fn touched_frames(&self) -> Result<[Pose; 2], String> {
        let arm = self.arm().map_err(|error| error.to_string())?;
        self.check_mount(&arm).map_err(|error| error.problem.to_string())?;
        let mount = self.robot.mount(&arm);
        Ok([mount, arm.controller_base().map_or(mount, |base| mount * base.pose)])
    }

    /// The rows of a table of plates as `[[plate]]` sections, each with the index of its kind.
    fn table(&self, text: &str, kinds: &[PlateSection]) -> Result<Vec<(PlateSection, Option<usize>)>, TableError> {
        let shape = TableShape {
            required: &NAME,
            optional: &[&PLACE, &TOUCHED, &TILT, &KIND, &ERROR, &SOIL],
            most: MOST,
            most_rows: MAX_PLATES,
            has_comments: true,
        };
        let table = NumberTable::read(text, &shape)?;
        let at_head = |reason: String| TableError {
            line: 1,
            column: None,
            reason,
        };
        let is_touched = match (table.places(&PLACE), table.places(&TOUCHED)) {
            (Some(_), None) => false,
            (None, Some(_)) => true,
            _ => {
                let reason = format!(
                    "expected the columns {} or {}, one of them",
                    PLACE.join(","),
                    TOUCHED.join(",")
                );
                return Err(at_head(reason));
            }
        };
        let touched = match is_touched {
            true => Some(self.touched_frames().map_err(at_head)?),
            false if self.layout.touched_from.is_some() => {
                return Err(at_head(
                    "layout.touched_from is of touched places, and no column states any".to_owned(),
                ));
            }
            false => None,
        };
        let mut names: Vec<String> = Vec::new();
        let mut rows = Vec::new();
        for row in table.rows() {
            let row = row?;
            if let Some([place]) = table.places(&NAME) {
                let name = row.text(place).to_owned();
                if name.is_empty() || names.contains(&name) {
                    let what = if name.is_empty() { "is empty" } else { "is there twice" };
                    return row.refused(place, format!("the name {what}; expected another name for each plate"));
                }
                names.push(name);
            }
            let at = |columns: &[&str; 3]| table.places(columns).map(|places| row.numbers(places)).transpose();
            let at_m = match &touched {
                Some(frames) => {
                    let tip = Point3::from(at(&TOUCHED)?.unwrap_or_default().map(|mm| 1e-3 * mm));
                    let [as_root, as_base] = frames.each_ref().map(|frame| (frame * tip).coords.into());
                    match self.layout.touched_from {
                        Some(OriginLink::Root) => as_root,
                        Some(OriginLink::Base) => as_base,
                        None if frames[0] == frames[1] => as_root,
                        None => {
                            let [place, ..] = table.places(&TOUCHED).unwrap_or_default();
                            let [as_root, as_base] = [as_root, as_base].map(place_words);
                            let reason = format!(
                                "the controller's base lies apart from the root link of the arm; found touched places, and nothing that says from which of \
                                 the two they count. With layout.touched_from = \"root\" the plate is at {as_root} in the world, with \"base\" at \
                                 {as_base}; state one of them: a pendant counts from \"base\""
                            );
                            return row.refused(place, reason);
                        }
                    }
                }
                None => at(&PLACE)?.unwrap_or_default(),
            };
            if at_m.iter().any(|at: &f64| at.abs() > FARTHEST_M) {
                let columns = if is_touched { &TOUCHED } else { &PLACE };
                let [place, ..] = table.places(columns).unwrap_or_default();
                let reason = format!("the plate would be at {at_m:?} m; expected a place within ±{FARTHEST_M} m");
                return row.refused(place, reason);
            }
            let (kind, mut section) = kind_of(&table, &row, kinds)?;
            section.at_m = Some(at_m);
            if let Some(places) = table.places(&TILT) {
                let [tilt_deg, azimuth_deg] = row.numbers(places)?;
                section.rpy_deg = Some(tilted_deg(tilt_deg, azimuth_deg));
            }
            if let Some([place]) = table.places(&ERROR).filter(|[place]| !row.text(*place).is_empty()) {
                let [error_mm] = row.numbers([place])?;
                if !(0.0..=1e3).contains(&error_mm) {
                    return row.refused(
                        place,
                        format!("found {error_mm}; expected a height error from 0 to 1000 mm"),
                    );
                }
                section.height_error_m = Some(1e-3 * error_mm);
            }
            if let Some([place]) = table.places(&SOIL).filter(|[place]| !row.text(*place).is_empty()) {
                section.soil = Some(row.text(place).to_owned());
            }
            rows.push((section, kind));
        }
        Ok(rows)
    }

    /// The kinds of soil in the file that the text names.
    fn read_soils(&self) -> Result<Vec<Soil>, Problem> {
        let Some(path) = &self.wash.soil_file else {
            return Ok(Vec::new());
        };
        let key = "wash.soil_file";
        let text = self.text_of(path, key, MAX_BYTES)?;
        let refused = |detail: String| Problem::of_file(key, path, detail);
        let file: SoilFile = toml::from_str(&text).map_err(|error| refused(error.to_string().trim_end().to_owned()))?;
        for (index, soil) in file.soil.iter().enumerate() {
            let name = &soil.name;
            let bad = |what: &str, expected: &str| Err(refused(format!("soil \"{name}\": {what} must be {expected}")));
            if name.trim().is_empty() || soil.source.trim().is_empty() {
                return bad(
                    "name and source",
                    "texts that are not empty; the source may be \"assumed\"",
                );
            }
            if file.soil[..index].iter().any(|other| other.name == *name) {
                return bad("name", "another one than those before");
            }
            soil.validate().map_err(|error| {
                let words = error.to_string();
                let words = words.strip_prefix("job: soils.").unwrap_or(&words);
                refused(format!("soil \"{name}\": {words}"))
            })?;
        }
        Ok(file.soil)
    }
}

/// File of soils.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SoilFile {
    soil: Vec<Soil>,
}

/// Keys of a shape that was measured.
struct Shape {
    radius_m: Option<f64>,
    knots: Option<Vec<[f64; 2]>>,
    /// Thickness, if the body was measured, and the least one otherwise.
    measured_m: Option<f64>,
    least_m: f64,
    foot_m: Option<[f64; 2]>,
}

impl Shape {
    fn from_measured(plate: &MeasuredPlate) -> Self {
        let (radius_m, knots) = match &plate.surface {
            Surface::Profile(meridian) => {
                let knots = meridian.knots().iter();
                let knots = knots.map(|knot| [knot.radius_m, knot.slope_rad.to_degrees()]).collect();
                (None, Some(knots))
            }
            flat => (Some(flat.rim_m()), None),
        };
        Self {
            radius_m,
            knots,
            measured_m: plate.thickness_m,
            least_m: plate.least_thickness_m,
            foot_m: plate.foot.map(|foot| [foot.radius_m, foot.height_m]),
        }
    }

    /// Thickness of the plate: as measured, otherwise as stated, and so thick that the body holds the whole mesh \[m\].
    fn thickness_m(&self, stated_m: f64) -> f64 {
        self.measured_m.unwrap_or_else(|| stated_m.max(self.least_m))
    }
}

/// The section of a row's kind, and its index among the kinds of the scenario.
fn kind_of(
    table: &NumberTable<'_>,
    row: &Row<'_>,
    kinds: &[PlateSection],
) -> Result<(Option<usize>, PlateSection), TableError> {
    let Some([place]) = table.places(&KIND).filter(|[place]| !row.text(*place).is_empty()) else {
        return Ok((None, PlateSection::default()));
    };
    let name = row.text(place);
    if let Some(index) = kinds.iter().position(|kind| kind.kind.as_deref() == Some(name)) {
        let section = PlateSection {
            kind: None,
            ..kinds[index].clone()
        };
        return Ok((Some(index), section));
    }
    let profiles = [
        ProfileName::Flat,
        ProfileName::Coupe275,
        ProfileName::Rim270,
        ProfileName::Deep230,
        ProfileName::Dessert190,
    ];
    match profiles.into_iter().find(|profile| profile.name() == name) {
        Some(profile) => Ok((
            None,
            PlateSection {
                profile: Some(profile),
                ..PlateSection::default()
            },
        )),
        None => {
            let stated = kinds.iter().filter_map(|kind| kind.kind.as_deref());
            let all: Vec<_> = stated.chain(profiles.map(ProfileName::name)).collect();
            row.refused(
                place,
                format!("there is no kind \"{name}\"; expected one of {}", all.join(", ")),
            )
        }
    }
}

/// Roll, pitch and yaw \[°\] of a plate whose axis leans by an angle from the vertical towards an azimuth \[°\].
fn tilted_deg(tilt_deg: f64, azimuth_deg: f64) -> [f64; 3] {
    let about = |axis, deg: f64| UnitQuaternion::from_axis_angle(&axis, deg.to_radians());
    let (z, y) = (Vector3::z_axis(), Vector3::y_axis());
    let turn = about(z, azimuth_deg) * about(y, tilt_deg) * about(z, -azimuth_deg);
    let (roll, pitch, yaw) = turn.euler_angles();
    [roll, pitch, yaw].map(f64::to_degrees)
}
