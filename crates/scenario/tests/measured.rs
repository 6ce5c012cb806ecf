use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use platewash_scenario::measured::*;
use platewash_workcell::surface::{SHIPPED_PROFILES, Surface};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

type Triangle = [Point3<f64>; 3];

fn rng(seed: u64) -> Pcg64 {
    Pcg64::seed_from_u64(seed)
}

const THICKNESS_M: f64 = 4e-3;
const FOOT_M: [f64; 2] = [0.05, 3e-3];

/// Nearly normal, with a standard deviation of 1.
fn normal(rng: &mut Pcg64) -> f64 {
    (0..12).map(|_| rng.random_range(-0.5..0.5)).sum()
}

fn noise(rng: &mut Pcg64, sigma: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| sigma * normal(rng))
}

fn motion(rng: &mut Pcg64) -> Isometry3<f64> {
    let axis = Vector3::from_fn(|_, _| normal(rng)).normalize() * rng.random_range(0.0..3.1);
    let by = Vector3::from_fn(|_, _| rng.random_range(-0.5..0.5));
    Isometry3::from_parts(Translation3::from(by), UnitQuaternion::from_scaled_axis(axis))
}

/// Outline of a plate's half section from the pole over the rim to the middle below, about `step_m` apart; with the number of those of the face.
fn outline(surface: &Surface, step_m: f64) -> (Vec<[f64; 2]>, usize) {
    let rim_m = surface.rim_m();
    let rings = (rim_m / step_m).ceil() as usize;
    let mut points: Vec<[f64; 2]> = (0..=rings)
        .map(|k| rim_m * k as f64 / rings as f64)
        .map(|rho| [rho, surface.height_m(rho)])
        .collect();
    let below = |rho: f64| [rho, surface.height_m(rho) - THICKNESS_M];
    let [foot_m, high_m] = FOOT_M;
    let bottom_m = -THICKNESS_M - high_m;
    let corners = [
        below(rim_m),
        below(foot_m + 1e-3),
        [foot_m, bottom_m],
        [foot_m - 4e-3, bottom_m],
        below(foot_m - 6e-3),
        below(0.0),
    ];
    for (k, corner) in corners.iter().enumerate() {
        let from = points[points.len() - 1];
        let length = (corner[0] - from[0]).hypot(corner[1] - from[1]);
        let parts = (length / step_m).ceil().max(1.0) as usize;
        for part in 1..=parts {
            let share = part as f64 / parts as f64;
            let rho = from[0] + (corner[0] - from[0]) * share;
            // Along the underside, the outline is as far below the face all over.
            let curved = matches!(k, 1 | 5);
            points.push(if curved {
                below(rho)
            } else {
                [rho, from[1] + (corner[1] - from[1]) * share]
            });
        }
    }
    (points, rings + 1)
}

/// Surface of revolution of an outline as triangles.
fn revolved(
    outline: &[[f64; 2]],
    around: usize,
    mut at: impl FnMut(usize, usize, [f64; 2]) -> Point3<f64>,
) -> Vec<Triangle> {
    let grid: Vec<Vec<Point3<f64>>> = outline
        .iter()
        .enumerate()
        .map(|(ring, here)| {
            let count = if here[0] == 0.0 { 1 } else { around };
            (0..count).map(|k| at(ring, k, *here)).collect()
        })
        .collect();
    let mut triangles = Vec::new();
    for pair in grid.windows(2) {
        for k in 0..around {
            let corner = |ring: usize, k: usize| pair[ring][k % pair[ring].len()];
            let [a, b, c, d] = [corner(0, k), corner(1, k), corner(1, k + 1), corner(0, k + 1)];
            triangles.extend(
                [[a, b, c], [a, c, d]]
                    .into_iter()
                    .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]),
            );
        }
    }
    triangles
}

/// Mesh of a plate with about so many triangles, in its plate frame.
fn plate(surface: &Surface, count: usize, sigma: f64, rng: &mut Pcg64) -> (Vec<Triangle>, usize) {
    let around = (count as f64 * 1.1).sqrt().round() as usize;
    let step_m = (2.0 * surface.rim_m() + 0.03) * 2.0 * around as f64 / count as f64;
    let (outline, face) = outline(surface, step_m);
    let triangles = revolved(&outline, around, |ring, k, [rho, z]| {
        // The vertices of the face lie on it anywhere, but those of its rim.
        let inside = ring > 0 && ring + 1 < face;
        let mut jitter = || if inside { 0.3 * rng.random_range(-1.0..1.0) } else { 0.0 };
        let (rho, turned) = (rho + jitter() * step_m, jitter());
        let z = if inside { surface.height_m(rho) } else { z };
        let (s, c) = (TAU * (k as f64 + turned) / around as f64).sin_cos();
        Point3::new(rho * c, rho * s, z) + noise(rng, sigma)
    });
    (triangles, face)
}

fn moved(triangles: &[Triangle], by: impl Fn(&Point3<f64>) -> Point3<f64>) -> Vec<Triangle> {
    triangles.iter().map(|t| [0, 1, 2].map(|k| by(&t[k]))).collect()
}

/// Greatest difference of both profiles \[m\], pole on pole, from the axis to the lesser rim.
fn apart_m(a: &Surface, b: &Surface) -> f64 {
    let rim_m = a.rim_m().min(b.rim_m());
    let off = |k: usize| {
        let rho = rim_m * k as f64 / 500.0;
        (a.height_m(rho) - b.height_m(rho)).abs()
    };
    (0..=500).map(off).fold(0.0, f64::max)
}

/// Angle between the axes \[rad\], and distance of the pole from the true one, beside and along the axis \[m\].
fn pose_errors(found: &MeasuredPlate, truth: &Isometry3<f64>) -> [f64; 3] {
    let axis = |pose: &Isometry3<f64>| pose.rotation * Vector3::z();
    let beside = truth.inverse_transform_point(&Point3::from(found.pose.translation.vector));
    [
        axis(&found.pose).cross(&axis(truth)).norm(),
        beside.xy().coords.norm(),
        beside.z.abs(),
    ]
}

fn outside_m(found: &MeasuredPlate, point: &Point3<f64>) -> f64 {
    let local = found.pose.inverse_transform_point(point);
    let (rho, rim_m) = (local.xy().coords.norm(), found.surface.rim_m());
    let face = found.surface.height_m(rho.min(rim_m));
    let thickness_m = found.thickness_m.unwrap();
    let bottom = match found.foot {
        Some(foot) if rho <= foot.radius_m => (face - thickness_m).min(-thickness_m - foot.height_m),
        _ => face - thickness_m,
    };
    (local.z - found.surface.height_m(rho))
        .max(bottom - local.z)
        .max(rho - rim_m)
}

/// Limits of a fit: turn \[rad\], pole beside and along the axis, profile, rim \[m\].
fn check(found: &MeasuredPlate, truth: &Surface, by: &Isometry3<f64>, limits: [f64; 5]) {
    let [turn, beside, along] = pose_errors(found, by);
    let profile = apart_m(&found.surface, truth);
    let rim = (found.surface.rim_m() - truth.rim_m()).abs();
    let errors = [turn, beside, along, profile, rim];
    assert!(
        errors.iter().zip(limits).all(|(error, limit)| *error <= limit),
        "{errors:?} {limits:?}"
    );
}

/// Moved, turned, with noise, in millimetres: profile, pose, and a body that holds every vertex within the deviation.
#[test]
fn shipped_profiles_are_found_in_meshes() {
    for (k, name) in SHIPPED_PROFILES.into_iter().enumerate() {
        let truth = Surface::shipped(name).unwrap();
        for (count, limits) in [
            (1000, [1e-3, 2e-4, 2e-3, 2e-3, 2e-4]),
            (10_000, [2e-4, 1e-4, 2e-4, 1e-4, 2e-4]),
            (100_000, [1e-4, 5e-5, 5e-5, 5e-5, 2e-4]),
        ] {
            let mut rng = rng(17 * count as u64 + k as u64);
            let mesh = plate(&truth, count, 5e-5, &mut rng).0;
            let by = motion(&mut rng);
            let mesh = moved(&mesh, |p| Point3::from((by * p).coords * 1e3));
            let found = from_mesh(&mesh, None, None);
            // Coarse facets are far off the plate that they stand for, and some of them too far.
            if count == 1000 && matches!(found, Err(MeasuredError::Rough { .. })) {
                continue;
            }
            let found = found.unwrap();
            let mut limits = limits;
            // Facets of 20 mm tell neither the profile nor the axis well; the deviation says so.
            if found.deviation_m > 1.4e-3 {
                let share = found.deviation_m / truth.rim_m();
                limits = [
                    0.1 * share,
                    0.4 * found.deviation_m,
                    2e-3,
                    1.5 * found.deviation_m,
                    2e-4,
                ];
            }
            check(&found, &truth, &by, limits);
            assert_eq!((found.unit, found.unit_is_guessed), (Unit::Millimetre, true));
            let vertices = mesh.iter().flatten().map(|p| Point3::from(p.coords * 1e-3));
            let outside = vertices.map(|p| outside_m(&found, &p)).fold(0.0, f64::max);
            assert!(outside <= found.deviation_m + 1e-9, "{outside} {}", found.deviation_m);
            if count > 1000 {
                assert!((3.9e-3..4.7e-3).contains(&found.thickness_m.unwrap()));
                let foot = found.foot.unwrap();
                assert!((0.05..0.053).contains(&foot.radius_m) && (2.5e-3..3.3e-3).contains(&foot.height_m));
            }
        }
    }
}

/// A plate in its own frame.
fn sample(count: usize) -> (Surface, Vec<Triangle>) {
    let truth = Surface::shipped("coupe275").unwrap();
    let mesh = plate(&truth, count, 0.0, &mut rng(5)).0;
    (truth, mesh)
}

#[test]
fn deviation_bounds_every_point_of_the_facets() {
    let (_, mesh) = sample(6000);
    let found = from_mesh(&mesh, None, None).unwrap();
    let mut rng = rng(1);
    let mut worst: f64 = 0.0;
    for t in &mesh {
        for _ in 0..20 {
            let [u, v] = [0, 1].map(|_| rng.random_range(0.0..1.0_f64));
            let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            worst = worst.max(outside_m(&found, &(t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v)));
        }
    }
    assert!(worst <= found.deviation_m, "{worst} {}", found.deviation_m);
    assert!(worst > 0.9 * found.deviation_m, "{worst} {}", found.deviation_m);
}

#[test]
fn units_are_guessed_from_the_diameter_or_stated() {
    let (truth, mesh) = sample(10_000);
    for unit in Unit::ALL {
        let scaled = moved(&mesh, |p| Point3::from(p.coords / unit.length_m()));
        let found = from_mesh(&scaled, None, None).unwrap();
        assert_eq!((found.unit, found.unit_is_guessed), (unit, true));
        assert!(apart_m(&found.surface, &truth) < 1e-4);
        let stated = from_mesh(&scaled, Some(unit), None).unwrap();
        assert!(!stated.unit_is_guessed && stated.surface == found.surface);
        assert_eq!(Unit::named(unit.name()), Some(unit));
    }
    let small = moved(&mesh, |p| Point3::from(p.coords * 0.5));
    assert!(matches!(from_mesh(&small, None, None), Err(MeasuredError::Unit { .. })));
    assert!(apart_m(&from_mesh(&small, Some(Unit::Metre), None).unwrap().surface, &truth) > 1e-3);
    let why = from_mesh(&mesh, Some(Unit::Millimetre), None).unwrap_err();
    assert!(matches!(why, MeasuredError::Size { .. }), "{why}");
}

#[test]
fn mirrored_meshes_other_windings_and_other_orders_change_little() {
    let (truth, mut mesh) = sample(10_000);
    let plain = from_mesh(&mesh, None, None).unwrap();
    let mirrored = moved(&mesh, |p| Point3::new(-p.x, p.y, p.z));
    let found = from_mesh(&mirrored, None, None).unwrap();
    check(&found, &truth, &Isometry3::identity(), [1e-4, 1e-4, 2e-4, 1e-4, 1e-4]);
    assert!(found.thickness_m.is_some() && found.foot.is_some());
    let inside_out: Vec<_> = mesh.iter().map(|t| [t[0], t[2], t[1]]).collect();
    assert!((from_mesh(&inside_out, None, None).unwrap().deviation_m - plain.deviation_m).abs() < 1e-6);
    let mut rng = rng(2);
    for k in (1..mesh.len()).rev() {
        mesh.swap(k, rng.random_range(0..=k));
        let turn = rng.random_range(0..3);
        mesh[k].rotate_left(turn);
    }
    let found = from_mesh(&mesh, None, None).unwrap();
    assert!(apart_m(&found.surface, &plain.surface) < 1e-6);
    assert!((found.pose.translation.vector - plain.pose.translation.vector).norm() < 1e-6);
    assert!((found.deviation_m - plain.deviation_m).abs() < 1e-6);
    assert_eq!(found.relief, plain.relief);
}

#[test]
fn a_face_alone_is_a_plate_without_a_body() {
    for name in SHIPPED_PROFILES {
        let truth = Surface::shipped(name).unwrap();
        let mut rng = rng(3);
        let around = 120;
        let (outline, face) = outline(&truth, 2e-3);
        let mut mesh = revolved(&outline[..face], around, |_, k, [rho, z]| {
            let (s, c) = (TAU * k as f64 / around as f64).sin_cos();
            Point3::new(rho * c, rho * s, z) + noise(&mut rng, 2e-5)
        });
        let by = motion(&mut rng);
        mesh = moved(&mesh, |p| by * p);
        let found = from_mesh(&mesh, None, None).unwrap();
        check(&found, &truth, &by, [2e-4, 1e-4, 2e-4, 1e-4, 1e-4]);
        assert!(found.thickness_m.is_none() && found.foot.is_none() && found.relief.lower.is_empty());
        // The relief is that of the face.
        for (ring, radius_m) in found.relief.radii_m.iter().enumerate() {
            for height in &found.relief.upper[ring * found.relief.azimuths..][..found.relief.azimuths] {
                let off = f64::from(*height) * 1e-5 - found.surface.height_m(*radius_m);
                assert!(off.abs() <= found.deviation_m + 1e-5, "{off}");
            }
        }
        let text = serde_json::to_string(&found.relief).unwrap();
        assert_eq!(serde_json::from_str::<Relief>(&text).unwrap(), found.relief);
    }
}

#[test]
fn a_flat_disc_has_its_centre_by_its_rim() {
    let truth = Surface::Disc { radius_m: 0.13 };
    for sigma in [0.0, 5e-5] {
        let mut rng = rng(4);
        let mesh = plate(&truth, 20_000, sigma, &mut rng).0;
        let by = motion(&mut rng);
        // Level, it looks up; its foot is below.
        let upright = from_mesh(&mesh, None, None).unwrap();
        check(&upright, &truth, &Isometry3::identity(), [1e-4, 1e-4, 1e-4, 1e-5, 2e-4]);
        assert!(upright.surface.is_flat());
        assert!((3.9e-3..4.5e-3).contains(&upright.thickness_m.unwrap()), "{upright:?}");
        let found = from_mesh(&moved(&mesh, |p| by * p), None, None).unwrap();
        check(&found, &truth, &by, [1e-4, 1e-4, 1e-4, 1e-5, 2e-4]);
        // With the foot on top, the side must be stated.
        let turned = moved(&mesh, |p| Point3::new(p.x, -p.y, -p.z));
        let why = from_mesh(&turned, None, None).unwrap_err().to_string();
        assert!(
            why.contains("so that the first one has a foot or a dent") && why.contains("the one towards -z"),
            "{why}"
        );
        let turned = from_mesh(&turned, None, Some(FaceSide::MinusZ)).unwrap();
        assert!(turned.pose.rotation.transform_vector(&Vector3::z()).z < -0.99);
    }
}

/// Box with a raised edge.
fn tray() -> Vec<Triangle> {
    let outline = [
        [0.0, 0.0],
        [0.8, 0.0],
        [1.0, 0.02],
        [1.0, 0.015],
        [0.8, -0.005],
        [0.0, -0.005],
    ];
    revolved(&outline, 64, |_, k, [share, z]| {
        let (s, c) = (TAU * (k as f64 + 0.5) / 64.0).sin_cos();
        let reach = 0.12 / s.abs().max(c.abs());
        Point3::new(share * reach * c, share * reach * s, z)
    })
}

fn cup(radius_m: f64, high_m: f64, draft_m: f64) -> Vec<Triangle> {
    let r = radius_m;
    let outline = [
        [0.0, 0.005],
        [0.5 * r, 0.005],
        [r - draft_m, 0.005],
        [r - 0.5 * draft_m, 0.5 * high_m],
        [r, high_m],
        [r + 0.004, high_m],
        [r + 0.004 - draft_m, 0.0],
        [0.0, 0.0],
    ];
    let fine = |pair: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let [from, to] = [pair[0], pair[1]];
        (1..=10)
            .map(|k| [0, 1].map(|i| from[i] + (to[i] - from[i]) * f64::from(k) / 10.0))
            .collect()
    };
    let outline: Vec<_> = [outline[0]]
        .into_iter()
        .chain(outline.windows(2).flat_map(fine))
        .collect();
    revolved(&outline, 64, |_, k, [rho, z]| {
        let (s, c) = (TAU * k as f64 / 64.0).sin_cos();
        Point3::new(rho * c, rho * s, z)
    })
}

#[test]
fn what_is_no_round_plate_is_refused() {
    let why = from_mesh(&tray(), None, None).unwrap_err();
    assert!(matches!(why, MeasuredError::NotRound { .. }), "{why}");
    let mut rng = rng(6);
    for (radius_m, high_m, draft_m) in [
        (0.04, 0.09, 0.003),
        (0.04, 0.04, 0.0),
        (0.1, 0.08, 0.01),
        (0.035, 0.16, 0.002),
    ] {
        let by = motion(&mut rng);
        let why = from_mesh(
            &moved(&cup(radius_m, high_m, draft_m), |p| by * p),
            Some(Unit::Metre),
            None,
        )
        .unwrap_err();
        assert!(matches!(why, MeasuredError::Steep { .. }), "{why}");
    }
}

#[test]
fn holes_chips_and_dents_are_refused_with_their_place() {
    let (_, mesh) = sample(40_000);
    let middle = |t: &Triangle| (t[0].coords + t[1].coords + t[2].coords) / 3.0;
    // A hole in the face alone.
    let at = Vector3::new(0.06, 0.05, 0.0);
    let is_there = |t: &&Triangle| (middle(t).xy() - at.xy()).norm() < 0.006;
    let is_face = |t: &Triangle| (t[1] - t[0]).cross(&(t[2] - t[0])).z > 0.0;
    let faces_up = is_face(&mesh[0]);
    let holed: Vec<_> = mesh
        .iter()
        .filter(|t| !(is_there(t) && is_face(t) == faces_up))
        .copied()
        .collect();
    let why = from_mesh(&holed, None, None).unwrap_err();
    let MeasuredError::Missing { place, .. } = why else {
        panic!("{why}")
    };
    assert!((Vector3::from(place.in_file) - at).xy().norm() < 0.01, "{place}");
    // A bite out of the rim: what lies in a cylinder is pushed inwards to its surface.
    let at = Vector3::new(0.0, 0.14, 0.0);
    let bitten = moved(&mesh, |p| match (p.coords - at).xy() {
        off if off.norm() < 0.012 => {
            let reach = off * (0.012 / off.norm());
            let off = if reach.y > -0.006 {
                nalgebra::Vector2::new(off.x, -(0.012_f64.powi(2) - off.x * off.x).sqrt())
            } else {
                reach
            };
            Point3::new(at.x + off.x, at.y + off.y, p.z)
        }
        _ => *p,
    });
    let why = from_mesh(&bitten, None, None).unwrap_err();
    let (MeasuredError::Missing { place, .. } | MeasuredError::Rough { place, .. }) = why else {
        panic!("{why}")
    };
    assert!((Vector3::from(place.in_file) - at).xy().norm() < 0.02, "{place}");
    // Dents of 5 mm and of 1 mm.
    let at = Vector3::new(-0.05, 0.02, 0.0);
    let dented = |deep_m: f64| {
        let dent = move |p: &Point3<f64>| {
            let share = 1.0 - (p.coords - at).xy().norm() / 0.015;
            Point3::new(p.x, p.y, p.z - deep_m * share.max(0.0))
        };
        from_mesh(&moved(&mesh, dent), None, None)
    };
    let why = dented(5e-3).unwrap_err();
    let MeasuredError::Rough { place, deviation_m } = why else {
        panic!("{why}")
    };
    assert!(
        (Vector3::from(place.in_file) - at).xy().norm() < 0.01 && deviation_m > 2e-3,
        "{place}"
    );
    let found = dented(1e-3).unwrap();
    assert!((4e-4..8e-4).contains(&found.deviation_m), "{}", found.deviation_m);
    assert!(found.out_of_round_m > 7e-4);
    assert!(
        (Vector3::from(found.worst.in_file) - at).xy().norm() < 0.01,
        "{}",
        found.worst
    );
}

#[test]
fn meshes_without_numbers_or_areas_are_refused() {
    assert_eq!(from_mesh(&[], None, None).unwrap_err(), MeasuredError::Empty);
    let point = Point3::new(0.1, 0.0, 0.0);
    assert_eq!(
        from_mesh(&[[point; 3]; 9], None, None).unwrap_err(),
        MeasuredError::Empty
    );
    let line = [0.0, 0.1, 0.3].map(|x| Point3::new(x, 0.0, 0.0));
    assert_eq!(from_mesh(&[line; 3], None, None).unwrap_err(), MeasuredError::Empty);
    let (_, mut mesh) = sample(5000);
    mesh[7][1].y = f64::NAN;
    let why = from_mesh(&mesh, None, None).unwrap_err();
    assert!(matches!(why, MeasuredError::Coordinate { index: 7, .. }), "{why}");
}

#[test]
fn a_million_triangles_take_seconds() {
    let truth = Surface::shipped("coupe275").unwrap();
    let mut rng = rng(8);
    let mesh = plate(&truth, 1_000_000, 5e-5, &mut rng).0;
    let start = std::time::Instant::now();
    let found = from_mesh(&mesh, None, None).unwrap();
    println!("{} triangles: {:.2} s", mesh.len(), start.elapsed().as_secs_f64());
    check(&found, &truth, &Isometry3::identity(), [1e-4, 5e-5, 1e-4, 5e-5, 3e-4]);
}

/// Points as touched by hand: rings from the middle to the rim, each point near its place.
fn touched(truth: &Surface, rings: usize, sigma: f64, rng: &mut Pcg64) -> Vec<Point3<f64>> {
    let around = 10;
    let point = |k: usize| {
        let ring = k / around;
        let share = ((ring as f64 + 1.0) / rings as f64).powf(0.7);
        let rho = truth.rim_m()
            * if ring + 1 == rings {
                1.0
            } else {
                share + 0.02 * rng.random_range(-1.0..1.0)
            };
        // Along the rim the places are even.
        let aside = rng.random_range(-0.3..0.3) * if ring + 1 == rings { 0.5 } else { 1.0 };
        let phi = TAU * ((k % around) as f64 + aside + 0.5 * (ring % 2) as f64) / around as f64;
        truth.point(rho, phi) + noise(rng, sigma)
    };
    (0..around * rings).map(point).collect()
}

#[test]
fn shipped_profiles_are_found_by_probed_points() {
    for name in SHIPPED_PROFILES {
        let truth = Surface::shipped(name).unwrap();
        for rings in [6, 10] {
            for seed in 0..3 {
                let mut rng = rng(100 + seed);
                let by = motion(&mut rng);
                let points: Vec<_> = touched(&truth, rings, 2e-5, &mut rng).iter().map(|p| by * p).collect();
                let found = from_points(&points, Some(Unit::Metre), None).unwrap();
                check(&found, &truth, &by, [1e-3, 5e-4, 1e-3, 1e-3, 5e-4]);
                assert!(found.deviation_m < 5e-4 && found.thickness_m.is_none());
            }
        }
    }
    let mut rng = rng(9);
    let flat = touched(&Surface::Disc { radius_m: 0.13 }, 5, 2e-5, &mut rng);
    let found = from_points(&flat, None, None).unwrap();
    assert!(found.surface.is_flat());
    check(
        &found,
        &Surface::Disc { radius_m: 0.13 },
        &Isometry3::identity(),
        [1e-3, 5e-4, 1e-4, 1e-9, 5e-4],
    );
}

/// A ball of 5 mm touches with its centre 5 mm off the face, along the normal.
#[test]
fn profiles_are_found_by_the_centres_of_a_ball() {
    let radius_m = 5e-3;
    for name in SHIPPED_PROFILES {
        let truth = Surface::shipped(name).unwrap();
        let mut rng = rng(7);
        let by = motion(&mut rng);
        let centre = |p: &Point3<f64>| {
            let normal = truth.normal(p.coords.xy().norm(), p.y.atan2(p.x)).into_inner();
            Point3::from((by * (p + normal * radius_m)).coords * 1e3)
        };
        let centres: Vec<_> = touched(&truth, 10, 0.0, &mut rng).iter().map(centre).collect();
        let found = from_ball_centres(&centres, radius_m, None, None).unwrap();
        // The slope at the rim tells where the ball touched it.
        check(&found, &truth, &by, [1e-3, 5e-4, 1e-3, 1e-3, 1e-3]);
        assert_eq!((found.unit, found.unit_is_guessed), (Unit::Millimetre, true));
        let apart = from_points(&centres, None, None).unwrap();
        assert!((pose_errors(&apart, &by)[2] - radius_m).abs() < 1e-3);
    }
}

#[test]
fn points_that_fix_no_axis_are_refused() {
    let truth = Surface::shipped("coupe275").unwrap();
    let points = touched(&truth, 6, 2e-5, &mut rng(10));
    assert_eq!(
        from_points(&points[..11], None, None).unwrap_err(),
        MeasuredError::Few { found: 11, least: 12 }
    );
    let line: Vec<_> = (0..20).map(|k| Point3::new(0.01 * f64::from(k), 0.002, 0.0)).collect();
    let half: Vec<_> = points.iter().filter(|p| p.x > 0.0).copied().collect();
    let rim: Vec<_> = points.iter().filter(|p| p.coords.xy().norm() > 0.11).copied().collect();
    for few in [line, half, rim] {
        let why = from_points(&few, Some(Unit::Metre), None).unwrap_err();
        assert!(matches!(why, MeasuredError::NoAxis { .. }), "{why}");
    }
    let mut wrong = points.clone();
    wrong[3].z += 6e-3;
    let why = from_points(&wrong, None, None).unwrap_err();
    let MeasuredError::Rough { place, .. } = why else {
        panic!("{why}")
    };
    assert!((Point3::from(place.in_file) - wrong[3]).norm() < 1e-9);
    wrong[3].z = f64::INFINITY;
    assert!(matches!(
        from_points(&wrong, None, None),
        Err(MeasuredError::Coordinate { index: 3, .. })
    ));
}

#[test]
fn probed_points_come_as_text() {
    let read = |text: &str| probe_points(text).map_err(|e| e.to_string());
    let (points, unit) = read("# by hand\nname,z_mm,x_mm,y_mm\na,3,1,2\n\nb,6,4,5 # rim\n").unwrap();
    assert_eq!((points[1], unit), (Point3::new(4.0, 5.0, 6.0), Some(Unit::Millimetre)));
    assert_eq!(read("x,y,z\n1,2,3\n").unwrap().1, None);
    assert_eq!(read("x_m,y_m,z_m\n1,2,3\n").unwrap().1, Some(Unit::Metre));
    let refused = [
        ("x,y\n1,2\n", "column \"z\" is missing"),
        ("x_m,y_mm,z_m\n", "unknown"),
        ("x,y,z\n1,2,a\n", "found \"a\""),
        ("", "empty"),
    ];
    for (text, why) in refused {
        assert!(read(text).unwrap_err().contains(why), "{:?}", read(text));
    }
}

/// Plate of an outline, moved, in inches.
fn turned(outline: &[[f64; 2]], around: usize, seed: u64) -> (Vec<Triangle>, Isometry3<f64>) {
    let by = motion(&mut rng(seed));
    let mesh = revolved(outline, around, |_, k, [rho, z]| {
        let (s, c) = (TAU * k as f64 / around as f64).sin_cos();
        Point3::from((by * Point3::new(rho * c, rho * s, z)).coords / 0.0254)
    });
    (mesh, by)
}

/// Arc in an outline: about a centre, from one angle to another.
fn arc([rho, z]: [f64; 2], radius_m: f64, [from, to]: [f64; 2], parts: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..=parts).map(move |k| {
        let (s, c) = (from + (to - from) * k as f64 / parts as f64).sin_cos();
        [rho + radius_m * c, z + radius_m * s]
    })
}

/// Level over four fifths of its radius, then a rim that rises; all but a few vertices are those of the level part.
#[test]
fn a_small_rim_of_a_flat_plate_is_no_outlier() {
    let level = (0..60).map(|k| [0.11 * f64::from(k) / 60.0, 0.0]);
    let rim = (0..=12)
        .map(|k| f64::from(k) / 12.0)
        .map(|x| [0.11 + 0.02 * x, 0.006 * x * x]);
    let top: Vec<_> = level.chain(rim).collect();
    let below = top.iter().rev().map(|[rho, z]| [*rho, z - 0.004]);
    let outline: Vec<_> = top.iter().copied().chain(below).collect();
    let (mesh, by) = turned(&outline, 128, 20);
    let found = from_mesh(&mesh, None, Some(towards(&by))).unwrap();
    let [turn, beside, along] = pose_errors(&found, &by);
    assert!(turn < 1e-4 && beside < 1e-4 && along < 2e-4 && found.deviation_m < 3e-4);
    assert!((found.surface.height_m(0.13) - 6e-3).abs() < 2e-4);
    assert!(
        (3.8e-3..5e-3).contains(&found.thickness_m.unwrap()),
        "{:?}",
        found.thickness_m
    );
}

/// The face ends where the roll falls by 45°, and the body reaches at most 0.3 of the roll's radius beyond.
#[test]
fn a_rolled_lip_ends_the_face() {
    use std::f64::consts::FRAC_PI_2;
    for roll_m in [1e-3, 2e-3, 4e-3] {
        let height = |rho: f64| 0.2 * rho * rho / 0.13;
        let top = (0..80)
            .map(|k| 0.13 * f64::from(k) / 80.0)
            .map(|rho| [rho, height(rho)]);
        let lean = 0.4_f64.atan();
        let centre = [0.13 + roll_m * lean.sin(), height(0.13) - roll_m * lean.cos()];
        let roll = arc(centre, roll_m, [FRAC_PI_2 + lean, lean - FRAC_PI_2], 40);
        let below = (0..=80)
            .rev()
            .map(|k| 0.125 * f64::from(k) / 80.0)
            .map(|rho| [rho, height(rho) - 2.0 * roll_m]);
        let outline: Vec<_> = top.chain(roll).chain(below).collect();
        let (mesh, by) = turned(&outline, 256, 21);
        let found = from_mesh(&mesh, None, None).unwrap();
        let [turn, beside, along] = pose_errors(&found, &by);
        let rim_m = found.surface.rim_m();
        assert!(turn < 1e-4 && beside < 1e-4 && along < 2e-4);
        let end_m = centre[0] + roll_m * std::f64::consts::FRAC_1_SQRT_2;
        assert!((rim_m - end_m).abs() < 0.1 * roll_m, "{rim_m} {end_m}");
        assert!(found.deviation_m < 0.4 * roll_m + 1e-4, "{}", found.deviation_m);
    }
}

/// A part of a sphere has its axis by its rim alone.
#[test]
fn a_watch_glass_has_its_axis_by_its_rim() {
    let height = |rho: f64| 0.4 - (0.16 - rho * rho).sqrt();
    let top: Vec<_> = (0..=70)
        .map(|k| 0.12 * f64::from(k) / 70.0)
        .map(|rho| [rho, height(rho)])
        .collect();
    let below = top.iter().rev().map(|[rho, z]| [*rho, z - 0.003]);
    let outline: Vec<_> = top.iter().copied().chain(below).collect();
    let (mesh, by) = turned(&outline, 200, 22);
    let found = from_mesh(&mesh, None, None).unwrap();
    let [turn, beside, along] = pose_errors(&found, &by);
    assert!(turn < 5e-4 && beside < 2e-4 && along < 2e-4 && (found.surface.rim_m() - 0.12).abs() < 2e-4);
    // Points on it fix no axis.
    let points: Vec<_> = mesh
        .iter()
        .step_by(97)
        .map(|t| t[0])
        .filter(|p| by.inverse_transform_point(&Point3::from(p.coords * 0.0254)).z > 0.0)
        .collect();
    let why = from_points(&points, Some(Unit::Inch), None).unwrap_err();
    assert!(matches!(why, MeasuredError::NoAxis { .. }), "{why}");
}

/// A groove 8 mm wide and 1 mm deep all round is a part of the profile.
#[test]
fn a_groove_is_found() {
    let height = |rho: f64| {
        let x = (rho - 0.09) / 0.004;
        0.3 * rho * rho
            - if x.abs() < 1.0 {
                1e-3 * (1.0 - x * x).powi(2)
            } else {
                0.0
            }
    };
    let top: Vec<_> = (0..=260)
        .map(|k| 0.13 * f64::from(k) / 260.0)
        .map(|rho| [rho, height(rho)])
        .collect();
    let (mesh, _) = turned(&top, 200, 23);
    let found = from_mesh(&mesh, None, None).unwrap();
    assert!(found.deviation_m < 1.5e-4, "{}", found.deviation_m);
}

/// Vertices four times as dense on one side as on the other.
#[test]
fn uneven_vertices_do_not_move_the_axis() {
    let truth = Surface::shipped("rim270").unwrap();
    let outline = outline(&truth, 2e-3).0;
    let mut rng = rng(24);
    let by = motion(&mut rng);
    let mesh = revolved(&outline, 300, |_, k, [rho, z]| {
        let even = TAU * k as f64 / 300.0;
        let (s, c) = (even + 0.6 * even.sin()).sin_cos();
        by * (Point3::new(rho * c, rho * s, z) + noise(&mut rng, 5e-5))
    });
    let found = from_mesh(&mesh, None, None).unwrap();
    check(&found, &truth, &by, [1e-4, 5e-5, 1e-4, 5e-5, 2e-4]);
}

/// Distance of a point from the body of a plate, at most; 0 inside \[m\]. The body of a face alone is as thick as it must be.
fn distance_m(found: &MeasuredPlate, point: &Point3<f64>) -> f64 {
    let local = found.pose.inverse_transform_point(point);
    let (rho, rim_m) = (local.xy().coords.norm(), found.surface.rim_m());
    let face = found.surface.height_m(rho.min(rim_m));
    let thickness_m = found.thickness_m.unwrap_or(found.least_thickness_m);
    let bottom = match found.foot {
        Some(foot) if rho <= foot.radius_m => (face - thickness_m).min(-thickness_m - foot.height_m),
        _ => face - thickness_m,
    };
    let along = (local.z - face).max(bottom - local.z).max(0.0);
    along.hypot((rho - rim_m).max(0.0))
}

/// A box or a sheet with its corners at random, somewhere about a plate of that radius and height.
fn addition(rng: &mut Pcg64, rim_m: f64) -> (Vec<Triangle>, [f64; 3]) {
    let mut size = |least: f64, most: f64| 10.0_f64.powf(rng.random_range(least.log10()..most.log10()));
    // A wall, a pin, a bar, a crumb.
    let half = [size(5e-4, 0.5 * rim_m), size(5e-4, 0.02), size(5e-4, 0.1)];
    let turn = UnitQuaternion::from_euler_angles(0.0, rng.random_range(-0.3..0.3), rng.random_range(0.0..TAU));
    let (rho, phi) = (rim_m * rng.random_range(0.0..1.05), rng.random_range(0.0..TAU));
    let place = Vector3::new(rho * phi.cos(), rho * phi.sin(), rng.random_range(-0.06..0.06));
    let corner = |k: usize| {
        let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        Point3::from(place + turn * Vector3::new(sign(0) * half[0], sign(1) * half[1], sign(2) * half[2]))
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let count = if rng.random_bool(0.7) {
        6
    } else {
        rng.random_range(1..6)
    };
    let triangles = faces[..count]
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    (triangles.map(|t| t.map(corner)).collect(), half)
}

/// Whatever else a file of a plate holds is within the plan's body and the deviation, or the file is refused.
#[test]
fn every_triangle_is_in_the_body_or_the_mesh_is_refused() {
    let thorough = std::env::var_os("PLATEWASH_THOROUGH").is_some();
    let (mut taken, mut refused) = (0, 0);
    for seed in 0..if thorough { 2000 } else { 60 } {
        let mut rng = rng(7000 + seed);
        let name = SHIPPED_PROFILES[rng.random_range(0..SHIPPED_PROFILES.len())];
        let truth = if rng.random_bool(0.3) {
            Surface::Disc { radius_m: 0.12 }
        } else {
            Surface::shipped(name).unwrap()
        };
        let (outline, face) = outline(&truth, 3e-3);
        // A body, or its face alone.
        let shown = if rng.random_bool(0.5) {
            &outline[..]
        } else {
            &outline[..face]
        };
        let mut mesh = revolved(shown, 100, |_, k, [rho, z]| {
            let (s, c) = (TAU * k as f64 / 100.0).sin_cos();
            Point3::new(rho * c, rho * s, z)
        });
        let (more, half) = addition(&mut rng, truth.rim_m());
        mesh.extend(more);
        let by = motion(&mut rng);
        let mesh = moved(&mesh, |p| by * p);
        let Ok(found) = from_mesh(&mesh, Some(Unit::Metre), None) else {
            refused += 1;
            continue;
        };
        taken += 1;
        for [a, b, c] in &mesh {
            for k in 0..=8 {
                for j in 0..=8 - k {
                    let [u, v] = [f64::from(k), f64::from(j)].map(|share| share / 8.0);
                    let point = a + (b - a) * u + (c - a) * v;
                    let off_m = distance_m(&found, &point);
                    assert!(
                        off_m <= found.deviation_m + 2e-5,
                        "seed {seed} {half:?}: {off_m} {}",
                        found.deviation_m
                    );
                }
            }
        }
    }
    assert!(taken > 5 && refused > 20, "{taken} {refused}");
}

/// Points on a grid of a square, an oval, a star and a round plate with a stray point.
#[test]
fn a_rim_that_is_not_round_all_round_is_refused() {
    let of_rim = |rho: &dyn Fn(f64) -> f64, count: usize| -> Vec<Point3<f64>> {
        let point = |share: f64, k: usize| {
            let phi = TAU * k as f64 / count as f64;
            Point3::new(share * rho(phi) * phi.cos(), share * rho(phi) * phi.sin(), 0.0)
        };
        [0.2, 0.5, 0.8, 1.0]
            .iter()
            .flat_map(|share| (0..count).map(move |k| (share, k)))
            .map(|(share, k)| point(*share, k))
            .collect()
    };
    let square = |phi: f64| 0.1 / phi.cos().abs().max(phi.sin().abs());
    let oval = |phi: f64| 0.11 / (1.0 + 0.2 * phi.cos().powi(2)).sqrt();
    let round = |_: f64| 0.12;
    let hexagon = |phi: f64| 0.1 / (phi.rem_euclid(TAU / 6.0) - TAU / 12.0).cos();
    for (name, points) in [
        ("square", of_rim(&square, 16)),
        ("corners", of_rim(&square, 8)),
        ("oval", of_rim(&oval, 24)),
        ("few", of_rim(&round, 7)),
        ("hexagon", of_rim(&hexagon, 12)),
    ] {
        let why = from_points(&points, Some(Unit::Metre), None).unwrap_err();
        let is_told = matches!(
            why,
            MeasuredError::BeyondRim { .. } | MeasuredError::RimGap { .. } | MeasuredError::NoAxis { .. }
        );
        assert!(is_told, "{name}: {why}");
    }
    let mut points = of_rim(&round, 12);
    from_points(&points, Some(Unit::Metre), None).unwrap();
    let stray = Point3::new(0.05, -0.15, 0.0);
    points.push(stray);
    let why = from_points(&points, Some(Unit::Metre), None).unwrap_err();
    let MeasuredError::BeyondRim { place, .. } = why else {
        panic!("{why}")
    };
    assert!((Point3::from(place.in_file) - stray).norm() < 1e-9, "{place}");
}

/// A slab of a square, of an oval, and a round one with a corner.
#[test]
fn a_slab_that_is_not_round_is_told_so() {
    let slab = |rho: &dyn Fn(f64) -> f64| {
        let outline = [[0.0, 0.01], [1.0, 0.01], [1.0, 0.0], [0.0, 0.0]];
        revolved(&outline, 4, |_, k, [share, z]| {
            let phi = TAU * (k as f64 + 0.5) / 4.0;
            Point3::new(share * rho(phi) * phi.cos(), share * rho(phi) * phi.sin(), z)
        })
    };
    let why = from_mesh(&slab(&|_| 0.14), Some(Unit::Metre), None).unwrap_err();
    let MeasuredError::NotRound {
        rim_m: [least, most], ..
    } = why
    else {
        panic!("{why}")
    };
    assert!(least < 0.101 && most > 0.13, "{why}");
    let oval = |around: usize| {
        revolved(
            &[[0.0, 0.01], [1.0, 0.01], [1.0, 0.0], [0.0, 0.0]],
            around,
            |_, k, [share, z]| {
                let phi = TAU * k as f64 / around as f64;
                Point3::new(0.13 * share * phi.cos(), 0.12 * share * phi.sin(), z)
            },
        )
    };
    for around in [12, 48, 200] {
        let why = from_mesh(&oval(around), Some(Unit::Metre), None).unwrap_err();
        assert!(matches!(why, MeasuredError::NotRound { .. }), "{around}: {why}");
    }
}

/// Direction of the file in which the face of a plate looks that was moved.
fn towards(by: &Isometry3<f64>) -> FaceSide {
    let z = by.rotation * Vector3::z();
    let sides = [
        (FaceSide::PlusX, z.x),
        (FaceSide::MinusX, -z.x),
        (FaceSide::PlusY, z.y),
        (FaceSide::MinusY, -z.y),
        (FaceSide::PlusZ, z.z),
        (FaceSide::MinusZ, -z.z),
    ];
    sides.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0
}

/// A disc 20 mm thick, with a dent in its upper side or a ring near the rim of one of its sides.
#[test]
fn the_washed_side_is_stated_or_unmistakable() {
    let disc = |dent_m: f64, ring_m: f64| {
        let top = (0..=24).map(|k| [0.005 * f64::from(k), 0.0]);
        let below = [
            [0.12, -0.02],
            [0.115, -0.02],
            [0.115, -0.02 - ring_m],
            [0.109, -0.02 - ring_m],
            [0.109, -0.02],
            [0.05, -0.02],
            [0.0, -0.02],
        ];
        let outline: Vec<_> = top.chain(below).collect();
        revolved(&outline, 90, |ring, k, [rho, z]| {
            let phi = TAU * k as f64 / 90.0;
            let dent = if (8..12).contains(&ring) && k < 8 { dent_m } else { 0.0 };
            Point3::new(rho * phi.cos(), rho * phi.sin(), z - dent)
        })
    };
    let up = |found: &MeasuredPlate| found.pose.rotation.transform_vector(&Vector3::z()).z;
    let (metre, smooth) = (Some(Unit::Metre), disc(0.0, 0.0));
    assert!(up(&from_mesh(&smooth, metre, None).unwrap()) > 0.999);
    assert!(up(&from_mesh(&smooth, metre, Some(FaceSide::MinusZ)).unwrap()) < -0.999);
    // The other side of a dented one is not taken without a word.
    let dented = disc(6e-3, 0.0);
    let why = from_mesh(&dented, metre, None).unwrap_err();
    assert!(
        matches!(
            why,
            MeasuredError::OtherSide {
                tried: FaceSide::PlusZ,
                other: FaceSide::MinusZ,
                ..
            }
        ),
        "{why}"
    );
    assert!(up(&from_mesh(&dented, metre, Some(FaceSide::MinusZ)).unwrap()) < -0.999);
    // A ring that the plate stands on does not make the underside the face, however high it is, and is enclosed.
    for ring_m in [1e-3, 3e-3, 8e-3, 0.02] {
        let found = from_mesh(&disc(0.0, ring_m), metre, None).unwrap();
        assert!(up(&found) > 0.999, "{ring_m}");
        let low = found.foot.map_or(found.thickness_m.unwrap(), |foot| {
            found.thickness_m.unwrap() + foot.height_m
        });
        assert!(low >= 0.02 + ring_m - 1e-6, "{ring_m} {low}");
    }
    // Standing on its edge, a disc has no upper side, however little it leans.
    for lean in [0.0, 1e-12, -1e-12, 0.05] {
        let by = UnitQuaternion::from_euler_angles(0.5 * TAU / 2.0 + lean, 0.0, 0.0);
        let edge = moved(&smooth, |p| by * p);
        let why = from_mesh(&edge, metre, None).unwrap_err().to_string();
        assert!(why.contains("neither side looks along the file's z"), "{why}");
        let found = from_mesh(&edge, metre, Some(FaceSide::MinusY)).unwrap();
        assert!(found.pose.rotation.transform_vector(&Vector3::z()).y < -0.99);
        let why = from_mesh(&edge, metre, Some(FaceSide::PlusZ)).unwrap_err().to_string();
        assert!(why.contains("from the stated +z"), "{why}");
    }
    // Of touched points alike.
    let points = (0..60).map(|k| {
        let (rho, phi) = (0.12 * f64::from(1 + k / 12) / 5.0, TAU * f64::from(k % 12) / 12.0);
        Point3::new(rho * phi.cos(), 0.0, rho * phi.sin())
    });
    let points: Vec<_> = points.collect();
    let why = from_points(&points, metre, None).unwrap_err().to_string();
    assert!(why.contains("neither side looks along the file's z"), "{why}");
    let found = from_points(&points, metre, Some(FaceSide::PlusY)).unwrap();
    assert!(found.pose.rotation.transform_vector(&Vector3::z()).y > 0.999);
}
