//! How much work a scenario asks for, known before any of it is done.

use super::load::error;
use super::{Problem, Scenario, ScenarioError};
use crate::spiral::Spiral;

/// Most waypoints of a job: tens of seconds of planning.
pub const MAX_WAYPOINTS: usize = 200_000;

/// Most checks of a waypoint against a plate.
pub const MAX_PLATE_CHECKS: usize = 5_000_000;

impl Scenario {
    /// Plates that are asked for.
    #[must_use]
    pub fn plates(&self) -> usize {
        self.layout.positions_m.as_ref().map_or(self.layout.count, Vec::len)
    }

    /// Upper bound on the waypoints of the job: every plate's spiral, with one transition to each plate.
    #[must_use]
    pub fn waypoints_at_most(&self) -> usize {
        let spiral = Spiral {
            points: self.wash.points,
            turns: self.wash.turns,
            radius_m: self.wash.path_radius_m,
            closing_ring: self.wash.closing_ring,
        };
        let a_plate = spiral.waypoints([0.0; 2]).len().saturating_add(self.transition.samples);
        a_plate.saturating_mul(self.plates())
    }

    /// Refuses a job whose clearances would take minutes: many plates, each of which is checked at every waypoint.
    ///
    /// # Errors
    /// [`Problem::Conflict`] with what the job comes to and the most that is taken on.
    pub fn check_work(&self) -> Result<(), ScenarioError> {
        let (plates, waypoints) = (self.plates(), self.waypoints_at_most());
        if plates.saturating_mul(waypoints) <= MAX_PLATE_CHECKS {
            return Ok(());
        }
        let detail = format!(
            "{plates} plates and up to {waypoints} waypoints are too much work: their product must be at most \
             {MAX_PLATE_CHECKS}; give fewer plates or waypoints"
        );
        let problem = conflict("layout.count or positions_m, wash.points, transition.samples", detail);
        Err(error(&self.name, None, problem))
    }

    /// Refuses more than [`MAX_WAYPOINTS`].
    pub(super) fn check_waypoints(&self) -> Result<(), Problem> {
        match self.waypoints_at_most() {
            ..=MAX_WAYPOINTS => Ok(()),
            found => Err(conflict(
                "wash.points, transition.samples",
                format!(
                    "{} plates would have up to {found} waypoints; at most {MAX_WAYPOINTS} are planned",
                    self.plates()
                ),
            )),
        }
    }
}

fn conflict(keys: &str, detail: String) -> Problem {
    Problem::Conflict {
        keys: keys.to_owned(),
        detail,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(points: usize, plates: usize) -> Scenario {
        let mut scenario = Scenario::load("paper-text").unwrap();
        scenario.wash.points = points;
        scenario.layout.count = plates;
        scenario
    }

    #[test]
    fn the_bound_holds_for_the_shipped_scenario() {
        let scenario = with(55, 4);
        assert_eq!(scenario.waypoints_at_most(), 4 * (55 + 50));
        let job = crate::job::Job::run(&scenario).unwrap();
        assert!(job.tool_path.len() <= scenario.waypoints_at_most());
    }

    #[test]
    fn too_much_work_is_refused_before_it_is_begun() {
        assert!(with(49_950, 4).validate().is_ok());
        let message = with(49_951, 4).validate().unwrap_err().to_string();
        assert!(
            message.contains("200004 waypoints") && message.contains("wash.points"),
            "{message}"
        );
        assert!(with(55, 218).check_work().is_ok());
        let message = with(55, 1000).check_work().unwrap_err().to_string();
        assert!(
            message.contains("1000 plates") && message.contains("5000000"),
            "{message}"
        );
    }
}
