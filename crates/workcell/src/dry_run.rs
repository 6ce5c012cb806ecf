//! What makes a job a dry run: the motion of another plan in the air, over plates that stand below as obstacles.

use crate::plate::{GREATEST_M, Plate};
use crate::workcell::{Obstacle, ObstacleShape};
use serde::{Deserialize, Serialize};

/// Height of a dry run that is asked for without one \[m\].
pub const HEIGHT_M: f64 = 0.05;

/// The tip's largest speed in a dry run that is asked for without one \[m/s\].
pub const SPEED_M_S: f64 = 0.1;

/// Digits of a hash that are told.
const TOLD: usize = 12;

/// Digits of a hash.
const DIGITS: usize = 64;

/// That a job is the dry run of a plan. Its plates are those of that plan, raised, and nothing is there; the real ones stand below them as
/// obstacles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DryRun {
    /// Hash of the plan that is tried out: stated; whoever has that plan can compare.
    pub parent: String,
    /// How far its plates are raised \[m\].
    pub height_m: f64,
}

impl DryRun {
    /// What a person must read wherever a washing would be said to be washed.
    #[must_use]
    pub fn words(&self) -> String {
        let height_mm = (1e6 * self.height_m).round() / 1e3;
        format!(
            "DRY RUN of {}: {height_mm} mm above the plates, nothing is washed",
            self.parent_short()
        )
    }

    /// The first digits of the parent's hash; the beginning of what is no hash, in quotes.
    #[must_use]
    pub fn parent_short(&self) -> String {
        let first: String = self.parent.chars().take(TOLD).collect();
        if self.names_a_hash() {
            first
        } else {
            crate::words::quoted(&first)
        }
    }

    /// Whether the parent is named by what can be a hash: lower-case hexadecimal digits, as many as SHA-256 has.
    #[must_use]
    pub fn names_a_hash(&self) -> bool {
        let digit = |c: u8| matches!(c, b'0'..=b'9' | b'a'..=b'f');
        self.parent.len() == DIGITS && self.parent.bytes().all(digit)
    }

    /// Whether the plates are raised at all, and not out of this world.
    #[must_use]
    pub fn is_above(&self) -> bool {
        self.height_m > 0.0 && self.height_m <= GREATEST_M
    }

    /// Name of the obstacle that a real plate is.
    #[must_use]
    pub fn real_name(plate: usize) -> String {
        format!("real plate {plate}")
    }

    /// The raised plate of a real one.
    #[must_use]
    pub fn raised(&self, real: &Plate) -> Plate {
        let mut plate = *real;
        plate.pose.translation.vector += real.axis() * self.height_m;
        plate
    }

    /// The real plate of a raised one.
    #[must_use]
    pub fn lowered(&self, raised: &Plate) -> Plate {
        let mut plate = *raised;
        plate.pose.translation.vector -= raised.axis() * self.height_m;
        plate
    }

    /// A real plate as an obstacle.
    #[must_use]
    pub fn standing(index: usize, real: &Plate) -> Obstacle {
        let (shape, pose) = real.enclosure();
        Obstacle::new(&Self::real_name(index), ObstacleShape::Convex(shape), pose)
    }
}
