//! Share of the plan's speed that follows from a program's times, where it states none.

use crate::dialect::language::Points;
use crate::reading::Reading;
use platewash_motion::plan::Plan;

/// Shares are rounded to steps of one over this number.
const STEPS: f64 = 1e6;

/// Least share that is accepted.
const LEAST: f64 = 1e-3;

/// Steps of the search, each of which squares the error.
const ROUNDS: usize = 8;

/// The share of the plan's speed at which a program runs, by its times.
pub(crate) fn speed_share(plan: &Plan, found: &Reading, points: Points) -> f64 {
    let share = match points {
        Points::Knots if found.points.len() == plan.knots.t_s.len() => of_knots(plan, found),
        Points::Steps { .. } => of_rows(plan, found),
        _ => of_duration(plan, found),
    };
    let share = (share * STEPS).round() / STEPS;
    if (LEAST..=1.0).contains(&share) { share } else { 1.0 }
}

/// Share of a program with all the plan's knots: the median over the knots, so that a time that was changed does not count.
fn of_knots(plan: &Plan, found: &Reading) -> f64 {
    let both = plan.knots.t_s.iter().zip(&found.points).skip(1);
    let mut shares: Vec<_> = both.map(|(plan_s, point)| plan_s / point.t_s).collect();
    shares.sort_unstable_by(f64::total_cmp);
    shares.get(shares.len() / 2).copied().unwrap_or(1.0)
}

fn of_duration(plan: &Plan, found: &Reading) -> f64 {
    plan.duration_s() / found.points.last().map_or(0.0, |point| point.t_s)
}

/// Share of a program of rows at even steps, the last of which is up to a step after the plan's end: the share at which the rows
/// are nearest to the plan, in the sense of least squares.
fn of_rows(plan: &Plan, found: &Reading) -> f64 {
    let least = of_duration(plan, found);
    let ([.., before, _], Ok(motion)) = (found.points.as_slice(), plan.knots.motion()) else {
        return least;
    };
    let most = (plan.duration_s() / before.t_s).min(1.0).max(least);
    (0..ROUNDS).fold(least, |share, _| {
        let (mut off, mut slope) = (0.0, 0.0);
        for row in &found.points {
            if let Some(state) = motion.at(share * row.t_s) {
                let moves = state.qd * row.t_s;
                off += (row.q_rad - state.q).dot(&moves);
                slope += moves.norm_squared();
            }
        }
        match slope > 0.0 {
            true => (share + off / slope).clamp(least, most),
            // An arm that does not move gives no information.
            false => share,
        }
    })
}
