//! Moments of a wash, bounds of the motion between two of them, and the amounts wanted at a place.
//!
//! The amounts that one point of a plate gets from a wash are measured here, not bounded.

use crate::contact::bundles::Bundles;
use crate::contact::{Foundation, SpongePose};
use nalgebra::Vector3;
use platewash_workcell::job::ContactThresholds;
use std::ops::ControlFlow;

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

impl Moment {
    /// Sliding speed of the sponge over a point \[m/s\].
    fn slide_m_s(&self, point: &Vector3<f64>) -> f64 {
        let slide = self.speed + self.turning.cross(&(point - self.pose.tip));
        (slide - self.pose.axis * slide.dot(&self.pose.axis)).norm()
    }
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
    let crossing = || from / (from - to);
    match (from >= 0.0, to >= 0.0) {
        (true, true) => Some([0.0, 1.0]),
        (true, false) => Some([0.0, crossing()]),
        (false, true) => Some([crossing(), 1.0]),
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
pub struct ContactSampler {
    foundation: Foundation,
    moments: Vec<Moment>,
    thresholds: ContactThresholds,
    /// One for each moment.
    prepared: Vec<Prepared>,
    bundles: Bundles,
}

/// Amounts of a moment that are the same for all points.
#[derive(Debug, Clone, Copy)]
struct Prepared {
    /// Shifts of a point by the height error, off the axis and down along it \[m\].
    moved_m: [f64; 2],
    /// Sliding speed, if the sponge does not turn \[m/s\].
    slide_m_s: Option<f64>,
}

/// State of a point at a moment.
#[derive(Clone, Copy)]
struct Instant {
    index: usize,
    compression_m: f64,
    /// Depth within the sponge's rim \[m\]; negative outside.
    inside_m: f64,
}

impl ContactSampler {
    /// Prepares the moments of a wash.
    #[must_use]
    pub fn new(foundation: Foundation, moments: Vec<Moment>, thresholds: ContactThresholds) -> Self {
        let prepared = |moment: &Moment| {
            let SpongePose { tip, axis } = &moment.pose;
            let share = [axis.xy().norm(), axis.z.abs()];
            Prepared {
                moved_m: share.map(|share| thresholds.height_error_m * share),
                slide_m_s: (moment.turning == Vector3::zeros()).then(|| moment.slide_m_s(tip)),
            }
        };
        Self {
            foundation,
            prepared: moments.iter().map(prepared).collect(),
            bundles: Bundles::of(&moments),
            moments,
            thresholds,
        }
    }

    /// The moments of the wash.
    #[must_use]
    pub fn moments(&self) -> &[Moment] {
        &self.moments
    }

    /// Returns the amounts at a point \[m\], plate frame.
    #[must_use]
    pub fn at(&self, point: &Vector3<f64>) -> Dwell {
        self.until(point, |_| false)
    }

    /// Returns the amounts at a point \[m\], plate frame, from the moments up to the first at which they are enough.
    #[must_use]
    pub fn until(&self, point: &Vector3<f64>, is_enough: impl Fn(&Dwell) -> bool) -> Dwell {
        let mut dwell = Dwell {
            compression_m: f64::NEG_INFINITY,
            ..Dwell::default()
        };
        self.pass(point, |before, here| {
            if here.inside_m >= 0.0 {
                dwell.compression_m = dwell.compression_m.max(here.compression_m);
            }
            let ends = before.map(|before| [before, here]);
            if let Some((ends, shares)) = ends.and_then(|ends| Some((ends, self.in_contact(ends)?))) {
                let slide_m_s = ends.map(|end| self.slide_m_s(end.index, point));
                self.add_between(&mut dwell, ends, shares, slide_m_s);
                if is_enough(&dwell) {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        });
        dwell
    }

    /// Returns the intervals in which a point is in contact \[s\], plate frame, in the order of the moments.
    #[must_use]
    pub fn contact_intervals(&self, point: &Vector3<f64>) -> Vec<[f64; 2]> {
        let mut stays: Vec<[f64; 2]> = Vec::new();
        self.pass(point, |before, here| {
            let ends = before.map(|before| [before, here]);
            let Some((ends, shares)) = ends.and_then(|ends| Some((ends, self.in_contact(ends)?))) else {
                return ControlFlow::Continue(());
            };
            let [first, last] = ends.map(|end| self.moments[end.index].t_s);
            let [from, to] = shares.map(|share| first + (last - first) * share);
            match stays.last_mut() {
                // A stay to the end of one interval continues from the start of the next.
                Some(stay) if stay[1] == from => stay[1] = to,
                _ => stays.push([from, to]),
            }
            ControlFlow::Continue(())
        });
        stays
    }

    /// Visits the moments at which a point may be inside the sponge's rim, and their neighbours, each with the one before it if that
    /// is visited, too; up to the first at which it is told to stop.
    fn pass(&self, point: &Vector3<f64>, mut at: impl FnMut(Option<&Instant>, &Instant) -> ControlFlow<()>) {
        let radius_m = self.foundation.radius_m;
        let mut before: Option<Instant> = None;
        for moments in self.bundles.near(radius_m, point) {
            for index in moments {
                let here = self.instant(index, point);
                let next_to = before.as_ref().filter(|before| before.index + 1 == index);
                if at(next_to, &here).is_break() {
                    return;
                }
                before = Some(here);
            }
        }
    }

    fn instant(&self, index: usize, point: &Vector3<f64>) -> Instant {
        let SpongePose { tip, axis } = &self.moments[index].pose;
        let [aside_m, lower_m] = self.prepared[index].moved_m;
        let away = point - tip;
        let along = away.dot(axis);
        let aside_m = (away.norm_squared() - along * along).max(0.0).sqrt() + aside_m;
        Instant {
            index,
            compression_m: self.foundation.compression_m - along - lower_m,
            inside_m: self.foundation.radius_m - aside_m,
        }
    }

    /// Sliding speed of the sponge over a point \[m/s\].
    fn slide_m_s(&self, index: usize, point: &Vector3<f64>) -> f64 {
        self.prepared[index]
            .slide_m_s
            .unwrap_or_else(|| self.moments[index].slide_m_s(point))
    }

    /// Returns the part of the time between two moments in which a point is in contact; `None` if it is not.
    fn in_contact(&self, ends: [&Instant; 2]) -> Option<[f64; 2]> {
        let inside = at_least_0(ends.map(|end| end.inside_m))?;
        let pressed = ends.map(|end| end.compression_m - self.thresholds.compression_m);
        both(at_least_0(pressed)?, inside)
    }

    /// Adds time and dose for the part of the time between two moments that is in contact, with the speeds of sliding at both.
    fn add_between(&self, dwell: &mut Dwell, ends: [&Instant; 2], [from, to]: [f64; 2], slide_m_s: [f64; 2]) {
        let [first, last] = ends.map(|end| self.moments[end.index].t_s);
        let along_s = (to - from) * (last - first);
        let middle = 0.5 * (from + to);
        let mean = |[first, last]: [f64; 2]| first + (last - first) * middle;
        let pressure_pa =
            self.foundation.stiffness_pa[0] / self.foundation.free_height_m * mean(ends.map(|end| end.compression_m));
        dwell.time_s += along_s;
        dwell.dose_pa_m += pressure_pa * mean(slide_m_s) * along_s;
    }
}
