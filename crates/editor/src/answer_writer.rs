//! An answer on its way to the page, line by line, and how it ends.

use crate::protocol::{EndLine, Milliseconds, Refusal};
use crate::refusal::of_failure;
use platewash_planner::PlanError;
use platewash_scenario::Failure;
use platewash_workcell::cancel::{CancelToken, Cancelled, Clock};
use serde::Serialize;
use std::time::Duration;

/// Writes the lines of an answer while the client listens, and records the duration of each step.
pub struct AnswerWriter<'a> {
    tell: &'a mut dyn FnMut(String) -> bool,
    /// Cancelled when the client has left.
    client: CancelToken,
    /// Cancelled when the client has left, or the work must end for another reason.
    pub gone: CancelToken,
    clock: Clock,
    since: Duration,
    took: Milliseconds,
}

impl<'a> AnswerWriter<'a> {
    /// Makes a writer that passes lines to `tell`, which returns false once the client has left. The first step begins now.
    pub fn new(tell: &'a mut dyn FnMut(String) -> bool, gone: &CancelToken, clock: Clock) -> Self {
        Self {
            tell,
            client: gone.clone(),
            gone: gone.clone(),
            clock,
            since: clock(),
            took: Milliseconds::default(),
        }
    }

    /// Tells a line.
    pub fn line(&mut self, line: &impl Serialize) {
        // Lines are made of numbers and text, which JSON can say.
        let Ok(text) = serde_json::to_string(line) else { return };
        if !(self.tell)(text) {
            self.client.cancel();
        }
    }

    /// A step ends here, the next one begins.
    pub fn step(&mut self, name: &'static str) {
        let now = (self.clock)();
        let took_ms = 1e3 * (now - self.since).as_secs_f64();
        // Hundredths are as fine as anybody looks.
        self.took.0.insert(name, (100.0 * took_ms).round() / 100.0);
        self.since = now;
    }

    /// Time of all steps up to now.
    pub fn ms(&self) -> Milliseconds {
        self.took.clone()
    }

    /// Tells that something is wrong.
    pub fn failed(&mut self, words: &str) {
        self.line(&EndLine::Failed { words });
    }

    /// From now on, cancels the work after some time.
    pub fn end_within(&mut self, time: Duration) {
        self.gone = self.client.within(time, self.clock);
    }

    /// Tells why an answer ends; `too_long` are the words where its time has passed.
    pub fn end(&mut self, end: &End, too_long: &str) {
        let ms = self.ms();
        match end {
            End::Refused(refusal) => self.line(&EndLine::Refused { refusal, ms }),
            End::GivenUp if self.gone.is_late() => self.failed(too_long),
            End::GivenUp => self.line(&EndLine::Superseded),
            End::Failed(words) => self.failed(words),
        }
    }
}

/// Reason that an answer ends early.
pub enum End {
    /// The scenario is none, or states no job.
    Refused(Refusal),
    /// A later question came, or it takes too long.
    GivenUp,
    /// A fault of the program.
    Failed(String),
}

impl From<Refusal> for End {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<Failure> for End {
    fn from(failure: Failure) -> Self {
        match failure.is_cancelled() {
            true => Self::GivenUp,
            false => Self::Refused(of_failure(&failure)),
        }
    }
}

impl From<PlanError> for End {
    fn from(error: PlanError) -> Self {
        Failure::from(error).into()
    }
}

impl From<Cancelled> for End {
    fn from(_: Cancelled) -> Self {
        Self::GivenUp
    }
}
