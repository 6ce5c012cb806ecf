//! Which plates the sponge may touch while it works on one, and how far beyond that one's rim.
//!
//! The tip keeps within the stroke's radius R of the centre of its plate of radius r. At the height of the plate's face a sponge of radius
//! s, tilted by τ, reaches s / cos τ from the tip: upright it is its own radius, tilted its side wall lies as far out. (Below the face it
//! reaches less far; above it, where no plate of that height is, farther.) So it reaches at most R + s / cos τ − r beyond the rim. A
//! neighbour may be touched there and nowhere else; and by no more than its rim: not so far that the tip is over it, nor the sponge
//! over its centre.

use super::promise::Discrepancy;
use crate::plan::{LINE_TOLERANCE_M, Plan};
use platewash_workcell::layout::Plate;
use platewash_workcell::words::millimetres;
use serde::{Deserialize, Serialize};

/// Plates that overlap by less than this touch: the rounding of their places \[m\].
pub(super) const TOUCHING_M: f64 = 1e-9;

/// A neighbour that the sponge reaches while it works on another plate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Touched {
    /// Index of the plate that is reached.
    pub plate: usize,
    /// How far over its rim, at most \[m\].
    pub depth_m: f64,
}

/// How far beyond the rim of a plate the sponge reaches at the height of its face, at most, with the tip within `tip_m` of the plate's
/// centre and cos τ not below `cos_tilt` \[m\]; infinite without a bound of the tilt. A tip below the face by d has the side wall at the
/// face d tan τ farther out: other promises see to it that d is no more than the tolerance of the lines.
pub(super) fn beyond_rim_m(plan: &Plan, plate: &Plate, tip_m: f64, cos_tilt: f64) -> f64 {
    if cos_tilt > 0.0 {
        let sine = (1.0 - cos_tilt * cos_tilt).max(0.0).sqrt();
        tip_m + (plan.scenario.tool.sponge_radius_m + LINE_TOLERANCE_M * sine) / cos_tilt - plate.radius_m
    } else {
        f64::INFINITY
    }
}

/// The plates but one that a sponge reaches which gets `beyond_rim_m` beyond the rim of that one, in order.
pub(super) fn touched(plan: &Plan, plate: usize, beyond_rim_m: f64) -> Vec<Touched> {
    let Some(own) = plan.plates.get(plate) else {
        return Vec::new();
    };
    let others = plan.plates.iter().enumerate().filter(|(other, _)| *other != plate);
    let depths = others.map(|(plate, other)| Touched {
        plate,
        depth_m: beyond_rim_m - gap(own, other),
    });
    depths.filter(|touched| touched.depth_m > 0.0).collect()
}

/// Whether the sponge, tilted as it likes, may come nearer to one plate than the clearance while it works on another.
pub(super) fn is_within_reach(plan: &Plan, working_on: usize, plate: usize) -> bool {
    let (tool, wash) = (&plan.scenario.tool, &plan.scenario.wash);
    let (Some(own), Some(other)) = (plan.plates.get(working_on), plan.plates.get(plate)) else {
        return false;
    };
    // No point of the sponge is farther from the tip.
    let sponge_m = norm(tool.sponge_radius_m, tool.sponge_height_m);
    let reach_m = wash.path_radius_m + LINE_TOLERANCE_M + sponge_m + wash.clearance_m;
    distance(own, other) - other.radius_m <= reach_m
}

/// What is swept besides the plate that is washed.
#[derive(Debug, Default)]
pub(super) struct Swept {
    /// Plates that lie apart from the one that is washed.
    pub apart: Vec<Discrepancy>,
    /// Plates that overlap it.
    pub overlapping: Vec<Discrepancy>,
}

/// Plates of which more than the rim may be swept while another one is washed.
pub(super) fn swept(plan: &Plan) -> Swept {
    let sponge_m = plan.scenario.tool.sponge_radius_m / crate::trig::cos(plan.scenario.tilt_max_rad());
    let mut swept = Swept::default();
    for (i, own) in plan.plates.iter().enumerate() {
        let beyond_m = plan.scenario.wash.path_radius_m + sponge_m - own.radius_m;
        for (j, other) in plan.plates.iter().enumerate().filter(|(j, _)| *j != i) {
            let (gap_m, most_m) = (gap(own, other), sponge_m.min(other.radius_m));
            let depth_m = (beyond_m - gap_m).min(2.0 * other.radius_m);
            if depth_m <= most_m + TOUCHING_M {
                continue;
            }
            let list = if gap_m < -TOUCHING_M {
                &mut swept.overlapping
            } else {
                &mut swept.apart
            };
            list.push(Discrepancy::new(
                format!("plate {j} while plate {i} is washed"),
                format!("swept as far as {} over its rim", millimetres(depth_m)),
                format!("at most its rim, {}", millimetres(most_m)),
            ));
        }
    }
    swept
}

/// Distance between the rims of two plates, negative where they overlap \[m\].
pub(super) fn gap(a: &Plate, b: &Plate) -> f64 {
    distance(a, b) - a.radius_m - b.radius_m
}

fn distance(a: &Plate, b: &Plate) -> f64 {
    norm(a.x_m - b.x_m, a.y_m - b.y_m)
}

/// √(x² + y²), the same bits on every machine.
pub(super) fn norm(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}
