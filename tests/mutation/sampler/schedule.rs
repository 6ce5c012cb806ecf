//! Whether the segments say what every moment is for, and which moment belongs to which.

use super::hermite::Piece;
use platewash::Plan;
use platewash::workcell::trajectory::{PlanSegment, SegmentKind};
use platewash::workcell::wash_path::WashPath;
use std::f64::consts::{PI, TAU};

/// Whether the segments cover the motion from knot to knot, and their kinds and plates are those of a job that washes in the
/// plan's order.
pub fn is_sound(plan: &Plan) -> bool {
    let found: Vec<_> = plan.segments.iter().map(|s| (s.kind, s.plate)).collect();
    follows(&found, &plan.order) && covers(plan)
}

fn follows(list: &[(SegmentKind, usize)], order: &[usize]) -> bool {
    let last = 4 * order.len();
    list.len() == last + 1
        && list.iter().enumerate().all(|(i, (kind, plate))| {
            let expected = match (i, i % 4) {
                (0, _) => SegmentKind::Depart,
                (i, _) if i == last => return *kind == SegmentKind::Return && order.last() == Some(plate),
                (_, 0) => SegmentKind::Transit,
                (_, 1) => SegmentKind::Approach,
                (_, 2) => SegmentKind::Wash,
                _ => SegmentKind::Retreat,
            };
            *kind == expected && *plate == order[i / 4]
        })
}

fn covers(plan: &Plan) -> bool {
    let times = &plan.knots.t_s;
    let mut reached = times[0];
    let mut connected = |s: &PlanSegment| {
        let fits = s.t_start_s == reached && s.t_end_s > reached && times.contains(&s.t_end_s);
        reached = s.t_end_s;
        fits
    };
    plan.segments.iter().all(&mut connected) && reached == times[times.len() - 1]
}

/// Index of the segment in which the middle of a piece lies, for segments that are sound.
pub fn segment_of(plan: &Plan, piece: &Piece) -> usize {
    let middle = piece.start_s + 0.5 * piece.length_s;
    let after = plan.segments.partition_point(|s| s.t_end_s <= middle);
    after.min(plan.segments.len() - 1)
}

/// Whether the tip is on a plate, or on its normal.
pub fn is_at_plate(kind: SegmentKind) -> bool {
    use SegmentKind::{Approach, Retreat, Wash};
    matches!(kind, Approach | Wash | Retreat)
}

/// How a plate is washed; `None` where the plan does not say, or says what is no path.
pub fn path_of(plan: &Plan, plate: usize) -> Option<&WashPath> {
    let path = plan.wash_paths.iter().find(|path| path.plate == plate)?;
    let curve = &path.curve;
    let within = [
        (curve.radius_m, 1e-4, 10.0),
        (curve.turns, 0.25, 200.0),
        (curve.start_angle_rad, -TAU, TAU),
        (PI * curve.radius_m * (curve.turns + 2.0), 0.0, 100.0),
        (path.lift_m, 1e-300, 10.0),
        (path.cone_rad, 0.0, most_tilt_rad(plan)),
    ];
    let sound = within
        .iter()
        .all(|(found, least, most)| found >= least && found <= most);
    (sound && plate < plan.job.plates.len()).then_some(path)
}

/// How far the tool may tilt \[rad\]: as the job allows, and no more than the narrowest cone that a path states.
pub fn tilt_limit_rad(plan: &Plan) -> f64 {
    let paths = (0..plan.job.plates.len()).filter_map(|plate| path_of(plan, plate));
    let cones = paths.map(|path| path.cone_rad);
    cones.fold(most_tilt_rad(plan), f64::min)
}

/// How far the job allows the tool to tilt \[rad\].
fn most_tilt_rad(plan: &Plan) -> f64 {
    let sponge = &plan.job.workcell.tool.sponge;
    // Beyond this the rim where the handle holds the sponge would have to go through the plate.
    let gives_way = (sponge.height_m / sponge.radius_m).atan();
    plan.job.requirements.tilt_rad.min(gives_way)
}
