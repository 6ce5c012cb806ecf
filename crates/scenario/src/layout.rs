//! The `[layout]` section: the plates and the rule by which they are placed.

use crate::error::{Problem, conflict};
use platewash_workcell::job::Overlap;
use platewash_workcell::layout::Region;
use serde::{Deserialize, Serialize};

/// Radius of a flat plate where none is stated \[m\].
pub const PLATE_RADIUS_M: f64 = 0.145;

/// `[layout]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LayoutSection {
    /// Plates to sample.
    pub count: usize,
    /// Radius of a flat plate \[m\]; without it, 0.145. Not with another profile.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_radius_m: Option<f64>,
    /// Shape of the washing surface by name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_profile: Option<ProfileName>,
    /// Shape of the washing surface by knots of its meridian: radius \[m\] and slope \[deg\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_knots: Option<Vec<[f64; 2]>>,
    /// Radius and height of the ring that a plate stands on \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_foot_m: Option<[f64; 2]>,
    /// z of the pole of the washing surface \[m\].
    pub plate_height_m: f64,
    /// Thickness of a plate, downwards \[m\].
    pub plate_thickness_m: f64,
    /// A region by name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<RegionName>,
    /// Range of x \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_m: Option<[f64; 2]>,
    /// Range of y \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_m: Option<[f64; 2]>,
    /// Range of the distance from the base axis \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rho_m: Option<[f64; 2]>,
    /// Range of the azimuth \[deg\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub azimuth_deg: Option<[f64; 2]>,
    /// Least distance between centres \[m\].
    pub min_distance_m: f64,
    /// Least distance of a centre from the base axis \[m\].
    pub base_radius_m: f64,
    /// What overlapping plates lead to.
    pub overlap: Overlap,
    /// Whether layouts are drawn until every plate can be washed whole.
    pub only_washable: bool,
    /// Plate centres, in place of sampling \[m\].
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

/// The paper's two regions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RegionName {
    /// As the paper's text says.
    Text,
    /// As its appendix code says.
    Appendix,
}

impl RegionName {
    /// The region it names.
    #[must_use]
    pub fn region(self) -> Region {
        match self {
            Self::Text => Region::PAPER_TEXT,
            Self::Appendix => Region::PAPER_APPENDIX,
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

impl Default for LayoutSection {
    fn default() -> Self {
        Self {
            count: 4,
            plate_radius_m: None,
            plate_profile: None,
            plate_knots: None,
            plate_foot_m: None,
            plate_height_m: 0.03,
            plate_thickness_m: 0.02,
            region: None,
            x_m: None,
            y_m: None,
            rho_m: None,
            azimuth_deg: None,
            min_distance_m: 0.28,
            base_radius_m: 0.25,
            overlap: Overlap::Fail,
            only_washable: false,
            positions_m: None,
        }
    }
}
