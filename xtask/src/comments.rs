//! Doc comments open with their subject.

use crate::sources::collect;
use platewash_bundler::root;

/// Words that open a sentence without a subject.
const OPENINGS: [&str; 9] = ["What", "How", "Whether", "Where", "Why", "That", "Of", "Those", "Who"];

#[test]
fn doc_comments_open_with_their_subject() {
    let mut files = Vec::new();
    for folder in ["crates", "src"] {
        collect(&root(), folder.into(), &mut files).unwrap();
    }
    let is_source = |file: &&std::path::PathBuf| {
        file.extension().is_some_and(|extension| extension == "rs") && file.iter().all(|part| part != "tests")
    };
    let mut found = Vec::new();
    for file in files.iter().filter(is_source) {
        let text = std::fs::read_to_string(root().join(file)).unwrap();
        let mut before = "";
        for line in text.lines().map(str::trim) {
            let opening = line.strip_prefix("/// ").filter(|_| !before.starts_with("///"));
            let word = opening.and_then(|text| text.split(' ').next()).unwrap_or_default();
            if OPENINGS.contains(&word) {
                found.push(format!("{}: {line}", file.display()));
            }
            before = line;
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}
