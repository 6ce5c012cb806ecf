//! The modules of a crate as its sources state them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A module's place among the modules of its crate; the root is 0.
pub type Id = usize;

/// What a name stands for in a module.
#[derive(Debug, Clone)]
pub enum Name {
    /// An item that the module defines.
    Item,
    /// A module inside it.
    Module(Id),
    /// Something imported, by its path.
    Import(Vec<String>),
}

/// A name of a module.
#[derive(Debug, Clone)]
pub struct Binding {
    /// What it stands for.
    pub name: Name,
    /// Whether it is seen beyond the module and those inside it.
    pub open: bool,
}

/// An import of all that a module holds.
#[derive(Debug, Clone)]
pub struct Glob {
    /// The module, or the enumeration.
    pub path: Vec<String>,
    /// Whether it is a re-export.
    pub open: bool,
}

/// A path that stands in a module.
#[derive(Debug, Clone)]
pub struct Mention {
    /// Its segments.
    pub path: Vec<String>,
    /// Its line in the file, from 1.
    pub line: usize,
    /// Whether it is part of a re-export.
    pub reexport: bool,
}

/// One module.
#[derive(Debug)]
pub struct Module {
    /// Its name; the root's is `crate`.
    pub name: String,
    /// What it is inside of.
    pub parent: Option<Id>,
    /// The file that it stands in; an inline module's is its parent's.
    pub file: PathBuf,
    /// What its names stand for: a name may be a module, a type and a function at once.
    pub names: BTreeMap<String, Vec<Binding>>,
    /// Its imports of all that another one holds.
    pub globs: Vec<Glob>,
    /// Paths in its code and imports.
    pub mentions: Vec<Mention>,
}

impl Module {
    /// Adds a meaning of a name.
    pub fn bind(&mut self, name: String, meaning: Name, open: bool) {
        self.names
            .entry(name)
            .or_default()
            .push(Binding { name: meaning, open });
    }
}

/// All modules of a crate, parents before their children.
#[derive(Debug, Default)]
pub struct Modules {
    /// By their places.
    pub all: Vec<Module>,
}

impl Modules {
    /// A module and all that it is inside of, the root first.
    pub fn chain(&self, id: Id) -> Vec<Id> {
        let mut chain: Vec<Id> = std::iter::successors(Some(id), |at| self.all[*at].parent).collect();
        chain.reverse();
        chain
    }

    /// Name of a module in full: `crate::posture::search`.
    pub fn path(&self, id: Id) -> String {
        let names: Vec<&str> = self.chain(id).iter().map(|at| self.all[*at].name.as_str()).collect();
        names.join("::")
    }

    /// The files of the crate, each once.
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = self.all.iter().map(|module| module.file.clone()).collect();
        files.sort();
        files.dedup();
        files
    }
}

/// A file's name with `/` between its parts on every machine.
pub fn shown(file: &Path) -> String {
    file.to_string_lossy().replace('\\', "/")
}
