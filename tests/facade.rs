//! The façade stays small, and the command and the wheel go through it.

use std::fs;
use std::path::{Path, PathBuf};

/// Most items at the root, the modules apart, and most modules.
const MOST_ITEMS: usize = 60;
const MOST_MODULES: usize = 16;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// What a source makes public at its root: modules, and other items.
#[derive(Debug, Default, PartialEq)]
struct Public {
    modules: Vec<String>,
    items: Vec<String>,
}

impl Public {
    /// Of a source whose root re-exports and declares modules, and nothing else but what documentation tests alone see.
    fn of(source: &str) -> Self {
        let code: Vec<_> = source
            .lines()
            .map(|line| line.split("//").next().unwrap_or_default())
            .collect();
        let code = code.join("\n");
        let (seen, hidden) = code.split_once("#[cfg(doctest)]").unwrap_or((&code, ""));
        assert!(
            hidden.matches("pub ").count() <= 1,
            "one item is seen by documentation tests"
        );
        let mut public = Self::default();
        for statement in seen
            .split([';', '}'])
            .filter_map(|text| Some(text.split_once("pub ")?.1))
        {
            match statement.split_once(' ') {
                Some(("mod", name)) => public.modules.push(name.to_owned()),
                Some(("use", path)) => public.export(path),
                _ => public.items.push(statement.to_owned()),
            }
        }
        public
    }

    /// A path as it stands behind `use`, without a closing brace.
    fn export(&mut self, path: &str) {
        match (path.split_once('{'), path.split_once(" as ")) {
            (Some((_, names)), _) => {
                let names = names.split(',').map(str::trim).filter(|name| !name.is_empty());
                self.items.extend(names.map(str::to_owned));
            }
            // A whole crate under another name.
            (_, Some((from, name))) if !from.contains("::") => self.modules.push(name.to_owned()),
            _ => self.items.push(path.rsplit("::").next().unwrap_or(path).to_owned()),
        }
    }
}

#[test]
fn public_items_are_counted() {
    let source = "//! pub mod no;\n#[cfg(x)]\npub mod cli;\nmod own;\npub use a_b as b;\npub use a::c::d;\n\
                  pub use a::{E,\n    f, // pub g\n};\npub const H: u8 = 1;\n#[cfg(doctest)]\npub struct I;\n";
    let found = Public::of(source);
    assert_eq!(found.modules, ["cli", "b"]);
    assert_eq!(found.items, ["d", "E", "f", "const H: u8 = 1"]);
}

#[test]
fn the_facade_stays_small() {
    let found = Public::of(&fs::read_to_string(root().join("src/lib.rs")).unwrap());
    assert!(found.modules.len() <= MOST_MODULES, "{:?}", found.modules);
    assert!(
        found.items.len() <= MOST_ITEMS,
        "{}: {:?}",
        found.items.len(),
        found.items
    );
    // It is read at all.
    assert!(
        found.modules.iter().any(|name| name == "planner"),
        "{:?}",
        found.modules
    );
    for name in ["Scenario", "plan", "prove", "simulate", "sweep"] {
        assert!(
            found.items.iter().any(|item| item == name),
            "{name} is none of {:?}",
            found.items
        );
    }
    assert!(
        !found.items.iter().any(|item| item.contains('*')),
        "nothing is re-exported by a glob"
    );
}

/// All sources below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            all.extend(sources(&path));
        } else if path.extension().is_some_and(|ext| ext == "rs") {
            all.push(path);
        }
    }
    all
}

/// The crates behind the façade that a source names.
fn crates_named(source: &str) -> Vec<&str> {
    let words = source.split(|c: char| !c.is_alphanumeric() && c != '_');
    words.filter(|word| word.starts_with("platewash_")).collect()
}

#[test]
fn the_command_and_the_wheel_use_only_the_facade() {
    assert_eq!(
        crates_named("use platewash_planner::plan; pyplatewash_x"),
        ["platewash_planner"]
    );
    for folder in ["src/cli", "crates/pyplatewash/src"] {
        let all = sources(&root().join(folder));
        assert!(all.len() > 10, "{folder}: {}", all.len());
        for path in all {
            let source = fs::read_to_string(&path).unwrap();
            let named = crates_named(&source);
            assert!(named.is_empty(), "{}: {named:?}", path.display());
        }
    }
}
