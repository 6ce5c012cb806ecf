//! `platewash edit`: a scenario on a page in the browser, changed by hand, planned and proved at once; and the file that it saves the scenario
//! to, with what is written beside it.

use super::failure::{self, ExitCode, internal};
use super::files::{Files, REPORTS, check_places};
use super::options::Options;
use super::output::json;
use super::page::{self, ServeArguments};
use super::run::wash;
use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use platewash::certificate::prove_with;
use platewash::editor::{Editor, Keeper, Save, SaveError, SaveReport};
use platewash::kinematics::urdf::file::{FileError, read_bytes};
use platewash::scenario::{Draft, ScenarioSource, source};
use platewash::server::cell_site;
use platewash::workcell::words::count_with_noun;
use platewash::{CancelToken, Failure, Scenario, WashReport};
use serde::Serialize;
use std::ffi::OsString;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Longest file that is read \[bytes\]: longer ones are no scenarios.
const MAX_BYTES: u64 = 1 << 20;

/// Arguments of `edit`.
#[derive(Debug, Args)]
pub struct EditArguments {
    /// File that Save writes [default: the scenario's own file; NAME.toml in the working folder for a shipped scenario]
    #[arg(long, value_name = "FILE")]
    save_as: Option<PathBuf>,
    #[command(flatten)]
    serve: ServeArguments,
}

/// Answer of `edit`.
#[derive(Debug, Serialize)]
struct Answer<'a> {
    url: &'a str,
    /// File that Save writes.
    file: String,
}

/// Serves the page of a scenario until the command is cancelled.
pub fn run(options: &Options, arguments: &EditArguments) -> Result<ExitCode> {
    ensure!(
        options.urdf.is_none(),
        "--urdf: the page edits a scenario, which names its arm itself: set robot.urdf (and robot.srdf, robot.package_path) in it"
    );
    ensure!(
        options.fix.is_empty(),
        "--fix: the page edits a scenario, which names its arm itself: set robot.fixed in it"
    );
    let source = source(options.scenario_name())?;
    let text = text(options, &source)?;
    let editor = Editor::of_text(&source.name, &text, source.folder.as_deref())?;
    let save_as = arguments.save_as.as_deref();
    refuse_other_folder(&source, save_as, &editor)?;
    let file = ScenarioFile::new(options, &source, save_as)?;
    let listener = arguments.serve.listen(options)?;
    let bundle = page::needed_bundle()?;
    let (url, saved_in) = (listener.url(), file.file());
    let editor = editor.with_keeper(Box::new(file));
    let editor = match arguments.serve.is_loopback() {
        true => editor,
        false => editor.open_to_others(),
    };
    let site = cell_site(editor, bundle).map_err(internal)?;
    // Behind the #, where browsers keep it to themselves.
    let token = site.service.as_ref().map(|service| service.token().to_owned());
    let answer = Answer {
        url: &format!("{url}#token={}", token.unwrap_or_default()),
        file: saved_in,
    };
    let server = listener.serve(site).map_err(internal)?;
    options.print(&answer, || format!("{}\n", answer.url))?;
    let _redirect = arguments.serve.open_privately(options, answer.url)?;
    options.say(&format!(
        "Save writes {}. Ctrl-C ends it; what is not saved stays in the page",
        answer.file
    ));
    options.wait();
    drop(server);
    Ok(ExitCode::Done)
}

/// The scenario's text, with what the options override.
fn text(options: &Options, source: &ScenarioSource) -> Result<String> {
    let Some(seed) = options.seed else {
        return Ok(source.text.clone());
    };
    let mut draft = Draft::new(&source.text)?;
    draft.set("seed", Some(&seed.into()))?;
    Ok(draft.text().to_owned())
}

/// Refuses to save a scenario elsewhere that names files relative to its folder: there, it would name others.
fn refuse_other_folder(source: &ScenarioSource, save_as: Option<&Path>, editor: &Editor) -> Result<()> {
    let Some(save_as) = save_as else { return Ok(()) };
    // A name alone has an empty folder.
    let in_full = |folder: Option<&Path>| Path::new(".").join(folder.unwrap_or(Path::new(""))).canonicalize().ok();
    if in_full(source.folder.as_deref()) == in_full(save_as.parent()) {
        return Ok(());
    }
    let stated = Draft::new(editor.text())?.stated();
    let is_relative = |value: &serde_json::Value| {
        let paths = value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice);
        let mut paths = paths.iter().filter_map(serde_json::Value::as_str);
        paths.any(|path| Path::new(path).is_relative())
    };
    for key in ["robot.urdf", "robot.srdf", "robot.package_path"] {
        ensure!(
            !stated.get(key).is_some_and(is_relative),
            "--save-as {}: {key} is relative to the scenario's folder, and would lead elsewhere from there; make it absolute first",
            save_as.display()
        );
    }
    Ok(())
}

/// The file that a save writes.
#[derive(Debug)]
struct ScenarioFile {
    file: PathBuf,
    /// True where that file is the scenario that is edited: Save writes over no other file, and no option overrides a key.
    is_scenario: bool,
    /// Folder of the reports, its own or that of `--out`, and the prefix of their names: its name without the extension, and a dot.
    beside: (PathBuf, OsString),
    /// Options of the command, made quiet; a save plans with them.
    options: Options,
}

impl ScenarioFile {
    /// The file of a scenario, or another one where that is asked for.
    ///
    /// # Errors
    /// Files cannot be written there.
    fn new(options: &Options, source: &ScenarioSource, save_as: Option<&Path>) -> Result<Self> {
        let named = match (save_as, &source.file) {
            (Some(file), _) => file.to_owned(),
            (None, Some(file)) => file.clone(),
            (None, None) => PathBuf::from(format!("{}.toml", source.name)),
        };
        // A link stays a link: what it leads to is written.
        let file = named.canonicalize().unwrap_or_else(|_| named.clone());
        let name = file.file_stem().filter(|_| !file.is_dir()).map(ToOwned::to_owned);
        let mut name = name.with_context(|| format!("--save-as {}: is not a file name", named.display()))?;
        name.push(".");
        let folder = options.out.clone().or_else(|| file.parent().map(Path::to_owned));
        let is_own = |own: &PathBuf| own.canonicalize().is_ok_and(|own| own == file);
        let kept = Self {
            beside: (folder.unwrap_or_default(), name),
            is_scenario: options.seed.is_none() && (save_as.is_none() || source.file.as_ref().is_some_and(is_own)),
            file,
            options: Options {
                quiet: true,
                ..options.clone()
            },
        };
        check_places(&[vec![kept.file.clone()], kept.files().places(&REPORTS)].concat())?;
        if source.file.is_none() && save_as.is_none() && kept.file.exists() {
            options.say(&format!(
                "{} is there already: it is what is edited, and not the shipped {}; --save-as takes another file",
                kept.file(),
                source.name
            ));
        }
        Ok(kept)
    }

    /// Set of the files beside the scenario; it is empty at first.
    fn files(&self) -> Files<'static> {
        let (folder, name) = self.beside.clone();
        Files::new(folder, &REPORTS).with_prefix(name)
    }

    /// Writes the text and its results, and reports them. The scenario goes first: where it cannot be written, nothing is.
    fn save(&self, save: &Save<'_>, still: &dyn Fn() -> bool, cancel: &CancelToken) -> Result<Option<SaveReport>> {
        let options = Options {
            cancel: cancel.clone(),
            ..self.options.clone()
        };
        let before = fs::metadata(&self.file).ok().map(|file| file.permissions());
        if before.as_ref().is_some_and(fs::Permissions::readonly) {
            bail!("{}: is read-only", self.file());
        }
        let mut files = self.files();
        files.add_at(self.file.clone(), save.text.to_owned());
        let mut words = match save.scenario {
            Ok(scenario) => Self::add_products(&mut files, &options, scenario)?,
            Err(words) => format!("without a plan: {words}"),
        };
        match files.stale() {
            0 => {}
            removed => words += &format!("; {} of an earlier save removed", count_with_noun(removed, "file")),
        }
        if !files.write_if(cancel, still)? {
            return Ok(None);
        }
        // A new file has the mode of new files; this one has been here before.
        if let Some(mode) = before {
            fs::set_permissions(&self.file, mode)
                .with_context(|| format!("{}: is written, but its mode cannot be kept", self.file()))?;
        }
        let files = files.paths().map(|path| path.display().to_string()).collect();
        Ok(Some(SaveReport { files, words }))
    }

    /// Adds plan, certificate, report and page; the report alone where there is no plan. The first line of the report.
    fn add_products(files: &mut Files<'_>, options: &Options, scenario: &Scenario) -> Result<String> {
        let washing = match wash(options, scenario) {
            Ok(washing) => washing,
            Err(failure) if failure.is_cancelled() => return Err(failure.into()),
            Err(failure) => {
                let Some(report) = failure.report(&scenario.name, scenario.seed) else {
                    return Ok(format!("without a plan: {failure}"));
                };
                files.add_report("report", &report)?;
                return Ok(report.headline);
            }
        };
        let (plan, arm) = (&washing.planned.plan, &washing.arm);
        let certificate = prove_with(plan, arm, &options.cancel).map_err(Failure::from)?;
        let region = scenario.task_region(arm);
        if let Some(page) = page::render(options, plan, arm, Some(&certificate), None, &region)? {
            files.add("page.html", page);
        }
        files.add("plan.json", plan.to_json().map_err(Failure::from)?);
        files.add("certificate.json", json(&certificate)?);
        let report = WashReport::new(&washing.planned, &washing.findings, certificate);
        files.add_report("report", &report)?;
        Ok(report.headline)
    }
}

impl Keeper for ScenarioFile {
    fn file(&self) -> String {
        self.file.display().to_string()
    }

    fn is_scenario(&self) -> bool {
        self.is_scenario
    }

    fn on_disk(&self) -> Result<Option<Vec<u8>>, String> {
        match read_bytes(&self.file, MAX_BYTES) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(FileError::System {
                kind: ErrorKind::NotFound,
                ..
            }) => Ok(None),
            Err(error) => Err(format!("{}: cannot be read: {error}", self.file())),
        }
    }

    fn write(&self, save: &Save<'_>, still: &dyn Fn() -> bool, cancel: &CancelToken) -> Result<SaveReport, SaveError> {
        match self.save(save, still, cancel) {
            Ok(Some(written)) => Ok(written),
            Ok(None) => Err(SaveError::Changed),
            Err(error) => Err(SaveError::Cannot(match failure::code(&error) {
                ExitCode::Interrupted => "given up: nothing was written".to_owned(),
                _ => format!("{error:#}"),
            })),
        }
    }
}
