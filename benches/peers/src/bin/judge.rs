//! Judges our answers by others' on poses anywhere and at every edge, and freedom in the task by brute force.
//!
//!     cargo run --release --manifest-path benches/peers/Cargo.toml --bin judge
#![allow(clippy::print_stdout)]

use platewash_benches::edges::{self, Case};
use platewash_benches::judged::{Call, Court, Tally};
use platewash_benches::plain_fk::PlainArm;
use platewash_benches::tilts;
use platewash_kinematics::ik::{GeneralizedTask, IkSettings, IkSolver, TaskFreedom};
use platewash_kinematics::{RobotModel, ToolFrame};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::error::Error;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::Instant;

const THREADS: usize = 2;
/// Cases to a unit of work; each unit has its own random stream, so that the threads don't matter.
const UNIT: usize = 10_000;

type Maker = fn(&RobotModel, &PlainArm, &mut Pcg64) -> Case;

fn main() -> Result<(), Box<dyn Error>> {
    let robot = RobotModel::irb120()?;
    nearness(&robot, 1_000_000);
    verdicts("random poses", &robot, edges::anywhere, 1_000_000, 1_000);
    verdicts("edges", &robot, edges::at_an_edge, 100_000, 2_000);
    generalized(&robot)
}

/// Does `units` units of work on all threads and gathers their results.
fn parallel<T: Send>(robot: &RobotModel, units: usize, work: impl Fn(&Court<'_>, usize) -> T + Sync) -> Vec<T> {
    let (next, results) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let take = || {
        let Ok(court) = Court::new(robot) else { return };
        loop {
            let unit = next.fetch_add(1, Relaxed);
            if unit >= units {
                return;
            }
            let result = work(&court, unit);
            if let Ok(mut all) = results.lock() {
                all.push((unit, result));
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(take);
        }
    });
    let mut all = results.into_inner().unwrap_or_default();
    all.sort_by_key(|(unit, _)| *unit);
    all.into_iter().map(|(_, result)| result).collect()
}

fn nearness(robot: &RobotModel, count: usize) {
    let clock = Instant::now();
    let plain = PlainArm::default();
    let counts = parallel(robot, count / UNIT, |court, unit| {
        let mut rng = Pcg64::seed_from_u64(unit as u64);
        let (mut made, mut met, mut further) = (0, [0; 3], 0);
        while made < UNIT {
            let case = edges::anywhere(robot, &plain, &mut rng);
            if case.witness.is_none() {
                continue;
            }
            let nearness = court.nearest_of_all(&case);
            made += 1;
            further += usize::from(nearness.further);
            for (total, met) in met.iter_mut().zip(nearness.met) {
                *total += usize::from(met);
            }
        }
        (met, further)
    });
    let total = |solver: usize| counts.iter().map(|(met, _)| met[solver]).sum::<usize>();
    let further: usize = counts.iter().map(|(_, further)| further).sum();
    println!("\n{count} reachable poses, nearest branch to 1e-9 m and 1e-9 rad within the limits\n");
    println!("| solver | solved |\n| --- | ---: |");
    for (solver, name) in ["platewash `nearest`", "rs-opw-kinematics", "ik-geo"]
        .iter()
        .enumerate()
    {
        println!("| {name} | {} |", total(solver));
    }
    println!(
        "\nours further from the start than another's answer: {further}; {:.0} s",
        clock.elapsed().as_secs_f64()
    );
}

fn verdicts(title: &str, robot: &RobotModel, make: Maker, count: usize, stream: u64) {
    let plain = PlainArm::default();
    for (call, name) in [(Call::Nearest, "nearest"), (Call::Solve, "solve")] {
        let clock = Instant::now();
        let tallies = parallel(robot, count / UNIT, |court, unit| {
            let mut rng = Pcg64::seed_from_u64(stream + unit as u64);
            let mut tally = Tally::default();
            for _ in 0..UNIT {
                court.judge(&make(robot, &plain, &mut rng), call, &mut tally);
            }
            tally
        });
        let mut all = Tally::default();
        tallies.into_iter().for_each(|tally| all.add(tally));
        println!("\n{count} {title}, `{name}`, {:.0} s\n", clock.elapsed().as_secs_f64());
        println!("| poses | verdict | count |\n| --- | --- | ---: |");
        for ((kind, verdict), count) in &all.counts {
            println!("| {kind} | {verdict} | {count} |");
        }
        for (verdict, cases) in &all.written {
            println!("\n{verdict}, e.g.");
            cases.iter().for_each(|case| println!("- {case}"));
        }
    }
}

fn generalized(robot: &RobotModel) -> Result<(), Box<dyn Error>> {
    let clock = Instant::now();
    let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
    let solver = IkSolver::new(robot, tool0, IkSettings::default())?;
    let poses = tilts::poses(&solver);
    let outcomes = parallel(robot, poses.len(), |_, case| {
        let target = &poses[case];
        let asked = GeneralizedTask {
            freedom: TaskFreedom::cone(tilts::CONE_RAD),
            motion_rad: None,
            clearance: None,
        };
        let answer = solver.solve_generalized(target, &tilts::start(), &asked);
        let met = answer
            .as_ref()
            .map(|a| tilts::met(robot, &robot.pose(&a.q, &tool0), target, &a.q));
        let possible = tilts::brute_force(robot, &solver, target);
        (met.unwrap_or(false), answer.is_ok(), possible)
    });
    let count = |which: fn(&(bool, bool, bool)) -> bool| outcomes.iter().filter(|o| which(o)).count();
    println!(
        "\n{} poses outside the tool-down reach, 15° cone, {:.0} s\n",
        poses.len(),
        clock.elapsed().as_secs_f64()
    );
    println!("| outcome | poses |\n| --- | ---: |");
    println!(
        "| possible by brute force at 0.1° with 0.2° to spare | {} |",
        count(|o| o.2)
    );
    println!("| solved | {} |", count(|o| o.0));
    println!("| wrong answers | {} |", count(|o| o.1 && !o.0));
    println!("| possible but not solved | {} |", count(|o| o.2 && !o.0));
    println!("| solved beyond what brute force finds | {} |", count(|o| o.0 && !o.2));
    Ok(())
}
