//! Suggestions for the arm and the tool of a scenario: a home, a region in which plates like its own are washed, and pairs of
//! links that need no check.

use crate::error::{Problem, ScenarioError};
use crate::failure::Failure;
use crate::scenario::Scenario;
use crate::sections::motion::Program;
use crate::sections::obstacle::HeldPlates;
use crate::sections::robot::ReducedClearanceSection;
use platewash_bodies::clearance::TouchingPairs;
use platewash_bodies::job::{JobError, WashJob};
use platewash_kinematics::RobotModel;
use platewash_planner::suggest::{
    NearPair, SuggestedHome, SuggestedRegion, near_pairs, place_in_front, suggest_home, suggest_region, suggest_sector,
};
use platewash_planner::{PlanError, Watch};
use platewash_workcell::cancel::system_clock;
use platewash_workcell::job::TermsError;
use platewash_workcell::plate::Plate;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

/// A pair of links is too near often where it is so in at least one of as many configurations.
const OFTEN: usize = 10;

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
            let detail = format!(
                "what is suggested is for a certified job, whose sponge touches the plates: it needs wash.height_m = 0; the paper's \
                 program of this scenario hovers at {height_m} m"
            );
            return Err(ScenarioError::new(&self.name, None, Problem::conflict("wash.height_m", detail)).into());
        }
        let plate_m = match self.plate.first().and_then(|plate| plate.at_m) {
            Some([x, y, _]) => [x, y],
            None => self.front_m(arm)?,
        };
        let job = self.with_one_plate(arm, plate_m)?;
        let [plate, ..] = job.terms().plates[..] else {
            return Err(JobError::from(TermsError::PlateCount { found: 0 }).into());
        };
        let home = suggest_home(arm, job.terms(), watch.cancel)?;
        let cancel = &watch.cancel.within(map_time, system_clock);
        Ok(Suggestion {
            home,
            plate,
            region: suggest_region(&job, &Watch { cancel, ..*watch })?,
            pairs: TouchingPairs::find(arm)?,
        })
    }

    /// The same scenario for another arm: a home, and a region in which plates like its own can be washed, are looked for and stated.
    /// Where fewer plates than it asks for have room there, it has fewer. `None` where no such region was found.
    ///
    /// # Errors
    /// [`Failure`]: no home, or a scenario that is refused.
    pub fn fitted_to(&self, arm: &Arc<RobotModel>, watch: &Watch<'_>) -> Result<Option<Self>, Failure> {
        let first = self.in_region(arm, watch);
        let near = match &first {
            Err(Failure::Plan(PlanError::NoHome { in_the_way, .. })) => in_the_way.clone(),
            Ok(None) => {
                let job = self.with_one_plate(arm, self.front_m(arm)?)?;
                near_pairs(arm, job.terms(), watch.cancel)?
            }
            _ => return first,
        };
        if let Some(split) = self.with_split_links(arm, &near) {
            // With a mesh that cannot be split, the arm stays as it is.
            let fitted = split.arm().and_then(|arm| split.in_region(&arm, watch));
            if let Ok(Some(fitted)) = fitted {
                return Ok(Some(fitted));
            }
        }
        match self.with_reduced_clearances(&near) {
            Some(reduced) => reduced.in_region(arm, watch),
            None => first,
        }
    }

    /// A place in front of the arm \[m\].
    fn front_m(&self, arm: &RobotModel) -> Result<[f64; 2], Failure> {
        Ok(place_in_front(arm, &self.tool_on(arm)?, &self.robot.mount(arm)))
    }

    /// The same scenario with a home and a region that suit an arm; `None` where no such region was found.
    fn in_region(&self, arm: &Arc<RobotModel>, watch: &Watch<'_>) -> Result<Option<Self>, Failure> {
        let front_m = self.front_m(arm)?;
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
        let ([x, y], [front_x, front_y]) = (self.foot_m(arm), front_m);
        let (ahead_x, ahead_y) = (front_x - x, front_y - y);
        let part = 0.5 * (sector.rho_m[0] + sector.rho_m[1]) / (ahead_x * ahead_x + ahead_y * ahead_y).sqrt();
        let job = fitted.with_one_plate(arm, [x + part * ahead_x, y + part * ahead_y])?;
        let [home, _] = job.terms().home_rad;
        let start_deg = home.map(|rad| rad.to_degrees().round() + 0.0).into();
        (fitted.robot.start_deg, fitted.robot.home_deg) = (Some(start_deg), None);
        while fitted.layout.count > 1 && fitted.layout(arm).is_err() {
            fitted.layout.count -= 1;
        }
        Ok(Some(fitted))
    }

    /// The same scenario with the links split whose convex hulls are too near in many configurations; `None` where there are none.
    fn with_split_links(&self, arm: &RobotModel, near: &[NearPair]) -> Option<Self> {
        let has_hull = |name: &str| arm.links_with_hulls().any(|link| link == name);
        let often = near.iter().filter(|near| OFTEN * near.count >= near.tried);
        let pairs = often.filter(|near| near.pair.iter().all(|name| has_hull(name)));
        let links: BTreeSet<_> = pairs.flat_map(|near| near.pair.clone()).collect();
        let mut split = self.clone();
        split.robot.split_links.extend(links);
        (split.robot.split_links != self.robot.split_links).then_some(split)
    }

    /// The same scenario with clearances of their own for pairs that are too near in every configuration: half of their greatest distance, so
    /// that the arm keeps room to move. `None` where there are none.
    fn with_reduced_clearances(&self, near: &[NearPair]) -> Option<Self> {
        let reduced = near.iter().filter(|near| near.is_by_design()).filter_map(|near| {
            let [a, b] = near.pair.clone();
            // In tenths of a millimetre, rounded down.
            let half_m = (0.5e4 * near.most_m).floor() / 1e4;
            let clearance_m = half_m.min(0.5 * self.wash.clearance_m);
            (clearance_m > 0.0).then_some(ReducedClearanceSection { a, b, clearance_m })
        });
        let mut scenario = self.clone();
        scenario.reduced_clearance.extend(reduced);
        (scenario.reduced_clearance != self.reduced_clearance).then_some(scenario)
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

    /// The handle is never farther than 24 mm from the forearm.
    #[test]
    fn a_pair_that_is_always_near_gets_half_of_its_greatest_distance() {
        let mut scenario = Scenario::load("kitchen").unwrap();
        scenario.wash.clearance_m = 0.025;
        scenario.robot.start_deg = None;
        let refused = scenario.job().unwrap_err();
        let said = refused.to_string();
        let advice = "apart in all of them: state a clearance of their own ([[reduced_clearance]])";
        assert!(said.contains(advice), "{said}");
        let Failure::Plan(PlanError::NoHome { in_the_way, .. }) = refused else {
            panic!("{said}")
        };
        let scenario = scenario.with_reduced_clearances(&in_the_way).unwrap();
        assert_eq!(scenario.with_split_links(&scenario.arm().unwrap(), &in_the_way), None);
        let job = scenario.job().unwrap();
        let [ReducedClearanceSection { a, b, clearance_m }] = &scenario.reduced_clearance[..] else {
            panic!("{:?}", scenario.reduced_clearance)
        };
        assert_eq!((&**a, &**b, *clearance_m), ("link_4", "handle", 0.0118));
        let own = &job.terms().workcell.reduced_clearances;
        assert!(own.len() == 1 && (own[0].by_m - 0.0132).abs() < 1e-12, "{own:?}");
        scenario.validate().unwrap();
        let refused = |clearance_m: f64| {
            let mut wrong = scenario.clone();
            wrong.reduced_clearance[0].clearance_m = clearance_m;
            wrong
                .validate()
                .map_err(Failure::from)
                .and_then(|()| wrong.job().map(|_| ()))
                .unwrap_err()
                .to_string()
        };
        let words =
            "reduced_clearance[0].clearance_m, wash.clearance_m: 0.025 m is not less than what all pairs keep, 0.025 m";
        assert!(refused(0.025).contains(words), "{}", refused(0.025));
        for found in [0.0, -1.0, f64::NAN] {
            let words = "reduced_clearance[0].clearance_m must be a number above 0";
            assert!(refused(found).contains(words), "{}", refused(found));
        }
    }

    #[test]
    fn links_are_split_whose_hulls_are_often_too_near() {
        let tetrahedron = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.obj"), tetrahedron).unwrap();
        let mut text = platewash_kinematics::irb120::IRB120_URDF.to_owned();
        for link in ["link_3", "link_5"] {
            let named = format!("<link name=\"{link}\">");
            let mesh = "<collision><geometry><mesh filename=\"a.obj\"/></geometry></collision>";
            text = text.replacen(&named, &format!("{named}{mesh}"), 1);
        }
        let source = platewash_kinematics::urdf::MeshSource::new(&[], Some(folder.path()));
        let arm = RobotModel::from_urdf(&text, &source).unwrap();
        let scenario = Scenario::load("kitchen").unwrap();
        let split = |pair: [&str; 2], count: usize| {
            let near = NearPair {
                pair: pair.map(str::to_owned),
                count,
                tried: 4000,
                is_of_arm: true,
                most_m: 0.1,
            };
            scenario
                .with_split_links(&arm, &[near])
                .map(|split| split.robot.split_links)
        };
        let both = Some(vec!["link_3".to_owned(), "link_5".to_owned()]);
        assert_eq!(split(["link_5", "link_3"], 400), both);
        for (pair, count) in [
            (["link_3", "link_5"], 399),
            (["link_3", "link_4"], 4000),
            (["link_3", "handle"], 4000),
        ] {
            assert_eq!(split(pair, count), None, "{pair:?}");
        }
    }
}
