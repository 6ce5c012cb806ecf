//! Times at which the places of a cell leave the sponge, to the second order in the size of the cell.
//!
//! Near the moment t₀ at which the middle X of a cell leaves the sponge, let the way from the axis to a point of its patch be
//! V₀ + B (t − t₀) + J δ + j e (`cell.rs`; J and j across the axis, at one moment), but for ε at most: what the moments looked at are off
//! that line, what is lost between them, how the patch bends and twice what the axis turns times how far the patch reaches. A place that
//! leaves at t₀ + g·δ + g_e e − η is V₀ + M δ + m e − B η from the axis then; g = −Jᵀ V₀ / (B·V₀), and g_e alike, make M = J + B gᵀ and m
//! be across V₀. With μ no less than ‖M δ + m e‖ it is within the sponge, of radius s, as long as
//!
//! ‖V₀‖² + μ² − 2 η (B·V₀ − ‖B‖ μ) + η² ‖B‖² ≤ (s − ε)²,
//!
//! whose smallest root is taken for η. A line that ends within the sponge and begins there is within it in between.
//!
//! Where the foam is released rather than left, its compression w₀ + ẇ (t − t₀) + j·δ + j_e e is such a line itself, so that g = −j/ẇ and
//! η = ε/|ẇ|. What a cell enters it leaves in reversed time.

use crate::washing::face_shares::edges::{Edges, Gain, LeavingTimes, Window, length};
use crate::washing::face_shares::face_cell::{CellState, FaceCell};
use crate::washing::face_shares::lower::Lower;
use crate::washing::face_shares::sags::Sags;
use nalgebra::Vector3;

/// Error of the formulas above due to rounding \[m\].
const WAY_ROUNDING_M: f64 = 1e-12;

/// Line in time through the values at two moments.
struct Line<T> {
    at_s: f64,
    value: T,
    rate: T,
}

impl Edges<'_> {
    /// Returns lower bounds for every place of a cell through a window: one for leaving, if the cell is wholly in contact at the first two
    /// moments, and one for entering, if it is at the last two.
    pub fn gain(&self, cell: &FaceCell, state: &[CellState]) -> [Option<Gain>; 2] {
        let leaves = state.len() > 2 && state[1].full;
        let enters = state.len() > 2 && state[state.len() - 1].full;
        let one = |reversed| {
            let first = if reversed { state.last() } else { state.first() };
            let window = Window {
                state,
                reversed,
                start_s: self.look(first?.index).t_s,
            };
            self.one_way(cell, window)
        };
        let (left, entered) = (
            leaves.then(|| one(false)).flatten(),
            enters.then(|| one(true)).flatten(),
        );
        match (left, entered) {
            // A place that leaves and comes back counts once if both parts have some time in common.
            (Some(a), Some(b)) if a.until_s > b.until_s => {
                if a.time.value > b.time.value {
                    [left, None]
                } else {
                    [None, entered]
                }
            }
            both => [both.0, both.1],
        }
    }

    fn one_way(&self, cell: &FaceCell, window: Window<'_>) -> Option<Gain> {
        let leaving = self.leaving(cell, window)?;
        let start_s = window.start_s;
        let farthest_s = leaving.at_s - leaving.sooner_s + leaving.spread_s;
        Some(Gain {
            time: Lower {
                value: leaving.at_s - leaving.sooner_s,
                slope: leaving.slope,
                over_height: leaving.over_height,
                slack: leaving.sooner_s,
            },
            dose: self.dose(cell, window, &leaving),
            until_s: if window.reversed {
                start_s - farthest_s
            } else {
                start_s + farthest_s
            },
        })
    }

    fn leaving(&self, cell: &FaceCell, window: Window<'_>) -> Option<LeavingTimes> {
        let radius_m = self.foundation.radius_m;
        for k in 1.. {
            let (before, after) = (window.at(k - 1)?, window.at(k)?);
            let aside = after.off_m > radius_m;
            let released = after.compression_m < self.thresholds.compression_m;
            if !aside && !released {
                continue;
            }
            let times = [before, after].map(|seen| self.elapsed_s(window, seen));
            let span_s = times[1] - times[0];
            let axis = self.look(after.index).axis;
            let share = if aside {
                crossing(&before.way, &after.way, radius_m)
            } else {
                let [from, to] = [before, after].map(|seen| seen.compression_m - self.thresholds.compression_m);
                from / (from - to)
            };
            let at_s = times[0] + share * span_s;
            return if aside {
                let line = Line {
                    at_s,
                    value: before.way + (after.way - before.way) * share,
                    rate: (after.way - before.way) / span_s,
                };
                self.left_aside(cell, window, &line, &axis)
            } else {
                let line = Line {
                    at_s,
                    value: self.thresholds.compression_m,
                    rate: (after.compression_m - before.compression_m) / span_s,
                };
                self.release_times(cell, window, &line, &axis)
            };
        }
        None
    }

    /// Returns the times at which a cell gets beyond the sponge's rim while all of it is pressed: t₀, η, g and g_e of the head of this
    /// file. `line` is V₀ + B (t − t₀): its value is V₀, its rate is B. In the code, `columns` is J and j, `rates` is g and g_e, `moved` is
    /// M and m, `lost_m` is ε.
    fn left_aside(
        &self,
        cell: &FaceCell,
        window: Window<'_>,
        line: &Line<Vector3<f64>>,
        axis: &Vector3<f64>,
    ) -> Option<LeavingTimes> {
        let across = |v: Vector3<f64>| v - axis * v.dot(axis);
        let error_m = self.thresholds.height_error_m;
        let (v0, b) = (&line.value, &line.rate);
        let outwards = v0.dot(b);
        let columns = [cell.tangents()[0], cell.tangents()[1], Vector3::z()].map(across);
        let rates = columns.map(|column| -column.dot(v0) / outwards);
        let moved = [0, 1, 2].map(|i| columns[i] + b * rates[i]);
        let mu = cell.reach_m * (moved[0].norm_squared() + moved[1].norm_squared()).sqrt() + error_m * moved[2].norm();
        let spread_s = cell.reach_m * length(rates[0], rates[1]) + error_m * rates[2].abs();
        let last = self.all_left(window, line.at_s + spread_s)?;
        let off = |state: &CellState| (state.way - v0 - b * (self.elapsed_s(window, state) - line.at_s)).norm();
        let (off_m, turned, sags) = self.deviation_from_line(window, last, axis, off);
        let reach_m = cell.max_distance_m() + error_m;
        let lost_m = WAY_ROUNDING_M + off_m + sags.aside_m + cell.bend_m + 2.0 * turned * reach_m;
        let free_m = self.foundation.radius_m - lost_m;
        let (speed, slow) = (b.norm_squared(), outwards - b.norm() * mu);
        let beyond = v0.norm_squared() + mu * mu - free_m * free_m;
        let root = slow * slow - speed * beyond;
        if !(free_m > 0.0 && slow > 0.0 && root >= 0.0) {
            return None;
        }
        let sooner_s = ((slow - root.sqrt()) / speed).max(0.0) * (1.0 + 1e-12);
        let begins_m = (v0 - b * line.at_s).norm() + cell.tangent_m + error_m * columns[2].norm();
        let pressed = window
            .states_until(last)
            .all(|seen| seen.pressed_m >= sags.compression_m);
        (pressed && begins_m <= free_m && line.at_s - spread_s - sooner_s >= 0.0).then_some(LeavingTimes {
            at_s: line.at_s,
            sooner_s,
            slope: [rates[0], rates[1]],
            over_height: rates[2],
            spread_s,
            last,
        })
    }

    /// Returns the times at which the foam on a cell is released while all of it is within the sponge: t₀, η, g and g_e of the head of this file.
    /// `line` is w₀ + ẇ (t − t₀): its value is w₀, its rate is ẇ. In the code, `lost_m` is ε.
    fn release_times(
        &self,
        cell: &FaceCell,
        window: Window<'_>,
        line: &Line<f64>,
        axis: &Vector3<f64>,
    ) -> Option<LeavingTimes> {
        let error_m = self.thresholds.height_error_m;
        let falls = -line.rate;
        if falls.is_nan() || falls <= 0.0 {
            return None;
        }
        // The compression falls by a·x.
        let [gx, gy] = cell.along(axis).map(|v| -v / falls);
        let ge = -axis.z / falls;
        let spread_s = cell.reach_m * length(gx, gy) + error_m * ge.abs();
        let last = self.all_left(window, line.at_s + spread_s)?;
        let off = |state: &CellState| {
            (state.compression_m - line.value - line.rate * (self.elapsed_s(window, state) - line.at_s)).abs()
        };
        let (off_m, turned, sags) = self.deviation_from_line(window, last, axis, off);
        let lost_m =
            WAY_ROUNDING_M + off_m + sags.compression_m + cell.bend_m + turned * (cell.max_distance_m() + error_m);
        let sooner_s = lost_m / falls * (1.0 + 1e-12);
        let within = window.states_until(last).all(|seen| seen.inside_m >= sags.aside_m);
        // The foam must be pressed at the first moment, by more than the losses and the time by which a place leaves sooner.
        (within && line.at_s - spread_s - sooner_s >= 0.0).then_some(LeavingTimes {
            at_s: line.at_s,
            sooner_s,
            slope: [gx, gy],
            over_height: ge,
            spread_s,
            last,
        })
    }

    /// Returns the first moment of a window later than a given time; `None` if there is none.
    fn all_left(&self, window: Window<'_>, after_s: f64) -> Option<usize> {
        for k in 1.. {
            let seen = window.at(k)?;
            if self.elapsed_s(window, seen) >= after_s {
                return Some(k);
            }
        }
        None
    }

    /// Returns the greatest distance of the states up to a moment from a line, the greatest difference from `axis`, and the greatest sags.
    fn deviation_from_line(
        &self,
        window: Window<'_>,
        last: usize,
        axis: &Vector3<f64>,
        off: impl Fn(&CellState) -> f64,
    ) -> (f64, f64, Sags) {
        let greater = |most: f64, found: f64| if found > most { found } else { most };
        let (mut off_m, mut turned_squared, mut most) = (0.0, 0.0, Sags::default());
        let mut before: Option<&CellState> = None;
        for seen in window.states_until(last) {
            off_m = greater(off_m, off(seen));
            turned_squared = greater(turned_squared, (self.look(seen.index).axis - axis).norm_squared());
            if let Some(before) = before {
                let sags = self.sags(before, seen);
                most.compression_m = greater(most.compression_m, sags.compression_m);
                most.aside_m = greater(most.aside_m, sags.aside_m);
            }
            before = Some(seen);
        }
        (off_m, turned_squared.sqrt(), most)
    }
}

/// Parameter, 0 to 1, at which the line between two vectors gets longer than a radius.
fn crossing(from: &Vector3<f64>, to: &Vector3<f64>, radius_m: f64) -> f64 {
    let step = to - from;
    let (a, b, c) = (
        step.norm_squared(),
        from.dot(&step),
        from.norm_squared() - radius_m * radius_m,
    );
    let root = (b * b - a * c).max(0.0).sqrt();
    // The greater root, without cancelling.
    let share = if b > 0.0 { -c / (b + root) } else { (root - b) / a };
    share.clamp(0.0, 1.0)
}
