//! Geometry of the folded chain at q = 0, in the base frame: what the structures are recognised by.

use crate::ik::analytic::chain::Chain;
use crate::ik::analytic::links::Links;
use crate::ik::analytic::mismatch::{ROUNDED_M, StructureMismatch};
use crate::ik::analytic::tolerances::{GEOMETRY_TOLERANCE_M, GEOMETRY_TOLERANCE_RAD, SHORTEST_LINK_M};
use crate::ik::analytic::wrist::Turns;
use crate::joints::AXES;
use crate::model::RobotModel;
use crate::rotation::RigidTransform;
use crate::trig::{atan2, sin_cos};
use nalgebra::{Complex, Matrix3, Vector3};

/// Joint axis as a line in the base frame.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub point: Vector3<f64>,
    pub direction: Vector3<f64>,
}

/// The folded chain at q = 0.
pub(crate) struct Geometry {
    folded: [RigidTransform; AXES],
    bodies: [RigidTransform; AXES],
    pub axes: [Line; AXES],
}

impl Geometry {
    pub fn from_robot(robot: &RobotModel) -> Self {
        let folded = *robot.folded();
        let bodies = at_zero(&folded);
        let axes = bodies.map(|body| Line {
            point: body.translation,
            direction: body.rotation.column(2).into(),
        });
        Self { folded, bodies, axes }
    }

    /// Returns the angles between axes that both structures ask for.
    pub fn angles(&self) -> [Result<(), StructureMismatch>; 4] {
        [
            parallel(&self.axes, [1, 2]),
            perpendicular(&self.axes, [0, 1]),
            perpendicular(&self.axes, [3, 4]),
            perpendicular(&self.axes, [4, 5]),
        ]
    }

    /// Returns the chain with the first property that holds up to rounding only, or the first that does not hold.
    pub fn chain(
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
    pub fn links(
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

    pub fn turns(&self, links: &Links) -> Turns {
        let zero = WristZero::new(&self.folded);
        let first = links.shoulder_from_base.rotation * self.bodies[3].rotation * about_z(zero.first);
        Turns {
            from_shoulder: first.transpose(),
            at_zero: zero.others,
        }
    }
}

/// True where a property holds, or fails by rounding only.
pub(crate) fn nearly(property: Result<(), StructureMismatch>) -> bool {
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

pub(crate) fn parallel(axes: &[Line; AXES], joints: [usize; 2]) -> Result<(), StructureMismatch> {
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
pub(super) fn wrist_centre(axes: &[Line; AXES]) -> (Vector3<f64>, [Result<(), StructureMismatch>; 2]) {
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
pub(super) fn meeting_point(axes: &[Line; AXES]) -> (Vector3<f64>, Result<(), StructureMismatch>) {
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
    fn new(folded: &[RigidTransform; AXES]) -> Self {
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
