//! One command, announced before it runs and judged after.

use anyhow::{Context, Result, bail};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;

/// The repository.
pub fn root() -> PathBuf {
    // `cargo run` says where this package lies now; the other is where it was when it was built.
    let package = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or(env!("CARGO_MANIFEST_DIR").into());
    let package = PathBuf::from(package);
    package.parent().map_or(package.clone(), Path::to_path_buf)
}

/// Where cargo builds, and where the virtual environment of the Python tests is.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}

/// A command that is run from the root of the repository.
pub struct Step {
    title: &'static str,
    command: Command,
}

impl Step {
    /// A call of any program.
    pub fn program(title: &'static str, program: impl AsRef<OsStr>, arguments: &[&str]) -> Self {
        let mut command = Command::new(program);
        command.args(arguments).current_dir(root());
        Self { title, command }
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
            .and_then(Child::wait_with_output)
            .with_context(|| format!("{}: cannot start {line}", self.title))?;
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
