//! Two plates with a wall between them, over which or round which the arm has to find its way.

use super::{Outcome, judged};
use platewash::{WashReport, plan, prove};
use platewash_problems::walls::walled;
use std::time::Instant;

fn share(cells: u64) -> usize {
    let mut proved = 0;
    let mut seconds: Vec<f64> = Vec::new();
    for seed in 1..=cells {
        let scenario = walled(seed).unwrap();
        let start = Instant::now();
        let (outcome, _) = judged(&scenario);
        seconds.push(start.elapsed().as_secs_f64());
        proved += usize::from(outcome == Outcome::Proved);
        if outcome != Outcome::Proved {
            eprintln!("wall {seed}: {outcome:?}");
        }
    }
    seconds.sort_by(f64::total_cmp);
    let median = seconds.get(seconds.len() / 2).copied().unwrap_or_default();
    eprintln!("{proved} of {cells} cells with a wall proved; median {median:.3} s to plan and prove");
    proved
}

#[test]
fn finds_and_proves_a_transit_past_a_wall() {
    assert!(share(4) >= 2);
}

/// Where a smooth path that follows free lines of the joints is not free itself; where forearm or elbow are beside the wall, so that the tool
/// has to lean away from it.
#[test]
fn washes_and_proves_plates_beside_a_wall() {
    for seed in [6, 12, 20] {
        assert_eq!(judged(&walled(seed).unwrap()).0, Outcome::Proved, "wall {seed}");
    }
}

/// How far it leans is reported, where it does.
#[test]
fn reports_a_tool_that_leans_away_from_a_wall() {
    for (seed, leans) in [(1, false), (20, true)] {
        let job = walled(seed).unwrap().job().unwrap();
        let planned = plan(&job).unwrap();
        let text = WashReport::new(&planned, &[], prove(&planned.plan, job.arm()).unwrap()).to_string();
        assert_eq!(text.contains("° aside"), leans, "wall {seed}: {text}");
        let said = serde_json::to_string(&planned.visits).unwrap();
        assert_eq!(said.contains("aside_rad"), leans, "wall {seed}: {said}");
    }
}

#[test]
#[ignore = "100 walls"]
fn finds_and_proves_transits_past_many_walls() {
    assert!(share(100) >= 95);
}
