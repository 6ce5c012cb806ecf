//! Timing for a noisy machine: the solvers take turns, round after round, and what is reported is the median
//! over the rounds, of each time and of each ratio to the first solver in the same round. The spread over the
//! targets comes from one more pass in which each is timed alone.

use crate::problems::Problems;
use crate::score::Score;
use crate::solvers::Solver;
use platewash_kinematics::{RobotModel, ToolFrameError};
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
    /// Mean time per target, median over the rounds \[ns\].
    pub mean_ns: f64,
    /// Ratio to the first solver's mean in the same round, median over the rounds.
    pub ratio: f64,
    /// Time that half of the targets need at most \[ns\].
    pub half_ns: f64,
    /// Time that 99 % of the targets need at most \[ns\].
    pub most_ns: f64,
}

/// Scores every solver, then times them in turns.
///
/// # Errors
/// An arm without `tool0`.
pub fn compare(
    solvers: &mut [Box<dyn Solver + '_>],
    problems: &Problems,
    robot: &RobotModel,
) -> Result<Vec<Row>, ToolFrameError> {
    let scores: Vec<Score> = solvers
        .iter_mut()
        .map(|solver| Score::of(solver.as_mut(), problems, robot))
        .collect::<Result<_, _>>()?;
    let alone: Vec<Vec<f64>> = solvers.iter_mut().map(|s| each_ns(s.as_mut(), problems)).collect();
    let mut means = vec![Vec::new(); solvers.len()];
    for _ in 0..ROUNDS {
        for (solver, means) in solvers.iter_mut().zip(&mut means) {
            means.push(mean_ns(solver.as_mut(), problems));
        }
    }
    let row = |k: usize| {
        let ratios = means[k].iter().zip(&means[0]).map(|(own, first)| own / first);
        Row {
            name: solvers[k].name(),
            score: scores[k],
            mean_ns: quantile(means[k].clone(), 0.5),
            ratio: quantile(ratios.collect(), 0.5),
            half_ns: quantile(alone[k].clone(), 0.5),
            most_ns: quantile(alone[k].clone(), 0.99),
        }
    };
    Ok((0..solvers.len()).map(row).collect())
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
    let mut text = format!("\n{title}, {ROUNDS} interleaved rounds\n\n");
    text += "| solver | solved % | wrong | mean ns | ratio | 50 % within ns | 99 % within ns | largest step rad |\n";
    text += "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    for row in rows {
        let Row { name, score, .. } = row;
        let (solved, wrong) = (score.percent(), score.wrong);
        let step = score
            .largest_step_rad
            .map_or("–".to_owned(), |step| format!("{step:.3}"));
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "| {name} | {solved:.1} | {wrong} | {:.0} | {:.2} | {:.0} | {:.0} | {step} |",
            row.mean_ns, row.ratio, row.half_ns, row.most_ns
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
