//! Where else a plate could lie for the job to wash it.

use super::shared::Pipeline;
use super::visit;
use super::visit::Turn;
use crate::activity::Activity;
use crate::error::PlanError;
use crate::redundancy::RedundancyError;
use crate::redundancy::elsewhere::Elsewhere;
use crate::redundancy::relocation::{RING_M, RINGS, nearest_washable};
use crate::scene::Scene;
use crate::transit::LiftLine;
use crate::watch::Watch;
use nalgebra::Vector2;
use platewash_kinematics::JointVector;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::clearance::standing_overlaps;
use platewash_workcell::job::WashJob;
use platewash_workcell::wash_path::WashPath;

/// The nearest centre found at which the job would wash a plate \[m\], on a grid of a millimetre; `None` within
/// [`SEARCHED_M`](crate::SEARCHED_M) of where it lies. The search that [`plan_with`](crate::plan_with) makes where the job asks for
/// it, whether it does or not; a plate that is washed where it lies stays there, to a millimetre.
///
/// # Errors
/// [`PlanError`] of the input, [`PlanError::Plate`] and [`PlanError::Cancelled`].
pub fn nearest_place(job: &WashJob, plate: usize, watch: &Watch<'_>) -> Result<Option<[f64; 2]>, PlanError> {
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_plate(plate)?;
    let scene = pipeline.scene()?;
    let (order, _) = pipeline.order(&scene)?;
    let (path, near) = pipeline.start_on(&scene, &order, plate)?;
    let nearest = pipeline.nearest(&scene, &path, &near)?;
    scene.check_cancelled()?;
    Ok(nearest)
}

impl Pipeline<'_> {
    /// The wash path of a plate, and the configuration not far from which it starts \[rad\]: where the one before it ended; home,
    /// where a few points tell that it cannot be washed.
    fn start_on(&self, scene: &Scene<'_>, order: &[usize], plate: usize) -> Result<(WashPath, JointVector), Cancelled> {
        let turn = order.iter().position(|&other| other == plate).unwrap_or(0);
        let path = self.path_of(scene, order, turn);
        let [mut near, _] = self.terms.home_rad;
        if self.blocked(scene, order, turn)?.is_none() {
            let before = &order[..turn];
            let washed = self.turns(scene, order, |other| before.contains(&other));
            let last = washed.filter_map(Result::ok).last();
            near = last.and_then(|turn| turn.washing.q.last().copied()).unwrap_or(near);
        }
        scene.check_cancelled()?;
        Ok((path, near))
    }

    /// The nearest place found at which the job would wash the plate \[m\].
    pub fn nearest(
        &self,
        scene: &Scene<'_>,
        path: &WashPath,
        near: &JointVector,
    ) -> Result<Option<[f64; 2]>, Cancelled> {
        let plate = path.plate;
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
        match nearest_washable(&self.elsewhere(scene, path, near), &mut holds, &tell) {
            Ok(place) => Ok(place.map(Into::into)),
            Err(RedundancyError::Cancelled(cancelled)) => Err(cancelled),
            Err(_) => Ok(None),
        }
    }

    /// The plate of a wash path, to be looked at elsewhere.
    pub fn elsewhere<'a>(&'a self, scene: &'a Scene<'a>, path: &'a WashPath, near: &'a JointVector) -> Elsewhere<'a> {
        Elsewhere {
            scene,
            clearance: &self.clearance,
            path,
            clearance_m: self.clearance_m(),
            near,
        }
    }

    /// Whether the job would wash a plate with its centre there \[m\]: planned as the job is, up to the transits to it and from
    /// it. Other plates that cannot be washed are left out.
    fn washes_at(&self, plate: usize, centre_m: [f64; 2]) -> Result<bool, PlanError> {
        let mut plates = self.plates.to_vec();
        plates[plate] = self.scene()?.moved(&plates[plate], centre_m);
        if !standing_overlaps(self.robot, &self.terms.workcell, &plates, None)?.is_empty() {
            return Ok(false);
        }
        let moved = self.among(&plates);
        moved.check_homes()?;
        let scene = moved.scene()?;
        let (order, _) = moved.order(&scene)?;
        let (mut lines, mut at): (Vec<[LiftLine; 2]>, _) = (Vec::new(), None);
        for turn in moved.turns(&scene, &order, |_| true) {
            let Turn { path, washing, .. } = match turn {
                Ok(washed) => washed,
                Err(failed) => match failed.error {
                    RedundancyError::Cancelled(cancelled) => return Err(cancelled.into()),
                    _ if failed.path.plate != plate => continue,
                    _ => return Ok(false),
                },
            };
            if path.plate == plate {
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
