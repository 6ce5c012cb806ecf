//! A limit on doc comments that open without their subject.

use platewash_bundler::root;
use std::path::Path;

/// Most doc comments that may open without their subject: docstrings of Python and meanings of scenario keys.
const MOST: usize = 62;
/// Words that open a sentence without a subject.
const OPENINGS: [&str; 9] = ["What", "How", "Whether", "Where", "Why", "That", "Of", "Those", "Who"];

#[test]
fn doc_comments_open_with_their_subject() {
    let mut found = Vec::new();
    collect(&root().join("crates"), &mut found);
    collect(&root().join("src"), &mut found);
    assert!(
        found.len() <= MOST,
        "{} of at most {MOST}:\n{}",
        found.len(),
        found.join("\n")
    );
}

fn collect(folder: &Path, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            if !["tests", "target", "node_modules"]
                .iter()
                .any(|name| entry.ends_with(name))
            {
                collect(&entry, found);
            }
        } else if entry.extension().is_some_and(|extension| extension == "rs") {
            let text = std::fs::read_to_string(&entry).unwrap();
            let mut before = "";
            for line in text.lines().map(str::trim) {
                let opening = line.strip_prefix("/// ").filter(|_| !before.starts_with("///"));
                let word = opening.and_then(|text| text.split(' ').next()).unwrap_or_default();
                if OPENINGS.contains(&word) {
                    found.push(format!("{}: {line}", entry.display()));
                }
                before = line;
            }
        }
    }
}
