//! Transits past walls: each planned and proved alone, as JSON for `benches/peers/transits_against_ompl.py`, and in a few words on
//! standard error.
//!
//!     cargo run --release --manifest-path benches/peers/Cargo.toml --bin wall_transits -- 100 > transits.json
//!
//! The argument is the number of walls beside which both plates can be washed; where one cannot, there is no transit, and the next wall is
//! taken.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use nalgebra::Vector3;
use platewash_benches::scene::scene;
use platewash_kinematics::JointVector;
use platewash_planner::PlanError;
use platewash_problems::transits::{AloneTransit, transits_alone};
use platewash_problems::walls::{WALL, walled};
use platewash_bodies::job::WashJob;
use serde_json::{Value, json};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // One thread, whatever the machine has.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let wanted: usize = std::env::args().nth(1).ok_or("how many walls?")?.parse()?;
    let (mut cells, mut spent_ms, mut unwashable, mut unsolved) = (Vec::new(), Vec::new(), 0, 0);
    for wall in 1.. {
        if cells.len() == wanted {
            break;
        }
        let job = walled(wall)?.job()?;
        let transits = match transits_alone(&job) {
            Ok(transits) => transits,
            Err(error) if is_without_washes(&*error) => {
                unwashable += 1;
                continue;
            }
            Err(error) => {
                eprintln!("wall {wall}: {error}");
                unsolved += 1;
                Vec::new()
            }
        };
        let past: Vec<_> = transits.iter().filter(|transit| goes_past(&job, transit)).collect();
        spent_ms.extend(past.iter().map(|t| ms(t.planning) + ms(t.proving)));
        cells.push(json!({
            "wall": wall,
            "scene": scene(&job)?,
            "transits": past.into_iter().map(as_json).collect::<Vec<_>>(),
        }));
    }
    spent_ms.sort_by(f64::total_cmp);
    let quantile = |share: f64| {
        spent_ms
            .get((share * spent_ms.len() as f64) as usize)
            .copied()
            .unwrap_or(f64::NAN)
    };
    eprintln!(
        "{} transits past {wanted} walls planned and proved; median {:.1} ms, 90 % within {:.1} ms; {unsolved} cells without one of their \
         transits; passed over: {unwashable} walls beside which a plate was not found to be washable",
        spent_ms.len(),
        quantile(0.5),
        quantile(0.9),
    );
    println!("{}", json!(cells));
    Ok(())
}

/// Whether a plate cannot be washed, so that no transit was looked for.
fn is_without_washes(error: &(dyn Error + 'static)) -> bool {
    matches!(error.downcast_ref::<PlanError>(), Some(error) if !matches!(error, PlanError::Transit(_)))
}

/// Whether the tip is on either side of the wall at the ends.
fn goes_past(job: &WashJob, transit: &AloneTransit) -> bool {
    let terms = job.seen_from_base();
    let Some(wall) = terms.workcell.obstacles.iter().find(|obstacle| obstacle.name == WALL) else {
        return false;
    };
    let tip = terms.workcell.tool.tip_frame(job.arm());
    let across = wall.pose.rotation * Vector3::y();
    let side = |q: &JointVector| across.dot(&(job.arm().fk(q).rigid(&tip).translation - wall.pose.translation.vector));
    let [from, to] = transit.tops.each_ref().map(side);
    from * to < 0.0
}

fn ms(duration: std::time::Duration) -> f64 {
    1e3 * duration.as_secs_f64()
}

fn as_json(transit: &AloneTransit) -> Value {
    json!({
        "from": transit.from,
        "to": transit.to,
        "tops_rad": transit.tops.each_ref().map(|q| q.as_slice().to_vec()),
        "planning_ms": ms(transit.planning),
        "proving_ms": ms(transit.proving),
        "proved": transit.is_proved,
    })
}
