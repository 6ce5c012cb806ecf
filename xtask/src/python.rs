//! The Python tests, in a virtual environment of their own.

use crate::command;
use crate::step::Step;
use anyhow::{Context, Result, bail};
use platewash_bundler::{interpreter, python_program, root, target};
use std::path::PathBuf;
use std::process::Command;
use std::sync::{Mutex, PoisonError};

const REQUIREMENTS: &str = "tests/python/requirements.txt";
/// Prints the version if the interpreter is complete; Debian ships `venv` without `ensurepip`.
const PROBE: &str = "import ensurepip, platform, venv; print(platform.python_version())";
const MISSING: &str = "\
the Python tests need Python 3 with venv and pip.
    Debian, Ubuntu:  apt install python3 python3-venv
    Fedora:          dnf install python3
    macOS:           brew install python
    Windows:         winget install Python.Python.3.12
If it goes by another name, set PYTHON, as in PYTHON=python3.12.
Without Python, `cargo xtask check --only lint` and `cargo xtask test --only rust` still work.";
/// What type checkers say of the package: a part of `cargo xtask check`.
const TYPES: &str = "tests/python/test_wheel_types.py";

/// Runs `tests/python`, and the tests of the second prover, against the release build of the command.
pub fn tests() -> Result<()> {
    let without = format!("--ignore={TYPES}");
    let line = [
        "tests/python",
        "checker/tests",
        &without,
        // One process a core. Tests of one file stay together: they share plans, and a cluster is alone in its process.
        // `tests/python/conftest.py` puts the longest files first, so that no core is idle at the end.
        "--numprocesses=auto",
        "--dist=loadfile",
        "--no-loadscope-reorder",
        "--durations=20",
    ];
    pytest("Python tests", &line)
}

/// Checks the types of the package, and its stubs.
pub fn types() -> Result<()> {
    pytest("types of the Python package", &[TYPES])
}

fn pytest(title: &'static str, arguments: &[&str]) -> Result<()> {
    let line = [&["-m", "pytest"], arguments].concat();
    Step::program(title, environment()?, &line)
        .with("PLATEWASH_BIN", command::program())
        // What Python compiles is kept, and not among the sources.
        .with("PYTHONDONTWRITEBYTECODE", "")
        .with("PYTHONPYCACHEPREFIX", target().join("pycache"))
        .run()
}

/// Fails where there is no Python that can run the tests.
///
/// # Errors
/// No interpreter, or one without `venv` or `pip`; the message says what to install.
pub fn check() -> Result<()> {
    version(&python_program()).map(drop)
}

/// The interpreter of the virtual environment, made anew when the interpreter or the requirements changed. One call waits for the other.
pub fn environment() -> Result<PathBuf> {
    static ALONE: Mutex<()> = Mutex::new(());
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let base = python_program();
    let version = version(&base)?;
    let requirements = std::fs::read_to_string(root().join(REQUIREMENTS)).context(REQUIREMENTS)?;
    let folder = target().join("python");
    let python = interpreter(&folder);
    // Written last, so that an interrupted installation is not taken for a finished one.
    let stamp = folder.join("stamp.txt");
    let wanted = format!("{base} {version}\n{requirements}");
    if python.is_file() && std::fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) {
        return Ok(python);
    }
    let place = folder.to_string_lossy();
    Step::program("virtual environment", &base, &["-m", "venv", "--clear", &place]).run()?;
    let install = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        // The tests compile what they import: a small part of what is installed.
        "--no-compile",
        "-r",
        REQUIREMENTS,
    ];
    if let Err(error) = Step::program("Python packages", &python, &install).run() {
        bail!(
            "{error:#}\n(a package that is not found may mean that {REQUIREMENTS} is for another Python than {version}, \
             or for other systems: Pinocchio and coal are not published for Windows)"
        );
    }
    std::fs::write(&stamp, wanted).with_context(|| stamp.display().to_string())?;
    Ok(python)
}

/// The interpreter's version, if it has what is needed.
fn version(base: &str) -> Result<String> {
    let Ok(output) = Command::new(base).args(["-c", PROBE]).output() else {
        bail!("no program '{base}': {MISSING}");
    };
    if !output.status.success() {
        bail!("'{base}' is incomplete: {MISSING}");
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
