//! Closed convex bodies of which a mesh is made, such as the walls of a cell: each is a cell of its own, whose hull fills nothing.
//!
//! Triangles belong together where they share an edge and have the same wedge of material behind them. So boxes that touch along an edge, which
//! has four triangles then, stay apart. A body is taken where its triangles face outwards, all of its corners lie behind each of them, and
//! nothing else of the mesh lies within: the inner side of a hollow, and the outer side of one, are left to the other cuts.

use crate::clearance::convex::{bits, bounds};
use parry3d_f64::math::Vector;
use platewash_kinematics::trig::atan2;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::f64::consts::TAU;

/// Greatest number of bodies; a mesh of more is cut as a whole.
const MOST_BODIES: usize = 64;

/// Greatest number of pairs of a triangle and a corner of a body: a smooth body of more is left to the other cuts.
const MOST_PAIRS: usize = 100_000_000;

/// Distance in front of a triangle at which a corner counts as behind it, as a part of the mesh's size.
const ROUNDING: f64 = 1e-9;

/// Angle between two triangles at an edge that lie on each other \[rad\].
const SAME_ANGLE: f64 = 1e-9;

/// Returns the triangles of each closed convex body of a mesh, and the other triangles. Triangles that are there twice count once.
pub(super) fn bodies(triangles: &[[Vector; 3]]) -> (Vec<Vec<[Vector; 3]>>, Vec<[Vector; 3]>) {
    let mut seen = HashSet::new();
    let once = |corners: &[Vector; 3]| {
        let mut keys = corners.map(|corner| bits(corner + Vector::ZERO));
        let least = (0..3).min_by_key(|k| keys[*k]).unwrap_or(0);
        keys.rotate_left(least);
        seen.insert(keys)
    };
    let triangles: Vec<[Vector; 3]> = triangles.iter().copied().filter(once).collect();
    let groups = connected(&triangles);
    if groups.len() > MOST_BODIES {
        return (Vec::new(), triangles);
    }
    // A body alone may be inside out.
    if groups.len() == 1 && volume(&triangles) < 0.0 {
        let turned = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect::<Vec<_>>();
        return match is_convex(&turned, ROUNDING * size(&turned)) {
            true => (vec![turned], Vec::new()),
            false => (Vec::new(), triangles),
        };
    }
    let size = size(&triangles);
    let groups: Vec<Vec<[Vector; 3]>> = groups
        .into_iter()
        .map(|group| group.into_iter().map(|k| triangles[k]).collect())
        .collect();
    let is_body: Vec<bool> = (0..groups.len())
        .map(|k| {
            let others = groups.iter().enumerate().filter(|(other, _)| *other != k);
            let mut others = others.flat_map(|(_, group)| group.iter().flatten());
            is_convex(&groups[k], ROUNDING * size) && !others.any(|p| is_within(&groups[k], p, ROUNDING * size))
        })
        .collect();
    let (mut bodies, mut rest) = (Vec::new(), Vec::new());
    for (group, is_body) in groups.into_iter().zip(is_body) {
        match is_body {
            true => bodies.push(group),
            false => rest.extend(group),
        }
    }
    (bodies, rest)
}

/// A triangle at an edge.
#[derive(Debug, Clone, Copy)]
struct Side {
    triangle: usize,
    /// True where the triangle, seen from outside, runs along the edge from its lesser end to its greater one.
    is_along: bool,
    /// Ends of the edge, the lesser first.
    ends: [Vector; 2],
    /// Third corner of the triangle.
    third: Vector,
}

fn size(triangles: &[[Vector; 3]]) -> f64 {
    triangles.iter().flatten().map(|p| p.length()).fold(0.0, f64::max)
}

/// Six times the volume within closed triangles, below 0 where they face inwards.
fn volume(triangles: &[[Vector; 3]]) -> f64 {
    triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c))).sum()
}

/// Groups triangles that share an edge with the same material behind them.
fn connected(triangles: &[[Vector; 3]]) -> Vec<Vec<usize>> {
    let mut of_edge: BTreeMap<[[u64; 3]; 2], Vec<Side>> = BTreeMap::new();
    for (triangle, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            let [from, to, third] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| corners[k] + Vector::ZERO);
            let is_along = bits(from) < bits(to);
            let ends = if is_along { [from, to] } else { [to, from] };
            of_edge.entry(ends.map(bits)).or_default().push(Side {
                triangle,
                is_along,
                ends,
                third,
            });
        }
    }
    let mut leader: Vec<usize> = (0..triangles.len()).collect();
    for [a, b] in of_edge.values().flat_map(|sides| wedges(sides)) {
        let [a, b] = [a, b].map(|k| first(&mut leader, k));
        leader[a.max(b)] = a.min(b);
    }
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut number = HashMap::new();
    for k in 0..triangles.len() {
        let group = *number.entry(first(&mut leader, k)).or_insert_with(|| {
            groups.push(Vec::new());
            groups.len() - 1
        });
        groups[group].push(k);
    }
    groups
}

/// Pairs of triangles at an edge with the same wedge of material between them. About the edge, a triangle that runs along it has the material
/// before it; the other triangle of that wedge is the next one before it.
fn wedges(sides: &[Side]) -> Vec<[usize; 2]> {
    if let [a, b] = sides {
        return vec![[a.triangle, b.triangle]];
    }
    let Some(Side { ends: [from, to], .. }) = sides.first() else {
        return Vec::new();
    };
    let along = (*to - *from).normalize_or_zero();
    let across = along.any_orthonormal_vector();
    let up = along.cross(across);
    let angle = |side: &Side| {
        let way = side.third - *from;
        atan2(way.dot(up), way.dot(across))
    };
    let before = |side: &Side| {
        let turn = |other: &Side| (angle(side) - angle(other)).rem_euclid(TAU);
        let others = sides.iter().filter(|other| !other.is_along && turn(other) > SAME_ANGLE);
        others
            .min_by(|a, b| turn(a).total_cmp(&turn(b)))
            .map(|other| other.triangle)
    };
    let along = sides.iter().filter(|side| side.is_along);
    along.filter_map(|side| Some([side.triangle, before(side)?])).collect()
}

/// The least triangle of a group, to which all on the way are attached.
fn first(leader: &mut [usize], mut k: usize) -> usize {
    while leader[k] != k {
        leader[k] = leader[leader[k]];
        k = leader[k];
    }
    k
}

/// Twice the area of a triangle along its outward normal.
fn normal([a, b, c]: &[Vector; 3]) -> Vector {
    (*b - *a).cross(*c - *a)
}

/// Returns true for a body with a volume whose corners all lie behind each of its triangles, and whose edges each have one triangle on either
/// side.
fn is_convex(body: &[[Vector; 3]], rounding: f64) -> bool {
    if body.len() < 4 || 3 * body.len() * body.len() > MOST_PAIRS {
        return false;
    }
    let [least, most] = bounds(&body.iter().flatten().copied().collect::<Vec<_>>());
    let is_solid = volume(body) > rounding * (most - least).length_squared();
    is_solid && is_closed(body) && body.iter().flatten().all(|p| is_behind(body, p, rounding))
}

fn is_behind(body: &[[Vector; 3]], point: &Vector, rounding: f64) -> bool {
    body.iter().all(|triangle| {
        let normal = normal(triangle);
        normal.dot(*point - triangle[0]) <= rounding * normal.length()
    })
}

/// Returns true for a point behind each triangle of a convex body by more than rounding.
fn is_within(body: &[[Vector; 3]], point: &Vector, rounding: f64) -> bool {
    body.iter().all(|triangle| {
        let normal = normal(triangle);
        normal.length() == 0.0 || normal.dot(*point - triangle[0]) < -rounding * normal.length()
    })
}

/// Returns true if each edge has as many triangles on one side as on the other.
fn is_closed(body: &[[Vector; 3]]) -> bool {
    let mut sides: HashMap<[[u64; 3]; 2], i32> = HashMap::new();
    for corners in body {
        let keys = corners.map(|corner| bits(corner + Vector::ZERO));
        for side in 0..3 {
            let (from, to) = (keys[side], keys[(side + 1) % 3]);
            match from < to {
                true => *sides.entry([from, to]).or_default() += 1,
                false => *sides.entry([to, from]).or_default() -= 1,
            }
        }
    }
    sides.values().all(|sum| *sum == 0)
}
