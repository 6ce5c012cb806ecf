//! Recognising the structure: the geometry of the folded chain at q = 0, in the base frame.

use crate::ik::analytic::{AnalyticArm, GEOMETRY_TOLERANCE_M, GEOMETRY_TOLERANCE_RAD, SHORTEST_LINK_M};
use crate::model::Frame;
use crate::rotation::RigidTransform;
use crate::trig::{atan2, sin_cos};
use crate::{AXES, RobotModel};
use nalgebra::{Complex, Matrix3, Vector3};

/// Property of the structure that an arm does not have, with the deviation.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StructureMismatch {
    /// Two axes that must be parallel are not.
    #[error("axes {} and {} are not parallel, by {by_rad:.3e} rad", .joints[0] + 1, .joints[1] + 1)]
    NotParallel {
        /// Joint indices, 0 for joint 1.
        joints: [usize; 2],
        /// Angle between the two lines \[rad\].
        by_rad: f64,
    },
    /// Two axes that must be perpendicular are not.
    #[error("axes {} and {} are not perpendicular, by {by_rad:.3e} rad", .joints[0] + 1, .joints[1] + 1)]
    NotPerpendicular {
        /// Joint indices, 0 for joint 1.
        joints: [usize; 2],
        /// Deviation from 90° \[rad\].
        by_rad: f64,
    },
    /// Axes 4, 5 and 6 do not meet in one point.
    #[error(
        "the wrist is not spherical: axes 4, 5 and 6 do not meet in one point, as axes {} and {} miss each other by {:.4} mm",
        .joints[0] + 1, .joints[1] + 1, 1e3 * .by_m
    )]
    WristNotSpherical {
        /// Joint indices, 0 for joint 1.
        joints: [usize; 2],
        /// Distance between the two lines (4, 5), or of axis 6 from the wrist centre (5, 6) \[m\].
        by_m: f64,
    },
    /// Axes 2 and 3 coincide.
    #[error("the upper arm, axis 2 to axis 3, is only {length_m:.3e} m long")]
    NoUpperArm {
        /// Distance between the axes \[m\].
        length_m: f64,
    },
    /// The wrist centre lies on axis 3.
    #[error("the forearm, axis 3 to the wrist centre, is only {length_m:.3e} m long")]
    NoForearm {
        /// Distance of the wrist centre from the axis \[m\].
        length_m: f64,
    },
}

/// Greatest deviation of an angle that the rounding of a description explains \[rad\]: printed values of five decimals, such as 1.5708 for
/// π/2, deviate by 4e-6.
const ROUNDED_RAD: f64 = 1e-5;
/// Greatest deviation of a length that the rounding of a description explains \[m\]: half a unit of the sixth decimal, twice.
const ROUNDED_M: f64 = 1e-6;

impl StructureMismatch {
    /// True where the rounding of the description's numbers explains the deviation.
    fn is_rounding(&self) -> bool {
        match self {
            Self::NotParallel { by_rad, .. } | Self::NotPerpendicular { by_rad, .. } => *by_rad <= ROUNDED_RAD,
            Self::WristNotSpherical { by_m, .. } => *by_m <= ROUNDED_M,
            Self::NoUpperArm { .. } | Self::NoForearm { .. } => false,
        }
    }
}

/// Joint axis as a line in the base frame.
#[derive(Clone, Copy)]
struct Line {
    point: Vector3<f64>,
    direction: Vector3<f64>,
}

impl AnalyticArm {
    /// Recognises the arm from the folded chain of the model.
    ///
    /// # Errors
    /// [`StructureMismatch`]: the first property of the [module](super)'s list that fails by more than the rounding of the description's
    /// numbers.
    pub fn recognise(robot: &RobotModel) -> Result<Self, StructureMismatch> {
        let folded = *robot.folded();
        let bodies = at_zero(&folded);
        let axes = bodies.map(|body| Line {
            point: body.translation,
            direction: body.rotation.column(2).into(),
        });
        let (centre, misses) = wrist_centre(&axes);
        let angles = [
            parallel(&axes, [1, 2]),
            perpendicular(&axes, [0, 1]),
            perpendicular(&axes, [3, 4]),
            perpendicular(&axes, [4, 5]),
        ];
        let failed: Vec<_> = angles.into_iter().chain(misses).filter_map(Result::err).collect();
        if let Some(reason) = failed.iter().find(|reason| !reason.is_rounding()) {
            return Err(*reason);
        }
        let rounding = failed.first().copied();
        let zero_m = rounding.map_or(GEOMETRY_TOLERANCE_M, |_| ROUNDED_M);
        let shoulder = shoulder_frame(&axes, &centre);
        let shoulder_from_base = shoulder.inverse();
        let seen = |point: &Vector3<f64>| shoulder_from_base.rotation * point + shoulder_from_base.translation;
        let [second, third, wrist] = [axes[1].point, axes[2].point, centre].map(|p| seen(&p));
        let plane = |v: Vector3<f64>| Complex::new(v.z, v.x);
        let (upper, fore) = (plane(third - second), plane(wrist - third));
        let [length_m, fore_m] = [upper, fore].map(|link| link.norm_sqr().sqrt());
        if length_m < SHORTEST_LINK_M {
            return Err(StructureMismatch::NoUpperArm { length_m });
        }
        if fore_m < SHORTEST_LINK_M {
            return Err(StructureMismatch::NoForearm { length_m: fore_m });
        }
        let turn = (fore / fore_m) * (upper / length_m).conj();
        let y = shoulder.rotation.column(1);
        let wrist_zero = WristZero::of(&folded);
        Ok(Self {
            folded,
            shoulder_from_base,
            wrist_along_axis_6: axes[5].direction.dot(&(centre - axes[5].point)),
            shoulder_offset: second.x,
            lateral_offset: if wrist.y.abs() <= zero_m { 0.0 } else { wrist.y },
            lengths: [length_m, fore_m],
            signs: [1, 2].map(|i: usize| 1.0_f64.copysign(axes[i].direction.dot(&y))),
            upper_at_zero: upper / length_m,
            bend_at_zero: atan2(turn.im, turn.re),
            turn_at_zero: turn,
            wrist_from_shoulder: (shoulder_from_base.rotation * bodies[3].rotation * about_z(wrist_zero.first))
                .transpose(),
            wrist_at_zero: wrist_zero.others,
            rounding,
        })
    }

    /// First property that holds only up to the rounding of the description's numbers; `None` if all hold to the tolerances.
    #[must_use]
    pub fn rounding(&self) -> Option<StructureMismatch> {
        self.rounding
    }

    /// Returns the target of body 6, `T_base_body6`, for a target of `frame` on it, `T_base_frame`.
    ///
    /// `None` unless body 6, the one behind joint 6, carries the frame.
    #[must_use]
    pub fn body_target(frame: &Frame, target: &RigidTransform) -> Option<RigidTransform> {
        (frame.body() == AXES).then(|| target.then(&frame.offset.inverse()))
    }
}

/// `T_base_i` at q = 0.
fn at_zero(folded: &[RigidTransform; AXES]) -> [RigidTransform; AXES] {
    let mut body = RigidTransform::identity();
    folded.map(|next| {
        body = body.then(&next);
        body
    })
}

fn parallel(axes: &[Line; AXES], joints: [usize; 2]) -> Result<(), StructureMismatch> {
    let [a, b] = joints.map(|i| axes[i].direction);
    let by_rad = atan2(a.cross(&b).norm(), a.dot(&b).abs());
    if by_rad <= GEOMETRY_TOLERANCE_RAD {
        return Ok(());
    }
    Err(StructureMismatch::NotParallel { joints, by_rad })
}

fn perpendicular(axes: &[Line; AXES], joints: [usize; 2]) -> Result<(), StructureMismatch> {
    let [a, b] = joints.map(|i| axes[i].direction);
    let by_rad = atan2(a.dot(&b).abs(), a.cross(&b).norm());
    if by_rad <= GEOMETRY_TOLERANCE_RAD {
        return Ok(());
    }
    Err(StructureMismatch::NotPerpendicular { joints, by_rad })
}

/// Returns the foot of axis 5 on axis 4, and by how much axes 4 and 5, and axis 6, miss it. Axes 4 and 5 are perpendicular, or the result
/// is not used unless they are nearly so.
fn wrist_centre(axes: &[Line; AXES]) -> (Vector3<f64>, [Result<(), StructureMismatch>; 2]) {
    let [fourth, fifth, sixth] = [axes[3], axes[4], axes[5]];
    let between = fifth.point - fourth.point;
    let gap = fourth.direction.cross(&fifth.direction).dot(&between);
    let centre = fourth.point + fourth.direction * fourth.direction.dot(&between);
    let miss = sixth.direction.cross(&(centre - sixth.point)).norm();
    let misses = [([3, 4], gap.abs()), ([4, 5], miss)].map(|(joints, by_m)| match by_m <= GEOMETRY_TOLERANCE_M {
        true => Ok(()),
        false => Err(StructureMismatch::WristNotSpherical { joints, by_m }),
    });
    (centre, misses)
}

/// `T_base_S` at q₁ = 0: on axis 1 at the height of axis 2, z along axis 1, y along ± axis 2, x to the front.
///
/// The front is the side of axis 1 on which axis 2 lies. If they meet, it is the side on which the wrist centre lies at q = 0; if that lies
/// on neither side, y points along axis 2.
fn shoulder_frame(axes: &[Line; AXES], wrist: &Vector3<f64>) -> RigidTransform {
    let z = axes[0].direction;
    let origin = axes[0].point + z * z.dot(&(axes[1].point - axes[0].point));
    let across = axes[1].direction;
    let x = across.cross(&z).normalize();
    let front = [axes[1].point, *wrist]
        .map(|point| x.dot(&(point - origin)))
        .into_iter()
        .find(|along| along.abs() > GEOMETRY_TOLERANCE_M)
        .unwrap_or(1.0);
    let x = x * 1.0_f64.copysign(front);
    RigidTransform {
        rotation: Matrix3::from_columns(&[x, z.cross(&x), z]),
        translation: origin,
    }
}

/// Angles that bring the folded wrist to z–y–z form:
/// `Rot_z(q₄) F₅ Rot_z(q₅) F₆ Rot_z(q₆) = Rot_z(α₄)` `Rot_z(q₄) Rot_y(q₅ + α₅) Rot_z(q₆ + α₆)`.
struct WristZero {
    first: f64,
    others: [f64; 2],
}

impl WristZero {
    fn of(folded: &[RigidTransform; AXES]) -> Self {
        // Axis 5 in body 4 is y of the z–y–z form's first frame; axis 6 at q₅ = 0 gives α₅; α₆ is the rest.
        let [fifth, sixth] = [folded[4].rotation, folded[5].rotation];
        let first = atan2(-fifth.m13, fifth.m23);
        let rest = about_z(-first) * fifth * sixth;
        let second = atan2(rest.m13, rest.m33);
        let third = atan2(rest.m21, rest.m22);
        Self {
            first,
            others: [second, third],
        }
    }
}

fn about_z(angle: f64) -> Matrix3<f64> {
    let (s, c) = sin_cos(angle);
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}
