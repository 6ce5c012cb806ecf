//! Swept or pressed area of the plates: sampled for display, not the proof.
//!
//! Where a job states what counts as contact, and on every profile, a place counts as long as the foam presses it (`pressed.rs`).
//! On a disc without such a job, a sponge counts as a disc about its tip, seen along the plate's axis, of the radius s cos τ at
//! that moment: tilted by τ, its face is an ellipse that holds this disc. It counts while the plan washes the plate, as long as
//! the sponge touches ([`platewash_workcell::tool::Tool::touch`]).

use super::pressed::PressedRule;
use super::raster::{Disc, Marks, Raster};
use super::thin::thinned;
use super::tips::{Tip, washes};
use platewash_certificate as proved;
use platewash_motion::plan::Plan;
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::{Tool, Touch};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeSet;
use ts_rs::TS;

/// Cells of all rasters of a motion together, about.
pub(super) const CELLS: usize = 80_000;

/// Cells along an edge of a raster, at least and at most.
const EDGE: [usize; 2] = [24, 88];

/// Least distance between the places of two moments \[m\].
const STEP_M: f64 = 2e-3;

/// Longest stroke that is made of several moments \[m\].
const STROKE_M: f64 = 4e-3;

/// Swept area of a plate.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct PlateCoverage {
    /// Index of the plate.
    pub plate: usize,
    /// Half of the square's edge: the rim's radius \[m\].
    pub half_m: f64,
    /// Contact that counts; `None` where the sponge only has to be over a place.
    pub counted: Option<PressedRule>,
    /// Times at which each place counts, and for how long.
    #[serde(flatten)]
    pub marks: Marks,
    /// The least share of the counted area that the certificate proves; `None` without one.
    pub proved: Option<f64>,
}

impl PlateCoverage {
    /// The least share of the counted area that a certificate proves; `None` where it has no entry for the plate.
    #[must_use]
    pub fn proved_by(&self, certificate: &proved::Certificate) -> Option<f64> {
        proved_share(certificate, self.plate, self.counted)
    }
}

/// Rasters of all plates that a plan washes, with so many cells together, in the order of washing, from the tip during each wash (from and
/// to \[s\]).
pub(super) fn plates(
    plan: &Plan,
    certificate: Option<&proved::Certificate>,
    cells: usize,
    tips: impl Fn([f64; 2]) -> Vec<Tip> + Sync,
) -> Vec<PlateCoverage> {
    let mut seen = BTreeSet::new();
    let order = washes(plan).map(|(plate, _)| plate);
    let order: Vec<usize> = order.filter(|plate| seen.insert(*plate)).collect();
    let cells = (cells / order.len().max(1)).isqrt().clamp(EDGE[0], EDGE[1]);
    let duration_s = plan.duration_s();
    let one = |&index: &usize| {
        let plate = plan.job.plates.get(index)?;
        let of_plate = washes(plan).filter(|(washed, _)| *washed == index);
        let is_far = |last: &Tip, tip: &Tip| (tip.at - last.at).norm() >= STEP_M;
        let ways = of_plate.map(|(_, span)| thinned(&tips(span), is_far).into_iter().copied().collect());
        let counted = PressedRule::on(plate, &plan.job);
        let tool = &plan.job.workcell.tool;
        Some(PlateCoverage {
            plate: index,
            half_m: plate.rim_m(),
            counted,
            marks: swept(plate, tool, counted.as_ref(), ways, cells).marks(duration_s),
            proved: certificate.and_then(|certificate| proved_share(certificate, index, counted)),
        })
    };
    order.par_iter().filter_map(one).collect()
}

/// The least share of a plate that counts, as it is proved.
pub(crate) fn proved_share(
    certificate: &proved::Certificate,
    plate: usize,
    counted: Option<PressedRule>,
) -> Option<f64> {
    if counted.is_some_and(|counted| counted.is_promised) {
        let of = certificate.contact.iter().find(|contact| contact.plate == plate);
        return of.map(|contact| contact.pressed.at_least);
    }
    let of = certificate.swept.iter().find(|swept| swept.plate == plate);
    of.map(|swept| swept.at_least)
}

/// Computes the counted area of a plate on some paths of the sponge's tip.
pub(crate) fn swept(
    plate: &Plate,
    tool: &Tool,
    counted: Option<&PressedRule>,
    ways: impl Iterator<Item = Vec<Tip>>,
    cells: usize,
) -> Raster {
    let mut raster = Raster::new(plate.rim_m(), cells);
    if let Some(counted) = counted {
        ways.for_each(|way| counted.add(&mut raster, plate, tool, &way));
        return raster;
    }
    let disc = |tip: &Tip| {
        let local = plate.local(&tip.at);
        let cosine = -tip.axis.dot(&plate.normal_at(&tip.at));
        // Without a tool the whole sponge counts, however the flange is turned.
        let cosine = if tool.is_present() { cosine } else { 1.0 };
        Disc {
            t_s: tip.t_s,
            at: [local.x, local.y],
            radius_m: tool.sponge.radius_m * cosine,
        }
    };
    let touches = |tip: &Tip| tool.touch(plate.height_of(&tip.at)) == Touch::On;
    for way in ways {
        let mut stroke: Option<[Disc; 2]> = None;
        for tip in &way {
            let here = touches(tip).then(|| disc(tip)).filter(|disc| disc.radius_m > 0.0);
            stroke = match (stroke, here) {
                (Some([from, to]), Some(here)) if is_long(&from, &here) => {
                    raster.sweep(&from, &to);
                    Some([to, here])
                }
                (Some([from, _]), Some(here)) => Some([from, here]),
                (None, Some(here)) => Some([here, here]),
                (Some([from, to]), None) => {
                    raster.sweep(&from, &to);
                    None
                }
                (None, None) => None,
            };
        }
        if let Some([from, to]) = stroke {
            raster.sweep(&from, &to);
        }
    }
    raster
}

/// Checks that the path between two moments is too long for one straight stroke.
fn is_long(from: &Disc, to: &Disc) -> bool {
    let [x, y] = [to.at[0] - from.at[0], to.at[1] - from.at[1]];
    x * x + y * y > STROKE_M * STROKE_M
}
