//! The spiral of before: where neither rings nor a promise about contact are asked for, the arm washes as it always did.
//!
//! `tests/golden/spiral-knots.json` holds wash knots of the program of before; `spiral_knots.py` beside it wrote them.

use platewash::motion::plan::Plan;
use platewash::motion::trajectory::SegmentKind;
use platewash::{Scenario, plan};
use serde::Deserialize;

/// How far joints may be from before \[rad\], and knots \[s\].
const APART: f64 = 1e-9;

#[derive(Deserialize)]
struct GoldenKnots {
    /// Every so manieth knot is stated.
    every: usize,
    washes: Vec<Wash>,
}

#[derive(Deserialize)]
struct Wash {
    seed: u64,
    plate: usize,
    /// Knots in all.
    knots: usize,
    /// t since the wash began \[s\], then q \[rad\].
    t_s_q_rad: Vec<[f64; 7]>,
}

fn planned(seed: u64) -> Plan {
    let scenario = Scenario {
        seed,
        ..Scenario::load("kitchen-spiral").unwrap()
    };
    plan(&scenario.job().unwrap()).unwrap().plan
}

/// Every so manieth knot of the washes of a plan, as the file states them.
fn washes(seed: u64, every: usize) -> Vec<Wash> {
    let plan = planned(seed);
    let of_wash = plan.segments.iter().filter(|segment| segment.kind == SegmentKind::Wash);
    let wash = of_wash.map(|segment| {
        let inside = |t: &f64| (segment.t_start_s..=segment.t_end_s).contains(t);
        let within: Vec<_> = (0..plan.knots.t_s.len())
            .filter(|&k| inside(&plan.knots.t_s[k]))
            .collect();
        let row = |&k: &usize| {
            let mut row = [plan.knots.t_s[k] - segment.t_start_s; 7];
            row[1..].copy_from_slice(plan.knots.q_rad[k].as_slice());
            row
        };
        Wash {
            seed,
            plate: segment.plate,
            knots: within.len(),
            t_s_q_rad: within.iter().step_by(every).map(row).collect(),
        }
    });
    wash.collect()
}

#[test]
fn the_spiral_is_washed_as_before() {
    let golden: GoldenKnots = serde_json::from_str(include_str!("golden/spiral-knots.json")).unwrap();
    let found: Vec<_> = (1..=3).flat_map(|seed| washes(seed, golden.every)).collect();
    assert_eq!((golden.washes.len(), found.len()), (12, 12));
    for (before, now) in golden.washes.iter().zip(&found) {
        let at = (before.seed, before.plate);
        assert_eq!((now.seed, now.plate, now.knots), (at.0, at.1, before.knots));
        assert!(
            before.knots > 400 && before.t_s_q_rad.len() == now.t_s_q_rad.len(),
            "{at:?}"
        );
        for (then, now) in before.t_s_q_rad.iter().zip(&now.t_s_q_rad) {
            let apart = then.iter().zip(now).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart <= APART, "{at:?}: {then:?} and {now:?}");
        }
    }
}
