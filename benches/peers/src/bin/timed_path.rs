//! Times a path of the joints again and again, on demand: for `benches/peers/timing_against_toppra.py`, which takes turns
//! with it.
//!
//! The first line of standard input is the path as JSON, `u`, `q_rad`, `velocity_rad_s` and `acceleration_rad_s2`; every
//! further line asks for one timing and is answered by a line, the nanoseconds that it took and the motion's duration \[s\].

use nalgebra::Vector6;
use platewash_kinematics::{RobotModel, ToolFrame};
use platewash_planner::joint_path::{Ends, JointPath};
use platewash_planner::timing::{MotionLimits, time_optimal};
use serde::Deserialize;
use std::error::Error;
use std::io::{BufRead, Write};
use std::time::Instant;

#[derive(Deserialize)]
struct Work {
    u: Vec<f64>,
    q_rad: Vec<[f64; 6]>,
    velocity_rad_s: [f64; 6],
    acceleration_rad_s2: [f64; 6],
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut lines = std::io::stdin().lock().lines();
    let work: Work = serde_json::from_str(&lines.next().ok_or("no path on standard input")??)?;
    let robot = RobotModel::irb120()?;
    let tip = robot.tool_frame(ToolFrame::Flange)?;
    let limits = MotionLimits {
        velocity: work.velocity_rad_s.into(),
        acceleration: work.acceleration_rad_s2.into(),
        tip: None,
    };
    let mut out = std::io::stdout().lock();
    for line in lines {
        line?;
        let start = Instant::now();
        let q = work.q_rad.iter().copied().map(Vector6::from).collect();
        let path = JointPath::through(work.u.clone(), q, Ends::NotAKnot)?;
        let timed = time_optimal(&path, &robot, &tip, &limits)?;
        let spent = start.elapsed();
        writeln!(out, "{} {}", spent.as_nanos(), timed.motion.duration_s())?;
        out.flush()?;
    }
    Ok(())
}
