//! Limits of stable gains and steps, against criteria by hand.

use platewash_kinematics::{JointVector, RobotModel};
use platewash_simulator::control::{Gains, Loop, Stability};
use platewash_simulator::dynamics::{DynamicsModel, MassMatrix};
use platewash_simulator::plant::ContactSlope;
use platewash_workcell::simulation::Integrator;

fn law(kp: f64, kd: f64, integrator: Integrator) -> Stability {
    Stability {
        of: Loop::Acceleration,
        gains: Gains {
            kp: JointVector::repeat(kp),
            kd: JointVector::repeat(kd),
        },
        friction: JointVector::zeros(),
        integrator,
        substeps: 1,
    }
}

/// A double integrator under semi-implicit Euler is stable if and only if 4 − 2 T kd − T² kp > 0 and kd, kp > 0 (Jury's
/// criterion on z² − (2 − T kd − T² kp) z + 1 − T kd).
#[test]
fn the_stability_limit_agrees_with_jurys_criterion() {
    let mass = RobotModel::irb120().map(|r| DynamicsModel::new(&r, None).unwrap().mass_matrix(&JointVector::zeros()));
    let mass = mass.unwrap();
    let stable = |kp: f64, kd: f64| law(kp, kd, Integrator::SemiImplicitEuler).is_stable(&mass, None, 1e-3);
    // ζ = 1: 4 − 4x − x² = 0 at x = T ω = 2√2 − 2.
    let limit = (8f64.sqrt() - 2.0) * 1e3;
    for (share, expected) in [(0.999, true), (1.001, false)] {
        let w = limit * share;
        assert_eq!(stable(w * w, 2.0 * w), expected);
    }
    assert!(!stable(900.0, 0.0) && !stable(0.0, 60.0) && !stable(-1.0, 60.0) && !stable(f64::NAN, 60.0));
    assert!(stable(900.0, 1e-2));
}

/// Exact sampling of a double integrator, which Runge–Kutta is: z² − (2 − T kd − T² kp/2) z + 1 − T kd + T² kp/2.
#[test]
fn runge_kutta_samples_exactly() {
    let mass = MassMatrix::identity();
    let stable = |kp: f64, kd: f64| law(kp, kd, Integrator::Rk4).is_stable(&mass, None, 1e-3);
    assert!(stable(900.0, 0.451) && !stable(900.0, 0.449), "T kd = T² kp/2");
    assert!(stable(100.0, 1999.0) && !stable(100.0, 2001.0), "T kd = 2");
}

#[test]
fn substeps_are_the_finer_integration_of_the_same_torque() {
    let mass = MassMatrix::identity();
    let fine = |kd: f64| {
        Stability {
            substeps: 1000,
            ..law(900.0, kd, Integrator::SemiImplicitEuler)
        }
        .is_stable(&mass, None, 1e-3)
    };
    // Towards Runge–Kutta's limit of 0.45.
    assert!(fine(0.452) && !fine(0.448));
}

/// A mass on a spring under semi-implicit Euler: z² − (2 − x²) z + 1 with x = T √(S/m), and a little damping: stable to x = 2.
/// Runge–Kutta keeps it to x = 2 √2 (Hairer and Wanner, *Solving Ordinary Differential Equations II*, IV.2).
#[test]
fn stiff_foam_asks_for_short_steps() {
    let mass = MassMatrix::identity();
    let stable = |integrator, x: f64| {
        let foam = ContactSlope {
            stiffness: MassMatrix::identity() * (x * x * 1e6),
            damping: MassMatrix::zeros(),
        };
        law(1e-6, 1e-2, integrator).is_stable(&mass, Some(&foam), 1e-3)
    };
    assert!(stable(Integrator::SemiImplicitEuler, 1.99) && !stable(Integrator::SemiImplicitEuler, 2.01));
    assert!(stable(Integrator::Rk4, 2.8) && !stable(Integrator::Rk4, 2.85));
}
