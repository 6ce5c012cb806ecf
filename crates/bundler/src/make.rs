//! The bundle, made where it is missing or old.

use crate::node::{Node, Packages};
use crate::place::{root, target};
use crate::stamp;
use crate::workshop::{Workshop, removed};
use anyhow::{Context, Result};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// Result of [`make`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The bundle was up to date; nothing was made.
    Fresh,
    /// The bundle was made.
    Made,
}

/// Folder of the page's sources.
pub fn sources() -> PathBuf {
    root().join("crates/viewer/page")
}

/// Folder of the page's bundle.
pub fn bundle() -> PathBuf {
    root().join("crates/viewer/dist")
}

/// Makes the bundle, unless the one that is there was made from these sources.
///
/// It is made beside its place and renamed, one call after the other: whoever reads the folder finds all of one bundle.
///
/// # Errors
/// No Node that is new enough, no network where packages are missing, a folder that cannot be written.
pub fn make() -> Result<Outcome> {
    let _alone = alone()?;
    let (sources, bundle) = (sources(), bundle());
    if stamp::found(&bundle) == Some(stamp::compute(&sources)?) {
        return Ok(Outcome::Fresh);
    }
    let node = Node::found(Packages::Bundled)?;
    let workshop = workshop()?;
    workshop.fetch(&node, Packages::Bundled)?;
    let new = bundle.with_file_name(".dist-new");
    workshop.bundle(&node, &new)?;
    replace(&bundle, &new)?;
    Ok(Outcome::Made)
}

/// The copy of the sources in which the bundle is made and checked. For one call at a time, see [`alone`].
///
/// # Errors
/// A folder that cannot be written.
pub fn workshop() -> Result<Workshop> {
    Workshop::new("the page", &sources(), target().join("page"))
}

/// Waits until no other call makes or checks the page; others wait until this is dropped.
///
/// # Errors
/// A lock file that cannot be made.
pub fn alone() -> Result<File> {
    let target = target();
    fs::create_dir_all(&target).with_context(|| target.display().to_string())?;
    let place = target.join("page.lock");
    let file = File::create(&place).with_context(|| place.display().to_string())?;
    file.lock().with_context(|| place.display().to_string())?;
    Ok(file)
}

/// Puts a folder in the place of another. No system renames onto a folder with files, so that the old one goes aside before.
fn replace(old: &Path, new: &Path) -> Result<()> {
    let aside = old.with_file_name(".dist-old");
    removed(&aside)?;
    if old.exists() {
        fs::rename(old, &aside).with_context(|| old.display().to_string())?;
    }
    fs::rename(new, old).with_context(|| new.display().to_string())?;
    removed(&aside)
}
