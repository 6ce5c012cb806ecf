//! `platewash edit`: a scenario on a page in the browser, changed by hand, planned and proved at once.

use super::failure::{ExitCode, Failure};
use super::kept::{Place, ScenarioFile};
use super::options::Options;
use super::serve::ServeArguments;
use super::{bundle, output};
use anyhow::anyhow;
use clap::Args;
use platewash::editor::{Editor, site};
use platewash::scenario::{Draft, ScenarioSource, source};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Arguments of `edit`.
#[derive(Debug, Args)]
pub struct EditArguments {
    /// File that Save writes [default: the scenario's own file; NAME.toml in the working folder for a shipped scenario]
    #[arg(long, value_name = "FILE")]
    save_as: Option<PathBuf>,
    #[command(flatten)]
    serve: ServeArguments,
}

/// Where the page is.
#[derive(Debug, Serialize)]
struct Answer<'a> {
    url: &'a str,
    /// Where Save writes.
    file: String,
}

/// Serves the page of a scenario until it is told to end.
pub fn run(options: &Options, arguments: &EditArguments) -> Result<ExitCode, Failure> {
    if options.urdf.is_some() {
        return Err(Failure::input(anyhow!(
            "--urdf: the page edits a scenario, which names its arm itself: set robot.urdf (and robot.srdf, robot.package_path) in it"
        )));
    }
    let source = source(options.scenario_name())?;
    let text = text(options, &source)?;
    let editor = Editor::of_text(&source.name, &text, source.folder.as_deref()).map_err(Failure::input)?;
    refuse_other_folder(&source, arguments.save_as.as_deref(), &editor)?;
    let place = Place::new(options, &source, arguments.save_as.as_deref())?;
    let listener = arguments.serve.listen(options)?;
    let bundle = bundle::needed()?;
    let (url, saved_in) = (listener.url(), place.words());
    let editor = editor.kept_by(Box::new(ScenarioFile::new(options, place, &bundle)));
    let editor = match arguments.serve.is_loopback() {
        true => editor,
        false => editor.open_to_others(),
    };
    let site = site(editor, bundle).map_err(Failure::internal)?;
    // Behind the #, where browsers keep it to themselves.
    let token = site
        .service
        .as_ref()
        .map_or_else(String::new, |service| service.token().to_owned());
    let answer = Answer {
        url: &format!("{url}#token={token}"),
        file: saved_in,
    };
    let server = listener.serve(site).map_err(Failure::internal)?;
    output::print_either(options.json, &answer, || format!("{}\n", answer.url))?;
    let _redirect = arguments.serve.open_privately(options, answer.url)?;
    let words = format!(
        "Save writes {}. Ctrl-C ends it; what is not saved stays in the page",
        answer.file
    );
    output::message(options.quiet, &words);
    options.wait();
    drop(server);
    Ok(ExitCode::SUCCESS)
}

/// The scenario's text, with what the options override.
fn text(options: &Options, source: &ScenarioSource) -> Result<String, Failure> {
    let Some(seed) = options.seed else {
        return Ok(source.text.clone());
    };
    let mut draft = Draft::new(&source.text)?;
    draft.set("seed", Some(&seed.into())).map_err(Failure::input)?;
    Ok(draft.text().to_owned())
}

/// Refuses to save a scenario elsewhere that names files relative to its folder: there, it would name others.
fn refuse_other_folder(source: &ScenarioSource, save_as: Option<&Path>, editor: &Editor) -> Result<(), Failure> {
    let Some(save_as) = save_as else { return Ok(()) };
    let in_full = |folder: Option<&Path>| match folder {
        Some(folder) if !folder.as_os_str().is_empty() => folder.canonicalize().ok(),
        _ => Path::new(".").canonicalize().ok(),
    };
    if in_full(source.folder.as_deref()) == in_full(save_as.parent()) {
        return Ok(());
    }
    let stated = Draft::new(editor.text())?.stated();
    let is_relative = |value: &serde_json::Value| {
        let paths = value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice);
        let mut paths = paths.iter().filter_map(serde_json::Value::as_str);
        paths.any(|path| Path::new(path).is_relative())
    };
    let files = ["robot.urdf", "robot.srdf", "robot.package_path"];
    match files.into_iter().find(|key| stated.get(*key).is_some_and(is_relative)) {
        None => Ok(()),
        Some(key) => Err(Failure::input(anyhow!(
            "--save-as {}: {key} is relative to the scenario's folder, and would lead elsewhere from there; make it absolute first",
            save_as.display()
        ))),
    }
}
