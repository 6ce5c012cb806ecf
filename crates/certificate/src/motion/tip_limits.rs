//! Limits of the tip: speed, acceleration, tilt of the tool, and contact height.
//!
//! Requirements 15–20, formulas (15.1) to (20.1) in `docs/certificate.md`.

use crate::judged_job::JudgedJob;
use crate::motion::bound_tracker::BoundTracker;
use crate::motion::piece::Piece;
use crate::motion::tip::{Arm, Moment, Stretch, TipPiece};
use crate::plan_statements::schedule::{Schedule, Span};
use crate::report::check::{Check, Measure, Sense, WorstCase, finite, tighter};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::face::{Face, Pass, sine_of_tilt};
use nalgebra::Vector3;
use platewash_kinematics::trig::{asin, sin};
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::job::PATH_TOLERANCE_M;

/// Gap allowed between a bound of the tip's speed or acceleration and the worst value found, as a part of the limit.
const RESOLUTION: f64 = 2e-3;

/// Gap allowed for the sine of the tilt.
const TILT_RESOLUTION: f64 = 2e-4;

/// Error of a small angle between two directions \[rad\].
const TILT_ROUNDING_RAD: f64 = 1e-8;

/// Gap allowed for the contact height \[m\].
const HEIGHT_RESOLUTION_M: f64 = 5e-6;

/// Trackers of the tip's quantities.
pub(crate) struct Tips {
    /// Speed and acceleration while the tip does not wash.
    pub moving: [BoundTracker; 2],
    /// Speed and acceleration while it washes, by the limit of the speed \[m/s\].
    washing: Vec<(f64, [BoundTracker; 2])>,
    /// Sine of the tilt for every span at a plate, by the span's index.
    pub tilt: Vec<(usize, BoundTracker)>,
    /// Sine of the angle from the plate's axis for every span at a plate whose face is no disc, by the span's index. On a disc it is that
    /// of the tilt.
    upright: Vec<(usize, BoundTracker)>,
    /// Height of the tip over or under the face for every wash, by the span's index.
    pub height: Vec<(usize, BoundTracker)>,
}

/// Normal against which the tilt is measured.
#[derive(Debug, Clone, Copy)]
enum TiltNormal {
    /// A constant normal: that of the line of an approach or retreat, or of a flat face.
    Fixed(Vector3<f64>),
    /// The normal of the face under the tip.
    Local,
}

impl Tips {
    /// Bounds all quantities, formulas (15.1) to (20.1). Without a schedule the whole motion counts as not washing.
    pub fn new(arm: &Arm<'_>, judged: &JudgedJob<'_>, pieces: &[TipPiece<'_>], schedule: Option<&Schedule>) -> Self {
        let (job, limits) = (judged.job, &judged.job.limits);
        let pair = |speed: f64, acceleration: f64| {
            [speed, acceleration].map(|limit| BoundTracker::new(limit, RESOLUTION * limit))
        };
        let mut tips = Self {
            moving: pair(limits.tip_speed_m_s, limits.tip_acceleration_m_s2),
            washing: Vec::new(),
            tilt: Vec::new(),
            upright: Vec::new(),
            height: Vec::new(),
        };
        let Some(schedule) = schedule else {
            track_rates(arm, &mut tips.moving, &[pieces]);
            return tips;
        };
        let of = |span: &Span| &pieces[span.pieces.clone()];
        let (washing, moving): (Vec<_>, Vec<_>) = schedule.spans.iter().partition(|s| s.kind == SegmentKind::Wash);
        track_rates(arm, &mut tips.moving, &moving.into_iter().map(of).collect::<Vec<_>>());
        // The washes of plates with the same limit of speed are tracked together.
        let limit = |span: &Span| {
            judged
                .plates()
                .get(span.plate)
                .map(|plate| judged.job.wash_speed_of(plate))
        };
        let mut of_limit: Vec<(f64, Vec<&[TipPiece<'_>]>)> = Vec::new();
        if washing.is_empty() {
            of_limit.push((job.wash_speed_m_s(), Vec::new()));
        }
        for span in washing {
            let own = limit(span).unwrap_or(job.wash_speed_m_s());
            match of_limit.iter_mut().find(|(other, _)| *other == own) {
                Some((_, pieces)) => pieces.push(of(span)),
                None => of_limit.push((own, vec![of(span)])),
            }
        }
        for (limit, pieces) in of_limit {
            let mut rates = pair(limit, job.wash_acceleration_m_s2());
            track_rates(arm, &mut rates, &pieces);
            tips.washing.push((limit, rates));
        }
        let sine = sin(judged.tilt_rad + TILT_ROUNDING_RAD);
        for (i, span) in schedule.spans.iter().enumerate().filter(|(_, s)| s.kind.is_at_plate()) {
            let Some(plate) = judged.plates().get(span.plate) else {
                continue;
            };
            let face = Face::new(plate);
            let against = against(judged, span, &face);
            let tracker = BoundTracker::new(sine, TILT_RESOLUTION);
            tips.tilt.push((i, tilted(arm, tracker, of(span), &face, against)));
            if !face.surface().is_flat() {
                // No limit is asked of it.
                let tracker = BoundTracker::new(1.0, TILT_RESOLUTION);
                let upright = TiltNormal::Fixed(*face.plate_axis());
                tips.upright.push((i, tilted(arm, tracker, of(span), &face, upright)));
            }
            if span.kind == SegmentKind::Wash {
                // The sponge touches where the tip is on the face.
                let mut tracker = BoundTracker::new(PATH_TOLERANCE_M, HEIGHT_RESOLUTION_M);
                let bend = |s: &Stretch<'_>| {
                    let bounds = arm.derivatives(s);
                    if face.surface().is_flat() {
                        s.sag(bounds.second())
                    } else {
                        s.sag(Pass::new(&face, s, bounds).bend_of_height())
                    }
                };
                observe(
                    arm,
                    &mut tracker,
                    &[of(span)],
                    &|m| face.height_of(&m.position).abs(),
                    &bend,
                );
                tips.height.push((i, tracker));
            }
        }
        tips
    }

    /// Lower bound on cos τ during a span, from formula (19.1); 0 where nothing is known.
    pub fn least_cosine_of(&self, span: usize) -> f64 {
        let tilt = self.tilt.iter().find(|(index, _)| *index == span);
        tilt.map_or(0.0, |(_, tracker)| cosine(tracker.bound))
    }

    /// Lower bound on the cosine of the angle from the plate's axis during a span; 0 where nothing is known.
    pub fn least_upright_cosine_of(&self, span: usize) -> f64 {
        let upright = self.upright.iter().find(|(index, _)| *index == span);
        upright.map_or_else(|| self.least_cosine_of(span), |(_, tracker)| cosine(tracker.bound))
    }

    /// Upper bound on |z − f|, the height of the tip over or under the face during the wash of a span \[m\], formula (20.1); infinite where nothing
    /// is known.
    pub fn greatest_height_of(&self, span: usize) -> f64 {
        let height = self.height.iter().find(|(index, _)| *index == span);
        height.map_or(f64::INFINITY, |(_, tracker)| {
            if tracker.bound.is_nan() {
                f64::INFINITY
            } else {
                tracker.bound
            }
        })
    }

    /// Lower bound on the cosine of the angle from the plate's axis over all spans at a plate; 0 without any.
    pub fn least_upright_cosine_at(&self, schedule: &Schedule, plate: usize) -> f64 {
        let spans = schedule.spans.iter().enumerate();
        let there = spans.filter(|(_, span)| span.plate == plate && span.kind.is_at_plate());
        let cosines = there.map(|(i, _)| self.least_upright_cosine_of(i));
        cosines.min_by(f64::total_cmp).unwrap_or(0.0)
    }

    /// Checks speed and acceleration while the tip does not wash.
    pub fn moving_checks(&self, judged: &JudgedJob<'_>, pieces: &[Piece], schedule: Option<&Schedule>) -> [Check; 2] {
        let (limits, [speed, acceleration]) = (&judged.job.limits, &self.moving);
        let at = |tracker: &BoundTracker| worst_case(tracker, pieces, schedule);
        let (m_s, m_s2) = (Unit::MetrePerSecond, Unit::MetrePerSecondSquared);
        let (v, a) = (limits.tip_speed_m_s, limits.tip_acceleration_m_s2);
        [
            check(Requirement::TipSpeed, speed, v, m_s, at(speed)),
            check(Requirement::TipAcceleration, acceleration, a, m_s2, at(acceleration)),
        ]
    }

    /// Checks all requirements about the tip.
    pub fn checks(&self, judged: &JudgedJob<'_>, pieces: &[Piece], schedule: Option<&Schedule>) -> Vec<Check> {
        let (m_s, m_s2) = (Unit::MetrePerSecond, Unit::MetrePerSecondSquared);
        let at = |tracker: &BoundTracker| worst_case(tracker, pieces, schedule);
        let mut all = Vec::from(self.moving_checks(judged, pieces, schedule));
        let rest = [
            Requirement::WashSpeed,
            Requirement::WashAcceleration,
            Requirement::Tilt,
            Requirement::ContactHeight,
        ];
        let Some(schedule) = schedule else {
            all.extend(rest.map(Check::not_judged));
            return all;
        };
        let (tilt, height) = (greatest(&self.tilt), greatest(&self.height));
        let angle = tilt.through(angle);
        let place = |tracker: &BoundTracker| in_segment(tracker, pieces, schedule);
        let rates = self.washing.iter().map(|(v, [speed, acceleration])| {
            let a = judged.job.wash_acceleration_m_s2();
            [
                check(Requirement::WashSpeed, speed, *v, m_s, at(speed)),
                check(Requirement::WashAcceleration, acceleration, a, m_s2, at(acceleration)),
            ]
        });
        let rates = rates.reduce(|[v, a], [w, b]| [tighter(v, w), tighter(a, b)]);
        all.extend(rates.unwrap_or([Requirement::WashSpeed, Requirement::WashAcceleration].map(Check::not_judged)));
        let most_tilt_rad = judged.tilt_rad + TILT_ROUNDING_RAD;
        all.extend([
            check(Requirement::Tilt, &angle, most_tilt_rad, Unit::Radian, place(&tilt)),
            check(
                Requirement::ContactHeight,
                &height,
                PATH_TOLERANCE_M,
                Unit::Metre,
                place(&height),
            ),
        ]);
        all
    }
}

/// Checks that a tracked quantity stays at or below its limit.
pub(crate) fn check(
    requirement: Requirement,
    tracker: &BoundTracker,
    limit: f64,
    unit: Unit,
    worst: WorstCase,
) -> Check {
    let measure = Measure::new(Sense::AtMost, limit, unit, [tracker.bound, tracker.seen].map(finite));
    Check::measured(requirement, measure, worst)
}

/// Returns position and time of the worst value of a tracked quantity.
pub(crate) fn worst_case(tracker: &BoundTracker, pieces: &[Piece], schedule: Option<&Schedule>) -> WorstCase {
    match schedule {
        Some(schedule) => in_segment(tracker, pieces, schedule),
        None => WorstCase {
            time_s: Some(tracker.time_s),
            place_m: Some(tracker.place),
            ..WorstCase::default()
        },
    }
}

fn in_segment(tracker: &BoundTracker, pieces: &[Piece], schedule: &Schedule) -> WorstCase {
    let segment = schedule.segment_at(pieces, tracker.time_s);
    WorstCase {
        time_s: Some(tracker.time_s),
        place_m: Some(tracker.place),
        plate: segment.and_then(|(i, _)| schedule.spans.get(i)).map(|s| s.plate),
        segment,
        ..WorstCase::default()
    }
}

/// Combines several trackers: the worst value, and the greatest bound.
pub(crate) fn greatest(trackers: &[(usize, BoundTracker)]) -> BoundTracker {
    let nothing = BoundTracker::new(0.0, 0.0);
    trackers.iter().fold(nothing, |all, (_, tracker)| all.and(tracker))
}

/// Angle of a sine \[rad\]; π for a value that is not the sine of an angle below a right one.
fn angle(sine: f64) -> f64 {
    if sine <= 1.0 { asin(sine) } else { std::f64::consts::PI }
}

/// Lower bound on cos τ. `sine` is an upper bound on sin τ; the result is 0 where it says nothing.
fn cosine(sine: f64) -> f64 {
    if sine >= 0.0 {
        (1.0 - sine * sine).max(0.0).sqrt()
    } else {
        0.0
    }
}

/// Returns the normal for the tilt during a span: that of the line over the end of its path, or that of the face. Without a path there is
/// no line, and the face counts.
fn against(judged: &JudgedJob<'_>, span: &Span, face: &Face<'_>) -> TiltNormal {
    if face.surface().is_flat() {
        return TiltNormal::Fixed(*face.plate_axis());
    }
    let feet = || {
        let plate = judged.plates().get(span.plate)?;
        Some(judged.path_of(span.plate)?.feet(plate))
    };
    match (span.kind, feet()) {
        (SegmentKind::Approach, Some([start, _])) => TiltNormal::Fixed(face.normal_under(&start)),
        (SegmentKind::Retreat, Some([_, end])) => TiltNormal::Fixed(face.normal_under(&end)),
        _ => TiltNormal::Local,
    }
}

/// Bounds sin τ, the sine of the tilt, during the pieces: formula (19.1). `against` tells n.
fn tilted(
    arm: &Arm<'_>,
    mut tracker: BoundTracker,
    pieces: &[TipPiece<'_>],
    face: &Face<'_>,
    against: TiltNormal,
) -> BoundTracker {
    match against {
        TiltNormal::Fixed(normal) => {
            let bend = |s: &Stretch<'_>| s.sag(arm.derivatives(s).second_of_axis());
            observe(arm, &mut tracker, &[pieces], &|m| sine_of_tilt(&m.axis, &normal), &bend);
        }
        TiltNormal::Local => {
            let sine = |m: &Moment| sine_of_tilt(&m.axis, &face.normal_under(&m.position));
            let bend = |s: &Stretch<'_>| {
                let bounds = arm.derivatives(s);
                let second = bounds.second_of_axis();
                Pass::new(face, s, bounds).sag_of_sine(s, [turning(s, second), second])
            };
            observe(arm, &mut tracker, &[pieces], &sine, &bend);
        }
    }
    tracker
}

/// Upper bound on ‖ȧ‖, the speed of the tool's axis, over a stretch \[1/s\]: its value at the ends, and h/2 times `second`. `second` is sup ‖ä‖ of
/// formula (0.4) \[1/s²\].
pub(crate) fn turning(stretch: &Stretch<'_>, second: f64) -> f64 {
    let [from, to] = stretch.ends.map(|m| m.turning.cross(&m.axis).norm());
    from.max(to) + 0.5 * stretch.length_s() * second
}

/// Bounds the tip's speed, formula (15.1), and its acceleration, formula (16.1), over some spans.
fn track_rates(arm: &Arm<'_>, [speed, acceleration]: &mut [BoundTracker; 2], spans: &[&[TipPiece<'_>]]) {
    observe(arm, speed, spans, &|m| m.speed.norm(), &|s| {
        s.sag(arm.derivatives(s).third())
    });
    // In short pieces the joints' accelerations at the ends round by more than other things do.
    observe(arm, acceleration, spans, &|m| m.acceleration.norm(), &|s| {
        let derivatives = arm.derivatives(s);
        s.sag(derivatives.fourth()) + derivatives.rounding(&s.piece.rounding().acceleration)
    });
}

/// Bounds a quantity over some spans by formula (0.1). `value` is the quantity at a moment, `beyond` is its rise within a stretch.
fn observe(
    arm: &Arm<'_>,
    tracker: &mut BoundTracker,
    spans: &[&[TipPiece<'_>]],
    value: &impl Fn(&Moment) -> f64,
    beyond: &impl Fn(&Stretch<'_>) -> f64,
) {
    let pieces = || spans.iter().flat_map(|pieces| pieces.iter());
    tracker.allow_for(pieces().count());
    pieces().for_each(|piece| tracker.see_ends(&piece.stretch(), value));
    pieces().for_each(|piece| tracker.refine(arm, &piece.stretch(), value, beyond));
}
