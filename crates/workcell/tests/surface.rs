use nalgebra::{Point3, Vector3};
use platewash_workcell::surface::*;
use proptest::prelude::*;
use std::f64::consts::PI;

#[test]
fn a_disc_is_flat_with_its_exact_area() {
    let disc = Surface::Disc { radius_m: 0.2 };
    let rim = disc.point(disc.rim_m(), 0.5 * PI);
    assert!((rim - Point3::new(0.0, 0.2, 0.0)).norm() < 1e-15);
    assert_eq!(disc.normal(0.1, 1.0), Vector3::z_axis());
    assert_eq!((disc.height_m(0.2), disc.curvature_bounds()), (0.0, [0.0; 2]));
    assert!((disc.area_m2() - 0.04 * PI).abs() < 1e-15);
}

/// Depth, arc and area of the profiles that come along, as they are stated \[mm, mm, cm²\], and their least radii \[mm\].
#[test]
fn shipped_profiles_are_as_documented() {
    for (name, depth, arc, area, [hollow, dome]) in [
        ("coupe275", 20.5, 140.6, 616.0, [74.0, 19.0]),
        ("rim270", 14.2, 137.5, 588.0, [18.0, 21.0]),
        ("deep230", 30.1, 123.3, 457.0, [55.0, 14.0]),
        ("dessert190", 10.2, 96.4, 291.0, [70.0, 10.0]),
    ] {
        let plate = Surface::shipped(name).unwrap();
        let [least, most] = plate.curvature_bounds();
        for (found, stated, within) in [
            (1e3 * plate.height_m(plate.rim_m()), depth, 0.06),
            (1e3 * plate.arc_m(), arc, 0.06),
            (1e4 * plate.area_m2(), area, 0.6),
            (1e3 / most, hollow, 1.0),
            (-1e3 / least, dome, 1.0),
        ] {
            assert!((found - stated).abs() <= within, "{name}: {found} {stated}");
        }
    }
    assert_eq!(Surface::shipped("bowl"), None);
    assert!(SHIPPED_PROFILES.iter().all(|name| Surface::shipped(name).is_some()));
}

fn knots() -> impl Strategy<Value = Vec<Knot>> {
    prop::collection::vec((0.001..0.05f64, -1.0..1.0f64), 1..=MOST_KNOTS).prop_map(|steps| {
        let mut radius_m = 0.0;
        let knot = |(step, slope_rad)| {
            radius_m += step;
            Knot { radius_m, slope_rad }
        };
        steps.into_iter().map(knot).collect()
    })
}

proptest! {
    /// By small steps along the meridian: its slope, its curvature and its area are those of the points.
    #[test]
    fn points_slopes_and_areas_are_consistent(knots in knots(), share in 0.01..0.99f64) {
        let meridian = Meridian::new(&knots).unwrap();
        let arc_m = share * meridian.arc_m();
        let (here, h) = (meridian.at_arc(arc_m), 1e-6);
        let by_radius = meridian.at_radius(here.radius_m);
        prop_assert!((by_radius.height_m - here.height_m).abs() < 1e-12);
        prop_assert!((by_radius.sine - here.sine).abs() < 1e-9);
        prop_assert!((meridian.arc_at(here.radius_m) - arc_m).abs() < 1e-12);
        prop_assert!((here.sine.hypot(here.cosine) - 1.0).abs() < 1e-12);
        let [a, b] = [-h, h].map(|d| meridian.at_arc(arc_m + d));
        let [along, up] = [(b.radius_m - a.radius_m) / (2.0 * h), (b.height_m - a.height_m) / (2.0 * h)];
        prop_assert!((along - here.cosine).abs() < 1e-3 && (up - here.sine).abs() < 1e-3);
        let [least, most] = meridian.patch([0.0, meridian.rim_m()]).curvature;
        prop_assert!((least..=most).contains(&here.curvature));
        let across = here.sine / here.radius_m;
        prop_assert!(across >= least - 1e-6 && across <= most + 1e-6, "{across} {least} {most}");
        let rings = (0..4000).map(|k| {
            let [a, b] = [k, k + 1].map(|k| meridian.at_arc(arc_m * f64::from(k) / 4000.0));
            PI * (a.radius_m + b.radius_m) * (b.radius_m - a.radius_m).hypot(b.height_m - a.height_m)
        });
        let area: f64 = rings.sum();
        prop_assert!((meridian.area_within_m2(here.radius_m) / area - 1.0).abs() < 1e-5);
    }

    #[test]
    fn reads_back_what_was_written(knots in knots()) {
        let surface = Surface::profile(&knots).unwrap();
        let text = serde_json::to_string(&surface).unwrap();
        prop_assert_eq!(serde_json::from_str::<Surface>(&text).unwrap(), surface, "{}", text);
    }
}

#[test]
fn a_level_profile_is_a_disc() {
    let knots = [0.05, 0.145].map(|radius_m| Knot {
        radius_m,
        slope_rad: 0.0,
    });
    assert_eq!(Surface::profile(&knots).unwrap(), Surface::Disc { radius_m: 0.145 });
}

#[test]
fn rejects_invalid_meridians_by_their_knot() {
    let knot = |radius_m, slope_rad| Knot { radius_m, slope_rad };
    for (knots, said) in [
        (vec![], "from 1 to 16 knots; found 0"),
        (vec![knot(0.1, 0.1); 17], "found 17"),
        (
            vec![knot(0.1, 0.1), knot(0.1, 0.2)],
            "knot 1 of the profile: radius 0.1 m",
        ),
        (vec![knot(f64::NAN, 0.1)], "knot 0"),
        (vec![knot(f64::INFINITY, 0.1)], "knot 0"),
        (vec![knot(0.0, 0.1)], "knot 0"),
        (vec![knot(0.1, 1.1)], "slope 1.1 rad"),
        (vec![knot(0.1, f64::NAN)], "slope NaN"),
        (
            vec![knot(0.05, 0.0), knot(0.05 + 1e-7, 1.0), knot(0.1, 1.0)],
            "knot 1 of the profile: the face turns towards it with a radius of 0.00000011",
        ),
        (vec![knot(1e-5, 0.5)], "knot 0 of the profile: the face turns"),
        (vec![knot(0.1, 0.5), knot(0.10005, -0.5)], "expected 0.0001 m or more"),
    ] {
        let error = Surface::profile(&knots).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    let text = r#"{"meridian":"profile","knots":[{"radius_m":0.1,"slope_rad":2.0}]}"#;
    assert!(
        serde_json::from_str::<Surface>(text)
            .unwrap_err()
            .to_string()
            .contains("slope 2 rad")
    );
}

#[test]
fn an_outline_hits_every_knot_and_stays_near_the_meridian() {
    for name in SHIPPED_PROFILES {
        let surface = Surface::shipped(name).unwrap();
        let Surface::Profile(meridian) = surface else {
            panic!("{name} is flat")
        };
        let outline = surface.outline_m(0.06);
        for knot in meridian.knots() {
            let end = [knot.radius_m, surface.height_m(knot.radius_m)];
            assert!(outline.contains(&end), "{name}: {knot:?}");
        }
        for pair in outline.windows(2) {
            assert!(pair[1][0] > pair[0][0], "{name}: {pair:?}");
            let middle = [0, 1].map(|i| 0.5 * (pair[0][i] + pair[1][i]));
            assert!(
                (middle[1] - surface.height_m(middle[0])).abs() < 1e-3,
                "{name}: {pair:?}"
            );
        }
    }
    assert_eq!(
        Surface::Disc { radius_m: 0.1 }.outline_m(0.06),
        [[0.0, 0.0], [0.1, 0.0]]
    );
}

/// Points stand for the whole face: their areas add up to it, and a place within reach of none is too far from all.
#[test]
fn points_cover_the_face_by_its_area() {
    let faces = [Surface::Disc { radius_m: 0.145 }].into_iter();
    for surface in faces.chain(SHIPPED_PROFILES.iter().filter_map(|name| Surface::shipped(name))) {
        let points: Vec<_> = surface.points(0.004).collect();
        let area_m2: f64 = points.iter().map(|(_, area_m2)| area_m2).sum();
        assert!((area_m2 / surface.area_m2() - 1.0).abs() < 1e-9, "{area_m2}");
        for (rho_m, phi_rad) in (0..200).map(|k| (surface.rim_m() * f64::from(k) / 199.0, 2.4 * f64::from(k))) {
            let place = surface.point(rho_m, phi_rad).coords;
            let nearest_m = points
                .iter()
                .map(|(point, _)| (point - place).norm())
                .fold(f64::INFINITY, f64::min);
            assert!(nearest_m < 0.004, "{place:?}: {nearest_m}");
        }
    }
}
