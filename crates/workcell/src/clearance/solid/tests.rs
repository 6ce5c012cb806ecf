use crate::clearance::distance::bracketed;
use crate::clearance::solid::*;
use crate::clearance::{ITERATIVE_ERROR_M, part as convex};
use crate::fixtures::is_thorough;
use nalgebra::Vector3;
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{Frame, JointVector, Pose, RobotModel};
use proptest::prelude::*;

type Mesh = Vec<[Point3<f64>; 3]>;

/// The twelve triangles of a box between two corners.
fn cuboid(low: [f64; 3], high: [f64; 3]) -> Mesh {
    let corner = |k: usize| Point3::from(Vector3::from_fn(|i, _| if k >> i & 1 == 1 { high[i] } else { low[i] }));
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    faces.into_iter().flat_map(triangles).map(|t| t.map(corner)).collect()
}

/// A trough that is open above, as four boxes and a bottom.
fn trough() -> Mesh {
    [
        cuboid([0.0, 0.0, 0.0], [0.5, 0.4, 0.01]),
        cuboid([0.0, 0.0, 0.0], [0.01, 0.4, 0.2]),
        cuboid([0.49, 0.0, 0.0], [0.5, 0.4, 0.2]),
        cuboid([0.0, 0.0, 0.0], [0.5, 0.01, 0.2]),
        cuboid([0.0, 0.39, 0.0], [0.5, 0.4, 0.2]),
    ]
    .concat()
}

/// Distance of a point outside of the nearest of some hulls, by their planes, at most 0 within one. For unreliable hulls it is the distance
/// of the point to the hull of the corners, less its stated error.
fn outside(parts: &[Vec<Point3<f64>>], point: Point3<f64>) -> f64 {
    let p = Vector::new(point.x, point.y, point.z);
    let beyond = |part: &Vec<Point3<f64>>| {
        let points: Vec<_> = part.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
        let planes = Part::around(points).planes;
        if planes.is_empty() {
            return distance(part, point) - ITERATIVE_ERROR_M;
        }
        planes
            .iter()
            .map(|(n, at)| n.dot(p) - at)
            .fold(f64::NEG_INFINITY, f64::max)
    };
    parts.iter().map(beyond).fold(f64::INFINITY, f64::min)
}

/// Distance of a point from a hull.
fn distance(points: &[Point3<f64>], point: Point3<f64>) -> f64 {
    let points = points.to_vec();
    let hull = convex::Part::new(&Shape::Hull { points }, Frame::base()).unwrap();
    let at = Frame::base().offset(&RigidTransform::from(&Pose::translation(point.x, point.y, point.z)));
    let ball = convex::Part::ball(1e-12, at);
    let poses = RobotModel::irb120().unwrap().fk(&JointVector::zeros());
    bracketed(&hull.place(&poses), &ball.place(&poses)).0.distance
}

#[test]
fn decomposition_keeps_a_trough_hollow() {
    let middle = Point3::new(0.25, 0.2, 0.12);
    let hull = solid_parts(&trough(), SolidParts::Hull).unwrap();
    assert_eq!((hull.len(), hull[0].len()), (1, 8));
    assert!(outside(&hull, middle) < -0.05);
    let parts = solid_parts(&trough(), SolidParts::Decomposed).unwrap();
    assert!(outside(&parts, middle) > 0.05, "{} parts", parts.len());
    assert_eq!(parts, solid_parts(&trough(), SolidParts::Decomposed).unwrap());
}

/// Few parts are enough for a trough, which has five walls, and one for a box; a heap of boxes becomes no more than may be.
#[test]
fn few_parts_keep_a_trough_hollow() {
    let parts = solid_parts(&trough(), SolidParts::Few).unwrap();
    assert!((2..=few::MOST_PARTS).contains(&parts.len()), "{} parts", parts.len());
    assert!(outside(&parts, Point3::new(0.25, 0.2, 0.12)) > 0.05);
    let cube = cuboid([0.0; 3], [0.3, 0.2, 0.1]);
    let hull = |wanted| solid_parts(&cube, wanted).unwrap();
    assert_eq!(hull(SolidParts::Few), hull(SolidParts::Hull));
    let apart = |k: usize| {
        let low = [k % 3, k / 3 % 3, k / 9].map(|at| 0.1 * at as f64);
        cuboid(low, low.map(|at| at + 0.05))
    };
    let heap: Mesh = (0..27).flat_map(apart).collect();
    let parts = solid_parts(&heap, SolidParts::Few).unwrap();
    assert!((2..=few::MOST_PARTS).contains(&parts.len()), "{} parts", parts.len());
}

#[test]
fn a_box_lies_behind_its_six_faces() {
    let hull = Part::around(distinct(
        cuboid([0.0; 3], [1.0; 3])
            .iter()
            .flatten()
            .map(|p| Vector::new(p.x, p.y, p.z)),
    ));
    assert_eq!((hull.corners.len(), hull.planes.len()), (8, 6));
}

#[test]
fn thickens_sheets_and_rejects_flat_point_sets() {
    let sheet = |z: f64| [[0.0, 0.0], [0.3, 0.0], [0.0, 0.3]].map(|[x, y]| Point3::new(x, y, z));
    assert_eq!(solid_parts(&[sheet(0.1)], SolidParts::Hull), Err(SolidError::Flat));
    assert_eq!(solid_parts(&[], SolidParts::Hull), Err(SolidError::Empty));
    let mut broken = vec![sheet(0.0), sheet(0.1)];
    broken[1][2].y = f64::NAN;
    let not_finite = Err(SolidError::NotFinite { triangle: 1 });
    assert_eq!(solid_parts(&broken, SolidParts::Decomposed), not_finite);
    let many = vec![sheet(0.1); MOST_TRIANGLES + 1].into_iter().chain([sheet(0.2)]);
    let found = MOST_TRIANGLES + 2;
    let many: Vec<_> = many.collect();
    assert_eq!(
        solid_parts(&many, SolidParts::Decomposed),
        Err(SolidError::TooMany { found })
    );
    // Two sheets, 0.3 m apart.
    let parts = solid_parts(&[sheet(0.0), sheet(0.3)], SolidParts::Decomposed).unwrap();
    for z in [0.0, 0.3] {
        assert!(outside(&parts, Point3::new(0.1, 0.1, z)) <= 1e-9);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: if is_thorough() { 4 } else { 2 }, ..ProptestConfig::default() })]
    /// Every point of every triangle is in a part, for any proposal. The pieces are boxes in a heap, and loose triangles.
    #[test]
    fn every_point_of_the_surface_is_enclosed(
        boxes in prop::collection::vec((prop::array::uniform3(-0.3..0.3f64), prop::array::uniform3(0.005..0.3f64)), 1..4),
        loose in prop::collection::vec(prop::array::uniform9(-0.3..0.3f64), 0..6),
        shares in prop::collection::vec(prop::array::uniform2(0.0..1.0f64), 8),
    ) {
        let mut mesh: Mesh = Vec::new();
        for (low, size) in boxes {
            let high = [0, 1, 2].map(|i| low[i] + size[i]);
            mesh.extend(cuboid(low, high));
        }
        mesh.extend(loose.iter().map(|c| [0, 3, 6].map(|k| Point3::new(c[k], c[k + 1], c[k + 2]))));
        for wanted in [SolidParts::Hull, SolidParts::Decomposed, SolidParts::Few] {
            let parts = solid_parts(&mesh, wanted).unwrap();
            for [a, b, c] in &mesh {
                let within = shares.iter().map(|[s, t]| {
                    let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (*s, *t) };
                    a + (b - a) * s + (c - a) * t
                });
                for point in within.chain([*a, *b, *c]) {
                    let beyond = outside(&parts, point);
                    prop_assert!(beyond <= 1e-9, "{beyond} {point} {wanted:?}");
                }
            }
        }
    }
}

/// Too many corners are refused before a hull is computed, for every interpretation of the mesh; the greatest allowed number is not.
#[test]
fn more_corners_than_can_be_judged_are_refused() {
    let spread = |count: usize| -> Mesh {
        let corner = |k: usize| Point3::new((k % 40) as f64, (k / 40 % 40) as f64, (k / 1600) as f64) * 0.01;
        (0..count / 3).map(|t| [0, 1, 2].map(|i| corner(3 * t + i))).collect()
    };
    for parts in [SolidParts::Hull, SolidParts::Decomposed] {
        let refused = solid_parts(&spread(MOST_CORNERS + 2), parts).unwrap_err();
        let said = refused.to_string();
        assert!(
            said.contains("10002 distinct corners; at most 10000 can be judged: simplify the mesh"),
            "{said}"
        );
    }
    assert!(solid_parts(&spread(MOST_CORNERS - 1), SolidParts::Hull).is_ok());
}
