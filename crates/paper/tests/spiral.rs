//! The spiral and its ring, waypoint by waypoint.

use platewash_paper::PaperSpiral;
use std::f64::consts::TAU;

const PAPER: PaperSpiral = PaperSpiral {
    points: 55,
    turns: 3.0,
    radius_m: 0.145,
    closing_ring: false,
};

#[test]
fn the_papers_spiral_turns_20_degrees_a_waypoint_and_ends_on_the_x_axis() {
    let points = PAPER.waypoints([0.25, -0.25]);
    assert_eq!(points.len(), 55);
    assert_eq!(points[0], [0.25, -0.25]);
    let end = points[54];
    assert!((end[0] - 0.395).abs() < 1e-15 && (end[1] + 0.25).abs() < 1e-15);
    for (k, p) in points.iter().enumerate().skip(1) {
        let (dx, dy) = (p[0] - 0.25, p[1] + 0.25);
        assert!(((dx * dx + dy * dy).sqrt() - 0.145 * k as f64 / 54.0).abs() < 1e-15);
        let angle = dy.atan2(dx).rem_euclid(TAU);
        let expected = (20.0_f64 * k as f64).to_radians().rem_euclid(TAU);
        let off = (angle - expected).abs();
        assert!(off.min(TAU - off) < 1e-12, "waypoint {k}");
    }
}

#[test]
fn the_ring_is_a_full_circle_that_starts_where_the_spiral_ends() {
    let ringed = PaperSpiral {
        closing_ring: true,
        turns: 2.5,
        ..PAPER
    };
    let points = ringed.waypoints([0.0, 0.0]);
    let ring = &points[54..];
    assert_eq!(ring.len() - 1, 22, "54 steps over 2.5 turns are 21.6 a turn");
    let endless = PaperSpiral { turns: 1e-9, ..ringed };
    assert_eq!(endless.waypoints([0.0, 0.0]).len(), 55 + 3600);
    for spiral in [PAPER, ringed, endless] {
        assert_eq!(spiral.waypoint_count(), spiral.waypoints([0.0, 0.0]).len());
    }
    let (first, last) = (ring[0], ring[ring.len() - 1]);
    assert!((first[0] - last[0]).abs() < 1e-14 && (first[1] - last[1]).abs() < 1e-14);
    assert!(
        ring.iter()
            .all(|p| ((p[0] * p[0] + p[1] * p[1]).sqrt() - 0.145).abs() < 1e-15)
    );
}
