//! Times dynamics, steps of the plant and the whole kitchen again and again, on demand: for
//! `benches/peers/dynamics_against_others.py`, which takes turns with it.
//!
//! The first line of standard input is the work as JSON: `plan`, the path of a plan of the built-in arm; `q`, `qd` and `qdd`, as
//! many states; `steps` of 1 ms. Every further line asks for one round of `inverse`, `forward` (the third column as torques),
//! `mass`, `step` (from the first state, without torque) or `kitchen`, and is answered by a line: the nanoseconds that one call, one
//! step or the whole plan took, and the six numbers of the last result.

use nalgebra::Vector6;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_simulator::{DynamicsModel, Plant, PlantState, simulate};
use platewash_motion::plan::Plan;
use platewash_workcell::simulation::Integrator;
use serde::Deserialize;
use std::error::Error;
use std::hint::black_box;
use std::io::{BufRead, Write};
use std::time::Instant;

#[derive(Deserialize)]
struct Work {
    plan: String,
    q: Vec<[f64; 6]>,
    qd: Vec<[f64; 6]>,
    qdd: Vec<[f64; 6]>,
    steps: u32,
}

/// What is timed.
struct Bench {
    robot: RobotModel,
    plan: Plan,
    model: DynamicsModel,
    states: Vec<[JointVector; 3]>,
    steps: u32,
}

impl Bench {
    fn new(work: &Work) -> Result<Self, Box<dyn Error>> {
        let robot = RobotModel::irb120()?;
        let plan = Plan::from_json(&std::fs::read_to_string(&work.plan)?)?;
        let model = DynamicsModel::new(&robot, Some(&plan.job.workcell.tool))?;
        let rows = work.q.iter().zip(&work.qd).zip(&work.qdd);
        Ok(Self {
            robot,
            plan,
            model,
            states: rows
                .map(|((q, qd), qdd)| [q, qd, qdd].map(|row| Vector6::from(*row)))
                .collect(),
            steps: work.steps,
        })
    }

    /// Nanoseconds of one call on average, and the result of the last one.
    fn each(&self, call: impl Fn(&[JointVector; 3]) -> JointVector) -> (f64, JointVector) {
        let start = Instant::now();
        let last = self.states.iter().map(|state| black_box(call(black_box(state)))).last();
        let spent = start.elapsed().as_nanos() as f64 / self.states.len() as f64;
        (spent, last.unwrap_or_default())
    }

    fn step(&self) -> (f64, JointVector) {
        let plant = Plant::ideal(self.model.clone(), Integrator::SemiImplicitEuler);
        let [q, qd, _] = self.states[0];
        let torque = black_box(JointVector::zeros());
        let start = Instant::now();
        let end = (0..self.steps).fold(PlantState { q, qd }, |state, _| plant.step(&state, &torque, 1e-3).0);
        (start.elapsed().as_nanos() as f64 / f64::from(self.steps), end.q)
    }

    fn kitchen(&self) -> Result<(f64, JointVector), Box<dyn Error>> {
        let start = Instant::now();
        let execution = simulate(&self.plan, &self.robot, &self.plan.job.simulation)?;
        let spent = start.elapsed().as_nanos() as f64;
        Ok((
            spent,
            execution
                .samples
                .last()
                .map_or_else(JointVector::zeros, |sample| sample.state.q),
        ))
    }

    fn round(&self, asked: &str) -> Result<(f64, JointVector), Box<dyn Error>> {
        Ok(match asked {
            "inverse" => self.each(|[q, qd, qdd]| self.model.inverse_dynamics(q, qd, qdd)),
            "forward" => self.each(|[q, qd, torque]| self.model.forward_dynamics(q, qd, torque)),
            "mass" => self.each(|[q, ..]| self.model.mass_matrix(q).column(0).into()),
            "step" => self.step(),
            "kitchen" => self.kitchen()?,
            other => return Err(format!("no work is called '{other}'").into()),
        })
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut lines = std::io::stdin().lock().lines();
    let work: Work = serde_json::from_str(&lines.next().ok_or("no work on standard input")??)?;
    let bench = Bench::new(&work)?;
    let mut out = std::io::stdout().lock();
    for line in lines {
        let (spent, last) = bench.round(line?.trim())?;
        let last: Vec<_> = last.iter().map(ToString::to_string).collect();
        writeln!(out, "{spent} {}", last.join(" "))?;
        out.flush()?;
    }
    Ok(())
}
