#![allow(clippy::unwrap_used)]

use crate::layout::sampling::*;
use platewash_kinematics::trig::{atan2, sin_cos};
use rand::SeedableRng;
use rand_pcg::Pcg64;

const SPACING: Spacing = Spacing {
    min_distance_m: 0.28,
    base_radius_m: 0.25,
};

fn sampler(region: &Region) -> Sampler {
    Sampler::new(region, &SPACING).unwrap()
}

/// Returns a sampler of the same law that draws from cells from the first draw on.
fn by_cells(region: &Region, spacing: &Spacing) -> Sampler {
    Sampler {
        box_draws: 0,
        ..Sampler::new(region, spacing).unwrap()
    }
}

fn squared_distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
}

/// True if a point is free by the definition of the law.
fn is_free(region: &Region, spacing: &Spacing, placed: &[[f64; 2]], p: [f64; 2]) -> bool {
    region.contains(p)
        && squared_distance(p, [0.0, 0.0]).sqrt() > spacing.base_radius_m
        && placed
            .iter()
            .all(|&q| squared_distance(p, q).sqrt() > spacing.min_distance_m)
}

/// Dead ends per 20,000 layouts, against rates measured independently on about 1,500 layouts each (their 95 % half width is 2.5 points, a
/// standard error of 1.28).
#[test]
fn dead_ends_are_as_frequent_as_measured() {
    let measured = [
        (Region::PAPER_TEXT, [3.4, 55.8, 96.9]),
        (Region::PAPER_APPENDIX, [2.5, 59.2, 96.4]),
    ];
    let attempts = 20_000;
    for (region, rates) in measured {
        for (count, rate) in (3..).zip(rates) {
            for sampler in [sampler(&region), by_cells(&region, &SPACING)] {
                let mut rng = Pcg64::seed_from_u64(7);
                let dead =
                    (0..attempts).filter(|_| matches!(sampler.attempt(count, &mut rng), Attempt::DeadEnd { .. }));
                let percent = 100.0 * dead.count() as f64 / f64::from(attempts);
                let own = (percent * (100.0 - percent) / f64::from(attempts)).sqrt();
                let allowed = 3.0 * (own * own + (2.5_f64 / 1.96).powi(2)).sqrt();
                assert!(
                    (percent - rate).abs() < allowed,
                    "{count} plates: {percent} %, not {rate} %"
                );
            }
        }
    }
}

/// Returns Pearson's χ² of draws beside `placed`, in bins of equal size over a box, against the free area of every bin, in standard
/// deviations from its mean.
fn uniformity(sampler: &Sampler, region: &Region, placed: &[[f64; 2]], low: [f64; 2], high: [f64; 2]) -> f64 {
    let (bins, fine, draws) = (12_usize, 60_usize, 100_000);
    let step = [0, 1].map(|k| (high[k] - low[k]) / (bins * fine) as f64);
    let mut expected = vec![0.0; bins * bins];
    for j in 0..bins * fine {
        for i in 0..bins * fine {
            let p = [low[0] + (i as f64 + 0.5) * step[0], low[1] + (j as f64 + 0.5) * step[1]];
            if is_free(region, &sampler.spacing, placed, p) {
                expected[j / fine * bins + i / fine] += 1.0;
            }
        }
    }
    let free: f64 = expected.iter().sum();
    let mut found = vec![0.0; bins * bins];
    let mut rng = Pcg64::seed_from_u64(11);
    for _ in 0..draws {
        let p = sampler.place(placed, &mut rng).unwrap();
        assert!(is_free(region, &sampler.spacing, placed, p));
        let [i, j] = [0, 1].map(|k| (((p[k] - low[k]) / (step[k] * fine as f64)) as usize).min(bins - 1));
        found[j * bins + i] += 1.0;
    }
    // Bins with few expected draws are pooled: the χ² law and the fine grid hold for large ones.
    let (mut chi_squared, mut used, mut rest) = (0.0, 0.0, [0.0, 0.0]);
    for (found, cells) in found.iter().zip(&expected) {
        let expected = cells / free * f64::from(draws);
        if *cells < 0.3 * (fine * fine) as f64 {
            rest = [rest[0] + found, rest[1] + expected];
        } else {
            chi_squared += (found - expected).powi(2) / expected;
            used += 1.0;
        }
    }
    if rest[1] > 10.0 {
        chi_squared += (rest[0] - rest[1]).powi(2) / rest[1];
        used += 1.0;
    }
    assert!(used > 4.0);
    (chi_squared - (used - 1.0)) / (2.0 * (used - 1.0_f64)).sqrt()
}

#[test]
fn plates_are_uniform_over_the_free_area() {
    let text = Region::PAPER_TEXT;
    let ring = Region {
        x_m: [-0.6, 0.6],
        y_m: [-0.6, 0.6],
        rho_m: Some([0.3, 0.55]),
        azimuth_deg: Some([-130.0, 110.0]),
    };
    for (region, low, high) in [(text, [0.0, -0.38], [0.32, 0.32]), (ring, [-0.55, -0.55], [0.55, 0.55])] {
        for sampler in [sampler(&region), by_cells(&region, &SPACING)] {
            for placed in [&[][..], &[[0.2, -0.2]], &[[0.3, 0.1], [0.05, -0.37]]] {
                let sigmas = uniformity(&sampler, &region, placed, low, high);
                assert!(sigmas.abs() < 4.0, "{placed:?}: {sigmas} standard deviations");
            }
        }
    }
}

/// Returns three discs about the origin that leave a three-pointed gap of `slack` between them.
fn three_around(slack: f64) -> Vec<[f64; 2]> {
    let at = |degrees: f64| {
        let (sin, cos) = sin_cos(degrees.to_radians());
        [(0.28 + slack) * cos, (0.28 + slack) * sin]
    };
    vec![at(90.0), at(210.0), at(330.0)]
}

#[test]
fn a_gap_of_a_billionth_is_found_and_sampled_uniformly() {
    let region = Region {
        x_m: [-0.0513, 0.0487],
        y_m: [-0.0491, 0.0509],
        rho_m: None,
        azimuth_deg: None,
    };
    let spacing = Spacing {
        base_radius_m: 0.0,
        ..SPACING
    };
    let sampler = Sampler::new(&region, &spacing).unwrap();
    let mut rng = Pcg64::seed_from_u64(3);
    // Gap area 3√3 slack²: 5e-10 of the region at 1e-6.
    for slack in [1e-3, 1e-5, 1e-6, 1e-7, 2e-8] {
        let placed = three_around(slack);
        let (mut corners, mut inner) = ([0_u32; 3], 0);
        for _ in 0..600 {
            let p = sampler.place(&placed, &mut rng).unwrap();
            assert!(is_free(&region, &spacing, &placed, p));
            // One corner at 30°, one at 150°, one at 270°.
            corners[((atan2(p[1], p[0]).to_degrees() + 390.0) % 360.0 / 120.0) as usize] += 1;
            inner += u32::from(squared_distance(p, [0.0, 0.0]) < slack * slack);
        }
        // So small a gap is a triangle: a third lies about each corner, π/(3√3) = 0.6046 in the inscribed circle.
        let chi_squared: f64 = corners.iter().map(|&n| (f64::from(n) - 200.0).powi(2) / 200.0).sum();
        assert!(
            chi_squared < 16.0 && (f64::from(inner) - 362.8).abs() < 48.0,
            "{slack}: {corners:?} {inner}"
        );
    }
    for slack in [-1e-3, -1e-6, -1e-8] {
        assert_eq!(sampler.place(&three_around(slack), &mut rng), None, "{slack}");
    }
}

/// True if any point is free, by another method: every component of the free part has a boundary arc between neighbouring crossings of two
/// boundary curves, and next to the middle of that arc lies a free point.
fn has_room_by_arcs(region: &Region, spacing: &Spacing, placed: &[[f64; 2]]) -> bool {
    let tiny = 1e-9;
    let ([x0, x1], [y0, y1]) = (region.x_m, region.y_m);
    let mut circles: Vec<([f64; 2], f64)> = placed.iter().map(|&c| (c, spacing.min_distance_m)).collect();
    circles.push(([0.0, 0.0], spacing.base_radius_m));
    let free = |p| is_free(region, spacing, placed, p);
    let angle = |c: [f64; 2], p: [f64; 2]| atan2(p[1] - c[1], p[0] - c[0]);
    // Crossings of a circle with the line p[k] = v.
    let with_line = |(c, r): ([f64; 2], f64), k: usize, v: f64| -> Vec<[f64; 2]> {
        let rest = r * r - (v - c[k]) * (v - c[k]);
        let mut ends = Vec::new();
        if rest > 0.0 {
            for sign in [-1.0, 1.0] {
                let mut p = [v, v];
                p[1 - k] = c[1 - k] + sign * rest.sqrt();
                ends.push(p);
            }
        }
        ends
    };
    let edges = [
        (0, x0, 1.0, y0, y1),
        (0, x1, -1.0, y0, y1),
        (1, y0, 1.0, x0, x1),
        (1, y1, -1.0, x0, x1),
    ];
    for &(k, v, inward, from, to) in &edges {
        let mut cuts = vec![from, to];
        cuts.extend(
            circles
                .iter()
                .flat_map(|&circle| with_line(circle, k, v))
                .map(|p| p[1 - k]),
        );
        cuts.sort_by(f64::total_cmp);
        for pair in cuts.windows(2) {
            let mut p = [v + inward * tiny; 2];
            p[1 - k] = 0.5 * (pair[0] + pair[1]);
            if free(p) {
                return true;
            }
        }
    }
    for &(c, r) in &circles {
        let mut cuts: Vec<f64> = edges
            .iter()
            .flat_map(|e| with_line((c, r), e.0, e.1))
            .map(|p| angle(c, p))
            .collect();
        for &(other, s) in &circles {
            let d = squared_distance(c, other).sqrt();
            let cos = (d * d + r * r - s * s) / (2.0 * d * r);
            if d > 0.0 && cos.abs() < 1.0 {
                cuts.extend([-1.0, 1.0].map(|sign| angle(c, other) + sign * platewash_kinematics::trig::acos(cos)));
            }
        }
        cuts = cuts
            .iter()
            .map(|a| a.rem_euclid(std::f64::consts::TAU))
            .chain([0.0])
            .collect();
        cuts.sort_by(f64::total_cmp);
        cuts.push(cuts[0] + std::f64::consts::TAU);
        for pair in cuts.windows(2) {
            let (sin, cos) = sin_cos(0.5 * (pair[0] + pair[1]));
            if free([c[0] + (r + tiny) * cos, c[1] + (r + tiny) * sin]) {
                return true;
            }
        }
    }
    false
}

/// True if a point of a grid is free.
fn has_room_by_grid(region: &Region, spacing: &Spacing, placed: &[[f64; 2]], n: usize) -> bool {
    let coordinate = |[low, high]: [f64; 2], i: usize| low + (high - low) * (i as f64 + 0.5) / n as f64;
    (0..n * n).any(|k| {
        is_free(
            region,
            spacing,
            placed,
            [coordinate(region.x_m, k % n), coordinate(region.y_m, k / n)],
        )
    })
}

#[test]
fn dead_ends_agree_with_arcs_and_with_a_grid() {
    let mut rng = Pcg64::seed_from_u64(5);
    let (mut dead, mut cases) = (0, 0);
    for region in [Region::PAPER_TEXT, Region::PAPER_APPENDIX] {
        let sampler = sampler(&region);
        for _ in 0..1500 {
            let mut placed = Vec::new();
            loop {
                let next = sampler.place(&placed, &mut rng);
                cases += 1;
                assert_eq!(
                    next.is_some(),
                    has_room_by_arcs(&region, &SPACING, &placed),
                    "{placed:?}"
                );
                let Some(p) = next else { break };
                assert!(is_free(&region, &SPACING, &placed, p));
                placed.push(p);
            }
            dead += 1;
            assert!(!has_room_by_grid(&region, &SPACING, &placed, 100), "{placed:?}");
        }
    }
    assert!(dead == 3000 && cases > 10_000);
}

#[test]
fn every_region_keeps_the_rules() {
    let base = Region {
        x_m: [-0.6, 0.6],
        y_m: [-0.6, 0.6],
        rho_m: None,
        azimuth_deg: None,
    };
    let regions = [
        Region {
            rho_m: Some([0.3, 0.5]),
            ..base
        },
        Region {
            rho_m: Some([0.25, 5.0]),
            azimuth_deg: Some([-110.0, 110.0]),
            ..base
        },
        Region {
            azimuth_deg: Some([170.0, 190.0]),
            ..base
        },
        Region {
            azimuth_deg: Some([30.0, 390.0]),
            rho_m: Some([0.0, 0.4]),
            ..base
        },
        Region {
            azimuth_deg: Some([90.0, 90.001]),
            ..base
        },
    ];
    let mut rng = Pcg64::seed_from_u64(1);
    for region in regions {
        let sampler = sampler(&region);
        for _ in 0..200 {
            let mut placed = Vec::new();
            while let Some(p) = sampler.place(&placed, &mut rng) {
                assert!(is_free(&region, &SPACING, &placed, p), "{region:?} {p:?}");
                placed.push(p);
            }
            assert!(
                !placed.is_empty() && !has_room_by_grid(&region, &SPACING, &placed, 60),
                "{region:?}"
            );
        }
    }
}

#[test]
fn many_plates_are_drawn_as_few_are() {
    // Buckets against the linear search: the same generator gives the same plates.
    let region = Region {
        x_m: [1.0, 4.0],
        y_m: [-3.0, 1.0],
        rho_m: None,
        azimuth_deg: None,
    };
    let sampler = sampler(&region);
    let Attempt::Placed(all) = sampler.attempt(60, &mut Pcg64::seed_from_u64(2)) else {
        unreachable!()
    };
    let Attempt::Placed(few) = sampler.attempt(20, &mut Pcg64::seed_from_u64(2)) else {
        unreachable!()
    };
    assert_eq!(all[..20], few);
    for (i, &p) in all.iter().enumerate() {
        assert!(is_free(&region, &SPACING, &all[..i], p));
    }
}
