//! Re-measures what the paper's program does, over many layouts.
//!
//! Every quantity is measured by running the program's own parts (layout law, spiral, transition, inverse kinematics
//! seeded with the executed configuration, control law), not copied from anywhere. The paper's column says what its text
//! takes for granted: that layouts are found, points reached, nothing touched, and plates covered.
//!
//! Sampling errors are half-widths of 95 % intervals: binomial for dead ends, batch means over layouts (up to 20 batches)
//! for everything else, because waypoints of one layout are not independent.

mod cell;
mod law;
mod stall;
mod statistics;
mod table;

pub use law::FrequencyResponse;

use crate::job::PlanError;
use crate::scenario::{RegionName, Scenario};
use cell::{LayoutSample, SPONGES_MM};
use rayon::prelude::*;
use serde::Serialize;
use statistics::{Estimate, batch_means, percentile};
use std::sync::atomic::{AtomicUsize, Ordering};

/// What to measure, and how often.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct ReproduceSettings {
    /// Layouts simulated in each of the paper's two regions.
    pub layouts: usize,
    /// Layouts begun to measure each dead-end rate.
    pub draws: usize,
    /// Seed of every random stream.
    pub seed: u64,
}

impl Default for ReproduceSettings {
    fn default() -> Self {
        Self {
            layouts: 400,
            draws: 20_000,
            seed: 1,
        }
    }
}

/// One measured quantity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Stable key, e.g. `dead_end_rate.text.4_plates`; listed in `docs/reproduce.md`.
    pub key: String,
    /// Group heading.
    pub group: &'static str,
    /// What it is, in words.
    pub quantity: String,
    /// Unit: `%`, `mm`, `deg` or empty for a ratio.
    pub unit: &'static str,
    /// What the paper's text takes for granted, in the same unit, where it says anything.
    pub paper: Option<f64>,
    /// Measured value.
    pub measured: f64,
    /// Half-width of the 95 % interval; `None` where the value has no sampling error or too few samples.
    pub half_width_95: Option<f64>,
}

/// Everything measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reproduction {
    /// What was asked.
    pub settings: ReproduceSettings,
    /// The quantities, in reading order.
    pub rows: Vec<Row>,
}

/// The paper's regions with the scenarios that state them.
const REGIONS: [(RegionName, &str, &str); 2] = [
    (RegionName::Text, "text", "paper-text"),
    (RegionName::Appendix, "appendix", "paper-appendix"),
];

/// Measures everything; `progress(done, total)` is called after each layout, from any thread.
///
/// The answer does not depend on the number of threads.
///
/// # Errors
/// [`PlanError`] from a stage of the program; never for a layout that does not wash.
pub fn reproduce(
    settings: &ReproduceSettings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Reproduction, PlanError> {
    let mut rows = stall::rows(settings)?;
    rows.extend(law::rows(&Scenario::load("paper-appendix")?.control));
    let done = AtomicUsize::new(0);
    let total = REGIONS.len() * settings.layouts;
    let mut pooled = Vec::new();
    for (_, region, scenario) in REGIONS {
        let bench = cell::Bench::new(Scenario::load(scenario)?)?;
        let measure = |k: usize| {
            let sample = bench.measure(settings.seed, region, k);
            progress(1 + done.fetch_add(1, Ordering::Relaxed), total);
            sample
        };
        let samples = (0..settings.layouts)
            .into_par_iter()
            .map(measure)
            .collect::<Result<Vec<_>, _>>()?;
        rows.extend(feasibility_rows(region, &samples));
        pooled.extend(samples);
    }
    rows.extend(tracking_rows(&pooled));
    rows.extend(coverage_rows(&pooled)?);
    Ok(Reproduction {
        settings: *settings,
        rows,
    })
}

fn row(group: &'static str, key: String, quantity: String, unit: &'static str, paper: Option<f64>, e: Estimate) -> Row {
    Row {
        key,
        group,
        quantity,
        unit,
        paper,
        measured: e.value,
        half_width_95: e.half_width_95,
    }
}

/// 100 × the share of a count over another, both summed over layouts.
fn percent(samples: &[LayoutSample], part: fn(&LayoutSample) -> usize, whole: fn(&LayoutSample) -> usize) -> Estimate {
    batch_means(samples, |batch| {
        let sum = |of: fn(&LayoutSample) -> usize| batch.iter().map(of).sum::<usize>() as f64;
        100.0 * sum(part) / sum(whole).max(1.0)
    })
}

fn feasibility_rows(region: &'static str, samples: &[LayoutSample]) -> Vec<Row> {
    const GROUP: &str = "Layouts, reach and contact (tool straight down, exact inverse kinematics)";
    type Count = fn(&LayoutSample) -> usize;
    let quantities: [(&str, &str, f64, Count, Count); 9] = [
        (
            "plates_overlap",
            "layouts whose plates overlap",
            0.0,
            |s| s.plates_overlap.into(),
            |_| 1,
        ),
        (
            "base_overlap",
            "layouts with a plate over the robot's base",
            0.0,
            |s| s.base_overlap.into(),
            |_| 1,
        ),
        (
            "points_reached",
            "spiral points with an exact solution",
            100.0,
            |s| s.reached(),
            |s| s.points(),
        ),
        (
            "points_clear",
            "spiral points reached and free of contact",
            100.0,
            |s| s.clear(),
            |s| s.points(),
        ),
        (
            "plates_clear",
            "plates with every point reached and free",
            100.0,
            |s| s.clear_plates(),
            |s| s.plates.len(),
        ),
        (
            "layouts_clear",
            "layouts with every point reached and free",
            100.0,
            |s| s.is_clear().into(),
            |_| 1,
        ),
        (
            "transitions_reached",
            "transition points with an exact solution",
            100.0,
            |s| s.transition.reached,
            |s| s.transition.points,
        ),
        (
            "transition_points_clear",
            "reached transition points free of contact",
            100.0,
            |s| s.transition.clear,
            |s| s.transition.reached,
        ),
        (
            "transitions_clear",
            "transitions wholly free of contact",
            100.0,
            |s| s.clear_transitions,
            |s| s.transitions,
        ),
    ];
    let make = |(key, quantity, paper, part, whole): (&str, &str, f64, Count, Count)| {
        let (key, quantity) = (format!("{key}.{region}"), format!("{quantity}, {region} region"));
        row(GROUP, key, quantity, "%", Some(paper), percent(samples, part, whole))
    };
    quantities.into_iter().map(make).collect()
}

fn tracking_rows(samples: &[LayoutSample]) -> Vec<Row> {
    const GROUP: &str = "Tracking under the paper's control law (both regions)";
    let rms = |of: fn(&LayoutSample) -> &[f64]| {
        batch_means(samples, |batch| {
            let (n, sum) = batch
                .iter()
                .flat_map(of)
                .fold((0.0, 0.0), |(n, sum), e| (n + 1.0, sum + e * e));
            1e3 * f64::sqrt(sum / f64::max(n, 1.0))
        })
    };
    let share = |share: f64, of: fn(&LayoutSample) -> &[f64]| {
        batch_means(samples, |batch| {
            1e3 * percentile(batch.iter().flat_map(of).copied().collect(), share)
        })
    };
    let mm = |key: &str, quantity: &str, paper, e| row(GROUP, key.into(), quantity.into(), "mm", paper, e);
    vec![
        mm(
            "tracking_rms.first_spiral",
            "tip error on the first spiral, rms",
            Some(0.0),
            rms(|s| &s.first_spiral_errors),
        ),
        mm(
            "tracking_rms.later_spirals",
            "tip error on later spirals, rms",
            Some(0.0),
            rms(|s| &s.later_spiral_errors),
        ),
        mm(
            "tracking_p95.later_spirals",
            "tip error on later spirals, 95th percentile",
            Some(0.0),
            share(0.95, |s| &s.later_spiral_errors),
        ),
        mm(
            "tracking_rms.transitions",
            "tip error on transitions, rms",
            Some(0.0),
            rms(|s| &s.transition_errors),
        ),
        mm(
            "executed_radius.median",
            "outermost executed radius on later plates, median",
            Some(145.0),
            share(0.5, |s| &s.outermost_radii),
        ),
        mm(
            "executed_radius.p05",
            "the same, 5th percentile",
            None,
            share(0.05, |s| &s.outermost_radii),
        ),
        mm(
            "executed_radius.p95",
            "the same, 95th percentile",
            None,
            share(0.95, |s| &s.outermost_radii),
        ),
        row(
            GROUP,
            "steps_too_fast".into(),
            "steps that exceed a joint's speed limit".into(),
            "%",
            Some(0.0),
            percent(samples, |s| s.steps_too_fast, |s| s.steps),
        ),
    ]
}

fn coverage_rows(samples: &[LayoutSample]) -> Result<Vec<Row>, PlanError> {
    const GROUP: &str = "Coverage of the disc of radius 145 mm, by sponge radius (executed: all spirals pooled)";
    let ideal = cell::ideal_coverage(&Scenario::load("paper-appendix")?)?;
    let mut rows = Vec::new();
    for (k, (sponge, ideal)) in SPONGES_MM.into_iter().zip(ideal).enumerate() {
        let exact = Estimate {
            value: 100.0 * ideal,
            half_width_95: None,
        };
        let executed = batch_means(samples, |batch| {
            let all = batch.iter().flat_map(|s| &s.plates).map(|p| p.executed_coverage[k]);
            let (n, sum) = all.fold((0.0, 0.0), |(n, sum), c| (n + 1.0, sum + c));
            100.0 * sum / f64::max(n, 1.0)
        });
        for (path, estimate) in [("ideal", exact), ("executed", executed)] {
            let (key, quantity) = (
                format!("coverage.{path}.{sponge}mm"),
                format!("{path} path, sponge radius {sponge} mm"),
            );
            rows.push(row(GROUP, key, quantity, "%", Some(100.0), estimate));
        }
    }
    Ok(rows)
}
