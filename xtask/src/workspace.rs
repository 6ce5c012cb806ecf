//! The packages of the workspace, as their manifests state them.

use anyhow::{Context, Result};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// One package.
#[derive(Debug)]
pub struct Package {
    /// Its name.
    pub name: String,
    /// Its folder.
    pub folder: PathBuf,
    /// The root files of its library and its programs.
    pub roots: Vec<PathBuf>,
    /// What it depends on: not what its tests, its benchmarks or its build need.
    pub dependencies: BTreeSet<String>,
}

/// All packages of the workspace at a folder, in the order of its manifest.
///
/// # Errors
/// A manifest that cannot be read.
pub fn packages(root: &Path) -> Result<Vec<Package>> {
    let members = manifest(root)?;
    let members = members.get("workspace").and_then(|workspace| workspace.get("members"));
    let members = members
        .and_then(Value::as_array)
        .context("Cargo.toml has no [workspace] members")?;
    let folders = members.iter().filter_map(Value::as_str);
    folders.map(|folder| package(&folder_of(root, folder))).collect()
}

fn folder_of(root: &Path, member: &str) -> PathBuf {
    if member == "." {
        root.to_owned()
    } else {
        root.join(member)
    }
}

fn manifest(folder: &Path) -> Result<Table> {
    let file = folder.join("Cargo.toml");
    let text = std::fs::read_to_string(&file).with_context(|| file.display().to_string())?;
    text.parse().with_context(|| file.display().to_string())
}

fn package(folder: &Path) -> Result<Package> {
    let manifest = manifest(folder)?;
    let name = manifest
        .get("package")
        .and_then(|package| package.get("name"))
        .and_then(Value::as_str);
    let name = name
        .with_context(|| format!("{}: no name", folder.display()))?
        .to_owned();
    Ok(Package {
        name,
        folder: folder.to_owned(),
        roots: roots(folder, &manifest)?,
        dependencies: dependencies(&manifest),
    })
}

/// Root files, those that cargo finds by itself and those that the manifest names.
fn roots(folder: &Path, manifest: &Table) -> Result<Vec<PathBuf>> {
    let mut roots: BTreeSet<PathBuf> = ["src/lib.rs", "src/main.rs"].map(|name| folder.join(name)).into();
    let programs = folder.join("src/bin");
    if programs.is_dir() {
        for entry in std::fs::read_dir(&programs).with_context(|| programs.display().to_string())? {
            let place = entry?.path();
            roots.insert(if place.is_dir() { place.join("main.rs") } else { place });
        }
    }
    let named = manifest
        .get("bin")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
        .chain(manifest.get("lib"));
    roots.extend(named.filter_map(|target| Some(folder.join(target.get("path")?.as_str()?))));
    Ok(roots.into_iter().filter(|root| root.is_file()).collect())
}

/// Names under `[dependencies]`, on every machine or on some.
pub fn dependencies(manifest: &Table) -> BTreeSet<String> {
    let machines = manifest
        .get("target")
        .and_then(Value::as_table)
        .into_iter()
        .flat_map(Table::values);
    let tables = machines
        .filter_map(|machine| machine.get("dependencies"))
        .chain(manifest.get("dependencies"));
    tables
        .filter_map(Value::as_table)
        .flat_map(Table::keys)
        .cloned()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependencies_are_those_of_the_library() {
        let manifest = "[dependencies]\na.workspace = true\nb = '1'\n[dependencies.c]\npath = 'c'\n[dev-dependencies]\nd = '1'\n\
                        [build-dependencies]\ne = '1'\n[target.'cfg(unix)'.dependencies]\nf = '1'\n";
        let found = dependencies(&manifest.parse().unwrap());
        assert_eq!(found.into_iter().collect::<Vec<_>>(), ["a", "b", "c", "f"]);
    }

    #[test]
    fn every_root_of_this_workspace_is_found() {
        let root = platewash_bundler::root();
        let found: Vec<PathBuf> = packages(&root)
            .unwrap()
            .into_iter()
            .flat_map(|package| package.roots)
            .collect();
        for wanted in [
            "src/lib.rs",
            "src/main.rs",
            "crates/kinematics/src/lib.rs",
            "xtask/src/main.rs",
            "benches/problems/src/lib.rs",
        ] {
            assert!(found.contains(&root.join(wanted)), "{wanted} is not among {found:?}");
        }
    }
}
