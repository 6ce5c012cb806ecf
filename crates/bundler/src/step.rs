//! One command, announced before it runs and judged after.

use anyhow::{Context, Result, bail};
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// The repository.
pub fn root() -> PathBuf {
    // Cargo says where the package lies that it runs; the other is where this one was when it was built.
    let package = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let mut folders = package.iter().flat_map(|package| package.ancestors());
    let found = folders.find(|folder| folder.join("crates/bundler/Cargo.toml").is_file());
    found.map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."),
        Path::to_path_buf,
    )
}

/// Folder in which cargo builds; it also holds the virtual environment of the Python tests.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}

/// A command that is run from the root of the repository.
pub struct Step {
    title: &'static str,
    command: Command,
    longest: Option<Duration>,
}

impl Step {
    /// A call of any program.
    pub fn program(title: &'static str, program: impl AsRef<OsStr>, arguments: &[&str]) -> Self {
        let mut command = Command::new(program);
        command.args(arguments).current_dir(root());
        let longest = None;
        Self {
            title,
            command,
            longest,
        }
    }

    /// A call of the cargo that runs us.
    pub fn cargo(title: &'static str, arguments: &[&str]) -> Self {
        Self::program(title, std::env::var_os("CARGO").unwrap_or("cargo".into()), arguments)
    }

    /// The same with an environment variable set.
    pub fn with(mut self, variable: &str, value: impl AsRef<OsStr>) -> Self {
        self.command.env(variable, value);
        self
    }

    /// Runs the step in another folder.
    pub fn at(mut self, folder: &Path) -> Self {
        self.command.current_dir(folder);
        self
    }

    /// The same, ended by force if it takes longer.
    pub fn within(mut self, longest: Duration) -> Self {
        self.longest = Some(longest);
        self
    }

    /// Runs the command; fails unless it succeeds.
    pub fn run(self) -> Result<()> {
        self.output_to(Stdio::inherit()).map(drop)
    }

    /// Runs the command; fails unless it succeeds. Its standard output is not shown but returned.
    pub fn output(self) -> Result<String> {
        self.output_to(Stdio::piped())
    }

    fn output_to(mut self, stdout: Stdio) -> Result<String> {
        let line = self.line();
        println!("\n==> {}: {line}", self.title);
        let start = Instant::now();
        let child = self.command.stdout(stdout).spawn();
        let output = child
            .and_then(|child| wait(child, self.longest))
            .with_context(|| format!("{}: cannot run `{line}`", self.title))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        if !output.status.success() {
            bail!("{}: `{line}` ended with {}\n{text}", self.title, output.status);
        }
        println!("    {} passed in {:.1} s", self.title, start.elapsed().as_secs_f64());
        Ok(text)
    }

    /// The command as one would type it.
    fn line(&self) -> String {
        let program = Path::new(self.command.get_program());
        let name = program.file_name().unwrap_or(program.as_os_str());
        let words = std::iter::once(name).chain(self.command.get_args());
        words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ")
    }
}

/// Waits for the end of a program, for a time if one is given, and then ends it.
fn wait(mut child: Child, longest: Option<Duration>) -> io::Result<Output> {
    const BETWEEN_LOOKS: Duration = Duration::from_millis(20);
    let start = Instant::now();
    while let Some(longest) = longest
        && child.try_wait()?.is_none()
    {
        if start.elapsed() > longest {
            child.kill()?;
            child.wait()?;
            let words = format!("not done after {} s", longest.as_secs());
            return Err(io::Error::new(io::ErrorKind::TimedOut, words));
        }
        std::thread::sleep(BETWEEN_LOOKS);
    }
    child.wait_with_output()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_is_done_in_time_has_succeeded() {
        let step = Step::cargo("version", &["--version"]).within(Duration::from_secs(60));
        assert!(step.output().unwrap().starts_with("cargo "));
    }

    #[test]
    fn a_program_that_takes_too_long_is_ended() {
        // It reads a source that does not end.
        let child = Command::new("rustc").arg("-").stdin(Stdio::piped()).spawn().unwrap();
        let error = wait(child, Some(Duration::ZERO)).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::TimedOut);
    }
}
