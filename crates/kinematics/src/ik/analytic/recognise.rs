//! Recognising the structure: the geometry of the folded chain at q = 0, in the base frame.

use crate::ik::analytic::chain::Chain;
use crate::ik::analytic::links::Links;
use crate::ik::analytic::parallel::ParallelAxesArm;
use crate::ik::analytic::spherical::SphericalWristArm;
use crate::ik::analytic::wrist::Turns;
use crate::ik::analytic::{AnalyticArm, ClosedForm, GEOMETRY_TOLERANCE_M, GEOMETRY_TOLERANCE_RAD, SHORTEST_LINK_M};
use crate::model::Frame;
use crate::rotation::RigidTransform;
use crate::trig::{atan2, sin_cos};
use crate::{AXES, RobotModel};
use nalgebra::{Complex, Matrix3, Vector3};
use std::sync::Arc;

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
    /// Axes 5 and 6 do not meet, on an arm with parallel axes 2, 3 and 4.
    #[error("axes 5 and 6 do not meet: they miss each other by {:.4} mm", 1e3 * .by_m)]
    AxesDoNotMeet {
        /// Distance between the two lines \[m\].
        by_m: f64,
    },
    /// The point where axes 5 and 6 meet has no offset along axis 2 from axis 1, on an arm with parallel axes 2, 3 and 4.
    #[error("axes 2, 3 and 4 are parallel, and the point where axes 5 and 6 meet has no offset along them from axis 1")]
    NoLateralOffset,
    /// Axes 2 and 3 coincide.
    #[error("the upper arm, axis 2 to axis 3, is only {length_m:.3e} m long")]
    NoUpperArm {
        /// Distance between the axes \[m\].
        length_m: f64,
    },
    /// The wrist centre lies on axis 3, or axes 3 and 4 coincide where axes 2, 3 and 4 are parallel.
    #[error("the forearm, axis 3 to the wrist centre or axis 4, is only {length_m:.3e} m long")]
    NoForearm {
        /// Length of the forearm \[m\].
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
            Self::WristNotSpherical { by_m, .. } | Self::AxesDoNotMeet { by_m } => *by_m <= ROUNDED_M,
            Self::NoLateralOffset | Self::NoUpperArm { .. } | Self::NoForearm { .. } => false,
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
    /// [`StructureMismatch`]: the first property of the [module](super)'s lists that fails by more than the rounding of the description's
    /// numbers. Where axes 2, 3 and 4 are parallel it is from the second list, else from the first.
    pub fn recognise(robot: &RobotModel) -> Result<Self, StructureMismatch> {
        let geometry = Geometry::of(robot);
        let form = match geometry.spherical() {
            Ok(arm) => Arc::new(arm) as Arc<dyn ClosedForm>,
            Err(_) if nearly(parallel(&geometry.axes, [2, 3])) => Arc::new(geometry.parallel()?),
            Err(mismatch) => return Err(mismatch),
        };
        Ok(Self { form })
    }

    /// First property that holds only up to the rounding of the description's numbers; `None` if all hold to the tolerances.
    #[must_use]
    pub fn rounding(&self) -> Option<StructureMismatch> {
        self.form.chain().rounding
    }

    /// Words for the structure that makes a closed form possible: "spherical wrist, axes 2 and 3 parallel".
    #[must_use]
    pub fn structure(&self) -> &'static str {
        self.form.structure()
    }

    /// True if the arm works equally well with the wrist centre on either side of axis 1: with parallel axes 2, 3 and 4 a half turn of joint 1
    /// mirrors it. With a spherical wrist the back is over the shoulder.
    #[must_use]
    pub fn shoulder_sides_are_alike(&self) -> bool {
        self.form.shoulder_sides_are_alike()
    }

    /// Returns the target of body 6, `T_base_body6`, for a target of `frame` on it, `T_base_frame`.
    ///
    /// `None` unless body 6, the one behind joint 6, carries the frame.
    #[must_use]
    pub fn body_target(frame: &Frame, target: &RigidTransform) -> Option<RigidTransform> {
        (frame.body() == AXES).then(|| target.then(&frame.offset.inverse()))
    }
}

/// The folded chain at q = 0.
pub(crate) struct Geometry {
    folded: [RigidTransform; AXES],
    bodies: [RigidTransform; AXES],
    axes: [Line; AXES],
}

impl Geometry {
    pub fn of(robot: &RobotModel) -> Self {
        let folded = *robot.folded();
        let bodies = at_zero(&folded);
        let axes = bodies.map(|body| Line {
            point: body.translation,
            direction: body.rotation.column(2).into(),
        });
        Self { folded, bodies, axes }
    }

    pub fn spherical(&self) -> Result<SphericalWristArm, StructureMismatch> {
        let (centre, misses) = wrist_centre(&self.axes);
        let chain = self.chain(self.angles().into_iter().chain(misses))?;
        let (links, _) = self.links(&centre, None, chain.rounding)?;
        let turns = self.turns(&links);
        Ok(SphericalWristArm { chain, links, turns })
    }

    pub fn parallel(&self) -> Result<ParallelAxesArm, StructureMismatch> {
        let (centre, meet) = meeting_point(&self.axes);
        let angles = self.angles().into_iter().chain([parallel(&self.axes, [2, 3])]);
        let chain = self.chain(angles.chain([meet]))?;
        let (links, hand) = self.links(&centre, Some(&self.axes[3].point), chain.rounding)?;
        if links.lateral_offset == 0.0 {
            return Err(StructureMismatch::NoLateralOffset);
        }
        let y = links.shoulder_from_base.rotation.row(1).transpose();
        Ok(ParallelAxesArm {
            chain,
            turns: self.turns(&links),
            hand,
            sign_4: 1.0_f64.copysign(self.axes[3].direction.dot(&y)),
            links,
        })
    }

    /// Returns the angles between axes that both structures ask for.
    fn angles(&self) -> [Result<(), StructureMismatch>; 4] {
        [
            parallel(&self.axes, [1, 2]),
            perpendicular(&self.axes, [0, 1]),
            perpendicular(&self.axes, [3, 4]),
            perpendicular(&self.axes, [4, 5]),
        ]
    }

    /// Returns the chain with the first property that holds up to rounding only, or the first that does not hold.
    fn chain(
        &self,
        properties: impl Iterator<Item = Result<(), StructureMismatch>>,
    ) -> Result<Chain, StructureMismatch> {
        let failed: Vec<_> = properties.filter_map(Result::err).collect();
        match failed.iter().find(|reason| !reason.is_rounding()) {
            Some(reason) => Err(*reason),
            None => Ok(Chain {
                folded: self.folded,
                rounding: failed.first().copied(),
            }),
        }
    }

    /// Returns the links, whose forearm ends at axis 4 if its point is given and otherwise at the wrist centre, and the vector from that end
    /// to the wrist centre in the plane of the arm \[m\].
    fn links(
        &self,
        centre: &Vector3<f64>,
        axis_4: Option<&Vector3<f64>>,
        rounding: Option<StructureMismatch>,
    ) -> Result<(Links, Complex<f64>), StructureMismatch> {
        let axes = &self.axes;
        let zero_m = rounding.map_or(GEOMETRY_TOLERANCE_M, |_| ROUNDED_M);
        let shoulder = shoulder_frame(axes, centre);
        let shoulder_from_base = shoulder.inverse();
        let seen = |point: &Vector3<f64>| shoulder_from_base.rotation * point + shoulder_from_base.translation;
        let [second, third, wrist] = [axes[1].point, axes[2].point, *centre].map(|p| seen(&p));
        let end = axis_4.map_or(wrist, seen);
        let plane = |v: Vector3<f64>| Complex::new(v.z, v.x);
        let (upper, fore) = (plane(third - second), plane(end - third));
        let [length_m, fore_m] = [upper, fore].map(|link| link.norm_sqr().sqrt());
        if length_m < SHORTEST_LINK_M {
            return Err(StructureMismatch::NoUpperArm { length_m });
        }
        if fore_m < SHORTEST_LINK_M {
            return Err(StructureMismatch::NoForearm { length_m: fore_m });
        }
        let turn = (fore / fore_m) * (upper / length_m).conj();
        let y = shoulder.rotation.column(1);
        let links = Links {
            shoulder_from_base,
            wrist_along_axis_6: axes[5].direction.dot(&(centre - axes[5].point)),
            shoulder_offset: second.x,
            lateral_offset: if wrist.y.abs() <= zero_m { 0.0 } else { wrist.y },
            lengths: [length_m, fore_m],
            signs: [1, 2].map(|i: usize| 1.0_f64.copysign(axes[i].direction.dot(&y))),
            upper_at_zero: upper / length_m,
            bend_at_zero: atan2(turn.im, turn.re),
            turn_at_zero: turn,
        };
        Ok((links, plane(wrist - end)))
    }

    fn turns(&self, links: &Links) -> Turns {
        let zero = WristZero::of(&self.folded);
        let first = links.shoulder_from_base.rotation * self.bodies[3].rotation * about_z(zero.first);
        Turns {
            from_shoulder: first.transpose(),
            at_zero: zero.others,
        }
    }
}

/// True where a property holds, or fails by rounding only.
fn nearly(property: Result<(), StructureMismatch>) -> bool {
    property.map_or_else(|reason| reason.is_rounding(), |()| true)
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

/// Returns the point of axis 6 nearest to axis 5, and by how much the two miss each other. They are perpendicular, or the result is not used
/// unless they are nearly so.
fn meeting_point(axes: &[Line; AXES]) -> (Vector3<f64>, Result<(), StructureMismatch>) {
    let [fifth, sixth] = [axes[4], axes[5]];
    let between = fifth.point - sixth.point;
    let by_m = fifth.direction.cross(&sixth.direction).dot(&between).abs();
    let centre = sixth.point + sixth.direction * sixth.direction.dot(&between);
    match by_m <= GEOMETRY_TOLERANCE_M {
        true => (centre, Ok(())),
        false => (centre, Err(StructureMismatch::AxesDoNotMeet { by_m })),
    }
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
