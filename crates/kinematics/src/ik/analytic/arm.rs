//! An arm with a closed form, in its own terms.

use crate::AXES;
use crate::rotation::Rigid;
use nalgebra::{Complex, Matrix3};

/// An arm whose inverse kinematics has a closed form: see the [module](super) text. Immutable.
#[derive(Debug, Clone, PartialEq)]
pub struct AnalyticArm {
    /// `F_i` of the model.
    pub(super) folded: [Rigid; AXES],
    /// `T_S_base`: base coordinates to the shoulder frame at q₁ = 0.
    pub(super) shoulder_from_base: Rigid,
    /// Wrist centre on the z axis of body 6 \[m\].
    pub(super) wrist_along_axis_6: f64,
    /// x of axis 2 in the shoulder frame, a₁ \[m\].
    pub(super) shoulder_offset: f64,
    /// y of the wrist centre in the shoulder frame, b \[m\]; exactly 0 when within tolerance.
    pub(super) lateral_offset: f64,
    /// Upper arm L₂ and forearm L₃ \[m\].
    pub(super) lengths: [f64; 2],
    /// +1 where axis 2 (axis 3) points along y of the shoulder frame, −1 where against it.
    pub(super) signs: [f64; 2],
    /// `e^{i φ₂}` at q₂ = 0.
    pub(super) upper_at_zero: Complex<f64>,
    /// ψ at q₃ = 0 \[rad\], and `e^{i ψ}` there.
    pub(super) bend_at_zero: f64,
    pub(super) turn_at_zero: Complex<f64>,
    /// `Kᵀ`, K the rotation from the z–y–z wrist's first frame to the shoulder frame at q₁ = q₂ = q₃ = 0.
    pub(super) wrist_from_shoulder: Matrix3<f64>,
    /// α₅ and α₆ \[rad\].
    pub(super) wrist_at_zero: [f64; 2],
}
