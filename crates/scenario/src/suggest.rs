//! Suggestions for the arm and the tool of a scenario: a home, a region in which plates like its own are washed, and pairs of
//! links that need no check.

use crate::error::{Problem, ScenarioError};
use crate::failure::Failure;
use crate::scenario::Scenario;
use crate::sections::motion::Program;
use crate::sections::obstacle::HeldPlates;
use platewash_kinematics::RobotModel;
use platewash_planner::Watch;
use platewash_planner::suggest::{
    SuggestedHome, SuggestedRegion, place_in_front, suggest_home, suggest_region, suggest_sector,
};
use platewash_workcell::cancel::system_clock;
use platewash_workcell::clearance::TouchingPairs;
use platewash_workcell::job::{JobError, WashJob};
use platewash_workcell::plate::Plate;
use std::sync::Arc;
use std::time::Duration;

/// Home, plate and region that suit an arm with its tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Suggestion {
    /// A home for a plate in front of the arm.
    pub home: SuggestedHome,
    /// The plate in front of the arm, world frame.
    pub plate: Plate,
    /// Region in which plates like it can be washed from that home, each alone.
    pub region: SuggestedRegion,
    /// Pairs of links that need no check.
    pub pairs: TouchingPairs,
}

impl Scenario {
    /// Suggests a home, a plate and a region that suit the arm with the scenario's tool, its kind of plates and its requirements;
    /// its own home and places have no effect. The map of the region ends after `map_time`.
    ///
    /// # Errors
    /// [`Failure`]: no home, or a scenario that is refused.
    pub fn suggest(&self, arm: &Arc<RobotModel>, map_time: Duration, watch: &Watch<'_>) -> Result<Suggestion, Failure> {
        if self.job.program == Program::Paper && self.wash.height_m != 0.0 {
            let height_m = self.wash.height_m;
            let (keys, detail) = (
                "wash.height_m".to_owned(),
                format!(
                    "what is suggested is for a certified job, whose sponge touches the plates: it needs wash.height_m = 0; the paper's \
                     program of this scenario hovers at {height_m} m"
                ),
            );
            return Err(ScenarioError::new(&self.name, None, Problem::Conflict { keys, detail }).into());
        }
        let plate_m = match self.plate.first().and_then(|plate| plate.at_m) {
            Some([x, y, _]) => [x, y],
            None => place_in_front(arm, &self.tool_on(arm)?, &self.robot.mount()),
        };
        let job = self.with_one_plate(arm, plate_m)?;
        let [plate, ..] = job.terms().plates[..] else {
            return Err(JobError::PlateCount { found: 0 }.into());
        };
        let home = suggest_home(arm, job.terms(), watch.cancel)?;
        let cancel = &watch.cancel.within(map_time, system_clock);
        Ok(Suggestion {
            home,
            plate,
            region: suggest_region(&job, &Watch { cancel, ..*watch })?,
            pairs: TouchingPairs::of(arm)?,
        })
    }

    /// The same scenario for another arm: a home, and a region in which plates like its own can be washed, are looked for and stated.
    /// Where fewer plates than it asks for have room there, it has fewer. `None` where no such region was found.
    ///
    /// # Errors
    /// [`Failure`]: no home, or a scenario that is refused.
    pub fn fitted_to(&self, arm: &Arc<RobotModel>, watch: &Watch<'_>) -> Result<Option<Self>, Failure> {
        let front_m = place_in_front(arm, &self.tool_on(arm)?, &self.robot.mount());
        let job = self.with_one_plate(arm, front_m)?;
        let Some(sector) = suggest_sector(&job, watch)? else {
            return Ok(None);
        };
        let sector = sector.in_whole_units();
        let mut fitted = self.clone();
        let layout = &mut fitted.layout;
        (layout.region, layout.x_m, layout.y_m) = (None, None, None);
        (layout.rho_m, layout.azimuth_deg) = (Some(sector.rho_m), Some(sector.azimuth_deg));
        layout.base_radius_m = layout.base_radius_m.min(sector.rho_m[0]);
        layout.only_washable = true;
        // The home is that for a plate ahead, in the middle of the row.
        let ([x, y], [front_x, front_y]) = (self.foot_m(), front_m);
        let (ahead_x, ahead_y) = (front_x - x, front_y - y);
        let part = 0.5 * (sector.rho_m[0] + sector.rho_m[1]) / ahead_x.hypot(ahead_y);
        let job = self.with_one_plate(arm, [x + part * ahead_x, y + part * ahead_y])?;
        let [home, _] = job.terms().home_rad;
        let start_deg = home.map(|rad| rad.to_degrees().round() + 0.0).into();
        (fitted.robot.start_deg, fitted.robot.home_deg) = (Some(start_deg), None);
        while fitted.layout.count > 1 && fitted.layout(arm).is_err() {
            fitted.layout.count -= 1;
        }
        Ok(Some(fitted))
    }

    /// The job of this scenario on its first plate alone, at a place, from the home that is found there.
    fn with_one_plate(&self, arm: &Arc<RobotModel>, plate_m: [f64; 2]) -> Result<WashJob, Failure> {
        let mut alone = self.clone();
        alone.job.program = Program::Certified;
        (alone.robot.start_deg, alone.robot.home_deg) = (None, None);
        let layout = &mut alone.layout;
        // A plate that stands at an angle stays at its stated place.
        alone.plate.truncate(1);
        for obstacle in &mut alone.obstacle {
            let holds = obstacle.held(1).contains(&0);
            obstacle.holds_plates = holds.then(|| HeldPlates::These(vec![0]));
        }
        layout.positions_m = None;
        match alone.plate.first_mut() {
            Some(kind) if kind.at_m.is_none() => {
                let [x, y] = plate_m;
                (kind.at_m, kind.count) = (Some([x, y, layout.plate_height_m]), None);
            }
            Some(_) => {}
            None => layout.positions_m = Some(vec![plate_m]),
        }
        (layout.region, layout.only_washable) = (None, false);
        (layout.x_m, layout.y_m, layout.rho_m, layout.azimuth_deg) = (None, None, None, None);
        let placed = alone.layout(arm)?;
        alone.job_on(arm, &placed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Note;
    use platewash_workcell::cancel::CancelToken;

    #[test]
    fn a_job_without_a_home_uses_and_reports_the_suggested_one() {
        let mut scenario = Scenario::load("kitchen").unwrap();
        scenario.robot.start_deg = None;
        assert_eq!(scenario.validate(), Ok(()));
        assert!(
            matches!(scenario.notes()[..], [Note::HomeLeftOpen]),
            "{:?}",
            scenario.notes()
        );
        let job = scenario.job().unwrap();
        let found = suggest_home(job.arm(), job.terms(), &CancelToken::new()).unwrap();
        assert_eq!(job.terms().home_rad, [found.q_rad(); 2]);
        scenario.robot.home_deg = Some([0.0, 0.0, 0.0, 0.0, 90.0, 0.0]);
        let [start, end] = scenario.job().unwrap().terms().home_rad;
        assert_eq!((start, end[4]), (found.q_rad(), 90_f64.to_radians()));
    }

    #[test]
    fn the_papers_program_starts_at_0_where_nothing_is_stated() {
        let mut scenario = Scenario::load("paper-text").unwrap();
        scenario.robot.start_deg = None;
        assert_eq!(scenario.notes(), []);
        assert_eq!(scenario.paper_job().unwrap().start_rad.amax(), 0.0);
    }

    #[test]
    fn suggested_homes_are_accepted() {
        let (scenario, cancel) = (Scenario::load("angled-tool").unwrap(), CancelToken::new());
        let arm = scenario.arm().unwrap();
        let suggestion = scenario
            .suggest(&arm, Duration::from_secs(600), &Watch::silent(&cancel))
            .unwrap();
        let sector = suggestion.region.sector.unwrap();
        let mut like = scenario.clone();
        like.robot.start_deg = Some(suggestion.home.q_deg);
        like.layout.region = None;
        (like.layout.rho_m, like.layout.azimuth_deg) = (Some(sector.rho_m), Some(sector.azimuth_deg));
        like.layout.count = 2;
        platewash_planner::plan(&like.job().unwrap()).unwrap();
    }
}
