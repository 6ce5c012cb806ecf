//! The files of the checkout by their names.

use anyhow::{Context, Result};
use std::collections::BTreeSet;
use std::path::Path;

/// What lies in a checkout and is none of its sources.
const LEFT_OUT: [&str; 7] = [".git", ".venv", "__pycache__", "dist", "node_modules", "out", "target"];

/// Names of files, relative to one folder, with `/` between their parts.
#[derive(Debug)]
pub struct Tree(BTreeSet<String>);

impl Tree {
    /// The files below a folder.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub fn of(root: &Path) -> Result<Self> {
        let mut files = BTreeSet::new();
        let mut left = vec![String::new()];
        while let Some(at) = left.pop() {
            let folder = root.join(&at);
            for entry in std::fs::read_dir(&folder).with_context(|| folder.display().to_string())? {
                let entry = entry?;
                let name = entry.file_name().to_string_lossy().into_owned();
                let place = if at.is_empty() {
                    name.clone()
                } else {
                    format!("{at}/{name}")
                };
                if !entry.file_type()?.is_dir() {
                    files.insert(place);
                } else if !LEFT_OUT.contains(&name.as_str()) {
                    left.push(place);
                }
            }
        }
        Ok(Self(files))
    }

    /// Whether there is a file or a folder of that name; the last part may have one `*`.
    pub fn has(&self, name: &str) -> bool {
        let name = name.trim_end_matches('/');
        match name.split_once('*') {
            Some((start, end)) => self.0.iter().any(|file| {
                let rest = file.strip_prefix(start).and_then(|rest| rest.strip_suffix(end));
                rest.is_some_and(|rest| !rest.contains('/'))
            }),
            None => self.0.contains(name) || self.is_folder(name),
        }
    }

    /// Whether there is a folder of that name.
    pub fn is_folder(&self, name: &str) -> bool {
        let inside = format!("{}/", name.trim_end_matches('/'));
        self.0
            .range(inside.clone()..)
            .next()
            .is_some_and(|file| file.starts_with(&inside))
    }

    /// Whether some file or folder's name ends so, from the beginning of one of its parts on.
    pub fn has_at_the_end(&self, name: &str) -> bool {
        let folder = format!("/{}/", name.trim_end_matches('/'));
        self.has(name) || self.0.iter().any(|file| format!("/{file}/").contains(&folder))
    }
}

impl<'a> FromIterator<&'a str> for Tree {
    fn from_iter<I: IntoIterator<Item = &'a str>>(names: I) -> Self {
        Self(names.into_iter().map(str::to_owned).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_folders_and_stars_are_found() {
        let tree = Tree::from_iter(["a/b/c.rs", "a/bc.rs", "d.md"]);
        for name in ["a", "a/", "a/b", "a/b/c.rs", "d.md", "a/*.rs", "*.md", "a/b*.rs"] {
            assert!(tree.has(name), "{name}");
        }
        for name in ["b", "a/c", "a/bc", "a/b/c", "*.rs", "a/*.md"] {
            assert!(!tree.has(name), "{name}");
        }
        assert!(tree.is_folder("a/b/") && !tree.is_folder("d.md"));
        assert!(tree.has_at_the_end("b/c.rs") && tree.has_at_the_end("b/") && !tree.has_at_the_end("c"));
    }

    #[test]
    fn the_checkout_is_read_without_what_is_built() {
        let tree = Tree::of(&platewash_bundler::root()).unwrap();
        assert!(tree.has("xtask/src/tree.rs") && !tree.is_folder("target") && !tree.is_folder(".git"));
    }
}
