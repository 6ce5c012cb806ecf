use crate::parts::{Solid, height_over_face, rng};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::plate::PlateTerms;
use platewash_workcell::plate::*;
use platewash_workcell::surface::{Knot, MeridianError, SHIPPED_PROFILES, Surface};
use proptest::prelude::*;
use rand::RngExt;
use std::f64::consts::TAU;

/// What parts may hold above the face of the shipped profiles \[m\].
const SLACK_M: f64 = 5e-4;

fn plate(surface: Surface, thickness_m: f64, foot: Option<Foot>) -> Plate {
    Plate {
        surface,
        thickness_m,
        foot,
        pose: Pose::from_parts(
            nalgebra::Translation3::new(0.3, -0.2, 0.05),
            UnitQuaternion::from_euler_angles(0.0, 0.0, 0.7),
        ),
        terms: PlateTerms::default(),
    }
}

/// Points of the body: on the face, below it along the axis and along the normal, on the rim's edge, on the foot.
fn body_points(plate: &Plate, seed: u64, count: usize) -> Vec<Point3<f64>> {
    let (surface, rim_m, t) = (plate.surface, plate.rim_m(), plate.thickness_m);
    let mut rng = rng(seed);
    let mut points = Vec::new();
    for k in 0..count {
        let phi = rng.random_range(0.0..TAU);
        let rho = match k % 4 {
            0 => rim_m,
            // Knots are where pieces meet.
            1 => match surface {
                Surface::Profile(meridian) => meridian.knots()[k % meridian.knots().len()].radius_m,
                _ => 0.5 * rim_m,
            },
            _ => rim_m * rng.random_range(0.0..1.0_f64).sqrt(),
        };
        let depth = t * [0.0, 1.0, rng.random_range(0.0..1.0)][k % 3];
        let face = surface.point(rho, phi);
        points.push(face - Vector3::z() * depth);
        let along = face - surface.normal(rho, phi).into_inner() * depth;
        if along.xy().coords.norm() <= rim_m {
            points.push(along);
        }
        if let Some(foot) = plate.foot {
            let rho = foot.radius_m * if k % 2 == 0 { 1.0 } else { rng.random_range(0.0..1.0) };
            let bottom = -t - foot.height_m;
            let top = surface.height_m(rho) - t;
            // A face that falls below its foot has none there.
            if top > bottom {
                let z = bottom + (top - bottom) * rng.random_range(0.0..1.0);
                points.push(Point3::new(rho * phi.cos(), rho * phi.sin(), z));
            }
        }
    }
    points.iter().map(|point| plate.pose * point).collect()
}

/// Every point of the body lies within a part, and every part within the whole.
fn holds(plate: &Plate, seed: u64, count: usize) -> Result<(), TestCaseError> {
    let solids: Vec<_> = plate.bodies().iter().map(Solid::new).collect();
    let parts = PlateParts::new(plate);
    let whole = Solid::new(&(parts.whole.0, plate.pose * parts.whole.1));
    for point in body_points(plate, seed, count) {
        let out = solids
            .iter()
            .map(|solid| solid.outside(&point))
            .fold(f64::INFINITY, f64::min);
        prop_assert!(
            out <= 1e-9 * (1.0 + plate.rim_m()),
            "{out} m outside at {point} of {plate:?}"
        );
    }
    for corner in solids.iter().flat_map(Solid::corners) {
        prop_assert!(whole.outside(&corner) <= 1e-9, "{corner}");
    }
    Ok(())
}

#[test]
fn the_parts_of_the_shipped_profiles_hold_their_bodies_with_little_to_spare() {
    for (k, name) in SHIPPED_PROFILES.into_iter().enumerate() {
        let surface = Surface::shipped(name).unwrap();
        let foot = (k % 2 == 0).then_some(Foot {
            radius_m: 0.6 * surface.rim_m(),
            height_m: 0.006,
        });
        let plate = plate(surface, 0.0045, foot);
        holds(&plate, 3, 2000).unwrap();
        let bodies = plate.bodies();
        let mut most = 0.0_f64;
        let mut rng = rng(11);
        for (shape, pose) in &bodies {
            let solid = Solid::new(&(shape.clone(), *pose));
            for point in solid.samples(&mut rng, 60) {
                let local = plate.pose.inverse_transform_point(&point);
                if local.xy().coords.norm() <= surface.rim_m() {
                    most = most.max(height_over_face(&surface, &local));
                }
            }
        }
        assert!(
            (1e-5..SLACK_M).contains(&most),
            "{name}, {} parts: {most} m above the face",
            bodies.len()
        );
    }
}

#[test]
fn a_flat_disc_is_one_cylinder_to_the_bit() {
    let mut plate = Plate::level_disc([0.31, -0.17, 0.03], 0.145, 0.02);
    let [below, above] = plate.extent_m();
    let shape = Shape::Cylinder {
        radius_m: 0.145,
        half_length_m: (above - below) / 2.0,
    };
    let pose = plate.pose * Pose::translation(0.0, 0.0, (above + below) / 2.0);
    assert_eq!(plate.bodies(), [(shape, pose)]);
    assert_eq!(plate.bodies(), [plate.enclosure()]);
    plate.surface = Surface::profile(&[Knot {
        radius_m: 0.145,
        slope_rad: 0.0,
    }])
    .unwrap();
    assert_eq!(plate.bodies(), [plate.enclosure()]);
}

#[test]
fn a_foot_has_a_size_and_stands_within_the_rim() {
    let foot = |radius_m, height_m| {
        let foot = Some(Foot { radius_m, height_m });
        plate(Surface::shipped("coupe275").unwrap(), 0.004, foot).is_sound()
    };
    assert!(foot(0.087, 0.005) && foot(0.137, 0.005));
    for (radius_m, height_m) in [
        (0.138, 0.005),
        (0.0, 0.005),
        (0.08, 0.0),
        (-0.08, 0.005),
        (0.08, -0.005),
        (f64::NAN, 0.005),
        (0.08, f64::NAN),
        (0.08, f64::INFINITY),
        (0.08, 1e4),
    ] {
        assert!(!foot(radius_m, height_m), "{radius_m} {height_m}");
    }
}

/// Profiles of any shape and size, steep ones and domed ones among them.
fn profiles() -> impl Strategy<Value = Surface> {
    let knots = prop::collection::vec((0.05..1.0f64, -1.047..1.047f64), 1..8);
    (knots, -2.0..2.0f64).prop_filter_map("a bend that is too sharp", |(steps, size)| {
        let scale = 10.0_f64.powf(size) * 0.1;
        let mut radius_m = 0.0;
        let knots: Vec<_> = steps
            .into_iter()
            .map(|(step, slope_rad)| {
                radius_m += scale * step;
                Knot { radius_m, slope_rad }
            })
            .collect();
        match Surface::profile(&knots) {
            Err(MeridianError::Sharp { .. }) => None,
            profile => Some(profile.unwrap()),
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]
    #[test]
    fn parts_hold_the_body_of_any_profile(
        surface in profiles(), thick in 0.001..0.3f64, foot in prop::option::of((0.05..1.0f64, 0.01..0.2f64)), seed in 0..u64::MAX,
    ) {
        let rim_m = surface.rim_m();
        let foot = foot.map(|(radius, height)| Foot { radius_m: radius * rim_m, height_m: height * rim_m });
        holds(&plate(surface, thick * rim_m, foot), seed, 60)?;
    }
}
