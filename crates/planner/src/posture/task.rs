//! One plate to wash: whether a contact point can be washed at a tilt, and a whole stroke at a profile of tilts.

use super::cell::Cell;
use super::error::PostureError;
use super::inverse::Start;
use super::obstacle::Obstacle;
use super::policy::TiltPolicy;
use super::samples::Samples;
use super::settings::{PostureSettings, check_input};
use super::spline::TiltSpline;
use nalgebra::{Vector3, Vector6};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{Axes, JointVector};
use platewash_workcell::layout::Plate;
use platewash_workcell::stroke::Stroke;

/// The most that a joint may move per length of the stroke \[rad/m\]: 0.35 rad in 5 mm.
pub(super) const JOINT_RATE: f64 = 70.0;

/// What a joint may move in any step, however short \[rad\].
const LEAST_STEP_RAD: f64 = 1e-3;

/// With this much more than the clearance required \[m\] …
pub(super) const ROOM_M: f64 = 8e-3;

/// … contact points within this length need no look of their own \[m\].
const STRIDE_M: f64 = 4e-3;

/// Step of θ for differences \[rad\].
const DIFFERENCE_RAD: f64 = 1e-3;

/// A tilt in the arm's plane for each contact point.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Profile {
    /// By the distance from axis 1.
    Policy(TiltPolicy),
    /// By the length along the stroke.
    Spline(TiltSpline),
}

/// One plate to wash.
#[derive(Debug)]
pub(super) struct Task<'a> {
    pub cell: &'a Cell<'a>,
    pub samples: Samples,
    /// What every pair but the sponge and the plates must keep \[m\].
    pub required_m: f64,
}

/// Where a profile cannot be followed further.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stop {
    /// Index of the sample.
    pub sample: usize,
    /// Why.
    pub obstacle: Obstacle,
}

impl<'a> Task<'a> {
    /// The task, if the input makes sense.
    ///
    /// # Errors
    /// [`PostureError::Input`] and [`PostureError::Plate`].
    pub fn new(
        cell: &'a Cell<'a>,
        stroke: &Stroke,
        centre: Vector3<f64>,
        plate: usize,
        settings: &PostureSettings,
        near: &JointVector,
    ) -> Result<Self, PostureError> {
        settings.validate()?;
        check_input(stroke, &centre, near)?;
        let count = cell.plates.len();
        if plate >= count {
            return Err(PostureError::Plate { plate, count });
        }
        Ok(Self {
            cell,
            samples: Samples::new(stroke, centre),
            required_m: settings.required_m(),
        })
    }

    /// The configuration at a pose of the tip, continued from `start` and clear.
    ///
    /// # Errors
    /// The first filter that rejects it.
    pub fn posture(&self, target: &Rigid, start: &Start) -> Result<JointVector, Obstacle> {
        let q = self.cell.inverse.continuing(target, start)?;
        self.check_clear(&q)?;
        Ok(q)
    }

    /// Whether the bodies keep off each other at `q` \[rad\].
    pub fn check_clear(&self, q: &JointVector) -> Result<(), Obstacle> {
        let (clearance, required_m) = (self.cell.clearance, self.required_m);
        if clearance.keeps_washing(q, required_m) {
            return Ok(());
        }
        match clearance.nearest_washing(q, required_m) {
            Some(pair) => Err(Obstacle::Clearance { pair, required_m }),
            None => Ok(()),
        }
    }

    /// Whether the bodies keep [`ROOM_M`] more than they must.
    pub fn has_room(&self, q: &JointVector) -> bool {
        self.cell.clearance.keeps_washing(q, self.required_m + ROOM_M)
    }

    /// Tilt \[rad\] at a contact point at the length `s` \[m\] along the stroke.
    pub fn tilt(&self, profile: &Profile, contact: &Vector3<f64>, s: f64) -> f64 {
        match profile {
            Profile::Policy(policy) => policy.tilt(self.cell.seen(contact).r),
            Profile::Spline(spline) => spline.tilt(s),
        }
    }

    /// Tilts at all samples \[rad\].
    pub fn tilts(&self, profile: &Profile) -> Vec<f64> {
        let Samples { contact, length_m, .. } = &self.samples;
        contact
            .iter()
            .zip(length_m)
            .map(|(p, &s)| self.tilt(profile, p, s))
            .collect()
    }

    /// Configurations at all samples, continued from `start`.
    ///
    /// # Errors
    /// The first sample that cannot be washed so, and why.
    pub fn follow(&self, tilts: &[f64], start: &Start) -> Result<Vec<JointVector>, Stop> {
        let Samples { contact, length_m, .. } = &self.samples;
        let mut all: Vec<JointVector> = Vec::with_capacity(contact.len());
        let mut free_until = f64::NEG_INFINITY;
        let mut last = *start;
        for (sample, (point, &tilt)) in contact.iter().zip(tilts).enumerate() {
            let stop = |obstacle| Stop { sample, obstacle };
            let target = self.cell.tip_rigid(point, tilt);
            let q = self.cell.inverse.continuing(&target, &last).map_err(stop)?;
            if sample > 0 {
                let length = length_m[sample] - length_m[sample - 1];
                check_step(&last.q, &q, length).map_err(stop)?;
            }
            if length_m[sample] >= free_until || sample + 1 == contact.len() {
                if self.has_room(&q) {
                    free_until = length_m[sample] + STRIDE_M;
                } else {
                    self.check_clear(&q).map_err(stop)?;
                }
            }
            all.push(q);
            last.q = q;
        }
        Ok(all)
    }

    /// `dq/dθ` where the tip follows the profile: `J q′ = (p′, ω)`, ω by differences of the exact rotation; `None` at a
    /// singularity.
    pub fn slope(&self, profile: &Profile, sample: usize, q: &JointVector) -> Option<JointVector> {
        let (theta, length) = (self.samples.theta[sample], self.samples.length_m[sample]);
        let first = self.samples.first(theta);
        let rotation = |step: f64| {
            let contact = self.samples.at(theta + step);
            let tilt = self.tilt(profile, &contact, length + step * first.norm());
            self.cell.tip_rigid(&contact, tilt).rotation
        };
        let h = DIFFERENCE_RAD;
        let change = ((rotation(h) - rotation(-h)) * 8.0 - (rotation(2.0 * h) - rotation(-2.0 * h))) / (12.0 * h);
        let spin = change * rotation(0.0).transpose();
        let twist = Vector6::new(first.x, first.y, first.z, spin.m32, spin.m13, spin.m21);
        let jacobian = self.cell.robot.fk(q).jacobian(&self.cell.tip, Axes::Base);
        let slope = jacobian.lu().solve(&twist)?;
        let bounded = slope.amax() <= JOINT_RATE * first.norm().max(1e-3);
        bounded.then_some(slope)
    }
}

/// Whether two plates share a place.
pub(super) fn overlap(a: &Plate, b: &Plate) -> bool {
    let apart = Vector3::new(a.x_m - b.x_m, a.y_m - b.y_m, 0.0).norm();
    let above = |top: &Plate, bottom: &Plate| top.z_m - top.thickness_m > bottom.z_m;
    apart < a.radius_m + b.radius_m && !above(a, b) && !above(b, a)
}

/// Refuses a joint step that is no continuous motion along `length` \[m\] of the stroke.
pub(super) fn check_step(from: &JointVector, to: &JointVector, length: f64) -> Result<(), Obstacle> {
    let step = (to - from).abs();
    let joint = step.imax();
    if step[joint] <= JOINT_RATE * length + LEAST_STEP_RAD {
        return Ok(());
    }
    Err(Obstacle::Jump {
        joint,
        by_rad: step[joint],
    })
}
