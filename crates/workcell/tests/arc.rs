//! Arcs between plates.

use nalgebra::Vector3;
use platewash_workcell::arc::*;
use proptest::prelude::*;
use std::f64::consts::TAU;

const ARC: Arc = Arc {
    points: 5,
    radius_m: 0.35,
    height_m: 0.25,
};

proptest! {
    #[test]
    fn the_arc_goes_the_shorter_way_at_its_radius_and_height(a in 0.0..TAU, b in 0.0..TAU, r in 0.1..0.6f64) {
        let place = |angle: f64| Vector3::new(r * angle.cos(), r * angle.sin(), 0.08);
        let path = waypoints(place(a), place(b), &ARC);
        prop_assert_eq!(path.len(), 7);
        prop_assert_eq!((path[0], path[6]), (place(a), place(b)));
        for p in &path[1..6] {
            prop_assert!((p.xy().norm() - 0.35).abs() < 1e-14 && p.z == 0.25);
        }
        let total: f64 = path[1..6].windows(2).map(|w| w[0].xy().angle(&w[1].xy())).sum();
        prop_assert!((total - place(a).xy().angle(&place(b).xy())).abs() < 1e-6, "turned {total}");
        // The ends of the arc stand over the ends of the path.
        prop_assert!(path[1].xy().angle(&path[0].xy()) < 1e-7);
        prop_assert!(path[5].xy().angle(&path[6].xy()) < 1e-7);
    }
}

#[test]
fn arcs_take_no_detour_at_the_seam_of_atan2() {
    let path = waypoints(Vector3::new(-0.3, 0.01, 0.08), Vector3::new(-0.3, -0.01, 0.08), &ARC);
    assert!(path[1..6].iter().all(|p| p.x < -0.34), "{path:?}");
}
