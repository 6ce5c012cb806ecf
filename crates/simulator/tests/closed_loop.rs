//! From anywhere within the limits, at up to half the speed limits, every law that is not refused stays bounded and settles.

use nalgebra::Matrix6;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_simulator::control::{self, ControlError, OperatingPoint, PaperLaw, Reference};
use platewash_simulator::dynamics::spread;
use platewash_simulator::{Command, ControlLaw, DynamicsModel, Plant, PlantState};
use platewash_workcell::simulation::{ControlLawName, ControlSettings, Integrator};
use proptest::prelude::*;
use std::sync::OnceLock;

const LAWS: [ControlLawName; 3] = [
    ControlLawName::Pd,
    ControlLawName::PdGravity,
    ControlLawName::ComputedTorque,
];

fn plant() -> (RobotModel, Plant) {
    let robot = RobotModel::irb120().unwrap();
    let plant = Plant::ideal(DynamicsModel::new(&robot, None).unwrap(), Integrator::SemiImplicitEuler);
    (robot, plant)
}

/// Configurations at which some loop of independent joints is nearest to instability, and some all over the limits.
///
/// Gains go with D, each joint's largest inertia, so that a loop is fastest where the largest eigenvalue of M⁻¹ D is.
fn everywhere(robot: &RobotModel) -> Vec<OperatingPoint> {
    static FOUND: OnceLock<Vec<JointVector>> = OnceLock::new();
    let find = || {
        let (_, plant) = plant();
        let scale = Matrix6::from_diagonal(&plant.model.largest_inertias(robot.limits()).map(f64::sqrt));
        let fastest = |q: &JointVector| {
            let inverse = plant.model.mass_matrix(q).try_inverse().unwrap();
            (scale * inverse * scale).symmetric_eigenvalues().max()
        };
        let mut all: Vec<_> = spread(robot.limits(), 1 << 14).map(|q| (fastest(&q), q)).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        all.into_iter()
            .map(|(_, q)| q)
            .take(32)
            .chain(spread(robot.limits(), 32))
            .collect()
    };
    FOUND
        .get_or_init(find)
        .iter()
        .copied()
        .map(OperatingPoint::from)
        .collect()
}

/// The state after `seconds` at 1 kHz.
fn run(
    law: &mut dyn ControlLaw,
    plant: &Plant,
    target: JointVector,
    mut state: PlantState,
    seconds: f64,
) -> PlantState {
    let reference = Reference::towards(target);
    for _ in 0..(seconds * 1e3) as usize {
        match law.command(&reference, &state) {
            Command::Torque(torque) => state = plant.step(&state, &torque, 1e-3).0,
            Command::Position(q) => state = PlantState::at_rest(q),
        }
        assert!(state.q.amax() < 1e3 && state.qd.amax() < 1e4, "{state:?}");
    }
    state
}

/// Where a law without a plant puts the arm next.
fn stepped(law: &mut dyn ControlLaw, reference: &Reference, q: JointVector) -> JointVector {
    match law.command(reference, &PlantState::at_rest(q)) {
        Command::Position(q) => q,
        Command::Torque(_) => JointVector::repeat(f64::NAN),
    }
}

/// A place within a range, by a share.
fn within(robot: &RobotModel, shares: [f64; 6]) -> JointVector {
    JointVector::from_fn(|j, _| {
        let [least, most] = robot.limits().sampling_range(j);
        least + (most - least) * shares[j]
    })
}

/// Where a loop starts, where it shall go, and its settings.
#[derive(Debug, Clone)]
struct Case {
    from: [f64; 6],
    target: [f64; 6],
    speeds: [f64; 6],
    frequency: f64,
    damping: f64,
}

fn cases() -> impl Strategy<Value = Case> {
    let shares = || prop::array::uniform6(0.0..1.0f64);
    let speeds = prop::array::uniform6(-0.5..0.5f64);
    (shares(), shares(), speeds, 5.0..80.0f64, 0.7..1.5f64).prop_map(|(from, target, speeds, frequency, damping)| {
        Case {
            from,
            target,
            speeds,
            frequency,
            damping,
        }
    })
}

/// The law stays bounded for 5 s at least and settles, or is refused.
fn settles(law: ControlLawName, case: &Case) -> Result<(), TestCaseError> {
    let (robot, plant) = plant();
    let (frequency, damping) = (case.frequency, case.damping);
    let settings = ControlSettings {
        frequency_rad_s: frequency,
        damping_ratio: damping,
        ..ControlSettings::default()
    };
    let Ok(mut made) = control::law(law, &settings, &plant, robot.limits(), &everywhere(&robot), 1) else {
        // Few are refused: independent joints with high gains, whose wrist has much less inertia in some configurations.
        prop_assert!(
            law != ControlLawName::ComputedTorque && frequency * damping > 30.0,
            "{law:?} {frequency} {damping}"
        );
        return Ok(());
    };
    let (q, target) = (within(&robot, case.from), within(&robot, case.target));
    let qd = JointVector::from(case.speeds).component_mul(&robot.limits().velocity);
    let mut end = run(made.as_mut(), &plant, target, PlantState { q, qd }, 5.0);
    if law == ControlLawName::Pd && end.qd.amax() >= 0.05 {
        // A loop that is hardly stiffer than gravity's slope takes its time.
        end = run(made.as_mut(), &plant, target, end, 25.0);
    }
    prop_assert!(
        end.qd.amax() < 0.05,
        "{law:?} at {frequency} rad/s still moves: {}",
        end.qd
    );
    if law != ControlLawName::Pd {
        prop_assert!(
            (end.q - target).amax() < 0.05,
            "{law:?} at {frequency} rad/s is off: {}",
            end.q - target
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn pd_stays_bounded_and_settles(case in cases()) {
        settles(ControlLawName::Pd, &case)?;
    }

    #[test]
    fn pd_with_gravity_stays_bounded_and_settles(case in cases()) {
        settles(ControlLawName::PdGravity, &case)?;
    }

    #[test]
    fn computed_torque_stays_bounded_and_settles(case in cases()) {
        settles(ControlLawName::ComputedTorque, &case)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// The paper's law, stepped at its own 0.01 s for 5 s, settles or is refused; it is refused where its error grows.
    #[test]
    fn the_papers_law_settles_or_is_refused(
        from in prop::array::uniform6(0.0..1.0f64),
        target in prop::array::uniform6(0.0..1.0f64),
        kp in 2.0..400.0f64,
        kd in -1.2..1.2f64,
    ) {
        let (robot, _) = plant();
        let settings = ControlSettings { kp, kd, ..ControlSettings::default() };
        let (q, target) = (within(&robot, from), within(&robot, target));
        let reference = Reference::towards(target);
        let mut free = PaperLaw::new(kp, kd, 0.01);
        let grown = (0..2000).fold(q, |q, _| stepped(&mut free, &reference, q)) - target;
        // Within 2 % of the limit neither growth nor decay shows in 20 s.
        let limit = 2.0 * (1.0 - kd) / 0.01;
        let is_marginal = (kd.abs() - 1.0).abs() < 0.02 || (kp - limit).abs() < 0.02 * limit.abs();
        // Joint 6 alone may have 14 rad to go.
        let is_bounded = grown.iter().all(|v| v.is_finite() && v.abs() < 50.0);
        let has_moved_in = grown.iter().zip(&(q - target)).all(|(now, before)| now.is_finite() && now.abs() < 0.9 * before.abs());
        match control::stable_kinematic(ControlLawName::Paper, &settings) {
            Ok(_) => prop_assert!(is_bounded, "accepted and grows: {}", grown),
            Err(_) => prop_assert!(!has_moved_in || is_marginal, "refused and settles: {}", grown),
        }
        let paper = ControlSettings::default();
        let mut law = control::stable_kinematic(ControlLawName::Paper, &paper).unwrap();
        let end = (0..500).fold(q, |q, _| stepped(law.as_mut(), &reference, q));
        prop_assert!((end - target).amax() < 1e-6);
    }
}

#[test]
fn unstable_settings_are_refused_with_their_limits() {
    let (robot, plant) = plant();
    for law in LAWS {
        let settings = |frequency: f64, rate: f64| ControlSettings {
            frequency_rad_s: frequency,
            rate_hz: rate,
            ..ControlSettings::default()
        };
        let refusal = |settings: &ControlSettings| {
            control::law(law, settings, &plant, robot.limits(), &everywhere(&robot), 1)
                .map(|_| ())
                .unwrap_err()
        };
        let error = refusal(&settings(2000.0, 1000.0));
        let ControlError::Unstable {
            least_rate_hz: Some(rate),
            highest_frequency_rad_s: Some(frequency),
            ..
        } = error
        else {
            panic!("{error}");
        };
        let message = error.to_string();
        assert!(
            message.contains(&format!("{} Hz", platewash_kinematics::words::rounded_up(rate, 5)))
                && message.contains("the frequency must be at most"),
            "{message}"
        );
        assert!(rate > 1000.0 && frequency < 2000.0);
        // The limits are limits: within them it holds, a percent beyond it does not.
        let holds = |frequency: f64, rate: f64| {
            control::law(
                law,
                &settings(frequency, rate),
                &plant,
                robot.limits(),
                &everywhere(&robot),
                1,
            )
            .is_ok()
        };
        assert!(
            holds(2000.0, rate * 1.001) && !holds(2000.0, rate * 0.99),
            "{law:?} {rate}"
        );
        assert!(
            holds(frequency * 0.999, 1000.0) && !holds(frequency * 1.01, 1000.0),
            "{law:?} {frequency}"
        );
    }
}

#[test]
fn gains_that_never_hold_are_refused() {
    let (robot, plant) = plant();
    let outright = |kp: f64, kd: f64| ControlSettings {
        joint_kp: Some([kp; 6]),
        joint_kd: Some([kd; 6]),
        ..ControlSettings::default()
    };
    let refusal = |settings: &ControlSettings| {
        control::law(
            ControlLawName::Pd,
            settings,
            &plant,
            robot.limits(),
            &everywhere(&robot),
            1,
        )
        .map(|_| ())
        .unwrap_err()
    };
    let error = refusal(&outright(20.0, 0.0));
    assert!(
        matches!(
            error,
            ControlError::Unstable {
                least_rate_hz: None,
                highest_frequency_rad_s: None,
                ..
            }
        ),
        "{error}"
    );
    assert!(error.to_string().contains("above 0"), "{error}");
    for bad in [f64::NAN, -1.0, f64::INFINITY] {
        assert!(matches!(
            refusal(&outright(bad, 1.0)),
            ControlError::Setting { name: "joint_kp", .. }
        ));
        let settings = ControlSettings {
            frequency_rad_s: bad,
            ..ControlSettings::default()
        };
        assert!(matches!(
            refusal(&settings),
            ControlError::Setting {
                name: "frequency_rad_s",
                ..
            }
        ));
        let settings = ControlSettings {
            rate_hz: bad,
            ..ControlSettings::default()
        };
        assert!(matches!(
            refusal(&settings),
            ControlError::Setting { name: "rate_hz", .. }
        ));
    }
}

/// The paper's program follows waypoints whatever its gains, and never with torques.
#[test]
fn a_law_for_waypoints_moves_positions() {
    let unstable = ControlSettings {
        kp: 1e6,
        ..ControlSettings::default()
    };
    for law in ControlLawName::ALL {
        let made = control::kinematic(law, &unstable).map(|_| ());
        assert_eq!(made.is_ok(), law.is_kinematic(), "{law:?}");
        if let Err(error) = made {
            assert_eq!(error, ControlError::NotKinematic { law });
            assert!(error.to_string().contains(law.name()), "{error}");
        }
    }
    assert!(matches!(
        control::stable_kinematic(ControlLawName::Paper, &unstable),
        Err(ControlError::UnstablePaper { .. })
    ));
    let mut exact = control::stable_kinematic(ControlLawName::Exact, &unstable).unwrap();
    let target = JointVector::new(0.1, -0.2, 0.3, 0.2, 0.4, -0.5);
    let end = stepped(exact.as_mut(), &Reference::towards(target), JointVector::zeros());
    assert_eq!(end, target);
}

/// Computed torque on a plant that the law knows is a double integrator: e(t) = e₀ (1 + ω t) exp(−ω t) from rest with ζ = 1.
#[test]
fn computed_torque_is_a_second_order_system() {
    let (robot, plant) = plant();
    let settings = ControlSettings {
        rate_hz: 1e4,
        frequency_rad_s: 10.0,
        ..ControlSettings::default()
    };
    let mut law = control::law(
        ControlLawName::ComputedTorque,
        &settings,
        &plant,
        robot.limits(),
        &everywhere(&robot),
        1,
    )
    .unwrap();
    let target = JointVector::new(0.1, -0.2, 0.3, 0.2, 0.4, -0.5);
    let mut state = PlantState::at_rest(JointVector::zeros());
    let reference = Reference::towards(target);
    for _ in 0..2000 {
        let Command::Torque(torque) = law.command(&reference, &state) else {
            panic!("a torque")
        };
        state = plant.step(&state, &torque, 1e-4).0;
    }
    // t = 0.2 s, ω t = 2.
    let left = 3.0 * (-2f64).exp();
    assert!(
        (target - state.q - target * left).amax() < 2e-3,
        "{}",
        (target - state.q).component_div(&target)
    );
}
