//! How hard the sponge is pressed on a face that is no disc: branch and bound over the wash, the worst stretch first.
//!
//! The wash is cut into stretches of many moments each. What the plate asks of the foam over a stretch follows from where the columns
//! stand at both ends of it and from how the sponge may move between them (`contact/stands.rs`): loosely over a long stretch or with few
//! columns. Of each quantity the stretch with the worst bound is looked at more closely, with more columns or in halves, until that is as
//! near to what is shown of a single moment, with the most columns, as [`NEAR`] asks. It asks the same whatever the requirements are.

use crate::instants::Instants;
use crate::pressing::Pressing;
use crate::turning_frame::TurningFrame;
use platewash_workcell::contact::{Bends, Columns, Foundation, Press, Standing};
use platewash_workcell::plate::Plate;

/// Moments of a stretch at first.
const LONGEST: usize = 64;

/// How near the bounds come to those of single moments, as a part of them: of volumes and the greatest compression, and of the torque.
const NEAR: [f64; QUANTITIES] = [0.01, 0.01, 0.01, 0.02];

/// What a compression lacks between moments is not looked at more closely with more columns, but in halves, from here on \[m\].
const MOST_SAG_M: f64 = 1e-4;

/// Looks: with few columns, and with many.
const LOOKS: usize = 2;

/// The quantities: each the greater the worse.
const QUANTITIES: usize = 4;

/// A stretch between two moments by their index, and what is known of it.
struct Span {
    from: usize,
    to: usize,
    /// With which columns.
    look: usize,
    press: Press,
}

/// A search through the wash of a plate.
struct Search<'a> {
    bends: Bends<'a>,
    instants: &'a Instants,
    turning: TurningFrame<'a>,
    error_m: f64,
    looks: [Columns; LOOKS],
    /// Where the columns of each look stand at each moment, as far as was asked.
    standings: [Vec<Option<Standing>>; LOOKS],
    spans: Vec<Span>,
    /// The worst bound of a single moment.
    at_moments: [f64; QUANTITIES],
    /// What is no worse is not looked at more closely.
    enough: [f64; QUANTITIES],
    found: Pressing,
}

/// How hard the sponge is pressed on any face, which may lie higher or lower by `error_m`.
pub(crate) fn on_face(plate: &Plate, foundation: &Foundation, instants: &Instants, error_m: f64) -> Pressing {
    search((plate, error_m), foundation, instants, [f64::NEG_INFINITY; QUANTITIES])
}

/// How hard it is pressed at most before or after a wash of which that is known: as closely as it takes to show that it is no harder than in the wash, and
/// otherwise as [`on_face`].
pub(crate) fn around_face(
    plate: &Plate,
    foundation: &Foundation,
    (instants, wash): (&Instants, &Pressing),
    error_m: f64,
) -> Pressing {
    let enough = [f64::INFINITY, wash.volume[1].bound, wash.deepest.bound, wash.twist_m4];
    search((plate, error_m), foundation, instants, enough)
}

fn search(
    (plate, error_m): (&Plate, f64),
    foundation: &Foundation,
    instants: &Instants,
    enough: [f64; QUANTITIES],
) -> Pressing {
    let count = instants.moments.len();
    if count == 0 {
        return Pressing::unknown();
    }
    let mut search = Search {
        bends: Bends::of(&plate.surface),
        instants,
        turning: TurningFrame::new(plate, instants),
        error_m,
        looks: [Columns::new(foundation), Columns::fine(foundation)],
        standings: [vec![None; count], vec![None; count]],
        spans: Vec::new(),
        at_moments: [f64::NEG_INFINITY; QUANTITIES],
        enough,
        found: Pressing::new(),
    };
    let last = count - 1;
    for from in (0..last.max(1)).step_by(LONGEST) {
        let to = (from + LONGEST).min(last);
        let span = search.look(from, to, 0);
        search.spans.push(span);
    }
    for quantity in 0..QUANTITIES {
        search.settle(quantity);
    }
    for span in &search.spans {
        search.found.take(&span.press);
    }
    search.found
}

/// By how bad a press is, of each quantity; what is no number is the worst.
fn badness(press: &Press) -> [f64; QUANTITIES] {
    let all = [-press.volume_m3[0], press.volume_m3[1], press.deepest_m, press.twist_m4];
    all.map(|bad| if bad.is_nan() { f64::INFINITY } else { bad })
}

impl Search<'_> {
    /// Looks at the stretches that are the worst of a quantity, until that is known.
    fn settle(&mut self, quantity: usize) {
        loop {
            let bad = |span: &Span| badness(&span.press)[quantity];
            let worst = (0..self.spans.len()).max_by(|a, b| bad(&self.spans[*a]).total_cmp(&bad(&self.spans[*b])));
            let Some(worst) = worst else { return };
            let at_moments = self.at_moments[quantity];
            let near = (at_moments + NEAR[quantity] * at_moments.abs()).max(self.enough[quantity]);
            if bad(&self.spans[worst]) <= near || !self.refine(worst) {
                return;
            }
        }
    }

    /// Looks at a stretch more closely; `false` where that is not possible.
    fn refine(&mut self, span: usize) -> bool {
        let Span {
            from, to, look, press, ..
        } = self.spans[span];
        let finest = look + 1 == LOOKS;
        let longer = to - from > 1;
        if longer && (finest || press.sag_m > MOST_SAG_M) {
            let middle = from + (to - from) / 2;
            self.spans[span] = self.look(from, middle, look);
            let second = self.look(middle, to, look);
            self.spans.push(second);
        } else if !finest {
            self.spans[span] = self.look(from, to, look + 1);
        }
        longer || !finest
    }

    /// Looks at a stretch.
    fn look(&mut self, from: usize, to: usize, look: usize) -> Span {
        self.stand(from, look);
        self.stand(to, look);
        let standings = &self.standings[look];
        let press = match (&standings[from], &standings[to]) {
            (Some(a), Some(b)) => {
                let drift = self.turning.drift(from, to);
                self.looks[look].press(&self.bends, [a, b], &drift)
            }
            _ => Press::UNKNOWN,
        };
        Span { from, to, look, press }
    }

    /// Sees where the columns stand at a moment, and with the most of them what is certain of it.
    fn stand(&mut self, at: usize, look: usize) {
        if self.standings[look][at].is_some() {
            return;
        }
        let (columns, moment) = (&self.looks[look], &self.instants.moments[at]);
        let standing = columns.stand(&self.bends, &moment.pose, &self.turning.side(at), self.error_m);
        if look + 1 == LOOKS {
            let (seen, press) = columns.seen(&self.bends, &standing);
            self.found.see(&seen, moment.t_s, moment.pose.tip.into());
            for (most, found) in self.at_moments.iter_mut().zip(badness(&press)) {
                *most = most.max(found);
            }
        }
        self.standings[look][at] = Some(standing);
    }
}
