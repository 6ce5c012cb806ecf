//! The description of another arm: a file, or a name that is looked up where ROS has packages installed; xacro files are expanded by `xacro`.

use anyhow::{Result, bail};
use platewash::kinematics::urdf::Files;
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A description: its file, and the arguments that `xacro` takes with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Description {
    pub file: PathBuf,
    pub arguments: Vec<String>,
}

/// Folders of a package that hold descriptions, and the ends of their names, those that need no expansion first.
const FOLDERS: [&str; 2] = ["urdf", "robots"];
const ENDS: [&str; 3] = [".urdf", ".urdf.xacro", ".xacro"];

/// Arms whose file has another name or needs arguments: name, package, file, arguments.
const KNOWN: [(&str, &str, &str, &[&str]); 3] = [
    ("gen3", "kortex_description", "robots/gen3.xacro", &["dof:=6"]),
    (
        "xarm6",
        "xarm_description",
        "urdf/xarm_device.urdf.xacro",
        &["dof:=6", "robot_type:=xarm"],
    ),
    (
        "lite6",
        "xarm_description",
        "urdf/xarm_device.urdf.xacro",
        &["dof:=6", "robot_type:=lite"],
    ),
];

/// Returns the description of an arm by name, from the packages in the folders that the environment states.
///
/// # Errors
/// No description, or several: with what was looked for, or the files.
pub fn find(name: &str) -> Result<Description> {
    if name.is_empty() || name.contains(['/', '\\']) {
        bail!("--arm {name:?}: must be the name of an arm, such as ur5e; a file is given as '--urdf ARM.urdf'");
    }
    let folders = installed_folders();
    let packages: Vec<PathBuf> = folders.iter().flat_map(|folder| packages(folder)).collect();
    // Of packages with the same name the first counts, as in ROS.
    let mut names = BTreeSet::new();
    let first = packages.iter().filter(|package| names.insert(package.file_name()));
    let found: Vec<Description> = first.filter_map(|package| in_package(package, name)).collect();
    match &found[..] {
        [one] => Ok(one.clone()),
        [] => bail!(
            "--arm {name}: no package has urdf/{name}.urdf, urdf/{name}.xacro or the same in robots/; looked in {} packages of \
             ROS_PACKAGE_PATH and AMENT_PREFIX_PATH{}. Install its ROS description, or give the file: '--urdf ARM.urdf'",
            packages.len(),
            if folders.is_empty() { ", which are not set" } else { "" }
        ),
        several => {
            let files: Vec<_> = several.iter().map(|one| one.file.display().to_string()).collect();
            bail!(
                "--arm {name}: several descriptions: {}; give one as '--urdf FILE'",
                files.join(", ")
            )
        }
    }
}

/// Packages in a folder, by name, and the folder itself where it is one.
fn packages(folder: &Path) -> Vec<PathBuf> {
    let inside = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut all: Vec<_> = inside.map(|entry| entry.path()).filter(|path| path.is_dir()).collect();
    all.sort_unstable();
    all.push(folder.to_owned());
    all
}

fn in_package(package: &Path, name: &str) -> Option<Description> {
    let of = |file: PathBuf, arguments: &[&str]| {
        let arguments = arguments.iter().map(|&argument| argument.to_owned()).collect();
        file.is_file().then_some(Description { file, arguments })
    };
    let known = KNOWN
        .iter()
        .find(|(arm, of_package, ..)| *arm == name && package.ends_with(of_package));
    if let Some((.., file, arguments)) = known {
        return of(package.join(file), arguments);
    }
    // Universal Robots has one file for all arms, and a folder with the numbers of each.
    if package
        .join("config")
        .join(name)
        .join("physical_parameters.yaml")
        .is_file()
    {
        let [name, kind] = ["name", "ur_type"].map(|key| format!("{key}:={name}"));
        return of(package.join("urdf/ur.urdf.xacro"), &[&name, &kind]);
    }
    let files = FOLDERS
        .iter()
        .flat_map(|folder| ENDS.map(|end| package.join(folder).join(format!("{name}{end}"))));
    files.into_iter().find_map(|file| of(file, &[]))
}

/// Returns the text of a xacro file, expanded by `xacro`.
///
/// # Errors
/// `xacro` is not installed, or refuses the file: with its words.
pub fn expand(description: &Description) -> Result<String> {
    let Description { file, arguments } = description;
    let shown = file.display();
    let ran = match Command::new("xacro").arg(file).args(arguments).output() {
        Ok(ran) => ran,
        Err(error) if error.kind() == ErrorKind::NotFound => bail!(
            "{shown}: is expanded by xacro, which is not installed here: install it ('pip install xacro', or with ROS), or expand the file \
             elsewhere and give the result as '--urdf ARM.urdf'"
        ),
        Err(error) => bail!("{shown}: xacro cannot be run: {error}"),
    };
    if !ran.status.success() {
        let words = String::from_utf8_lossy(&ran.stderr);
        let last: Vec<_> = words.lines().rev().take(3).collect();
        let last: Vec<_> = last.into_iter().rev().map(str::trim).collect();
        bail!(
            "{shown}: xacro cannot expand it (arguments are given as '--xacro-arg NAME:=VALUE'): {}",
            last.join("; ")
        );
    }
    String::from_utf8(ran.stdout).map_err(|_| anyhow::anyhow!("{shown}: xacro printed what is not UTF-8"))
}

/// Source of the files of an arm: the disk, with the folders in which ROS has packages installed, as the environment states them:
/// ROS_PACKAGE_PATH, and the `share` folder of each prefix in AMENT_PREFIX_PATH.
#[must_use]
pub fn installed_files() -> Files {
    Files::default().with_installed(installed_folders())
}

/// Folders in which ROS has packages installed, as the environment states them.
pub fn installed_folders() -> Vec<PathBuf> {
    let folders = |name: &str| -> Vec<PathBuf> {
        let list = std::env::var_os(name).unwrap_or_default();
        std::env::split_paths(&list)
            .filter(|path| !path.as_os_str().is_empty())
            .collect()
    };
    let prefixes = folders("AMENT_PREFIX_PATH").into_iter();
    let shares = prefixes.map(|prefix| prefix.join("share"));
    folders("ROS_PACKAGE_PATH").into_iter().chain(shares).collect()
}
