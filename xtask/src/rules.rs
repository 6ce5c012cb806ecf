//! Rules of the code that no compiler checks, held against the checkout.

use crate::workspace::{Package, packages};
use crate::{floors, map, rings};
use anyhow::{Context, Result, bail};
use platewash_bundler::root;
use std::path::{Path, PathBuf};

/// What breaks a rule, each as text.
type Findings = Result<Vec<String>>;

/// Fails where any of the rules is broken, with all that breaks one.
pub fn kept() -> Result<()> {
    let root = root();
    let packages = packages(&root)?;
    let rules = [
        ("modules in rings", in_rings(&root, &packages)),
        ("crates on the wrong floor", misplaced(&root, &packages)),
        (
            "the scenario's types outside of its crate",
            foreign_types(&root, &packages)?,
        ),
        ("crates too large", too_large(&root, &packages)?),
        ("docs/architecture.md", map::wrong(&root, &packages)?),
    ];
    judge(&rules)
}

/// Fails where modules import each other in a ring.
pub fn no_rings() -> Result<()> {
    let root = root();
    judge(&[("modules in rings", in_rings(&root, &packages(&root)?))])
}

fn judge(rules: &[(&str, Vec<String>)]) -> Result<()> {
    let mut broken = 0;
    for (rule, findings) in rules {
        println!(
            "\n==> {rule}: {}",
            if findings.is_empty() {
                "none".to_owned()
            } else {
                findings.len().to_string()
            }
        );
        findings.iter().for_each(|finding| println!("{finding}"));
        broken += findings.len();
    }
    match broken {
        0 => Ok(()),
        _ => bail!("{broken} findings where the code does not keep to its own rules"),
    }
}

/// A crate that cannot be read is one finding, so that the others are still looked at.
fn in_rings(root: &Path, packages: &[Package]) -> Vec<String> {
    let mut found = Vec::new();
    for package in packages {
        for file in &package.roots {
            let rings = rings::read(file, &text);
            let rings = rings.map(|modules| [rings::rings(&modules, root), rings::lost(&modules, root)].concat());
            let rings = rings.unwrap_or_else(|error| vec![format!("cannot be read: {error:#}")]);
            found.extend(rings.into_iter().map(|ring| format!("{}: {ring}", package.name)));
        }
    }
    found
}

/// Packages of the product: those of `crates/`, and the root package.
fn product<'a>(root: &Path, packages: &'a [Package]) -> impl Iterator<Item = &'a Package> {
    let crates = root.join("crates");
    let root = root.to_owned();
    packages
        .iter()
        .filter(move |package| package.folder == root || package.folder.starts_with(&crates))
}

fn misplaced(root: &Path, packages: &[Package]) -> Vec<String> {
    let product = product(root, packages);
    product
        .flat_map(|package| floors::misplaced(&package.name, &package.dependencies))
        .collect()
}

fn foreign_types(root: &Path, packages: &[Package]) -> Findings {
    let mut found = Vec::new();
    for package in product(root, packages).filter(|package| package.folder != root) {
        for file in sources(&package.folder)? {
            let place = file.strip_prefix(root).unwrap_or(&file).display().to_string();
            let source = std::fs::read_to_string(&file).with_context(|| place.clone())?;
            let types = floors::foreign_types(&package.name, &source);
            let types = types.map_err(|error| anyhow::anyhow!("{place}: {error}"))?;
            if !types.is_empty() {
                found.push(format!("{place} names {}", Vec::from_iter(types).join(", ")));
            }
        }
    }
    Ok(found)
}

/// Lines of what is compiled into the library and its programs: files for tests alone do not count.
fn too_large(root: &Path, packages: &[Package]) -> Findings {
    let mut lines = Vec::new();
    for package in product(root, packages) {
        let mut files: Vec<PathBuf> = Vec::new();
        for file in &package.roots {
            files.extend(rings::read(file, &text)?.files());
        }
        files.sort();
        files.dedup();
        let counted = files
            .iter()
            .filter_map(|file| text(file))
            .map(|text| text.lines().count());
        lines.push((package.name.clone(), counted.sum()));
    }
    Ok(floors::too_large(&lines))
}

fn text(file: &Path) -> Option<String> {
    std::fs::read_to_string(file).ok()
}

/// Every Rust file below a folder, in order.
fn sources(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut left = vec![folder.to_owned()];
    while let Some(at) = left.pop() {
        for entry in std::fs::read_dir(&at).with_context(|| at.display().to_string())? {
            let place = entry?.path();
            if place.is_dir() {
                left.push(place);
            } else if place.extension().is_some_and(|extension| extension == "rs") {
                files.push(place);
            }
        }
    }
    files.sort();
    Ok(files)
}
