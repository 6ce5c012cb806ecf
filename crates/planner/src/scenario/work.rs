//! How much work a scenario asks for, known before any of it is done.

use super::load::error;
use super::{Problem, Program, Scenario, ScenarioError};
use crate::posture::settings::CHORD_ERROR_M;
use crate::spiral::Spiral;
use platewash_workcell::words::counted;

/// Most waypoints of a job: tens of seconds of planning.
pub const MAX_WAYPOINTS: usize = 200_000;

/// Most checks of a waypoint against a plate.
pub const MAX_PLATE_CHECKS: usize = 5_000_000;

/// Most checks of a contact point of a certified job against a plate: a minute or so of planning.
pub const MAX_STROKE_CHECKS: usize = 25_000_000;

impl Scenario {
    /// Plates that are asked for.
    #[must_use]
    pub fn plates(&self) -> usize {
        self.layout.positions_m.as_ref().map_or(self.layout.count, Vec::len)
    }

    /// Upper bound on the waypoints of the paper's program: every plate's spiral, with one transition to each plate.
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

    /// Contact points of a certified job: those of every plate's stroke.
    #[must_use]
    pub fn contact_points(&self) -> usize {
        let a_plate = self.stroke().parameters(CHORD_ERROR_M).len();
        a_plate.saturating_mul(self.plates())
    }

    /// Refuses a job whose clearances would take minutes: many plates, each of which is checked at every waypoint or contact
    /// point. Only keys that the job's program uses count.
    ///
    /// # Errors
    /// [`Problem::Conflict`] with what the job comes to and the most that is taken on.
    pub fn check_work(&self) -> Result<(), ScenarioError> {
        let plates = self.plates();
        let (points, called, most, keys) = match self.job.program {
            Program::Paper => (
                self.waypoints_at_most(),
                "waypoints",
                MAX_PLATE_CHECKS,
                "layout.count or positions_m, wash.points, transition.samples",
            ),
            Program::Certified => (
                self.contact_points(),
                "contact points",
                MAX_STROKE_CHECKS,
                "layout.count or positions_m, wash.turns, wash.path_radius_m",
            ),
        };
        if plates.saturating_mul(points) <= most {
            return Ok(());
        }
        let detail = format!(
            "{} and up to {points} {called} are too much work: their product must be at most {most}; give fewer plates or \
             {called}",
            counted(plates, "plate")
        );
        let problem = conflict(keys, detail);
        Err(error(&self.name, None, problem))
    }

    /// Refuses more than [`MAX_WAYPOINTS`] of the paper's program; a certified job has none.
    pub(super) fn check_waypoints(&self) -> Result<(), Problem> {
        if self.job.program == Program::Certified {
            return Ok(());
        }
        match self.waypoints_at_most() {
            ..=MAX_WAYPOINTS => Ok(()),
            found => Err(conflict(
                "wash.points, transition.samples",
                format!(
                    "{} would have up to {found} waypoints; at most {MAX_WAYPOINTS} are planned",
                    counted(self.plates(), "plate")
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

    /// Waypoints are the paper program's alone: they refuse no certified job, whose own strokes count.
    #[test]
    fn only_keys_that_the_program_uses_count() {
        let mut scenario = Scenario::load("kitchen").unwrap();
        (scenario.wash.points, scenario.transition.samples) = (100_000, 100_000);
        scenario.layout.count = 200;
        assert!(scenario.validate().is_ok() && scenario.check_work().is_ok());
        scenario.layout.count = 1000;
        let message = scenario.check_work().unwrap_err().to_string();
        assert!(
            message.contains("1000 plates") && message.contains("wash.turns") && !message.contains("wash.points"),
            "{message}"
        );
    }
}
