//! The measured quantities, from samples of layouts.

use super::layout::{SPONGES_MM, Sample, by_sponge};
use super::row::Row;
use super::statistics::{Estimate, batch_means, percentile, root_mean_square};
use crate::part::PaperPart;
use crate::tool_path::ToolPath;
use platewash_bodies::coverage::{Coverage, CoverageError};
use platewash_workcell::plate::Plate;

/// Shares in each region: key, words, the value that the paper takes for granted \[%\].
const SHARES: [(&str, &str, f64); 9] = [
    ("plates_overlap", "layouts whose plates overlap", 0.0),
    ("base_overlap", "layouts with a plate over the robot's base", 0.0),
    ("points_reached", "spiral points with an exact solution", 100.0),
    ("points_clear", "spiral points reached and free of contact", 100.0),
    ("plates_clear", "plates with every point reached and free", 100.0),
    ("layouts_clear", "layouts with every point reached and free", 100.0),
    ("transitions_reached", "transition points with an exact solution", 100.0),
    (
        "transition_points_clear",
        "reached transition points free of contact",
        100.0,
    ),
    (
        "transitions_clear",
        "transitions whose reached points are all free",
        100.0,
    ),
];

/// Tip errors: key, which ends with that of the lengths; words; the share of the values below, or `None` for the root mean square.
const TIP_ERRORS: [(&str, &str, Option<f64>); 4] = [
    ("tracking_rms.first_spiral", "the first spiral, rms", None),
    ("tracking_rms.later_spirals", "later spirals, rms", None),
    (
        "tracking_p95.later_spirals",
        "later spirals, 95th percentile",
        Some(0.95),
    ),
    ("tracking_rms.transitions", "transitions, rms", None),
];

/// Percentiles of the outermost radius: key, words, the value that the paper takes for granted \[mm\], the share of the values
/// below.
const RADII: [(&str, &str, Option<f64>, f64); 3] = [
    (
        "executed_radius.median",
        "outermost executed radius on later plates, median",
        Some(145.0),
        0.5,
    ),
    ("executed_radius.p05", "the same, 5th percentile", None, 0.05),
    ("executed_radius.p90", "the same, 90th percentile", None, 0.9),
];

/// Reach and contact in one region.
pub(super) fn feasibility(region: &str, samples: &[Sample]) -> Vec<Row> {
    const GROUP: &str = "Layouts, reach and contact (tool straight down, exact inverse kinematics)";
    let make = |(key, words, paper): (&str, &str, f64)| {
        let (name, quantity) = (format!("{key}.{region}"), format!("{words}, {region} region"));
        Row::new(GROUP, name, quantity, "%", paper, percent(samples, key))
    };
    SHARES.map(make).into()
}

/// 100 × the share of a count in another, both summed over layouts.
fn percent(samples: &[Sample], key: &str) -> Estimate {
    let estimate = batch_means(samples, |batch| {
        let counts = batch.iter().filter_map(|sample| sample.counts.get(key));
        let [part, whole] = counts.fold([0, 0], |sum, count| [sum[0] + count[0], sum[1] + count[1]]);
        100.0 * part as f64 / (whole as f64).max(1.0)
    });
    // The rule of three: no exception in n layouts bounds their share by 3/n.
    let certain = estimate.value <= 0.0 || estimate.value >= 100.0;
    let three = 300.0 / samples.len().max(1) as f64;
    Estimate {
        half_width_95: estimate.half_width_95.map(|h| if certain { three } else { h }),
        ..estimate
    }
}

/// Rows on the tracking errors of the control law, over both regions.
pub(super) fn tracking(samples: &[Sample]) -> Vec<Row> {
    const GROUP: &str = "Tracking under the paper's control law (both regions)";
    let millimetres = |lengths: &str, share: Option<f64>| {
        batch_means(samples, |batch| {
            let values = batch.iter().filter_map(|sample| sample.lengths_m.get(lengths));
            let values: Vec<f64> = values.flatten().copied().collect();
            1e3 * share.map_or_else(|| root_mean_square(&values), |share| percentile(&values, share))
        })
    };
    let error = |(key, words, share): (&'static str, &str, Option<f64>)| {
        let lengths = key.rsplit('.').next().unwrap_or(key);
        let quantity = format!("tip error on {words}");
        Row::new(GROUP, key, quantity, "mm", 0.0, millimetres(lengths, share))
    };
    let radius =
        |(key, words, paper, share)| Row::new(GROUP, key, words, "mm", paper, millimetres("radius", Some(share)));
    let (key, words) = ("steps_too_fast", "steps that exceed a joint's speed limit");
    let too_fast = Row::new(GROUP, key, words, "%", 0.0, percent(samples, key));
    let lengths = TIP_ERRORS.map(error).into_iter().chain(RADII.map(radius));
    lengths.chain([too_fast]).collect()
}

/// Coverage by sponge radius, ideal and executed; the raster's proven error is part of the error stated.
pub(super) fn coverage(samples: &[Sample]) -> Result<Vec<Row>, CoverageError> {
    const GROUP: &str = "Coverage of the disc of radius 145 mm, by sponge radius (executed: all spirals pooled)";
    let mut rows = Vec::new();
    for (k, (sponge, ideal)) in SPONGES_MM.into_iter().zip(ideal_coverage()?).enumerate() {
        let mean = |batch: &[Sample], of: fn(&Coverage) -> f64| {
            let plates = batch.iter().flat_map(|sample| &sample.coverage);
            let all: Vec<f64> = plates.map(|plate| of(&plate[k])).collect();
            100.0 * all.iter().sum::<f64>() / all.len().max(1) as f64
        };
        let executed = batch_means(samples, |batch| mean(batch, |c| c.fraction));
        let raster = 0.5 * mean(samples, Coverage::error);
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
            rows.push(Row::new(GROUP, key, quantity, "%", 100.0, estimate));
        }
    }
    Ok(rows)
}

/// Coverage of a plate of the paper's appendix had the tip followed the waypoints, by sponge radius.
fn ideal_coverage() -> Result<Vec<Coverage>, CoverageError> {
    let part = PaperPart::Appendix;
    let size = part.geometry();
    let plate = Plate::level_disc([0.3, 0.0, size.height_m], size.surface.rim_m(), size.thickness_m);
    let path = ToolPath::new(&part.settings(), &[plate]);
    let spiral = path.segments.iter().flat_map(|segment| &segment.waypoints);
    let spiral: Vec<_> = spiral.map(|p| [p.x, p.y]).collect();
    by_sponge(&spiral, &plate, 1e-4)
}
