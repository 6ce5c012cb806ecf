//! The `[layout]` section: the plates and the rule by which they are placed.

use platewash_workcell::job::Overlap;
use platewash_workcell::layout::Region;
use serde::{Deserialize, Serialize};

/// `[layout]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LayoutSection {
    /// Plates to sample.
    pub count: usize,
    /// Radius of a plate \[m\].
    pub plate_radius_m: f64,
    /// z of the washing surface \[m\].
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

impl Default for LayoutSection {
    fn default() -> Self {
        Self {
            count: 4,
            plate_radius_m: 0.145,
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
