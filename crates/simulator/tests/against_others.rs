//! Dynamics against values made with Pinocchio and MuJoCo (`fixtures/generate_dynamics.py`), on the IRB 120 with and without a tool
//! and on generated arms with oblique axes and rotated fixed joints everywhere. The fixtures hold a few states each; the
//! test of the Python package draws 10 000 from the same generator.

use crate::dynamics::fixtures;
use nalgebra::Matrix6;
use platewash_kinematics::JointVector;

/// Largest difference relative to the largest entry.
fn relative(found: &JointVector, expected: &[f64; 6]) -> f64 {
    let expected = JointVector::from(*expected);
    (found - expected).amax() / expected.amax()
}

const TOLERANCE: f64 = 1e-11;

#[test]
fn inverse_dynamics_gravity_and_bias_are_pinocchios() {
    let mut compared = 0;
    for (name, fixture, robot, model) in fixtures() {
        let joints: Vec<_> = robot.joints().iter().map(|j| j.name.clone()).collect();
        assert_eq!(joints, fixture.joints, "{name}");
        for state in &fixture.states {
            let (q, qd, qdd) = (state.q.into(), state.qd.into(), state.qdd.into());
            for (what, found, expected) in [
                ("inverse", model.inverse_dynamics(&q, &qd, &qdd), &state.inverse),
                ("gravity", model.gravity_torque(&q), &state.gravity),
                ("bias", model.bias_torque(&q, &qd), &state.bias),
            ] {
                let error = relative(&found, expected);
                assert!(error < TOLERANCE, "{name} {what}: {error:e}");
                compared += 1;
            }
            let coriolis = model.coriolis_torque(&q, &qd) + JointVector::from(state.gravity);
            assert!(relative(&coriolis, &state.bias) < TOLERANCE, "{name}");
        }
    }
    assert!(compared >= 720, "only {compared} compared");
}

#[test]
fn the_mass_matrix_is_pinocchios_and_symmetric() {
    for (name, fixture, _, model) in fixtures() {
        for state in &fixture.states {
            let found = model.mass_matrix(&state.q.into());
            let expected = Matrix6::from_fn(|i, j| state.mass[i][j]);
            let error = (found - expected).amax() / expected.amax();
            assert!(error < TOLERANCE, "{name}: {error:e}");
            assert_eq!(found, found.transpose());
        }
    }
}

#[test]
fn forward_dynamics_are_pinocchios_and_mujocos() {
    for (name, fixture, _, model) in fixtures() {
        for state in &fixture.states {
            let found = model.forward_dynamics(&state.q.into(), &state.qd.into(), &state.tau.into());
            for (whose, expected) in [("Pinocchio", &state.forward), ("MuJoCo", &state.forward_mujoco)] {
                let error = relative(&found, expected);
                assert!(error < TOLERANCE, "{name} {whose}: {error:e}");
            }
        }
    }
}
