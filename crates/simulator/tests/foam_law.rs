//! The law of foam alone: its pressure and energy, and the longest step on it.

use platewash_simulator::dynamics::MassMatrix;
use platewash_simulator::plant::{ContactSlope, Foam, longest_step_s};
use platewash_workcell::simulation::Integrator;
use proptest::prelude::*;

const FOAM: Foam = Foam {
    stiffness_pa: 2e4,
    damping_pa_s: 100.0,
    free_height_m: 0.025,
};

#[test]
fn within_the_limit_the_foam_equals_the_foundation() {
    for w in [1e-6, 0.005, 0.0149] {
        let (energy, pressure) = FOAM.energy_and_pressure(w);
        assert!((pressure - 2e4 * w / 0.025).abs() < 1e-9);
        assert!((energy - 0.5 * 2e4 / 0.025 * w * w).abs() < 1e-12);
    }
    assert_eq!(FOAM.energy_and_pressure(0.0), (0.0, 0.0));
    assert_eq!(FOAM.energy_and_pressure(0.05), (0.0, 0.0));
    assert_eq!(FOAM.energy_and_pressure(f64::NAN), (0.0, 0.0));
    assert_eq!(FOAM.energy_and_pressure(f64::INFINITY), (0.0, 0.0));
    assert_eq!(FOAM.damped(0.005, 10.0, -1.0), 0.0, "it does not pull");
    assert!((FOAM.damped(0.005, 10.0, 0.1) - 410.0).abs() < 1e-9);
}

proptest! {
    #[test]
    fn pressure_is_the_slope_of_the_energy(w in -0.01..0.06_f64) {
        let h = 1e-7;
        let slope = (FOAM.energy_and_pressure(w + h).0 - FOAM.energy_and_pressure(w - h).0) / (2.0 * h);
        prop_assert!((FOAM.energy_and_pressure(w).1 - slope).abs() < 2.0, "{} {}", FOAM.energy_and_pressure(w).1, slope);
    }
}

fn slope(stiffness: f64, damping: f64) -> ContactSlope {
    ContactSlope {
        stiffness: MassMatrix::identity() * stiffness,
        damping: MassMatrix::identity() * damping,
    }
}

/// Spectral radius of one step on x of a mass of one.
fn radius(integrator: Integrator, h: f64, stiffness: f64, damping: f64) -> f64 {
    let step = |[x, v]: [f64; 2]| match integrator {
        Integrator::SemiImplicitEuler => {
            let v = v + h * (-stiffness * x - damping * v);
            [x + h * v, v]
        }
        Integrator::Rk4 => {
            let rate = |[x, v]: [f64; 2]| [v, -stiffness * x - damping * v];
            let ahead = |by: f64, r: [f64; 2]| [x + by * r[0], v + by * r[1]];
            let a = rate([x, v]);
            let b = rate(ahead(0.5 * h, a));
            let c = rate(ahead(0.5 * h, b));
            let d = rate(ahead(h, c));
            let sum = [0, 1].map(|k| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0);
            ahead(h, sum)
        }
    };
    let (a, b) = (step([1.0, 0.0]), step([0.0, 1.0]));
    let (half, det) = (0.5 * (a[0] + b[1]), a[0] * b[1] - b[0] * a[1]);
    let beyond = half * half - det;
    if beyond > 0.0 {
        half.abs() + beyond.sqrt()
    } else {
        det.sqrt()
    }
}

#[test]
fn steps_up_to_the_longest_are_stable() {
    for integrator in [Integrator::SemiImplicitEuler, Integrator::Rk4] {
        for stiffness in [1.0, 1e3, 1e6] {
            for ratio in [0.0, 0.01, 0.3, 1.0, 3.0, 30.0] {
                let damping = ratio * f64::sqrt(stiffness);
                let longest = longest_step_s(&MassMatrix::identity(), &slope(stiffness, damping), integrator);
                for share in [0.01, 0.3, 0.7, 0.9, 0.999] {
                    let radius = radius(integrator, share * longest, stiffness, damping);
                    assert!(
                        radius <= 1.0 + 1e-9,
                        "{integrator:?} {stiffness} {ratio} {share}: {radius}"
                    );
                }
                let beyond = radius(integrator, 1.25 * longest, stiffness, damping);
                assert!(beyond > 1.0, "{integrator:?} {stiffness} {ratio}: {beyond}");
            }
        }
    }
}

#[test]
fn returns_no_step_for_an_invalid_slope() {
    let one = MassMatrix::identity();
    let euler = Integrator::SemiImplicitEuler;
    assert_eq!(longest_step_s(&one, &slope(0.0, 0.0), euler), f64::INFINITY);
    assert_eq!(longest_step_s(&one, &slope(f64::NAN, 0.0), euler), 0.0);
    assert_eq!(longest_step_s(&-one, &slope(1.0, 0.0), euler), 0.0);
}
