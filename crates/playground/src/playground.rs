//! Questions of the browser's worker, and their answers.

use crate::files::{FileQuestion, files};
use platewash_editor::{Editor, Host, LastResult};
use platewash_kinematics::urdf::Files;
use platewash_scenario::{Program, SHIPPED, Scenario};
use platewash_workcell::cancel::{CancelToken, Clock};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Name of the scenario in messages.
const NAME: &str = "the scenario";

/// Session of the questions that the playground asks itself.
const OWN_SESSION: &str = "playgroundsown00";

/// A live cell without a disk.
#[derive(Debug)]
pub struct Playground {
    /// The cell; `None` where not even the first shipped scenario can be read.
    editor: Option<Editor>,
}

/// Question for the first contents of a page.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OpenQuestion {
    /// The scenario.
    text: String,
}

/// A scenario that comes with the program.
#[derive(Debug, Serialize)]
struct ShippedLine {
    name: &'static str,
    /// The first sentence of its comment.
    about: String,
    /// True for the paper's program, which a live cell does not run.
    is_paper: bool,
    text: &'static str,
}

impl Playground {
    /// A playground with a clock. It has no files: scenarios that name some are refused.
    #[must_use]
    pub fn new(clock: Clock) -> Self {
        let host = Host {
            clock,
            files: Files::none(),
        };
        let editor = SHIPPED
            .first()
            .and_then(|first| Editor::of_text(NAME, first.text, None).ok());
        Self {
            editor: editor.map(|editor| editor.with_memory().with_host(host)),
        }
    }

    /// Answers a question in JSON. Each line of the answer goes to `tell` as soon as it is known.
    pub fn answer(&self, path: &str, question: &str, tell: &mut dyn FnMut(String)) {
        if let Err(words) = self.answered(path, question, tell) {
            tell(json!({ "kind": "failed", "words": words }).to_string());
        }
    }

    fn answered(&self, path: &str, question: &str, tell: &mut dyn FnMut(String)) -> Result<(), String> {
        let editor = self.editor.as_ref().ok_or("the shipped scenarios cannot be read")?;
        let malformed = |error: serde_json::Error| format!("{path}: the question cannot be read: {error}");
        let told = match path {
            "/open" => {
                let question: OpenQuestion = serde_json::from_str(question).map_err(malformed)?;
                let first = editor.first_contents(&question.text);
                serde_json::to_string(&first.map_err(|error| error.to_string())?)
            }
            "/shipped" => {
                let lines = SHIPPED.iter().map(|shipped| ShippedLine {
                    name: shipped.name,
                    about: shipped.about(),
                    is_paper: Scenario::parse(shipped.text, shipped.name)
                        .is_ok_and(|scenario| scenario.job.program == Program::Paper),
                    text: shipped.text,
                });
                serde_json::to_string(&lines.collect::<Vec<_>>())
            }
            "/file" => {
                let question: FileQuestion = serde_json::from_str(question).map_err(malformed)?;
                let result = self.result(editor, &question.text)?;
                for file in files(&result, &question)? {
                    tell(serde_json::to_string(&file).map_err(|error| error.to_string())?);
                }
                return Ok(());
            }
            _ => {
                let mut listens = |line| {
                    tell(line);
                    true
                };
                editor.answer(path, question.as_bytes(), &mut listens, &CancelToken::new());
                return Ok(());
            }
        };
        tell(told.map_err(|error| error.to_string())?);
        Ok(())
    }

    /// The result of a scenario: the latest one, or one that is planned and proved now.
    fn result(&self, editor: &Editor, text: &str) -> Result<LastResult, String> {
        let latest = || editor.latest().filter(|latest| latest.text == text);
        if let Some(latest) = latest() {
            return Ok(latest);
        }
        let question = json!({ "session": OWN_SESSION, "text": text, "edits": [], "want": "proof", "arm": null });
        let mut last = String::new();
        let mut listens = |line| {
            last = line;
            true
        };
        let question = question.to_string();
        editor.answer("/cell", question.as_bytes(), &mut listens, &CancelToken::new());
        latest().ok_or_else(|| {
            let line: Value = serde_json::from_str(&last).unwrap_or_default();
            let words = line.get("words").and_then(Value::as_str);
            let words = words.unwrap_or("it was not planned");
            match line.get("line").and_then(Value::as_u64) {
                Some(line) => format!("{NAME}, line {line}: {words}"),
                None => format!("{NAME}: {words}"),
            }
        })
    }
}
