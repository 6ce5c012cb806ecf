//! Keys that would mend a job that cannot be done, or whose plan is not proved: one alone, changed least.
//!
//! The cause points to keys; each is tried by itself, up and down as the cause has it, by planning the changed job whole and proving the plan.
//! A change is so many steps of the key's own grid: 1, 2, 4, 8, 16 and so on, until the plan is proved, then halved down to the least with which
//! it is: at most [`MOST_TRIALS`] jobs per key and direction, in as many threads as there are. The search ends after a time that
//! the caller states: keys that were not tried until then are named.

use crate::failure::home_key;
use crate::scenario::Scenario;
use platewash_bodies::job::{End, JobError};
use platewash_certificate::{Certificate, Requirement, prove_with};
use platewash_kinematics::RobotModel;
use platewash_planner::placed_arm::Hindrance;
use platewash_planner::transit::TransitError;
use platewash_planner::{ContactPromise, PlanError, Watch, plan_unexplained};
use platewash_workcell::cancel::{Cancelled, system_clock};
use platewash_workcell::layout::LayoutError;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

/// The greatest change, in steps of a key's grid: a power of 2.
const MOST_STEPS: i32 = 32;

/// Jobs that are planned at most for a key in one direction: 1, 2, 4, 8, 16, 32 steps, and four halvings.
pub const MOST_TRIALS: u32 = 10;

/// Digits of a step's value that count: grids are coarser.
const ROUNDED: f64 = 1e9;

/// A key that alone, changed, gives a job that is planned.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remedy {
    /// Dotted path of the key.
    pub key: &'static str,
    /// The value to give it, in the key's unit; `None`: to be left out.
    pub value: Option<Value>,
    /// The value that it has.
    pub found: Option<Value>,
    /// True where the plan is proved; otherwise the job is only planned.
    pub is_proved: bool,
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.value, &self.found) {
            (Some(value), Some(found)) => write!(f, "{} = {value} instead of {found}", self.key),
            (Some(value), None) => write!(f, "{} = {value}", self.key),
            (None, _) => write!(f, "{} left out, for a home that is found", self.key),
        }
    }
}

/// Changes that were tried for a job that cannot be done.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Remedies {
    /// The keys that would do, each alone: those with which the plan is proved first, in the order in which the cause points to them.
    pub would_do: Vec<Remedy>,
    /// The keys that would not, as far as they were changed.
    pub would_not: Vec<&'static str>,
    /// The keys for which there was no time.
    pub not_tried: Vec<&'static str>,
}

impl fmt::Display for Remedies {
    /// Writes nothing where nothing was tried.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const FEW: usize = 3;
        let few = |is_proved: bool| {
            let some = self.would_do.iter().filter(|remedy| remedy.is_proved == is_proved);
            let some: Vec<_> = some.take(FEW).map(ToString::to_string).collect();
            some.join(", or with ")
        };
        let [proved, planned] = [true, false].map(few);
        if !proved.is_empty() {
            write!(f, "; the plan is proved with {proved}")?;
        }
        if !planned.is_empty() {
            write!(f, "; the job is planned, but not proved, with {planned}")?;
        }
        if self.would_do.is_empty() && !self.would_not.is_empty() {
            let keys = self.would_not.join(", ");
            write!(f, "; no single change of these keys was found to help: {keys}")?;
        }
        if !self.not_tried.is_empty() {
            write!(
                f,
                "; not tried to the end, for lack of time: {}",
                self.not_tried.join(", ")
            )?;
        }
        Ok(())
    }
}

/// A key that is tried.
#[derive(Debug, Clone, Copy)]
enum TriedKey {
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
    /// Its value, where it has an effect.
    get: fn(&Scenario) -> Option<f64>,
    set: fn(&mut Scenario, f64),
}

/// Result of a changed job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Trial {
    Refused,
    Planned,
    Proved,
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
grid!(
    COMPRESSION,
    "tool.sponge_compression_m",
    [0.0005, -0.0005],
    tool.sponge_compression_m
);
grid!(SPEED, "wash.speed_m_s", [-0.02], wash.speed_m_s);
grid!(LESS_TILT, "wash.tilt_max_deg", [-1.0], wash.tilt_max_deg);
grid!(stated TURNS, "wash.turns", [0.5], wash.turns);
grid!(stated PATH_RADIUS, "wash.path_radius_m", [0.002, -0.002], wash.path_radius_m);
grid!(stated PLATE_RADIUS, "layout.plate_radius_m", [-0.005], layout.plate_radius_m);
static PLATE_HEIGHT: Grid = Grid {
    key: "layout.plate_height_m",
    steps: &[0.01, -0.01],
    // Plates that are placed one by one have heights of their own.
    get: |scenario| scenario.plate.is_empty().then_some(scenario.layout.plate_height_m),
    set: |scenario, value| scenario.layout.plate_height_m = value,
};
static MIN_DISTANCE: Grid = Grid {
    key: "layout.min_distance_m",
    steps: &[0.01, -0.01],
    get: |scenario| is_sampled(scenario).then_some(scenario.layout.min_distance_m),
    set: |scenario, value| scenario.layout.min_distance_m = value,
};
static COUNT: Grid = Grid {
    key: "layout.count",
    steps: &[-1.0],
    get: |scenario| is_sampled(scenario).then_some(scenario.layout.count as f64),
    set: |scenario, value| scenario.layout.count = value.max(0.0) as usize,
};
static MOUNT: Grid = Grid {
    key: "robot.mount_m",
    steps: &[0.02, -0.02],
    get: |scenario| Some(scenario.robot.mount_m[2]),
    set: |scenario, value| scenario.robot.mount_m[2] = value,
};

/// Checks that plates are drawn at random.
fn is_sampled(scenario: &Scenario) -> bool {
    scenario.plate.is_empty() && scenario.layout.positions_m.is_none()
}

impl TriedKey {
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
    pub fn remedies(
        &self,
        arm: &Arc<RobotModel>,
        error: &PlanError,
        watch: &Watch<'_>,
        search_time: Duration,
    ) -> Result<Remedies, Cancelled> {
        self.try_each(arm, keys_of_cause(error), watch, search_time)
    }

    /// Keys with which the plan would be proved, where it is not.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn remedies_of_proof(
        &self,
        arm: &Arc<RobotModel>,
        certificate: &Certificate,
        watch: &Watch<'_>,
        search_time: Duration,
    ) -> Result<Remedies, Cancelled> {
        let broken = certificate.broken().flat_map(|check| of_requirement(check.requirement));
        self.try_each(
            arm,
            once_each(broken.map(TriedKey::Number).collect()),
            watch,
            search_time,
        )
    }

    fn try_each(
        &self,
        arm: &Arc<RobotModel>,
        pointed_to: Vec<TriedKey>,
        watch: &Watch<'_>,
        search_time: Duration,
    ) -> Result<Remedies, Cancelled> {
        let is_over = watch.cancel.within(search_time, system_clock);
        let silent = Watch::silent(&is_over);
        let tried: Vec<TriedKey> = pointed_to.into_iter().filter(|tried| self.has_effect(*tried)).collect();
        let found: Vec<_> = tried
            .par_iter()
            .with_max_len(1)
            .map(|tried| (self.remedy(arm, *tried, &silent), is_over.is_cancelled()))
            .collect();
        watch.cancel.check()?;
        let mut remedies = Remedies::default();
        for (tried, found) in tried.iter().zip(found) {
            match found {
                (Some(remedy), _) => remedies.would_do.push(remedy),
                (None, true) => remedies.not_tried.push(tried.key()),
                (None, false) => remedies.would_not.push(tried.key()),
            }
        }
        remedies.would_do.sort_by_key(|remedy| !remedy.is_proved);
        Ok(remedies)
    }

    /// Returns true where a key has an effect in this scenario.
    fn has_effect(&self, tried: TriedKey) -> bool {
        match tried {
            TriedKey::Number(grid) => (grid.get)(self).is_some(),
            TriedKey::Home(End::Start) => self.robot.start_deg.is_some(),
            TriedKey::Home(End::End) => self.robot.home_deg.is_some(),
        }
    }

    /// The least change of a key with which the plan is proved, or else with which there is one.
    fn remedy(&self, arm: &Arc<RobotModel>, tried: TriedKey, watch: &Watch<'_>) -> Option<Remedy> {
        let key = tried.key();
        let grid = match tried {
            TriedKey::Number(grid) => grid,
            TriedKey::Home(end) => {
                let mut changed = self.clone();
                match end {
                    End::Start => changed.robot.start_deg = None,
                    End::End => changed.robot.home_deg = None,
                }
                let trial = changed.trial(arm, watch);
                return (trial > Trial::Refused).then_some(Remedy {
                    key,
                    value: None,
                    found: None,
                    is_proved: trial == Trial::Proved,
                });
            }
        };
        let found = (grid.get)(self)?;
        let changed = |step: f64, steps: i32| {
            let mut changed = self.clone();
            let after = (ROUNDED * (found + step * f64::from(steps))).round() / ROUNDED;
            (grid.set)(&mut changed, after);
            changed
        };
        let least = |step: f64| least_steps(|steps| changed(step, steps).trial(arm, watch));
        let ways = grid.steps.iter().filter_map(|&step| Some((least(step)?, step)));
        let ((trial, steps), step) = ways.min_by_key(|((trial, steps), _)| (*trial != Trial::Proved, *steps))?;
        Some(Remedy {
            key,
            value: changed(step, steps).stated(key),
            found: self.stated(key),
            is_proved: trial == Trial::Proved,
        })
    }

    /// Returns the stated value of a key.
    fn stated(&self, key: &str) -> Option<Value> {
        let (section, name) = key.split_once('.')?;
        let all = serde_json::to_value(self).ok()?;
        all.get(section)?.get(name).cloned()
    }

    /// Plans and proves the changed scenario.
    fn trial(&self, arm: &Arc<RobotModel>, watch: &Watch<'_>) -> Trial {
        if self.validate().is_err() {
            return Trial::Refused;
        }
        let placed = self.place(arm, watch);
        let Ok(job) = placed.and_then(|layout| self.job_on(arm, &layout)) else {
            return Trial::Refused;
        };
        let Ok(planned) = plan_unexplained(&job, watch) else {
            return Trial::Refused;
        };
        match prove_with(&planned.plan, arm, watch.cancel) {
            Ok(certificate) if certificate.passes() => Trial::Proved,
            _ => Trial::Planned,
        }
    }
}

/// The least number of steps up to [`MOST_STEPS`] with which the plan is proved, as far as [`MOST_TRIALS`] trials find it; where it is with
/// none, the first with which there is one.
fn least_steps(trial: impl Fn(i32) -> Trial) -> Option<(Trial, i32)> {
    let (mut planned, mut fails, mut steps) = (None, 0, 1);
    loop {
        match trial(steps) {
            Trial::Proved => break,
            Trial::Planned => planned = planned.or(Some((Trial::Planned, steps))),
            Trial::Refused => {}
        }
        (fails, steps) = (steps, 2 * steps);
        if steps > MOST_STEPS {
            return planned;
        }
    }
    while steps - fails > 1 {
        let middle = (steps + fails) / 2;
        if trial(middle) == Trial::Proved {
            steps = middle;
        } else {
            fails = middle;
        }
    }
    Some((Trial::Proved, steps))
}

/// The keys that a cause points to, each once; that asks for less clearance comes last.
fn keys_of_cause(error: &PlanError) -> Vec<TriedKey> {
    use TriedKey::{Home, Number};
    let mut all: Vec<TriedKey> = match error {
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
        PlanError::Promise { shortfall, .. } => of_promise(shortfall.promised).into_iter().map(Number).collect(),
        PlanError::Overlap(_)
        | PlanError::Layout(LayoutError::NoRoom { .. })
        | PlanError::Job(JobError::Standing(_)) => {
            let all = [&MIN_DISTANCE, &PLATE_RADIUS, &COUNT, &PLATE_HEIGHT, &MOUNT];
            all.into_iter().map(Number).collect()
        }
        PlanError::Job(JobError::StillNear { .. }) => vec![Number(&CLEARANCE), Number(&LENGTH), Number(&MOUNT)],
        _ => Vec::new(),
    };
    all.sort_by_key(|tried| tried.key() == CLEARANCE.key);
    once_each(all)
}

/// Each key once.
fn once_each(mut all: Vec<TriedKey>) -> Vec<TriedKey> {
    let mut keys = BTreeSet::new();
    all.retain(|tried| keys.insert(tried.key()));
    all
}

/// The keys that decide whether a promise about contact is kept.
fn of_promise(promised: ContactPromise) -> Vec<&'static Grid> {
    match promised {
        ContactPromise::Strain | ContactPromise::LeastForce | ContactPromise::GreatestForce => {
            vec![&COMPRESSION, &LESS_TILT]
        }
        ContactPromise::Pressed | ContactPromise::ContactDose => vec![&COMPRESSION, &LESS_TILT, &TURNS],
        ContactPromise::ContactTime => vec![&SPEED, &COMPRESSION, &TURNS],
    }
}

/// The keys that decide whether a requirement is kept.
fn of_requirement(requirement: Requirement) -> Vec<&'static Grid> {
    match requirement {
        Requirement::Swept => vec![&TURNS, &PATH_RADIUS, &LESS_TILT],
        Requirement::Clearance => vec![&LIFT, &CLEARANCE],
        Requirement::Tilt => vec![&TILT_MAX],
        Requirement::Pressed | Requirement::ContactDose => of_promise(ContactPromise::Pressed),
        Requirement::ContactTime => of_promise(ContactPromise::ContactTime),
        Requirement::Strain | Requirement::ContactForce => of_promise(ContactPromise::Strain),
        _ => Vec::new(),
    }
}

/// The keys that decide whether something hinders.
fn of_hindrance(hindrance: &Hindrance) -> Vec<&'static Grid> {
    let reach = [&TILT_MAX, &TILT, &LENGTH, &PLATE_HEIGHT, &MOUNT];
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
    use super::*;
    use std::cell::Cell;

    #[test]
    fn the_least_number_of_steps_takes_no_more_than_the_trials_stated() {
        for least in 1..=MOST_STEPS + 1 {
            let trials = Cell::new(0);
            let found = least_steps(|steps| {
                trials.set(trials.get() + 1);
                if steps >= least { Trial::Proved } else { Trial::Refused }
            });
            assert_eq!(found, (least <= MOST_STEPS).then_some((Trial::Proved, least)));
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
            &COMPRESSION,
            &SPEED,
            &TURNS,
            &PATH_RADIUS,
            &PLATE_RADIUS,
            &MIN_DISTANCE,
        ];
        for grid in all {
            assert!(
                crate::keys::table::KEYS.iter().any(|key| key.path == grid.key),
                "{}",
                grid.key
            );
            let mut scenario = Scenario::load("kitchen").unwrap();
            (grid.set)(&mut scenario, 0.125);
            assert_eq!((grid.get)(&scenario), Some(0.125), "{}", grid.key);
            let (section, name) = grid.key.split_once('.').unwrap();
            let stated = serde_json::to_value(&scenario).unwrap();
            assert_eq!(stated[section][name], 0.125, "{}", grid.key);
        }
    }
}
