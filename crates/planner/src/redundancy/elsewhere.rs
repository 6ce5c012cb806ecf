//! A plate at another place than its own, the others as they lie: whether it could be washed there.

use super::error::RedundancyError;
use super::task::Task;
use super::washing::by_policy;
use crate::scene::{Scene, Width};
use nalgebra::Vector2;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::clearance::{ClearanceModel, gap_of_plates};
use platewash_workcell::layout::base_footprint;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;

/// A plate to be looked at elsewhere.
#[derive(Debug, Clone, Copy)]
pub struct Elsewhere<'a> {
    /// The scene, with the plates as they lie.
    pub scene: &'a Scene<'a>,
    /// Its bodies, to be moved.
    pub clearance: &'a ClearanceModel,
    /// The wash path on the plate to move.
    pub path: &'a WashPath,
    /// Clearance that must be kept \[m\].
    pub clearance_m: f64,
    /// The configuration it starts not far from \[rad\].
    pub near: &'a JointVector,
}

/// One place after the other, with the plate moved there.
#[derive(Debug, Clone)]
pub struct Trial<'a> {
    asked: Elsewhere<'a>,
    plates: Vec<Plate>,
    clearance: ClearanceModel,
}

impl<'a> Trial<'a> {
    /// Trials with the plate of the wash path.
    #[must_use]
    pub fn new(asked: &Elsewhere<'a>) -> Self {
        Self {
            asked: *asked,
            plates: asked.scene.plates.to_vec(),
            clearance: asked.clearance.clone(),
        }
    }

    /// The bodies, with the plate where it last had room.
    pub fn bodies(&self) -> &ClearanceModel {
        &self.clearance
    }

    /// Whether a policy of tilts washes the plate whole with its centre there \[m\], and it has room there: it overlaps neither
    /// another plate nor the base.
    ///
    /// # Errors
    /// [`RedundancyError`] for numbers out of range, or where the search was given up.
    pub fn suits(&mut self, centre: &Vector2<f64>) -> Result<bool, RedundancyError> {
        let Elsewhere {
            scene,
            path,
            clearance_m,
            near,
            ..
        } = self.asked;
        scene.check_cancelled()?;
        let (plate, count) = (path.plate, self.plates.len());
        let lies = self
            .plates
            .get_mut(plate)
            .ok_or(RedundancyError::Plate { plate, count })?;
        let moved = scene.moved(lies, (*centre).into());
        *lies = moved;
        let mut others = self.plates.iter().enumerate().filter(|(i, _)| *i != path.plate);
        if others.any(|(_, other)| overlap(scene.robot, &moved, other)) || meets_base(scene.robot, &moved) {
            return Ok(false);
        }
        self.clearance.lay(&self.plates);
        let scene = scene.among(&self.clearance, &self.plates);
        let task = Task::new(&scene, path, clearance_m, near)?;
        Ok(by_policy(&task, Width::Near)?.is_some())
    }
}

/// Whether two plates share a place: parallel ones where they do seen along their axis and neither lies over the other, others where their
/// bodies do.
fn overlap(robot: &RobotModel, a: &Plate, b: &Plate) -> bool {
    if !a.is_parallel(b) {
        return !a.is_back_of(b) && gap_of_plates(robot, a, b) < 0.0;
    }
    a.aside_m(b) < a.rim_m() + b.rim_m() && !a.is_over(b) && !b.is_over(a)
}

/// Whether a plate that lies level with the base is over it.
fn meets_base(robot: &RobotModel, plate: &Plate) -> bool {
    let level = Plate::level_disc([0.0; 3], 1.0, 1.0);
    if !plate.is_parallel(&level) {
        return false;
    }
    let (foot, [x, y], rim_m) = (base_footprint(robot), plate.centre_xy(), plate.rim_m());
    let beside = |[least, most]: [f64; 2], at: f64| (least - at).max(at - most).max(0.0);
    let (dx, dy) = (beside(foot.x_m, x), beside(foot.y_m, y));
    dx * dx + dy * dy < rim_m * rim_m
}
