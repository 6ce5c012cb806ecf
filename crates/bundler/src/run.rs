//! Calls of programs, ended by force where they take too long.

use anyhow::{Context, Result, bail};
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Time between two looks whether a program has ended.
const BETWEEN_LOOKS: Duration = Duration::from_millis(20);

/// Runs a program for a time at most; fails unless it succeeds.
pub(crate) fn run(title: &str, command: &mut Command, longest: Duration) -> Result<()> {
    println!("\n==> {title}");
    let child = command.spawn();
    let mut child = child.with_context(|| format!("{title}: cannot run {}", command.get_program().display()))?;
    let start = Instant::now();
    let ended = loop {
        if let Some(ended) = child.try_wait()? {
            break ended;
        }
        if start.elapsed() > longest {
            child.kill()?;
            child.wait()?;
            bail!("{title}: not done after {} s", longest.as_secs());
        }
        sleep(BETWEEN_LOOKS);
    };
    if !ended.success() {
        bail!("{title}: ended with {ended}");
    }
    println!("    {title} passed in {:.1} s", start.elapsed().as_secs_f64());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Stdio;

    #[test]
    fn a_program_that_is_done_in_time_has_succeeded() {
        run(
            "version",
            Command::new("rustc").arg("--version"),
            Duration::from_secs(60),
        )
        .unwrap();
        let error = run("bad", Command::new("rustc").arg("--no-such"), Duration::from_secs(60)).unwrap_err();
        assert!(error.to_string().starts_with("bad: ended with"), "{error}");
    }

    #[test]
    fn a_program_that_takes_too_long_is_ended() {
        // It reads a source that does not end.
        let mut command = Command::new("rustc");
        command.arg("-").stdin(Stdio::piped());
        let error = run("endless", &mut command, Duration::ZERO).unwrap_err();
        assert_eq!(error.to_string(), "endless: not done after 0 s");
    }
}
