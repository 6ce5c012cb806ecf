//! The crates as packages: what they hold, and, before a release, whether a program can use them.

use crate::step::Step;
use crate::wheel::{emptied, outside, text};
use crate::{python, sources};
use anyhow::{Context, Result, bail};
use platewash_bundler::{root, target};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

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

/// A crate of the workspace.
#[derive(Debug, PartialEq, Eq)]
struct Member {
    name: String,
    /// Relative to the root of the repository; empty for the crate there.
    folder: PathBuf,
    is_published: bool,
}

/// Fails unless the package of each published crate holds all of the crate's files that command and wheel are compiled from.
pub fn complete() -> Result<()> {
    let crates = members()?;
    let files = sources::compiled()?;
    for one in crates.iter().filter(|one| one.is_published) {
        let line = ["package", "--list", "--allow-dirty", "--package", &one.name];
        let list = Step::cargo("files of a package", &line).output()?;
        if let Some(missing) = missing(one, &crates, &files, &list).first() {
            bail!(
                "the package of {} has no {}: add it to `include` in {}",
                one.name,
                missing.display(),
                one.folder.join("Cargo.toml").display()
            );
        }
    }
    println!("    the packages hold what is compiled from them");
    Ok(())
}

/// The crates of the workspace, by cargo's own account.
fn members() -> Result<Vec<Member>> {
    let line = ["metadata", "--no-deps", "--format-version", "1"];
    members_of(&Step::cargo("crates", &line).output()?)
}

/// The crates of cargo's account of the workspace.
fn members_of(metadata: &str) -> Result<Vec<Member>> {
    let metadata: Value = serde_json::from_str(metadata).context("cargo's account of the workspace")?;
    let packages = metadata["packages"]
        .as_array()
        .context("no packages in cargo's account")?;
    let mut crates = Vec::new();
    for package in packages {
        let text = |key: &str| package[key].as_str().with_context(|| format!("no {key} of a package"));
        let manifest = PathBuf::from(text("manifest_path")?);
        let place = manifest
            .strip_prefix(root())
            .context("a package outside of the checkout")?;
        crates.push(Member {
            name: text("name")?.to_owned(),
            folder: place.parent().unwrap_or(Path::new("")).to_owned(),
            // With `publish = false` the list of registries is empty; else there is none.
            is_published: package["publish"].is_null(),
        });
    }
    Ok(crates)
}

/// Files of a crate, relative to its folder, that are compiled and are not in the list of its package.
fn missing(one: &Member, crates: &[Member], files: &[PathBuf], list: &str) -> Vec<PathBuf> {
    let listed: Vec<PathBuf> = list.lines().map(PathBuf::from).collect();
    // A file belongs to the crate whose folder is the nearest around it.
    let is_ours = |file: &&PathBuf| {
        let around = crates.iter().filter(|other| file.starts_with(&other.folder));
        let nearest = around.max_by_key(|other| other.folder.components().count());
        nearest.is_some_and(|nearest| nearest == one)
    };
    let ours = files
        .iter()
        .filter(is_ours)
        .filter_map(|file| file.strip_prefix(&one.folder).ok());
    ours.filter(|file| !listed.iter().any(|listed| listed == file))
        .map(Path::to_owned)
        .collect()
}

/// Makes the packages, and checks a program that uses them in a folder without the workspace, and the library without what the command
/// needs. Then checks the extension in the unpacked source package.
pub fn used() -> Result<()> {
    let packages = target().join("package");
    for old in files_in(&packages)?.iter().filter(|name| name.ends_with(".crate")) {
        fs::remove_file(packages.join(old))?;
    }
    let crates = members()?;
    let published = crates.iter().filter(|one| one.is_published);
    let named = published.flat_map(|one| ["--package", &one.name]);
    let line = ["package", "--no-verify", "--allow-dirty", "--quiet"];
    let line: Vec<&str> = line.into_iter().chain(named).collect();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_a_package_lacks_is_found() {
        let one = |name: &str, folder: &str, is_published: bool| Member {
            name: name.to_owned(),
            folder: folder.into(),
            is_published,
        };
        let crates = [
            one("whole", "", true),
            one("part", "crates/part", true),
            one("private", "crates/private", false),
        ];
        let files = [
            "src/lib.rs",
            "crates/part/src/lib.rs",
            "crates/part/data.toml",
            "crates/private/src/lib.rs",
        ];
        let files = files.map(PathBuf::from);
        assert!(missing(&crates[0], &crates, &files, "Cargo.toml\nsrc/lib.rs\n").is_empty());
        let found = missing(&crates[1], &crates, &files, "Cargo.toml\nsrc/lib.rs\n");
        assert_eq!(found, [PathBuf::from("data.toml")]);
    }

    #[test]
    fn crates_that_are_not_published_are_known() {
        let manifest = |folder: &str| root().join(folder).join("Cargo.toml").display().to_string();
        let metadata = serde_json::json!({ "packages": [
            { "name": "whole", "manifest_path": manifest(""), "publish": null },
            { "name": "private", "manifest_path": manifest("private"), "publish": [] },
        ]});
        let found = members_of(&metadata.to_string()).unwrap();
        assert_eq!(
            found.iter().map(|one| one.is_published).collect::<Vec<_>>(),
            [true, false]
        );
        assert_eq!(
            (found[0].folder.as_path(), found[1].folder.as_path()),
            (Path::new(""), Path::new("private"))
        );
    }
}
