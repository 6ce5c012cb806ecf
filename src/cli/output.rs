//! Results on standard output; messages on standard error, and signs of life for work that takes long: a spinner on a terminal, a line now and
//! then elsewhere.

use super::failure;
use super::terminal::shown;
use anyhow::{Context, Result};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use platewash::CancelToken;
use platewash::planner::{Activity, Watch};
use serde::Serialize;
use std::fmt::Display;
use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Last line of a report that leaves something out.
const HINT: &str = "\nmore: --details\n";

/// State of the reader of standard output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reader {
    /// The reader has not closed its end, as far as is known.
    There,
    /// The reader has closed its end; further output is lost.
    Gone,
}

/// Prints to standard output; a reader that has gone away is no error.
pub fn print(text: &str) -> Result<Reader> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(Reader::Gone),
        printed => printed
            .map(|()| Reader::There)
            .context("standard output cannot be written"),
    }
}

/// A message on standard error.
pub fn message(words: &str) {
    // Nothing is left to do when standard error is closed.
    let _ = writeln!(std::io::stderr(), "{}", shown(&words));
}

/// A value as indented JSON: see [`json::write`](platewash::workcell::json::write).
pub fn json(value: &impl Serialize) -> Result<String> {
    platewash::workcell::json::write(value).map_err(failure::internal)
}

/// The whole report, as files hold it.
pub fn full_report(report: &impl Display) -> String {
    shown(&format_args!("{report:#}"))
}

/// `--details`.
#[derive(Debug, Args, Default)]
pub struct DetailArguments {
    /// Print the whole report: every requirement, plate, pair of bodies and assumption
    #[arg(long)]
    details: bool,
}

impl DetailArguments {
    /// The report as it is printed: one screen of it, or the whole.
    pub fn printed(&self, report: &impl Display) -> String {
        let (short, whole) = (shown(report), full_report(report));
        match self.details || short == whole {
            true => whole,
            false => short + HINT,
        }
    }
}

/// Shortest work that shows its progress on a terminal.
const PATIENCE: Duration = Duration::from_secs(1);

/// Time before the first progress line, and between two lines, where standard error is no terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(5);

/// Time between two turns of the spinner.
const TICK: Duration = Duration::from_millis(100);

/// Progress display: the work and its present step, with a spinner, and a bar once the amount of work is known. It disappears when
/// it is dropped.
pub struct Progress {
    bar: ProgressBar,
    /// Shows the activity of a planner.
    tell: Box<dyn Fn(&Activity) + Sync>,
    timer: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// A display of the work named `work`, which shows nothing yet. With `quiet` it stays silent.
    pub fn new(quiet: bool, work: &'static str) -> Self {
        let silent = Self::hidden(work);
        if quiet {
            return silent;
        }
        if !std::io::stderr().is_terminal() {
            return silent.lines(BETWEEN_LINES, std::io::stderr());
        }
        silent.timed(PATIENCE, |bar| {
            bar.set_draw_target(ProgressDrawTarget::stderr());
            bar.enable_steady_tick(TICK);
            false
        })
    }

    fn hidden(work: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()).with_message(work);
        style(&bar, "{spinner} {msg}, {elapsed}");
        let shown = bar.clone();
        Self {
            bar,
            tell: Box::new(move |activity| shown.set_message(format!("{work}: {activity}"))),
            timer: None,
        }
    }

    /// Writes a line with the present step to `out` at the given interval.
    fn lines(self, every: Duration, mut out: impl Write + Send + 'static) -> Self {
        self.timed(every, move |bar| {
            // Nobody may be reading.
            let _ = writeln!(out, "{} ({} s)", bar.message(), bar.elapsed().as_secs());
            true
        })
    }

    /// Calls `show` at the given interval, until it returns false.
    fn timed(mut self, every: Duration, mut show: impl FnMut(&ProgressBar) -> bool + Send + 'static) -> Self {
        let ((over, waiting), bar) = (channel(), self.bar.clone());
        let timer = move || while waiting.recv_timeout(every) == Err(RecvTimeoutError::Timeout) && show(&bar) {};
        self.timer = Some((over, std::thread::spawn(timer)));
        self
    }

    /// Returns what tells a planner to give up, and shows what it says.
    pub fn watch<'a>(&'a self, cancel: &'a CancelToken) -> Watch<'a> {
        let tell = &*self.tell;
        Watch { tell, cancel }
    }

    /// Shows the progress of a study.
    pub fn rows(&self, at: &platewash::study::Progress) {
        let (done, rows) = (at.done, at.rows);
        let words = format!("{done} of {rows} rows, {:.1} rows/s, {:.0} s left", at.per_s, at.left_s);
        self.counted(done, rows, "{bar:40} {msg}", words);
    }

    /// Shows the number of layouts done.
    pub fn layouts(&self, done: usize, total: usize) {
        let words = format!("{done} of {total} layouts");
        self.counted(done as u64, total as u64, "{bar:40} {msg}, {eta} left", words);
    }

    fn counted(&self, done: u64, total: u64, template: &str, words: String) {
        if self.bar.length().is_none() {
            style(&self.bar, template);
        }
        self.bar.set_length(total);
        self.bar.set_position(done);
        self.bar.set_message(words);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((over, timer)) = self.timer.take() {
            drop(over);
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

    #[test]
    fn no_control_character_but_a_new_line_leaves() {
        let name = "a\u{1b}[31m\u{7f}\u{9b}2J\t\r\n\u{e9}";
        assert_eq!(shown(&name), "a\\u{1b}[31m\\u{7f}\\u{9b}2J\\t\\r\n\u{e9}");
        let written = json(&name).unwrap();
        assert!(!written.trim_end().contains(char::is_control), "{written:?}");
        assert_eq!(serde_json::from_str::<String>(&written).unwrap(), name);
    }
}

#[cfg(test)]
mod progress_tests {
    use super::*;
    use std::sync::{Arc, Mutex};

    /// Written text, shared with the writer.
    #[derive(Clone, Default)]
    struct SharedBuffer(Arc<Mutex<Vec<u8>>>);

    impl SharedBuffer {
        fn text(&self) -> String {
            String::from_utf8(self.0.lock().unwrap().clone()).unwrap()
        }
    }

    impl Write for SharedBuffer {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.lock().unwrap().write(bytes)
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn without_a_terminal_prints_a_progress_line_now_and_then() {
        let written = SharedBuffer::default();
        let progress = Progress::hidden("planning").lines(Duration::from_millis(1), written.clone());
        for what in [0, 1].map(|plate| Activity::Cause { plate }) {
            (progress.tell)(&what);
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
    fn quiet_work_starts_no_progress_thread() {
        let progress = Progress::new(true, "planning");
        (progress.tell)(&Activity::Cause { plate: 0 });
        assert!(progress.timer.is_none() && progress.bar.is_hidden());
    }
}
