//! The words of the documents name what is in the code: the glossary of the proof, and the files that pages of docs name.

use crate::sources::collect;
use platewash_bundler::root;
use std::fs;
use std::path::PathBuf;

/// The texts between backticks in a cell of a table.
fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// True if a text has a word, with no letter, digit or underscore on either side.
fn has_word(text: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| {
        let (before, after) = (text[..at].chars().next_back(), text[at + word.len()..].chars().next());
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}

#[test]
fn the_glossary_names_what_is_in_the_code() {
    let page = fs::read_to_string(root().join("docs/certificate.md")).unwrap();
    let (_, glossary) = page.split_once("\n## Glossary\n").unwrap();
    let mut rows = 0;
    for row in glossary
        .lines()
        .filter(|line| line.starts_with('|') && line.contains(".rs`"))
    {
        let cells: Vec<_> = row.trim_matches('|').split(" | ").collect();
        let [_, _, names, files] = cells[..] else {
            panic!("a row has a word, its meaning, its name and its file: {row}");
        };
        let sources: Vec<String> = quoted(files)
            .map(|file| root().join("crates").join(file))
            .map(|file| fs::read_to_string(&file).unwrap_or_else(|_| panic!("{} is not there: {row}", file.display())))
            .collect();
        assert!(!sources.is_empty(), "no file: {row}");
        for part in quoted(names).flat_map(|name| name.split("::")) {
            assert!(
                sources.iter().any(|source| has_word(source, part)),
                "{part} is in none of its files: {row}"
            );
        }
        rows += 1;
    }
    assert!(rows > 80, "{rows} rows");
}

#[test]
fn the_architecture_names_files_that_are_there() {
    for page in ["docs/architecture.md", "CONTRIBUTING.md"] {
        let text = fs::read_to_string(root().join(page)).unwrap();
        // A path has a folder that stands in `crates` or at the root; names alone are of the folder named before.
        let named = quoted(&text).filter(|name| {
            name.split_once('/')
                .is_some_and(|(first, _)| root().join("crates").join(first).is_dir() || root().join(first).is_dir())
        });
        let is_there = |name: &str| {
            let places: [PathBuf; 2] = [root().join("crates").join(name), root().join(name)];
            places.iter().any(|place| place.exists())
        };
        let named: Vec<_> = named.filter(|name| !name.contains(['<', '*', ' ', '('])).collect();
        assert!(named.len() > 5, "{page}: {named:?}");
        let gone: Vec<_> = named.into_iter().filter(|name| !is_there(name)).collect();
        assert!(gone.is_empty(), "{page} names what is not there: {gone:?}");
    }
}

/// The sources that a cell of a table names: files, and all of a folder; a name without a folder is of the folder before.
fn sources_of(cell: &str) -> String {
    let (mut folder, mut sources) = (PathBuf::new(), String::new());
    for name in quoted(cell).filter(|name| name.ends_with('/') || name.ends_with(".rs")) {
        let place = match name.contains('/') {
            true => root().join("crates").join(name),
            false => folder.join(name),
        };
        folder = if place.is_dir() {
            place.clone()
        } else {
            place.parent().unwrap().to_owned()
        };
        let mut files = Vec::new();
        collect(&root(), place.strip_prefix(root()).unwrap().to_owned(), &mut files).unwrap();
        for file in files {
            sources += &fs::read_to_string(root().join(&file)).unwrap_or_else(|_| panic!("{}: {cell}", file.display()));
        }
    }
    sources
}

#[test]
fn functions_are_in_the_files_that_the_architecture_names_beside_them() {
    let page = fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    let part = page
        .split("\n## ")
        .find(|part| part.starts_with("From a scenario to a proved plan\n"))
        .unwrap();
    let mut functions = 0;
    for row in part.lines().filter(|line| line.starts_with("| ") && line.contains('`')) {
        let cells: Vec<_> = row.trim_matches('|').split(" | ").collect();
        let [_, names, files] = cells[..] else {
            panic!("a row has a step, its functions and their files: {row}");
        };
        let sources = sources_of(files);
        for name in quoted(names).filter_map(|name| name.rsplit("::").next()) {
            let is_there = ["fn", "struct", "trait"]
                .iter()
                .any(|kind| has_word(&sources, &format!("{kind} {name}")));
            assert!(is_there, "{name} is in none of its files: {row}");
            functions += 1;
        }
    }
    assert!(functions > 15, "{functions}");
}

/// The same bytes everywhere need nalgebra's own functions in Rust, too: see `crates/kinematics/src/trig/mod.rs`.
#[test]
fn nalgebra_computes_with_libm() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let line = manifest.lines().find(|line| line.starts_with("nalgebra = ")).unwrap();
    assert!(line.contains("\"libm-force\""), "{line}");
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let manifest = fs::read_to_string(entry.unwrap().path().join("Cargo.toml")).unwrap();
        let lines = manifest.lines().filter(|line| line.starts_with("nalgebra"));
        assert!(
            lines.into_iter().all(|line| line == "nalgebra.workspace = true"),
            "{manifest}"
        );
    }
}
