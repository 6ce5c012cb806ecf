//! Regions of plates: their borders, and the footprint of the base beside them.

use platewash_kinematics::RobotModel;
use platewash_workcell::layout::{Region, base_footprint};
use proptest::prelude::*;
type Point = [f64; 2];

/// True if a point is in a polygon: a ray from it crosses the border an odd number of times.
fn contains(polygon: &[Point], [x, y]: Point) -> bool {
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crossed =
        edges.filter(|([ax, ay], [bx, by])| (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax));
    crossed.count() % 2 == 1
}

fn area(polygon: &[Point]) -> f64 {
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    0.5 * edges.map(|([ax, ay], [bx, by])| ax * by - bx * ay).sum::<f64>()
}

#[test]
fn rectangles_and_sectors_agree_with_hand_calculation() {
    let appendix = Region::PAPER_APPENDIX.outline_m();
    assert_eq!(appendix, [[0.0, -0.38], [0.30, -0.38], [0.30, 0.38], [0.0, 0.38]]);
    let square = |rho_m, azimuth_deg| Region {
        x_m: [-1.0, 1.0],
        y_m: [-1.0, 1.0],
        rho_m,
        azimuth_deg,
    };
    let close = |region: Region, expected: f64| {
        let found = area(&region.outline_m());
        assert!((found - expected).abs() < 1e-3 * expected, "{found} {expected}");
    };
    let pi = std::f64::consts::PI;
    close(square(Some([0.0, 0.5]), None), 0.25 * pi);
    close(square(Some([0.3, 0.5]), None), 0.16 * pi);
    close(square(Some([0.0, 0.5]), Some([-90.0, 180.0])), 0.75 * 0.25 * pi);
    close(square(None, Some([0.0, 90.0])), 1.0);
    close(square(None, Some([-45.0, 45.0])), 1.0);
}

#[test]
fn a_region_without_points_has_no_border() {
    let region = Region {
        rho_m: Some([0.1, 0.2]),
        x_m: [1.0, 2.0],
        ..Region::PAPER_TEXT
    };
    assert!(region.outline_m().is_empty());
}

proptest! {
    /// A point is in the polygon if it belongs to the region, except in a strip along arcs as narrow as a chord's height.
    #[test]
    fn the_border_is_that_of_the_region(
        x in [-0.6..0.0f64, 0.1..0.6f64], y in [-0.6..0.0f64, 0.1..0.6f64], rho in [0.0..0.3f64, 0.31..0.9f64],
        azimuth in (-300.0..300.0f64, 10.0..360.0f64), parts in 0..4u8, point in prop::array::uniform2(-0.7..0.7f64),
    ) {
        let region = Region {
            x_m: x,
            y_m: y,
            rho_m: (parts & 1 > 0).then_some(rho),
            azimuth_deg: (parts & 2 > 0).then_some([azimuth.0, azimuth.0 + azimuth.1]),
        };
        let off = 1e-3;
        let around = [[off, 0.0], [-off, 0.0], [0.0, off], [0.0, -off]].map(|[dx, dy]| [point[0] + dx, point[1] + dy]);
        let belongs = region.contains(point);
        prop_assume!(around.iter().all(|near| region.contains(*near) == belongs));
        prop_assert_eq!(contains(&region.outline_m(), point), belongs);
    }
}

#[test]
fn the_base_footprint_of_the_irb120_has_its_bounds() {
    let foot = base_footprint(&RobotModel::irb120().unwrap());
    let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9;
    assert!(close(foot.x_m, [-0.2115, 0.0905]), "{foot:?}");
    assert!(close(foot.y_m, [-0.0905, 0.0905]), "{foot:?}");
}
