//! A sign of life for work that takes long: a spinner on a terminal, a line now and then elsewhere.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, Write};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// On a terminal, work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);

/// Elsewhere, the time to the first line, and between two.
const BETWEEN_LINES: Duration = Duration::from_secs(5);

/// Time between two turns of the spinner.
const TICK: Duration = Duration::from_millis(100);

/// What is done, and what of it is tried at the moment; a spinner, and a bar once it is known how much there is to do. Goes when
/// it is dropped.
pub struct Progress {
    bar: ProgressBar,
    doing: Arc<Mutex<String>>,
    over: Option<Sender<()>>,
    timer: Option<JoinHandle<()>>,
}

impl Progress {
    /// Shows nothing yet; `work` is what is done. With `quiet` it stays silent.
    pub fn new(quiet: bool, work: &'static str) -> Self {
        if quiet {
            return Self::silent(work);
        }
        if std::io::stderr().is_terminal() {
            return Self::spinner(work);
        }
        Self::lines(work, BETWEEN_LINES, std::io::stderr())
    }

    fn silent(work: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        style(&bar, "{spinner} {msg}, {elapsed}");
        bar.set_message(work);
        Self {
            bar,
            doing: Arc::new(Mutex::new(work.to_owned())),
            over: None,
            timer: None,
        }
    }

    fn spinner(work: &'static str) -> Self {
        let silent = Self::silent(work);
        let shown = silent.bar.clone();
        silent.timed(move |waiting, _| {
            if waiting.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(TICK);
            }
        })
    }

    /// A line to `out` every so often, with what is tried at that moment.
    fn lines(work: &'static str, every: Duration, mut out: impl Write + Send + 'static) -> Self {
        let start = Instant::now();
        Self::silent(work).timed(move |waiting, doing| {
            while waiting.recv_timeout(every) == Err(RecvTimeoutError::Timeout) {
                let doing = doing.lock().unwrap_or_else(PoisonError::into_inner).clone();
                // Nobody may be reading.
                let _ = writeln!(out, "{doing} ({} s)", start.elapsed().as_secs());
            }
        })
    }

    fn timed(mut self, show: impl FnOnce(Receiver<()>, Arc<Mutex<String>>) + Send + 'static) -> Self {
        let (over, waiting) = channel();
        let doing = self.doing.clone();
        self.over = Some(over);
        self.timer = Some(std::thread::spawn(move || show(waiting, doing)));
        self
    }

    /// Notes what is tried now.
    pub fn say(&self, work: &str, what: &dyn std::fmt::Display) {
        let text = format!("{work}: {what}");
        self.bar.set_message(text.clone());
        *self.doing.lock().unwrap_or_else(PoisonError::into_inner) = text;
    }

    /// Notes how far a study is.
    pub fn rows(&self, at: &platewash::study::Progress) {
        if self.bar.length().is_none() {
            style(&self.bar, "{bar:40} {msg}");
        }
        self.bar.set_length(at.rows);
        self.bar.set_position(at.done);
        let text = format!(
            "{} of {} rows, {:.1} rows/s, {:.0} s left",
            at.done, at.rows, at.per_s, at.left_s
        );
        self.bar.set_message(text.clone());
        *self.doing.lock().unwrap_or_else(PoisonError::into_inner) = text;
    }

    /// Notes how much is done.
    pub fn note(&self, done: usize, total: usize) {
        if self.bar.length().is_none() {
            style(&self.bar, "{bar:40} {pos}/{len} layouts, {eta} left");
        }
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
        *self.doing.lock().unwrap_or_else(PoisonError::into_inner) = format!("{done} of {total} layouts");
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What was written, shared with the one who writes.
    #[derive(Clone, Default)]
    struct Written(Arc<Mutex<Vec<u8>>>);

    impl Written {
        fn text(&self) -> String {
            String::from_utf8(self.0.lock().unwrap().clone()).unwrap()
        }
    }

    impl Write for Written {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.lock().unwrap().write(bytes)
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn where_there_is_no_terminal_a_line_now_and_then_says_what_is_tried() {
        let written = Written::default();
        let progress = Progress::lines("planning", Duration::from_millis(1), written.clone());
        for what in ["ring 1 of 30", "ring 2 of 30"] {
            progress.say("planning", &what);
            let line = format!("planning: {what} (");
            while !written.text().contains(&line) {
                std::thread::yield_now();
            }
        }
        drop(progress);
        let all = written.text();
        assert!(all.ends_with(" s)\n"), "{all}");
        assert!(all.lines().all(|line| line.starts_with("planning")), "{all}");
    }

    #[test]
    fn quiet_work_starts_no_one_who_could_speak() {
        let progress = Progress::new(true, "planning");
        progress.say("planning", &"ring 1 of 30");
        assert!(progress.timer.is_none() && progress.bar.is_hidden());
    }
}
