//! The modules of a program and the files that they are in.

use crate::dialect::ReadError;
use crate::file::{Place, ProgramFile};
use crate::rapid::syntax::{At, SyntaxError, ast::Module, parse};

/// A module and the file that it is in.
#[derive(Debug)]
pub struct Source {
    /// The file's name.
    pub file: String,
    /// The module.
    pub module: Module,
}

impl Source {
    /// All modules of some files.
    ///
    /// # Errors
    /// [`ReadError`] with the line and the column of what is no RAPID.
    pub fn of(files: &[ProgramFile]) -> Result<Vec<Self>, ReadError> {
        let mut sources = Vec::new();
        for file in files {
            let modules = parse(&file.text).map_err(|error| in_file(&file.name, &error))?;
            sources.extend(modules.into_iter().map(|module| Self {
                file: file.name.clone(),
                module,
            }));
        }
        Ok(sources)
    }

    /// That a line of it is refused.
    #[must_use]
    pub fn refused(&self, at: At, reason: String) -> ReadError {
        ReadError {
            place: self.place(at),
            reason,
        }
    }

    /// A line of it.
    #[must_use]
    pub fn place(&self, at: At) -> Place {
        Place {
            file: self.file.clone(),
            line: at.line,
        }
    }
}

fn in_file(name: &str, error: &SyntaxError) -> ReadError {
    let At { line, column } = error.at();
    ReadError {
        place: Place {
            file: name.to_owned(),
            line,
        },
        reason: format!("column {column}: {error}"),
    }
}

/// A refusal where there is no line.
pub fn nothing(reason: String) -> ReadError {
    let file = "(no file)".to_owned();
    ReadError {
        place: Place { file, line: 1 },
        reason,
    }
}
