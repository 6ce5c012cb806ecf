//! Lower bound on the swept share of a plate: from the sponge's face on a disc, from the area it touches on other faces.
//!
//! Requirement 26, formula (26.1) in `docs/certificate.md`.
//!
//! Tilted by τ, the sponge's face lies over a disc of radius s cos τ about the tip. Between neighbours of a polyline of
//! moments the tip leaves the chord by at most h²/8 · sup ‖p̈‖; less the greatest of these, the disc sweeps at least what it
//! would along the polyline.
//!
//! What is pressed is swept: where the share proved to be pressed (requirement 27) reaches the required one, it is the bound.

use crate::error::ProveError;
use crate::judged_job::JudgedJob;
use crate::motion::tip::{Arm, TipPiece};
use crate::motion::tip_limits::Tips;
use crate::plan_statements::schedule::Schedule;
use crate::report::check::{Check, Measure, Sense, WorstCase};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::face::Face;
use crate::washing::face_shares::{Fineness, shares};
use crate::washing::instants::Instants;
use crate::washing::plate_contact::PlateContact;
use crate::washing::plate_coverage::PlateCoverage;
use crate::washing::polyline::{MOST_HALVINGS, Polyline};
use crate::washing::wash_inputs::{ContactInputs, Washing};
use platewash_bodies::contact::Foundation;
use platewash_bodies::coverage::coverage;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::job::PATH_TOLERANCE_M;
use rayon::prelude::*;

/// Edges of the smallest cells \[m\]. Each is used where the ones before it do not suffice.
const CELLS_M: [f64; 2] = [1e-3, 2.5e-4];

/// Results for one wash.
#[derive(Debug)]
pub(crate) struct Wash {
    /// Index of its span.
    pub span: usize,
    /// Upper bound on the distance of the tip from the plate's pole, seen along the plate's axis \[m\].
    pub tip_m: f64,
    /// Greatest such distance at the moments that were computed \[m\].
    pub seen_m: f64,
    pub swept: PlateCoverage,
    /// Bounds of the contact, where the job has contact requirements.
    pub contact: Option<PlateContact>,
}

/// Coverage of every plate that is washed, formula (26.1), and contact with it where the job asks for that.
///
/// # Errors
/// [`ProveError::Coverage`] for lengths that make no sense, [`ProveError::Cancelled`].
pub(crate) fn washes(
    arm: &Arm<'_>,
    judged: &JudgedJob<'_>,
    pieces: &[TipPiece<'_>],
    schedule: &Schedule,
    tips: &Tips,
    cancel: &CancelToken,
) -> Result<Vec<Wash>, ProveError> {
    let spans = schedule.spans.par_iter().enumerate();
    let washed = spans.filter_map(|(index, span)| {
        let plate = judged.plates().get(span.plate)?;
        (span.kind == SegmentKind::Wash).then_some(Washing {
            arm,
            judged,
            pieces: &pieces[span.pieces.clone()],
            around: schedule
                .around(span.plate)
                .map(|span| &pieces[span.pieces.clone()])
                .collect(),
            around_cosine: tips.least_upright_cosine_at(schedule, span.plate),
            span: index,
            plate,
            index: span.plate,
            tips,
            cancel,
        })
    });
    washed.map(|washing| washing.judge()).collect()
}

impl Washing<'_> {
    fn judge(&self) -> Result<Wash, ProveError> {
        let judged = self.judged;
        let within_m = judged.path_radius_m(self.index).unwrap_or(0.0) + PATH_TOLERANCE_M;
        let line = Polyline::new(self.arm, self.pieces, &Face::new(self.plate), within_m, MOST_HALVINGS);
        let contact = self.contact(&line)?;
        let mut swept = PlateCoverage {
            plate: self.index,
            at_least: 0.0,
            at_most: None,
            cos_tilt: self.tips.least_cosine_of(self.span),
            beyond_rim_m: None,
            beyond_rim_seen_m: 0.0,
            beyond_rim_allowed_m: 0.0,
            touches: Vec::new(),
        };
        let pressed = contact.map(|contact| contact.pressed.at_least);
        match pressed.filter(|pressed| *pressed >= self.judged.job.requirements.coverage) {
            Some(pressed) => swept.at_least = pressed,
            None if self.plate.surface.is_flat() => self.sweep(&line, &mut swept)?,
            None => swept.at_least = self.touched_share(pressed.unwrap_or(0.0))?,
        }
        Ok(Wash {
            span: self.span,
            tip_m: line.within_m,
            seen_m: line.seen_m,
            swept,
            contact,
        })
    }

    /// Bounds the share of a disc that the sponge sweeps: at least that which a disc of the radius s cos τ − Δ sweeps along the polyline, formula
    /// (26.1). `line` has Δ, `swept` has the lower bound on cos τ.
    fn sweep(&self, line: &Polyline, swept: &mut PlateCoverage) -> Result<(), ProveError> {
        let (plate, sponge_m) = (self.plate, self.judged.sponge_m());
        let share = |radius_m: f64, cell_m: f64| {
            self.cancel.check()?;
            let (rim_m, cell_m) = (plate.rim_m(), cell_m.max(1e-4 * plate.rim_m()));
            coverage(&line.points, [0.0; 2], rim_m, radius_m, cell_m).map_err(ProveError::Coverage)
        };
        let required = self.judged.job.requirements.coverage;
        let shrunk = sponge_m * swept.cos_tilt - line.off_m;
        if shrunk > 0.0 {
            swept.at_least = share(shrunk, CELLS_M[0])?.lower;
            if swept.at_least < required {
                swept.at_least = swept.at_least.max(share(shrunk, CELLS_M[1])?.lower);
            }
        }
        if swept.at_least < required && line.off_m.is_finite() {
            swept.at_most = Some(share(sponge_m + line.off_m, CELLS_M[1])?.upper);
        }
        Ok(())
    }

    /// Returns a lower bound on the share of a face that is no disc that the sponge touches, by area, with the plate at its stated
    /// position; not less than the `pressed` one.
    fn touched_share(&self, pressed: f64) -> Result<f64, ProveError> {
        if !self.meets_from_above() {
            return Ok(pressed);
        }
        let required = self.judged.job.requirements.coverage;
        let sponge = &self.judged.job.workcell.tool.sponge;
        // Whatever its stiffness: no dose is asked for.
        let foundation = Foundation::stiff(sponge, [0.0; 2]);
        let wanted = ContactThresholds {
            compression_m: 0.0,
            height_error_m: 0.0,
            time_s: 0.0,
            dose_pa_m: 0.0,
        };
        let instants = Instants::new(self.arm, self.pieces, self.plate, (&foundation, 0.0));
        self.cancel.check()?;
        let fineness = Fineness {
            cell_m: CELLS_M[1],
            enough: [required; 3],
        };
        let moments = (&instants.moments[..], &[][..]);
        let found = shares(&self.plate.surface, &foundation, moments, &wanted, &fineness);
        Ok(found.contact.at_least.max(pressed))
    }

    /// Bounds the contact, where the job has contact requirements.
    fn contact(&self, line: &Polyline) -> Result<Option<PlateContact>, ProveError> {
        let job = self.judged.job;
        let (Some(wanted), Some(foundation)) = (
            job.contact_of(self.plate),
            Foundation::from_sponge(&job.workcell.tool.sponge),
        ) else {
            return Ok(None);
        };
        let error_m = wanted.height_error_m;
        let instants_of = |pieces| Instants::new(self.arm, pieces, self.plate, (&foundation, error_m));
        let instants = instants_of(self.pieces);
        let around: Vec<_> = self.around.iter().map(|pieces| instants_of(pieces)).collect();
        let pressed = ContactInputs {
            washing: self,
            foundation: &foundation,
            wanted: &wanted,
            instants: &instants,
            around: &around,
            distance_m: line.within_m,
        };
        Ok(Some(pressed.judge()?))
    }
}

/// Checks that every plate is swept to the required share. Reports the plate with the least share.
pub(crate) fn check(judged: &JudgedJob<'_>, coverage: &[PlateCoverage]) -> Check {
    let worst = coverage.iter().min_by(|a, b| a.at_least.total_cmp(&b.at_least));
    let Some(worst) = worst else {
        return Check::not_judged(Requirement::Swept);
    };
    let all_washed = judged
        .job
        .plates_to_wash()
        .all(|i| coverage.iter().any(|c| c.plate == i));
    let bounds = [Some(if all_washed { worst.at_least } else { 0.0 }), worst.at_most];
    let measure = Measure::new(Sense::AtLeast, judged.job.requirements.coverage, Unit::Share, bounds);
    Check::measured(Requirement::Swept, measure, WorstCase::on_plate(worst.plate))
}
