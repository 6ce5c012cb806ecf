//! How much work a run is, known before any of it is done.

use crate::settings::PaperSettings;
use platewash_workcell::words::count_with_noun;

/// Most waypoints of a run: tens of seconds of planning.
pub const MAX_WAYPOINTS: usize = 200_000;

/// Most checks of a waypoint against a plate.
pub const MAX_PLATE_CHECKS: usize = 5_000_000;

/// A run that would take minutes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WorkError {
    /// Too many waypoints.
    #[error("{} would have up to {waypoints} waypoints; at most {MAX_WAYPOINTS} are planned", count_with_noun(*.plates, "plate"))]
    Waypoints {
        /// Plates.
        plates: usize,
        /// Waypoints at most.
        waypoints: usize,
    },
    /// Too many plates, each of which is checked at every waypoint.
    #[error(
        "{} and up to {waypoints} waypoints are too much work: their product must be at most {MAX_PLATE_CHECKS}; give fewer plates \
         or waypoints", count_with_noun(*.plates, "plate")
    )]
    PlateChecks {
        /// Plates.
        plates: usize,
        /// Waypoints at most.
        waypoints: usize,
    },
}

impl PaperSettings {
    /// Upper bound on the waypoints of a run: every plate's spiral, with one transit to each plate.
    #[must_use]
    pub fn waypoints_at_most(&self, plates: usize) -> usize {
        let a_plate = self.spiral.waypoint_count().saturating_add(self.transit.samples);
        a_plate.saturating_mul(plates)
    }

    /// Refuses more than [`MAX_WAYPOINTS`].
    ///
    /// # Errors
    /// [`WorkError::Waypoints`].
    pub fn check_waypoints(&self, plates: usize) -> Result<(), WorkError> {
        match self.waypoints_at_most(plates) {
            ..=MAX_WAYPOINTS => Ok(()),
            waypoints => Err(WorkError::Waypoints { plates, waypoints }),
        }
    }

    /// Refuses more than [`MAX_WAYPOINTS`], and more than [`MAX_PLATE_CHECKS`] of them against the plates.
    ///
    /// # Errors
    /// [`WorkError`].
    pub fn check_work(&self, plates: usize) -> Result<(), WorkError> {
        self.check_waypoints(plates)?;
        let waypoints = self.waypoints_at_most(plates);
        if plates.saturating_mul(waypoints) <= MAX_PLATE_CHECKS {
            return Ok(());
        }
        Err(WorkError::PlateChecks { plates, waypoints })
    }
}
