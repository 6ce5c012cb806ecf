//! How far the sponge reaches beyond the rims.

use crate::check::{Check, Measure, Sense, Unit, Worst};
use crate::face::{Face, PLACE_M};
use crate::neighbours;
use crate::piece::Piece;
use crate::polyline::Polyline;
use crate::requirement::Requirement;
use crate::schedule::{Schedule, Span, is_at_plate};
use crate::subject::Subject;
use crate::swept::{PlateCoverage, Wash};
use crate::tip::Arm;
use crate::tip_limits::Tips;
use platewash_kinematics::trig::cos;
use platewash_workcell::job::PATH_TOLERANCE_M;
use platewash_workcell::plate::Plate;
use platewash_workcell::segment::SegmentKind;

/// How often a piece of an approach or a retreat is halved at most: pieces are long there.
const LINE_HALVINGS: u32 = 12;

/// What is proved of the tip, as far as the reach of the sponge depends on it.
pub(crate) struct Proved<'a> {
    pub arm: &'a Arm<'a>,
    pub pieces: &'a [Piece],
    pub schedule: &'a Schedule,
    pub tips: &'a Tips,
    /// How far the tip is from its wash path at most, where that is proved \[m\].
    pub path_deviation_m: Option<f64>,
}

impl Proved<'_> {
    /// The spans at a plate, with their indices.
    fn spans_at(&self, plate: usize) -> impl Iterator<Item = (usize, &Span)> {
        let spans = self.schedule.spans.iter().enumerate();
        spans.filter(move |(_, span)| span.plate == plate && is_at_plate(span.kind))
    }
}

/// Fills in how far the sponge may reach beyond the rim of each plate, and what it may touch there.
pub(crate) fn settle(subject: &Subject<'_>, washes: &mut [Wash], proved: &Proved<'_>) {
    let most_tilted = cos(subject.limits.tilt_rad);
    for wash in washes {
        let index = wash.swept.plate;
        let Some(plate) = subject.plates().get(index) else {
            continue;
        };
        let radius_m = subject.path_radius_m(index).unwrap_or(0.0);
        let allowed_m = radius_m + outward_m(subject, index) + PATH_TOLERANCE_M;
        let spans = proved.spans_at(wash.swept.plate);
        let cos_tilt = spans.fold(1.0, |least: f64, (i, _)| {
            least.min(proved.tips.least_upright_cosine_of(i))
        });
        // About the axis of a face that is no disc no tilt is asked for.
        let most_tilted = if plate.surface.is_flat() { most_tilted } else { cos_tilt };
        let [tip_m, seen_m] = tip_m(allowed_m, (radius_m, plate), wash, proved);
        let reach_m = neighbours::beyond_rim_m(subject, plate, tip_m, cos_tilt);
        let swept = &mut wash.swept;
        let touched = |reach_m| neighbours::touched(subject, index, reach_m);
        swept.beyond_rim_allowed_m = neighbours::beyond_rim_m(subject, plate, allowed_m, cos_tilt.max(most_tilted));
        swept.beyond_rim_seen_m = neighbours::beyond_rim_m(subject, plate, seen_m, cos_tilt.max(most_tilted));
        swept.beyond_rim_m = Some(reach_m).filter(|reach_m| reach_m.is_finite());
        swept.touches = swept.beyond_rim_m.map_or_else(Vec::new, touched);
    }
}

/// How far outwards the lines along the normal over the ends of a wash path lead: where the face falls towards the rim \[m\].
fn outward_m(subject: &Subject<'_>, plate: usize) -> f64 {
    let (Some(path), Some(plate)) = (subject.path_of(plate), subject.plates().get(plate)) else {
        return 0.0;
    };
    let ends = [0.0, path.curve.end()].map(|theta| {
        let [arc_m, ..] = path.curve.arc(theta);
        -plate.surface.at_arc(arc_m).sine
    });
    path.lift_m * ends[0].max(ends[1]).max(0.0)
}

/// What the tip is not farther from the pole of a plate, seen along its axis, in its wash and in all approaches to the plate and
/// retreats from it, and how far it was seen to be \[m\]; infinite where that is not bounded.
fn tip_m(allowed_m: f64, (radius_m, plate): (f64, &Plate), wash: &Wash, proved: &Proved<'_>) -> [f64; 2] {
    let along_path_m = (proved.path_deviation_m).map_or(f64::INFINITY, |off_m| radius_m + PLACE_M + off_m);
    let tips = proved.spans_at(wash.swept.plate).map(|(i, span)| match span.kind {
        // The wash of another entry.
        SegmentKind::Wash if i != wash.span => [0.0; 2],
        SegmentKind::Wash => [wash.tip_m.min(along_path_m), wash.seen_m],
        _ => {
            let pieces = &proved.pieces[span.pieces.clone()];
            let line = Polyline::new(proved.arm, pieces, &Face::of(plate), allowed_m, LINE_HALVINGS);
            [line.within_m, line.seen_m]
        }
    });
    // NaN must not get lost.
    let greater = |most: f64, tip: f64| if tip.is_nan() { f64::INFINITY } else { most.max(tip) };
    tips.fold([0.0; 2], |[most, seen], [tip, there]| {
        [greater(most, tip), seen.max(there)]
    })
}

/// The sponge reaches no farther beyond any rim than the wash path and its own radius make it.
pub(crate) fn check(subject: &Subject<'_>, coverage: &[PlateCoverage]) -> Check {
    if coverage.iter().any(|c| subject.path_of(c.plate).is_none()) {
        return Check::not_judged(Requirement::Reach);
    }
    let excess = |c: &PlateCoverage| c.beyond_rim_m.unwrap_or(f64::INFINITY) - c.beyond_rim_allowed_m;
    let Some(worst) = coverage.iter().max_by(|a, b| excess(a).total_cmp(&excess(b))) else {
        return Check::not_judged(Requirement::Reach);
    };
    let measure = Measure {
        bound: worst.beyond_rim_m,
        seen: Some(worst.beyond_rim_seen_m),
        limit: worst.beyond_rim_allowed_m,
        sense: Sense::AtMost,
        unit: Unit::Metre,
    };
    let place = Worst {
        plate: Some(worst.plate),
        ..Worst::default()
    };
    Check::measured(Requirement::Reach, measure, place)
}
