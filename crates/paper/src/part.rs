//! The two parts of the paper that state a cell: its text and its appendix. They differ in the region of the plates.

use crate::settings::PaperSettings;
use platewash_kinematics::RobotModel;
use platewash_workcell::layout::{
    Layout, LayoutError, PlateGeometry, Region, SampleRequest, Spacing, base_footprint, sample,
};
use platewash_workcell::plate::PlateTerms;
use platewash_workcell::random;
use platewash_workcell::surface::Surface;
use serde::{Deserialize, Serialize};

/// A part of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PaperPart {
    /// The text of the paper.
    Text,
    /// The program in its appendix.
    Appendix,
}

impl PaperPart {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Text, Self::Appendix];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Appendix => "appendix",
        }
    }

    /// Region for the centres of plates.
    #[must_use]
    pub fn region(self) -> Region {
        match self {
            Self::Text => Region::PAPER_TEXT,
            Self::Appendix => Region::PAPER_APPENDIX,
        }
    }

    /// Least distances of plates from each other and from the base axis. The distance is below two radii: plates may overlap.
    #[must_use]
    pub fn spacing(self) -> Spacing {
        Spacing {
            min_distance_m: 0.28,
            base_radius_m: 0.25,
        }
    }

    /// Its plates: of the spiral's outer radius, as the paper gives no other; the thickness is an assumption.
    #[must_use]
    pub fn geometry(self) -> PlateGeometry {
        PlateGeometry {
            surface: Surface::Disc { radius_m: 0.145 },
            height_m: 0.03,
            thickness_m: 0.02,
            foot: None,
            terms: PlateTerms::default(),
        }
    }

    /// Number of plates.
    #[must_use]
    pub fn plate_count(self) -> usize {
        4
    }

    /// The settings of its program.
    #[must_use]
    pub fn settings(self) -> PaperSettings {
        match self {
            Self::Text => PaperSettings::text(),
            Self::Appendix => PaperSettings::appendix(),
        }
    }

    /// Draws its plates for a seed, about an arm.
    ///
    /// # Errors
    /// [`LayoutError::NoRoom`] where every layout begun came to a dead end.
    pub fn draw(self, arm: &RobotModel, seed: u64) -> Result<Layout, LayoutError> {
        let request = SampleRequest {
            region: self.region(),
            spacing: self.spacing(),
            count: self.plate_count(),
            geometry: self.geometry(),
            base: Some(base_footprint(arm)),
        };
        sample(&request, &mut random::stream(seed, "layout"))
    }
}
