//! Where a cell is in contact at one moment at least.

use super::affine::Lower;
use super::cell::{Cell, Seen};
use super::edges::Edges;

/// How well a cell is in contact at the moment that suits it best.
#[derive(Default)]
pub(super) struct Touch {
    /// Whether all of it is.
    pub all: bool,
    /// Whether some of it may be.
    some: bool,
    /// Where it is: what is not below 0 there.
    bound: Lower,
    /// How far from its middle that gets below 0 \[m\]; `None` before there is such a moment.
    spare_m: Option<f64>,
    /// The greatest compression of all of it while it is within the sponge \[m\].
    pub compression_m: f64,
}

impl Touch {
    /// What is not below 0 where the cell is in contact.
    pub fn bound(&self, is_large: bool) -> Lower {
        let bound = match self.spare_m {
            Some(_) => self.bound,
            None => Lower::flat(-1.0, 0.0),
        };
        // Other moments may suit other places of it.
        let more = self.some && (is_large || self.spare_m.is_none());
        Lower {
            slack: if more { f64::INFINITY } else { bound.slack },
            ..bound
        }
    }

    /// Of the ways P (X + J δ + b ẑ + e ẑ − p) the squared lengths are at most those of P (X + J δ − p), ‖V‖² + 2 V·J δ + ‖J δ‖², with the
    /// others taken off the radius.
    pub fn see(&mut self, edges: &Edges<'_>, cell: &Cell, seen: &Seen) {
        let (inside_m, pressed_m) = (edges.inside_m(seen), edges.pressed_m(seen));
        if inside_m >= 0.0 {
            self.compression_m = self.compression_m.max(seen.compression_m - seen.shallower_m);
            self.all |= pressed_m >= 0.0;
        }
        self.some |= inside_m >= -2.0 * cell.away_m() && pressed_m >= -2.0 * seen.sloping_m;
        let (tangent_m, axis) = (cell.tangent_m, &edges.moment(seen.index).pose.axis);
        let bound = if pressed_m >= 0.0 {
            let free_m = (edges.foundation.radius_m - (seen.farther_m - tangent_m)).max(0.0);
            Lower {
                value: free_m * free_m - seen.off_m * seen.off_m - tangent_m * tangent_m,
                slope: cell.along(&seen.way).map(|v| -2.0 * v),
                over_height: 0.0,
                slack: 2.0 * (tangent_m * tangent_m + 2.0 * edges.foundation.radius_m * cell.bend_m),
            }
        } else if inside_m >= 0.0 {
            let slope = cell.along(axis).map(|v| -v);
            let sloping_m = (slope[0] * slope[0] + slope[1] * slope[1]).sqrt() * cell.reach_m;
            let lost_m = seen.shallower_m - sloping_m;
            Lower {
                value: seen.compression_m - lost_m - edges.wanted.compression_m,
                slope,
                over_height: 0.0,
                slack: 2.0 * axis.z.abs() * cell.bend_m,
            }
        } else {
            return;
        };
        let spare_m = bound.value / bound.steepness();
        if self.spare_m.is_none_or(|most| spare_m > most) {
            (self.bound, self.spare_m) = (bound, Some(spare_m));
        }
    }
}
