//! What dynamics must obey whatever the arm: the algorithms agree with each other, energy is kept, gravity has a potential.

use crate::dynamics::{fixture, names};
use platewash_kinematics::JointVector;
use proptest::prelude::*;

fn vector(size: f64) -> impl Strategy<Value = JointVector> {
    prop::array::uniform6(-size..size).prop_map(JointVector::from)
}

fn arm() -> impl Strategy<Value = String> {
    prop::sample::select(names())
}

proptest! {
    #[test]
    fn forward_dynamics_undo_inverse_dynamics(name in arm(), q in vector(3.2), qd in vector(5.0), qdd in vector(20.0)) {
        let (_, _, model) = fixture(&name);
        let torque = model.inverse_dynamics(&q, &qd, &qdd);
        let back = model.forward_dynamics(&q, &qd, &torque);
        let error = (back - qdd).amax() / qdd.amax().max(1.0);
        prop_assert!(error < 1e-9, "{name}: {error:e}");
    }

    #[test]
    fn inverse_dynamics_are_mass_times_acceleration_and_bias(name in arm(), q in vector(3.2), qd in vector(5.0), qdd in vector(20.0)) {
        let (_, _, model) = fixture(&name);
        let sum = model.mass_matrix(&q) * qdd + model.bias_torque(&q, &qd);
        let torque = model.inverse_dynamics(&q, &qd, &qdd);
        prop_assert!((sum - torque).amax() < 1e-10 * torque.amax().max(1.0));
    }

    #[test]
    fn the_mass_matrix_is_positive_definite(name in arm(), q in vector(3.2)) {
        let (_, _, model) = fixture(&name);
        prop_assert!(model.mass_matrix(&q).cholesky().is_some());
    }

    #[test]
    fn gravity_is_the_slope_of_the_potential(name in arm(), q in vector(3.2)) {
        const H: f64 = 1e-5;
        let (_, _, model) = fixture(&name);
        let still = JointVector::zeros();
        let gravity = model.gravity_torque(&q);
        for joint in 0..6 {
            let mut step = JointVector::zeros();
            step[joint] = H;
            let [ahead, behind] = [q + step, q - step].map(|q| model.energy(&q, &still).potential_j);
            prop_assert!(((ahead - behind) / (2.0 * H) - gravity[joint]).abs() < 1e-7 * gravity.amax().max(1.0));
        }
    }

    /// q̇ᵀ (Ṁ − 2C) q̇ = 0: half the rate of the mass matrix does the work of the Coriolis torques.
    #[test]
    fn coriolis_torques_do_the_work_of_the_changing_mass(name in arm(), q in vector(3.2), qd in vector(3.0)) {
        const H: f64 = 1e-6;
        let (_, _, model) = fixture(&name);
        let [ahead, behind] = [q + qd * H, q - qd * H].map(|q| model.energy(&q, &qd).kinetic_j);
        let power = qd.dot(&model.coriolis_torque(&q, &qd));
        prop_assert!(((ahead - behind) / (2.0 * H) - power).abs() < 1e-6 * power.abs().max(10.0));
    }

    #[test]
    fn non_finite_input_gives_non_finite_output(joint in 0..6usize, bad in prop::sample::select(vec![f64::NAN, f64::INFINITY])) {
        let (_, _, model) = fixture("irb120");
        let fine = JointVector::repeat(0.3);
        let mut broken = fine;
        broken[joint] = bad;
        for found in [
            model.inverse_dynamics(&broken, &fine, &fine),
            model.forward_dynamics(&broken, &fine, &fine),
            model.forward_dynamics(&fine, &broken, &fine),
            model.forward_dynamics(&fine, &fine, &broken),
        ] {
            // Joint 1 turns about gravity: nothing but the wrist's torques would notice its position.
            prop_assert!(joint == 0 || found.iter().any(|v| !v.is_finite()));
        }
    }
}
