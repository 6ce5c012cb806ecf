//! Reach of the sponge beyond the rims.
//!
//! Requirement 25, formula (25.1) in `docs/certificate.md`; also formulas (8.1) and (24.1) there.
//!
//! Two questions are answered: which plates the sponge may touch while it works on another, and its reach beyond the rim of that one.
//!
//! The tip keeps within the wash path's radius R of the pole of its plate of radius r. At the height of the plate's face a sponge of
//! radius s, tilted by τ, reaches s / cos τ from the tip: upright it is its own radius, tilted its side wall lies as far out. (Below the
//! face it reaches less far; above it, where no plate of that height is, farther.) So it reaches at most R + s / cos τ − r beyond the rim.
//! A neighbour may be touched there and nowhere else; and by no more than its rim: not so far that the tip is over it, nor the sponge
//! over its centre.

use crate::judged_job::JudgedJob;
use crate::motion::tip::{Arm, TipPiece};
use crate::motion::tip_limits::Tips;
use crate::plan_statements::schedule::{Schedule, Span};
use crate::report::check::{Check, Discrepancy, Measure, Sense, WorstCase};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::coverage::Wash;
use crate::washing::face::{Face, PLACE_M, norm};
use crate::washing::plate_coverage::{PlateCoverage, ReachedNeighbour};
use crate::washing::polyline::Polyline;
use platewash_kinematics::trig::cos;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::job::{LINE_TOLERANCE_M, PATH_TOLERANCE_M};
use platewash_workcell::plate::Plate;
use platewash_workcell::words::{millimetres, plate_name};

/// Greatest depth of halving of a piece of an approach or a retreat. The pieces are long there.
const LINE_HALVINGS: u32 = 12;

/// Proved bounds of the tip on which the reach of the sponge depends.
pub(crate) struct ReachInputs<'a> {
    pub arm: &'a Arm<'a>,
    pub pieces: &'a [TipPiece<'a>],
    pub schedule: &'a Schedule,
    pub tips: &'a Tips,
    /// Upper bound on the distance of the tip from its wash path \[m\]; `None` where it is not proved.
    pub path_deviation_m: Option<f64>,
}

impl ReachInputs<'_> {
    /// Returns the spans at a plate, with their indices.
    fn spans_at(&self, plate: usize) -> impl Iterator<Item = (usize, &Span)> {
        let spans = self.schedule.spans.iter().enumerate();
        spans.filter(move |(_, span)| span.plate == plate && span.kind.is_at_plate())
    }
}

/// Fills in both sides of formula (25.1), the reach of the sponge beyond the rim of each plate and the one that the wash path implies, and the
/// plates it may touch there.
pub(crate) fn fill_in_reach(judged: &JudgedJob<'_>, washes: &mut [Wash], inputs: &ReachInputs<'_>) {
    let most_tilted = cos(judged.tilt_rad);
    for wash in washes {
        let index = wash.swept.plate;
        let Some(plate) = judged.plates().get(index) else {
            continue;
        };
        let radius_m = judged.path_radius_m(index).unwrap_or(0.0);
        let allowed_m = radius_m + outward_m(judged, index) + PATH_TOLERANCE_M;
        let spans = inputs.spans_at(wash.swept.plate);
        let cos_tilt = spans.fold(1.0, |least: f64, (i, _)| {
            least.min(inputs.tips.least_upright_cosine_of(i))
        });
        // About the axis of a face that is no disc no tilt is asked for.
        let most_tilted = if plate.surface.is_flat() { most_tilted } else { cos_tilt };
        let [tip_m, seen_m] = tip_m(allowed_m, radius_m, plate, wash, inputs);
        let reach_m = beyond_rim_m(judged, plate, tip_m, cos_tilt);
        let swept = &mut wash.swept;
        let touched = |reach_m| reached_neighbours(judged, index, reach_m);
        swept.beyond_rim_allowed_m = beyond_rim_m(judged, plate, allowed_m, cos_tilt.max(most_tilted));
        swept.beyond_rim_seen_m = beyond_rim_m(judged, plate, seen_m, cos_tilt.max(most_tilted));
        swept.beyond_rim_m = Some(reach_m).filter(|reach_m| reach_m.is_finite());
        swept.touches = swept.beyond_rim_m.map_or_else(Vec::new, touched);
    }
}

/// Returns the outward distance covered by the lines along the normal over the ends of a wash path \[m\]. It is 0 where the face does not
/// fall towards the rim.
fn outward_m(judged: &JudgedJob<'_>, plate: usize) -> f64 {
    let (Some(path), Some(plate)) = (judged.path_of(plate), judged.plates().get(plate)) else {
        return 0.0;
    };
    let ends = [0.0, path.curve.end()].map(|theta| {
        let [arc_m, ..] = path.curve.arc(theta);
        -plate.surface.at_arc(arc_m).sine
    });
    path.lift_m * ends[0].max(ends[1]).max(0.0)
}

/// Returns an upper bound on sup ‖p_xy‖ of formula (25.1), the distance of the tip from the pole of a plate, seen along its axis, in its wash and
/// in all approaches and retreats at the plate, and the greatest distance found \[m\]. The bound is infinite where nothing is proved. `radius_m`
/// is R.
fn tip_m(allowed_m: f64, radius_m: f64, plate: &Plate, wash: &Wash, inputs: &ReachInputs<'_>) -> [f64; 2] {
    let along_path_m = (inputs.path_deviation_m).map_or(f64::INFINITY, |off_m| radius_m + PLACE_M + off_m);
    let tips = inputs.spans_at(wash.swept.plate).map(|(i, span)| match span.kind {
        // The wash of another entry.
        SegmentKind::Wash if i != wash.span => [0.0; 2],
        SegmentKind::Wash => [wash.tip_m.min(along_path_m), wash.seen_m],
        _ => {
            let pieces = &inputs.pieces[span.pieces.clone()];
            let line = Polyline::new(inputs.arm, pieces, &Face::new(plate), allowed_m, LINE_HALVINGS);
            [line.within_m, line.seen_m]
        }
    });
    // NaN must not get lost.
    let greater = |most: f64, tip: f64| if tip.is_nan() { f64::INFINITY } else { most.max(tip) };
    tips.fold([0.0; 2], |[most, seen], [tip, there]| {
        [greater(most, tip), seen.max(there)]
    })
}

/// Checks that the sponge reaches no farther beyond any rim than its wash path and its own radius imply.
pub(crate) fn check(judged: &JudgedJob<'_>, coverage: &[PlateCoverage]) -> Check {
    if coverage.iter().any(|c| judged.path_of(c.plate).is_none()) {
        return Check::not_judged(Requirement::Reach);
    }
    let excess = |c: &PlateCoverage| c.beyond_rim_m.unwrap_or(f64::INFINITY) - c.beyond_rim_allowed_m;
    let Some(worst) = coverage.iter().max_by(|a, b| excess(a).total_cmp(&excess(b))) else {
        return Check::not_judged(Requirement::Reach);
    };
    let bounds = [worst.beyond_rim_m, Some(worst.beyond_rim_seen_m)];
    let measure = Measure::new(Sense::AtMost, worst.beyond_rim_allowed_m, Unit::Metre, bounds);
    Check::measured(Requirement::Reach, measure, WorstCase::on_plate(worst.plate))
}

/// Returns an upper bound on the reach of the sponge beyond the rim of a plate, at the height of its face \[m\], formula (25.1). `tip_m` is
/// sup ‖p_xy‖, `cos_tilt` is a lower bound on cos τ; without one the result is infinite. For a tip at a depth d below the face, the side wall at
/// the face is d tan τ farther out: other requirements keep d within the tolerance of the lines, 1 mm.
///
/// On a face that is no disc, τ is the angle between the tool's axis and the plate's, and all heights up to the highest one of the face
/// count. With the tip at a distance ρ from the plate's axis, the side wall reaches (top − f(ρ)) tan τ farther. That grows with ρ more
/// slowly than ρ falls short as long as the slope β keeps tan β tan τ ≤ 1. Beyond the rim nothing compresses the sponge: its face lies c
/// beyond the tip there, and reaches no more than s cos τ + c sin τ to the side.
pub(crate) fn beyond_rim_m(judged: &JudgedJob<'_>, plate: &Plate, tip_m: f64, cos_tilt: f64) -> f64 {
    if cos_tilt > 0.0 {
        let sine = (1.0 - cos_tilt * cos_tilt).max(0.0).sqrt();
        let level_m = (judged.sponge_m() + LINE_TOLERANCE_M * sine) / cos_tilt;
        tip_m + raised_m(judged, plate, tip_m, [sine, cos_tilt], level_m) - plate.rim_m()
    } else {
        f64::INFINITY
    }
}

/// Returns the reach of the sponge from the tip at the heights of a face \[m\]. `level_m` is the reach at the height of the tip,
/// (s + 1 mm sin τ) / cos τ of formula (25.1); `sine` and `cosine` are bounds of sin τ and cos τ.
fn raised_m(judged: &JudgedJob<'_>, plate: &Plate, tip_m: f64, [sine, cosine]: [f64; 2], level_m: f64) -> f64 {
    let surface = &plate.surface;
    if surface.is_flat() {
        return level_m;
    }
    let [_, top_m] = surface.height_bounds_m();
    let patch = surface.patch([0.0, tip_m.max(plate.rim_m())]);
    let steepest = patch.sine[1].max(0.0) / patch.least_cosine();
    if !(tip_m.is_finite() && steepest * sine <= cosine) {
        return f64::INFINITY;
    }
    let wall_m = level_m + (top_m - surface.height_m(tip_m)).max(0.0) * sine / cosine;
    let free_m = judged.sponge_m() * cosine + judged.job.workcell.tool.sponge.compression_m * sine;
    wall_m.max(free_m)
}

/// Returns the plates beside `plate` and no higher ([`Plate::may_touch_beside`]) that a sponge reaches if it gets `beyond_rim_m` beyond the
/// rim of `plate`, in order.
pub(crate) fn reached_neighbours(judged: &JudgedJob<'_>, plate: usize, beyond_rim_m: f64) -> Vec<ReachedNeighbour> {
    let Some(own) = judged.plates().get(plate) else {
        return Vec::new();
    };
    let others = judged.plates().iter().enumerate();
    let others = others.filter(|(index, other)| *index != plate && own.may_touch_beside(other));
    let depths = others.map(|(plate, other)| ReachedNeighbour {
        plate,
        depth_m: beyond_rim_m - own.gap_beside_m(other),
    });
    depths.filter(|touched| touched.depth_m > 0.0).collect()
}

/// True if the sponge, at any tilt, may come nearer to `plate` than the clearance while it works on `working_on`: formula (24.1). It keeps clear of
/// a plate whose face is higher, that stands at an angle, or that lies under the one it works on, except the other face of the same disc.
/// The contact speed and the reach beyond the rim are bounded at the height of the plate being worked on and below.
pub(crate) fn is_within_reach(judged: &JudgedJob<'_>, working_on: usize, plate: usize) -> bool {
    let (Some(own), Some(other)) = (judged.plates().get(working_on), judged.plates().get(plate)) else {
        return false;
    };
    let Some(radius_m) = judged.path_radius_m(working_on) else {
        return false;
    };
    if own.is_back_of(other) {
        return true;
    }
    if !own.may_touch_beside(other) {
        return false;
    }
    // No point of the sponge is farther from the tip.
    let sponge = &judged.job.workcell.tool.sponge;
    let sponge_m = norm(sponge.radius_m, sponge.height_m);
    let reach_m = radius_m + LINE_TOLERANCE_M + sponge_m + judged.job.requirements.clearance_m;
    own.aside_m(other) - other.outer_m() <= reach_m
}

/// Plates that are swept besides the plate being washed.
#[derive(Debug, Default)]
pub(crate) struct SweptNeighbours {
    /// Plates that lie apart from the one being washed.
    pub apart: Vec<Discrepancy>,
    /// Plates that overlap it.
    pub overlapping: Vec<Discrepancy>,
}

/// Finds plates of which more than the rim may be swept while another one is washed, formula (8.1). The tilt of the tool is limited by its own
/// requirement. On a face that is no disc that tilt is about the normal; `upright_cosine` then gives the bound proved about the plate's
/// axis.
pub(crate) fn swept(judged: &JudgedJob<'_>, upright_cosine: impl Fn(usize) -> f64) -> SweptNeighbours {
    let tilted_m = judged.sponge_m() / cos(judged.tilt_rad);
    let mut swept = SweptNeighbours::default();
    for (i, own) in judged.plates().iter().enumerate() {
        // Without a path it is not washed at all.
        let Some(radius_m) = judged.path_radius_m(i) else {
            continue;
        };
        let (sponge_m, beyond_m) = if own.surface.is_flat() {
            (tilted_m, radius_m + tilted_m - own.rim_m())
        } else {
            let cosine = upright_cosine(i);
            (judged.sponge_m() / cosine, beyond_rim_m(judged, own, radius_m, cosine))
        };
        // The sponge keeps clear of a plate at an angle to it, or all under or over it.
        let beside = |other: &Plate| own.is_parallel(other) && !own.is_over(other) && !other.is_over(own);
        let others = judged.plates().iter().enumerate();
        for (j, other) in others.filter(|(j, other)| *j != i && beside(other)) {
            let (gap_m, most_m) = (own.gap_beside_m(other), sponge_m.min(other.rim_m()));
            let depth_m = (beyond_m - gap_m).min(2.0 * other.rim_m());
            if depth_m <= most_m + PLACE_M {
                continue;
            }
            let list = if gap_m < -PLACE_M {
                &mut swept.overlapping
            } else {
                &mut swept.apart
            };
            list.push(Discrepancy::new(
                format!("{} while {} is washed", plate_name(j), plate_name(i)),
                format!("swept as far as {} over its rim", millimetres(depth_m)),
                format!("at most its rim, {}", millimetres(most_m)),
            ));
        }
    }
    swept
}
