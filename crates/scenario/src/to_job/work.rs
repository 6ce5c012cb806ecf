//! Amount of work of a scenario, known before any of it is done.

use crate::error::{Problem, ScenarioError, conflict};
use crate::scenario::Scenario;
use crate::sections::motion::Program;
use platewash_paper::WorkError;
use platewash_planner::redundancy::samples::CHORD_ERROR_M;
use platewash_workcell::layout::PlateGeometry;
use platewash_workcell::words::count_with_noun;

/// Most checks of a contact point of a certified job against a plate: a minute or so of planning.
pub const MAX_CONTACT_CHECKS: usize = 25_000_000;

/// The keys that decide how many waypoints there are.
const WAYPOINT_KEYS: &str = "wash.points, transition.samples";

impl Scenario {
    /// Contact points of a certified job: those of every plate's wash path.
    #[must_use]
    pub fn contact_points(&self) -> usize {
        let of_kind = |(count, geometry): (usize, PlateGeometry)| {
            let curve = self.wash_curve_on(&geometry.surface);
            let a_plate = curve.parameters(&geometry.surface, CHORD_ERROR_M).len();
            a_plate.saturating_mul(count)
        };
        let kinds = self.kinds().into_iter().map(of_kind);
        kinds.fold(0, usize::saturating_add)
    }

    /// Refuses a job whose clearances would take minutes: many plates, each of which is checked at every waypoint or contact
    /// point. Only keys that the job's program uses count.
    ///
    /// # Errors
    /// [`Problem::Conflict`] with how much work it is and the most that is taken on.
    pub fn check_work(&self) -> Result<(), ScenarioError> {
        let checked = match self.job.program {
            Program::Paper => self.check_paper_work(),
            Program::Certified => self.check_contacts(),
        };
        checked.map_err(|problem| ScenarioError::new(&self.name, None, problem))
    }

    fn check_paper_work(&self) -> Result<(), Problem> {
        let plates = "layout.count or positions_m, ";
        self.paper_settings().check_work(self.plates()).or_else(|error| {
            let plates = if matches!(error, WorkError::Waypoints { .. }) {
                ""
            } else {
                plates
            };
            conflict(format!("{plates}{WAYPOINT_KEYS}"), error.to_string())
        })
    }

    fn check_contacts(&self) -> Result<(), Problem> {
        let (plates, points) = (self.plates(), self.contact_points());
        if plates.saturating_mul(points) <= MAX_CONTACT_CHECKS {
            return Ok(());
        }
        let detail = format!(
            "{} and up to {points} contact points are too much work: their product must be at most {MAX_CONTACT_CHECKS}; give fewer \
             plates or contact points",
            count_with_noun(plates, "plate")
        );
        let keys = "layout.count or positions_m, wash.turns, wash.path_radius_m";
        conflict(keys, detail)
    }

    /// Refuses more waypoints of the paper's program than are planned; a certified job has none.
    pub(crate) fn check_waypoints(&self) -> Result<(), Problem> {
        if self.job.program == Program::Certified {
            return Ok(());
        }
        let checked = self.paper_settings().check_waypoints(self.plates());
        checked.or_else(|error| conflict(WAYPOINT_KEYS, error.to_string()))
    }
}
