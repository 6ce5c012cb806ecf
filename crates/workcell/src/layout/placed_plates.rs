//! Plates in their places, with the findings about them.

use crate::layout::findings::{self, Finding};
use crate::layout::footprint::BaseFootprint;
use crate::layout::plate_geometry::PlateGeometry;
use crate::plate::Plate;
use platewash_kinematics::Pose;
use serde::{Deserialize, Serialize};

/// Source of the positions of a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum LayoutSource {
    /// Drawn at random.
    Sampled {
        /// Number of layouts begun and abandoned before this one.
        restarts: u32,
        /// Number of candidate positions drawn, all restarts included.
        draws: u64,
    },
    /// Given one by one.
    Explicit,
}

/// Plates with the findings about their positions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layout {
    /// Plates, in the order in which they were drawn or given.
    pub plates: Vec<Plate>,
    /// Source of their positions.
    pub source: LayoutSource,
    /// Problems of their positions.
    pub findings: Vec<Finding>,
}

impl Layout {
    /// Returns a layout of given plates without findings.
    #[must_use]
    pub fn from_plates(plates: Vec<Plate>) -> Self {
        Self {
            plates,
            source: LayoutSource::Explicit,
            findings: Vec::new(),
        }
    }

    /// Returns a layout of plates given in the world, with their overlaps as findings. `[x, y]` is the foot of the arm's mount \[m\].
    #[must_use]
    pub fn with_overlaps(plates: Vec<Plate>, [x, y]: [f64; 2], base: Option<&BaseFootprint>) -> Self {
        let to_foot = Pose::translation(-x, -y, 0.0);
        let about_foot: Vec<_> = plates.iter().map(|plate| plate.seen_from(&to_foot)).collect();
        Self {
            findings: findings::overlaps(&about_foot, base),
            ..Self::from_plates(plates)
        }
    }

    /// Returns the same positions with plates of several kinds: a number of each, in their order.
    #[must_use]
    pub fn of_kinds(self, kinds: &[(usize, PlateGeometry)], base: Option<&BaseFootprint>) -> Self {
        let each = kinds.iter().flat_map(|(count, kind)| std::iter::repeat_n(kind, *count));
        let centres = self.plates.iter().map(Plate::centre_xy);
        let plates: Vec<_> = centres
            .zip(each)
            .flat_map(|(centre, kind)| kind.plates(&[centre]))
            .collect();
        Self {
            findings: findings::overlaps(&plates, base),
            plates,
            ..self
        }
    }

    /// Returns the layout moved by `[x, y]` \[m\], for another origin.
    #[must_use]
    pub fn moved_by(mut self, [x, y]: [f64; 2]) -> Self {
        let by = Pose::translation(x, y, 0.0);
        for plate in &mut self.plates {
            *plate = plate.seen_from(&by);
        }
        for finding in &mut self.findings {
            finding.move_by([x, y]);
        }
        self
    }
}
