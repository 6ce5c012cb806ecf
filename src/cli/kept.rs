//! The file that `edit` saves a scenario to, and what is written beside it.

use super::details::whole;
use super::failure::Failure;
use super::options::Options;
use super::output::{self, File};
use super::{infeasible, page, wash};
use anyhow::{Context, anyhow};
use platewash::certificate::prove_with;
use platewash::editor::{Keeper, NotWritten, Save, Written};
use platewash::scenario::ScenarioSource;
use platewash::viewer::bundle::Bundle;
use platewash::viewer::view::Beside;
use platewash::workcell::words::counted;
use platewash::{CancelToken, Scenario, WashReport};
use std::ffi::OsString;
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// What stands behind the scenario's own name in the names of the files beside it, which belong to it: those that a save does not write
/// are removed, so that no proof of an earlier one stays.
const BESIDE: [&str; 5] = [
    "plan.json",
    "certificate.json",
    "report.json",
    "report.txt",
    "page.html",
];

/// Longest file that is read \[bytes\]: longer ones are no scenarios.
const MAX_BYTES: u64 = 1 << 20;

/// Where a save writes.
#[derive(Debug, Clone)]
pub struct Place {
    file: PathBuf,
    /// Whether what stands there is what is edited: no other file to write over, and nothing overridden.
    is_scenario: bool,
    /// Its folder or that of `--out`, and its name without an ending.
    beside: (PathBuf, OsString),
}

impl Place {
    /// The file of a scenario, or another one where that is asked for.
    ///
    /// # Errors
    /// [`Failure`]: files cannot be written there.
    pub fn new(options: &Options, source: &ScenarioSource, save_as: Option<&Path>) -> Result<Self, Failure> {
        let named = match (save_as, &source.file) {
            (Some(file), _) => file.to_owned(),
            (None, Some(file)) => file.clone(),
            (None, None) => PathBuf::from(format!("{}.toml", source.name)),
        };
        // A link stays a link: what it leads to is written.
        let file = named.canonicalize().unwrap_or_else(|_| named.clone());
        let name = file.file_stem().filter(|_| !file.is_dir()).map(ToOwned::to_owned);
        let name =
            name.ok_or_else(|| Failure::input(anyhow!("--save-as {}: is no name of a file", named.display())))?;
        let folder = options.out.clone().or_else(|| file.parent().map(Path::to_owned));
        let is_own = |own: &PathBuf| own.canonicalize().is_ok_and(|own| own == file);
        let place = Self {
            beside: (folder.unwrap_or_default(), name),
            is_scenario: options.seed.is_none() && (save_as.is_none() || source.file.as_ref().is_some_and(is_own)),
            file,
        };
        let beside = BESIDE.iter().map(|ending| place.beside(ending));
        output::check_places(&[place.file.clone()].into_iter().chain(beside).collect::<Vec<_>>())?;
        if source.file.is_none() && save_as.is_none() && place.file.exists() {
            let words = format!(
                "{} is there already: it is what is edited, and not the shipped {}; --save-as takes another file",
                place.words(),
                source.name
            );
            output::message(options.quiet, &words);
        }
        Ok(place)
    }

    /// The file in words.
    pub fn words(&self) -> String {
        self.file.display().to_string()
    }

    fn beside(&self, ending: &str) -> PathBuf {
        let (folder, name) = &self.beside;
        let mut name = name.clone();
        name.push(".");
        name.push(ending);
        folder.join(name)
    }
}

/// The file.
#[derive(Debug)]
pub struct ScenarioFile {
    place: Place,
    /// What a save has to know of how the command was called.
    options: Options,
    bundle: Bundle,
}

impl ScenarioFile {
    /// The file there.
    pub fn new(options: &Options, place: Place, bundle: &Bundle) -> Self {
        Self {
            place,
            options: Options {
                quiet: true,
                ..options.clone()
            },
            bundle: bundle.clone(),
        }
    }

    /// Writes the text with what comes of it, and says what that is. The scenario goes first: where it cannot be written, nothing is.
    fn save(
        &self,
        save: &Save<'_>,
        still: &dyn Fn() -> bool,
        cancel: &CancelToken,
    ) -> Result<Option<Written>, Failure> {
        let options = Options {
            cancel: cancel.clone(),
            ..self.options.clone()
        };
        let before = fs::metadata(&self.place.file).ok().map(|file| file.permissions());
        if before.as_ref().is_some_and(fs::Permissions::readonly) {
            return Err(Failure::input(anyhow!("{}: is read-only", self.place.words())));
        }
        let (products, words) = self.products(&options, save)?;
        let mut files = vec![output::file(self.place.file.clone(), save.text)];
        files.extend(products);
        let is_written = |path: &PathBuf| files.iter().any(|(written, _)| written == path);
        let earlier = BESIDE.iter().map(|ending| self.place.beside(ending));
        let earlier: Vec<_> = earlier.filter(|path| path.is_file()).collect();
        let removed = earlier.iter().filter(|path| !is_written(path)).count();
        if !output::replace_if(&files, &earlier, cancel, still)? {
            return Ok(None);
        }
        // A new file has the mode of new files; this one has been here before.
        if let Some(mode) = before {
            let kept = fs::set_permissions(&self.place.file, mode);
            kept.with_context(|| format!("{}: is written, but its mode cannot be kept", self.place.words()))
                .map_err(Failure::input)?;
        }
        let removed = match removed {
            0 => String::new(),
            _ => format!("; {} of an earlier save removed", counted(removed, "file")),
        };
        let files = files.iter().map(|(path, _)| path.display().to_string());
        Ok(Some(Written {
            files: files.collect(),
            words: format!("{words}{removed}"),
        }))
    }

    /// Plan, certificate, report and page; the report alone where there is no plan, nothing where nothing is planned.
    fn products(&self, options: &Options, save: &Save<'_>) -> Result<(Vec<File<'static>>, String), Failure> {
        let scenario = match save.scenario {
            Ok(scenario) => scenario,
            Err(words) => return Ok((Vec::new(), format!("without a plan: {words}"))),
        };
        match wash::plan(options, scenario) {
            Ok(washing) => self.of_plan(options, scenario, washing),
            Err(failure) if failure.is_cancelled() => Err(failure.into()),
            Err(failure) => self.of_failure(scenario, &failure),
        }
    }

    fn of_plan(
        &self,
        options: &Options,
        scenario: &Scenario,
        washing: wash::Washing,
    ) -> Result<(Vec<File<'static>>, String), Failure> {
        let (plan, arm) = (&washing.planned.plan, &washing.arm);
        let certificate = prove_with(plan, arm, &options.cancel).map_err(platewash::Failure::from)?;
        let region = scenario.task_region();
        let beside = Beside {
            certificate: Some(&certificate),
            region: Some(&region),
            ..Beside::default()
        };
        let page = page::html(plan, arm, &beside, &self.bundle).map_err(Failure::internal)?;
        let proof = output::json(&certificate)?;
        let json = plan.to_json().map_err(platewash::Failure::from)?;
        let report = WashReport::new(&washing.planned, &washing.findings, certificate);
        let files = vec![
            output::file(self.place.beside("plan.json"), json),
            output::file(self.place.beside("certificate.json"), proof),
            output::file(self.place.beside("report.json"), output::json(&report)?),
            output::file(self.place.beside("report.txt"), whole(&report)),
            output::file(self.place.beside("page.html"), page),
        ];
        Ok((files, report.headline))
    }

    fn of_failure(
        &self,
        scenario: &Scenario,
        failure: &platewash::Failure,
    ) -> Result<(Vec<File<'static>>, String), Failure> {
        let Some(report) = infeasible::report(scenario, failure) else {
            return Ok((Vec::new(), format!("without a plan: {failure}")));
        };
        let files = vec![
            output::file(self.place.beside("report.json"), output::json(&report)?),
            output::file(self.place.beside("report.txt"), whole(&report)),
        ];
        Ok((files, report.headline))
    }
}

impl Keeper for ScenarioFile {
    fn file(&self) -> String {
        self.place.words()
    }

    fn is_scenario(&self) -> bool {
        self.place.is_scenario
    }

    fn on_disk(&self) -> Result<Option<Vec<u8>>, String> {
        match fs::metadata(&self.place.file) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(format!("{}: cannot be read: {error}", self.place.words())),
            // What is none may never end.
            Ok(found) if !found.is_file() => return Err(format!("{}: is no regular file", self.place.words())),
            Ok(_) => {}
        }
        let mut bytes = Vec::new();
        let read = fs::File::open(&self.place.file).and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes));
        read.map_err(|error| format!("{}: cannot be read: {error}", self.place.words()))?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(format!(
                "{}: is longer than {MAX_BYTES} bytes, the most that are read",
                self.place.words()
            ));
        }
        Ok(Some(bytes))
    }

    fn write(&self, save: &Save<'_>, still: &dyn Fn() -> bool, cancel: &CancelToken) -> Result<Written, NotWritten> {
        match self.save(save, still, cancel) {
            Ok(Some(written)) => Ok(written),
            Ok(None) => Err(NotWritten::Changed),
            Err(Failure::Interrupted) => Err(NotWritten::Cannot("given up: nothing was written".to_owned())),
            Err(Failure::Wrong { error, .. }) => Err(NotWritten::Cannot(format!("{error:#}"))),
        }
    }
}
