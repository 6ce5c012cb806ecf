//! The certified job `kitchen`, stage by stage and whole, on one core.
//!
//!     cargo bench -p platewash-benches --bench cycle
#![allow(missing_docs)]

use criterion::Criterion;
use nalgebra::Vector3;
use platewash_planner::certificate;
use platewash_planner::clearance::ClearanceModel;
use platewash_planner::cycle::Cycle;
use platewash_planner::job;
use platewash_planner::joint_path::{Ends, JointPath};
use platewash_planner::plan::Plan;
use platewash_planner::posture::{Cell, PostureSettings, washing};
use platewash_planner::robot;
use platewash_planner::scenario::Scenario;
use platewash_planner::stroke::Stroke;
use platewash_planner::timing::{self, MotionLimits, TipLimits};
use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

fn stages(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let scenario = Scenario::load("kitchen")?;
    let robot = robot::load(&scenario.robot)?;
    let layout = job::place_plates(&scenario, &robot)?;
    let clearance = ClearanceModel::new(&robot, &scenario.tool, &layout.plates)?;
    let cell = Cell::new(&robot, &scenario.tool, &clearance, &layout.plates)?;
    let plate = layout.plates[0];
    let centre = Vector3::new(plate.x_m, plate.y_m, plate.z_m);
    let stroke = Stroke {
        radius_m: scenario.wash.path_radius_m,
        turns: scenario.wash.turns,
        start_angle_rad: 0.0,
        closing_ring: true,
    };
    let settings = PostureSettings {
        tilt_max_rad: scenario.wash.tilt_max_deg.to_radians(),
        clearance_m: scenario.wash.clearance_m,
    };
    let [home, _] = scenario.homes();
    let posture = || washing(&cell, &stroke, centre, 0, &settings, &home);
    let washed = posture()?;
    let path = JointPath::through(washed.theta, washed.q, Ends::Clamped(washed.end_slopes))?;
    let limits = MotionLimits {
        velocity: robot.limits().velocity,
        acceleration: scenario.limits.joint_acceleration_rad_s2.into(),
        tip: Some(TipLimits {
            speed_m_s: scenario.wash.speed_m_s,
            acceleration_m_s2: scenario.wash.acceleration_m_s2,
        }),
    };
    let cycle = Cycle::plan(&scenario)?;
    let plan = cycle.to_plan()?;
    let text = plan.to_json()?;
    let mut group = criterion.benchmark_group("kitchen");
    group.sample_size(20).measurement_time(Duration::from_secs(4));
    group.bench_function("layout", |b| b.iter(|| black_box(job::place_plates(&scenario, &robot))));
    group.bench_function("posture of one plate", |b| b.iter(|| black_box(posture())));
    let tip = robot::tip_frame(&robot, &scenario.tool);
    group.bench_function("timing of one wash", |b| {
        b.iter(|| black_box(timing::time_optimal(&path, &robot, &tip, &limits)));
    });
    group.bench_function("plan, whole cycle", |b| b.iter(|| black_box(Cycle::plan(&scenario))));
    group.bench_function("seal and write", |b| {
        b.iter(|| black_box(cycle.to_plan().and_then(|plan| plan.to_json())));
    });
    group.bench_function("read", |b| b.iter(|| black_box(Plan::from_json(&text))));
    group.bench_function("verify", |b| b.iter(|| black_box(certificate::verify(&plan, &robot))));
    group.finish();
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    // One thread, whatever the machine has.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let mut criterion = Criterion::default().configure_from_args();
    stages(&mut criterion)?;
    criterion.final_summary();
    Ok(())
}
