//! Depth by which two convex parts overlap.
//!
//! Two convex parts overlap by no more than max n·a − min n·b along any direction n, from the first to the second. So parts are apart if
//! one of the directions tried shows it: those of their faces and axes, of their nearest points, and the one in which the collision library
//! would push them apart. The least value found is stated as the overlap. All else that the library says of two parts is no proof.

use crate::clearance::distance::bracketed;
use crate::clearance::part::{Core, Extent, PlacedPart};
use parry3d_f64::math::Vector;
use parry3d_f64::query;

/// Depth by which touching bodies may overlap by rounding \[m\].
pub(crate) const TOUCH_M: f64 = 1e-6;

/// Upper bound on the depth by which two parts overlap \[m\]; 0 or less if they do not.
pub(crate) fn depth(a: &PlacedPart<'_>, b: &PlacedPart<'_>) -> f64 {
    let (found, at_least) = bracketed(a, b);
    if a.outwards().is_some() || b.outwards().is_some() {
        return -found.distance;
    }
    if at_least > 0.0 {
        return -at_least;
    }
    let mut least = f64::INFINITY;
    let pushed = match (&a.core, &b.core) {
        (Core::Solid(p, _), Core::Solid(r, _)) => query::contact(&a.pose, &**p, &b.pose, &**r, 0.0).ok().flatten(),
        _ => None,
    };
    let pushed = pushed.map(|contact| contact.normal1);
    let directions = faces(a).chain(faces(b)).flat_map(|n| [n, -n]);
    let along = [pushed, Some(Vector::from_array(found.normal))].into_iter().flatten();
    let all = directions.chain(along).chain(between(a, b));
    // The library has faces without a normal. Along no direction every two parts are apart.
    for n in all.filter(|n| (n.length() - 1.0).abs() < 1e-6) {
        least = least.min(a.support(n) + b.support(-n));
    }
    least
}

/// Returns directions between the middles of two parts: directly, and across the axes of both, which separate round parts.
fn between(a: &PlacedPart<'_>, b: &PlacedPart<'_>) -> impl Iterator<Item = Vector> {
    let way = b.pose.translation - a.pose.translation;
    let across = [a, b].map(|part| {
        let axis = part.axis().unwrap_or(Vector::ZERO);
        way - axis * axis.dot(way)
    });
    let ways = [way, across[0], across[1]].into_iter();
    ways.map(|way| way.normalize_or_zero())
        .filter(|way| *way != Vector::ZERO)
}

/// Returns the directions of a part's faces, and of its axis if it has one; both ways.
fn faces(part: &PlacedPart<'_>) -> std::vec::IntoIter<Vector> {
    let own: Vec<Vector> = match part.core {
        Core::Solid(solid, Extent::Vertices(_)) => match solid.as_convex_polyhedron() {
            Some(hull) => hull.faces().iter().map(|face| face.normal).collect(),
            None => vec![Vector::X, Vector::Y, Vector::Z],
        },
        Core::Solid(_, Extent::Cylinder(..)) => vec![Vector::Y],
        Core::Segment(_) | Core::HalfSpace => Vec::new(),
    };
    let turned: Vec<_> = own.into_iter().map(|n| part.pose.rotation * n).collect();
    turned.into_iter()
}
