//! Lower bound on the share of a face that no wash path sweeps, because the tip gets near it in no configuration of the arm.
//!
//! A place is swept or pressed from a tip that is not far from it: by little more than the sponge's radius. The tip is at the end of a
//! tool that leans from the normal by no more than the job allows. So a point of the tool (the centre of the wrist, or the tip itself)
//! lies on a cap of a sphere about the tip. [`RobotModel::sharp_reach_bound`] limits how far that point gets from the arm. A place counts as
//! beyond the arm where the whole cap of every such tip lies beyond the bound. Joint limits and collisions are not used: they only take
//! more away.

use nalgebra::{Point3, Vector3};
use platewash_kinematics::RobotModel;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::trig::{acos, cos};
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::{Sponge, Tool};
use std::f64::consts::PI;

/// Distance of the points of a face that are judged, as a part of its radius.
const APART: f64 = 1.0 / 150.0;

/// Greatest distance of a place from the point that [`Surface::points`](platewash_workcell::surface::Surface::points) has for it, in
/// units of the points' distance: half a ring along the meridian, and as much as the whole distance across it on the innermost ring.
const CELL: f64 = 1.5;

/// Distance by which a tip may lie off the face \[m\]: more than a proof lets it.
const OFF_FACE_M: f64 = 1e-3;

/// Angle by which a tool may lean more than the job allows \[rad\]: more than rounding.
const MORE_LEAN_RAD: f64 = 1e-6;

/// Bound on a point of the tool.
#[derive(Debug, Clone, Copy)]
struct PointBound {
    /// The point is within `bound_m` of this, base frame \[m\].
    centre: Point3<f64>,
    bound_m: f64,
    /// Distance of the point from the tip \[m\].
    from_tip_m: f64,
    /// Angle of the way from the tip to the point from the tool's axis, which leaves the face \[rad\].
    aside_rad: f64,
}

impl PointBound {
    /// Bounds on the centre of the wrist and on the tip of a tool.
    fn both(robot: &RobotModel, tool: &Tool) -> [Self; 2] {
        let tip = tool.tip_frame(robot);
        [robot.wrist_frame(), tip].map(|point| {
            let (centre, bound_m) = robot.sharp_reach_bound(&point);
            let from_tip: RigidTransform = tip.on_body().inverse().then(point.on_body());
            Self {
                centre,
                bound_m,
                from_tip_m: from_tip.translation.norm(),
                aside_rad: angle(&from_tip.translation, &-Vector3::z()),
            }
        })
    }

    /// Returns true if the point is beyond its bound with every tip within `near_m` of a place \[m\], where the tool leans at most
    /// `lean_rad` from an axis \[rad\].
    fn is_beyond(&self, place: &Vector3<f64>, near_m: f64, axis: &Vector3<f64>, lean_rad: f64) -> bool {
        let (from, long_m) = (place - self.centre.coords, self.from_tip_m);
        // The direction on the cap that leads back to the centre the most.
        let most = (angle(&from, axis) + lean_rad + self.aside_rad).min(PI);
        let square = from.norm_squared() + long_m * long_m + 2.0 * from.norm() * long_m * cos(most);
        square.max(0.0).sqrt() > self.bound_m + near_m
    }
}

/// Angle between two vectors \[rad\]; 0 where one has no direction.
fn angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    let lengths = a.norm() * b.norm();
    match lengths > 0.0 {
        true => acos((a.dot(b) / lengths).clamp(-1.0, 1.0)),
        false => 0.0,
    }
}

/// Bounds on the arm, as a plate of a job needs them.
struct FaceBound<'a> {
    points: [PointBound; 2],
    plate: &'a Plate,
    /// The plate's axis, base frame.
    axis: Vector3<f64>,
    /// Greatest angle of the tool from the normal under the tip \[rad\].
    lean_rad: f64,
    /// Greatest distance from the tip of a place that it sweeps or presses \[m\].
    touch_m: f64,
}

impl<'a> FaceBound<'a> {
    fn new(robot: &RobotModel, terms: &JobTerms, plate: &'a Plate) -> Self {
        let (tool, is_flat) = (&terms.workcell.tool, plate.surface.is_flat());
        let lean_rad = terms.tilt_max_rad() + MORE_LEAN_RAD;
        Self {
            points: PointBound::both(robot, tool),
            plate,
            axis: plate.axis(),
            lean_rad,
            touch_m: touch_m(&tool.sponge, is_flat, lean_rad) + OFF_FACE_M + terms.height_error_of(plate),
        }
    }

    /// Returns true if no tip sweeps or presses any place of the face within `around_m` of this one \[m\], plate frame.
    fn is_beyond(&self, place: &Vector3<f64>, around_m: f64) -> bool {
        let (from_pole_m, near_m) = (place.xy().norm(), self.touch_m + around_m);
        let under = [(from_pole_m - near_m).max(0.0), from_pole_m + near_m];
        let slope_rad = acos(self.plate.surface.patch(under).least_cosine());
        let (place, lean_rad) = (self.plate.world(place), self.lean_rad + slope_rad);
        let is_beyond = |bound: &PointBound| bound.is_beyond(&place, near_m, &self.axis, lean_rad);
        self.points.iter().any(is_beyond)
    }
}

/// Lower bound on the share of a plate's face, by area, that is swept and pressed by no wash path that the job allows, whatever the
/// configurations of the arm. The plate is in the base frame.
#[must_use]
pub fn share_beyond_reach(robot: &RobotModel, terms: &JobTerms, plate: &Plate) -> f64 {
    let (bound, surface) = (FaceBound::new(robot, terms, plate), &plate.surface);
    let apart_m = APART * surface.rim_m();
    let beyond = surface
        .points(apart_m)
        .filter(|(place, _)| bound.is_beyond(place, CELL * apart_m));
    let beyond_m2: f64 = beyond.map(|(_, area_m2)| area_m2).sum();
    // Adding 0 makes −0 into 0.
    beyond_m2 / surface.area_m2() + 0.0
}

/// Greatest distance from the tip, on the face, of a place that the sponge touches or passes over \[m\]. On a flat face the sponge's
/// cylinder ends in an ellipse about the tip; on others a place is anywhere in the cylinder.
fn touch_m(sponge: &Sponge, is_flat: bool, lean_rad: f64) -> f64 {
    let deep_m = sponge.height_m.max(sponge.compression_m);
    let anywhere_m = (sponge.radius_m * sponge.radius_m + deep_m * deep_m).sqrt();
    let cosine = cos(lean_rad);
    match is_flat && cosine > 0.0 {
        true => anywhere_m.min(sponge.radius_m / cosine),
        false => anywhere_m,
    }
}

/// Greatest share of a plate's face that a job requires to be swept or pressed.
#[must_use]
pub fn required_share(terms: &JobTerms, plate: &Plate) -> f64 {
    let contact = terms
        .contact_of(plate)
        .filter(|_| terms.judged_requirements().contact.is_some());
    let contact = contact.map(|wanted| {
        // A place that the sponge never touches has no time and no dose there: enough where none is asked for.
        let time_share = if wanted.time_s > 0.0 { wanted.time_share } else { 0.0 };
        let dose_share = if wanted.dose_pa_m > 0.0 { wanted.dose_share } else { 0.0 };
        wanted.share.max(time_share).max(dose_share)
    });
    terms.requirements.coverage.max(contact.unwrap_or(0.0))
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;
