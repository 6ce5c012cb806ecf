//! All plates, one after the other.

use super::shared::Pipeline;
use super::visit::{Visit, wash_path};
use crate::activity::Activity;
use crate::error::PlanError;
use crate::redundancy::{self, RedundancyError, Task, Washing};
use crate::scene::Scene;
use platewash_kinematics::JointVector;
use platewash_workcell::wash_path::WashPath;

impl Pipeline<'_> {
    pub fn visits(&self, scene: &Scene<'_>, order: &[usize]) -> Result<Vec<Visit>, PlanError> {
        self.check_unblocked(scene, order)?;
        let [start, _] = &self.terms.home_rad;
        let mut visits: Vec<Visit> = Vec::with_capacity(order.len());
        for k in 0..order.len() {
            self.tell_of(order, k);
            let path = self.path_of(scene, order, k);
            let near = visits.last().and_then(|v| v.washing.q.last()).unwrap_or(start);
            let washing = self
                .washing(scene, &path, near)
                .map_err(|error| self.unwashable(scene, &path, near, error))?;
            visits.push(Visit::plan(self, scene, path, washing)?);
        }
        Ok(visits)
    }

    /// Refuses at once a plate of which a few points tell that it cannot be washed, before others are searched for minutes.
    fn check_unblocked(&self, scene: &Scene<'_>, order: &[usize]) -> Result<(), PlanError> {
        let [near, _] = &self.terms.home_rad;
        for k in 0..order.len() {
            scene.check_cancelled()?;
            let path = self.path_of(scene, order, k);
            let Ok(task) = Task::new(scene, &path, self.clearance_m(), near) else {
                continue;
            };
            if !redundancy::is_blocked(&task)? {
                continue;
            }
            self.tell_of(order, k);
            // A tilt between those of the search may still do.
            if let Err(error) = redundancy::washing(&task) {
                return Err(self.unwashable(scene, &path, near, error));
            }
        }
        Ok(())
    }

    fn tell_of(&self, order: &[usize], k: usize) {
        let (plate, turn, of) = (order[k], k + 1, order.len());
        (self.watch.tell)(&Activity::Wash { plate, turn, of });
    }

    /// The wash path on the `k`-th plate of an order: it ends towards the next one, or home.
    pub fn path_of(&self, scene: &Scene<'_>, order: &[usize], k: usize) -> WashPath {
        let home = || self.home_tip(scene, &self.terms.home_rad[1]);
        let next = order.get(k + 1).map(|&next| self.plates[next].centre());
        wash_path(self, order[k], &next.unwrap_or_else(home))
    }

    /// The washing along a path from a configuration not far from `near` \[rad\].
    pub fn washing(&self, scene: &Scene<'_>, path: &WashPath, near: &JointVector) -> Result<Washing, RedundancyError> {
        redundancy::washing(&Task::new(scene, path, self.clearance_m(), near)?)
    }
}
