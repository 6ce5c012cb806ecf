//! What the sampler measured: the worst value of every promise.

use platewash::planner::certificate::{PromiseName, Sense};

/// The worst value of a promise among the samples (SI). The truth is at least as bad, up to `slack`.
#[derive(Debug, Clone, Copy)]
pub struct Found {
    pub name: PromiseName,
    pub value: f64,
    pub limit: f64,
    pub sense: Sense,
    /// What the value is right to.
    pub slack: f64,
}

/// The worst values, a promise once.
#[derive(Default)]
pub struct Findings(Vec<Found>);

impl Found {
    /// Whether the promise is broken, beyond doubt.
    pub fn is_broken(&self) -> bool {
        match self.sense {
            Sense::AtMost => self.value > self.limit + self.slack,
            _ => self.value < self.limit - self.slack,
        }
    }

    /// Orders values of one promise, whose limits may differ by joint.
    fn badness(&self) -> f64 {
        match self.sense {
            Sense::AtMost if self.limit > 0.0 => self.value / self.limit,
            Sense::AtMost => self.value,
            _ => self.limit - self.value,
        }
    }
}

impl Findings {
    /// A value that shall not be above a limit.
    pub fn at_most(&mut self, name: PromiseName, value: f64, limit: f64, slack: f64) {
        self.note(name, value, limit, slack, Sense::AtMost);
    }

    /// A value that shall not be below a limit.
    pub fn at_least(&mut self, name: PromiseName, value: f64, limit: f64, slack: f64) {
        self.note(name, value, limit, slack, Sense::AtLeast);
    }

    /// The worst value of a promise; `None` where it was not measured.
    pub fn of(&self, name: PromiseName) -> Option<&Found> {
        self.0.iter().find(|found| found.name == name)
    }

    /// What is broken.
    pub fn broken(&self) -> impl Iterator<Item = &Found> {
        self.0.iter().filter(|found| found.is_broken())
    }

    fn note(&mut self, name: PromiseName, value: f64, limit: f64, slack: f64, sense: Sense) {
        assert!(!value.is_nan(), "{name:?} is not a number");
        let found = Found {
            name,
            value,
            limit,
            sense,
            slack,
        };
        match self.0.iter_mut().find(|known| known.name == name) {
            Some(known) if found.badness() > known.badness() => *known = found,
            Some(_) => {}
            None => self.0.push(found),
        }
    }
}
