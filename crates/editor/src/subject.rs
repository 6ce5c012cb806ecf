//! What is edited: a scenario as it was opened, what questions about it may name, and what came last of them.

use crate::arms::Arms;
use platewash_certificate::Certificate;
use platewash_scenario::{Draft, Scenario, Solids};
use platewash_workcell::plan::Plan;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// What is edited.
#[derive(Debug, Default)]
pub struct Subject {
    /// Name of the scenario, or its file as it was given.
    pub name: String,
    /// Where paths in it begin.
    pub folder: Option<PathBuf>,
    /// Its text as it was opened.
    pub text: String,
    /// Whether pages on other machines ask.
    pub is_open_to_others: bool,
    /// Whether what came last is remembered.
    pub remembers: bool,
    /// Arms that were loaded.
    pub arms: Arms,
    /// Meshes that were cut.
    pub solids: Solids,
    latest: Mutex<Option<Latest>>,
}

/// What came of the last question that was answered to its end.
#[derive(Debug, Clone)]
pub struct Latest {
    /// The scenario's text.
    pub text: String,
    /// The scenario.
    pub scenario: Scenario,
    /// Its plan, if there is one.
    pub plan: Option<Arc<Plan>>,
    /// The proof of it.
    pub certificate: Option<Arc<Certificate>>,
    /// The first line of what came of it.
    pub headline: String,
}

impl Subject {
    /// A scenario; paths in it begin in `folder`.
    pub fn new(name: &str, text: &str, folder: Option<&Path>) -> Self {
        Self {
            name: name.to_owned(),
            folder: folder.map(Path::to_owned),
            text: text.to_owned(),
            ..Self::default()
        }
    }

    /// What came last, if it is remembered.
    pub fn latest(&self) -> Option<Latest> {
        self.latest.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Remembers what came of a question, where that is wanted.
    pub fn remember(&self, news: impl FnOnce() -> Latest) {
        if self.remembers {
            *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(news());
        }
    }

    /// Whether a question may name files that the scenario on disk does not.
    pub fn may_name_files(&self) -> bool {
        !self.is_open_to_others
    }

    /// Whether the scenario, as it was opened, names all files that another one names.
    pub fn names_all_of(&self, scenario: &Scenario) -> bool {
        let opened = Draft::new(&self.text).and_then(|draft| draft.scenario(&self.name, self.folder.as_deref()));
        let opened = opened.ok();
        let named: HashSet<&Path> = opened.iter().flat_map(Scenario::files).collect();
        scenario.files().all(|path| named.contains(path))
    }
}
