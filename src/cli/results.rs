//! The files of `run` and `plan`: they own their names in the output folder, so that no proof of an earlier call stays beside
//! a new result.

use super::failure::Failure;
use super::options::Options;
use super::output::{self, File};
use std::path::{Path, PathBuf};

/// Folder that is written to without `--out`.
const DEFAULT_FOLDER: &str = "out";

/// Where files go.
pub fn folder(options: &Options) -> PathBuf {
    options.out.clone().unwrap_or_else(|| PathBuf::from(DEFAULT_FOLDER))
}

/// Names in the output folder that belong to `run` and `plan`, those that `simulate` writes of a plan there included.
pub const OWNED: [&str; 10] = [
    "plan.json",
    "trajectory.csv",
    "executed.csv",
    "certificate.json",
    "report.json",
    "report.txt",
    PAGE,
    "simulated.csv",
    "simulation.json",
    "simulation.txt",
];

/// The page that `run` writes.
pub const PAGE: &str = "page.html";

/// What `simulate` writes: the motion, and the report twice.
pub const SIMULATED: [&str; 3] = ["simulated.csv", "simulation.json", "simulation.txt"];

/// Writes the files of one call in place of all of [`OWNED`] in the folder. All or nothing, as [`output::write_files`].
pub fn write(options: &Options, files: &[File<'_>]) -> Result<(), Failure> {
    let earlier = OWNED.map(|name| folder(options).join(name));
    output::replace(files, &earlier, &options.cancel)
}

/// Says what was written.
pub fn name(options: &Options, files: &[File<'_>]) {
    let names: Vec<_> = files.iter().map(|(path, _)| path.display().to_string()).collect();
    output::message(options.quiet, &format!("wrote {}", names.join(", ")));
}

/// Refuses, before any work, a folder in which `names` of [`OWNED`] cannot be written, and a CSV that cannot be where it is asked
/// for.
pub fn check_places(options: &Options, names: &[&str], csv: &Path) -> Result<(), Failure> {
    let folder = folder(options);
    let named = names.iter().map(|name| folder.join(name));
    output::check_places(&named.chain([csv.to_owned()]).collect::<Vec<_>>())
}
