//! How much of a plate the sponge sweeps, at least.
//!
//! Tilted by τ, the sponge's face lies over a disc of radius s cos τ about the tip. Between neighbours of a polyline of
//! moments the tip leaves the chord by at most h²/8 · sup ‖p̈‖; less the greatest of these, the disc sweeps at least what it
//! would along the polyline.

use crate::check::{Check, Measure, Sense, Unit, Worst};
use crate::error::ProveError;
use crate::face::Face;
use crate::neighbours::Touched;
use crate::piece::Piece;
use crate::polyline::{MOST_HALVINGS, Polyline};
use crate::requirement::Requirement;
use crate::schedule::Schedule;
use crate::subject::Subject;
use crate::tip::Arm;
use crate::tip_limits::Tips;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::coverage::{CoverageSettings, coverage};
use platewash_workcell::job::PATH_TOLERANCE_M;
use platewash_workcell::segment::SegmentKind;
use serde::{Deserialize, Serialize};

/// Edges of the smallest cells, the second where the first do not suffice \[m\].
const CELLS_M: [f64; 2] = [1e-3, 2.5e-4];

/// The swept share of a plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlateCoverage {
    /// Index of the plate.
    pub plate: usize,
    /// What is proved: no smaller share is swept.
    pub at_least: f64,
    /// No greater share is swept; `None` where it was not needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// Least cos τ while washing, proved.
    pub cos_tilt: f64,
    /// How far the sponge reaches beyond the rim at the height of the plate's face while it comes down, washes and leaves, at most,
    /// negative where it stays within it \[m\]; `None` where nothing is proved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_rim_m: Option<f64>,
    /// How far a sponge that is tilted as much would reach where the tip was seen \[m\].
    pub beyond_rim_seen_m: f64,
    /// How far it may reach \[m\].
    pub beyond_rim_allowed_m: f64,
    /// The neighbours that it may touch there.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub touches: Vec<Touched>,
}

/// What came of one wash.
#[derive(Debug)]
pub(crate) struct Wash {
    /// Index of its span.
    pub span: usize,
    /// The tip is never farther from the plate's pole, seen along its axis \[m\].
    pub tip_m: f64,
    /// How far it was seen to be \[m\].
    pub seen_m: f64,
    pub swept: PlateCoverage,
}

/// Coverage of every plate that is washed.
///
/// # Errors
/// [`ProveError::Coverage`] for lengths that make no sense, [`ProveError::Cancelled`].
pub(crate) fn washes(
    arm: &Arm<'_>,
    subject: &Subject<'_>,
    (pieces, schedule): (&[Piece], &Schedule),
    tips: &Tips,
    cancel: &CancelToken,
) -> Result<Vec<Wash>, ProveError> {
    let mut all = Vec::new();
    for (span, stretch) in schedule.spans.iter().enumerate() {
        if stretch.kind != SegmentKind::Wash || subject.plates().get(stretch.plate).is_none() {
            continue;
        }
        let pieces = &pieces[stretch.pieces.clone()];
        let (swept, line) = swept_of(
            arm,
            subject,
            (pieces, stretch.plate),
            tips.least_cosine_of(span),
            cancel,
        )?;
        all.push(Wash {
            span,
            tip_m: line.within_m,
            seen_m: line.seen_m,
            swept,
        });
    }
    Ok(all)
}

/// What the sponge sweeps of a plate during some pieces, with cos τ never below `cos_tilt`, and the polyline of the tip. The tip should
/// keep within its wash path: where it does, that is proved.
fn swept_of(
    arm: &Arm<'_>,
    subject: &Subject<'_>,
    (pieces, index): (&[Piece], usize),
    cos_tilt: f64,
    cancel: &CancelToken,
) -> Result<(PlateCoverage, Polyline), ProveError> {
    let (plate, sponge_m) = (&subject.plates()[index], subject.sponge_m());
    let within_m = subject.path_radius_m(index).unwrap_or(0.0) + PATH_TOLERANCE_M;
    let line = Polyline::new(arm, pieces, &Face::of(plate), within_m, MOST_HALVINGS);
    let share = |radius_m: f64, cell_m: f64| {
        cancel.check()?;
        let settings = CoverageSettings {
            cell_m: cell_m.max(1e-4 * plate.rim_m()),
        };
        let share = coverage(&line.points, [0.0; 2], plate.rim_m(), radius_m, &settings)?;
        Ok::<_, ProveError>(share)
    };
    let required = subject.limits.coverage;
    let shrunk = sponge_m * cos_tilt - line.off_m;
    let mut swept = PlateCoverage {
        plate: index,
        at_least: 0.0,
        at_most: None,
        cos_tilt,
        beyond_rim_m: None,
        beyond_rim_seen_m: 0.0,
        beyond_rim_allowed_m: 0.0,
        touches: Vec::new(),
    };
    if shrunk > 0.0 {
        swept.at_least = share(shrunk, CELLS_M[0])?.lower;
        if swept.at_least < required {
            swept.at_least = swept.at_least.max(share(shrunk, CELLS_M[1])?.lower);
        }
    }
    if swept.at_least < required && line.off_m.is_finite() {
        swept.at_most = Some(share(sponge_m + line.off_m, CELLS_M[1])?.upper);
    }
    Ok((swept, line))
}

/// Every plate is swept to the share required: the plate of which the least is.
pub(crate) fn check(subject: &Subject<'_>, coverage: &[PlateCoverage]) -> Check {
    let worst = coverage.iter().min_by(|a, b| a.at_least.total_cmp(&b.at_least));
    let Some(worst) = worst else {
        return Check::not_judged(Requirement::Coverage);
    };
    let all_washed = (0..subject.plates().len()).all(|i| coverage.iter().any(|c| c.plate == i));
    let measure = Measure {
        bound: Some(if all_washed { worst.at_least } else { 0.0 }),
        seen: worst.at_most,
        limit: subject.limits.coverage,
        sense: Sense::AtLeast,
        unit: Unit::Share,
    };
    let place = Worst {
        plate: Some(worst.plate),
        ..Worst::default()
    };
    Check::measured(Requirement::Coverage, measure, place)
}
