//! Contact of a cell at one moment at least: a bound over a cell that is nowhere wholly in contact.

use crate::washing::face_shares::edges::Edges;
use crate::washing::face_shares::face_cell::{CellState, FaceCell};
use crate::washing::face_shares::lower::Lower;

/// State of a cell that is nowhere wholly in contact, at the moments that suit its contact best.
#[derive(Default)]
pub(crate) struct Touch {
    /// True if a part of the cell may be in contact at some moment.
    some: bool,
    /// Lower bound over the cell that is not below 0 where a place is in contact.
    bound: Lower,
    /// Distance from the middle of the cell at which that bound gets below 0 \[m\]; `None` before the first such moment.
    spare_m: Option<f64>,
    /// Greatest compression of the whole cell while it is within the sponge \[m\].
    pub compression_m: f64,
}

impl Touch {
    /// Returns a bound over the cell that is not below 0 where a place is in contact.
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

    /// Updates the state with a moment. The squared lengths of the vectors P (X + J δ + b ẑ + e ẑ − p) are at most those of P (X + J δ −
    /// p), ‖V‖² + 2 V·J δ + ‖J δ‖², with the remaining terms taken off the radius.
    pub fn see(&mut self, edges: &Edges<'_>, cell: &FaceCell, state: &CellState) {
        let (inside_m, pressed_m) = (state.inside_m, state.pressed_m);
        let look = edges.look(state.index);
        let shallower_m = look.shallower_m(state.sloping_m);
        if inside_m >= 0.0 {
            self.compression_m = self.compression_m.max(state.compression_m - shallower_m);
        }
        self.some |= inside_m >= -2.0 * cell.max_distance_m() && pressed_m >= -2.0 * state.sloping_m;
        let (tangent_m, axis) = (cell.tangent_m, &look.axis);
        let bound = if pressed_m >= 0.0 {
            let free_m = (edges.foundation.radius_m - (cell.farther_m(look) - tangent_m)).max(0.0);
            Lower {
                value: free_m * free_m - state.off_m * state.off_m - tangent_m * tangent_m,
                slope: cell.along(&state.way).map(|v| -2.0 * v),
                over_height: 0.0,
                slack: 2.0 * (tangent_m * tangent_m + 2.0 * edges.foundation.radius_m * cell.bend_m),
            }
        } else if inside_m >= 0.0 {
            let slope = cell.along(axis).map(|v| -v);
            let sloping_m = (slope[0] * slope[0] + slope[1] * slope[1]).sqrt() * cell.reach_m;
            let lost_m = shallower_m - sloping_m;
            Lower {
                value: state.compression_m - lost_m - edges.thresholds.compression_m,
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
