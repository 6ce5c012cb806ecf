//! An editor: it answers the page's questions and makes the page's first contents.

use crate::answer_writer::AnswerWriter;
use crate::cell_answer;
use crate::edited_scenario::{EditedScenario, LONGEST, LONGEST_MAP, LastResult, accepted, may_name_its_files, stated};
use crate::host::Host;
use crate::keep::{DiskContents, Keeper, SavedFile};
use crate::protocol::{CellQuestion, DiskQuestion, FORMAT, LastStage, MapQuestion, RecoveryQuestion, SaveQuestion};
use crate::recovery_answer;
use crate::sessions::{Lane, Sessions, Turn, is_name};
use platewash_kinematics::JointVector;
use platewash_scenario::{Draft, FormKey, Scenario, ScenarioError, form, source};
use platewash_viewer::bundle::Bundle;
use platewash_viewer::page::{self, PageError};
use platewash_viewer::view::View;
use platewash_workcell::cancel::{CancelToken, Clock, system_clock};
use serde::{Deserialize, Serialize};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use ts_rs::TS;

/// Reason that there is nothing to edit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EditorError {
    /// The scenario cannot be read.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The scenario fails before there is anything to show.
    #[error(transparent)]
    Failure(#[from] platewash_scenario::Failure),
    /// The page cannot be made.
    #[error(transparent)]
    Page(#[from] PageError),
}

/// A scenario that is edited. Its only state of a page is the work under way: the page holds the scenario.
#[derive(Debug)]
pub struct Editor {
    edited: EditedScenario,
    saved_file: Option<SavedFile>,
    sessions: Sessions,
    clock: Clock,
}

impl Editor {
    /// A scenario by its shipped name or file.
    ///
    /// # Errors
    /// [`EditorError::Scenario`].
    pub fn open(name_or_file: &str) -> Result<Self, EditorError> {
        let source = source(name_or_file)?;
        Self::of_text(&source.name, &source.text, source.folder.as_deref())
    }

    /// A scenario as text; paths in it are taken relative to `folder`.
    ///
    /// # Errors
    /// [`EditorError::Scenario`].
    pub fn of_text(name: &str, text: &str, folder: Option<&Path>) -> Result<Self, EditorError> {
        Scenario::parse(text, name)?;
        Ok(Self {
            edited: EditedScenario::new(name, text, folder),
            saved_file: None,
            sessions: Sessions::default(),
            clock: system_clock,
        })
    }

    /// The same editor on another machine than the one with the system's clock and the files on disk.
    #[must_use]
    pub fn with_host(mut self, host: Host) -> Self {
        self.edited.files = host.files;
        self.clock = host.clock;
        self
    }

    /// The same editor, saved by a keeper. The file on disk is read again for each page.
    #[must_use]
    pub fn with_keeper(self, keeper: Box<dyn Keeper>) -> Self {
        Self {
            saved_file: Some(SavedFile::new(keeper)),
            ..self
        }
    }

    /// The same editor for pages that other machines can reach: they may name no files except those that the scenario names.
    #[must_use]
    pub fn open_to_others(mut self) -> Self {
        self.edited.is_open_to_others = true;
        self
    }

    /// The same editor, which remembers its latest answer.
    #[must_use]
    pub fn with_memory(mut self) -> Self {
        self.edited.remembers = true;
        self
    }

    /// Name of the scenario, or its file as it was given.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.edited.name
    }

    /// Folder that relative paths in the scenario start from.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.edited.folder.as_deref()
    }

    /// The scenario as it was opened.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.edited.text
    }

    /// Latest answer of an editor that is [`Editor::with_memory`].
    #[must_use]
    pub fn latest(&self) -> Option<LastResult> {
        self.edited.latest()
    }

    /// A page whose questions go to the window around it.
    ///
    /// # Errors
    /// [`EditorError`].
    pub fn framed_page(&self, bundle: &Bundle) -> Result<String, EditorError> {
        self.page(Channel::Frame, self.text(), bundle)
    }

    /// The first contents of a page whose questions go to a worker of the browser, of the scenario as `text` has it.
    ///
    /// # Errors
    /// [`EditorError`].
    pub fn first_contents<'a>(&'a self, text: &'a str) -> Result<FirstContents<'a>, EditorError> {
        Ok(FirstContents {
            view: self.view(text)?,
            edit: EditDocument::new(Channel::Worker, text, self.saved_file.as_ref()),
        })
    }

    /// A page whose questions go to its own address: of the file on disk; of the scenario as it was opened, where there is no file
    /// or it is no scenario.
    ///
    /// # Errors
    /// [`EditorError`].
    pub fn served_page(&self, bundle: &Bundle) -> Result<String, EditorError> {
        let on_disk = self.saved_file.as_ref().and_then(SavedFile::scenario);
        self.page(Channel::Server, on_disk.as_deref().unwrap_or(self.text()), bundle)
    }

    /// A page of the scenario as `text` has it, or as it was opened where that is none.
    fn page(&self, channel: Channel, text: &str, bundle: &Bundle) -> Result<String, EditorError> {
        let edit = EditDocument::new(channel, text, self.saved_file.as_ref());
        let view = self.view(text)?;
        Ok(page::html_with(&view, &edit, bundle)?)
    }

    /// The arm at home: the view before the first answer.
    fn view(&self, text: &str) -> Result<View, EditorError> {
        let edited = &self.edited;
        let scenario = stated(edited, text).ok();
        let scenario = scenario.filter(|scenario| may_name_its_files(edited, scenario).is_ok());
        let scenario = match scenario {
            Some(scenario) => scenario,
            None => {
                let mut opened = Draft::new(&edited.text)?.scenario(&edited.name, self.folder())?;
                opened.name.clone_from(&edited.name);
                opened.files = edited.files.clone();
                opened
            }
        };
        let arm = edited.arm(&scenario)?.arm;
        let mut view = View::of_configuration(&arm, None, &scenario.homes()[0].unwrap_or_else(JointVector::zeros));
        view.heading.scenario.clone_from(&scenario.name);
        Ok(view)
    }

    /// Answers a question: `/cell`, `/map`, `/recover`, and where it is kept `/save`, `/disk`, `/hello`. Each line of JSON goes to `tell` as soon as it
    /// is known. The work stops where `tell` returns that the client has left, or `gone` is cancelled.
    pub fn answer(&self, path: &str, question: &[u8], tell: &mut dyn FnMut(String) -> bool, gone: &CancelToken) {
        let mut told = AnswerWriter::new(tell, gone, self.clock);
        let answered = catch_unwind(AssertUnwindSafe(|| self.answer_told(path, question, &mut told, gone)));
        let words = match answered {
            Ok(Ok(())) => return,
            Ok(Err(words)) => words,
            // Its message is on standard error.
            Err(_) => "a fault of the program: see the terminal that it runs in".to_owned(),
        };
        told.failed(&words);
    }

    fn answer_told(
        &self,
        path: &str,
        question: &[u8],
        answer: &mut AnswerWriter<'_>,
        gone: &CancelToken,
    ) -> Result<(), String> {
        match (path, &self.saved_file) {
            ("/cell", _) => {
                let question: CellQuestion = read(question)?;
                let lane = match question.want {
                    LastStage::Preview => Lane::Preview,
                    LastStage::Proof => Lane::Proof,
                };
                let _turn = self.turn(&question.session, lane, gone)?;
                answer.end_within(LONGEST);
                cell_answer::answer(&self.edited, &question, answer);
            }
            ("/map", _) => {
                let question: MapQuestion = read(question)?;
                let _turn = self.turn(&question.session, Lane::Map, gone)?;
                answer.end_within(LONGEST_MAP);
                cell_answer::map(&self.edited, &question, answer);
            }
            ("/recover", _) => {
                let question: RecoveryQuestion = read(question)?;
                let _turn = self.turn(&question.session, Lane::Map, gone)?;
                answer.end_within(LONGEST);
                recovery_answer::answer(&self.edited, &question, answer);
            }
            ("/save", Some(kept)) => {
                let question: SaveQuestion = read(question)?;
                named(&question.session)?;
                answer.end_within(LONGEST);
                self.save(kept, &question, answer)?;
            }
            ("/disk", Some(kept)) => {
                let question: DiskQuestion = read(question)?;
                named(&question.session)?;
                kept.report_changes(&question, answer);
            }
            ("/hello", Some(kept)) => kept.greet(answer),
            _ => return Err(format!("there is no question {path}")),
        }
        Ok(())
    }

    /// Saves a text, with the result of its scenario where that is small enough to plan while the user waits.
    fn save(
        &self,
        saved_file: &SavedFile,
        question: &SaveQuestion,
        answer: &mut AnswerWriter<'_>,
    ) -> Result<(), String> {
        let edited = &self.edited;
        let scenario = stated(edited, &question.text);
        // Whatever is refused for other reasons is saved: it may be mended later.
        if let Ok(scenario) = &scenario {
            may_name_its_files(edited, scenario).map_err(|refusal| refusal.words)?;
        }
        let scenario = scenario.and_then(|scenario| accepted(edited, scenario));
        let scenario = scenario.map_err(|refusal| refusal.words);
        saved_file.save(question, scenario.as_ref().map_err(String::as_str), answer);
        Ok(())
    }

    fn turn(&self, session: &str, lane: Lane, token: &CancelToken) -> Result<Turn<'_>, String> {
        named(session)?;
        Ok(self.sessions.begin(session, lane, token))
    }
}

/// Refuses a name that is none.
fn named(session: &str) -> Result<(), String> {
    match is_name(session) {
        true => Ok(()),
        false => Err("session must be 16 to 64 letters and digits".to_owned()),
    }
}

fn read<'a, Q: Deserialize<'a>>(question: &'a [u8]) -> Result<Q, String> {
    let text = std::str::from_utf8(question).map_err(|error| format!("the question is none: {error}"))?;
    serde_json::from_str(text).map_err(|error| format!("the question is none: {error}"))
}

/// Channel for the page's questions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
enum Channel {
    /// Questions go to the page's own address.
    Server,
    /// Questions go to the window around it, by messages.
    Frame,
    /// Questions go to workers of the browser that the page has started.
    Worker,
}

/// First contents of a page: the arm at home, and the block of the live cell.
#[derive(Debug, Serialize, TS)]
pub struct FirstContents<'a> {
    view: View,
    edit: EditDocument<'a>,
}

/// The block of the live cell in a page.
#[derive(Debug, Serialize, TS)]
struct EditDocument<'a> {
    /// [`FORMAT`].
    format: &'static str,
    /// Channel for the page's questions.
    channel: Channel,
    /// File that it is saved in, in words; `None` where it cannot be saved.
    file: Option<String>,
    /// SHA-256 of that file's contents on disk; `None` where there are none.
    disk: Option<String>,
    /// Contents of that file, where they are text.
    saved: Option<String>,
    /// The scenario.
    text: &'a str,
    /// The table of keys.
    keys: Vec<FormKey>,
}

impl<'a> EditDocument<'a> {
    /// Document of a scenario, with the file that it is saved in.
    fn new(channel: Channel, text: &'a str, saved_file: Option<&SavedFile>) -> Self {
        let standing = saved_file.and_then(|kept| kept.read_disk().ok());
        Self {
            format: FORMAT,
            channel,
            file: saved_file.map(SavedFile::file),
            disk: standing.as_ref().and_then(DiskContents::hash),
            saved: standing.and_then(DiskContents::into_text),
            text,
            keys: form(),
        }
    }
}
