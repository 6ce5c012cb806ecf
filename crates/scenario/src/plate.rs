//! The `[[plate]]` sections: plates one by one, each with its own shape and place, or kinds of plates to be sampled.

use crate::layout::{LayoutSection, ProfileName};
use crate::poses::pose;
use platewash_keys::Section;
use platewash_workcell::layout::PlateGeometry;
use platewash_workcell::plate::Plate;
use serde::{Deserialize, Serialize};

/// `[[plate]]`: a plate, or a kind of plates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("plate")]
#[serde(default, deny_unknown_fields)]
pub struct PlateSection {
    /// Where the pole of its washing surface is, in the world: of a flat one the middle. In every section, or in none.
    #[key(unit = "m", domain = Triple(-10.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<[f64; 3]>,
    /// How it is turned there: roll, pitch and yaw about the fixed axes x, y, z of the world. Unturned it lies level, face up.
    #[key(unit = "deg", domain = Triple(-360.0, 360.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
    /// Which faces of a flat plate are washed: that at at_m alone, or the other one, too, which counts as a plate of its own, the next one.
    #[key(domain = Word(&["one", "both"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<Faces>,
    /// How many plates of this kind are sampled, in place of `at_m`; centres keep `layout.min_distance_m` apart whatever their kinds.
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
    /// Whether both of its faces are washed.
    pub(crate) fn has_both(&self) -> bool {
        self.faces == Some(Faces::Both)
    }

    /// The section of a layout in which every plate is one of these.
    pub(crate) fn of(&self, layout: &LayoutSection) -> LayoutSection {
        let mut own = layout.clone();
        if self.radius_m.is_some() || self.profile.is_some() || self.knots.is_some() {
            own.plate_radius_m = self.radius_m;
            own.plate_profile = self.profile;
            own.plate_knots.clone_from(&self.knots);
        }
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
        };
        Some(match plate.faces().filter(|_| self.has_both()) {
            Some(both) => both.to_vec(),
            None => vec![plate],
        })
    }
}
