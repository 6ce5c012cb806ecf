//! Dry run: the motion of another plan in the air, over plates that stand below as obstacles.
//!
//! The plates are raised, together with everything that the tip does on them. The real ones stay in place, as obstacles with the usual
//! clearance.

use crate::obstacle::{Obstacle, ObstacleShape};
use crate::plate::{GREATEST_M, Plate};
use crate::words::{plate_name, quoted};
use serde::{Deserialize, Serialize};

/// Default height of a dry run \[m\].
pub const HEIGHT_M: f64 = 0.05;

/// Default greatest speed of the tip in a dry run \[m/s\].
pub const SPEED_M_S: f64 = 0.1;

/// Number of digits of a hash in messages.
const TOLD: usize = 12;

/// Number of digits of a hash.
const DIGITS: usize = 64;

/// True for lower-case hexadecimal digits, as many as SHA-256 has.
pub(crate) fn is_hash(text: &str) -> bool {
    let digit = |c: u8| matches!(c, b'0'..=b'9' | b'a'..=b'f');
    text.len() == DIGITS && text.bytes().all(digit)
}

/// Statement that a job is the dry run of a plan. Its plates are those of that plan, raised, with nothing there; the real ones stand below
/// them as obstacles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DryRun {
    /// Hash of the plan that is tried out. It is stated; comparing takes that plan.
    pub parent: String,
    /// Height by which the plates are raised \[m\].
    pub height_m: f64,
}

impl DryRun {
    /// Returns the notice that replaces the words about washed plates in reports.
    #[must_use]
    pub fn words(&self) -> String {
        let height_mm = (1e6 * self.height_m).round() / 1e3;
        format!(
            "DRY RUN of {}: {height_mm} mm above the plates, nothing is washed",
            self.parent_short()
        )
    }

    /// Returns the first digits of the parent's hash; in quotes the start of a text that is no hash.
    #[must_use]
    pub fn parent_short(&self) -> String {
        let first: String = self.parent.chars().take(TOLD).collect();
        if self.names_a_hash() { first } else { quoted(&first) }
    }

    /// True if the parent is a valid hash: lower-case hexadecimal digits, as many as SHA-256 has.
    #[must_use]
    pub fn names_a_hash(&self) -> bool {
        is_hash(&self.parent)
    }

    /// True if the height is above 0 and not too large.
    #[must_use]
    pub fn is_above(&self) -> bool {
        self.height_m > 0.0 && self.height_m <= GREATEST_M
    }

    /// Name of the obstacle for a real plate: `real plate 1` for index 0.
    #[must_use]
    pub fn real_name(plate: usize) -> String {
        format!("real {}", plate_name(plate))
    }

    /// Returns the raised plate of a real one.
    #[must_use]
    pub fn raised(&self, real: &Plate) -> Plate {
        let mut plate = *real;
        plate.pose.translation.vector += real.axis() * self.height_m;
        plate
    }

    /// Returns the real plate of a raised one.
    #[must_use]
    pub fn lowered(&self, raised: &Plate) -> Plate {
        let mut plate = *raised;
        plate.pose.translation.vector -= raised.axis() * self.height_m;
        plate
    }

    /// Returns a real plate as an obstacle.
    #[must_use]
    pub fn plate_as_obstacle(index: usize, real: &Plate) -> Obstacle {
        let (shape, pose) = real.enclosure();
        Obstacle::new(&Self::real_name(index), ObstacleShape::Convex(shape), pose)
    }
}
