//! A plate for which no way was found to wash it whole: why, and where it could be washed.

use super::shared::Pipeline;
use super::visit;
use crate::activity::Activity;
use crate::error::PlanError;
use crate::redundancy::relocation::{RING_M, RINGS, Relocation, SEARCHED_M};
use crate::redundancy::washable::{self, Washable};
use crate::redundancy::{Conclusion, RedundancyError, Task};
use crate::scene::Scene;
use crate::transit::LiftLine;
use crate::unwashable::{PlaceSearch, UnwashablePlate};
use nalgebra::Vector2;
use platewash_kinematics::JointVector;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::wash_path::WashPath;

impl Pipeline<'_> {
    /// Looks into a plate for which no configurations were found.
    pub fn unwashable(
        &self,
        scene: &Scene<'_>,
        path: &WashPath,
        near: &JointVector,
        error: RedundancyError,
    ) -> PlanError {
        let looked_into = match error {
            RedundancyError::Cancelled(cancelled) => Err(cancelled),
            error => self.look_into(scene, path, near, error),
        };
        match looked_into {
            Ok(plate) => PlanError::Unwashable(Box::new(plate)),
            Err(cancelled) => cancelled.into(),
        }
    }

    fn look_into(
        &self,
        scene: &Scene<'_>,
        path: &WashPath,
        near: &JointVector,
        error: RedundancyError,
    ) -> Result<UnwashablePlate, Cancelled> {
        let plate = path.plate;
        (self.watch.tell)(&Activity::Cause { plate });
        let part = match Task::new(scene, path, self.clearance_m(), near) {
            Ok(task) => Some(washable::washable_part(&task)?),
            Err(_) => None,
        };
        let (share, causes, conclusion) = match part {
            Some(Washable::Part {
                share,
                causes,
                conclusion,
            }) => (Some(share), causes, conclusion),
            _ => (None, Vec::new(), Conclusion::NotFound),
        };
        let (nearest, place_search) = match self.settings.relocate {
            true => (self.nearest(scene, path, near), PlaceSearch::Within(SEARCHED_M)),
            false => (None, PlaceSearch::Off),
        };
        scene.check_cancelled()?;
        Ok(UnwashablePlate {
            plate,
            centre_m: self.plates[plate].centre_xy(),
            error,
            conclusion,
            share,
            causes,
            nearest_m: nearest.map(Into::into),
            place_search,
        })
    }

    /// The nearest place found at which the job would wash the plate \[m\].
    fn nearest(&self, scene: &Scene<'_>, path: &WashPath, near: &JointVector) -> Option<Vector2<f64>> {
        let plate = path.plate;
        let relocation = Relocation {
            scene,
            clearance: &self.clearance,
            path,
            clearance_m: self.clearance_m(),
            near,
        };
        let mut holds = |centre: &Vector2<f64>| {
            let centre_m = (*centre).into();
            (self.watch.tell)(&Activity::Trial { plate, centre_m });
            self.washes_at(plate, centre_m).unwrap_or(false)
        };
        let tell = |ring: u32| {
            let (of, away_m) = (RINGS, RING_M * f64::from(ring));
            (self.watch.tell)(&Activity::Relocation {
                plate,
                ring,
                of,
                away_m,
            });
        };
        relocation.nearest_washable(&mut holds, &tell).ok().flatten()
    }

    /// Whether the job would wash a plate with its centre there \[m\]: planned as the job is, up to the transits to it and from
    /// it. Other plates that cannot be washed are left out.
    fn washes_at(&self, plate: usize, centre_m: [f64; 2]) -> Result<bool, PlanError> {
        let mut plates = self.plates.to_vec();
        plates[plate] = plates[plate].moved_to(centre_m);
        let moved = self.among(&plates);
        moved.check_homes()?;
        let scene = moved.scene()?;
        let (order, _) = moved.order(&scene)?;
        let [mut near, _] = self.terms.home_rad;
        let (mut lines, mut at): (Vec<[LiftLine; 2]>, _) = (Vec::new(), None);
        for k in 0..order.len() {
            let path = moved.path_of(&scene, &order, k);
            let washing = match moved.washing(&scene, &path, &near) {
                Ok(washing) => washing,
                Err(RedundancyError::Cancelled(cancelled)) => return Err(cancelled.into()),
                Err(_) if order[k] != plate => continue,
                Err(_) => return Ok(false),
            };
            near = washing.q.last().copied().unwrap_or(near);
            if order[k] == plate {
                at = Some(lines.len());
            }
            lines.push(visit::lines(&moved, &scene, &path, &washing)?);
        }
        let lines: Vec<_> = lines.iter().map(|[entry, exit]| [entry, exit]).collect();
        let beside = |k: usize| at.is_some_and(|at| k == at || k == at + 1);
        moved.transits(&scene, &lines, beside)?;
        Ok(true)
    }
}
