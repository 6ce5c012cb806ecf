//! How long steps took.

use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Instant;

/// Time that steps took, by their names \[ms\].
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Milliseconds(BTreeMap<&'static str, f64>);

/// Measures steps that follow each other.
#[derive(Debug)]
pub struct Stopwatch {
    since: Instant,
    told: Milliseconds,
}

impl Stopwatch {
    /// The first step begins now.
    pub fn start() -> Self {
        Self {
            since: Instant::now(),
            told: Milliseconds::default(),
        }
    }

    /// A step ends here, the next one begins.
    pub fn step(&mut self, name: &'static str) {
        let now = Instant::now();
        let took_ms = 1e3 * (now - self.since).as_secs_f64();
        // Hundredths are as fine as anybody looks.
        self.told.0.insert(name, (100.0 * took_ms).round() / 100.0);
        self.since = now;
    }

    /// All steps up to now.
    pub fn all(&self) -> Milliseconds {
        self.told.clone()
    }
}
