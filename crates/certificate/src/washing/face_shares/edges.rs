//! The moments of a wash over a plate, and the state of a cell at each: the windows in which its places leave or enter.

use crate::washing::face_shares::face_cell::{CellState, FaceCell};
use crate::washing::face_shares::look::Look;
use crate::washing::face_shares::lower::Lower;
use crate::washing::face_shares::sags::Sags;
use platewash_bodies::contact::{Foundation, Moment};
use platewash_workcell::job::ContactThresholds;
use std::ops::Range;

/// Inputs for the bounds of moments over a plate.
pub(crate) struct Edges<'a> {
    pub foundation: &'a Foundation,
    pub moments: &'a [Moment],
    pub thresholds: &'a ContactThresholds,
    looks: Vec<Look>,
}

/// Lower bounds of time and dose that a cell gets in a part of a window.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Gain {
    pub time: Lower,
    pub dose: Lower,
    /// Latest time at which any place leaves, or earliest at which any enters \[s\].
    pub until_s: f64,
}

/// Consecutive moments, in order or in reversed time.
#[derive(Clone, Copy)]
pub(crate) struct Window<'a> {
    pub(super) state: &'a [CellState],
    pub reversed: bool,
    /// Time of the first moment \[s\].
    pub(super) start_s: f64,
}

/// Times at which the places of a cell leave, counted from the first moment of a window.
pub(crate) struct LeavingTimes {
    /// Time t₀ since the first moment \[s\].
    pub at_s: f64,
    /// Time η by which a place may leave sooner \[s\].
    pub sooner_s: f64,
    pub slope: [f64; 2],
    pub over_height: f64,
    /// Greatest difference between t₀ and the time at which a place of the cell leaves \[s\].
    pub spread_s: f64,
    /// First moment at which all places have left.
    pub last: usize,
}

impl Window<'_> {
    pub fn at(&self, k: usize) -> Option<&CellState> {
        // What is before the first moment wraps round to where none is.
        let last = self.state.len().wrapping_sub(1);
        self.state.get(if self.reversed { last.wrapping_sub(k) } else { k })
    }

    /// Returns the states from the first moment to another one.
    pub fn states_until(&self, last: usize) -> impl Iterator<Item = &CellState> {
        let (ahead, back) = if self.reversed {
            let from = self.state.len().saturating_sub(last + 1);
            (&[][..], self.state.get(from..).unwrap_or_default())
        } else {
            (self.state.get(..=last).unwrap_or(self.state), &[][..])
        };
        ahead.iter().chain(back.iter().rev())
    }
}

impl<'a> Edges<'a> {
    pub fn new(
        foundation: &'a Foundation,
        (moments, sags): (&'a [Moment], &'a [Sags]),
        thresholds: &'a ContactThresholds,
    ) -> Self {
        let unknown = Sags {
            compression_m: f64::INFINITY,
            aside_m: f64::INFINITY,
            slide_m: f64::INFINITY,
        };
        let look = |(index, moment): (usize, &Moment)| {
            let axis = moment.pose.axis;
            let (tilt, upright) = (length(axis.x, axis.y), axis.z.abs());
            Look {
                index: index as u32,
                t_s: moment.t_s,
                tip: moment.pose.tip,
                axis,
                tilt,
                upright,
                turning: moment.turning.norm(),
                aside_m: thresholds.height_error_m * tilt,
                lower_m: upright * thresholds.height_error_m,
                sags: [index.wrapping_sub(1), index].map(|k| sags.get(k).copied().unwrap_or(unknown)),
            }
        };
        Self {
            foundation,
            moments,
            thresholds,
            looks: moments.iter().enumerate().map(look).collect(),
        }
    }

    pub fn look(&self, index: u32) -> &Look {
        &self.looks[index as usize]
    }

    /// Returns the sponge at some moments.
    pub fn looks(&self, moments: Range<usize>) -> &[Look] {
        self.looks.get(moments).unwrap_or_default()
    }
}

impl Edges<'_> {
    pub fn moment(&self, index: u32) -> &Moment {
        &self.moments[index as usize]
    }

    /// Returns the sags between two neighbouring moments, in any order; infinite where nothing is known.
    pub fn sags(&self, a: &CellState, b: &CellState) -> &Sags {
        &self.look(a.index.min(b.index)).sags[1]
    }

    /// Time of a state since the first moment of a window \[s\].
    pub fn elapsed_s(&self, window: Window<'_>, state: &CellState) -> f64 {
        (self.look(state.index).t_s - window.start_s).abs()
    }

    /// Writes the state of a cell at a moment, with the compression w of formula (27.1) in `docs/contact.md`, and tells the distance of the
    /// sponge's axis from the middle \[m\]. Beyond `reach_m` of it, nothing else is computed.
    #[inline]
    pub fn see(&self, cell: &FaceCell, look: &Look, reach_m: f64, state: &mut CellState) -> f64 {
        let axis = &look.axis;
        let away = cell.point - look.tip;
        let along = away.dot(axis);
        let way = away - axis * along;
        let off_m = way.norm_squared().sqrt();
        let is_near = off_m <= reach_m;
        if !is_near {
            return off_m;
        }
        let across = if cell.is_level {
            look.tilt
        } else {
            let [gx, gy] = cell.along(axis);
            (gx * gx + gy * gy).sqrt()
        };
        let sloping_m = across * cell.reach_m + look.upright * cell.bend_m;
        let compression_m = self.foundation.compression_m - along;
        state.index = look.index;
        state.compression_m = compression_m;
        state.sloping_m = sloping_m;
        state.way = way;
        state.off_m = off_m;
        state.inside_m = self.foundation.radius_m - off_m - cell.farther_m(look);
        state.pressed_m = compression_m - look.shallower_m(sloping_m) - self.thresholds.compression_m;
        off_m
    }
}

/// Length of a vector of two components.
pub(super) fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}
