//! A placed arm: the arm with its tool among the bodies that it must keep clear of, and the pose of the tool at a contact point.

mod hindrance;
pub(crate) mod inverse;
pub(crate) mod stance;
pub(crate) mod tilt_policy;

pub use crate::placed_arm::hindrance::{Filter, Hindrance};
pub(crate) use crate::placed_arm::inverse::{Inverse, Start, Width, merge_starts};
pub(crate) use crate::placed_arm::stance::angle_between;
pub use crate::placed_arm::stance::{AXIS_SHARE, AxisRule, Contact, Stance, TILT_RESERVE_RAD, WRIST_RESERVE_RAD};
pub use crate::placed_arm::tilt_policy::TiltPolicy;

use nalgebra::{Matrix3, Point3, Vector3};
use platewash_bodies::clearance::{ClearanceModel, PairClearance};
use platewash_kinematics::ik::{IkSettingsError, IkSolver};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::{Frame, JointVector, Pose, RobotModel};
use platewash_workcell::cancel::{CancelToken, Cancelled};
use platewash_workcell::job::ReachBorders;
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::Tool;
use std::fmt::Debug;
use std::sync::Arc;

/// A distance from axis 1 along a face below which it has no direction \[m\].
const ON_AXIS_M: f64 = 1e-9;

/// Sine of the angle to axis 1 up to which a face lies level with the base.
const LEVEL: f64 = 1e-9;

/// The sine of the angle from which on a tool leans from axis 6.
const LEAST_LEAN: f64 = 0.02;

/// The arm in its place: with its tool, among the bodies that it must keep clear of.
#[derive(Debug, Clone)]
pub struct PlacedArm<'a> {
    /// The arm.
    pub robot: &'a RobotModel,
    /// The tip: the centre of the sponge's far face, z leaving the tool.
    pub tip: Frame,
    /// The bodies around, the plates among them.
    pub surroundings: &'a dyn Surroundings,
    /// The plates, as in `surroundings`.
    pub plates: &'a [Plate],
    /// Borders between which the upright tool leans, by distance.
    pub reach: ReachBorders,
    /// Rules for the tool on faces, and for the wrist.
    pub stance: Stance,
    /// `T_world_base`, for places in reports; all else is in the frame of the base.
    pub mount: Pose,
    pub(crate) solver: Arc<IkSolver<'a>>,
    pub(crate) inverse: Arc<Inverse<'a>>,
    /// A point of axis 1 and its direction, base frame.
    axis_1: [Vector3<f64>; 2],
    /// The direction of the tip frame that lies across the arm's plane while joints 4 and 6 rest: unit, z = 0.
    across: Vector3<f64>,
    cancel: Option<&'a CancelToken>,
}

impl<'a> PlacedArm<'a> {
    /// A placed arm. `tool` and `plates` are those that `surroundings` was made with.
    ///
    /// # Errors
    /// [`IkSettingsError`], for a solver that refuses its settings.
    pub fn new(
        robot: &'a RobotModel,
        tool: &Tool,
        surroundings: &'a dyn Surroundings,
        plates: &'a [Plate],
        reach: ReachBorders,
    ) -> Result<Self, IkSettingsError> {
        let tip = tool.tip_frame(robot);
        let axes = robot.fk(&JointVector::zeros()).joint_axes();
        let mut placed = Self {
            robot,
            tip,
            surroundings,
            plates,
            reach,
            stance: Stance::default(),
            mount: Pose::identity(),
            solver: Arc::new(IkSolver::new(robot, tip, inverse::exact())?),
            inverse: Arc::new(Inverse::new(robot, tip)?),
            axis_1: [robot.reach_bound(&tip).0.coords, axes[0]],
            across: Vector3::y(),
            cancel: None,
        };
        placed.across = placed.across_at_rest([&axes[4], &axes[5]]);
        Ok(placed)
    }

    /// The same placed arm, in which all searches end as soon as `cancel` is set.
    #[must_use]
    pub fn with_cancel(self, cancel: &'a CancelToken) -> Self {
        let cancel = Some(cancel);
        Self { cancel, ..self }
    }

    /// The same placed arm with another stance.
    #[must_use]
    pub fn with_stance(self, stance: Stance) -> Self {
        Self { stance, ..self }
    }

    /// The same placed arm with the tool leaning so far across the arm's plane ([`Stance::aside_rad`]).
    #[must_use]
    pub fn leaning_aside(mut self, aside_rad: f64) -> Self {
        self.stance.aside_rad = aside_rad;
        self
    }

    /// The same arm, mounted at `T_world_base`.
    #[must_use]
    pub fn mounted(self, mount: Pose) -> Self {
        Self { mount, ..self }
    }

    /// A point of the base frame in the world \[m\].
    #[must_use]
    pub fn in_world(&self, point: &Vector3<f64>) -> Vector3<f64> {
        if self.mount == Pose::identity() {
            return *point;
        }
        self.mount.transform_point(&Point3::from(*point)).coords
    }

    /// The pole of a plate seen from above in the world \[m\].
    #[must_use]
    pub fn centre_in_world(&self, plate: &Plate) -> [f64; 2] {
        self.in_world(&plate.centre()).xy().into()
    }

    /// A plate with its pole over another place of the world's floor, as high as before \[m\].
    #[must_use]
    pub fn moved(&self, plate: &Plate, centre_m: [f64; 2]) -> Plate {
        if self.mount == Pose::identity() {
            return plate.moved_to(centre_m);
        }
        let in_world = plate.seen_from(&self.mount).moved_to(centre_m);
        in_world.seen_from(&self.mount.inverse())
    }

    /// The same placed arm with the tool half a turn about its axis.
    #[cfg(test)]
    pub(crate) fn half_turned(self) -> Self {
        let across = -self.across;
        Self { across, ..self }
    }

    /// The same arm among other plates.
    #[must_use]
    pub fn among<'b>(&self, surroundings: &'b dyn Surroundings, plates: &'b [Plate]) -> PlacedArm<'b>
    where
        'a: 'b,
    {
        PlacedArm {
            surroundings,
            plates,
            ..self.clone()
        }
    }

    /// Returns an error once the work is to be given up.
    pub(crate) fn check_cancelled(&self) -> Result<(), Cancelled> {
        self.cancel.map_or(Ok(()), CancelToken::check)
    }

    /// Pose of the tip frame that washes at `contact` with the tool tilted by `tilt_rad` in the arm's plane. That plane goes
    /// through axis 1, the contact point and its axis n; z of the tip is `−(cos τ n + sin τ ρ̂)`, so that τ > 0 leans the flange
    /// away from axis 1. A stance that leans aside adds to that. On a level face the yaw is the one at which joints 4 and 6 rest,
    /// on arms whose wrist allows it.
    ///
    /// On axis 1 itself ρ̂ is x of the base frame, along the face.
    #[must_use]
    pub fn tip_pose(&self, contact: &Contact, tilt_rad: f64) -> Pose {
        Pose::from(&self.tip_rigid(contact, tilt_rad))
    }

    /// [`PlacedArm::tip_pose`] with the tilt of a policy.
    #[must_use]
    pub fn pose(&self, contact: &Contact, policy: &TiltPolicy) -> Pose {
        self.tip_pose(contact, policy.tilt(self.distance(&contact.point)))
    }

    /// The configuration for [`PlacedArm::pose`] that is found from `near` \[rad\].
    #[must_use]
    pub fn configuration(&self, contact: &Contact, policy: &TiltPolicy, near: &JointVector) -> Option<JointVector> {
        let answer = self.solver.solve(&self.pose(contact, policy), near);
        answer.ok().map(|answer| answer.q)
    }

    pub(crate) fn tip_rigid(&self, contact: &Contact, tilt_rad: f64) -> RigidTransform {
        let out = self.outward_direction(contact);
        let aside_rad = self.stance.aside_rad;
        if aside_rad == 0.0 {
            return leaning(&self.across, contact, [&out, &out], tilt_rad);
        }
        self.tip_leaning(contact, &(out * tilt_rad + contact.axis.cross(&out) * aside_rad))
    }

    /// The tip with the flange leaning towards `lean`, along the face, by its length \[rad\].
    pub(crate) fn tip_leaning(&self, contact: &Contact, lean: &Vector3<f64>) -> RigidTransform {
        let out = self.outward_direction(contact);
        let tilt_rad = lean.norm();
        let towards = if tilt_rad > 0.0 { lean / tilt_rad } else { out };
        leaning(&self.across, contact, [&out, &towards], tilt_rad)
    }

    /// Distance of a point \[m\] from axis 1 \[m\].
    #[must_use]
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.offset_from_axis_1(point).norm()
    }

    /// ρ̂ of a contact point: the direction across its axis n away from axis 1, where n is along that.
    ///
    /// With n in any other direction, that direction vanishes on faces that look towards axis 1, and the direction across n and the
    /// arm's plane vanishes on faces that look along the way round. The length of each is the sine of the angle between n and the
    /// direction that it is cut from. The result is along their sum, which changes steadily over a face: both agree where n is in
    /// the arm's plane.
    pub(crate) fn outward_direction(&self, contact: &Contact) -> Vector3<f64> {
        let (n, [_, a]) = (contact.axis, self.axis_1);
        let across = |v: Vector3<f64>| v - n * n.dot(&v);
        let along = |v: Vector3<f64>| across(v).try_normalize(ON_AXIS_M);
        let away = self.offset_from_axis_1(&contact.point);
        if n.cross(&a).norm() <= LEVEL {
            return along(away).or_else(|| along(Vector3::x())).unwrap_or_else(Vector3::y);
        }
        let upwards = 1.0_f64.copysign(n.dot(&a) + LEVEL);
        let out = away.try_normalize(ON_AXIS_M).and_then(|away| {
            let inwards = a.cross(&away).cross(&n) * upwards;
            (across(away) + inwards).try_normalize(LEVEL)
        });
        out.or_else(|| along(a)).unwrap_or_else(Vector3::y)
    }

    /// The vector from axis 1 to a point \[m\].
    fn offset_from_axis_1(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let [origin, direction] = self.axis_1;
        let away = point - origin;
        away - direction * direction.dot(&away)
    }

    /// Direction across the tool in the tip frame that is held across the arm's plane. For a tool along axis 6 it is axis 5 at q
    /// = 0, in the sense that it has against ẑ × ρ̂ there. For a tool that leans from axis 6 it is across both, so that both lie
    /// in the arm's plane and the flange points back towards axis 1. The wrist is bent by the same angle more there: the other
    /// way round it would be near its singularity.
    fn across_at_rest(&self, [axis_5, axis_6]: [&Vector3<f64>; 2]) -> Vector3<f64> {
        let tip = self.robot.fk(&JointVector::zeros()).rigid(&self.tip);
        let leans = Vector3::z().cross(&tip.rotation.tr_mul(axis_6));
        if let Some(across) = leans.try_normalize(LEAST_LEAN) {
            return across;
        }
        let inside = tip.rotation.tr_mul(axis_5);
        let across = Vector3::new(inside.x, inside.y, 0.0);
        let Some(across) = across.try_normalize(1e-6) else {
            return Vector3::y();
        };
        let here = Contact::level(tip.translation);
        let side = here.normal.cross(&self.outward_direction(&here));
        across * 1.0_f64.copysign(side.dot(axis_5))
    }
}

/// The straight tool whose `across` points along `n × out`, turned about `n × lean` by the tilt.
fn leaning(rest: &Vector3<f64>, contact: &Contact, [out, lean]: [&Vector3<f64>; 2], tilt_rad: f64) -> RigidTransform {
    let n = contact.axis;
    let (s, c) = sin_cos(tilt_rad);
    let side = n.cross(out);
    let hinge = n.cross(lean);
    let z = -(n * c + lean * s);
    let leant = lean * c - n * s;
    let across = leant * side.dot(lean) + hinge * side.dot(&hinge);
    let [here, there] =
        [(across, z), (*rest, Vector3::z())].map(|(across, z)| Matrix3::from_columns(&[across, z, across.cross(&z)]));
    RigidTransform {
        rotation: here * there.transpose(),
        translation: contact.point,
    }
}

/// Stretch of a motion that a configuration belongs to: decides which bodies may be near each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stretch {
    /// It washes a plate or is on the line over one, by its index: the sponge may be near that one, and near those whose rims it may
    /// touch meanwhile.
    AtPlate(usize),
    /// Anything else.
    Free,
}

impl Stretch {
    /// Reserve that planning keeps beyond the clearance asked for \[m\], as it checks a motion in steps. The steps are short at a
    /// plate.
    #[must_use]
    pub fn reserve_m(self) -> f64 {
        match self {
            Self::AtPlate(_) => 5e-4,
            Self::Free => 1e-3,
        }
    }
}

/// Bodies that the arm must keep clear of.
pub trait Surroundings: Debug + Sync {
    /// Number of clearances \[m\], from the first of an ascending list, that every pair that counts keeps at `q` \[rad\].
    fn levels_kept(&self, q: &JointVector, stretch: Stretch, required_m: &[f64]) -> usize;

    /// Checks that every pair that counts keeps `required_m` at `q` \[rad\].
    fn is_clear(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> bool {
        self.levels_kept(q, stretch, &[required_m]) == 1
    }

    /// The nearest of the pairs that do not; `None` where there is none.
    fn too_near(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> Option<PairClearance>;

    /// Returns true where the body of that name stands around the arm: it is not of the arm, its tool or the plates.
    fn is_obstacle(&self, _name: &str) -> bool {
        false
    }
}

impl Surroundings for ClearanceModel {
    fn levels_kept(&self, q: &JointVector, stretch: Stretch, required_m: &[f64]) -> usize {
        let working_on = match stretch {
            Stretch::AtPlate(plate) => Some(plate),
            Stretch::Free => None,
        };
        ClearanceModel::levels_kept(self, q, working_on, required_m)
    }

    fn too_near(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> Option<PairClearance> {
        match stretch {
            Stretch::AtPlate(plate) => self.nearest_washing(q, plate, required_m),
            Stretch::Free => ClearanceModel::too_near(self, q, &[], required_m).into_iter().next(),
        }
    }

    fn is_obstacle(&self, name: &str) -> bool {
        ClearanceModel::is_obstacle(self, name)
    }
}
