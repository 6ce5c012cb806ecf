//! Layouts of which every plate can be washed whole, for scenarios that ask for them.

use super::activity::{Activity, Listener};
use super::stages::Stages;
use super::{CycleError, visit};
use crate::error::PlanError;
use crate::place;
use crate::posture;
use crate::scenario::Scenario;
use platewash_kinematics::RobotModel;
use platewash_workcell::layout::Layout;
use platewash_workcell::random;

/// Layouts drawn before it is given up.
const MOST_LAYOUTS: usize = 200;

/// The plates of a scenario. With `layout.only_washable`, sampled layouts are drawn from the seed's stream until every plate
/// can be washed whole.
///
/// # Errors
/// [`PlanError::Layout`], [`PlanError::Scenario`] for too much work, or [`CycleError::NoneWashable`] when no layout drawn will do.
pub(super) fn place(scenario: &Scenario, robot: &RobotModel, listener: Listener<'_>) -> Result<Layout, PlanError> {
    if !scenario.layout.only_washable || scenario.layout.positions_m.is_some() {
        return Ok(place::place_plates(scenario, robot)?);
    }
    scenario.check_work()?;
    let mut rng = random::stream(scenario.seed, "layout");
    let mut last = None;
    for drawn in 1..=MOST_LAYOUTS {
        let most = MOST_LAYOUTS;
        listener(&Activity::Layout { drawn, most });
        let layout = place::draw_plates(scenario, robot, &mut rng)?;
        let stages = Stages::new(scenario, robot, &layout.plates)?;
        match stages.first_unwashable()? {
            None => return Ok(layout),
            stop => last = stop,
        }
    }
    Err(CycleError::NoneWashable {
        layouts: MOST_LAYOUTS,
        last: last.unwrap_or_default(),
    }
    .into())
}

impl Stages<'_> {
    /// What stands in the way on the first plate that cannot be washed whole.
    fn first_unwashable(&self) -> Result<Option<String>, CycleError> {
        let arm = self.arm()?;
        let home = self.robot.fk(&self.homes[0]).rigid(&arm.cell.tip).translation;
        let stop = self.plates.iter().enumerate().find_map(|(plate, place)| {
            let centre = visit::centre(place, self.scenario);
            let stroke = visit::stroke(self.scenario, &centre, &home);
            let answer = posture::washing(&arm.cell, &stroke, centre, plate, &self.posture, &self.homes[0]);
            answer.err().map(|error| error.to_string())
        });
        Ok(stop)
    }
}
