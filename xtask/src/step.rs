//! One command, announced before it runs and judged after.

use anyhow::{Context, Result, bail};
use platewash_bundler::root;
use std::ffi::OsStr;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Instant;

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
        Self::from_command(title, command)
    }

    /// A call that is made already.
    pub fn from_command(title: &'static str, command: Command) -> Self {
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

    /// Runs the step in another folder.
    pub fn at(mut self, folder: &Path) -> Self {
        self.command.current_dir(folder);
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

#[cfg(test)]
mod tests {
    use super::Step;

    #[test]
    fn output_is_returned_and_a_failure_told_with_the_line() {
        let version = |word| Step::cargo("version", &[word]).output();
        assert!(version("--version").unwrap().starts_with("cargo "));
        let error = version("--no-such").unwrap_err().to_string();
        assert!(error.starts_with("version: `cargo --no-such` ended with"), "{error}");
    }
}
