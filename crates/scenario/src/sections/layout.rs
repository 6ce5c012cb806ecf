//! The `[layout]` section: the plates and the rule by which they are placed.
//!
//! The `[[plate]]` sections: plates one by one, each with its own shape and place, or kinds of plates to be sampled.

use crate::error::{Problem, conflict};
use crate::lossy_path::serialize_lossy;
use crate::measured::{FaceSide, Unit};
use crate::sections::body_shape::pose;
use crate::sections::robot::OriginLink;
use platewash_keys::Section;
use platewash_paper::PaperPart;
use platewash_workcell::job::Overlap;
use platewash_workcell::layout::PlateGeometry;
use platewash_workcell::plate::Plate;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Radius of a flat plate where none is stated \[m\].
pub const PLATE_RADIUS_M: f64 = 0.145;

/// `[layout]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("layout")]
#[serde(default, deny_unknown_fields)]
pub struct LayoutSection {
    /// Plates to sample; not used with `positions_m`.
    #[key(domain = Integer(1, 1000), default = 4)]
    pub count: usize,
    /// Radius of a flat plate, 0.145 without it; above 0.000001 in a certified job. The other profiles have their own.
    #[key(unit = "m", domain = NumberAbove(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_radius_m: Option<f64>,
    /// Shape of the washing surface: a flat disc, or a profile that comes along. `coupe275` is fitted to a scan of a real plate; the shapes of
    /// the others are assumptions.
    #[key(domain = Word(&["flat", "coupe275", "rim270", "deep230", "dessert190"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_profile: Option<ProfileName>,
    /// Shape of the washing surface by knots of its meridian, from the pole on, in place of `plate_profile`: radius and slope, above 0 where
    /// it rises outwards. Between knots the sine of the slope is linear in the radius: arcs and lines without a bend. At the pole the slope is
    /// 0, so that the first piece is an arc: [[0.105, 10]] has its rim 9.2 mm over the pole.
    #[key(unit = "m, deg", domain = Knots(10.0, 60.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_knots: Option<Vec<[f64; 2]>>,
    /// STL or OBJ file of a plate's mesh, in place of a profile: its axis is found, and a profile, thickness and foot are fitted to it. Its
    /// greatest deviation from them adds to the height error, so that the proof holds for the mesh. Relative to the scenario's folder.
    #[key(domain = Path)]
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub plate_mesh: Option<PathBuf>,
    /// CSV file of points that a probe touched on a plate's face, with columns x, y, z, in place of a mesh: the profile is fitted to them.
    /// Between the points the face is not measured.
    #[key(domain = Path)]
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub plate_points: Option<PathBuf>,
    /// Unit of the mesh or the points. Without it, the one in which the plate is from 0.145 to 0.365 m wide; a report names it.
    #[key(domain = Word(&["m", "cm", "mm", "inch"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_unit: Option<Unit>,
    /// Radius of the ball with which the probe touched; the points are then those of its centre. Without it, they are on the face.
    #[key(unit = "m", domain = NumberAbove(0.0, 0.1))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_ball_radius_m: Option<f64>,
    /// Direction of the file in which the washed face of the mesh or the points looks. Without it, the side that rises to its rim; of a flat plate
    /// the one towards +z.
    #[key(domain = Word(&["+x", "-x", "+y", "-y", "+z", "-z"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_face: Option<FaceSide>,
    /// Kind of soil on the plates: a name in wash.soil_file.
    #[key(domain = Text)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_soil: Option<String>,
    /// CSV file of plates, one a row: name, place (x_m, y_m, z_m; or touched_x_mm, touched_y_mm, touched_z_mm as the pendant shows the tip in the
    /// middle of the plate), and if wanted tilt_deg with tilt_azimuth_deg, kind, height_error_mm, soil. A kind is a built-in profile or the
    /// `kind` of a `[[plate]]` section.
    #[key(domain = Path)]
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub plate_file: Option<PathBuf>,
    /// Link from which the touched places of plate_file count: `base` of the arm's description, as a pendant does (REP-199), or its root
    /// link. To be stated where these two frames differ.
    #[key(domain = Word(&["root", "base"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub touched_from: Option<OriginLink>,
    /// Radius and height of the ring that a plate stands on, below its body; its radius is at most that of the rim.
    #[key(unit = "m", domain = PairAbove(0.0, 1.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_foot_m: Option<[f64; 2]>,
    /// z of the pole of the washing surface: of a flat one all of it, of a profile the middle of its well.
    #[key(unit = "m", domain = Number(-10.0, 10.0), default = 0.03)]
    pub plate_height_m: f64,
    /// Thickness of a plate, downwards from its washing surface, along its axis; above 0.000001 in a certified job.
    #[key(unit = "m", domain = NumberAbove(0.0, 1.0), default = 0.02)]
    pub plate_thickness_m: f64,
    /// Region of plate centres by name: as the paper's text, or as its appendix code.
    #[key(domain = Word(&["text", "appendix"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<PaperPart>,
    /// Range of x of plate centres.
    #[key(unit = "m", domain = Range(-10.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_m: Option<[f64; 2]>,
    /// Range of y of plate centres.
    #[key(unit = "m", domain = Range(-10.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_m: Option<[f64; 2]>,
    /// Range of the distance of plate centres from the base axis.
    #[key(unit = "m", domain = Range(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rho_m: Option<[f64; 2]>,
    /// Range of the azimuth of plate centres, counter-clockwise from x, at most a turn wide.
    #[key(unit = "deg", domain = Range(-720.0, 720.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub azimuth_deg: Option<[f64; 2]>,
    /// Plate centres are farther apart than this.
    #[key(unit = "m", domain = Number(0.0, 10.0), default = 0.28)]
    pub min_distance_m: f64,
    /// Plate centres are farther from the base axis than this.
    #[key(unit = "m", domain = Number(0.0, 10.0), default = 0.25)]
    pub base_radius_m: f64,
    /// Plates that overlap each other or the base: a finding only, or refused before planning.
    #[key(domain = Word(&["report", "fail"]), default = Overlap::Fail)]
    pub overlap: Overlap,
    /// Draws sampled layouts anew until every plate can be washed whole (certified).
    #[key(domain = Bool)]
    pub only_washable: bool,
    /// Plate centres, in place of sampling: as many plates as are listed.
    #[key(unit = "m", domain = Points(-10.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub positions_m: Option<Vec<[f64; 2]>>,
}

/// Shapes of washing surfaces by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProfileName {
    /// A flat disc, of the radius stated.
    Flat,
    /// A coupe plate, 275 mm wide.
    Coupe275,
    /// A plate with a rim, 270 mm wide.
    Rim270,
    /// A deep plate, 230 mm wide.
    Deep230,
    /// A dessert plate, 190 mm wide.
    Dessert190,
}

impl ProfileName {
    /// Its name in a file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::Coupe275 => "coupe275",
            Self::Rim270 => "rim270",
            Self::Deep230 => "deep230",
            Self::Dessert190 => "dessert190",
        }
    }
}

impl LayoutSection {
    /// The key that decides the shape of a plate.
    pub(crate) fn shape_key(&self) -> &'static str {
        match (&self.plate_knots, self.plate_profile) {
            (Some(_), _) => "layout.plate_knots",
            (None, Some(profile)) if profile != ProfileName::Flat => "layout.plate_profile",
            _ => "layout.plate_radius_m",
        }
    }

    /// Refuses two shapes at once, knots that are no meridian, and a foot that is wider than its plate.
    pub(crate) fn check_shape(&self) -> Result<(), Problem> {
        let files = [
            ("layout.plate_mesh", &self.plate_mesh),
            ("layout.plate_points", &self.plate_points),
        ];
        let mut files = files.into_iter().filter(|(_, file)| file.is_some());
        if let Some((key, _)) = files.next() {
            let others = [
                files.next().map(|(key, _)| key),
                self.plate_knots.as_ref().map(|_| "layout.plate_knots"),
                self.plate_profile.map(|_| "layout.plate_profile"),
                self.plate_radius_m.map(|_| "layout.plate_radius_m"),
            ];
            return match others.into_iter().flatten().next() {
                Some(other) => conflict(
                    format!("{key}, {other}"),
                    "the file states the shape of the plate: leave the other out",
                ),
                // The shape is checked once it is read.
                None => Ok(()),
            };
        }
        for (key, is_stated, what) in [
            ("layout.plate_unit", self.plate_unit.is_some(), "unit"),
            ("layout.plate_face", self.plate_face.is_some(), "face"),
            ("layout.plate_ball_radius_m", self.plate_ball_radius_m.is_some(), "ball"),
        ] {
            if is_stated {
                return conflict(key, format!("is the {what} of a mesh or of points, and there are none"));
            }
        }
        if let (Some(profile), Some(_)) = (self.plate_profile, &self.plate_knots) {
            return conflict(
                "layout.plate_profile, layout.plate_knots",
                format!(
                    "give a profile by name or by its knots; found \"{}\" and knots",
                    profile.name()
                ),
            );
        }
        if let Some(radius_m) = self.plate_radius_m
            && self.shape_key() != "layout.plate_radius_m"
        {
            return conflict(
                format!("{}, layout.plate_radius_m", self.shape_key()),
                format!(
                    "the profile has its own radius, {} m; found plate_radius_m = {radius_m}: leave one of them out",
                    self.surface().rim_m()
                ),
            );
        }
        if let Some(Err(none)) = self.profile_of_knots() {
            return conflict("layout.plate_knots", none.to_string());
        }
        let rim_m = self.surface().rim_m();
        match self.plate_foot_m {
            Some([radius_m, _]) if radius_m > rim_m => conflict(
                format!("layout.plate_foot_m, {}", self.shape_key()),
                format!("the foot's radius must be at most that of the rim, {rim_m} m; found {radius_m}"),
            ),
            _ => Ok(()),
        }
    }
}

/// `[[plate]]`: a plate, or a kind of plates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("plate")]
#[serde(default, deny_unknown_fields)]
pub struct PlateSection {
    /// Position of the pole of its washing surface in the world: of a flat one the middle. In every section, or in none.
    #[key(unit = "m", domain = Triple(-10.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<[f64; 3]>,
    /// Orientation: roll, pitch and yaw about the fixed axes x, y, z of the world. Unturned it lies level, face up.
    #[key(unit = "deg", domain = Triple(-360.0, 360.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
    /// Which faces of a flat plate are washed: that at at_m alone, or the other one, too, which counts as a plate of its own, the next one.
    #[key(domain = Word(&["one", "both"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<Faces>,
    /// Number of plates of this kind that are sampled, in place of `at_m`; centres keep `layout.min_distance_m` apart whatever their kinds.
    #[key(domain = Integer(1, 1000))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// Radius of a flat plate. A section without a shape of its own takes that of `[layout]`.
    #[key(unit = "m", domain = NumberAbove(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Shape of the washing surface by name.
    #[key(domain = Word(&["flat", "coupe275", "rim270", "deep230", "dessert190"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<ProfileName>,
    /// Shape of the washing surface by knots of its meridian, as `layout.plate_knots`.
    #[key(unit = "m, deg", domain = Knots(10.0, 60.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub knots: Option<Vec<[f64; 2]>>,
    /// STL or OBJ file of its mesh, as `layout.plate_mesh`.
    #[key(domain = Path)]
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub mesh: Option<PathBuf>,
    /// CSV file of points that a probe touched on its face, as `layout.plate_points`.
    #[key(domain = Path)]
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub points: Option<PathBuf>,
    /// Unit of the mesh or the points, as `layout.plate_unit`.
    #[key(domain = Word(&["m", "cm", "mm", "inch"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Radius of the ball with which the probe touched, as `layout.plate_ball_radius_m`.
    #[key(unit = "m", domain = NumberAbove(0.0, 0.1))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ball_radius_m: Option<f64>,
    /// Direction of the file in which the washed face of the mesh or the points looks, as `layout.plate_face`.
    #[key(domain = Word(&["+x", "-x", "+y", "-y", "+z", "-z"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face: Option<FaceSide>,
    /// Name of this kind, where the plates are those of layout.plate_file: the section states a kind and no plate.
    #[key(domain = Text)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// Kind of soil on it: a name in wash.soil_file. Without it, layout.plate_soil.
    #[key(domain = Text)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub soil: Option<String>,
    /// Height error of this plate, up or down. Without it, wash.contact_height_error_m.
    #[key(unit = "m", domain = Number(0.0, 1.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_error_m: Option<f64>,
    /// Radius and height of the ring that it stands on; without it, that of `[layout]`, if any.
    #[key(unit = "m", domain = PairAbove(0.0, 1.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub foot_m: Option<[f64; 2]>,
    /// Its thickness; without it, that of `[layout]`.
    #[key(unit = "m", domain = NumberAbove(0.0, 1.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_m: Option<f64>,
}

/// Which faces of a plate are washed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Faces {
    /// One.
    One,
    /// Both.
    Both,
}

impl PlateSection {
    /// True where both faces of the plate are washed.
    pub(crate) fn has_both(&self) -> bool {
        self.faces == Some(Faces::Both)
    }

    /// True where the section states a shape of its own.
    pub(crate) fn has_shape(&self) -> bool {
        let by_size = self.radius_m.is_some() || self.profile.is_some() || self.knots.is_some();
        by_size || self.mesh.is_some() || self.points.is_some()
    }

    /// The section of a layout in which every plate is one of these.
    pub(crate) fn as_layout(&self, layout: &LayoutSection) -> LayoutSection {
        let mut own = layout.clone();
        if self.has_shape() {
            own.plate_radius_m = self.radius_m;
            own.plate_profile = self.profile;
            own.plate_knots.clone_from(&self.knots);
            own.plate_mesh.clone_from(&self.mesh);
            own.plate_points.clone_from(&self.points);
            own.plate_unit = self.unit;
            own.plate_ball_radius_m = self.ball_radius_m;
            own.plate_face = self.face;
        }
        own.plate_soil = self.soil.clone().or(own.plate_soil);
        own.plate_foot_m = self.foot_m.or(own.plate_foot_m);
        own.plate_thickness_m = self.thickness_m.unwrap_or(own.plate_thickness_m);
        own
    }

    /// The plate, where it says where it is, or both of its faces.
    pub(crate) fn faces_of(&self, geometry: &PlateGeometry) -> Option<Vec<Plate>> {
        let plate = Plate {
            surface: geometry.surface,
            thickness_m: geometry.thickness_m,
            foot: geometry.foot,
            pose: pose(self.at_m?, self.rpy_deg.unwrap_or_default()),
            terms: geometry.terms,
        };
        Some(match plate.faces().filter(|_| self.has_both()) {
            Some(both) => both.to_vec(),
            None => vec![plate],
        })
    }
}
