//! What the sampler measured: the worst value of every requirement.

use platewash::certificate::{Requirement, Sense};

/// The worst value of a requirement among the samples (SI). The truth is at least as bad, up to `slack`.
#[derive(Debug, Clone, Copy)]
pub struct WorstSample {
    pub name: Requirement,
    pub value: f64,
    pub limit: f64,
    pub sense: Sense,
    /// What the value is right to.
    pub slack: f64,
}

/// The worst values, a requirement once.
#[derive(Default)]
pub struct Findings {
    all: Vec<WorstSample>,
    /// The least distance of the pairs that the job alone leaves out \[m\].
    waived_m: Option<f64>,
}

impl WorstSample {
    /// Whether the requirement is broken, beyond doubt.
    pub fn is_broken(&self) -> bool {
        match self.sense {
            Sense::AtMost => self.value > self.limit + self.slack,
            _ => self.value < self.limit - self.slack,
        }
    }

    /// Orders values of one requirement, whose limits may differ by joint.
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
    pub fn at_most(&mut self, name: Requirement, value: f64, limit: f64, slack: f64) {
        self.note(name, value, limit, slack, Sense::AtMost);
    }

    /// A value that shall not be below a limit.
    pub fn at_least(&mut self, name: Requirement, value: f64, limit: f64, slack: f64) {
        self.note(name, value, limit, slack, Sense::AtLeast);
    }

    /// The worst value of a requirement; `None` where it was not measured.
    pub fn of(&self, name: Requirement) -> Option<&WorstSample> {
        self.all.iter().find(|found| found.name == name)
    }

    /// What is broken.
    pub fn broken(&self) -> impl Iterator<Item = &WorstSample> {
        self.all.iter().filter(|found| found.is_broken())
    }

    /// A distance of a pair that the job alone leaves out \[m\].
    pub fn waived(&mut self, distance_m: f64) {
        let least = self.waived_m.get_or_insert(f64::INFINITY);
        *least = least.min(distance_m);
    }

    /// The least of those; `None` where no pair is left out so.
    pub fn least_waived_m(&self) -> Option<f64> {
        self.waived_m
    }

    fn note(&mut self, name: Requirement, value: f64, limit: f64, slack: f64, sense: Sense) {
        assert!(!value.is_nan(), "{name:?} is not a number");
        let found = WorstSample {
            name,
            value,
            limit,
            sense,
            slack,
        };
        match self.all.iter_mut().find(|known| known.name == name) {
            Some(known) if found.badness() > known.badness() => *known = found,
            Some(_) => {}
            None => self.all.push(found),
        }
    }
}
