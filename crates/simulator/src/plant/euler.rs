//! One step of semi-implicit Euler, implicit in the friction.
//!
//! With d = d(q̇) taken at the start of the step and friction at its end, (M + h diag(d)) q̈ = τ − C q̇ − g − d q̇; then
//! q̇ += h q̈, q += h q̇. Symplectic without friction; friction alone never turns a joint round, however stiff it is.

use super::friction::Friction;
use super::state::PlantState;
use crate::dynamics::DynamicsModel;
use platewash_kinematics::JointVector;

#[inline]
pub(super) fn step(
    (model, friction): (&DynamicsModel, &Friction),
    state: &PlantState,
    torque: &JointVector,
    h: f64,
) -> (PlantState, JointVector) {
    let d = friction.coefficient(&state.qd);
    let net = torque - d.component_mul(&state.qd);
    let qdd = model.forward_dynamics_with(&state.q, &state.qd, &net, &(d * h));
    let qd = state.qd + qdd * h;
    let q = state.q + qd * h;
    (PlantState { q, qd }, qdd)
}
