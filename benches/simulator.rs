//! Dynamics, a step of the plant, and the whole kitchen under its law, on one core.
//!
//!     cargo bench --bench simulator
//!
//! The kitchen lasts some 33 s: divided by the times of `kitchen executed`, it is the factor over real time, the foam of its sponge
//! included. Nobody else simulates such a job in Rust; MuJoCo and Pinocchio are measured from Python.
#![allow(missing_docs)]

use criterion::{Criterion, Throughput};
use platewash::simulator::dynamics::spread;
use platewash::simulator::{DynamicsModel, Plant, PlantState};
use platewash::workcell::simulation::{ControlLawName, Integrator, SimulationSettings};
use platewash::{JointVector, Scenario, SimulationReport, plan, simulate};
use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

/// States that a benchmark goes round, so that no branch is learnt by heart.
const STATES: u32 = 256;

/// Steps in one call, as MuJoCo is measured.
const STEPS: u64 = 1000;

fn dynamics(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let job = Scenario::load("kitchen")?.job()?;
    let model = DynamicsModel::new(job.arm(), Some(&job.terms().workcell.tool))?;
    let states: Vec<JointVector> = spread(job.arm().limits(), STATES).collect();
    let (qd, qdd) = (JointVector::repeat(0.5), JointVector::repeat(2.0));
    let mut group = criterion.benchmark_group("dynamics");
    group.throughput(Throughput::Elements(u64::from(STATES)));
    group.bench_function("inverse dynamics", |b| {
        b.iter(|| {
            for q in &states {
                black_box(model.inverse_dynamics(q, &qd, &qdd));
            }
        });
    });
    group.bench_function("mass matrix", |b| {
        b.iter(|| {
            for q in &states {
                black_box(model.mass_matrix(q));
            }
        });
    });
    group.bench_function("forward dynamics", |b| {
        b.iter(|| {
            for q in &states {
                black_box(model.forward_dynamics(q, &qd, &qdd));
            }
        });
    });
    group.finish();
    let mut group = criterion.benchmark_group("plant");
    group.throughput(Throughput::Elements(STEPS));
    for (name, integrator) in [
        ("semi-implicit Euler", Integrator::SemiImplicitEuler),
        ("Runge-Kutta", Integrator::Rk4),
    ] {
        let plant = Plant::ideal(model.clone(), integrator);
        let torque = model.gravity_torque(&states[0]);
        group.bench_function(name, |b| {
            b.iter(|| {
                let start = PlantState::at_rest(states[0]);
                black_box((0..STEPS).fold(start, |state, _| plant.step(&state, &torque, 1e-3).0))
            });
        });
    }
    group.finish();
    Ok(())
}

fn kitchen(criterion: &mut Criterion) -> Result<(), Box<dyn Error>> {
    let job = Scenario::load("kitchen")?.job()?;
    let (arm, plan) = (job.arm(), plan(&job)?.plan);
    let mut group = criterion.benchmark_group("kitchen executed");
    group.sample_size(10).measurement_time(Duration::from_secs(4));
    for law in [
        ControlLawName::Pd,
        ControlLawName::PdGravity,
        ControlLawName::ComputedTorque,
    ] {
        let settings = SimulationSettings {
            law,
            ..plan.job.simulation.clone()
        };
        group.bench_function(law.name(), |b| b.iter(|| black_box(simulate(&plan, arm, &settings))));
    }
    let settings = &plan.job.simulation;
    let execution = simulate(&plan, arm, settings)?;
    group.bench_function("report with coverage", |b| {
        b.iter(|| black_box(SimulationReport::new(&plan, arm, settings, &execution)));
    });
    group.finish();
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    // One thread, whatever the machine has.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let mut criterion = Criterion::default().configure_from_args();
    dynamics(&mut criterion)?;
    kitchen(&mut criterion)?;
    criterion.final_summary();
    Ok(())
}
