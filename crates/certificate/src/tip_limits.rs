//! Speed and acceleration of the tip, tilt of the tool and height of the contact.

use crate::bound_tracker::BoundTracker;
use crate::check::{Check, Measure, Sense, Unit, Worst};
use crate::face::Face;
use crate::piece::Piece;
use crate::requirement::Requirement;
use crate::schedule::{Schedule, Span, is_at_plate};
use crate::subject::Subject;
use crate::tip::{Arm, Moment, Stretch};
use platewash_kinematics::trig::{asin, sin};
use platewash_workcell::job::PATH_TOLERANCE_M;
use platewash_workcell::segment::SegmentKind;

/// How far a bound of the tip's speed or acceleration may be above the worst value found, as a part of the limit.
const RESOLUTION: f64 = 2e-3;

/// The same for the sine of the tilt.
const TILT_RESOLUTION: f64 = 2e-4;

/// By how much an angle between two directions may be wrong where it is small \[rad\].
const TILT_ROUNDING_RAD: f64 = 1e-8;

/// The same for the height of the contact \[m\].
const HEIGHT_RESOLUTION_M: f64 = 5e-6;

/// What is tracked of the tip.
pub(crate) struct Tips {
    /// Speed and acceleration while the tip does not wash.
    pub moving: [BoundTracker; 2],
    /// Speed and acceleration while it washes.
    pub washing: [BoundTracker; 2],
    /// Sine of the tilt, for every span at a plate: its index and the tracker.
    pub tilt: Vec<(usize, BoundTracker)>,
    /// Height of the tip over or under the face while it washes, and the index of the span.
    pub height: Vec<(usize, BoundTracker)>,
}

impl Tips {
    /// Bounds everything. Without a schedule the whole motion counts as not washing.
    pub fn new(arm: &Arm<'_>, subject: &Subject<'_>, pieces: &[Piece], schedule: Option<&Schedule>) -> Self {
        let limits = &subject.limits;
        let pair = |speed: f64, acceleration: f64| {
            [speed, acceleration].map(|limit| BoundTracker::new(limit, RESOLUTION * limit))
        };
        let mut tips = Self {
            moving: pair(limits.tip_speed_m_s, limits.tip_acceleration_m_s2),
            washing: pair(limits.wash_speed_m_s, limits.wash_acceleration_m_s2),
            tilt: Vec::new(),
            height: Vec::new(),
        };
        let Some(schedule) = schedule else {
            track_rates(arm, &mut tips.moving, &[pieces]);
            return tips;
        };
        let of = |span: &Span| &pieces[span.pieces.clone()];
        let (washing, moving): (Vec<_>, Vec<_>) = schedule.spans.iter().partition(|s| s.kind == SegmentKind::Wash);
        track_rates(arm, &mut tips.moving, &moving.into_iter().map(of).collect::<Vec<_>>());
        track_rates(arm, &mut tips.washing, &washing.into_iter().map(of).collect::<Vec<_>>());
        let sine = sin(limits.tilt_rad + TILT_ROUNDING_RAD);
        for (i, span) in schedule.spans.iter().enumerate().filter(|(_, s)| is_at_plate(s.kind)) {
            let Some(plate) = subject.plates().get(span.plate) else {
                continue;
            };
            let face = Face::of(plate);
            let mut tracker = BoundTracker::new(sine, TILT_RESOLUTION);
            let bend = |s: &Stretch<'_>| s.sag(arm.derivatives(s).second_of_axis());
            observe(arm, &mut tracker, &[of(span)], &|m| face.sine_of_tilt(&m.axis), &bend);
            tips.tilt.push((i, tracker));
            if span.kind == SegmentKind::Wash {
                // The sponge touches where the tip is on the face.
                let mut tracker = BoundTracker::new(PATH_TOLERANCE_M, HEIGHT_RESOLUTION_M);
                let bend = |s: &Stretch<'_>| s.sag(arm.derivatives(s).second());
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

    /// What cos τ is not below during a span; 0 where nothing is known.
    pub fn least_cosine_of(&self, span: usize) -> f64 {
        let tilt = self.tilt.iter().find(|(index, _)| *index == span);
        tilt.map_or(0.0, |(_, tracker)| cosine(tracker.bound))
    }

    /// Speed and acceleration while the tip does not wash.
    pub fn moving_checks(&self, subject: &Subject<'_>, pieces: &[Piece], schedule: Option<&Schedule>) -> [Check; 2] {
        let (limits, [speed, acceleration]) = (&subject.limits, &self.moving);
        let at = |tracker: &BoundTracker| worst(tracker, pieces, schedule);
        let (speed_limit, acceleration_limit) = (
            (limits.tip_speed_m_s, Unit::MetrePerSecond),
            (limits.tip_acceleration_m_s2, Unit::MetrePerSecondSquared),
        );
        [
            check(Requirement::TipSpeed, speed, speed_limit, at(speed)),
            check(
                Requirement::TipAcceleration,
                acceleration,
                acceleration_limit,
                at(acceleration),
            ),
        ]
    }

    /// The requirements about all of them.
    pub fn checks(&self, subject: &Subject<'_>, pieces: &[Piece], schedule: Option<&Schedule>) -> Vec<Check> {
        let limits = &subject.limits;
        let (m_s, m_s2) = (Unit::MetrePerSecond, Unit::MetrePerSecondSquared);
        let at = |tracker: &BoundTracker| worst(tracker, pieces, schedule);
        let mut all = Vec::from(self.moving_checks(subject, pieces, schedule));
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
        let [speed, acceleration] = &self.washing;
        all.push(check(
            Requirement::WashSpeed,
            speed,
            (limits.wash_speed_m_s, m_s),
            at(speed),
        ));
        all.push(check(
            Requirement::WashAcceleration,
            acceleration,
            (limits.wash_acceleration_m_s2, m_s2),
            at(acceleration),
        ));
        let tilt = greatest(&self.tilt);
        let angle = tilt.through(angle);
        let place = |tracker: &BoundTracker| in_segment(tracker, pieces, schedule);
        all.push(check(
            Requirement::Tilt,
            &angle,
            (limits.tilt_rad + TILT_ROUNDING_RAD, Unit::Radian),
            place(&tilt),
        ));
        let height = greatest(&self.height);
        let limit = (PATH_TOLERANCE_M, Unit::Metre);
        all.push(check(Requirement::ContactHeight, &height, limit, place(&height)));
        all
    }
}

/// The requirement that a tracked quantity stays at or below its limit.
pub(crate) fn check(
    requirement: Requirement,
    tracker: &BoundTracker,
    (limit, unit): (f64, Unit),
    worst: Worst,
) -> Check {
    let finite = |v: f64| Some(v).filter(|v| v.is_finite());
    let measure = Measure {
        bound: finite(tracker.bound),
        seen: finite(tracker.seen),
        limit,
        sense: Sense::AtMost,
        unit,
    };
    Check::measured(requirement, measure, worst)
}

/// Where a tracked quantity is worst.
pub(crate) fn worst(tracker: &BoundTracker, pieces: &[Piece], schedule: Option<&Schedule>) -> Worst {
    match schedule {
        Some(schedule) => in_segment(tracker, pieces, schedule),
        None => Worst {
            time_s: Some(tracker.time_s),
            place_m: Some(tracker.place),
            ..Worst::default()
        },
    }
}

fn in_segment(tracker: &BoundTracker, pieces: &[Piece], schedule: &Schedule) -> Worst {
    let segment = schedule.segment_at(pieces, tracker.time_s);
    Worst {
        time_s: Some(tracker.time_s),
        place_m: Some(tracker.place),
        plate: segment.and_then(|(i, _)| schedule.spans.get(i)).map(|s| s.plate),
        segment,
        ..Worst::default()
    }
}

/// The worst of several trackers, with the greatest bound of all.
pub(crate) fn greatest(trackers: &[(usize, BoundTracker)]) -> BoundTracker {
    let nothing = BoundTracker::new(0.0, 0.0);
    trackers.iter().fold(nothing, |all, (_, tracker)| all.and(tracker))
}

/// The angle of a sine \[rad\]; π for what is no sine of an angle below a right one.
fn angle(sine: f64) -> f64 {
    if sine <= 1.0 { asin(sine) } else { std::f64::consts::PI }
}

/// cos τ from a bound of sin τ; 0 where the bound says nothing.
fn cosine(sine: f64) -> f64 {
    if sine >= 0.0 {
        (1.0 - sine * sine).max(0.0).sqrt()
    } else {
        0.0
    }
}

fn track_rates(arm: &Arm<'_>, [speed, acceleration]: &mut [BoundTracker; 2], spans: &[&[Piece]]) {
    observe(arm, speed, spans, &|m| m.speed.norm(), &|s| {
        s.sag(arm.derivatives(s).third())
    });
    // In short pieces the joints' accelerations at the ends round by more than other things do.
    observe(arm, acceleration, spans, &|m| m.acceleration.norm(), &|s| {
        let derivatives = arm.derivatives(s);
        s.sag(derivatives.fourth()) + derivatives.rounding(&s.piece.rounding().acceleration)
    });
}

fn observe(
    arm: &Arm<'_>,
    tracker: &mut BoundTracker,
    spans: &[&[Piece]],
    value: &impl Fn(&Moment) -> f64,
    beyond: &impl Fn(&Stretch<'_>) -> f64,
) {
    let pieces = || spans.iter().flat_map(|pieces| pieces.iter());
    tracker.allow_for(pieces().count());
    pieces().for_each(|piece| tracker.see_ends(&arm.stretch(piece), value));
    pieces().for_each(|piece| tracker.refine(arm, &arm.stretch(piece), value, beyond));
}
