//! The words of the documents name what is in the code: the glossary of the proof, and the files that pages of docs name.

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
