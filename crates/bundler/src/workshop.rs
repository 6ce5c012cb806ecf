//! A copy of the page's sources with the packages that they need: whatever is fetched stays out of the sources.

use crate::node::{Node, Packages};
use crate::run::run;
use crate::stamp;
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

const PACKAGES: &str = "node_modules";

/// A copy of the page's sources.
#[derive(Debug)]
pub struct Workshop {
    what: &'static str,
    folder: PathBuf,
}

impl Workshop {
    /// `what` is what messages call it. Copies a folder's files, all but its packages, in place of those that were copied there before. Packages that were fetched
    /// stay.
    pub fn new(what: &'static str, sources: &Path, folder: PathBuf) -> Result<Self> {
        fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        for entry in fs::read_dir(&folder).with_context(|| folder.display().to_string())? {
            let entry = entry?;
            if entry.file_name() != PACKAGES {
                removed(&entry.path())?;
            }
        }
        copied(sources, &folder)?;
        Ok(Self { what, folder })
    }

    /// Path of the copied sources.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Fetches the packages of the lock file, unless they are there; none of their own programs runs.
    pub fn fetch(&self, node: &Node, packages: Packages) -> Result<()> {
        /// Longest time to fetch the packages.
        const LONGEST: Duration = Duration::from_secs(180);
        let read = |name: &str| {
            let file = self.folder.join(name);
            fs::read_to_string(&file).with_context(|| file.display().to_string())
        };
        let lock = read("package.json")? + &read("package-lock.json")?;
        let with_all = format!("{lock}with all");
        let note = self.folder.join(PACKAGES).join(".fetched");
        let found = fs::read_to_string(&note).unwrap_or_default();
        if found == with_all || (found == lock && packages == Packages::Bundled) {
            return Ok(());
        }
        let line = "ci --ignore-scripts --no-audit --no-fund --no-update-notifier --fetch-retries=1 --fetch-retry-mintimeout=1000 \
                    --fetch-timeout=60000";
        let mut npm = node.npm(&self.folder, &line.split(' ').collect::<Vec<_>>());
        if packages == Packages::Bundled {
            npm.arg("--omit=dev");
        }
        if run("packages", &mut npm, LONGEST).is_err() {
            bail!(
                "npm cannot fetch the packages of {}: connect to a network, then run this again",
                self.what
            );
        }
        let text = if packages == Packages::All { with_all } else { lock };
        // A list without packages leaves no folder.
        fs::create_dir_all(self.folder.join(PACKAGES)).with_context(|| note.display().to_string())?;
        fs::write(&note, text).with_context(|| note.display().to_string())
    }

    /// Makes the bundle in a folder of its own, with its stamp: that of the copied sources.
    pub fn bundle(&self, node: &Node, folder: &Path) -> Result<()> {
        const LONGEST: Duration = Duration::from_secs(60);
        removed(folder)?;
        let place = folder.to_string_lossy();
        run(
            "page",
            &mut node.node(&self.folder, &["build.mjs", "--out", &place]),
            LONGEST,
        )?;
        for name in stamp::FILES {
            if !folder.join(name).is_file() {
                bail!("crates/viewer/page/build.mjs makes no {name}");
            }
        }
        let text = stamp::compute(&self.folder)? + "\n";
        fs::write(folder.join(stamp::STAMP), text).with_context(|| folder.display().to_string())
    }
}

/// Copies a file, or a folder with all but its fetched packages.
pub fn copied(from: &Path, to: &Path) -> Result<()> {
    if !from.is_dir() {
        return fs::copy(from, to).map(drop).with_context(|| from.display().to_string());
    }
    fs::create_dir_all(to).with_context(|| to.display().to_string())?;
    for entry in fs::read_dir(from).with_context(|| from.display().to_string())? {
        let name = entry?.file_name();
        if name != PACKAGES {
            copied(&from.join(&name), &to.join(name))?;
        }
    }
    Ok(())
}

/// Removes a file or a folder, if it is there.
pub fn removed(place: &Path) -> Result<()> {
    let gone = match fs::symlink_metadata(place) {
        Err(_) => Ok(()),
        Ok(found) if found.is_dir() => fs::remove_dir_all(place),
        Ok(_) => fs::remove_file(place),
    };
    gone.with_context(|| place.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_has_the_sources_and_keeps_its_packages() {
        let (sources, copy) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let write = |place: PathBuf| {
            fs::create_dir_all(place.parent().unwrap()).unwrap();
            fs::write(place, "").unwrap();
        };
        for name in ["package.json", "src/main.ts", ".npmrc", "node_modules/of/sources.js"] {
            write(sources.path().join(name));
        }
        for name in ["old.json", "src/old.ts", "node_modules/of/copy.js"] {
            write(copy.path().join(name));
        }
        Workshop::new("the page", sources.path(), copy.path().to_owned()).unwrap();
        for name in ["package.json", "src/main.ts", ".npmrc", "node_modules/of/copy.js"] {
            assert!(copy.path().join(name).is_file(), "{name}");
        }
        for name in ["old.json", "src/old.ts", "node_modules/of/sources.js"] {
            assert!(!copy.path().join(name).exists(), "{name}");
        }
    }
}
