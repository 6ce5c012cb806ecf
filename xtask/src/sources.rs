//! What command and wheel are compiled from, by cargo's own account.

use anyhow::{Context, Result, bail};
use platewash_bundler::{bundle, root, target};
use std::fs::File;
use std::path::{Path, PathBuf};

/// Fails unless a folder holds, byte for byte, every file of the checkout that the extension was compiled from. Gives each the checkout's
/// time of change, from which cargo tells what to build again: a package states one time for all.
pub fn all_in(folder: &Path) -> Result<()> {
    let mut files = files_of(&account())?;
    // The bundle of the page, too, so that a build of the package needs no Node.
    let bundle = bundle().strip_prefix(root())?.to_owned();
    collect(&root(), bundle, &mut files)?;
    for file in &files {
        let read = |place: &Path| {
            std::fs::read(place.join(file)).with_context(|| format!("{} in {}", file.display(), place.display()))
        };
        if read(folder)? != read(&root())? {
            bail!("{} is another file in {}", file.display(), folder.display());
        }
        let changed = root().join(file).metadata()?.modified()?;
        File::options()
            .write(true)
            .open(folder.join(file))?
            .set_modified(changed)?;
    }
    println!("    {} source files are the checkout's", files.len());
    Ok(())
}

/// The files of the checkout, relative to its root, that command and extension are compiled from.
pub fn compiled() -> Result<Vec<PathBuf>> {
    let mut files = [files_of("platewash.d")?, files_of(&account())?].concat();
    files.sort();
    files.dedup();
    Ok(files)
}

/// The files of the checkout, relative to its root, that an account of the release build names.
fn files_of(account: &str) -> Result<Vec<PathBuf>> {
    let account = target().join("release").join(account);
    let text = std::fs::read_to_string(&account).with_context(|| account.display().to_string())?;
    let mut files = Vec::new();
    for named in compiled_from(&text, &root())? {
        // What build scripts made is made again from a package.
        if !root().join(&named).starts_with(target()) {
            collect(&root(), named, &mut files)?;
        }
    }
    Ok(files)
}

/// A file of `root`, or all in a folder of it: build scripts name folders, too.
pub fn collect(root: &Path, named: PathBuf, files: &mut Vec<PathBuf>) -> Result<()> {
    let place = root.join(&named);
    if !place.is_dir() {
        files.push(named);
        return Ok(());
    }
    for entry in std::fs::read_dir(&place).with_context(|| place.display().to_string())? {
        collect(root, named.join(entry?.file_name()), files)?;
    }
    Ok(())
}

/// The file beside the extension in which cargo says what it was compiled from.
fn account() -> String {
    format!("{}_core.d", std::env::consts::DLL_PREFIX)
}

/// The files of `root`, relative to it, that an account names: `target: file file …`, with spaces in names escaped.
fn compiled_from(account: &str, root: &Path) -> Result<Vec<PathBuf>> {
    let unescaped = |name: &str| PathBuf::from(name.replace('\u{0}', " "));
    let account = account.replace("\\ ", "\u{0}");
    let Some((_, files)) = account.trim().split_once(": ") else {
        bail!("no list of files in: {account}");
    };
    let files = files.split(' ').filter(|name| !name.is_empty()).map(unescaped);
    let files: Vec<PathBuf> = files
        .filter_map(|file| Some(file.strip_prefix(root).ok()?.to_owned()))
        .collect();
    if files.is_empty() {
        bail!("no file of {} in: {account}", root.display());
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependency_files_name_sources_of_the_checkout() {
        let account =
            "/here/a\\ b/target/lib_core.so: /here/a\\ b/src/lib.rs /elsewhere/x.rs /here/a\\ b/urdf/arm.urdf\n";
        let files = compiled_from(account, Path::new("/here/a b")).unwrap();
        assert_eq!(files, [PathBuf::from("src/lib.rs"), PathBuf::from("urdf/arm.urdf")]);
    }

    #[test]
    fn a_folder_stands_for_all_its_files() {
        let root = tempfile::tempdir().unwrap();
        for name in ["a/b/c.ts", "a/d.ts", "e.rs"] {
            let place = root.path().join(name);
            std::fs::create_dir_all(place.parent().unwrap()).unwrap();
            std::fs::write(place, "").unwrap();
        }
        let mut files = Vec::new();
        for named in ["a", "e.rs"] {
            collect(root.path(), named.into(), &mut files).unwrap();
        }
        files.sort();
        assert_eq!(files, ["a/b/c.ts", "a/d.ts", "e.rs"].map(PathBuf::from));
    }

    #[test]
    fn an_empty_dependency_file_is_an_error() {
        for account in ["", "lib_core.so:", "lib_core.so: /elsewhere/x.rs"] {
            assert!(compiled_from(account, Path::new("/here")).is_err(), "{account}");
        }
    }
}
