//! How fast the sponge touches a plate: whatever of it touches while it comes down and while it leaves (`rim.rs`).
//!
//! Where a job states how fast it may land, or lift off, the free sponge counts: its face lies beyond the tip by its compression, and the
//! plate as much higher as it may lie. Where it states nothing, the face that the sponge has while it washes counts, and it touches no
//! faster than it washes. Stretches in which nothing touches count for nothing; the others are halved like those of every quantity
//! (`bound_tracker.rs`).

use crate::bound_tracker::BoundTracker;
use crate::check::{Check, Unit, Worst};
use crate::piece::Piece;
use crate::plate_contact::tighter;
use crate::requirement::Requirement;
use crate::rim::{FarFace, Rim};
use crate::schedule::{Schedule, Span};
use crate::subject::Subject;
use crate::tip::Arm;
use crate::tip_limits::{self, Tips};
use platewash_workcell::segment::SegmentKind;

/// How far the bound of the speed may be above the greatest one found, as a part of the limit.
const RESOLUTION: f64 = 2e-3;

/// What is asked of the segments of some kinds.
struct Asked<'a> {
    kinds: &'a [SegmentKind],
    /// \[m/s\]
    limit: f64,
    far: FarFace,
}

/// The speed of whatever of the sponge touches a plate that it comes down on or leaves.
pub(crate) fn check(
    arm: &Arm<'_>,
    subject: &Subject<'_>,
    (pieces, schedule): (&[Piece], Option<&Schedule>),
    tips: &Tips,
) -> Check {
    let Some(schedule) = schedule else {
        return Check::not_judged(Requirement::ContactSpeed);
    };
    let wanted = &subject.job.requirements;
    let judged = |asked: &Asked<'_>| judge(arm, subject, (pieces, schedule), tips, asked);
    let as_washed = FarFace {
        beyond_m: 0.0,
        error_m: 0.0,
    };
    let limit = subject.limits.wash_speed_m_s;
    if wanted.landing_m_s.is_none() && wanted.lifting_m_s.is_none() {
        return judged(&Asked {
            kinds: &[SegmentKind::Approach, SegmentKind::Retreat],
            limit,
            far: as_washed,
        });
    }
    let free = FarFace {
        beyond_m: subject.job.workcell.tool.sponge.compression_m,
        error_m: wanted.contact.map_or(0.0, |contact| contact.height_error_m),
    };
    let of = |kind, stated: Option<f64>| {
        judged(&Asked {
            kinds: &[kind],
            limit: stated.map_or(limit, |stated| stated.min(limit)),
            far: stated.map_or(as_washed, |_| free),
        })
    };
    tighter(
        of(SegmentKind::Approach, wanted.landing_m_s),
        of(SegmentKind::Retreat, wanted.lifting_m_s),
    )
}

fn judge(
    arm: &Arm<'_>,
    subject: &Subject<'_>,
    (pieces, schedule): (&[Piece], &Schedule),
    tips: &Tips,
    asked: &Asked<'_>,
) -> Check {
    let limit = asked.limit;
    let mut tracker = BoundTracker::new(limit, RESOLUTION * limit);
    let touching = |span: &Span| asked.kinds.contains(&span.kind);
    let spans = || schedule.spans.iter().enumerate().filter(|(_, span)| touching(span));
    // A plate that is not there is found elsewhere.
    let rim = |index: usize, span: &Span| {
        let plate = subject.plates().get(span.plate)?;
        let sponge = &subject.job.workcell.tool.sponge;
        Some(Rim::new(plate, sponge, asked.far, tips.least_upright_cosine_of(index)))
    };
    tracker.allow_for(spans().map(|(_, span)| span.pieces.len()).sum());
    // Nothing that touches is fast: so it is until something is seen, and for good where nothing touches.
    tracker.seen = 0.0;
    tracker.take(0.0);
    let over: Vec<_> = spans()
        .filter_map(|(i, span)| Some((rim(i, span)?, &pieces[span.pieces.clone()])))
        .collect();
    for (rim, pieces) in &over {
        look(arm, rim, pieces, &mut tracker);
    }
    for (rim, pieces) in &over {
        for piece in *pieces {
            rim.halve(arm, &arm.stretch(piece), &mut tracker, 0);
        }
    }
    let worst = if tracker.seen > 0.0 {
        tip_limits::worst(&tracker, pieces, Some(schedule))
    } else {
        Worst::default()
    };
    tip_limits::check(
        Requirement::ContactSpeed,
        &tracker,
        (limit, Unit::MetrePerSecond),
        worst,
    )
}

/// Sees both ends of all pieces.
fn look(arm: &Arm<'_>, rim: &Rim<'_>, pieces: &[Piece], tracker: &mut BoundTracker) {
    for stretch in pieces.iter().map(|piece| arm.stretch(piece)) {
        for (moment, time_s) in stretch.ends.iter().zip(stretch.times()) {
            rim.see(tracker, moment, time_s);
        }
    }
}
