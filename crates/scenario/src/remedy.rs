//! Keys that would mend a job that cannot be done: one alone, changed least.
//!
//! The cause points to keys; each is tried by itself, up and down as the cause has it, by planning the changed job whole. A change is
//! so many steps of the key's own grid: 1, 2, 4, 8, 16, until the job is planned, then halved down to the least with which it is: at
//! most [`MOST_TRIALS`] jobs a key and direction, in as many threads as there are, with the same answer for any number of them.

use crate::failure::home_key;
use crate::scenario::Scenario;
use platewash_kinematics::RobotModel;
use platewash_planner::scene::Hindrance;
use platewash_planner::transit::TransitError;
use platewash_planner::{PlanError, Watch, plan_here};
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::job::End;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt;
use std::sync::Arc;

/// The greatest change, in steps of a key's grid: a power of 2.
const MOST_STEPS: i32 = 16;

/// Jobs that are planned at most for a key in one direction: 1, 2, 4, 8, 16 steps, and three halvings.
pub const MOST_TRIALS: u32 = 8;

/// Digits of a step's value that count: grids are coarser.
const ROUNDED: f64 = 1e9;

/// A key that alone, changed, gives a job that is planned.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remedy {
    /// Its dotted path.
    pub key: &'static str,
    /// The value to give it, in the key's unit; `None`: to be left out.
    pub value: Option<f64>,
    /// The value that it has.
    pub found: Option<f64>,
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.value, self.found) {
            (Some(value), Some(found)) => write!(f, "{} = {value:?} instead of {found:?}", self.key),
            (Some(value), None) => write!(f, "{} = {value:?}", self.key),
            (None, _) => write!(f, "{} left out, for a home that is found", self.key),
        }
    }
}

/// What was tried for a job that cannot be done.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Remedies {
    /// The keys that would do, each alone, in the order in which the cause points to them.
    pub would_do: Vec<Remedy>,
    /// The keys that would not, as far as they were changed.
    pub would_not: Vec<&'static str>,
}

impl fmt::Display for Remedies {
    /// Nothing where nothing was tried.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const FEW: usize = 3;
        if self.would_do.is_empty() {
            return match self.would_not[..] {
                [] => Ok(()),
                _ => write!(
                    f,
                    "; changed alone, none of these keys was found to mend it: {}",
                    self.would_not.join(", ")
                ),
            };
        }
        let few: Vec<_> = self.would_do.iter().take(FEW).map(ToString::to_string).collect();
        write!(f, "; the job is planned with {}", few.join(", or with "))
    }
}

/// A key that is tried.
#[derive(Debug, Clone, Copy)]
enum Tried {
    /// A number, by steps of its grid.
    Number(&'static Grid),
    /// A home that is stated, left out.
    Home(End),
}

/// A key that is a number, and the grid on which it is changed.
#[derive(Debug)]
struct Grid {
    key: &'static str,
    /// A step up (above 0) or down, in the key's unit.
    steps: &'static [f64],
    /// Its value, where it decides anything.
    get: fn(&Scenario) -> Option<f64>,
    set: fn(&mut Scenario, f64),
}

macro_rules! grid {
    ($name:ident, $key:literal, $steps:expr, $($field:ident).+) => {
        static $name: Grid = Grid {
            key: $key,
            steps: &$steps,
            get: |scenario| Some(scenario.$($field).+),
            set: |scenario, value| scenario.$($field).+ = value,
        };
    };
    (stated $name:ident, $key:literal, $steps:expr, $($field:ident).+) => {
        static $name: Grid = Grid {
            key: $key,
            steps: &$steps,
            get: |scenario| scenario.$($field).+,
            set: |scenario, value| scenario.$($field).+ = Some(value),
        };
    };
}

grid!(SPONGE_HEIGHT, "tool.sponge_height_m", [0.001], tool.sponge_height_m);
grid!(HANDLE, "tool.radius_m", [-0.001], tool.radius_m);
grid!(LENGTH, "tool.length_m", [0.01, -0.01], tool.length_m);
grid!(LIFT, "wash.lift_m", [0.005, -0.005], wash.lift_m);
grid!(TILT_MAX, "wash.tilt_max_deg", [1.0], wash.tilt_max_deg);
grid!(stated TILT, "wash.tilt_deg", [1.0], wash.tilt_deg);
grid!(CLEARANCE, "wash.clearance_m", [-0.001], wash.clearance_m);
grid!(stated WRIST, "wash.wrist_min_deg", [-0.5], wash.wrist_min_deg);
static PLATE_HEIGHT: Grid = Grid {
    key: "layout.plate_height_m",
    steps: &[0.01, -0.01],
    // Plates that are placed one by one have heights of their own.
    get: |scenario| scenario.plate.is_empty().then_some(scenario.layout.plate_height_m),
    set: |scenario, value| scenario.layout.plate_height_m = value,
};

impl Tried {
    fn key(&self) -> &'static str {
        match self {
            Self::Number(grid) => grid.key,
            Self::Home(end) => home_key(*end),
        }
    }
}

impl Scenario {
    /// Keys that would mend a job that ended with `error`: of those that the cause points to, each alone.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn remedies(&self, arm: &Arc<RobotModel>, error: &PlanError, watch: &Watch<'_>) -> Result<Remedies, Cancelled> {
        let silent = Watch::silent(watch.cancel);
        let tried: Vec<Tried> = pointed_to(error)
            .into_iter()
            .filter(|tried| self.decides(*tried))
            .collect();
        let found: Vec<_> = tried
            .par_iter()
            .map(|tried| self.remedy(arm, *tried, &silent))
            .collect();
        watch.cancel.check()?;
        let mut remedies = Remedies::default();
        for (tried, found) in tried.iter().zip(found) {
            match found {
                Some(remedy) => remedies.would_do.push(remedy),
                None => remedies.would_not.push(tried.key()),
            }
        }
        Ok(remedies)
    }

    /// Whether a key is one that decides anything as the scenario is.
    fn decides(&self, tried: Tried) -> bool {
        match tried {
            Tried::Number(grid) => (grid.get)(self).is_some(),
            Tried::Home(End::Start) => self.robot.start_deg.is_some(),
            Tried::Home(End::End) => self.robot.home_deg.is_some(),
        }
    }

    /// The least change of a key with which the job is planned.
    fn remedy(&self, arm: &Arc<RobotModel>, tried: Tried, watch: &Watch<'_>) -> Option<Remedy> {
        let key = tried.key();
        let grid = match tried {
            Tried::Number(grid) => grid,
            Tried::Home(end) => {
                let mut changed = self.clone();
                match end {
                    End::Start => changed.robot.start_deg = None,
                    End::End => changed.robot.home_deg = None,
                }
                let (value, found) = (None, None);
                return changed.is_planned(arm, watch).then_some(Remedy { key, value, found });
            }
        };
        let found = (grid.get)(self)?;
        let after = |step: f64, steps: i32| (ROUNDED * (found + step * f64::from(steps))).round() / ROUNDED;
        let least = |step: f64| {
            least_steps(|steps| {
                let mut changed = self.clone();
                (grid.set)(&mut changed, after(step, steps));
                changed.is_planned(arm, watch)
            })
        };
        let ways = grid.steps.iter().filter_map(|&step| Some((least(step)?, step)));
        let (steps, step) = ways.min_by_key(|(steps, _)| *steps)?;
        let value = Some(after(step, steps));
        Some(Remedy {
            key,
            value,
            found: Some(found),
        })
    }

    /// Whether a plan of its job is found.
    fn is_planned(&self, arm: &Arc<RobotModel>, watch: &Watch<'_>) -> bool {
        let placed = self.place(arm, watch);
        let job = placed.and_then(|layout| self.job_on(arm, &layout));
        job.is_ok_and(|job| plan_here(&job, watch).is_ok())
    }
}

/// The least number of steps up to [`MOST_STEPS`] that will do, as far as [`MOST_TRIALS`] trials find it.
fn least_steps(will_do: impl Fn(i32) -> bool) -> Option<i32> {
    let (mut fails, mut steps) = (0, 1);
    while !will_do(steps) {
        (fails, steps) = (steps, 2 * steps);
        if steps > MOST_STEPS {
            return None;
        }
    }
    while steps - fails > 1 {
        let middle = (steps + fails) / 2;
        if will_do(middle) {
            steps = middle;
        } else {
            fails = middle;
        }
    }
    Some(steps)
}

/// The keys that a cause points to, each once; that asks for less clearance comes last.
fn pointed_to(error: &PlanError) -> Vec<Tried> {
    use Tried::{Home, Number};
    let mut all: Vec<Tried> = match error {
        PlanError::Unwashable(plate) => {
            let hindrances = plate.causes.iter().flat_map(|cause| &cause.worst);
            let mut grids: Vec<&Grid> = hindrances.flat_map(of_hindrance).collect();
            if grids.is_empty() {
                grids = vec![&TILT_MAX, &TILT, &CLEARANCE];
            }
            grids.into_iter().map(Number).collect()
        }
        PlanError::Line { .. } | PlanError::LiftLine(_) | PlanError::Transit(TransitError::Line { .. }) => {
            vec![Number(&LIFT), Number(&TILT_MAX), Number(&CLEARANCE)]
        }
        PlanError::Tilt { .. } => vec![Number(&TILT_MAX)],
        PlanError::Transit(TransitError::NotFound { .. }) => {
            vec![Number(&LIFT), Home(End::Start), Home(End::End), Number(&CLEARANCE)]
        }
        PlanError::Transit(TransitError::Home { .. }) => {
            vec![Home(End::Start), Home(End::End), Number(&CLEARANCE)]
        }
        PlanError::HomeNotClear { end, .. } => vec![Home(*end), Number(&CLEARANCE)],
        PlanError::NoHome { .. } => vec![Number(&LENGTH), Number(&CLEARANCE)],
        _ => Vec::new(),
    };
    all.sort_by_key(|tried| tried.key() == CLEARANCE.key);
    let mut keys: Vec<&str> = Vec::new();
    all.retain(|tried| {
        let is_new = !keys.contains(&tried.key());
        keys.push(tried.key());
        is_new
    });
    all
}

/// The keys that decide whether something hinders.
fn of_hindrance(hindrance: &Hindrance) -> Vec<&'static Grid> {
    let reach = [&TILT_MAX, &TILT, &LENGTH, &PLATE_HEIGHT];
    match hindrance {
        Hindrance::Clearance { pair, .. } => {
            let of_handle = [&pair.a, &pair.b].into_iter().any(|name| name == "handle");
            let own: &[&Grid] = if of_handle { &[&SPONGE_HEIGHT, &HANDLE] } else { &[] };
            [own, &reach, &[&CLEARANCE]].concat()
        }
        Hindrance::Wrist { .. } => [&[&WRIST][..], &reach].concat(),
        Hindrance::NotFinite => Vec::new(),
        _ => reach.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use std::cell::Cell;

    #[test]
    fn the_least_number_of_steps_takes_no_more_than_the_trials_stated() {
        for least in 1..=MOST_STEPS + 1 {
            let trials = Cell::new(0);
            let found = least_steps(|steps| {
                trials.set(trials.get() + 1);
                steps >= least
            });
            assert_eq!(found, (least <= MOST_STEPS).then_some(least));
            assert!(trials.get() <= MOST_TRIALS, "{least}: {}", trials.get());
        }
    }

    #[test]
    fn every_grid_is_a_key_of_the_table() {
        let all = [
            &SPONGE_HEIGHT,
            &HANDLE,
            &LENGTH,
            &LIFT,
            &TILT_MAX,
            &TILT,
            &CLEARANCE,
            &WRIST,
            &PLATE_HEIGHT,
        ];
        for grid in all {
            assert!(crate::keys::KEYS.iter().any(|key| key.path == grid.key), "{}", grid.key);
            let mut scenario = Scenario::load("kitchen").unwrap();
            (grid.set)(&mut scenario, 0.125);
            assert_eq!((grid.get)(&scenario), Some(0.125), "{}", grid.key);
            let (section, name) = grid.key.split_once('.').unwrap();
            let stated = serde_json::to_value(&scenario).unwrap();
            assert_eq!(stated[section][name], 0.125, "{}", grid.key);
        }
    }
}
