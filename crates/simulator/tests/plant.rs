//! The plant: energy is kept where nothing takes it, friction only takes it, limits hold.

use crate::dynamics::fixture;
use nalgebra::Vector3;
use platewash_kinematics::{Axes, JointVector, RobotModel};
use platewash_simulator::{DynamicsModel, Energy, Plant, PlantState};
use platewash_workcell::simulation::{Integrator, PlantSettings};
use proptest::prelude::*;

fn irb120() -> (RobotModel, DynamicsModel) {
    let robot = RobotModel::irb120().unwrap();
    let model = DynamicsModel::new(&robot, None).unwrap();
    (robot, model)
}

fn vector(size: f64) -> impl Strategy<Value = JointVector> {
    prop::array::uniform6(-size..size).prop_map(JointVector::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// The passive undamped arm let go anywhere: over 10 s of RK4 at 1 kHz the energy stays within 1e-6 of the largest
    /// kinetic energy. Speeds reach tens of rad/s at the wrist.
    #[test]
    fn a_passive_arm_keeps_its_energy(q in vector(1.5)) {
        let plant = Plant::ideal(irb120().1, Integrator::Rk4);
        let mut state = PlantState::at_rest(q);
        let total_j = |energy: Energy| energy.kinetic_j + energy.potential_j;
        let start = total_j(plant.model.energy(&state.q, &state.qd));
        let (mut worst, mut peak) = (0.0f64, 0.0f64);
        for _ in 0..10_000 {
            state = plant.step(&state, &JointVector::zeros(), 1e-3).0;
            let energy = plant.model.energy(&state.q, &state.qd);
            worst = worst.max((total_j(energy) - start).abs());
            peak = peak.max(energy.kinetic_j);
        }
        prop_assert!(worst < 1e-6 * peak, "{worst:e} of {peak}");
    }

    /// Without gravity, semi-implicit Euler loses energy to friction at every step, up to what its first order costs.
    #[test]
    fn friction_only_takes_energy(q in vector(1.5), qd in vector(2.0), coulomb in 0.0..5.0f64, viscous in 0.0..50.0f64) {
        let (robot, model) = irb120();
        let settings = PlantSettings {
            coulomb_friction_n_m: [coulomb; 6],
            viscous_friction_n_m_s: [viscous; 6],
            ..PlantSettings::default()
        };
        let model = model.with_gravity(Vector3::zeros()).unwrap();
        let plant = Plant::new(model, robot.limits(), &settings);
        let mut state = PlantState { q, qd };
        let mut before = plant.model.energy(&state.q, &state.qd).kinetic_j;
        for _ in 0..500 {
            state = plant.step(&state, &JointVector::zeros(), 1e-3).0;
            let now = plant.model.energy(&state.q, &state.qd).kinetic_j;
            // What Coriolis forces cost a first-order step.
            prop_assert!(now <= before * (1.0 + 2e-2) + 1e-12, "{before} → {now}");
            before = now;
        }
    }
}

proptest! {
    /// Halving the step divides Runge–Kutta's error by 2⁴, Euler's by 2.
    #[test]
    fn integrators_have_their_order(q in vector(1.0), qd in vector(1.0)) {
        let model = irb120().1;
        let torque = model.gravity_torque(&q);
        let end = |integrator: Integrator, steps: u32| {
            let plant = Plant::ideal(model.clone(), integrator);
            let h = 0.02 / f64::from(steps);
            (0..steps).fold(PlantState { q, qd }, |state, _| plant.step(&state, &torque, h).0).q
        };
        let exact = end(Integrator::Rk4, 64);
        for (integrator, order) in [(Integrator::SemiImplicitEuler, 2.0), (Integrator::Rk4, 16.0)] {
            let [coarse, fine] = [2, 4].map(|steps| (end(integrator, steps) - exact).norm());
            // Below 1e-13 there is rounding only.
            prop_assert!(coarse < 1e-13 || fine < coarse / order * 1.6, "{integrator:?}: {coarse:e} {fine:e}");
        }
    }

    #[test]
    fn stiff_friction_stops_joints_and_never_turns_them_round(q in vector(1.5), qd in vector(3.0), coulomb in 1.0..1e4f64) {
        let (robot, model) = irb120();
        let settings = PlantSettings { coulomb_friction_n_m: [coulomb; 6], ..PlantSettings::default() };
        let plant = Plant::new(model.with_gravity(Vector3::zeros()).unwrap(), robot.limits(), &settings);
        let mut state = PlantState { q, qd };
        for _ in 0..3000 {
            state = plant.step(&state, &JointVector::zeros(), 1e-3).0;
        }
        prop_assert!(state.qd.amax() < 1e-6, "{}", state.qd);
        prop_assert!((state.q - q).amax() < 20.0);
    }

    #[test]
    fn a_force_does_the_work_of_the_jacobian(name in prop::sample::select(crate::dynamics::names()), q in vector(3.0), force in prop::array::uniform3(-9.0..9.0f64)) {
        let (_, robot, model) = fixture(&name);
        let force = Vector3::from(force);
        for link in robot.links() {
            let jacobian = robot.fk(&q).jacobian(&link.frame, Axes::Base);
            let expected = jacobian.fixed_rows::<3>(0).transpose() * force;
            let found = model.torque_of_force(&q, &link.frame, &force);
            prop_assert!((found - expected).amax() < 1e-11, "{name} {}", link.name);
            let at = robot.fk(&q).rigid(&link.frame).translation;
            prop_assert!((model.position(&q, &link.frame).coords - at).amax() < 1e-12);
        }
    }
}

#[test]
fn torque_limits_cut_torques_and_give_their_shares() {
    let (robot, model) = irb120();
    let free = Plant::new(model.clone(), robot.limits(), &PlantSettings::default());
    let torque = JointVector::repeat(-1e9);
    assert_eq!(
        free.limits.cut(&torque),
        torque,
        "an effort of 0 in the URDF is no limit"
    );
    assert_eq!(free.limits.shares(&torque), [None; 6]);
    let settings = PlantSettings {
        torque_limit_n_m: Some([50.0, 40.0, 30.0, 20.0, 10.0, 5.0]),
        ..PlantSettings::default()
    };
    let limited = Plant::new(model, robot.limits(), &settings);
    assert_eq!(
        limited.limits.cut(&torque),
        JointVector::new(-50.0, -40.0, -30.0, -20.0, -10.0, -5.0)
    );
    assert_eq!(limited.limits.shares(&JointVector::repeat(10.0))[4], Some(1.0));
    let (_, described, model) = fixture("arm_1");
    let known = Plant::new(model, described.limits(), &PlantSettings::default());
    assert_eq!(known.limits.0, described.limits().effort, "known efforts are limits");
    assert!(known.limits.0.iter().all(Option::is_some));
}
