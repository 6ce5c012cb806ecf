//! Cells of a mesh, joined to a few. A distance of a body that moves costs as much as it has parts, and one part more is worth it only where
//! it leaves out much.
//!
//! The hull of two cells holds both. Two are joined where that adds the least volume. Volumes are those of the hulls of extreme points along
//! [`directions`], a little too small: they shape a proposal, and nothing else.

use crate::clearance::convex::ConvexHull;
use crate::clearance::solid::cells::{Cuts, Part, cells, distinct, enclosing};
use crate::clearance::solid::error::SolidError;
use parry3d_f64::math::Vector;

/// Cuts of a body that moves.
const CUTS: Cuts = Cuts {
    most_parts: 16,
    cells: 40,
    hollow: 0.003,
};

/// Greatest number of parts.
pub(super) const MOST_PARTS: usize = 12;

/// Volume that joining two cells adds up to which they are joined although there are not too many, as a share of the whole hull.
const ADDED: f64 = 0.003;

/// Least volume that cells or parts leave out of the whole hull, as a share of it; if they leave out less, the hull is better.
const LEFT_OUT: f64 = 0.04;

/// Returns the parts of a mesh with some points: a single one, the hull, for a mesh that is nearly convex.
///
/// # Errors
/// [`SolidError::NotDecomposed`].
pub(super) fn parts(triangles: &[[Vector; 3]], points: Vec<Vector>) -> Result<Vec<Vec<Vector>>, SolidError> {
    let cells = joined(cells(triangles, &CUTS)?);
    if cells.len() > 1 {
        let directions = directions();
        let volume = |points: &[Vector]| Outline::new(points, &directions).volume;
        let parts = enclosing(triangles, &cells);
        if parts.iter().map(|part| volume(part)).sum::<f64>() <= (1.0 - LEFT_OUT) * volume(&points) {
            return Ok(parts);
        }
    }
    Ok(vec![Part::around(points).corners])
}

/// Joins cells of a mesh.
fn joined(cells: Vec<Part>) -> Vec<Part> {
    let directions = directions();
    let all = distinct(cells.iter().flat_map(|cell| cell.corners.iter().copied()));
    let whole = Outline::new(&all, &directions);
    let mut groups: Vec<Group> = Vec::new();
    let mut pairs: Vec<Pair> = Vec::new();
    let mut waiting: Vec<Group> = cells
        .into_iter()
        .enumerate()
        .map(|(number, cell)| Group {
            number,
            outline: Outline::new(&cell.corners, &directions),
            corners: cell.corners,
        })
        .collect();
    let mut number = waiting.len();
    loop {
        for group in waiting.drain(..) {
            pairs.extend(groups.iter().map(|other| Pair::new(other, &group, &directions)));
            groups.push(group);
        }
        let best = (0..pairs.len()).min_by(|&a, &b| pairs[a].added.total_cmp(&pairs[b].added));
        let is_worth_it = |pair: &Pair| groups.len() > MOST_PARTS || pair.added <= ADDED * whole.volume;
        let Some(best) = best.filter(|&best| is_worth_it(&pairs[best])) else {
            break;
        };
        let Pair { of, outline, .. } = pairs.swap_remove(best);
        pairs.retain(|pair| !pair.of.iter().any(|number| of.contains(number)));
        let (both, others) = groups.into_iter().partition(|group| of.contains(&group.number));
        groups = others;
        let both: Vec<Group> = both;
        waiting.push(Group {
            number,
            outline,
            corners: both.into_iter().flat_map(|group| group.corners).collect(),
        });
        number += 1;
    }
    let volume: f64 = groups.iter().map(|group| group.outline.volume).sum();
    if volume > (1.0 - LEFT_OUT) * whole.volume {
        return vec![Part::around(all)];
    }
    let part = |group: Group| Part::around(distinct(group.corners.into_iter()));
    groups.into_iter().map(part).collect()
}

/// Cells that become one.
struct Group {
    number: usize,
    outline: Outline,
    corners: Vec<Vector>,
}

/// Two groups, by their numbers.
struct Pair {
    of: [usize; 2],
    /// Outline of both together.
    outline: Outline,
    /// Volume that joining them adds \[m³\]; below 0 where they overlap.
    added: f64,
}

impl Pair {
    fn new(a: &Group, b: &Group, directions: &[Vector]) -> Self {
        let both = [&a.outline.points[..], &b.outline.points].concat();
        let outline = Outline::new(&both, directions);
        Self {
            of: [a.number, b.number],
            added: outline.volume - a.outline.volume - b.outline.volume,
            outline,
        }
    }
}

/// Extreme points of a body.
struct Outline {
    points: Vec<Vector>,
    /// Volume of their hull \[m³\]; 0 if they have none.
    volume: f64,
}

impl Outline {
    fn new(points: &[Vector], directions: &[Vector]) -> Self {
        let farthest = |along: &Vector| {
            let points = points.iter().copied();
            points.max_by(|a, b| along.dot(*a).total_cmp(&along.dot(*b)))
        };
        let points = distinct(directions.iter().filter_map(farthest));
        let volume = ConvexHull::from_points(&points).map_or(0.0, |hull| {
            let corner = |k: u32| hull.corners[k as usize] - points[0];
            let sixfold = |face: &[u32; 3]| corner(face[0]).dot(corner(face[1]).cross(corner(face[2])));
            hull.triangles.iter().map(sixfold).sum::<f64>() / 6.0
        });
        Self { points, volume }
    }
}

/// The 98 directions to the points of a cubic grid within two steps, each once.
fn directions() -> Vec<Vector> {
    let steps = || -2..=2_i32;
    let all = steps().flat_map(|x| steps().flat_map(move |y| steps().map(move |z| [x, y, z])));
    let first = all.filter(|step| step.iter().any(|s| s % 2 != 0));
    first.map(|step| Vector::from(step.map(f64::from))).collect()
}
