//! A plate at another place than its own, the others as they lie: whether it could be washed there.

use super::error::RedundancyError;
use super::task::Task;
use super::washing::by_policy;
use crate::scene::{Scene, Width};
use nalgebra::Vector2;
use platewash_kinematics::JointVector;
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
        let meets = |gap_m: f64| gap_m < 0.0;
        let over_base = base_footprint(scene.robot).gap_m(&moved).is_some_and(meets);
        if over_base || others.any(|(_, other)| meets(gap_of_plates(scene.robot, &moved, other))) {
            return Ok(false);
        }
        self.clearance.lay(&self.plates);
        if self.clearance.plate_in_base(path.plate).is_some() {
            return Ok(false);
        }
        let scene = scene.among(&self.clearance, &self.plates);
        let task = Task::new(&scene, path, clearance_m, near)?;
        Ok(by_policy(&task, Width::Near)?.is_some())
    }
}
