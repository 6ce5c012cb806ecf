//! The map of the code, `docs/architecture.md`, held against the code.
//!
//! How the page is written:
//!
//! - A heading may name folders in backticks. In the tables below it, a row is a module, and its last cell has the names of files
//!   and folders, relative to one of the heading's folders, or to the folder of the name before in that cell: under
//!   "`crates/x/src`", the cell "`ik/dls.rs`, `qp.rs`" has two files of `crates/x/src/ik`, and so has "`ik/`: `dls.rs`, `qp.rs`".
//! - Under a heading without folders, names in all cells are relative to the repository.
//! - In sentences, and in the other cells, a name may be the end of a file's.
//! - Every crate in `crates/` and every public module of a crate is named, or something inside it, in a table or a heading.
//! - Links to files are relative to the page.

use crate::tree::Tree;
use crate::workspace::Package;
use anyhow::{Context, Result};
use std::collections::BTreeSet;
use std::path::Path;

const PAGE: &str = "docs/architecture.md";
/// What ends the name of a source; other names need a folder to be taken for files.
const SOURCES: [&str; 5] = [".md", ".py", ".pyi", ".rs", ".typed"];

/// Whatever is wrong with the page of a checkout.
///
/// # Errors
/// The page or a source that cannot be read.
pub fn wrong(root: &Path, packages: &[Package]) -> Result<Vec<String>> {
    let page = std::fs::read_to_string(root.join(PAGE)).context(PAGE)?;
    let mut wanted = Vec::new();
    for package in packages {
        let folder = package.folder.strip_prefix(root).unwrap_or(&package.folder);
        let folder = folder.to_string_lossy().replace('\\', "/");
        let of_crates = folder.starts_with("crates/");
        if of_crates {
            wanted.push(folder.clone());
        }
        let library = package.folder.join("src/lib.rs");
        if (of_crates || folder.is_empty()) && library.is_file() {
            let source = std::fs::read_to_string(&library).with_context(|| library.display().to_string())?;
            let modules = public_modules(&source).with_context(|| library.display().to_string())?;
            let sources = if of_crates {
                format!("{folder}/src")
            } else {
                "src".to_owned()
            };
            wanted.extend(modules.iter().map(|module| format!("{sources}/{module}")));
        }
    }
    Ok(findings(&page, &Tree::of(root)?, &wanted))
}

/// Public modules that a library's root file declares.
fn public_modules(source: &str) -> syn::Result<Vec<String>> {
    let items = syn::parse_file(source)?.items.into_iter();
    let modules = items.filter_map(|item| match item {
        syn::Item::Mod(module) if matches!(module.vis, syn::Visibility::Public(_)) => Some(module.ident.to_string()),
        _ => None,
    });
    Ok(modules.collect())
}

/// What a page names and is not there, and what of `wanted`, folders and modules without `.rs`, it does not name.
fn findings(page: &str, tree: &Tree, wanted: &[String]) -> Vec<String> {
    let mut reader = Reader {
        tree,
        folders: Vec::new(),
        named: BTreeSet::new(),
        findings: Vec::new(),
    };
    let mut verbatim = false;
    for (line, text) in (1..).zip(page.lines()) {
        if text.trim_start().starts_with("```") {
            verbatim = !verbatim;
        } else if !verbatim {
            reader.line(line, text);
        }
    }
    let missing = wanted.iter().filter(|wanted| !reader.names(wanted));
    let missing: Vec<String> = missing.map(|wanted| format!("{PAGE} does not name {wanted}")).collect();
    reader.findings.extend(missing);
    reader.findings
}

struct Reader<'a> {
    tree: &'a Tree,
    /// What the heading names.
    folders: Vec<String>,
    /// Names in full that tables and headings have.
    named: BTreeSet<String>,
    findings: Vec<String>,
}

impl Reader<'_> {
    fn line(&mut self, line: usize, text: &str) {
        if text.starts_with('#') {
            self.heading(line, text);
        } else if text.starts_with('|') {
            self.row(line, text);
        } else {
            self.sentence(line, text);
        }
        self.links(line, text);
    }

    fn heading(&mut self, line: usize, text: &str) {
        self.folders.clear();
        for name in names(self.tree, text) {
            match self.tree.is_folder(name) {
                true => self.folders.push(name.trim_end_matches('/').to_owned()),
                false => self.missing(line, name, "no folder of the repository"),
            }
        }
        self.named.extend(self.folders.iter().cloned());
    }

    /// Under a heading with folders the last cell has the files, and those before it say what they are for.
    fn row(&mut self, line: usize, text: &str) {
        let cells: Vec<&str> = text.trim().trim_matches('|').split('|').collect();
        let said = if self.folders.is_empty() { 0 } else { cells.len() - 1 };
        cells[..said].iter().for_each(|cell| self.sentence(line, cell));
        cells[said..].iter().for_each(|cell| self.cell(line, cell));
    }

    fn cell(&mut self, line: usize, cell: &str) {
        let mut before: Option<String> = None;
        for name in names(self.tree, cell) {
            let folders = before.iter().chain(&self.folders).cloned();
            let folders: Vec<String> = if self.folders.is_empty() {
                folders.chain([String::new()]).collect()
            } else {
                folders.collect()
            };
            let full = folders
                .iter()
                .map(|folder| join(folder, name))
                .find(|full| self.tree.has(full));
            let Some(full) = full else {
                self.missing(line, name, "not in the folders of its heading and its cell");
                continue;
            };
            let folder = if self.tree.is_folder(&full) {
                &full
            } else {
                full.rsplit_once('/').map_or("", |(folder, _)| folder)
            };
            before = Some(folder.trim_end_matches('/').to_owned());
            self.named.insert(full);
        }
    }

    fn sentence(&mut self, line: usize, text: &str) {
        for name in names(self.tree, text) {
            if !self.tree.has_at_the_end(name) {
                self.missing(line, name, "nowhere in the repository");
            }
        }
    }

    fn links(&mut self, line: usize, text: &str) {
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        for target in targets.filter(|target| !target.contains(':') && !target.starts_with('#')) {
            let file = target.split('#').next().unwrap_or(target);
            let full = match file.strip_prefix("../") {
                Some(file) => file.to_owned(),
                None => join("docs", file),
            };
            if !self.tree.has(&full) {
                self.missing(line, target, "a link to nothing");
            }
        }
    }

    fn missing(&mut self, line: usize, name: &str, why: &str) {
        self.findings.push(format!("{PAGE}:{line}: `{name}`: {why}"));
    }

    /// Whether the page names a folder or a module, or something inside it.
    fn names(&self, wanted: &str) -> bool {
        let inside = format!("{wanted}/");
        let file = format!("{wanted}.rs");
        self.named
            .iter()
            .any(|name| name == wanted || *name == file || name.starts_with(&inside))
    }
}

fn join(folder: &str, name: &str) -> String {
    if folder.is_empty() {
        name.to_owned()
    } else {
        format!("{folder}/{name}")
    }
}

/// What stands in backticks and is meant as the name of a file or a folder.
fn names<'t>(tree: &Tree, text: &'t str) -> Vec<&'t str> {
    let spans = text.split('`').skip(1).step_by(2);
    let plain = |span: &&str| {
        span.chars()
            .all(|sign| sign.is_ascii_alphanumeric() || "_-./*".contains(sign))
    };
    let meant = |span: &&str| {
        let first = span.split_once('/').map(|(first, _)| first);
        span.ends_with('/')
            || SOURCES.iter().any(|end| span.ends_with(end))
            || first.is_some_and(|first| tree.is_folder(first))
    };
    spans.filter(plain).filter(meant).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(page: &str, wanted: &[&str]) -> Vec<String> {
        let files = [
            "crates/x/src/lib.rs",
            "crates/x/src/ik/mod.rs",
            "crates/x/src/ik/qp.rs",
            "crates/x/src/fk.rs",
            "docs/other.md",
        ];
        let wanted: Vec<String> = wanted.iter().map(ToString::to_string).collect();
        findings(page, &Tree::from_iter(files), &wanted)
    }

    #[test]
    fn names_in_tables_are_relative_to_the_heading_and_the_name_before() {
        let rows = "| `lib.rs` |\n| loose | `ik/`: `mod.rs`, `qp.rs` |\n| `ik/mod.rs`, `qp.rs`, `fk.rs` |";
        assert_eq!(found(&format!("## Floor 1, `crates/x/src`\n\n{rows}\n"), &[]), [""; 0]);
        let wrong = found(
            "## Floor 1, `crates/x/src`\n| a | `ik/`: `dls.rs` |\n| a | `qp.rs` |\n| a | `x/` |",
            &[],
        );
        let why = "not in the folders of its heading and its cell";
        let line = |line, name| format!("docs/architecture.md:{line}: `{name}`: {why}");
        assert_eq!(wrong, [line(2, "dls.rs"), line(3, "qp.rs"), line(4, "x/")]);
    }

    #[test]
    fn without_folders_in_the_heading_names_are_the_repositorys() {
        assert_eq!(found("## Floors\n| 1 | `crates/x` | `docs/*.md` |", &[]), [""; 0]);
        assert_eq!(
            found("## Floors\n| 1 | `crates/y` | `lib.rs` |\n## `crates/z`", &[]).len(),
            3
        );
    }

    #[test]
    fn sentences_may_name_the_end_of_a_file() {
        assert_eq!(found("## `crates/x/src`\n| but `qp.rs` | `ik/` |", &[]), [""; 0]);
        assert_eq!(
            found("In `ik/qp.rs`, `fk.rs` and `ik/`.\n```\n`gone.rs`\n```", &[]),
            [""; 0]
        );
        assert_eq!(
            found("In `gone.rs`.", &[]),
            ["docs/architecture.md:1: `gone.rs`: nowhere in the repository"]
        );
    }

    #[test]
    fn what_is_no_file_is_left_alone() {
        assert_eq!(
            found(
                "`a::b`, `plan.json`, `platewash-plan/2`, `cargo test x.rs`, `\"a/b.rs\"`, `m/s`",
                &[]
            ),
            [""; 0]
        );
    }

    #[test]
    fn links_lead_to_files() {
        assert_eq!(
            found(
                "[a](other.md#part), [b](https://c.d/e), [c](#part), [d](../crates/x/src/fk.rs)",
                &[]
            ),
            [""; 0]
        );
        assert_eq!(
            found("[a](lost.md)", &[]),
            ["docs/architecture.md:1: `lost.md`: a link to nothing"]
        );
    }

    #[test]
    fn crates_and_public_modules_are_named() {
        let wanted = ["crates/x", "crates/x/src/ik", "crates/x/src/fk"];
        assert_eq!(
            found("## `crates/x/src`\n| a | `ik/qp.rs` |\n| a | `fk.rs` |", &wanted),
            [""; 0]
        );
        let only_said = found("## `crates/x/src`\n| a | `ik/` |\n\nThere is `fk.rs`, too.", &wanted);
        assert_eq!(only_said, ["docs/architecture.md does not name crates/x/src/fk"]);
    }

    #[test]
    fn public_modules_are_those_that_others_see() {
        let source = "mod a; pub mod b; pub(crate) mod c; pub mod d { pub mod e {} }";
        assert_eq!(public_modules(source).unwrap(), ["b", "d"]);
    }
}
