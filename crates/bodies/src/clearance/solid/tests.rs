use crate::clearance::convex::{bits, guarded};
use crate::clearance::solid::*;
use nalgebra::{DMatrix, Rotation3, Vector3};
use platewash_fixtures::is_thorough;
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

/// Distance of a point from the nearest of some hulls.
fn outside(parts: &[Vec<Point3<f64>>], point: Point3<f64>) -> f64 {
    let from = |part: &Vec<Point3<f64>>| distance(part, point);
    parts.iter().map(from).fold(f64::INFINITY, f64::min)
}

/// Distance of a point from the nearest mixture of some corners that was found: weights, none below 0 and of sum 1, that give a point.
/// They are looked for as the corners lie, and once they are drawn out to be as high as wide, which finds them for thin hulls.
///
/// Independent of the product's hulls: a distance of 0 proves that the point is in the hull, whatever was done wrong here.
fn distance(corners: &[Point3<f64>], point: Point3<f64>) -> f64 {
    let ways: Vec<Vector3<f64>> = corners.iter().map(|corner| corner - point).collect();
    let middle = ways.iter().sum::<Vector3<f64>>() / ways.len() as f64;
    let spread = DMatrix::from_fn(3, ways.len().max(3), |row, column| {
        ways.get(column).map_or(0.0, |way| (way - middle)[row])
    })
    .svd(true, false);
    let (axes, lengths) = (spread.u.unwrap(), spread.singular_values);
    let drawn = |way: &Vector3<f64>| {
        Vector3::from_fn(|k, _| match (axes.column(k).dot(way), lengths[k]) {
            (along, length) if length > 0.0 => along / length,
            (along, _) => along,
        })
    };
    let drawn: Vec<_> = ways.iter().map(drawn).collect();
    let mixed = |weights: Vec<(usize, f64)>| weights.iter().map(|&(k, w)| ways[k] * w).sum::<Vector3<f64>>();
    [&ways, &drawn]
        .map(|ways| mixed(mixture(ways)).norm())
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// Weights of a mixture of corners near the origin. They are improved as long as a corner lies beyond it (Wolfe 1976).
fn mixture(ways: &[Vector3<f64>]) -> Vec<(usize, f64)> {
    let mixed = |weights: &[(usize, f64)]| weights.iter().map(|&(k, w)| ways[k] * w).sum::<Vector3<f64>>();
    let shortest = (0..ways.len()).min_by(|&a, &b| ways[a].norm().total_cmp(&ways[b].norm()));
    let mut weights = vec![(shortest.unwrap(), 1.0)];
    let mut best = (f64::INFINITY, weights.clone());
    for _ in 0..500 {
        let way = mixed(&weights);
        if way.norm() >= best.0 {
            break;
        }
        best = (way.norm(), weights.clone());
        let beyond = (0..ways.len()).min_by(|&a, &b| way.dot(&ways[a]).total_cmp(&way.dot(&ways[b])));
        let next = beyond.unwrap();
        if best.0 < 1e-15 || weights.iter().any(|&(k, _)| k == next) {
            break;
        }
        weights.push((next, 0.0));
        while let Some(wanted) = nearest_weights(&weights, ways) {
            // As far towards the wanted weights as none falls below 0.
            let share = |&((_, old), new): &((usize, f64), f64)| if new < 0.0 { old / (old - new) } else { 1.0 };
            let pairs = || weights.iter().copied().zip(wanted.iter().copied());
            let least = pairs().map(|pair| share(&pair)).fold(1.0, f64::min);
            let moved: Vec<_> = pairs()
                .map(|((k, old), new)| (k, (old + (new - old) * least).max(0.0)))
                .collect();
            let stay: Vec<_> = moved.iter().copied().filter(|&(_, w)| w > 1e-15).collect();
            let done = stay.len() == weights.len() || stay.is_empty();
            weights = if stay.is_empty() { moved } else { stay };
            let sum: f64 = weights.iter().map(|&(_, w)| w).sum();
            weights.iter_mut().for_each(|(_, w)| *w /= sum);
            if done || least == 1.0 {
                break;
            }
        }
    }
    best.1
}

/// Weights, of sum 1, of the point nearest to the origin in the plane of some corners.
fn nearest_weights(weights: &[(usize, f64)], ways: &[Vector3<f64>]) -> Option<Vec<f64>> {
    let first = ways[weights[0].0];
    if weights.len() == 1 {
        return Some(vec![1.0]);
    }
    let edges: Vec<_> = weights[1..].iter().map(|&(k, _)| ways[k] - first).collect();
    let matrix = DMatrix::from_fn(3, edges.len(), |row, column| edges[column][row]);
    let found = matrix.svd(true, true).solve(&-first, 1e-14).ok()?;
    let rest: Vec<f64> = found.iter().copied().collect();
    Some([vec![1.0 - rest.iter().sum::<f64>()], rest].concat())
}

#[test]
fn decomposition_keeps_a_trough_hollow() {
    let middle = Point3::new(0.25, 0.2, 0.12);
    let hull = solid_parts(&trough(), SolidParts::Hull).unwrap();
    assert_eq!((hull.len(), hull[0].len()), (1, 8));
    assert!(outside(&hull, middle) < 1e-12);
    let parts = solid_parts(&trough(), SolidParts::Decomposed).unwrap();
    assert!(outside(&parts, middle) > 0.05, "{} parts", parts.len());
    assert_eq!(parts, solid_parts(&trough(), SolidParts::Decomposed).unwrap());
}

/// The walls of a closed room touch along edges and corners; each is a body of its own, in a file's order or any other.
#[test]
fn walls_of_a_closed_room_are_its_parts() {
    let wall = |axis: usize, at: f64| {
        let (mut low, mut high) = ([-1.5; 3], [1.5; 3]);
        (low[axis], high[axis]) = (at - 0.05, at);
        cuboid(low, high)
    };
    let mut room: Mesh = (0..3)
        .flat_map(|axis| [wall(axis, -1.5), wall(axis, 1.55)].concat())
        .collect();
    for stride in [1, 5, 7] {
        room = (0..room.len()).map(|k| room[k * stride % room.len()]).collect();
        let parts = solid_parts(&room, SolidParts::Decomposed).unwrap();
        assert_eq!(parts.len(), 6);
        for (place, away_m) in [([0.0; 3], 1.5), ([1.4, -1.4, 1.4], 0.1)] {
            let found_m = outside(&parts, Point3::from(Vector3::from(place)));
            assert!((found_m - away_m).abs() < 1e-9, "{place:?}: {found_m}");
        }
    }
    // Boxes that touch along an edge or in a face, and one apart.
    let apart = [
        cuboid([0.0; 3], [1.0; 3]),
        cuboid([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]),
        cuboid([0.0, 0.0, 1.0], [1.0, 1.0, 2.0]),
        cuboid([4.0; 3], [5.0; 3]),
    ];
    let (bodies, rest) = separate::bodies(
        &apart
            .concat()
            .iter()
            .map(|t| t.map(|p| Vector::new(p.x, p.y, p.z)))
            .collect::<Vec<_>>(),
    );
    assert_eq!((bodies.len(), rest.len()), (4, 0));
}

/// Neither side of a hollow body is a body, nor is one that is inside out, open, or bent inwards.
#[test]
fn hollow_bodies_are_left_to_the_other_cuts() {
    let turned = |mesh: Mesh| -> Mesh { mesh.into_iter().map(|[a, b, c]| [a, c, b]).collect() };
    let (cube, far) = (cuboid([0.0; 3], [1.0; 3]), cuboid([4.0; 3], [5.0; 3]));
    let inner = turned(cuboid([0.1; 3], [0.9; 3]));
    let mut dented = cube.clone();
    dented
        .iter_mut()
        .flatten()
        .filter(|p| p.x + p.y + p.z == 3.0)
        .for_each(|p| *p = Point3::new(0.2, 0.2, 0.2));
    for (mesh, bodies) in [
        ([cube.clone(), inner].concat(), 0),
        ([turned(cube.clone()), far.clone()].concat(), 1),
        (turned(cube.clone()), 1),
        ([cube.clone(), cube.clone()].concat(), 1),
        ([cube[..11].to_vec(), far.clone()].concat(), 1),
        ([dented, far.clone()].concat(), 1),
        // Another body lies within the first one.
        ([cube.clone(), cuboid([0.4; 3], [0.6; 3])].concat(), 1),
        (cube, 1),
    ] {
        let triangles: Vec<_> = mesh.iter().map(|t| t.map(|p| Vector::new(p.x, p.y, p.z))).collect();
        let (found, rest) = separate::bodies(&triangles);
        assert_eq!(found.len(), bodies);
        let once: std::collections::BTreeSet<_> = triangles.iter().map(|t| t.map(bits)).collect();
        assert_eq!(found.iter().map(Vec::len).sum::<usize>() + rest.len(), once.len());
    }
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

/// Meshes that are hard to enclose: flat or nearly flat sheets, heaps of boxes, loose and thin triangles, all turned anyhow and rounded to
/// some decimals, as files are.
fn meshes() -> impl Strategy<Value = Mesh> {
    let sheet = (1..5usize, 1..5usize, -9.0..-3.0f64, any::<u64>())
        .prop_map(|(wide, long, warp, seed)| sheet(wide, long, warp, seed));
    let triangles = (
        prop::collection::vec(prop::array::uniform9(-0.3..0.3f64), 1..6),
        -7.0..0.0f64,
    )
        .prop_map(|(loose, thin)| {
            let squeezed =
                |c: [f64; 9]| [0, 3, 6].map(|k| Point3::new(c[k], c[k + 1], c[k + 2] * f64::powf(10.0, thin)));
            loose.into_iter().map(squeezed).collect::<Mesh>()
        });
    let size = prop_oneof![0.005..0.3f64, 1e-6..1e-3f64];
    let boxes = prop::collection::vec((prop::array::uniform3(-0.3..0.3f64), prop::array::uniform3(size)), 1..4);
    let boxes = boxes.prop_map(|boxes| {
        let mesh = |(low, size): ([f64; 3], [f64; 3])| cuboid(low, [0, 1, 2].map(|i| low[i] + size[i]));
        boxes.into_iter().flat_map(mesh).collect::<Mesh>()
    });
    let mesh = prop_oneof![
        4 => sheet.clone(),
        1 => triangles.clone(),
        1 => boxes.clone(),
        1 => (sheet, triangles, boxes).prop_map(|(a, b, c)| [a, b, c].concat()),
    ];
    (mesh, prop::array::uniform3(-3.2..3.2f64), 3..10i32).prop_map(|(mesh, [roll, pitch, yaw], decimals)| {
        let turn = Rotation3::from_euler_angles(roll, pitch, yaw);
        let unit = f64::powi(10.0, decimals);
        let rounded = |p: Point3<f64>| (turn * p).map(|c| (c * unit).round() / unit);
        mesh.into_iter().map(|triangle| triangle.map(rounded)).collect()
    })
}

/// A grid of squares, each of two triangles, with heights up to `10^warp` \[m\].
fn sheet(wide: usize, long: usize, warp: f64, seed: u64) -> Mesh {
    let height = |i: usize, j: usize| {
        let mixed = (seed ^ (31 * i + j + 1) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
        f64::powf(10.0, warp) * mixed as f64 / f64::powi(2.0, 24)
    };
    let corner = |i: usize, j: usize| Point3::new(0.2 * i as f64 - 0.3, 0.15 * j as f64 - 0.2, height(i, j));
    let squares = (0..wide).flat_map(|i| (0..long).map(move |j| (i, j)));
    let halves = |(i, j): (usize, usize)| {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    squares.flat_map(halves).collect()
}

/// Points of each triangle: its corners, its middle, and some between.
fn samples(mesh: &Mesh, shares: &[[f64; 2]]) -> Vec<Point3<f64>> {
    let of = |[a, b, c]: &[Point3<f64>; 3]| {
        let within = shares
            .iter()
            .map(|[s, t]| if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (*s, *t) });
        let point = |(s, t): (f64, f64)| a + (b - a) * s + (c - a) * t;
        within.map(point).chain([*a, *b, *c]).collect::<Vec<_>>()
    };
    mesh.iter().flat_map(of).collect()
}

fn vectors(points: &[Point3<f64>]) -> Vec<Vector> {
    points.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect()
}

/// Greatest distance of a point of the surface from the parts that counts as enclosed \[m\]: what [`distance`] misses in thin boxes, seen
/// up to 1.2e-9.
const ENCLOSED_M: f64 = 1e-8;

proptest! {
    #![proptest_config(ProptestConfig { cases: if is_thorough() { 5000 } else { 200 }, ..ProptestConfig::default() })]
    /// Every point of every triangle is in a part, for any cells in place of a decomposition, and in the hull.
    #[test]
    fn parts_enclose_the_surface_for_any_cells(
        mesh in meshes(),
        cells in prop::collection::vec(prop::collection::vec(prop::array::uniform3(-0.5..0.5f64), 4..9), 0..6),
        shares in prop::collection::vec(prop::array::uniform2(0.0..1.0f64), 4),
    ) {
        let triangles: Vec<[Vector; 3]> = mesh.iter().map(|t| t.map(|p| Vector::new(p.x, p.y, p.z))).collect();
        let cells: Vec<_> = cells
            .iter()
            .map(|cell| Part::around(cell.iter().map(|&[x, y, z]| Vector::new(x, y, z)).collect()))
            .collect();
        let points = |part: Vec<Vector>| part.into_iter().map(|v| Point3::new(v.x, v.y, v.z)).collect::<Vec<_>>();
        let parts: Vec<_> = enclosing(&triangles, &cells).into_iter().map(points).collect();
        let all: Vec<Point3<f64>> = mesh.iter().flatten().copied().collect();
        let hull = points(Part::around(distinct(vectors(&all).into_iter())).corners);
        for point in samples(&mesh, &shares) {
            let beyond = outside(&parts, point);
            prop_assert!(beyond <= ENCLOSED_M, "{beyond} {point}");
            let beyond = distance(&hull, point);
            prop_assert!(beyond <= ENCLOSED_M, "{beyond} {point} of the hull");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: if is_thorough() { 300 } else { 2 }, ..ProptestConfig::default() })]
    /// The same with the cells that the collision library proposes.
    #[test]
    fn every_point_of_the_surface_is_enclosed(
        mesh in meshes(),
        shares in prop::collection::vec(prop::array::uniform2(0.0..1.0f64), 4),
    ) {
        for wanted in [SolidParts::Hull, SolidParts::Decomposed, SolidParts::Few] {
            let parts = match solid_parts(&mesh, wanted) {
                Ok(parts) => parts,
                // Rounding may make it flat, and the library may fail.
                Err(SolidError::Flat | SolidError::NotDecomposed) => continue,
                Err(why) => return Err(TestCaseError::fail(why.to_string())),
            };
            for point in samples(&mesh, &shares) {
                let beyond = outside(&parts, point);
                prop_assert!(beyond <= ENCLOSED_M, "{beyond} {point} {wanted:?}");
            }
        }
    }
}

/// Neighbouring triangles of a rounded sheet have nearly the same normal. Faces that are merged by their normals miss corners of these
/// four by 2 to 5 µm, and surface between corners by more.
#[test]
fn a_rounded_sheet_is_enclosed() {
    for k in [87, 90, 155, 208] {
        let turn = Rotation3::from_euler_angles(0.0021 * f64::from(k), 0.7 + 0.0003 * f64::from(k), 1.1);
        let rounded = |p: Point3<f64>| (turn * p).map(|c| (c * 1e5).round() / 1e5);
        let mesh: Mesh = sheet(4, 4, -12.0, 1).into_iter().map(|t| t.map(rounded)).collect();
        let points = distinct(vectors(&mesh.iter().flatten().copied().collect::<Vec<_>>()).into_iter());
        let corners = Part::around(points).corners;
        let hull: Vec<_> = corners.iter().map(|v| Point3::new(v.x, v.y, v.z)).collect();
        for point in mesh.iter().flatten() {
            let beyond = distance(&hull, *point);
            assert!(beyond <= ENCLOSED_M, "{beyond} {point} {k}");
        }
    }
}

#[test]
fn a_panic_of_the_collision_library_is_no_panic_here() {
    assert_eq!(guarded(|| [1, 2].iter().position(|k| [0][*k] == 3)), None);
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
