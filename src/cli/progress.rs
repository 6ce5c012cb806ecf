//! A sign of life on a terminal, for work that takes longer than a second.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);

/// Time between two turns of the spinner.
const TICK: Duration = Duration::from_millis(100);

/// A spinner, and a bar once it is known how much there is to do; appears after a second, on a terminal only, and goes
/// when it is dropped.
pub struct Progress {
    bar: ProgressBar,
    over: Option<Sender<()>>,
    timer: Option<JoinHandle<()>>,
}

impl Progress {
    /// A spinner that is not shown yet; `work` is what is done.
    pub fn new(quiet: bool, work: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        style(&bar, "{spinner} {msg}, {elapsed}");
        bar.set_message(work);
        let (over, waiting) = channel();
        let shown = bar.clone();
        let appear = move || {
            if waiting.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                // indicatif itself stays silent when standard error is no terminal.
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(TICK);
            }
        };
        Self {
            bar,
            over: Some(over),
            timer: (!quiet).then(|| std::thread::spawn(appear)),
        }
    }

    /// Notes how much is done.
    pub fn note(&self, done: usize, total: usize) {
        if self.bar.length().is_none() {
            style(&self.bar, "{bar:40} {pos}/{len} layouts, {eta} left");
        }
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        drop(self.over.take());
        if let Some(timer) = self.timer.take() {
            // It only waits and shows; there is nothing to tell if it failed.
            let _ = timer.join();
        }
        self.bar.finish_and_clear();
    }
}

fn style(bar: &ProgressBar, template: &str) {
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
}
