//! The Python wheel: built from the checkout for the tests, and from its source package outside of it.

use crate::size::no_larger;
use crate::step::Step;
use crate::{python, sources};
use anyhow::{Context, Result, bail};
use platewash_bundler::{root, target};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

/// Largest wheel \[bytes\].
const LARGEST: u64 = 12_000_000;
/// Largest source package \[bytes\]: nothing that was fetched or made comes into it but the page's bundle.
const LARGEST_SOURCE: u64 = 8_000_000;

/// Makes the source package as pip and others do: by the project's own backend, in an environment that has maturin.
const SOURCE_PACKAGE: &str = "\
import os, sys
os.environ['PATH'] = os.pathsep.join([os.path.dirname(sys.executable), os.environ['PATH']])
sys.path.insert(0, sys.argv[1])
import platewash_build
platewash_build.build_sdist(sys.argv[2])";

/// Builds the wheel from the checkout, as `pip install .` does, and installs it in the environment of the tests.
///
/// The Rust build is cargo's in the same target folder, so that what the release build made is not made again.
pub fn install() -> Result<()> {
    let tests = python::environment()?;
    let wheel = build(&tests)?;
    let line = ["install", "--no-deps", "--force-reinstall", &text(&wheel)];
    pip("wheel among the tests", &tests, &line).run()
}

/// Makes the source package, which holds, byte for byte, what the wheel was compiled from, and runs the README's example with the wheel
/// and nothing else.
pub fn package() -> Result<()> {
    in_package(|_| Ok(()))?;
    fresh(&only_file(&wheels(), "whl")?)
}

/// Makes the source package, and checks the extension in it, outside of the checkout and without a network. So a wheel of the package is
/// that of the checkout, and is not compiled a second time.
pub fn package_checked() -> Result<()> {
    in_package(checked)
}

/// Makes the source package, unpacks it outside of the checkout, compares its sources with the checkout's, and does more with its folder.
fn in_package(more: fn(&Path) -> Result<()>) -> Result<()> {
    let tests = python::environment()?;
    let folder = emptied(target().join("package"))?;
    let line = ["-c", SOURCE_PACKAGE, "python/backend", &text(&folder)];
    Step::program("source package", &tests, &line).run()?;
    let package = only_file(&folder, "gz")?;
    no_larger(&package, LARGEST_SOURCE)?;
    let outside = emptied(outside("source"))?;
    let line = ["-m", "tarfile", "-e", &text(&package), &text(&outside)];
    Step::program("source package unpacked", &tests, &line).run()?;
    let name = package.file_name().unwrap_or_default().to_string_lossy();
    let source = outside.join(name.trim_end_matches(".tar.gz"));
    let done = sources::all_in(&source).and_then(|()| more(&source));
    emptied(outside)?;
    done
}

/// Checks the extension in an unpacked source package, without a network.
fn checked(source: &Path) -> Result<()> {
    let line = ["check", "--release", "--offline", "-p", "pyplatewash"];
    let step = Step::cargo("check of the source package", &line).at(source);
    with_its_settings(step).with("CARGO_TARGET_DIR", target()).run()
}

/// Gives a call of cargo the settings of pyo3 with which the wheel was built, so that pyo3 and the extension are not built once more for
/// the next wheel. Before the first wheel, pyo3 asks no interpreter.
pub fn with_its_settings(step: Step) -> Step {
    let settings = std::fs::read_dir(target().join("maturin")).into_iter().flatten();
    let settings = settings.filter_map(|entry| Some(entry.ok()?.path()));
    let is_of_pyo3 = |file: &PathBuf| {
        file.file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with("pyo3-config-"))
    };
    let changed = |file: &PathBuf| file.metadata().and_then(|data| data.modified()).ok();
    match settings.filter(is_of_pyo3).max_by_key(changed) {
        Some(file) => step.with("PYO3_CONFIG_FILE", file),
        None => step.with("PYO3_NO_PYTHON", "1"),
    }
}

/// Where the wheel is.
fn wheels() -> PathBuf {
    target().join("wheels")
}

/// A folder outside the checkout, always the same for this checkout: cargo replaces what it built there the last time.
pub fn outside(what: &str) -> PathBuf {
    let mut hasher = DefaultHasher::new();
    root().hash(&mut hasher);
    std::env::temp_dir().join(format!("platewash-{what}-{:016x}", hasher.finish()))
}

/// The wheel of the checkout.
fn build(python: &Path) -> Result<PathBuf> {
    let folder = emptied(wheels())?;
    let line = ["wheel", "--no-deps", "--wheel-dir", &text(&folder), &text(&root())];
    pip("wheel", python, &line).with("CARGO_TARGET_DIR", target()).run()?;
    let wheel = only_file(&folder, "whl")?;
    no_larger(&wheel, LARGEST)?;
    Ok(wheel)
}

/// The wheel in an environment where nothing else is, and the README's example in it.
fn fresh(wheel: &Path) -> Result<()> {
    let folder = target().join("fresh");
    let line = ["-m", "venv", "--clear", &text(&folder)];
    Step::program("fresh environment", platewash_bundler::python_program(), &line).run()?;
    let python = platewash_bundler::interpreter(&folder);
    pip("wheel in it", &python, &["install", &text(wheel)]).run()?;
    let line = ["-I", "tests/python/readme_example.py"];
    Step::program("README's example in it", &python, &line).run()
}

/// A call of an interpreter's pip.
fn pip(title: &'static str, python: &Path, arguments: &[&str]) -> Step {
    let line = [&["-m", "pip", "--quiet", "--disable-pip-version-check"], arguments].concat();
    Step::program(title, python, &line)
}

/// A folder that is not there any more.
pub fn emptied(folder: PathBuf) -> Result<PathBuf> {
    if folder.exists() {
        std::fs::remove_dir_all(&folder).with_context(|| folder.display().to_string())?;
    }
    Ok(folder)
}

/// The one file with that extension in a folder.
fn only_file(folder: &Path, extension: &str) -> Result<PathBuf> {
    let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut found = entries.filter_map(|entry| Some(entry.ok()?.path()));
    match found.find(|path| path.extension().is_some_and(|found| found == extension)) {
        Some(path) => Ok(path),
        None => bail!("no .{extension} file in {}", folder.display()),
    }
}

pub fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
