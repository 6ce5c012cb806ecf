//! Moments of a wash, bounds of the motion between two of them, and the amounts wanted at a place.
//!
//! The amounts that one point of a plate gets from a wash are measured here, not bounded.

use crate::contact::{Foundation, SpongePose};
use nalgebra::Vector3;

/// Moment of a wash, in the frame of the plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Time \[s\].
    pub t_s: f64,
    /// Pose of the sponge.
    pub pose: SpongePose,
    /// Velocity of the tip \[m/s\].
    pub speed: Vector3<f64>,
    /// Angular velocity ω of the sponge \[rad/s\].
    pub turning: Vector3<f64>,
}

/// Upper bounds on the motion of a sponge over a stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// Length h of the stretch \[s\].
    pub length_s: f64,
    /// Speed of the tip \[m/s\].
    pub tip_m_s: f64,
    /// Acceleration of the tip \[m/s²\].
    pub tip_m_s2: f64,
    /// Angular speed ω of the tool \[rad/s\].
    pub turning: f64,
    /// Rate of change of the axis, a unit vector \[1/s\].
    pub axis: f64,
    /// Second derivative of any unit vector that turns with the tool \[1/s²\].
    pub bending: f64,
}

impl Drift {
    /// Motion of a sponge at rest.
    pub const NONE: Self = Self {
        length_s: 0.0,
        tip_m_s: 0.0,
        tip_m_s2: 0.0,
        turning: 0.0,
        axis: 0.0,
        bending: 0.0,
    };

    /// Bounds the motion over a stretch and the one after it together.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            length_s: self.length_s + next.length_s,
            tip_m_s: self.tip_m_s.max(next.tip_m_s),
            tip_m_s2: self.tip_m_s2.max(next.tip_m_s2),
            turning: self.turning.max(next.turning),
            axis: self.axis.max(next.axis),
            bending: self.bending.max(next.bending),
        }
    }
}

/// Amounts wanted at a place of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactThresholds {
    /// Least compression of the foam that counts as contact \[m\].
    pub compression_m: f64,
    /// Height error of a plate along its axis \[m\].
    pub height_error_m: f64,
    /// Least time in contact \[s\].
    pub time_s: f64,
    /// Least dose ∫ p dl in contact, for the least stiffness \[Pa·m\].
    pub dose_pa_m: f64,
}

/// Amounts that a place gets, with the plate at the height where it gets the least.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dwell {
    /// Greatest compression over all moments \[m\].
    pub compression_m: f64,
    /// Time in contact \[s\].
    pub time_s: f64,
    /// Dose in contact \[Pa·m\].
    pub dose_pa_m: f64,
}

/// Returns the part of [0, 1] on which the line through two values is not below 0.
#[must_use]
pub fn at_least_0([from, to]: [f64; 2]) -> Option<[f64; 2]> {
    let crossing = from / (from - to);
    match (from >= 0.0, to >= 0.0) {
        (true, true) => Some([0.0, 1.0]),
        (true, false) => Some([0.0, crossing]),
        (false, true) => Some([crossing, 1.0]),
        (false, false) => None,
    }
}

/// Intersection of two ranges; `None` if it has no length.
#[must_use]
pub fn both([a, b]: [f64; 2], [c, d]: [f64; 2]) -> Option<[f64; 2]> {
    let common = [a.max(c), b.min(d)];
    (common[0] < common[1]).then_some(common)
}

/// Measures the amounts that single points of a face get through some moments in order, with linear interpolation between them. The plate
/// is at the height where a point gets the least.
#[derive(Debug, Clone)]
pub struct ContactSampler<'a> {
    foundation: &'a Foundation,
    moments: &'a [Moment],
    thresholds: &'a ContactThresholds,
    /// Longest distance of the tip between two moments \[m\].
    stride_m: f64,
}

/// State of a point at a moment.
#[derive(Clone, Copy)]
struct Instant {
    index: usize,
    compression_m: f64,
    /// Depth within the sponge's rim \[m\]; negative outside.
    inside_m: f64,
    /// Sliding speed of the sponge over it \[m/s\].
    slide_m_s: f64,
}

impl<'a> ContactSampler<'a> {
    /// Prepares the moments of a wash.
    #[must_use]
    pub fn new(foundation: &'a Foundation, moments: &'a [Moment], thresholds: &'a ContactThresholds) -> Self {
        let strides = moments
            .windows(2)
            .map(|ends| (ends[1].pose.tip - ends[0].pose.tip).norm());
        Self {
            foundation,
            moments,
            thresholds,
            stride_m: strides.fold(1e-9, f64::max),
        }
    }

    /// Returns the amounts at a point \[m\], plate frame.
    #[must_use]
    pub fn at(&self, point: &Vector3<f64>) -> Dwell {
        let mut dwell = Dwell {
            compression_m: f64::NEG_INFINITY,
            ..Dwell::default()
        };
        self.pass(point, |before, here| {
            if here.inside_m >= 0.0 {
                dwell.compression_m = dwell.compression_m.max(here.compression_m);
            }
            if let Some(before) = before {
                self.add_between(&mut dwell, [before, here]);
            }
        });
        dwell
    }

    /// Returns the intervals in which a point is in contact \[s\], plate frame, in the order of the moments.
    #[must_use]
    pub fn contact_intervals(&self, point: &Vector3<f64>) -> Vec<[f64; 2]> {
        let mut stays: Vec<[f64; 2]> = Vec::new();
        self.pass(point, |before, here| {
            let Some(ends) = before.map(|before| [before, here]) else {
                return;
            };
            let Some(shares) = self.in_contact(ends) else { return };
            let [first, last] = ends.map(|end| self.moments[end.index].t_s);
            let [from, to] = shares.map(|share| first + (last - first) * share);
            match stays.last_mut() {
                // A stay to the end of one interval continues from the start of the next.
                Some(stay) if stay[1] == from => stay[1] = to,
                _ => stays.push([from, to]),
            }
        });
        stays
    }

    /// Visits the moments that are near enough to a point, each with the one before it if that is near enough, too.
    fn pass(&self, point: &Vector3<f64>, mut at: impl FnMut(Option<&Instant>, &Instant)) {
        // One moment more on either side.
        let reach_m = self.foundation.radius_m + self.foundation.free_height_m + self.stride_m;
        let mut before: Option<Instant> = None;
        let mut index = 0;
        while let Some(moment) = self.moments.get(index) {
            let far_m = (point - moment.pose.tip).norm();
            if far_m > reach_m + self.stride_m {
                // No moment before that one is near enough.
                index += ((far_m - reach_m) / self.stride_m) as usize;
                continue;
            }
            let here = self.instant(index, moment, point);
            at(before.as_ref().filter(|before| before.index + 1 == index), &here);
            before = Some(here);
            index += 1;
        }
    }

    fn instant(&self, index: usize, moment: &Moment, point: &Vector3<f64>) -> Instant {
        let SpongePose { tip, axis } = &moment.pose;
        let (away, error_m) = (point - tip, self.thresholds.height_error_m);
        let along = away.dot(axis);
        let slide = moment.speed + moment.turning.cross(&away);
        let aside_m = (away.norm_squared() - along * along).max(0.0).sqrt() + error_m * axis.xy().norm();
        Instant {
            index,
            compression_m: self.foundation.compression_m - along - error_m * axis.z.abs(),
            inside_m: self.foundation.radius_m - aside_m,
            slide_m_s: (slide - axis * slide.dot(axis)).norm(),
        }
    }

    /// Returns the part of the time between two moments in which a point is in contact; `None` if it is not.
    fn in_contact(&self, ends: [&Instant; 2]) -> Option<[f64; 2]> {
        let pressed = ends.map(|end| end.compression_m - self.thresholds.compression_m);
        let inside = ends.map(|end| end.inside_m);
        both(at_least_0(pressed)?, at_least_0(inside)?)
    }

    /// Adds time and dose between two moments.
    fn add_between(&self, dwell: &mut Dwell, ends: [&Instant; 2]) {
        let Some([from, to]) = self.in_contact(ends) else {
            return;
        };
        let [first, last] = ends.map(|end| self.moments[end.index].t_s);
        let along_s = (to - from) * (last - first);
        let middle = 0.5 * (from + to);
        let mean = |of: fn(&Instant) -> f64| of(ends[0]) + (of(ends[1]) - of(ends[0])) * middle;
        let pressure_pa =
            self.foundation.stiffness_pa[0] / self.foundation.free_height_m * mean(|end| end.compression_m);
        dwell.time_s += along_s;
        dwell.dose_pa_m += pressure_pa * mean(|end| end.slide_m_s) * along_s;
    }
}
