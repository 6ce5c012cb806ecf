//! Timing for a noisy machine: the solvers take turns, round after round, and what is reported is the median
//! over the rounds, of each time and of each ratio to the first solver in the same round. The spread over the
//! targets comes from one more pass in which each is timed alone.

use platewash_kinematics::{RobotModel, ToolFrameError};
use platewash_problems::problems::Problems;
use platewash_problems::score::Score;
use platewash_problems::solver::Solver;
use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

/// Rounds; odd, so that the median is one of them.
pub const ROUNDS: usize = 21;

/// A solver's row of the summary.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The solver.
    pub name: &'static str,
    /// Its answers.
    pub score: Score,
    /// Its time per target.
    pub turn: Turn,
    /// Times that 50 % and 99 % of the targets need at most \[ns\]; none for a solver that takes all targets at once.
    pub quantiles_ns: Option<[f64; 2]>,
}

/// What a contestant needs per unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Turn {
    /// Median over the rounds \[ns\].
    pub median_ns: f64,
    /// Time of each of the first contestants divided by its own in the same round, medians over the rounds.
    pub ratios: Vec<f64>,
}

/// Lets the contestants take turns; each call gives the time of one pass per unit \[ns\]. The first `own` are what the
/// others are compared with.
pub fn turns(contestants: &mut [Box<dyn FnMut() -> f64 + '_>], own: usize) -> Vec<Turn> {
    let mut times = vec![Vec::new(); contestants.len()];
    for _ in 0..ROUNDS {
        for (contestant, times) in contestants.iter_mut().zip(&mut times) {
            times.push(contestant());
        }
    }
    let turn = |k: usize| Turn {
        median_ns: quantile(times[k].clone(), 0.5),
        ratios: times[..own]
            .iter()
            .map(|first| quantile(first.iter().zip(&times[k]).map(|(a, b)| a / b).collect(), 0.5))
            .collect(),
    };
    (0..contestants.len()).map(turn).collect()
}

/// Scores every solver, then times them in turns.
///
/// # Errors
/// An arm without `tool0`.
pub fn compare(
    solvers: &mut [Box<dyn Solver + '_>],
    own: usize,
    problems: &Problems,
    robot: &RobotModel,
) -> Result<Vec<Row>, ToolFrameError> {
    let names: Vec<_> = solvers.iter().map(|solver| solver.name()).collect();
    let scores: Vec<Score> = solvers
        .iter_mut()
        .map(|solver| Score::of(solver.as_mut(), problems, robot))
        .collect::<Result<_, _>>()?;
    let alone: Vec<_> = solvers
        .iter_mut()
        .map(|solver| {
            let at_once = solver.path(&problems.start()).is_some();
            let times = each_ns(solver.as_mut(), problems);
            (!at_once).then(|| [0.5, 0.99].map(|share| quantile(times.clone(), share)))
        })
        .collect();
    let mut contestants: Vec<Box<dyn FnMut() -> f64>> = Vec::new();
    for solver in solvers {
        contestants.push(Box::new(|| mean_ns(solver.as_mut(), problems)));
    }
    let turns = turns(&mut contestants, own);
    let row = |(k, turn)| Row {
        name: names[k],
        score: scores[k],
        turn,
        quantiles_ns: alone[k],
    };
    Ok(turns.into_iter().enumerate().map(row).collect())
}

/// Time per target of one pass \[ns\].
fn mean_ns(solver: &mut dyn Solver, problems: &Problems) -> f64 {
    let start = Instant::now();
    problems.run(solver, |_, answer| {
        black_box(answer);
    });
    start.elapsed().as_secs_f64() * 1e9 / problems.targets.len() as f64
}

/// Time of every target \[ns\].
fn each_ns(solver: &mut dyn Solver, problems: &Problems) -> Vec<f64> {
    let mut times = Vec::with_capacity(problems.targets.len());
    let mut start = Instant::now();
    problems.run(solver, |_, answer| {
        black_box(answer);
        times.push(start.elapsed().as_secs_f64() * 1e9);
        start = Instant::now();
    });
    times
}

/// The value below which the given share of the values lies.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[(share * (values.len() - 1) as f64).round() as usize]
}

/// The rows as a Markdown table.
#[must_use]
pub fn table(title: &str, rows: &[Row]) -> String {
    let own = rows.first().map_or(0, |row| row.turn.ratios.len());
    let mut text = format!("\n{title}, {ROUNDS} interleaved rounds\n\n| solver | solved % | wrong | mean ns |");
    for row in &rows[..own] {
        text += &format!(" {} / it |", row.name.trim_start_matches("platewash "));
    }
    text += " 50 % within ns | 99 % within ns | largest step rad |\n| --- ";
    text += &"| ---: ".repeat(6 + own);
    text += "|\n";
    for row in rows {
        let Row { name, score, turn, .. } = row;
        let (solved, wrong) = (score.percent(), score.wrong);
        let ratios: String = turn.ratios.iter().map(|ratio| format!(" {ratio:.3} |")).collect();
        let [half, most] = match row.quantiles_ns {
            Some(quantiles) => quantiles.map(|ns| format!("{ns:.0}")),
            None => ["–".to_owned(), "–".to_owned()],
        };
        let step = score
            .largest_step_rad
            .map_or("–".to_owned(), |step| format!("{step:.3}"));
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "| {name} | {solved:.2} | {wrong} | {:.0} |{ratios} {half} | {most} | {step} |",
            turn.median_ns
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_a_known_series() {
        let series: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        assert_eq!(quantile(series.clone(), 0.5), 50.0);
        assert_eq!(quantile(series, 0.99), 99.0);
        assert_eq!(quantile(vec![3.0], 0.99), 3.0);
    }
}
