//! The measured quantities, from samples of layouts.

use super::layout::LayoutSample;
use super::result::{Row, row};
use super::sponges::{SPONGES_MM, ideal_coverage};
use super::statistics::{Estimate, batch_means, percentile};
use platewash_workcell::coverage::{Coverage, CoverageError};

type Count = fn(&LayoutSample) -> usize;
type Values = fn(&LayoutSample) -> &[f64];

/// A share in percent: key, words, what the paper takes for granted, part, whole.
struct Share(&'static str, &'static str, f64, Count, Count);

/// Shares of each region.
const FEASIBILITY: [Share; 9] = [
    Share(
        "plates_overlap",
        "layouts whose plates overlap",
        0.0,
        |s| s.plates_overlap as usize,
        |_| 1,
    ),
    Share(
        "base_overlap",
        "layouts with a plate over the robot's base",
        0.0,
        |s| s.base_overlap as usize,
        |_| 1,
    ),
    Share(
        "points_reached",
        "spiral points with an exact solution",
        100.0,
        LayoutSample::reached,
        LayoutSample::points,
    ),
    Share(
        "points_clear",
        "spiral points reached and free of contact",
        100.0,
        LayoutSample::clear,
        LayoutSample::points,
    ),
    Share(
        "plates_clear",
        "plates with every point reached and free",
        100.0,
        LayoutSample::clear_plates,
        |s| s.plates.len(),
    ),
    Share(
        "layouts_clear",
        "layouts with every point reached and free",
        100.0,
        |s| s.is_clear() as usize,
        |_| 1,
    ),
    Share(
        "transitions_reached",
        "transition points with an exact solution",
        100.0,
        |s| s.transit.reached,
        |s| s.transit.points,
    ),
    Share(
        "transition_points_clear",
        "reached transition points free of contact",
        100.0,
        |s| s.transit.clear,
        |s| s.transit.reached,
    ),
    Share(
        "transitions_clear",
        "transitions whose reached points are all free",
        100.0,
        |s| s.clear_transits,
        |s| s.transits,
    ),
];

/// Reach and contact in one region.
pub(super) fn feasibility(region: &'static str, samples: &[LayoutSample]) -> Vec<Row> {
    const GROUP: &str = "Layouts, reach and contact (tool straight down, exact inverse kinematics)";
    let make = |Share(key, words, paper, part, whole): &Share| {
        let (key, quantity) = (format!("{key}.{region}"), format!("{words}, {region} region"));
        row(GROUP, key, quantity, "%", Some(*paper), percent(samples, *part, *whole))
    };
    FEASIBILITY.iter().map(make).collect()
}

/// 100 × the share of a count in another, both summed over layouts.
fn percent(samples: &[LayoutSample], part: Count, whole: Count) -> Estimate {
    let estimate = batch_means(samples, |batch| {
        let sum = |of: Count| batch.iter().map(of).sum::<usize>() as f64;
        100.0 * sum(part) / sum(whole).max(1.0)
    });
    // The rule of three: no exception in n layouts bounds their share by 3/n.
    let certain = estimate.value <= 0.0 || estimate.value >= 100.0;
    let three = 300.0 / samples.len().max(1) as f64;
    Estimate {
        half_width_95: estimate.half_width_95.map(|h| if certain { three } else { h }),
        ..estimate
    }
}

/// A length in millimetres: key, words, what the paper takes for granted, statistic, values \[m\].
struct Length(&'static str, &'static str, Option<f64>, Statistic, Values);

enum Statistic {
    RootMeanSquare,
    Percentile(f64),
}

/// Lengths of both regions together.
const TRACKING: [Length; 7] = {
    use Statistic::{Percentile, RootMeanSquare};
    [
        Length(
            "tracking_rms.first_spiral",
            "tip error on the first spiral, rms",
            Some(0.0),
            RootMeanSquare,
            |s| &s.first_spiral_errors,
        ),
        Length(
            "tracking_rms.later_spirals",
            "tip error on later spirals, rms",
            Some(0.0),
            RootMeanSquare,
            |s| &s.later_spiral_errors,
        ),
        Length(
            "tracking_p95.later_spirals",
            "tip error on later spirals, 95th percentile",
            Some(0.0),
            Percentile(0.95),
            |s| &s.later_spiral_errors,
        ),
        Length(
            "tracking_rms.transitions",
            "tip error on transitions, rms",
            Some(0.0),
            RootMeanSquare,
            |s| &s.transit_errors,
        ),
        Length(
            "executed_radius.median",
            "outermost executed radius on later plates, median",
            Some(145.0),
            Percentile(0.5),
            |s| &s.outermost_radii,
        ),
        Length(
            "executed_radius.p05",
            "the same, 5th percentile",
            None,
            Percentile(0.05),
            |s| &s.outermost_radii,
        ),
        Length(
            "executed_radius.p90",
            "the same, 90th percentile",
            None,
            Percentile(0.9),
            |s| &s.outermost_radii,
        ),
    ]
};

/// How well the control law tracks, over both regions.
pub(super) fn tracking(samples: &[LayoutSample]) -> Vec<Row> {
    const GROUP: &str = "Tracking under the paper's control law (both regions)";
    let lengths = TRACKING.iter().map(|Length(key, words, paper, statistic, values)| {
        let estimate = batch_means(samples, |batch| {
            1e3 * statistic.of(batch.iter().flat_map(values).copied().collect())
        });
        row(GROUP, (*key).into(), (*words).into(), "mm", *paper, estimate)
    });
    let too_fast = percent(samples, |s| s.steps_too_fast, |s| s.steps);
    let (key, words) = (
        "steps_too_fast".into(),
        "steps that exceed a joint's speed limit".into(),
    );
    lengths
        .chain([row(GROUP, key, words, "%", Some(0.0), too_fast)])
        .collect()
}

impl Statistic {
    fn of(&self, values: Vec<f64>) -> f64 {
        match self {
            Self::RootMeanSquare => f64::sqrt(values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64),
            Self::Percentile(share) => percentile(values, *share),
        }
    }
}

/// Coverage by sponge radius, ideal and executed; the raster's proven error is part of the error stated.
pub(super) fn coverage(samples: &[LayoutSample]) -> Result<Vec<Row>, CoverageError> {
    const GROUP: &str = "Coverage of the disc of radius 145 mm, by sponge radius (executed: all spirals pooled)";
    let ideal = ideal_coverage()?;
    let mut rows = Vec::new();
    for (k, (sponge, ideal)) in SPONGES_MM.into_iter().zip(ideal).enumerate() {
        let mean = |batch: &[LayoutSample], of: fn(&Coverage) -> f64| {
            let all: Vec<f64> = batch
                .iter()
                .flat_map(|s| &s.plates)
                .map(|p| of(&p.executed_coverage[k]))
                .collect();
            100.0 * all.iter().sum::<f64>() / all.len().max(1) as f64
        };
        let executed = batch_means(samples, |batch| mean(batch, |c| c.fraction));
        let raster = 0.5 * mean(samples, |c| c.error());
        let executed = Estimate {
            half_width_95: executed.half_width_95.map(|h| h + raster),
            ..executed
        };
        let exact = Estimate {
            value: 100.0 * ideal.fraction,
            half_width_95: Some(50.0 * ideal.error()),
        };
        for (path, estimate) in [("ideal", exact), ("executed", executed)] {
            let key = format!("coverage.{path}.{sponge}mm");
            let quantity = format!("{path} path, sponge radius {sponge} mm");
            rows.push(row(GROUP, key, quantity, "%", Some(100.0), estimate));
        }
    }
    Ok(rows)
}
