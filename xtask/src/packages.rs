//! The crates as packages: made, unpacked outside of the checkout, and used there as from a registry.

use crate::python;
use crate::wheel::{emptied, outside, text};
use anyhow::{Context, Result};
use platewash_bundler::{Step, root, target};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Members of the workspace that are not published.
const PRIVATE: [&str; 4] = ["pyplatewash", "platewash-playground", "platewash-problems", "xtask"];

/// Manifest of a program that uses the command as a library does.
const MANIFEST: &str = r#"
[package]
name = "user"
version = "0.0.0"
edition = "2024"

[dependencies]
platewash = "0.1.0"
# A copy under another name: crates that both use are checked once, with the same features.
alone = { package = "platewash-alone", path = "alone/platewash-0.1.0", default-features = false }

[workspace]

[patch.crates-io]
"#;

const PROGRAM: &str = r#"
fn main() -> Result<std::process::ExitCode, Box<dyn std::error::Error>> {
    let job = alone::Scenario::load("kitchen")?.job()?;
    let proved = platewash::certify(platewash::plan(&job)?.plan, job.arm())?;
    println!("{}", proved.certificate().headline);
    Ok(platewash::cli::program(std::env::args_os()).into())
}
"#;

/// Makes the packages, and checks a program that uses them in a folder without the workspace, and the library without what the command
/// needs.
pub fn tested() -> Result<()> {
    let excluded = PRIVATE.iter().flat_map(|name| ["--exclude", name]);
    let line = ["package", "--workspace", "--no-verify", "--allow-dirty", "--quiet"];
    let line: Vec<&str> = line.into_iter().chain(excluded).collect();
    let packages = target().join("package");
    for old in files_in(&packages)?.iter().filter(|name| name.ends_with(".crate")) {
        fs::remove_file(packages.join(old))?;
    }
    Step::cargo("packages", &line).run()?;
    let (python, outside) = (python::environment()?, emptied(outside("packages"))?);
    let mut manifest = MANIFEST.to_owned();
    for name in files_in(&packages)?
        .iter()
        .filter_map(|name| name.strip_suffix(".crate"))
    {
        unpack(&python, &packages, name, &outside)?;
        let bare = name.rsplit_once('-').map_or(name, |(bare, _)| bare);
        manifest += &format!("{bare} = {{ path = \"{name}\" }}\n");
    }
    let alone = unpack(&python, &packages, "platewash-0.1.0", &outside.join("alone"))?.join("Cargo.toml");
    let renamed = fs::read_to_string(&alone)?.replacen("name = \"platewash\"", "name = \"platewash-alone\"", 1);
    fs::write(alone, renamed)?;
    manifest += &profiles(&fs::read_to_string(root().join("Cargo.toml"))?);
    fs::write(outside.join("Cargo.toml"), manifest)?;
    fs::create_dir(outside.join("src"))?;
    fs::write(outside.join("src/main.rs"), PROGRAM)?;
    fs::copy(root().join("Cargo.lock"), outside.join("Cargo.lock"))?;
    let step = Step::cargo("program that uses the packages", &["check", "--release", "--offline"]);
    step.at(&outside).with("CARGO_TARGET_DIR", target()).run()?;
    emptied(outside).map(drop)
}

/// Unpacks a package, by Python, into a folder, and returns the package's own folder in it.
fn unpack(python: &Path, packages: &Path, name: &str, folder: &Path) -> Result<PathBuf> {
    let file = packages.join(format!("{name}.crate"));
    let line = ["-m", "tarfile", "-e", &text(&file), &text(folder)];
    Step::program("package unpacked", python, &line).run()?;
    // Packages of an earlier state have the same version and times: cargo must not take them for these.
    for entry in ["src/lib.rs", "lib.rs"].map(|entry| folder.join(name).join(entry)) {
        if entry.exists() {
            fs::File::options()
                .write(true)
                .open(entry)?
                .set_modified(SystemTime::now())?;
        }
    }
    Ok(folder.join(name))
}

/// The profiles of a manifest. With those of the workspace, nothing that was checked for it is checked again.
fn profiles(manifest: &str) -> String {
    let sections = manifest.split("\n[").filter(|section| section.starts_with("profile."));
    sections.map(|section| format!("\n[{section}\n")).collect()
}

/// Names of the files in a folder; empty where there is no folder.
fn files_in(folder: &Path) -> Result<Vec<String>> {
    let mut names = Vec::new();
    if folder.exists() {
        for entry in fs::read_dir(folder).with_context(|| folder.display().to_string())? {
            names.push(entry?.file_name().to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}
