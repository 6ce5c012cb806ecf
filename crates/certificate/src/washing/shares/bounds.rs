//! Bounds over a cell: lower bounds of compression, contact time and dose.

use crate::washing::shares::Sags;
use crate::washing::shares::cell::{Cell, CellState, Lower};
use crate::washing::shares::doses::{Polynomial, Sums};
use crate::washing::shares::edges::{Edges, Gain, Touch};
use platewash_workcell::contact::{ContactThresholds, Foundation, Moment};
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
        }
    }

    /// Fills `windows` with the runs of moments near a cell.
    pub fn windows_near(&self, cell: &Cell, windows: &mut Vec<[u32; 2]>) {
        let moments = self.edges.moments;
        let reach_m = self.reach_m(cell);
        let mut index = 0;
        while let Some(moment) = moments.get(index) {
            let away = cell.point - moment.pose.tip;
            let along = away.dot(&moment.pose.axis);
            let off_m = (away.norm_squared() - along * along).max(0.0).sqrt();
            if off_m > reach_m {
                // No moment before that one is near enough.
                index = index
                    .saturating_add(1)
                    .saturating_add(((off_m - reach_m) / self.step_m) as usize);
                continue;
            }
            let at = index as u32;
            match windows.last_mut() {
                Some([_, last]) if *last + 1 == at => *last = at,
                _ => windows.push([at; 2]),
            }
            index += 1;
        }
    }

    /// Upper bound on the distance of the sponge's axis from the middle of a cell, across the axis, at which a point of the cell may be
    /// within the sponge at that moment or the neighbouring ones \[m\].
    pub fn reach_m(&self, cell: &Cell) -> f64 {
        self.edges.foundation.radius_m + cell.max_distance_m() + self.step_m
    }
}

impl Passes<'_> {
    /// Bounds a cell through some windows of moments, on top of the amounts `kept` that are known already. Returns `None` where those
    /// bounds are enough.
    pub(crate) fn bounds(
        &self,
        cell: &Cell,
        (mut kept, within): (CellAmounts, &[[u32; 2]]),
        scratch: &mut Scratch,
        is_enough: impl Fn(&[Lower; 3]) -> bool,
    ) -> Option<CellBounds> {
        let edges = &self.edges;
        let error_m = edges.thresholds.height_error_m;
        let Scratch { all, spans } = scratch;
        all.clear();
        spans.clear();
        let mut touch = Touch::default();
        for &[from, to] in within {
            let first = all.len();
            all.extend((from..=to).map(|index| cell.state_at(edges, index)));
            self.runs(cell, all, first, &mut kept, &mut touch, spans);
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
        if is_enough(&bounds(Default::default())) {
            return None;
        }
        // Hardly anything is known of a large cell while it leaves or enters: its quarters are examined instead.
        let is_large = cell.half > LARGE * edges.foundation.radius_m && !spans.is_empty();
        let mut gains = [Lower::flat(0.0, if is_large { f64::INFINITY } else { 0.0 }); 2];
        for span in spans.iter().filter(|_| !is_large) {
            self.gains(cell, all.get(span.clone()).unwrap_or_default(), &mut gains);
        }
        let bounds = bounds(gains);
        (!is_enough(&bounds)).then_some(CellBounds {
            amounts: kept,
            bounds,
            compression_m: touch.compression_m,
        })
    }

    /// Separates the runs of moments between which all of a cell is in contact from the windows in which it is not, in consecutive moments
    /// `seen` from `first` on. A window has one more pair of moments at either side, as the quarters of the cell leave and enter from there
    /// on.
    fn runs(
        &self,
        cell: &Cell,
        all: &[CellState],
        first: usize,
        kept: &mut CellAmounts,
        touch: &mut Touch,
        spans: &mut Vec<Range<usize>>,
    ) {
        let reach_m = self.reach_m(cell);
        let mut from = first;
        while from < all.len() {
            let length = all[from..].iter().take_while(|seen| seen.off_m <= reach_m).count();
            let near = from..from + length;
            from = near.end + 1;
            let Some(pairs) = length.checked_sub(1) else { continue };
            if !kept.contact {
                all[near.clone()]
                    .iter()
                    .for_each(|seen| touch.see(&self.edges, cell, seen));
                kept.contact = touch.all;
            }
            let is_full = |pair: usize| self.edges.is_full(&all[near.start + pair], &all[near.start + pair + 1]);
            let mut window = (pairs == 0).then_some(0);
            let mut pair = 0;
            let mut full = pairs > 0 && is_full(0);
            while pair < pairs {
                let end = (pair + 1..pairs).find(|&k| is_full(k) != full).unwrap_or(pairs);
                let (before, after) = (window.is_some(), end < pairs);
                if !full {
                    window = window.or(Some(pair));
                } else if !(before && after && end == pair + 1) {
                    spans.extend(window.take().map(|start| near.start + start..near.start + pair + 2));
                    let [run, to] =
                        [pair + usize::from(before), end - usize::from(after)].map(|k| &all[near.start + k]);
                    if run.index < to.index {
                        kept.time_s += self.edges.look(to.index).t_s - self.edges.look(run.index).t_s;
                        kept.dose += self.sums.between(run.index, to.index);
                    }
                    window = after.then(|| end - 1);
                }
                (pair, full) = (end, !full);
            }
            spans.extend(window.map(|start| near.start + start..near.end));
        }
    }

    /// Adds the gains of a cell in a window: those where its places leave or enter, and those that all places get.
    fn gains(&self, cell: &Cell, window: &[CellState], gains: &mut [Lower; 2]) {
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
        for ends in window.windows(2) {
            let [from, to] = [&ends[0], &ends[1]].map(|seen| self.edges.look(seen.index).t_s);
            if from >= from_s && to <= to_s {
                add(&self.edges.flat(cell, [&ends[0], &ends[1]]));
            }
        }
    }

    /// Returns the dose that all of a cell gets.
    fn dose(&self, cell: &Cell, amounts: &CellAmounts) -> Lower {
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
