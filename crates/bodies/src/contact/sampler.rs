//! Amounts that single points of a plate's face get from a wash: measured, not bounded.
//!
//! The amounts of requirements 27 to 29 and formula (27.1) in `docs/contact.md`.

use crate::contact::bundles::Bundles;
use crate::contact::foundation::Foundation;
use crate::contact::interval::{at_least_0, both};
use crate::contact::moment::Moment;
use crate::contact::sponge_pose::SpongePose;
use nalgebra::Vector3;
use platewash_workcell::job::ContactThresholds;
use std::ops::ControlFlow;

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
            bundles: Bundles::new(&moments),
            moments,
            thresholds,
        }
    }

    /// The moments of the wash.
    #[must_use]
    pub fn moments(&self) -> &[Moment] {
        &self.moments
    }

    /// Returns the greatest w of formula (27.1), the time in contact and the dose ∫ σ dl at a point. `point` is x \[m\], plate frame.
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

    /// Returns w of formula (27.1) at a point and its depth within the rim, with the plate where both are least. `point` is x \[m\].
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

    /// Adds time and dose ∫ σ dl for the part of the time between two moments that is in contact, with the speeds of sliding at both.
    fn add_between(&self, dwell: &mut Dwell, ends: [&Instant; 2], [from, to]: [f64; 2], slide_m_s: [f64; 2]) {
        let [first, last] = ends.map(|end| self.moments[end.index].t_s);
        let along_s = (to - from) * (last - first);
        let middle = 0.5 * (from + to);
        let mean = |[first, last]: [f64; 2]| first + (last - first) * middle;
        let pressure_pa = self.foundation.pressure_pa_m()[0] * mean(ends.map(|end| end.compression_m));
        dwell.time_s += along_s;
        dwell.dose_pa_m += pressure_pa * mean(slide_m_s) * along_s;
    }
}
