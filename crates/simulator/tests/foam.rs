//! Plates that push a sponge back: the law, its energy, and what it makes of an arm.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_simulator::plant::foam::DENSE_STRAIN;
use platewash_simulator::plant::{SpongeOnPlates, longest_step_s};
use platewash_simulator::{DynamicsModel, Plant, PlantState};
use platewash_workcell::plate::Plate;
use platewash_workcell::simulation::{FoamContact, Integrator};
use platewash_workcell::surface::Surface;
use platewash_workcell::tool::{StraightTool, Tool, tool_down};
use proptest::prelude::*;

/// 25 mm free, 5 mm of which are pressed in where the tip is on the face.
fn tool() -> Tool {
    Tool::from(StraightTool {
        length_m: 0.15,
        sponge_height_m: 0.02,
        sponge_compression_m: 0.005,
        ..StraightTool::default()
    })
}

struct Cell {
    model: DynamicsModel,
    sponge: SpongeOnPlates,
    robot: RobotModel,
    plate: Plate,
}

fn plate(surface: Surface) -> Plate {
    Plate {
        surface,
        ..Plate::level_disc([0.4, 0.0, 0.1], 0.1, 0.02)
    }
}

fn cell(surface: Surface, foam: FoamContact) -> Cell {
    let (robot, tool) = (RobotModel::irb120().unwrap(), tool());
    let plate = plate(surface);
    Cell {
        model: DynamicsModel::new(&robot, Some(&tool)).unwrap(),
        sponge: SpongeOnPlates::new(&robot, &tool, &[plate], &foam).unwrap(),
        robot,
        plate,
    }
}

fn foam(stiffness_pa: f64) -> FoamContact {
    FoamContact {
        stiffness_pa,
        damping_pa_s: 0.0,
    }
}

impl Cell {
    /// The arm with its tip there over the plate [m, plate frame], the tool tilted by a rotation vector from straight down [rad].
    fn reach(&self, tip: [f64; 3], tilt: [f64; 2]) -> Option<JointVector> {
        let at = self.plate.world(&Vector3::from(tip));
        let down = UnitQuaternion::new(Vector3::new(tilt[0], tilt[1], 0.0)) * tool_down(at).rotation;
        let tight = IkSettings {
            position_tolerance_m: 1e-11,
            orientation_tolerance_rad: 1e-11,
            ..IkSettings::default()
        };
        let solver = IkSolver::new(&self.robot, tool().tip_frame(&self.robot), tight).unwrap();
        let near = JointVector::from([0.0, 0.3, 0.2, 0.0, 1.0, 0.0]);
        solver
            .solve(&Pose::from_parts(at.into(), down), &near)
            .ok()
            .map(|answer| answer.q)
    }

    fn energy(&self, q: &JointVector) -> f64 {
        self.sponge.push(&self.model, &PlantState::at_rest(*q)).energy_j
    }
}

/// By hand: 20 kPa, 5 mm of 25 mm, a radius of 25 mm: 4 kPa, 7.85 N.
#[test]
fn the_force_on_an_upright_sponge_agrees_with_hand_calculation() {
    let cell = cell(Surface::Disc { radius_m: 0.145 }, foam(2e4));
    let q = cell.reach([0.05, 0.02, 0.0], [0.0; 2]).unwrap();
    let push = cell.sponge.push(&cell.model, &PlantState::at_rest(q));
    let force = 4000.0 * std::f64::consts::PI * 0.025 * 0.025;
    assert!(
        (force - 7.854).abs() < 1e-3 && (push.load.force_n - force).abs() < 1e-6,
        "{push:?}"
    );
    assert!((push.load.deepest_m - 0.005).abs() < 1e-9 && (push.energy_j - 0.5 * force * 0.005).abs() < 1e-8);
    let tip = tool().tip_frame(&cell.robot);
    let by_hand = cell.model.torque_of_force(&q, &tip, &Vector3::new(0.0, 0.0, force));
    assert!((push.torque - by_hand).amax() < 1e-6, "{} {by_hand}", push.torque);
    // Half a plate's height error is half a millimetre times 1.57 N/mm.
    let higher = cell.sponge.load_at_rest(&cell.model, &q, 0, 0.001).force_n;
    assert!((higher - force * 1.2).abs() < 1e-6);
    assert_eq!(cell.sponge.load_at_rest(&cell.model, &q, 0, -0.0051).force_n, 0.0);
    assert_eq!(
        cell.sponge.load_at_rest(&cell.model, &q, 7, 0.0).force_n,
        0.0,
        "no such plate"
    );
}

#[test]
fn a_sponge_far_from_every_plate_feels_no_force() {
    let cell = cell(Surface::Disc { radius_m: 0.145 }, foam(2e4));
    for tip in [[0.05, 0.02, 0.0051], [0.0, 0.0, 0.3], [0.0, 0.175, 0.0]] {
        let Some(q) = cell.reach(tip, [0.0; 2]) else {
            panic!("{tip:?}")
        };
        let push = cell.sponge.push(&cell.model, &PlantState::at_rest(q));
        assert_eq!(
            (push.load.force_n, push.energy_j, push.torque),
            (0.0, 0.0, JointVector::zeros())
        );
    }
}

fn surfaces() -> impl Strategy<Value = Surface> {
    prop::sample::select(vec![
        Surface::Disc { radius_m: 0.145 },
        Surface::shipped("coupe275").unwrap(),
        Surface::shipped("rim270").unwrap(),
        Surface::shipped("deep230").unwrap(),
        Surface::shipped("dessert190").unwrap(),
    ])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Torques are the slope of the foam's energy, on the face and over the rim, upright and tilted, pressed and pressed too hard.
    #[test]
    fn torques_are_the_slope_of_the_energy(
        surface in surfaces(),
        share in 0.0..1.15_f64,
        azimuth in -3.1..3.1_f64,
        deep in -0.004..0.012_f64,
        tilt in prop::array::uniform2(-0.15..0.15_f64),
    ) {
        let cell = cell(surface, foam(2e4));
        let rho = share * surface.rim_m();
        let height = surface.height_m(rho.min(surface.rim_m())) - deep;
        let q = cell.reach([rho * azimuth.cos(), rho * azimuth.sin(), height], tilt);
        prop_assume!(q.is_some());
        let q = q.unwrap();
        let push = cell.sponge.push(&cell.model, &PlantState::at_rest(q));
        let scale = push.torque.amax().max(0.1);
        for joint in 0..6 {
            let h = 1e-6;
            let moved = |by: f64| {
                let mut q = q;
                q[joint] += by;
                cell.energy(&q)
            };
            let slope = (moved(h) - moved(-h)) / (2.0 * h);
            prop_assert!((push.torque[joint] + slope).abs() < 2e-4 * scale, "{joint}: {} {slope}", push.torque[joint]);
        }
    }

    /// Where the tool leans so far that the law fades, too.
    #[test]
    fn a_leaning_tool_is_pushed_by_the_slope_of_the_energy(
        azimuth in -3.1..3.1_f64,
        lean in 0.7..1.2_f64,
        towards in -3.1..3.1_f64,
        deep in 0.0..0.02_f64,
    ) {
        let cell = cell(Surface::Disc { radius_m: 0.145 }, foam(2e4));
        let at = [0.06 * azimuth.cos(), 0.06 * azimuth.sin(), -deep];
        let q = cell.reach(at, [lean * towards.cos(), lean * towards.sin()]);
        prop_assume!(q.is_some());
        let q = q.unwrap();
        let push = cell.sponge.push(&cell.model, &PlantState::at_rest(q));
        for joint in 0..6 {
            let h = 1e-7;
            let moved = |by: f64| {
                let mut q = q;
                q[joint] += by;
                cell.energy(&q)
            };
            let slope = (moved(h) - moved(-h)) / (2.0 * h);
            let scale = push.torque.amax().max(0.1);
            prop_assert!((push.torque[joint] + slope).abs() < 1e-3 * scale, "{joint}: {} {slope}", push.torque[joint]);
        }
    }

    /// Damping takes energy and the foam never pulls: the power of damped less undamped torques is not positive.
    #[test]
    fn damping_only_removes_energy(
        surface in surfaces(),
        deep in 0.0..0.012_f64,
        speeds in prop::array::uniform6(-0.5..0.5_f64),
        damping in 0.0..500.0_f64,
    ) {
        let damped = cell(surface, FoamContact { stiffness_pa: 2e4, damping_pa_s: damping });
        let free = cell(surface, foam(2e4));
        let q = free.reach([0.03, 0.01, surface.height_m(0.03) - deep], [0.05, 0.02]).unwrap();
        let state = PlantState { q, qd: JointVector::from(speeds) };
        let [with, without] = [&damped, &free].map(|cell| cell.sponge.push(&cell.model, &state));
        prop_assert!((with.torque - without.torque).dot(&state.qd) <= 1e-12);
        prop_assert!(with.load.force_n >= 0.0);
    }
}

/// The arm let go over a plate.
struct Drop {
    /// Energy of arm, gravity and foam at every step over the lowest height that there was \[J\].
    energies_j: Vec<f64>,
    /// The greatest compression \[m\].
    deepest_m: f64,
    /// The most that foam ever did of work, all together, beyond what its energy had lost \[J\].
    unpaid_j: f64,
}

impl Drop {
    fn most_j(&self) -> f64 {
        self.energies_j.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The most of every 100 ms \[J\].
    fn windows_j(&self) -> Vec<f64> {
        let most = |window: &[f64]| window.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        self.energies_j.chunks(100).map(most).collect()
    }
}

/// It lands, folds up, slides off, and comes back from all sides; `contact` none: there is no plate.
fn dropped(surface: Surface, contact: Option<FoamContact>, integrator: Integrator, (steps, h): (usize, f64)) -> Drop {
    let cell = cell(surface, contact.unwrap_or(foam(2e4)));
    let plant = Plant::ideal(cell.model.clone(), integrator);
    let q = cell.reach([0.0, 0.0, 0.006 + surface.height_m(0.0)], [0.0; 2]).unwrap();
    let (mut state, mut all, mut lowest, mut deepest_m) = (PlantState::at_rest(q), Vec::new(), f64::INFINITY, 0.0_f64);
    let (mut unpaid_j, mut worked_j) = (0.0_f64, 0.0);
    for _ in 0..steps {
        let energy = cell.model.energy(&state.q, &state.qd);
        lowest = lowest.min(energy.potential_j);
        if contact.is_some() {
            let push = cell.sponge.push(&cell.model, &state);
            deepest_m = deepest_m.max(push.load.deepest_m);
            all.push(energy.kinetic_j + energy.potential_j + push.energy_j);
            let next = plant.step_on(&cell.sponge, &state, &JointVector::zeros(), h).0;
            // The work on the way, by the mean torque of its two ends.
            let then = cell.sponge.push(&cell.model, &next);
            worked_j += 0.5 * (push.torque + then.torque).dot(&(next.q - state.q));
            unpaid_j = unpaid_j.max(worked_j + then.energy_j);
            state = next;
        } else {
            all.push(energy.kinetic_j + energy.potential_j);
            state = plant.step(&state, &JointVector::zeros(), h).0;
        }
        assert!(state.q.amax() < 1e4, "{}", state.q);
    }
    Drop {
        energies_j: all.iter().map(|energy| energy - lowest).collect(),
        deepest_m,
        unpaid_j,
    }
}

fn plates_to_drop_on() -> [Surface; 2] {
    [Surface::Disc { radius_m: 0.3 }, Surface::shipped("coupe275").unwrap()]
}

#[test]
fn an_arm_that_is_dropped_on_a_plate_gains_no_energy() {
    for surface in plates_to_drop_on() {
        for pa in [11e3, 44e3] {
            let drop = dropped(surface, Some(foam(pa)), Integrator::Rk4, (10_000, 1e-3));
            let (start, most) = (drop.energies_j[0], drop.most_j());
            println!(
                "{pa} Pa: start {start:.3} J, most {most:.4} J, deepest {:.1} mm",
                1e3 * drop.deepest_m
            );
            assert!(drop.deepest_m > 0.005, "it lands");
            assert!(most <= 1.01 * start, "{most} {start}");
        }
    }
}

/// With damping it falls: no 100 ms hold more than those before, but for what Runge and Kutta's steps err by.
#[test]
fn an_arm_that_is_dropped_on_damped_foam_loses_energy_all_the_way() {
    for surface in plates_to_drop_on() {
        for pa in [11e3, 44e3] {
            let damped = FoamContact {
                damping_pa_s: 100.0,
                ..foam(pa)
            };
            let drop = dropped(surface, Some(damped), Integrator::Rk4, (10_000, 1e-3));
            let (start, windows) = (drop.energies_j[0], drop.windows_j());
            let rise = windows.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
            let end = windows[windows.len() - 1];
            println!("{pa} Pa, damped: start {start:.3} J, end {end:.3} J, greatest rise {rise:.5} J");
            assert!(drop.most_j() <= start * (1.0 + 1e-4));
            assert!(end < 0.999 * start && rise <= 1e-4 * start, "{rise}");
        }
    }
}

/// Semi-implicit Euler keeps energy to first order of the step only, and worse the faster the arm turns: the arm alone, with no plate, gains
/// half of what it has in 10 s at 1 kHz. Foam adds nothing to that: its work is paid for by its energy for all of 10 s; and as long as the
/// arm is slow enough for the steps, all is kept on it, too.
#[test]
fn euler_steps_add_energy_through_the_arm_and_not_the_foam() {
    let euler = Integrator::SemiImplicitEuler;
    let most = |energies: &[f64]| energies.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    for surface in plates_to_drop_on() {
        let alone = dropped(surface, None, euler, (10_000, 1e-3));
        assert!(alone.most_j() > 1.1 * alone.energies_j[0], "the arm alone gains");
        for pa in [11e3, 44e3] {
            let landing = dropped(surface, Some(foam(pa)), euler, (500, 1e-3));
            assert!(landing.deepest_m > 0.005 && landing.most_j() <= 1.01 * landing.energies_j[0]);
            let drop = dropped(surface, Some(foam(pa)), euler, (100_000, 1e-4));
            let start = drop.energies_j[0];
            let [two_s, ten_s] = [20_000, 100_000].map(|steps| most(&drop.energies_j[..steps]) / start);
            println!(
                "{pa} Pa: {two_s:.4} in 2 s, {ten_s:.4} in 10 s, foam adds {:.5} J",
                drop.unpaid_j
            );
            assert!(two_s <= 1.01, "{two_s}");
            assert!(drop.unpaid_j <= 1e-3 * start, "{}", drop.unpaid_j);
        }
    }
}

/// The slope that the limits on steps rest on is that of the torques, on a face where every column is compressed.
#[test]
fn the_slope_is_that_of_the_torques() {
    let cell = cell(Surface::Disc { radius_m: 0.145 }, foam(2e4));
    let q = cell.reach([0.05, 0.02, -0.003], [0.1, 0.05]).unwrap();
    let [slope, dense] = cell.sponge.slopes(&cell.model, &q, 0);
    let upright = cell.sponge.push(&cell.model, &PlantState::at_rest(q));
    assert!(upright.load.deepest_m < DENSE_STRAIN * 0.025);
    // Where the force is small its lever does not matter: the energy of no force is ½ δqᵀ S δq.
    let stiffest = slope.stiffness.symmetric_eigenvalues().max();
    let differences = nalgebra::Matrix6::from_fn(|i, j| {
        let h = 1e-5;
        let torque = |by: f64| {
            let mut q = q;
            q[j] += by;
            cell.sponge.push(&cell.model, &PlantState::at_rest(q)).torque[i]
        };
        (torque(-h) - torque(h)) / (2.0 * h)
    });
    assert!(
        (differences - slope.stiffness).amax() < 0.05 * stiffest,
        "{differences} {}",
        slope.stiffness
    );
    assert!((dense.stiffness - slope.stiffness * 20.0).amax() < 1e-9 * stiffest);
    for integrator in [Integrator::SemiImplicitEuler, Integrator::Rk4] {
        let mass = cell.model.mass_matrix(&q);
        let longest = longest_step_s(&mass, &dense, integrator);
        println!("{integrator:?}: {:.2} ms at 20 kPa, bottoming out", 1e3 * longest);
        assert!(longest > 1e-3);
    }
}
