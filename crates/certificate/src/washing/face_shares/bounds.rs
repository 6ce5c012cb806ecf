//! Bounds over a cell: lower bounds of compression, contact time and dose.
//!
//! Requirements 27 to 29 in `docs/contact.md`.

use crate::washing::face_shares::doses::{Polynomial, Sums};
use crate::washing::face_shares::edges::{Edges, Gain};
use crate::washing::face_shares::face_cell::{CellState, FaceCell};
use crate::washing::face_shares::lower::Lower;
use crate::washing::face_shares::sags::Sags;
use crate::washing::face_shares::touch::Touch;
use platewash_bodies::contact::{Bundles, Foundation, Moment};
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::surface::Surface;
use std::ops::Range;

/// Half of the edge of a large cell, as a part of the sponge's radius.
const LARGE: f64 = 0.1;

/// Half of the edge of a small cell, as a part of the sponge's radius. The sponge's rim hardly differs from a line over such a cell.
const SMALL: f64 = 0.025;

/// Amounts that every place of a cell gets.
#[derive(Clone, Copy, Default)]
pub(crate) struct CellAmounts {
    /// True if there is a moment at which all of the cell is in contact.
    pub contact: bool,
    pub time_s: f64,
    pub dose: Polynomial,
}

/// Reused buffers: the state of a cell at the moments, and the windows of those moments.
#[derive(Default)]
pub(crate) struct Scratch {
    /// The states come first; what is behind them is left over from other cells.
    all: Vec<CellState>,
    spans: Vec<Range<usize>>,
}

impl Scratch {
    /// The first and the last moment of each window.
    pub fn windows(&self) -> impl Iterator<Item = [u32; 2]> {
        let seen = |span: &Range<usize>| self.all.get(span.clone());
        let spans = self.spans.iter().filter_map(seen);
        spans.filter_map(|seen| Some([seen.first()?.index, seen.last()?.index]))
    }
}

/// Bounds found for a cell.
pub(crate) struct CellBounds {
    /// Amounts that every place of the cell gets.
    pub amounts: CellAmounts,
    /// Lower bounds that hold for every height of the plate within its error: contact (above 0 where in contact), time \[s\], dose
    /// \[Pa·m\].
    pub bounds: [Lower; 3],
    /// Upper bounds on the shares of the cell that do not get the wanted contact, time and dose.
    pub below: [f64; 3],
    /// Greatest compression of the whole cell \[m\].
    pub compression_m: f64,
}

/// The passes of a sponge over a face.
pub(crate) struct Passes<'a> {
    pub surface: &'a Surface,
    pub edges: Edges<'a>,
    pub sums: Sums,
    /// Distance beyond the sponge at which a moment still counts as near a cell \[m\]: the longest step between two moments.
    pub step_m: f64,
    bundles: Bundles,
}

impl<'a> Passes<'a> {
    pub fn new(
        surface: &'a Surface,
        foundation: &'a Foundation,
        (moments, sags): (&'a [Moment], &'a [Sags]),
        thresholds: &'a ContactThresholds,
    ) -> Self {
        let [low_m, high_m] = surface.height_bounds_m();
        let far_m = surface.rim_m() + low_m.abs().max(high_m.abs());
        Self {
            surface,
            edges: Edges::new(foundation, (moments, sags), thresholds),
            sums: Sums::new(foundation, (moments, sags), far_m),
            step_m: longest_step(moments, foundation.radius_m),
            bundles: Bundles::new(moments),
        }
    }

    /// Fills `windows` with ranges of moments that hold all moments near a cell.
    pub fn windows_near(&self, cell: &FaceCell, windows: &mut Vec<[u32; 2]>) {
        for near in self.bundles.near(self.reach_m(cell), &cell.point) {
            let [first, end] = [near.start, near.end].map(|index| index as u32);
            match windows.last_mut() {
                Some([_, last]) if *last + 1 == first => *last = end - 1,
                _ => windows.push([first, end - 1]),
            }
        }
    }

    /// Upper bound on the distance of the sponge's axis from the middle of a cell, across the axis, at which a point of the cell may be
    /// within the sponge at that moment or the neighbouring ones \[m\].
    pub fn reach_m(&self, cell: &FaceCell) -> f64 {
        self.edges.foundation.radius_m + cell.max_distance_m() + self.step_m
    }
}

impl Passes<'_> {
    /// Bounds compression, time and dose of a cell (27 to 29) through some windows of moments, on top of the amounts `kept` that are known
    /// already. Returns `None` where those bounds are enough: where `shares_below`, the shares of the cell that they leave without the
    /// wanted amounts, are 0.
    pub(crate) fn bounds(
        &self,
        cell: &FaceCell,
        (mut kept, within): (CellAmounts, &[[u32; 2]]),
        scratch: &mut Scratch,
        shares_below: impl Fn(&[Lower; 3]) -> [f64; 3],
    ) -> Option<CellBounds> {
        let edges = &self.edges;
        let error_m = edges.thresholds.height_error_m;
        let Scratch { all: states, spans } = scratch;
        spans.clear();
        let mut count = 0;
        for &window in within {
            count = self.runs(cell, window, (states, count), &mut kept, spans);
        }
        let mut touch = Touch::default();
        if !kept.contact {
            states[..count].iter().for_each(|seen| touch.see(edges, cell, seen));
        }
        let bounds = |[mut time, mut dose]: [Lower; 2]| {
            time.add(&Lower::flat(kept.time_s, 0.0));
            dose.add(&self.dose(cell, &kept));
            let contact = if kept.contact {
                Lower::flat(f64::INFINITY, 0.0)
            } else {
                touch.bound(cell.half > SMALL * edges.foundation.radius_m)
            };
            [
                contact,
                time.over_height_error(error_m),
                dose.over_height_error(error_m),
            ]
        };
        // A cell that gets enough everywhere is not refined.
        let all = bounds(Default::default());
        let below = shares_below(&all);
        if below == [0.0; 3] {
            return None;
        }
        let found = |bounds, below| CellBounds {
            amounts: kept,
            bounds,
            below,
            compression_m: touch.compression_m,
        };
        if spans.is_empty() {
            return Some(found(all, below));
        }
        // Hardly anything is known of a large cell while it leaves or enters: its quarters are examined instead.
        let is_large = cell.half > LARGE * edges.foundation.radius_m;
        let mut gains = [Lower::flat(0.0, if is_large { f64::INFINITY } else { 0.0 }); 2];
        for span in spans.iter().filter(|_| !is_large) {
            self.gains(cell, states.get(span.clone()).unwrap_or_default(), &mut gains);
        }
        let bounds = bounds(gains);
        let below = shares_below(&bounds);
        (below != [0.0; 3]).then(|| found(bounds, below))
    }

    /// Adds the states at the moments of a window at which a cell may be within the sponge to the first `count` of `all`, run by run, and
    /// returns the new count.
    fn runs(
        &self,
        cell: &FaceCell,
        window: [u32; 2],
        (all, mut count): (&mut Vec<CellState>, usize),
        kept: &mut CellAmounts,
        spans: &mut Vec<Range<usize>>,
    ) -> usize {
        let (edges, reach_m) = (&self.edges, self.reach_m(cell));
        let mut looks = edges.looks(window[0] as usize..window[1] as usize + 1);
        if all.len() < count + looks.len() {
            all.resize(count + looks.len(), CellState::default());
        }
        while !looks.is_empty() {
            let (mut length, mut beyond_m, mut contact, mut begins) = (0, 0.0, false, false);
            for (look, state) in looks.iter().zip(&mut all[count..]) {
                let off_m = edges.see(cell, look, reach_m, state);
                let is_near = off_m <= reach_m;
                if !is_near {
                    beyond_m = off_m - reach_m;
                    break;
                }
                // No sag is below 0.
                let wholly = state.inside_m >= 0.0 && state.pressed_m >= 0.0;
                state.full = wholly && begins && state.is_in(&look.sags[0]);
                begins = wholly && state.is_in(&look.sags[1]);
                contact |= wholly;
                length += 1;
            }
            if length > 0 {
                kept.contact |= contact;
                self.split(&all[count..count + length], count, kept, spans);
                count += length;
            }
            // No moment before that one is near enough.
            let far = 1_usize.saturating_add((beyond_m / self.step_m) as usize);
            looks = looks.get(length.saturating_add(far)..).unwrap_or_default();
        }
        count
    }

    /// Separates the runs of moments between which all of a cell is in contact from the windows in which it is not, in consecutive moments,
    /// of which the first is the one at `start`. A window has one more pair of moments at either side, as the quarters of the cell leave and
    /// enter from there on.
    fn split(&self, near: &[CellState], start: usize, kept: &mut CellAmounts, spans: &mut Vec<Range<usize>>) {
        let pairs = near.len() - 1;
        let is_full = |pair: usize| near[pair + 1].full;
        let mut window = (pairs == 0).then_some(0);
        let mut pair = 0;
        let mut full = pairs > 0 && is_full(0);
        while pair < pairs {
            let alike = near[pair + 2..].iter().position(|seen| seen.full != full);
            let end = alike.map_or(pairs, |more| pair + 1 + more);
            let (before, after) = (window.is_some(), end < pairs);
            if !full {
                window = window.or(Some(pair));
            } else if !(before && after && end == pair + 1) {
                spans.extend(window.take().map(|first| start + first..start + pair + 2));
                let [run, to] = [pair + usize::from(before), end - usize::from(after)].map(|k| near[k].index);
                if run < to {
                    kept.time_s += self.edges.look(to).t_s - self.edges.look(run).t_s;
                    kept.dose = kept.dose + self.sums.between(run, to);
                }
                window = after.then(|| end - 1);
            }
            (pair, full) = (end, !full);
        }
        spans.extend(window.map(|first| start + first..start + near.len()));
    }

    /// Adds the gains of a cell in a window: those where its places leave or enter, and those that all places get.
    fn gains(&self, cell: &FaceCell, window: &[CellState], gains: &mut [Lower; 2]) {
        let mut add = |gain: &Gain| {
            gains[0].add(&gain.time);
            gains[1].add(&gain.dose);
        };
        let [left, entered] = self.edges.gain(cell, window);
        let from_s = left.map_or(f64::NEG_INFINITY, |gain| gain.until_s);
        let to_s = entered.map_or(f64::INFINITY, |gain| gain.until_s);
        left.iter().chain(&entered).for_each(&mut add);
        if left.or(entered).is_none() && cell.half > SMALL * self.edges.foundation.radius_m {
            return add(&self.edges.greatest_likely_gain(cell, window));
        }
        let time = |seen: &CellState| self.edges.look(seen.index).t_s;
        for ends in window.windows(2) {
            if left.is_some() && time(&ends[0]) < from_s || entered.is_some() && time(&ends[1]) > to_s {
                continue;
            }
            if let Some(gain) = self.edges.flat(cell, [&ends[0], &ends[1]]) {
                add(&gain);
            }
        }
    }

    /// Returns a lower bound on the dose that all of a cell gets in runs of moments in which it is wholly in contact: the difference of two sums.
    fn dose(&self, cell: &FaceCell, amounts: &CellAmounts) -> Lower {
        let (value, gradient) = amounts.dose.at(&cell.point);
        let error_m = self.edges.thresholds.height_error_m;
        let lost =
            amounts.dose.bend(cell.max_distance_m() + error_m) + gradient.z.abs() * cell.bend_m + self.sums.rounding();
        Lower {
            value: value - lost,
            slope: cell.along(&gradient),
            over_height: gradient.z,
            slack: 2.0 * lost,
        }
    }
}

/// Longest step of the sponge between two moments, its rim included \[m\].
fn longest_step(moments: &[Moment], radius_m: f64) -> f64 {
    let step = |pair: &[Moment]| {
        let [from, to] = [&pair[0].pose, &pair[1].pose];
        (to.tip - from.tip).norm() + radius_m * (to.axis - from.axis).norm()
    };
    moments.windows(2).map(step).fold(0.0, f64::max)
}
