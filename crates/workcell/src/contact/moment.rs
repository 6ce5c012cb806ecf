//! Moments of a wash, what may happen between two of them, and what a place is wanted to get through them.
//!
//! What one point of a plate gets from a wash: measured, not bounded.

use crate::contact::{Foundation, SpongePose};
use nalgebra::Vector3;

/// A moment of a wash, in the frame of the plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Its time \[s\].
    pub t_s: f64,
    /// Where the sponge stands.
    pub pose: SpongePose,
    /// Speed of the tip \[m/s\].
    pub speed: Vector3<f64>,
    /// ω: how fast the sponge turns \[rad/s\].
    pub turning: Vector3<f64>,
}

/// How a sponge moves over a stretch of time, at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// h \[s\].
    pub length_s: f64,
    /// Speed of the tip \[m/s\].
    pub tip_m_s: f64,
    /// Its acceleration \[m/s²\].
    pub tip_m_s2: f64,
    /// ω: how fast the tool turns \[rad/s\].
    pub turning: f64,
    /// How fast the axis turns \[1/s\].
    pub axis: f64,
    /// The second derivative of any direction that turns with the tool \[1/s²\].
    pub bending: f64,
}

impl Drift {
    /// Of a sponge that does not move.
    pub const NONE: Self = Self {
        length_s: 0.0,
        tip_m_s: 0.0,
        tip_m_s2: 0.0,
        turning: 0.0,
        axis: 0.0,
        bending: 0.0,
    };

    /// That of a stretch and of the one after it together.
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

/// What is wanted of a place of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Least compression of the foam that counts \[m\].
    pub compression_m: f64,
    /// By how much a plate may lie higher or lower along its axis \[m\].
    pub height_error_m: f64,
    /// Least time in contact \[s\].
    pub time_s: f64,
    /// Least dose ∫ p dl in contact, of the least stiffness \[Pa·m\].
    pub dose_pa_m: f64,
}

/// What a place gets, at least: with the plate where it gets the least.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dwell {
    /// The greatest of its compressions at all moments \[m\].
    pub compression_m: f64,
    /// Time in contact \[s\].
    pub time_s: f64,
    /// Dose in contact \[Pa·m\].
    pub dose_pa_m: f64,
}

/// Where between 0 and 1 a line through two values is not below 0.
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

/// What two ranges have in common; `None` where that has no length.
#[must_use]
pub fn both([a, b]: [f64; 2], [c, d]: [f64; 2]) -> Option<[f64; 2]> {
    let common = [a.max(c), b.min(d)];
    (common[0] < common[1]).then_some(common)
}

/// What single points of a face get through some moments in order, as it goes evenly between them. The plate lies where a point gets the
/// least.
#[derive(Debug, Clone)]
pub struct Looks<'a> {
    foundation: &'a Foundation,
    moments: &'a [Moment],
    wanted: &'a Wanted,
    /// The longest way of the tip between two moments \[m\].
    stride_m: f64,
}

/// A point at a moment.
#[derive(Clone, Copy)]
struct Instant {
    index: usize,
    compression_m: f64,
    /// How far it lies within the sponge \[m\].
    inside_m: f64,
    /// How fast the sponge slides over it \[m/s\].
    slide_m_s: f64,
}

impl<'a> Looks<'a> {
    /// Looks at a wash.
    #[must_use]
    pub fn new(foundation: &'a Foundation, moments: &'a [Moment], wanted: &'a Wanted) -> Self {
        let strides = moments
            .windows(2)
            .map(|ends| (ends[1].pose.tip - ends[0].pose.tip).norm());
        Self {
            foundation,
            moments,
            wanted,
            stride_m: strides.fold(1e-9, f64::max),
        }
    }

    /// What a point gets \[m\], plate frame.
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

    /// From when to when a point is in contact \[s\], plate frame, in the order of the moments.
    #[must_use]
    pub fn stays(&self, point: &Vector3<f64>) -> Vec<[f64; 2]> {
        let mut stays: Vec<[f64; 2]> = Vec::new();
        self.pass(point, |before, here| {
            let Some(ends) = before.map(|before| [before, here]) else {
                return;
            };
            let Some(shares) = self.in_contact(ends) else { return };
            let [first, last] = ends.map(|end| self.moments[end.index].t_s);
            let [from, to] = shares.map(|share| first + (last - first) * share);
            match stays.last_mut() {
                // Of one moment to the end, of the next from its start.
                Some(stay) if stay[1] == from => stay[1] = to,
                _ => stays.push([from, to]),
            }
        });
        stays
    }

    /// Goes through the moments that are near enough to a point, each with the one before it where that is near enough, too.
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
        let (away, error_m) = (point - tip, self.wanted.height_error_m);
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

    /// From and to which share of the time between two moments a point is in contact; `None` where it is not.
    fn in_contact(&self, ends: [&Instant; 2]) -> Option<[f64; 2]> {
        let pressed = ends.map(|end| end.compression_m - self.wanted.compression_m);
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
