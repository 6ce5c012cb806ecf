//! All plates, one after the other.

use super::shared::Pipeline;
use super::visit::{Turn, Visit, turned_as, wash_path};
use crate::activity::Activity;
use crate::error::PlanError;
use crate::pattern::{Margin, Promise, Shortfall};
use crate::redundancy::{self, RedundancyError, Task, Washing};
use crate::scene::Scene;
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::wash_path::WashPath;

/// A plate for which no configurations were found.
#[derive(Debug)]
pub(super) struct Failed {
    /// Its wash path.
    pub path: WashPath,
    /// The configuration not far from which it was to start \[rad\].
    pub near: JointVector,
    /// Where the search ended.
    pub error: RedundancyError,
}

impl Pipeline<'_> {
    pub fn visits(&self, scene: &Scene<'_>, order: &[usize]) -> Result<Vec<Visit>, PlanError> {
        // At once, before others are searched for minutes.
        for k in 0..order.len() {
            if let Some(failed) = self.blocked(scene, order, k)? {
                return Err(self.unwashable(scene, failed));
            }
        }
        let mut visits: Vec<Visit> = Vec::with_capacity(order.len());
        for turn in self.turns(scene, order, |_| true) {
            let turn = turn.map_err(|failed| self.unwashable(scene, *failed))?;
            self.check_promise(&turn)?;
            visits.push(Visit::plan(self, scene, turn)?);
        }
        Ok(visits)
    }

    /// The `k`-th plate of an order, where a few points tell that it cannot be washed, and no policy of tilts washes it either.
    pub fn blocked(&self, scene: &Scene<'_>, order: &[usize], k: usize) -> Result<Option<Failed>, Cancelled> {
        scene.check_cancelled()?;
        let [near, _] = self.terms.home_rad;
        let path = self.path_of(scene, order, k);
        let Ok(task) = Task::new(scene, &path, self.clearance_m(), &near) else {
            return Ok(None);
        };
        if !redundancy::is_blocked(&task)? {
            return Ok(None);
        }
        self.tell_of(order, k);
        // A tilt between those of the search may still do.
        let error = redundancy::washing(&task).err();
        Ok(error.map(|error| Failed { path, near, error }))
    }

    /// The washings of the plates that are `wanted`, in order; each starts where the last one ended. Those that fail are left out.
    pub fn turns(
        &self,
        scene: &Scene<'_>,
        order: &[usize],
        wanted: impl Fn(usize) -> bool,
    ) -> impl Iterator<Item = Result<Turn, Box<Failed>>> {
        let [mut near, _] = self.terms.home_rad;
        let turns = (0..order.len()).filter(move |&k| wanted(order[k]));
        turns.map(move |k| {
            self.tell_of(order, k);
            let path = self.path_of(scene, order, k);
            match self.washing_by_patterns(scene, &path, &near) {
                Ok(turn) => {
                    near = turn.washing.q.last().copied().unwrap_or(near);
                    Ok(turn)
                }
                Err(error) => Err(Box::new(Failed { path, near, error })),
            }
        })
    }

    fn tell_of(&self, order: &[usize], k: usize) {
        let (plate, turn, of) = (order[k], k + 1, order.len());
        (self.watch.tell)(&Activity::Wash { plate, turn, of });
    }

    /// The wash path on the `k`-th plate of an order: the one asked for, or one that ends towards the next plate, or home.
    pub fn path_of(&self, scene: &Scene<'_>, order: &[usize], k: usize) -> WashPath {
        let home = || self.home_tip(scene, &self.terms.home_rad[1]);
        let next = order.get(k + 1).map(|&next| self.plates[next].centre());
        let path = self.widest_path(order[k], &next.unwrap_or_else(home));
        let asked = self.asked_paths.iter().find(|asked| asked.plate == path.plate);
        asked.map_or(path, |asked| WashPath {
            curve: asked.curve,
            ..path
        })
    }

    /// The wash path on a plate by the pattern that is tried first, with the widest cone of all.
    pub fn widest_path(&self, plate: usize, towards: &Vector3<f64>) -> WashPath {
        wash_path(self, plate, &self.patterns[plate].widest(), towards)
    }

    /// The washing of a plate by its patterns, with a path that ends where `like` does: by the first with which the arm finds a way and
    /// presses as is promised with a margin, or else without one; where it never presses so, by one with which it finds a way. Denser and
    /// slower patterns are tried last, where the arm finds a way by another one and does not press so with a little margin.
    pub fn washing_by_patterns(
        &self,
        scene: &Scene<'_>,
        like: &WashPath,
        near: &JointVector,
    ) -> Result<Turn, RedundancyError> {
        let plate = like.plate;
        let patterns = &self.patterns[plate];
        let mut found: Result<Turn, RedundancyError> = Err(RedundancyError::Plate { plate, count: 0 });
        let mut offered = patterns.first().iter().copied().chain(patterns.wider());
        let mut denser = patterns.denser();
        // Whether the one found lacks a little margin, once that is asked.
        let mut lacks = None;
        loop {
            let Some(pattern) = offered.next().or_else(|| {
                let turn = found.as_ref().ok()?;
                let lacks = lacks.get_or_insert_with(|| self.shortfall(scene, turn, &Margin::CLOSE).is_some());
                lacks.then(|| denser.next())?
            }) else {
                return found;
            };
            let path = WashPath {
                curve: turned_as(pattern.curve, &like.curve),
                cone_rad: pattern.cone_rad,
                ..*like
            };
            match self.washing(scene, &path, near) {
                Err(RedundancyError::Cancelled(cancelled)) => return Err(cancelled.into()),
                // What the widest cone does not reach is told.
                Err(error) => found = found.or(Err(error)),
                Ok(washing) => {
                    let speed_m_s = pattern.speed_share * self.terms.wash_speed_m_s();
                    let mut turn = Turn {
                        path,
                        washing,
                        speed_m_s,
                        shortfall: None,
                    };
                    if self.shortfall(scene, &turn, &Margin::ARM).is_none() {
                        return Ok(turn);
                    }
                    turn.shortfall = self.shortfall(scene, &turn, &Margin::NONE);
                    let is_better = found
                        .as_ref()
                        .map_or(true, |found| found.shortfall.is_some() && turn.shortfall.is_none());
                    if is_better {
                        (found, lacks) = (Ok(turn), None);
                    }
                }
            }
        }
    }

    /// What a plate's washing lacks of what is promised about contact, looked at where its configurations are.
    fn shortfall(&self, scene: &Scene<'_>, turn: &Turn, margin: &Margin) -> Option<Shortfall> {
        self.terms.requirements.contact?;
        let plate = &self.plates[turn.path.plate];
        let promise = Promise::of(self.terms, &plate.surface);
        promise.shortfall(scene, plate, (&turn.washing.q, turn.speed_m_s), margin)
    }

    /// Refuses a washing of which no plan could be proved, where its curve was chosen: what a stated one lacks is for the certificate to say.
    pub fn check_promise(&self, turn: &Turn) -> Result<(), PlanError> {
        let plate = turn.path.plate;
        match turn.shortfall {
            Some(shortfall) if self.patterns[plate].is_chosen() => Err(PlanError::Promise { plate, shortfall }),
            _ => Ok(()),
        }
    }

    /// The washing along a path from a configuration not far from `near` \[rad\].
    pub fn washing(&self, scene: &Scene<'_>, path: &WashPath, near: &JointVector) -> Result<Washing, RedundancyError> {
        redundancy::washing(&Task::new(scene, path, self.clearance_m(), near)?)
    }
}
