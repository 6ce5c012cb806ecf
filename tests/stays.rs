//! What the holder of a plate takes, at the states of simulated washes: the load summed over dense columns, never above the proved bounds.
//!
//! `PLATEWASH_THOROUGH=1 cargo test --release -p platewash --test main stays -- --nocapture` simulates 100 washes and prints the shares.

use nalgebra::{Vector2, Vector3};
use platewash::certificate::prove;
use platewash::planner::{Watch, plan_here};
use platewash::workcell::plate::Plate;
use platewash::workcell::random::stream;
use platewash::workcell::simulation::ControlLawName;
use platewash::workcell::surface::Surface;
use platewash::{CancelToken, Plan, RobotModel, Scenario, simulate};
use platewash_fixtures::is_thorough;
use rand::RngExt;
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Columns across the sponge.
const ACROSS: i32 = 28;

/// Samples between two that are looked at.
const EVERY: usize = 8;

fn any(random: &mut Pcg64, [least, most]: [f64; 2]) -> f64 {
    least + (most - least) * random.random::<f64>()
}

/// A wash of one plate somewhere before the arm, with a sponge of some stiffness and size.
fn scenario(seed: u64) -> Scenario {
    let random = &mut stream(seed, "stays");
    let bases = ["kitchen", "rim", "dessert", "deep", "coupe"];
    let mut scenario = Scenario::load(bases[random.random_range(0..bases.len())]).unwrap();
    if scenario.layout.plate_radius_m.is_some() {
        scenario.layout.plate_radius_m = Some(any(random, [0.07, 0.145]));
    }
    let (azimuth, rho_m) = (any(random, [-90.0, 90.0]).to_radians(), any(random, [0.34, 0.44]));
    scenario.layout.positions_m = Some(vec![[rho_m * azimuth.cos(), rho_m * azimuth.sin()]]);
    let tool = &mut scenario.tool;
    tool.sponge_compression_m *= any(random, [0.8, 1.1]);
    let softest = any(random, [6.0, 15.0]);
    tool.sponge_stiffness_kpa = Some([softest, softest * any(random, [1.5, 4.0])]);
    let wash = &mut scenario.wash;
    (wash.contact_share, wash.contact_time_share, wash.contact_dose_share) = (Some(0.9), Some(0.5), Some(0.5));
    (wash.contact_time_s, wash.contact_dose_pa_m, wash.contact_force_n) = (Some(0.01), Some(1.0), Some([0.0, 300.0]));
    scenario.job.required_coverage = 0.9;
    scenario
}

/// Height, and sin β, of a face at a distance from its axis, from its knots: sin β is linear between two of them.
fn face(plate: &Plate, rho: f64) -> [f64; 2] {
    let Surface::Profile(meridian) = &plate.surface else {
        return [0.0; 2];
    };
    let (mut height, mut before) = (0.0, [0.0, 0.0]);
    for knot in meridian.knots() {
        let here = [knot.radius_m, knot.slope_rad.sin()];
        let end = rho.min(here[0]);
        let sine = before[1] + (here[1] - before[1]) * (end - before[0]) / (here[0] - before[0]);
        // Δz = Δρ (s₀ + s)/(c₀ + c) along an arc.
        let cosine = |s: f64| (1.0 - s * s).sqrt();
        height += (end - before[0]) * (before[1] + sine) / (cosine(before[1]) + cosine(sine));
        if rho <= here[0] {
            return [height, sine];
        }
        before = here;
    }
    let [_, sine] = before;
    [height + (rho - before[0]) * sine / (1.0 - sine * sine).sqrt(), sine]
}

/// The load on a plate that lies higher by `raised_m`, for a friction against the sliding of each column: across the axis \[N\], about it
/// \[N·m\], for friction 0.3 and 1.
fn load(plan: &Plan, raised_m: f64, robot: &RobotModel, q: [&platewash::JointVector; 2]) -> [[f64; 2]; 2] {
    let (tool, plate) = (&plan.job.workcell.tool, &plan.job.plates[0]);
    let frame = tool.tip_frame(robot);
    let [(tip, turn), (next, turned)] = q.map(|q| {
        let pose = plate.pose.inverse() * robot.pose(q, &frame);
        (pose.translation.vector - Vector3::z() * raised_m, pose.rotation)
    });
    let (a, moved, spun) = (turn * Vector3::z(), next - tip, (turned * turn.inverse()).scaled_axis());
    let (u, sponge) = (turn * Vector3::x(), &tool.sponge);
    let v = a.cross(&u);
    let (s, c) = (sponge.radius_m, sponge.compression_m);
    let free_m = sponge.height_m + c;
    let [_, stiffest] = sponge.stiffness_pa.unwrap();
    let ds = 2.0 * s / f64::from(ACROSS);
    let mut all = [
        [Vector2::<f64>::zeros(), Vector2::zeros()],
        [Vector2::zeros(), Vector2::zeros()],
    ];
    for i in 0..ACROSS {
        for j in 0..ACROSS {
            let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) * ds - s);
            if x * x + y * y > s * s {
                continue;
            }
            let start = tip + u * x + v * y;
            // The column meets the face where its height over it is 0: it is above at −c, and a tool that is nearly upright meets it once.
            let over = |along: f64| {
                let point = start + a * along;
                point.z - face(plate, point.xy().norm())[0]
            };
            let [mut near, mut far] = [-free_m, c];
            if over(far) >= 0.0 {
                continue;
            }
            for _ in 0..26 {
                let middle = 0.5 * (near + far);
                if over(middle) > 0.0 {
                    near = middle
                } else {
                    far = middle
                }
            }
            let point = start + a * near;
            let rho = point.xy().norm();
            if rho > plate.rim_m() {
                continue;
            }
            let [_, sine] = face(plate, rho);
            let out = if rho > 0.0 { point.xy() / rho } else { Vector2::x() };
            let normal = Vector3::new(-sine * out.x, -sine * out.y, (1.0 - sine * sine).sqrt());
            let pressed = stiffest * (c - near) / free_m * ds * ds / -normal.dot(&a);
            let slides = moved + spun.cross(&(point - tip));
            let along = slides - normal * slides.dot(&normal);
            let drag = if along.norm() > 0.0 {
                along.normalize()
            } else {
                Vector3::zeros()
            };
            for (friction, [sum, turned]) in [0.3, 1.0].into_iter().zip(&mut all) {
                let force = (drag * friction - normal) * pressed;
                *sum += force.xy();
                turned.x += point.xy().perp(&force.xy());
            }
        }
    }
    all.map(|[sum, turned]| [sum.norm(), turned.x.abs()])
}

/// The greatest shares of the proved bounds that one simulated wash reaches: across the axis and about it; `None` for a job that is not planned.
fn shares(seed: u64) -> Option<[f64; 2]> {
    let scenario = scenario(seed);
    let arm = scenario.arm().ok()?;
    let cancel = CancelToken::new();
    let watch = Watch::silent(&cancel);
    let layout = scenario.place(&arm, &watch).ok()?;
    let planned = plan_here(&scenario.job_on(&arm, &layout).ok()?, &watch).ok()?;
    let plan = planned.plan;
    let certificate = prove(&plan, &arm).unwrap();
    let bounds = certificate.contact.first()?.holder_load?;
    assert_eq!(bounds.sponge_friction, [0.3, 1.0]);
    let mut settings = plan.job.simulation.clone();
    settings.law = ControlLawName::ComputedTorque;
    let execution = simulate(&plan, &arm, &settings).unwrap();
    // As far as the arm strays from its plan, the plate lies lower than it may.
    let frame = plan.job.workcell.tool.tip_frame(&arm);
    let tip = |q: &platewash::JointVector| arm.pose(q, &frame).translation.vector;
    let over = |q: &platewash::JointVector| {
        let near = plan.job.plates[0].local(&tip(q));
        near.z - face(&plan.job.plates[0], near.xy().norm())[0]
    };
    let at_plate: Vec<_> = (0..execution.samples.len() - 1)
        .filter(|i| over(&execution.samples[*i].state.q) < 0.01)
        .collect();
    let strays = at_plate.iter().map(|i| {
        let sample = &execution.samples[*i];
        (over(&sample.state.q) - over(&sample.commanded)).abs()
    });
    let error_m = plan.job.contact_of(&plan.job.plates[0]).unwrap().height_error_m;
    let raised_m = (error_m - 2.0 * strays.fold(0.0, f64::max)).max(0.0);
    let mut most = [0.0_f64; 2];
    for i in at_plate.iter().step_by(EVERY) {
        let [from, to] = [0, 1].map(|k| &execution.samples[i + k].state.q);
        let found = load(&plan, raised_m, &arm, [from, to]);
        for (k, [across_n, about_nm]) in found.into_iter().enumerate() {
            let of = [across_n / bounds.lateral_n[k], about_nm / bounds.torque_nm[k]];
            assert!(
                of.iter().all(|share| *share <= 1.0),
                "seed {seed}: {found:?} {bounds:?}"
            );
            most = [most[0].max(of[0]), most[1].max(of[1])];
        }
    }
    println!(
        "{seed}: {} raised by {:.2} mm, {:.3} of the force, {:.3} of the torque",
        scenario.name,
        1e3 * raised_m,
        most[0],
        most[1]
    );
    Some(most)
}

#[test]
fn simulated_washes_load_the_holder_no_more_than_proved() {
    let wanted = if is_thorough() { 100 } else { 12 };
    let (mut found, mut seed) = (Vec::new(), 0);
    while found.len() < wanted {
        let seeds = seed..seed + (wanted - found.len()) as u64;
        seed = seeds.end;
        assert!(seed < 10 * wanted as u64, "most jobs are planned");
        found.extend(seeds.into_par_iter().filter_map(shares).collect::<Vec<_>>());
    }
    let most = found
        .iter()
        .fold([0.0_f64; 2], |most, of| [most[0].max(of[0]), most[1].max(of[1])]);
    println!(
        "{} washes, of {seed} jobs: at most {:.3} of the force, {:.3} of the torque",
        found.len(),
        most[0],
        most[1]
    );
    // So that a bound too small would be noticed.
    assert!(most.iter().all(|most| *most > 0.7), "{most:?}");
}
