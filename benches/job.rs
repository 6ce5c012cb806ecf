//! The certified job on one core: `kitchen`, bare and with obstacles that nothing comes near, stage by stage and whole, and the timing of smooth paths of two lengths.
//!
//!     cargo bench --bench job
#![allow(missing_docs)]

use criterion::{BenchmarkId, Criterion};
use platewash::kinematics::trig;
use platewash::planner::joint_path::{Ends, JointPath};
use platewash::planner::timing::{MotionLimits, TipLimits, time_optimal};
use platewash::{JointVector, RobotModel, Scenario, ToolFrame};
use platewash_problems::crowded::crowded;
use platewash_problems::stages::{Stage, Stages};
use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

/// Obstacles more, and what they keep from all that moves \[m\].
const OBSTACLES: usize = 50;
const FAR_M: f64 = 0.05;

fn main() -> Result<(), Box<dyn Error>> {
    // One thread, whatever the machine has.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let mut criterion = Criterion::default().configure_from_args();
    stages(&mut criterion)?;
    timing(&mut criterion)?;
    criterion.final_summary();
    Ok(())
}

fn stages(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let kitchen = Scenario::load("kitchen")?;
    let crowd = crowded(&kitchen, OBSTACLES, FAR_M)?;
    for (name, scenario) in [("kitchen", kitchen), ("kitchen with far obstacles", crowd)] {
        of_scenario(criterion, name, scenario)?;
    }
    Ok(())
}

fn of_scenario(criterion: &mut Criterion, name: &str, scenario: Scenario) -> Result<(), Box<dyn Error>> {
    let stages = Stages::of(scenario)?;
    let mut group = criterion.benchmark_group(name);
    group.sample_size(20).measurement_time(Duration::from_secs(4));
    for (stage, name) in Stage::ALL {
        // Beforehand once, so that an error ends the benchmark.
        stages.run(stage)?;
        group.bench_function(name, |b| b.iter(|| stages.run(stage)));
    }
    group.finish();
    Ok(())
}

fn timing(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let robot = RobotModel::irb120()?;
    let tip = robot.tool_frame(ToolFrame::Flange)?;
    let joints = MotionLimits {
        velocity: robot.limits().velocity,
        acceleration: JointVector::new(4.0, 4.0, 4.0, 5.0, 5.0, 6.0),
        tip: None,
    };
    let with_tip = MotionLimits {
        tip: Some(TipLimits {
            speed_m_s: 0.25,
            acceleration_m_s2: 4.0,
        }),
        ..joints
    };
    let mut group = criterion.benchmark_group("timing");
    for (limits, name) in [(joints, "limits of the joints"), (with_tip, "and of the tip")] {
        for samples in [100, 1000] {
            let path = waves(samples)?;
            // Beforehand once, so that an error ends the benchmark.
            time_optimal(&path, &robot, &tip, &limits)?;
            group.bench_with_input(BenchmarkId::new(name, samples), &path, |b, path| {
                b.iter(|| black_box(time_optimal(path, &robot, &tip, &limits)));
            });
        }
    }
    group.finish();
    Ok(())
}

/// A smooth path on which every joint turns a few times.
fn waves(samples: u32) -> Result<JointPath, Box<dyn Error>> {
    let u: Vec<f64> = (0..samples).map(|k| f64::from(k) / f64::from(samples - 1)).collect();
    let q = u
        .iter()
        .map(|u| JointVector::from_fn(|joint, _| 0.5 * trig::sin((4.0 + 3.0 * joint as f64) * u + 0.7 * joint as f64)));
    let q = q.collect();
    Ok(JointPath::through(u, q, Ends::NotAKnot)?)
}
