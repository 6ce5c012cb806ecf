//! Levers: bounds on the distance of a point that the arm carries from each joint's axis, and so on its speed.
//!
//! Formulas (0.2) and (0.3) in `docs/certificate.md`.
//!
//! With z_i the axis of joint i and p a point on the body behind joint k, ∂p/∂q_i = z_i × (p − p_i), and every further
//! derivative puts one more z × in front of that of the outermost joint: for i ≤ j ≤ … ≤ m,
//! ‖∂ⁿp / ∂q_i ∂q_j … ∂q_m‖ ≤ ‖z_m × (p − p_m)‖ = ρ_m, the lever of the **outermost** joint.

use nalgebra::Vector3;
use platewash_kinematics::{AXES, BodyPoses, JointVector};

/// Bounds ρ of a point's distances from the six axes \[m\]; 0 for the joints that do not move it.
pub type Levers = JointVector;

/// Levers R that hold in every configuration, formula (0.2), for a point on `body` that is at `point` (base frame, m) in the configuration of
/// `poses`: the distance from axis i to the origin of joint i + 1, which never changes, and the constant lengths from
/// there on (triangle inequality).
pub fn greatest(poses: &BodyPoses, body: usize, point: &Vector3<f64>) -> Levers {
    let origin = |i: usize| poses.bodies()[i].translation;
    let mut levers = Levers::zeros();
    let mut beyond = 0.0;
    let mut next = *point;
    for joint in (1..=body).rev() {
        levers[joint - 1] = from_axis(poses, joint, &next) + beyond;
        beyond += (next - origin(joint)).norm();
        next = origin(joint);
    }
    levers
}

/// Levers ρ at one configuration, formula (0.2). `point` is p, on the body `body` \[m\].
pub fn at(poses: &BodyPoses, body: usize, point: &Vector3<f64>) -> Levers {
    Levers::from_fn(|i, _| if i < body { from_axis(poses, i + 1, point) } else { 0.0 })
}

/// Levers ρ that hold while each joint i is within `drift[i]` \[rad\] of where they were `here`, formula (0.2): `here` plus Σ R_i |Δq_i| over the
/// joints i beyond, and at most R. `drift` is |Δq|, `greatest` is R. The distance from axis j depends on the joints beyond j alone.
pub fn within(here: &Levers, drift: &JointVector, greatest: &Levers) -> Levers {
    let mut levers = *here;
    let mut moved = 0.0;
    for joint in (0..AXES).rev() {
        levers[joint] = (here[joint] + moved).min(greatest[joint]);
        moved += greatest[joint] * drift[joint];
    }
    levers
}

/// Keeps the levers of the joints from index `first` on, for the motion of a body in the frame of an earlier one.
pub fn from(levers: &Levers, first: usize) -> Levers {
    Levers::from_fn(|i, _| if i < first { 0.0 } else { levers[i] })
}

/// Sum over all tuples of joints as in formula (0.3), one index from each of `rates`, of the outermost joint's lever times the product of
/// the rates. `levers` is ρ, `rates` are those of D₁, D₂ and D₃ that the sum names. It is Σ_m ρ_m (Π_r S_r,m − Π_r S_r,m−1) with the
/// partial sums S_r,m = Σ_{i ≤ m} rate_r,i. Joints before `first` do not count.
pub fn tuples<const N: usize>(levers: &Levers, first: usize, rates: [&JointVector; N]) -> f64 {
    let mut sums = [0.0; N];
    let mut before = 0.0;
    let mut total = 0.0;
    for joint in first..AXES {
        for (sum, rate) in sums.iter_mut().zip(rates) {
            *sum += rate[joint];
        }
        let product: f64 = sums.iter().product();
        total += levers[joint] * (product - before);
        before = product;
    }
    total
}

fn from_axis(poses: &BodyPoses, joint: usize, point: &Vector3<f64>) -> f64 {
    let body = &poses.bodies()[joint];
    let axis = body.rotation.column(2).into_owned();
    axis.cross(&(point - body.translation)).norm()
}
