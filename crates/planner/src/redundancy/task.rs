//! Task of washing one plate: checks a contact point at a tilt, and a whole wash path at a profile of tilts.

use crate::out_of_range::OutOfRange;
use crate::placed_arm::{Contact, Hindrance, PlacedArm, Start, Stretch, TiltPolicy, WRIST_RESERVE_RAD, angle_between};
use crate::redundancy::error::RedundancyError;
use crate::redundancy::samples::{Samples, TiltSpline};
use nalgebra::Vector6;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{Axes, JointVector};
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::{LEAST_RADIUS_M, LEAST_TURNS, LONGEST_M, MOST_TRIM_RAD, MOST_TURNS, WashPath};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Joint 5, by its index.
const WRIST: usize = 4;

/// The most that a joint may move per length of the wash path \[rad/m\]: 0.35 rad in 5 mm.
pub(crate) const JOINT_RATE: f64 = 70.0;

/// Joint motion allowed in any step, however short \[rad\].
const LEAST_STEP_RAD: f64 = 1e-3;

/// With this much more than the clearance required \[m\] …
pub(crate) const ROOM_M: f64 = 8e-3;

/// … contact points within this length need no look of their own \[m\].
const STRIDE_M: f64 = 4e-3;

/// Step of θ for differences \[rad\].
const DIFFERENCE_RAD: f64 = 1e-3;

/// A tilt in the arm's plane for each contact point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Profile {
    /// Tilt by the distance from axis 1.
    Policy(TiltPolicy),
    /// Tilt by the length along the wash path.
    Spline(TiltSpline),
}

/// One plate to wash.
#[derive(Debug, Clone)]
pub struct Task<'a> {
    pub(crate) placed: &'a PlacedArm<'a>,
    pub(crate) path: WashPath,
    pub(crate) plate: &'a Plate,
    pub(crate) samples: Samples,
    pub(crate) clearance_m: f64,
    /// Set once a line over an end of the path is refused because it is not clear. `None` where lines need not be clear: the caller that
    /// plans them reports those that are not.
    pub(crate) blocked_line: Option<Arc<AtomicBool>>,
    /// The configuration not far from which it starts \[rad\].
    pub(crate) near: JointVector,
}

/// End of a profile that cannot be followed further.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stop {
    /// Index of the sample.
    pub sample: usize,
    /// Reason that the profile ends here.
    pub hindrance: Hindrance,
}

impl<'a> Task<'a> {
    /// The task of washing along a path, from a configuration not far from `near` \[rad\]. Every pair but the sponge and the
    /// plates keeps `clearance_m`, in [0, 1], and [`Stretch::reserve_m`] more; the tool stays in the path's cone.
    ///
    /// # Errors
    /// [`RedundancyError::Input`] and [`RedundancyError::Plate`].
    pub fn new(
        placed: &'a PlacedArm<'a>,
        path: &WashPath,
        clearance_m: f64,
        near: &JointVector,
    ) -> Result<Self, RedundancyError> {
        let (index, count) = (path.plate, placed.plates.len());
        let missing = RedundancyError::Plate { plate: index, count };
        let plate = placed.plates.get(index).ok_or(missing)?;
        check_input(path, plate, clearance_m, near)?;
        Ok(Self {
            placed,
            path: *path,
            plate,
            samples: Samples::new(path, plate, placed.stance.axis_share),
            clearance_m,
            blocked_line: Some(Arc::default()),
            near: *near,
        })
    }

    /// The same task without the rule that the lines over the ends of the path must be clear.
    pub(crate) fn with_any_lines(&self) -> Self {
        Self {
            blocked_line: None,
            ..self.clone()
        }
    }

    /// Clearance required of every pair but the sponge and the plates, with the reserve \[m\].
    pub(crate) fn required_m(&self) -> f64 {
        self.clearance_m + self.stretch().reserve_m()
    }

    /// The stretch of its plate.
    pub(crate) fn stretch(&self) -> Stretch {
        Stretch::AtPlate(self.path.plate)
    }

    /// The task with another placed arm, its lines not checked yet.
    pub(crate) fn with_arm<'b>(&self, placed: &'b PlacedArm<'b>) -> Task<'b>
    where
        'a: 'b,
    {
        Task {
            placed,
            blocked_line: Some(Arc::default()),
            ..self.clone()
        }
    }

    /// The largest tilt allowed in the arm's plane \[rad\].
    pub(crate) fn tilt_max_rad(&self) -> f64 {
        self.placed.stance.tilt_rad(self.path.cone_rad)
    }

    /// The largest tilt in the arm's plane at the points that are solved \[rad\].
    pub(crate) fn planned_tilt_rad(&self) -> f64 {
        self.placed.stance.tilt_rad(self.planned_lean_rad())
    }

    /// Largest total lean of the tool at the points that are solved \[rad\]: the allowed lean less the reserve, or half the
    /// allowed lean where that is more.
    pub(crate) fn planned_lean_rad(&self) -> f64 {
        let most = self.path.cone_rad;
        (most - self.placed.stance.tilt_reserve_rad).max(0.5 * most)
    }

    /// The plate's centre, the pole of its face.
    pub(crate) fn centre(&self) -> Contact {
        let point = self.plate.centre();
        Contact::on_normal(point, self.plate.normal_at(&point))
    }

    /// A start from anywhere near.
    pub(crate) fn anywhere_near(&self) -> Start {
        let q = self.near;
        Start { q, sides: None }
    }

    /// The configuration at a pose of the tip, continued from `start` and clear.
    ///
    /// # Errors
    /// The first filter that rejects it.
    pub(crate) fn configuration(&self, target: &RigidTransform, start: &Start) -> Result<JointVector, Hindrance> {
        let q = self.placed.inverse.continuing(target, start)?;
        self.check_wrist(&q)?;
        self.check_clear(&q)?;
        Ok(q)
    }

    /// Checks that a configuration \[rad\] holds the wrist as required, and that all pairs of bodies keep their clearance.
    pub(crate) fn is_allowed(&self, q: &JointVector) -> bool {
        self.check_wrist(q).is_ok() && self.is_clear(q)
    }

    /// Checks that joint 5 is far enough from 0 and from whole turns.
    pub(crate) fn check_wrist(&self, q: &JointVector) -> Result<(), Hindrance> {
        let Some(least_rad) = self.placed.stance.wrist_rad else {
            return Ok(());
        };
        let whole = TAU * (q[WRIST] / TAU).round();
        let (found_rad, least_rad) = ((q[WRIST] - whole).abs(), least_rad + WRIST_RESERVE_RAD);
        if found_rad >= least_rad {
            return Ok(());
        }
        Err(Hindrance::Wrist { found_rad, least_rad })
    }

    /// Checks that the tool at a target stands within the planned cone about the normal.
    pub(crate) fn check_cone(&self, contact: &Contact, target: &RigidTransform) -> Result<(), Hindrance> {
        if contact.axis == contact.normal {
            // Tilts count from the normal, and are within the cone.
            return Ok(());
        }
        let axis = -target.rotation.column(2).into_owned();
        let (found_rad, most_rad) = (angle_between(&axis, &contact.normal), self.planned_lean_rad());
        if found_rad <= most_rad {
            return Ok(());
        }
        Err(Hindrance::Cone { found_rad, most_rad })
    }

    /// Checks that all pairs of bodies keep their clearance at `q` \[rad\].
    pub(crate) fn is_clear(&self, q: &JointVector) -> bool {
        let surroundings = self.placed.surroundings;
        surroundings.is_clear(q, self.stretch(), self.required_m())
    }

    /// Checks that a configuration \[rad\] keeps the clearance; the error names the pair that is too near.
    pub(crate) fn check_clear(&self, q: &JointVector) -> Result<(), Hindrance> {
        self.check_clear_in(q, self.stretch())
    }

    /// Checks that a configuration \[rad\] keeps the clearance of a stretch; the error names the pair that is too near.
    pub(crate) fn check_clear_in(&self, q: &JointVector, stretch: Stretch) -> Result<(), Hindrance> {
        let (surroundings, required_m) = (self.placed.surroundings, self.clearance_m + stretch.reserve_m());
        if surroundings.is_clear(q, stretch, required_m) {
            return Ok(());
        }
        match surroundings.too_near(q, stretch, required_m) {
            Some(pair) => {
                let required_m = pair.required_m(required_m);
                let pair = Box::new(pair);
                Err(Hindrance::Clearance { pair, required_m })
            }
            None => Ok(()),
        }
    }

    /// Checks that all pairs of bodies keep their clearance at `q` \[rad\], and returns true if they keep [`ROOM_M`] more; the error names
    /// the pair that is too near.
    pub(crate) fn check_room(&self, q: &JointVector) -> Result<bool, Hindrance> {
        let levels_m = [self.required_m(), self.required_m() + ROOM_M];
        let kept = self.placed.surroundings.levels_kept(q, self.stretch(), &levels_m);
        if kept == 0 {
            self.check_clear(q)?;
        }
        Ok(kept == levels_m.len())
    }

    /// Tilt \[rad\] at a contact point at the length `s` \[m\] along the wash path.
    pub(crate) fn tilt(&self, profile: &Profile, contact: &Contact, s: f64) -> f64 {
        match profile {
            Profile::Policy(policy) => policy.tilt(self.placed.distance(&contact.point)),
            Profile::Spline(spline) => spline.tilt(s),
        }
    }

    /// Tilts at all samples \[rad\].
    pub(crate) fn tilts(&self, profile: &Profile) -> Vec<f64> {
        let Samples { contact, length_m, .. } = &self.samples;
        contact
            .iter()
            .zip(length_m)
            .map(|(p, &s)| self.tilt(profile, p, s))
            .collect()
    }

    /// Configurations at all samples, continued from `start`; or the first sample that cannot be washed so, or the end whose line cannot be
    /// followed so, and why.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub(crate) fn follow(&self, tilts: &[f64], start: &Start) -> Result<Result<Vec<JointVector>, Stop>, Cancelled> {
        let Samples { contact, length_m, .. } = &self.samples;
        let mut all: Vec<JointVector> = Vec::with_capacity(contact.len());
        let mut free_until = f64::NEG_INFINITY;
        let mut last = *start;
        for (sample, (contact, &tilt)) in contact.iter().zip(tilts).enumerate() {
            self.placed.check_cancelled()?;
            let is_last = sample + 1 == length_m.len();
            let looked_at = length_m[sample] >= free_until || is_last;
            let along_m = sample.checked_sub(1).map(|before| length_m[sample] - length_m[before]);
            match self.next(contact, tilt, &last, along_m, looked_at) {
                Ok((q, has_room)) => {
                    if has_room {
                        free_until = length_m[sample] + STRIDE_M;
                    }
                    all.push(q);
                    last.q = q;
                }
                Err(hindrance) => return Ok(Err(Stop { sample, hindrance })),
            }
        }
        Ok(self.check_lines(tilts, &all, start).map(|()| all))
    }

    /// The configuration at a contact point so far along from `last` \[m\], and whether it was seen to have room.
    fn next(
        &self,
        contact: &Contact,
        tilt: f64,
        last: &Start,
        along_m: Option<f64>,
        looked_at: bool,
    ) -> Result<(JointVector, bool), Hindrance> {
        let target = self.placed.tip_rigid(contact, tilt);
        self.check_cone(contact, &target)?;
        let q = self.placed.inverse.continuing(&target, last)?;
        self.check_wrist(&q)?;
        if let Some(along_m) = along_m {
            check_step(&last.q, &q, along_m)?;
            self.check_side(&last.q, &q)?;
        }
        let has_room = looked_at && self.check_room(&q)?;
        Ok((q, has_room))
    }

    /// `dq/dθ` where the tip follows the profile: `J q′ = (p′, ω)`, ω by differences of the exact rotation; `None` at a
    /// singularity.
    pub(crate) fn slope(&self, profile: &Profile, sample: usize, q: &JointVector) -> Option<JointVector> {
        let (theta, length) = (self.samples.theta[sample], self.samples.length_m[sample]);
        let first = self.samples.first(theta);
        let rotation = |step: f64| {
            let contact = self.samples.at(theta + step);
            let tilt = self.tilt(profile, &contact, length + step * first.norm());
            self.placed.tip_rigid(&contact, tilt).rotation
        };
        let h = DIFFERENCE_RAD;
        let change = ((rotation(h) - rotation(-h)) * 8.0 - (rotation(2.0 * h) - rotation(-2.0 * h))) / (12.0 * h);
        let spin = change * rotation(0.0).transpose();
        let twist = Vector6::new(first.x, first.y, first.z, spin.m32, spin.m13, spin.m21);
        let jacobian = self.placed.robot.fk(q).jacobian(&self.placed.tip, Axes::Base);
        let slope = jacobian.lu().solve(&twist)?;
        let bounded = slope.amax() <= JOINT_RATE * first.norm().max(1e-3);
        bounded.then_some(slope)
    }
}

impl Task<'_> {
    /// Refuses a step over which the wrist flips.
    pub(crate) fn check_side(&self, from: &JointVector, to: &JointVector) -> Result<(), Hindrance> {
        let turn = |q: &JointVector| (q[WRIST] / TAU).floor();
        match self.placed.stance.wrist_rad {
            Some(least_rad) if turn(from) != turn(to) => Err(Hindrance::Wrist {
                found_rad: 0.0,
                least_rad,
            }),
            _ => Ok(()),
        }
    }
}

/// Refuses a joint step that is no continuous motion along `length` \[m\] of the wash path.
pub(crate) fn check_step(from: &JointVector, to: &JointVector, length: f64) -> Result<(), Hindrance> {
    let step = (to - from).abs();
    let joint = step.imax();
    if step[joint] <= JOINT_RATE * length + LEAST_STEP_RAD {
        return Ok(());
    }
    Err(Hindrance::Jump {
        joint,
        by_rad: step[joint],
    })
}

/// The largest tilt that can be asked for \[rad\]: short of lying flat.
pub const LARGEST_TILT_RAD: f64 = 0.9 * FRAC_PI_2;

/// Lengths beyond this are no plates \[m\].
const LARGEST_M: f64 = 10.0;

/// Refuses a wash path, a plate, a clearance or a configuration that is none.
pub(crate) fn check_input(
    path: &WashPath,
    plate: &Plate,
    clearance_m: f64,
    near: &JointVector,
) -> Result<(), RedundancyError> {
    let curve = &path.curve;
    let within = OutOfRange::check;
    within("cone_rad", path.cone_rad, [0.0, LARGEST_TILT_RAD])?;
    within("clearance_m", clearance_m, [0.0, 1.0])?;
    within("curve.radius_m", curve.radius_m, [LEAST_RADIUS_M, LARGEST_M])?;
    within("curve.turns", curve.turns, [LEAST_TURNS, MOST_TURNS])?;
    within("curve.start_angle_rad", curve.start_angle_rad, [-1e3, 1e3])?;
    within("curve.trim_rad", curve.trim_rad, [0.0, MOST_TRIM_RAD])?;
    within("length of the curve", curve.length_m(), [0.0, LONGEST_M])?;
    for (name, found, range) in curve.pattern_numbers() {
        within(name, found, range)?;
    }
    for &coordinate in &plate.centre() {
        within("centre", coordinate, [-LARGEST_M, LARGEST_M])?;
    }
    for &joint in near {
        within("near", joint, [-1e3, 1e3])?;
    }
    Ok(())
}
