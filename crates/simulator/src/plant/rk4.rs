//! One step of the classical Runge–Kutta scheme (Kutta 1901), fourth order.

use super::state::PlantState;
use platewash_kinematics::JointVector;

/// The state `h` \[s\] later, and the acceleration at the start.
#[inline]
pub(super) fn step(
    state: &PlantState,
    h: f64,
    acceleration: impl Fn(&PlantState) -> JointVector,
) -> (PlantState, JointVector) {
    let ahead = |qd: &JointVector, qdd: &JointVector, by: f64| PlantState {
        q: state.q + qd * by,
        qd: state.qd + qdd * by,
    };
    let a1 = acceleration(state);
    let second = ahead(&state.qd, &a1, 0.5 * h);
    let a2 = acceleration(&second);
    let third = ahead(&second.qd, &a2, 0.5 * h);
    let a3 = acceleration(&third);
    let fourth = ahead(&third.qd, &a3, h);
    let a4 = acceleration(&fourth);
    let mean =
        |k1: &JointVector, k2: &JointVector, k3: &JointVector, k4: &JointVector| (k1 + (k2 + k3) * 2.0 + k4) / 6.0;
    let speed = mean(&state.qd, &second.qd, &third.qd, &fourth.qd);
    (ahead(&speed, &mean(&a1, &a2, &a3, &a4), h), a1)
}
