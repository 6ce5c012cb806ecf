//! Why no configurations were found along a wash path.

use crate::scene::Hindrance;
use nalgebra::Vector3;
use platewash_workcell::cancel::Cancelled;
use std::fmt;

/// A contact point at which no tilt is left.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadEnd {
    /// Parameter of the wash path \[rad\].
    pub theta: f64,
    /// The contact point \[m\], world frame.
    pub position_m: Vector3<f64>,
    /// What stood in the way, one entry a filter: the most frequent first.
    pub reasons: Vec<Reason>,
}

/// A filter and what it rejected at one contact point.
#[derive(Debug, Clone, PartialEq)]
pub struct Reason {
    /// Tilts that it rejected.
    pub tilts: usize,
    /// The least of the hindrances.
    pub least: Hindrance,
}

/// Why no configurations were found along a wash path.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RedundancyError {
    /// A number that makes no sense.
    #[error("{name} must be in [{least}, {most}]; found {found}")]
    Input {
        /// Its name.
        name: &'static str,
        /// Least value.
        least: f64,
        /// Greatest value.
        most: f64,
        /// What was given.
        found: f64,
    },
    /// There is no such plate.
    #[error("there is no plate {plate}; there are {count}")]
    Plate {
        /// Index of the plate.
        plate: usize,
        /// How many there are.
        count: usize,
    },
    /// At some contact points no tilt within the limit was found reachable, within the joint limits and clear.
    #[error("plate {plate}: no tilt was found at {dead} of {tried} points of the wash path; {}", at(.ends))]
    NoTilt {
        /// Index of the plate.
        plate: usize,
        /// Points without a tilt.
        dead: usize,
        /// Points tried.
        tried: usize,
        /// Those points, at most [`MOST_DEAD_ENDS`] of them, evenly chosen.
        ends: Vec<DeadEnd>,
    },
    /// Every contact point has a tilt, but no continuous sequence of them was found within the joint steps and tilt rate allowed.
    #[error("plate {plate}: no way was found to connect the usable tilts along the path; {}", at(std::slice::from_ref(.end)))]
    Disconnected {
        /// Index of the plate.
        plate: usize,
        /// Where the last of the sequences ends.
        end: DeadEnd,
    },
    /// The search was given up.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The sequence of tilts found fails between the points searched.
    #[error("plate {plate}: {}", at(std::slice::from_ref(.end)))]
    Between {
        /// Index of the plate.
        plate: usize,
        /// Where.
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
