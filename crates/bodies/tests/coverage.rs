use std::f64::consts::PI;

use proptest::prelude::*;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use platewash_bodies::coverage::*;
use platewash_kinematics::trig::sin_cos;

const PLATE: f64 = 0.145;

fn swept(polyline: &[[f64; 2]], radius_m: f64, sponge_radius_m: f64) -> Coverage {
    coverage(polyline, [0.0, 0.0], radius_m, sponge_radius_m, 1e-3).unwrap()
}

fn assert_brackets(coverage: Coverage, truth: f64, within: f64) {
    assert!(
        coverage.lower <= truth && truth <= coverage.upper,
        "{coverage:?} does not contain {truth}"
    );
    assert!(
        coverage.lower <= coverage.fraction && coverage.fraction <= coverage.upper,
        "{coverage:?}"
    );
    assert!(
        (coverage.fraction - truth).abs() < within,
        "{coverage:?} is far from {truth}"
    );
}

/// The paper's spiral: θ = linspace(0, 6π, 55), r = linspace(0, 0.145, 55).
fn paper_spiral() -> Vec<[f64; 2]> {
    let point = |i: usize| {
        let part = i as f64 / 54.0;
        let (sin, cos) = sin_cos(6.0 * PI * part);
        [PLATE * part * cos, PLATE * part * sin]
    };
    (0..55).map(point).collect()
}

#[test]
fn an_empty_path_sweeps_nothing() {
    let nothing = swept(&[], PLATE, 0.025);
    assert!(nothing.fraction.abs() < 1e-12 && nothing.lower == 0.0 && nothing.upper < 1e-10);
    let far_away = swept(&[[3.0, 0.0], [3.0, 1.0]], PLATE, 0.025);
    assert!(far_away.fraction.abs() < 1e-12 && far_away.upper < 1e-10);
}

#[test]
fn a_centred_stamp_covers_the_square_of_the_ratio() {
    for s in [0.0004, 0.01, 0.025, 0.1, 0.144] {
        assert_brackets(swept(&[[0.0, 0.0]], PLATE, s), (s / PLATE) * (s / PLATE), 1e-3);
    }
}

/// Where the sponge's edge runs along the plate's rim, both cut the same cells.
#[test]
fn a_stamp_that_meets_the_rim_is_estimated_as_closely_as_any() {
    assert_brackets(swept(&[[0.0, 0.0]], PLATE, PLATE), 1.0, 1e-12);
    for short_m in [1e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3] {
        let ratio = (PLATE - short_m) / PLATE;
        assert_brackets(swept(&[[0.0, 0.0]], PLATE, PLATE - short_m), ratio * ratio, 2e-5);
    }
    // A ring whose outer edge is the rim, of chords that leave their arc by less than a micrometre: all but the middle.
    let (s, n) = (0.05, 2000);
    let at = |i: usize| {
        let (sin, cos) = sin_cos(2.0 * PI * i as f64 / n as f64);
        [(PLATE - s) * cos, (PLATE - s) * sin]
    };
    let ring: Vec<_> = (0..=n).map(at).collect();
    let left = (PLATE - 2.0 * s) / PLATE;
    assert_brackets(swept(&ring, PLATE, s), 1.0 - left * left, 2e-5);
}

#[test]
fn a_centred_stamp_is_estimated_to_a_few_parts_in_a_hundred_thousand() {
    for s in [0.01, 0.025, 0.05, 0.0725, 0.1, 0.12, 0.14] {
        assert_brackets(swept(&[[0.0, 0.0]], PLATE, s), (s / PLATE) * (s / PLATE), 5e-5);
    }
}

#[test]
fn a_large_stamp_covers_all() {
    let all = swept(&[[0.02, 0.0]], PLATE, 0.2);
    assert!(all.fraction == 1.0 && all.upper == 1.0 && all.lower > 1.0 - 1e-10);
}

#[test]
fn a_straight_stroke_covers_a_stadium() {
    let (length, s) = (0.12, 0.02);
    let truth = (2.0 * s * length + PI * s * s) / (PI * PLATE * PLATE);
    let ends = [[-0.05, -0.03], [-0.05 + 0.8 * length, -0.03 + 0.6 * length]];
    assert_brackets(swept(&ends, PLATE, s), truth, 1e-3);
    // Repeated and collinear points, and a stroke back, change nothing.
    let middle = [0.5 * (ends[0][0] + ends[1][0]), 0.5 * (ends[0][1] + ends[1][1])];
    let there_and_back = [ends[0], ends[0], middle, ends[1], ends[1], ends[0]];
    assert_brackets(swept(&there_and_back, PLATE, s), truth, 1e-3);
}

#[test]
fn a_stamp_on_the_rim_covers_a_lens() {
    // Two discs of radii R and s whose centres are R apart.
    let s = 0.05;
    let d = PLATE;
    let cut_s = s * s / (2.0 * d);
    let cut_r = d - cut_s;
    let segment = |r: f64, h: f64| r * r * platewash_kinematics::trig::acos(h / r) - h * (r * r - h * h).sqrt();
    let truth = (segment(s, cut_s) + segment(PLATE, cut_r)) / (PI * PLATE * PLATE);
    assert_brackets(swept(&[[0.0, PLATE]], PLATE, s), truth, 1e-3);
}

#[test]
fn the_papers_spiral_sweeps_the_measured_share() {
    let measured = [
        (10, 41.0),
        (15, 60.0),
        (20, 79.0),
        (25, 92.8),
        (30, 95.7),
        (35, 97.9),
        (40, 99.3),
        (45, 100.0),
    ];
    for (sponge_mm, percent) in measured {
        let coverage = swept(&paper_spiral(), PLATE, 1e-3 * f64::from(sponge_mm));
        assert!(
            (100.0 * coverage.fraction - percent).abs() < 0.5,
            "{sponge_mm} mm: {coverage:?}, not {percent} %"
        );
        assert!(coverage.error() < 0.08, "{sponge_mm} mm: {coverage:?}");
    }
}

#[test]
fn a_closing_ring_covers_nearly_all() {
    // Four turns to R = 0.12 m and a ring.
    let at = |r: f64, turns: f64| {
        let (sin, cos) = sin_cos(2.0 * PI * turns);
        [r * cos, r * sin]
    };
    let mut path: Vec<_> = (0..=400)
        .map(|i| at(0.12 * f64::from(i) / 400.0, f64::from(i) / 100.0))
        .collect();
    path.extend((1..=100).map(|i| at(0.12, f64::from(i) / 100.0)));
    let coverage = coverage(&path, [0.0, 0.0], PLATE, 0.025, 1e-4).unwrap();
    assert!(
        (coverage.fraction - 0.999).abs() < 1e-3 && coverage.error() < 2e-3,
        "{coverage:?}"
    );
}

#[test]
fn the_swept_share_does_not_depend_on_the_frame() {
    let centre = [0.31, -0.27];
    let moved: Vec<_> = paper_spiral()
        .iter()
        .map(|p| [p[0] + centre[0], p[1] + centre[1]])
        .collect();
    let here = swept(&paper_spiral(), PLATE, 0.025);
    let there = coverage(&moved, centre, PLATE, 0.025, 1e-3).unwrap();
    assert!((here.fraction - there.fraction).abs() < 1e-4);
}

#[test]
fn smaller_cells_shrink_the_error_in_proportion() {
    let error = |cell_m| {
        coverage(&paper_spiral(), [0.0, 0.0], PLATE, 0.025, cell_m)
            .unwrap()
            .error()
    };
    let ratio = error(1e-3) / error(1e-4);
    assert!(ratio > 8.0 && ratio < 12.0, "{ratio}");
}

#[test]
fn senseless_numbers_are_refused_by_name() {
    let call = |path: &[[f64; 2]], radius_m, sponge_m, cell_m| {
        coverage(path, [0.0, 0.0], radius_m, sponge_m, cell_m).unwrap_err()
    };
    let nan = f64::NAN;
    assert_eq!(
        call(&[[0.0, 0.0], [nan, 0.0]], 1.0, 1.0, 0.1),
        CoverageError::PathNotFinite { index: 1 }
    );
    assert_eq!(
        call(&[], 0.0, 1.0, 0.1),
        CoverageError::NotPositive {
            quantity: "radius_m",
            value_m: 0.0
        }
    );
    assert_eq!(
        call(&[], 1.0, -1.0, 0.1),
        CoverageError::NotPositive {
            quantity: "sponge_radius_m",
            value_m: -1.0
        }
    );
    assert!(matches!(
        call(&[], 1.0, 1.0, nan),
        CoverageError::NotPositive { quantity: "cell_m", .. }
    ));
    assert!(matches!(call(&[], 1.0, 1.0, 1e-9), CoverageError::CellTooSmall { .. }));
    let off = coverage(&[], [f64::INFINITY, 0.0], 1.0, 1.0, 0.1);
    assert_eq!(off.unwrap_err(), CoverageError::CentreNotFinite);
}

/// Fraction of random points of the unit disc within `s` of the polyline, by a plain loop.
fn monte_carlo(path: &[[f64; 2]], s: f64, points: usize, rng: &mut Pcg64) -> f64 {
    let mut unit = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let near = |p: [f64; 2], a: [f64; 2], b: [f64; 2]| {
        let (abx, aby, apx, apy) = (b[0] - a[0], b[1] - a[1], p[0] - a[0], p[1] - a[1]);
        let length_squared = abx * abx + aby * aby;
        let t = if length_squared > 0.0 {
            ((apx * abx + apy * aby) / length_squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let (dx, dy) = (apx - t * abx, apy - t * aby);
        dx * dx + dy * dy <= s * s
    };
    let hit =
        |p: [f64; 2]| path.windows(2).any(|w| near(p, w[0], w[1])) || (path.len() == 1 && near(p, path[0], path[0]));
    let (mut inside, mut hits) = (0, 0);
    while inside < points {
        let p = [2.0 * unit() - 1.0, 2.0 * unit() - 1.0];
        if p[0] * p[0] + p[1] * p[1] <= 1.0 {
            inside += 1;
            hits += usize::from(hit(p));
        }
    }
    hits as f64 / points as f64
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_bounds_contain_a_monte_carlo_estimate(
        path in prop::collection::vec([-1.3..1.3_f64, -1.3..1.3_f64], 0..12),
        s in 0.01..0.8_f64,
        cell_m in 0.01..0.2_f64,
        seed in any::<u64>(),
    ) {
        let coverage = coverage(&path, [0.0, 0.0], 1.0, s, cell_m).unwrap();
        prop_assert!(0.0 <= coverage.lower && coverage.lower <= coverage.fraction);
        prop_assert!(coverage.fraction <= coverage.upper && coverage.upper <= 1.0);
        let n = 20_000;
        let estimate = monte_carlo(&path, s, n, &mut Pcg64::seed_from_u64(seed));
        let slack = 5.0 * (estimate * (1.0 - estimate) / n as f64).sqrt() + 1e-3;
        prop_assert!(coverage.lower - slack <= estimate && estimate <= coverage.upper + slack, "{:?} {}", coverage, estimate);
    }

    #[test]
    fn finer_bounds_lie_between_coarser_ones_and_more_path_covers_no_less(
        path in prop::collection::vec([-1.3..1.3_f64, -1.3..1.3_f64], 1..12),
        s in 0.01..0.8_f64,
    ) {
        let at = |path: &[[f64; 2]], cell_m| coverage(path, [0.0, 0.0], 1.0, s, cell_m).unwrap();
        let (coarse, fine, part) = (at(&path, 0.08), at(&path, 0.01), at(&path[..path.len() - 1], 0.01));
        prop_assert!(coarse.lower <= fine.lower + 1e-9 && fine.upper <= coarse.upper + 1e-9);
        prop_assert!(part.fraction <= fine.fraction + 1e-12 && part.lower <= fine.lower + 1e-12);
    }
}

#[test]
fn a_share_meets_the_requirement_up_to_rounding() {
    assert!(reaches(0.995, 0.995) && reaches(0.995 - 9e-10, 0.995) && !reaches(0.995 - 1.1e-9, 0.995));
    assert!(reaches(-9e-13, 0.0) && !reaches(-1.1e-12, 0.0));
    assert!(!reaches(f64::NAN, 0.5) && !reaches(0.5, f64::NAN));
}
