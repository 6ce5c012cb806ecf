//! Errors of a search for configurations along a wash path.

use crate::out_of_range::OutOfRange;
use crate::placed_arm::Hindrance;
use nalgebra::Vector3;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::words::plate_name;
use std::fmt;

/// A contact point at which no tilt is left.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadEnd {
    /// Parameter of the wash path \[rad\].
    pub theta: f64,
    /// The contact point \[m\], world frame.
    pub position_m: Vector3<f64>,
    /// Hindrances there, one entry per filter: the most frequent first.
    pub reasons: Vec<Reason>,
}

/// A filter, and the hindrance that it found at one contact point.
#[derive(Debug, Clone, PartialEq)]
pub struct Reason {
    /// Tilts that it rejected.
    pub tilts: usize,
    /// The least of the hindrances.
    pub least: Hindrance,
}

/// Reason that no configurations were found along a wash path.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RedundancyError {
    /// A number that makes no sense.
    #[error(transparent)]
    Input(#[from] OutOfRange),
    /// There is no such plate.
    #[error("there is no {}; there are {count}", plate_name(*.plate))]
    Plate {
        /// Index of the plate.
        plate: usize,
        /// Number of plates.
        count: usize,
    },
    /// At some contact points no tilt within the limit was found reachable, within the joint limits and clear.
    #[error("{}: no tilt was found at {dead} of {tried} points of the wash path; {}", plate_name(*.plate), at(.ends))]
    NoTilt {
        /// Index of the plate.
        plate: usize,
        /// Points without a tilt.
        dead: usize,
        /// Points tried.
        tried: usize,
        /// Contact points without a tilt, at most [`MOST_DEAD_ENDS`] of them, evenly chosen.
        ends: Vec<DeadEnd>,
    },
    /// Every contact point has a tilt, but no continuous sequence of them was found within the joint steps and tilt rate allowed.
    #[error("{}: no way was found to connect the usable tilts along the path; {}", plate_name(*.plate), at(std::slice::from_ref(.end)))]
    Disconnected {
        /// Index of the plate.
        plate: usize,
        /// End of the last of the sequences.
        end: DeadEnd,
    },
    /// The search was given up.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The sequence of tilts found fails between the points searched.
    #[error("{}: {}", plate_name(*.plate), at(std::slice::from_ref(.end)))]
    Between {
        /// Index of the plate.
        plate: usize,
        /// Contact point at which the motion breaks.
        end: DeadEnd,
    },
}

/// The most dead ends that an error lists.
pub const MOST_DEAD_ENDS: usize = 24;

impl fmt::Display for DeadEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z]: [f64; 3] = self.position_m.into();
        write!(f, "at θ = {:.3} rad, ({x:.3}, {y:.3}, {z:.3}) m:", self.theta)?;
        for (k, reason) in self.reasons.iter().enumerate() {
            let separator = if k == 0 { "" } else { ";" };
            write!(f, "{separator} {} ({} of the tilts)", reason.least, reason.tilts)?;
        }
        Ok(())
    }
}

/// The first of some dead ends, in words.
fn at(ends: &[DeadEnd]) -> String {
    ends.first().map_or_else(String::new, ToString::to_string)
}
