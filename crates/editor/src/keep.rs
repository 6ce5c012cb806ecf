//! The file on disk: its contents, and writing.

use crate::answer_writer::AnswerWriter;
use crate::protocol::{DiskLine, DiskQuestion, FORMAT, HelloLine, SaveLine, SaveQuestion};
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_scenario::Scenario;
use platewash_workcell::cancel::CancelToken;
use std::fmt::Debug;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Store of the scenario's file and of the files written beside it.
pub trait Keeper: Debug + Send + Sync {
    /// The file, in words.
    fn file(&self) -> String;

    /// Returns true where the file on disk is the scenario that is edited, and no other one that would be overwritten.
    fn is_scenario(&self) -> bool;

    /// Reads the file on disk: `None` where there is none.
    ///
    /// # Errors
    /// The reason that it cannot be read, in words.
    fn on_disk(&self) -> Result<Option<Vec<u8>>, String>;

    /// Writes a scenario's text there, and the results of the scenario beside it: all of it or nothing. `still` is called once
    /// all is ready, just before anything is replaced; where it returns false, nothing is replaced.
    ///
    /// # Errors
    /// [`SaveError`].
    fn write(&self, save: &Save<'_>, still: &dyn Fn() -> bool, cancel: &CancelToken) -> Result<SaveReport, SaveError>;
}

/// Contents to write.
#[derive(Debug, Clone, Copy)]
pub struct Save<'a> {
    /// The text.
    pub text: &'a str,
    /// The scenario that it states; or why nothing is planned of it here, in words.
    pub scenario: Result<&'a Scenario, &'a str>,
}

/// Reason that nothing was written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The file on disk has changed meanwhile.
    #[error("the file was changed meanwhile")]
    Changed,
    /// Writing is impossible, for the reason in words.
    #[error("{0}")]
    Cannot(String),
}

/// Result of writing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaveReport {
    /// The files.
    pub files: Vec<String>,
    /// Result of the scenario, in one line.
    pub words: String,
}

/// A file that pages save to, one after the other.
#[derive(Debug)]
pub struct SavedFile {
    keeper: Box<dyn Keeper>,
    one_at_a_time: Mutex<()>,
}

/// Contents of the file on disk.
pub struct DiskContents {
    bytes: Option<Vec<u8>>,
}

impl DiskContents {
    /// SHA-256 of it; `None` for nothing.
    pub fn hash(&self) -> Option<String> {
        self.bytes.as_deref().map(sha256_hex)
    }

    fn text(&self) -> Option<&str> {
        std::str::from_utf8(self.bytes.as_deref()?).ok()
    }

    /// It, if it is text.
    pub fn into_text(self) -> Option<String> {
        String::from_utf8(self.bytes?).ok()
    }
}

impl SavedFile {
    /// A file.
    pub fn new(keeper: Box<dyn Keeper>) -> Self {
        Self {
            keeper,
            one_at_a_time: Mutex::default(),
        }
    }

    /// Name of the file, for messages.
    pub fn file(&self) -> String {
        self.keeper.file()
    }

    /// SHA-256 of the file on disk; `None` where there is none, or it cannot be read.
    pub fn hash(&self) -> Option<String> {
        self.read_disk().ok()?.hash()
    }

    /// The scenario that is edited, if it stands there as text.
    pub fn scenario(&self) -> Option<String> {
        let standing = self.keeper.is_scenario().then(|| self.read_disk().ok())?;
        standing?.into_text()
    }

    /// Reads the file on disk.
    pub fn read_disk(&self) -> Result<DiskContents, String> {
        self.keeper.on_disk().map(|bytes| DiskContents { bytes })
    }

    /// Reads the file until two reads, 0.2 s apart, agree: an editor that empties a file before it writes it is waited for, for up to 4 s.
    fn read_stable(&self, known: Option<&str>) -> Result<DiskContents, String> {
        let mut standing = self.read_disk()?;
        for _ in 0..20 {
            let hash = standing.hash();
            if hash.as_deref() == known {
                break;
            }
            std::thread::sleep(Duration::from_millis(200));
            standing = self.read_disk()?;
            if standing.hash() == hash {
                break;
            }
        }
        Ok(standing)
    }

    /// Answers if the file on disk has changed.
    pub fn report_changes(&self, question: &DiskQuestion, answer: &mut AnswerWriter<'_>) {
        let standing = match self.read_stable(question.disk.as_deref()) {
            Ok(standing) => standing,
            Err(words) => {
                let disk = question.disk.as_deref();
                return answer.line(&DiskLine {
                    disk,
                    text: None,
                    words: Some(&words),
                });
            }
        };
        let hash = standing.hash();
        let differs = hash != question.disk;
        let text = standing.text().filter(|_| differs);
        let is_no_text = differs && standing.bytes.is_some() && text.is_none();
        answer.line(&DiskLine {
            disk: hash.as_deref(),
            text,
            words: is_no_text.then_some("the file on disk is not a text file"),
        });
    }

    /// Writes, unless something else stands there than the page knows, when it asks or when all is ready to be written.
    pub fn save(&self, question: &SaveQuestion, scenario: Result<&Scenario, &str>, answer: &mut AnswerWriter<'_>) {
        let _one = self.one_at_a_time.lock().unwrap_or_else(PoisonError::into_inner);
        let standing = match self.read_disk() {
            Ok(standing) => standing,
            Err(words) => return answer.failed(&words),
        };
        let hash = standing.hash();
        // A text that is there already needs no check.
        let is_same = standing.text() == Some(&question.text);
        if !question.force && hash != question.disk && !is_same {
            return told_conflict(&standing, answer);
        }
        let still = || self.read_disk().is_ok_and(|now| now.hash() == hash);
        let text = question.text.as_str();
        match self.keeper.write(&Save { text, scenario }, &still, &answer.gone) {
            Ok(written) => answer.line(&SaveLine::Saved {
                disk: &sha256_hex(question.text.as_bytes()),
                file: &self.file(),
                files: &written.files,
                words: &written.words,
            }),
            Err(SaveError::Changed) => match self.read_disk() {
                Ok(now) => told_conflict(&now, answer),
                Err(words) => answer.failed(&words),
            },
            Err(SaveError::Cannot(words)) => answer.failed(&words),
        }
    }

    /// Greets a page that comes from a server that is gone.
    pub fn greet(&self, answer: &mut AnswerWriter<'_>) {
        answer.line(&HelloLine {
            format: FORMAT,
            file: Some(&self.file()),
            disk: self.hash().as_deref(),
        });
    }
}

/// Tells that something else stands on disk.
fn told_conflict(contents: &DiskContents, answer: &mut AnswerWriter<'_>) {
    let hash = contents.hash();
    let words = match hash {
        Some(_) => "the file on disk is not the one that this page has read or written: another program has changed it",
        None => "the file that this page has read or written is gone from the disk",
    };
    answer.line(&SaveLine::Conflict {
        disk: hash.as_deref(),
        text: contents.text(),
        words,
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file that another program is writing: each read gives the next text.
    #[derive(Debug)]
    struct HalfWrittenFile(Mutex<Vec<&'static str>>);

    impl Keeper for HalfWrittenFile {
        fn file(&self) -> String {
            "case.toml".into()
        }

        fn is_scenario(&self) -> bool {
            true
        }

        fn on_disk(&self) -> Result<Option<Vec<u8>>, String> {
            let mut reads = self.0.lock().map_err(|error| error.to_string())?;
            let text = if reads.len() > 1 { reads.remove(0) } else { reads[0] };
            Ok(Some(text.into()))
        }

        fn write(&self, _: &Save<'_>, _: &dyn Fn() -> bool, _: &CancelToken) -> Result<SaveReport, SaveError> {
            Err(SaveError::Changed)
        }
    }

    #[test]
    fn waits_for_a_file_that_is_being_written() {
        let read = |reads: &[&'static str], known| {
            let kept = SavedFile::new(Box::new(HalfWrittenFile(Mutex::new(reads.to_vec()))));
            kept.read_stable(known).unwrap().into_text().unwrap()
        };
        let before = sha256_hex(b"before");
        assert_eq!(read(&["", "half", "whole"], Some(&before)), "whole");
        assert_eq!(
            read(&["before", "whole"], Some(&before)),
            "before",
            "a file that is known is read once"
        );
    }
}
