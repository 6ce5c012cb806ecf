//! The swept share of a cell, by columns: within each, what the disc and every capsule cut out of its middle line is exact.

use super::capsule::Capsule;

/// Columns of a cell.
const COLUMNS: u32 = 8;

/// The swept share of the part of a cell, [x0, x1] × [y0, y1], that lies in the disc of `radius` about the origin: an
/// estimate, from 0 to 1. `sections` is room to work in.
pub(super) fn swept_share<'a>(
    [[x0, x1], [y0, y1]]: [[f64; 2]; 2],
    radius: f64,
    capsules: impl Iterator<Item = &'a Capsule> + Clone,
    sponge_radius: f64,
    sections: &mut Vec<[f64; 2]>,
) -> f64 {
    // Columns only where there is something of the disc.
    let nearest_y = y0.max(-y1).max(0.0);
    let widest = (radius * radius - nearest_y * nearest_y).max(0.0).sqrt();
    let (x0, x1) = (x0.max(-widest), x1.min(widest));
    let width = (x1 - x0) / f64::from(COLUMNS);
    let (mut whole, mut swept) = (0.0, 0.0);
    for column in 0..COLUMNS {
        let x = x0 + width * (f64::from(column) + 0.5);
        let rim = (radius * radius - x * x).max(0.0).sqrt();
        let (from, to) = (y0.max(-rim), y1.min(rim));
        if from < to {
            whole += to - from;
            sections.clear();
            sections.extend(capsules.clone().filter_map(|capsule| capsule.section(x, sponge_radius)));
            swept += covered_length([from, to], sections);
        }
    }
    if whole > 0.0 { (swept / whole).min(1.0) } else { 0.0 }
}

/// The length of an interval that others cover together.
fn covered_length([from, to]: [f64; 2], others: &mut [[f64; 2]]) -> f64 {
    others.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut done, mut covered) = (from, 0.0);
    for [start, end] in others {
        let (start, end) = (start.max(done), end.min(to));
        if end > start {
            covered += end - start;
            done = end;
        }
    }
    covered
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against a look at many points of the line.
        #[test]
        fn a_section_is_where_the_axis_is_near(
            start in prop::array::uniform2(-1.0..1.0f64),
            along in prop_oneof![
                prop::array::uniform2(-1.0..1.0f64),
                (-1.0..1.0f64).prop_map(|u| [u, 0.0]),
                (-1.0..1.0f64).prop_map(|u| [0.0, u]),
                Just([0.0, 0.0]),
            ],
            x in -2.0..2.0f64,
            reach in 0.05..1.0f64,
        ) {
            let capsule = Capsule::new(start, [start[0] + along[0], start[1] + along[1]]);
            let section = capsule.section(x, reach);
            for k in -400..=400 {
                let y = 0.01 * f64::from(k);
                let off = capsule.distance_squared([x, y]).sqrt() - reach;
                let inside = section.is_some_and(|[from, to]| from <= y && y <= to);
                prop_assert!(off.abs() < 1e-9 || inside == (off < 0.0), "y = {y}: {off} m off, section {section:?}");
            }
        }
    }

    #[test]
    fn lengths_that_overlap_count_once() {
        let mut others = [
            [0.5, 0.7],
            [-1.0, 0.1],
            [0.6, 0.8],
            [0.05, 0.2],
            [0.95, 3.0],
            [4.0, 5.0],
        ];
        assert!((covered_length([0.0, 1.0], &mut others) - 0.55).abs() < 1e-15);
        assert_eq!(covered_length([0.0, 1.0], &mut []), 0.0);
    }
}
