//! Speed and acceleration of the tip, tilt of the tool and height of the contact.

use super::piece::Piece;
use super::promise::{Measure, Promise, PromiseName, Sense, Unit, Worst};
use super::schedule::{Schedule, Stage, is_at_plate};
use super::tip::{Arm, Moment, Stretch};
use super::watch::Watch;
use crate::plan::{Plan, PlanLimits};
use crate::tool_path::SegmentKind;

/// How far a bound of the tip's speed or acceleration may be above the worst value found, as a part of the limit.
const RESOLUTION: f64 = 2e-3;

/// The same for the sine of the tilt.
const TILT_RESOLUTION: f64 = 2e-4;

/// By how much an angle between two directions may be wrong where it is small \[rad\].
const TILT_ROUNDING_RAD: f64 = 1e-8;

/// The same for the height of the contact \[m\].
const HEIGHT_RESOLUTION_M: f64 = 5e-6;

/// What is watched of the tip: promises, and the limits' names.
pub(super) struct Tips {
    /// Speed and acceleration while the tip does not wash.
    pub moving: [Watch; 2],
    /// Speed and acceleration while it washes.
    pub washing: [Watch; 2],
    /// Sine of the tilt, for every stage at a plate: its index and the watch.
    pub tilt: Vec<(usize, Watch)>,
    /// Height of the tip over or under the plane of each stroke, and the index of its stage.
    pub height: Vec<(usize, Watch)>,
}

impl Tips {
    /// Bounds everything. Without a schedule the whole motion counts as not washing.
    pub fn new(arm: &Arm<'_>, plan: &Plan, limits: &PlanLimits, pieces: &[Piece], schedule: Option<&Schedule>) -> Self {
        let pair =
            |speed: f64, acceleration: f64| [speed, acceleration].map(|limit| Watch::new(limit, RESOLUTION * limit));
        let mut tips = Self {
            moving: pair(limits.tip_speed_m_s, limits.tip_acceleration_m_s2),
            washing: pair(limits.wash_speed_m_s, limits.wash_acceleration_m_s2),
            tilt: Vec::new(),
            height: Vec::new(),
        };
        let Some(schedule) = schedule else {
            watch_rates(arm, &mut tips.moving, &[pieces]);
            return tips;
        };
        let of = |stage: &Stage| &pieces[stage.pieces.clone()];
        let (washing, moving): (Vec<_>, Vec<_>) = schedule.stages.iter().partition(|s| s.kind == SegmentKind::Wash);
        watch_rates(arm, &mut tips.moving, &moving.into_iter().map(of).collect::<Vec<_>>());
        watch_rates(arm, &mut tips.washing, &washing.into_iter().map(of).collect::<Vec<_>>());
        let sine = crate::trig::sin(limits.tilt_rad + TILT_ROUNDING_RAD);
        for (i, stage) in schedule.stages.iter().enumerate().filter(|(_, s)| is_at_plate(s.kind)) {
            let mut watch = Watch::new(sine, TILT_RESOLUTION);
            let bend = |s: &Stretch<'_>| s.sag(arm.derivatives(s).second_of_axis());
            observe(arm, &mut watch, &[of(stage)], &sine_of_tilt, &bend);
            tips.tilt.push((i, watch));
            if let (SegmentKind::Wash, Some(plate)) = (stage.kind, plan.plates.get(stage.plate)) {
                // The sponge touches where the tip is in the plane of the plate, wherever the stroke is declared.
                let height = plate.z_m;
                let mut watch = Watch::new(crate::plan::PATH_TOLERANCE_M, HEIGHT_RESOLUTION_M);
                let bend = |s: &Stretch<'_>| s.sag(arm.derivatives(s).second());
                observe(arm, &mut watch, &[of(stage)], &|m| (m.position.z - height).abs(), &bend);
                tips.height.push((i, watch));
            }
        }
        tips
    }

    /// What cos τ is not below during a stage; 0 where nothing is known.
    pub fn least_cosine_of(&self, stage: usize) -> f64 {
        let tilt = self.tilt.iter().find(|(index, _)| *index == stage);
        tilt.map_or(0.0, |(_, watch)| cosine(watch.bound))
    }

    /// The promises about them.
    pub fn promises(&self, limits: &PlanLimits, pieces: &[Piece], schedule: Option<&Schedule>) -> Vec<Promise> {
        let [speed, acceleration] = &self.moving;
        let (m_s, m_s2) = (Unit::MetrePerSecond, Unit::MetrePerSecondSquared);
        let at = |watch: &Watch| worst(watch, pieces, schedule);
        let mut all = vec![
            promise(PromiseName::TipSpeed, speed, (limits.tip_speed_m_s, m_s), at(speed)),
            promise(
                PromiseName::TipAcceleration,
                acceleration,
                (limits.tip_acceleration_m_s2, m_s2),
                at(acceleration),
            ),
        ];
        let rest = [
            PromiseName::WashSpeed,
            PromiseName::WashAcceleration,
            PromiseName::Tilt,
            PromiseName::ContactHeight,
        ];
        let Some(schedule) = schedule else {
            all.extend(rest.map(Promise::not_judged));
            return all;
        };
        let [speed, acceleration] = &self.washing;
        all.push(promise(
            PromiseName::WashSpeed,
            speed,
            (limits.wash_speed_m_s, m_s),
            at(speed),
        ));
        all.push(promise(
            PromiseName::WashAcceleration,
            acceleration,
            (limits.wash_acceleration_m_s2, m_s2),
            at(acceleration),
        ));
        let tilt = greatest(&self.tilt);
        let angle = tilt.through(angle);
        let place = |watch: &Watch| in_segment(watch, pieces, schedule);
        all.push(promise(
            PromiseName::Tilt,
            &angle,
            (limits.tilt_rad + TILT_ROUNDING_RAD, Unit::Radian),
            place(&tilt),
        ));
        let height = greatest(&self.height);
        let limit = (crate::plan::PATH_TOLERANCE_M, Unit::Metre);
        all.push(promise(PromiseName::ContactHeight, &height, limit, place(&height)));
        all
    }
}

/// A promise that a watched quantity stays at or below its limit.
pub(super) fn promise(name: PromiseName, watch: &Watch, (limit, unit): (f64, Unit), worst: Worst) -> Promise {
    let finite = |v: f64| Some(v).filter(|v| v.is_finite());
    let measure = Measure {
        bound: finite(watch.bound),
        seen: finite(watch.seen),
        limit,
        sense: Sense::AtMost,
        unit,
    };
    Promise::measured(name, measure, worst)
}

/// Where a watched quantity is worst.
pub(super) fn worst(watch: &Watch, pieces: &[Piece], schedule: Option<&Schedule>) -> Worst {
    match schedule {
        Some(schedule) => in_segment(watch, pieces, schedule),
        None => Worst {
            time_s: Some(watch.time_s),
            place_m: Some(watch.place),
            ..Worst::default()
        },
    }
}

fn in_segment(watch: &Watch, pieces: &[Piece], schedule: &Schedule) -> Worst {
    let segment = schedule.segment_at(pieces, watch.time_s);
    Worst {
        time_s: Some(watch.time_s),
        place_m: Some(watch.place),
        plate: segment.and_then(|(i, _)| schedule.stages.get(i)).map(|s| s.plate),
        segment,
        ..Worst::default()
    }
}

/// The worst of several watches, with the greatest bound of all.
pub(super) fn greatest(watches: &[(usize, Watch)]) -> Watch {
    let nothing = Watch::new(0.0, 0.0);
    watches.iter().fold(nothing, |all, (_, watch)| all.and(watch))
}

/// Sine of the angle between the tool and straight down; 2 where it points upwards, beyond every limit.
fn sine_of_tilt(moment: &Moment) -> f64 {
    if moment.axis.z < 0.0 {
        moment.axis.xy().norm()
    } else {
        2.0
    }
}

/// The angle of a sine \[rad\]; π for what is no sine of an angle below a right one.
fn angle(sine: f64) -> f64 {
    if sine <= 1.0 {
        crate::trig::asin(sine)
    } else {
        std::f64::consts::PI
    }
}

/// cos τ from a bound of sin τ; 0 where the bound says nothing.
fn cosine(sine: f64) -> f64 {
    if sine >= 0.0 {
        (1.0 - sine * sine).max(0.0).sqrt()
    } else {
        0.0
    }
}

fn watch_rates(arm: &Arm<'_>, [speed, acceleration]: &mut [Watch; 2], stages: &[&[Piece]]) {
    observe(arm, speed, stages, &|m| m.speed.norm(), &|s| {
        s.sag(arm.derivatives(s).third())
    });
    // In short pieces the joints' accelerations at the ends round by more than other things do.
    observe(arm, acceleration, stages, &|m| m.acceleration.norm(), &|s| {
        let derivatives = arm.derivatives(s);
        s.sag(derivatives.fourth()) + derivatives.rounding(&s.piece.rounding().acceleration)
    });
}

fn observe(
    arm: &Arm<'_>,
    watch: &mut Watch,
    stages: &[&[Piece]],
    value: &impl Fn(&Moment) -> f64,
    beyond: &impl Fn(&Stretch<'_>) -> f64,
) {
    let pieces = || stages.iter().flat_map(|pieces| pieces.iter());
    watch.allow_for(pieces().count());
    pieces().for_each(|piece| watch.see_ends(&arm.stretch(piece), value));
    pieces().for_each(|piece| watch.refine(arm, &arm.stretch(piece), value, beyond));
}
