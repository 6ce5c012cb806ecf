//! Rings of modules: files of a crate that import each other in a circle, so that a reader can begin with none of them.
//!
//! A file imports the file that each of its paths names: those of `use`, re-exports too, and those in the code that begin with `crate`,
//! `super`, `self` or a child module. A folder's `mod.rs` is a file like any other, and so is `lib.rs`. Modules of tests count for nothing.

use crate::sources::collect;
use platewash_bundler::root;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The rings that are left, each with its reason: crate, files. At most 6.
const LEFT: [(&str, &str); 1] = [
    // The file of a pattern states all of it, and asks the curve that it belongs to: to add a pattern is one file and four lines.
    (
        "workcell",
        "crate::wash_path crate::wash_path::pattern crate::wash_path::rings crate::wash_path::spiral",
    ),
];

/// The rings of the folders and files at the top of a crate that are left, though none of their files is in a ring.
const LEFT_FOLDERS: [(&str, &str); 3] = [
    // The report holds what each folder found, and each names its requirement as the report does.
    (
        "certificate",
        "crate::clearance crate::judged_job crate::motion crate::plan_statements crate::report crate::washing",
    ),
    // A description makes the arm, and the arm keeps what was left out of its description.
    ("kinematics", "crate::model crate::urdf"),
    // The scenario is its sections; their keys, and the errors that name keys, are made of the sections.
    (
        "scenario",
        "crate::error crate::failure crate::keys crate::scenario crate::sections crate::source crate::to_job crate::units",
    ),
];

/// A module of a crate: its path from the root of the crate.
type Module = Vec<String>;

/// The files that each file of a crate imports.
type Imports = BTreeMap<Module, BTreeSet<Module>>;

/// Returns the files of the modules in the folder `src` of a crate; without modules of tests.
fn modules(src: &Path) -> BTreeMap<Module, PathBuf> {
    let mut files = Vec::new();
    collect(src, PathBuf::new(), &mut files).unwrap();
    let mut modules = BTreeMap::new();
    for file in files
        .iter()
        .filter(|file| file.extension().is_some_and(|extension| extension == "rs"))
    {
        let mut module: Module = file
            .with_extension("")
            .iter()
            .map(|part| part.to_string_lossy().into_owned())
            .collect();
        let last = module.last().map(String::as_str);
        let is_root = module.len() == 1 && matches!(last, Some("lib" | "main"));
        if is_root || last == Some("mod") {
            module.pop();
        }
        if !module.iter().any(|part| part == "tests") {
            modules.insert(module, src.join(file));
        }
    }
    modules
}

/// The words and signs of a source that paths are made of; without comments, texts and the module of tests at the end.
fn tokens(source: &str) -> Vec<String> {
    let end = source.find("mod tests {").unwrap_or(source.len());
    let mut rest = &source[..end];
    let mut tokens: Vec<String> = Vec::new();
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if first == '"' {
            text_length(rest)
        } else if first.is_alphanumeric() || first == '_' {
            let end = rest
                .find(|c: char| !c.is_alphanumeric() && c != '_')
                .unwrap_or(rest.len());
            tokens.push(rest[..end].to_owned());
            end
        } else if rest.starts_with("::") {
            tokens.push("::".to_owned());
            2
        } else if rest.starts_with("'\"'") {
            3
        } else {
            if !first.is_whitespace() {
                tokens.push(first.to_string());
            }
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    tokens
}

/// Bytes of the text in quotes that `source` begins with.
fn text_length(source: &str) -> usize {
    let mut is_escaped = false;
    let is_end = |(k, c): &(usize, char)| {
        let ends = *c == '"' && *k > 0 && !is_escaped;
        is_escaped = *c == '\\' && !is_escaped;
        ends
    };
    source.char_indices().find(is_end).map_or(source.len(), |(k, _)| k + 1)
}

/// All paths of a source, with those of the trees of `use` written out.
fn paths(tokens: &[String]) -> Vec<Module> {
    let is_word = |token: &String| token.starts_with(|c: char| c.is_alphabetic() || c == '_');
    let (mut paths, mut k) = (Vec::new(), 0);
    while k < tokens.len() {
        let begins = is_word(&tokens[k]) && (k == 0 || tokens[k - 1] != "::");
        if tokens[k] == "use" {
            k = tree(tokens, k + 1, &[], &mut paths);
        } else if begins {
            let mut path = vec![tokens[k].clone()];
            while tokens.get(k + 1).is_some_and(|token| token == "::") && tokens.get(k + 2).is_some_and(is_word) {
                path.push(tokens[k + 2].clone());
                k += 2;
            }
            if path.len() > 1 {
                paths.push(path);
            }
            k += 1;
        } else {
            k += 1;
        }
    }
    paths
}

/// Reads a tree of `use` from the token `k` on; returns the index behind it.
fn tree(tokens: &[String], mut k: usize, prefix: &[String], paths: &mut Vec<Module>) -> usize {
    let mut path = prefix.to_vec();
    while let Some(token) = tokens.get(k) {
        match token.as_str() {
            "::" => {}
            "{" => loop {
                k = tree(tokens, k + 1, &path, paths);
                match tokens.get(k).map(String::as_str) {
                    Some(",") => {}
                    _ => return k + 1,
                }
            },
            "as" => k += 1,
            "," | "}" | ";" => break,
            word => path.push(word.to_owned()),
        }
        k += 1;
    }
    if path.len() > prefix.len() {
        paths.push(path);
    }
    k
}

/// The file that a path of the module `from` names; `None` for a path out of the crate.
fn named(from: &Module, path: &[String], modules: &BTreeMap<Module, PathBuf>) -> Option<Module> {
    let mut base = from.clone();
    let mut rest = path;
    match path[0].as_str() {
        "crate" => (base, rest) = (Module::new(), &path[1..]),
        "self" => rest = &path[1..],
        "super" => {
            while rest.first().is_some_and(|word| word == "super") {
                base.pop();
                rest = &rest[1..];
            }
        }
        child => {
            base.push(child.to_owned());
            if !modules.contains_key(&base) {
                return None;
            }
            rest = &path[1..];
        }
    }
    for word in rest {
        base.push(word.clone());
        if !modules.contains_key(&base) {
            base.pop();
            break;
        }
    }
    Some(base)
}

/// The files that each file of the crate in the folder `src` imports.
fn imports(src: &Path) -> Imports {
    let modules = modules(src);
    let of_module = |(module, file): (&Module, &PathBuf)| {
        let source = std::fs::read_to_string(file).unwrap();
        let named = paths(&tokens(&source))
            .into_iter()
            .filter_map(|path| named(module, &path, &modules));
        (module.clone(), named.filter(|other| other != module).collect())
    };
    modules.iter().map(of_module).collect()
}

/// The rings: the largest sets of files each of which imports every other, over other files or at once.
fn rings(imports: &Imports) -> Vec<BTreeSet<Module>> {
    let reached = |from: &Module| {
        let (mut found, mut open) = (BTreeSet::new(), vec![from.clone()]);
        while let Some(module) = open.pop() {
            for next in imports.get(&module).into_iter().flatten() {
                if found.insert(next.clone()) {
                    open.push(next.clone());
                }
            }
        }
        found
    };
    let reached: BTreeMap<&Module, BTreeSet<Module>> = imports.keys().map(|module| (module, reached(module))).collect();
    let ring = |module: &Module| -> BTreeSet<Module> {
        let mutual = reached[module].iter().filter(|other| reached[other].contains(module));
        mutual.cloned().collect()
    };
    let rings: BTreeSet<BTreeSet<Module>> = imports.keys().map(ring).filter(|ring| !ring.is_empty()).collect();
    rings.into_iter().collect()
}

/// The imports of the folders and files at the top of a crate, each taken as one; what `lib.rs` imports is left out.
fn rooms(imports: &Imports) -> Imports {
    let mut rooms = Imports::new();
    for (module, others) in imports.iter().filter(|(module, _)| !module.is_empty()) {
        let room = module[..1].to_vec();
        let others = others.iter().filter_map(|other| Some(vec![other.first()?.clone()]));
        let others = others.filter(|other| *other != room).collect::<Vec<_>>();
        rooms.entry(room).or_default().extend(others);
    }
    rooms
}

/// The rings in words: the paths of their modules.
fn in_words(imports: &Imports) -> Vec<String> {
    let words = |ring: BTreeSet<Module>| {
        let path = |module: &Module| [vec!["crate".to_owned()], module.clone()].concat().join("::");
        ring.iter().map(path).collect::<Vec<_>>().join(" ")
    };
    rings(imports).into_iter().map(words).collect()
}

/// The rings of each crate that `of` makes of its imports, with the crate's name.
fn in_crates(of: fn(&Imports) -> Imports) -> Vec<(String, String)> {
    let mut crates: Vec<PathBuf> = std::fs::read_dir(root().join("crates"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    crates.extend([root(), root().join("urdf"), root().join("xtask")]);
    crates.retain(|place| place.join("src").is_dir());
    crates.sort();
    let mut found = Vec::new();
    for place in &crates {
        let name = place.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let rings = in_words(&of(&imports(&place.join("src"))));
        found.extend(rings.into_iter().map(|ring| (name.clone(), ring)));
    }
    found
}

fn owned<const N: usize>(left: [(&str, &str); N]) -> Vec<(String, String)> {
    left.map(|(name, ring)| (name.to_owned(), ring.to_owned())).to_vec()
}

#[test]
fn files_do_not_import_each_other_in_a_circle() {
    assert_eq!(
        in_crates(Imports::clone),
        owned(LEFT),
        "a ring of files: move what both need to a file below them, or import it where it is defined"
    );
}

#[test]
fn folders_of_a_crate_do_not_import_each_other_in_a_circle() {
    assert_eq!(
        in_crates(rooms),
        owned(LEFT_FOLDERS),
        "a ring of folders: move what both need to a file beside them"
    );
}

#[test]
fn a_ring_is_found_in_trees_of_use_and_in_the_code() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let place = folder.path().join(name);
        std::fs::create_dir_all(place.parent().unwrap()).unwrap();
        std::fs::write(place, text).unwrap();
    };
    write("lib.rs", "mod a; mod b; mod c;\npub use a::First;\n");
    write(
        "a.rs",
        "use std::fmt;\nuse crate::{b::{self, Second as Other}, c::Third};\nstruct First;\n",
    );
    write(
        "b/mod.rs",
        "mod d;\n// crate::c::Third is no import\nconst TEXT: &str = \"crate::c\";\npub struct Second;\n",
    );
    write(
        "b/d.rs",
        "fn of() { super::super::a::First::new() }\n#[cfg(test)]\nmod tests { use crate::c; }\n",
    );
    write("c.rs", "pub struct Third;\n");
    assert_eq!(in_words(&imports(folder.path())), Vec::<String>::new());
    write("b/mod.rs", "mod d;\npub use self::d::of;\n");
    assert_eq!(in_words(&imports(folder.path())), ["crate::a crate::b crate::b::d"]);
    write("c.rs", "use crate::First;\n");
    assert_eq!(
        in_words(&imports(folder.path())),
        ["crate crate::a crate::b crate::b::d crate::c"]
    );
}
