//! Names, followed to what defines them.

use super::module::{Id, Modules, Name};
use std::collections::BTreeSet;

/// What a path ends at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meaning {
    /// An item, or something inside an item, that this module defines.
    Item(Id),
    /// This module itself.
    Module(Id),
    /// Something of another crate, or of the language.
    Elsewhere,
}

/// Names that are being followed already, in these modules: imports may lead round.
type Trail = BTreeSet<(Id, String)>;

impl Modules {
    /// All that a path in a module stands for; nothing if it cannot be followed.
    pub fn meanings(&self, module: Id, path: &[String]) -> BTreeSet<Meaning> {
        self.follow(module, path, &mut Trail::new())
    }

    fn follow(&self, module: Id, path: &[String], trail: &mut Trail) -> BTreeSet<Meaning> {
        let Some((start, rest)) = self.start(module, path) else {
            return BTreeSet::new();
        };
        let mut found = BTreeSet::from([Meaning::Module(start)]);
        for (place, name) in rest.iter().enumerate() {
            // Beside a module of its name, what is no module is a function, in which nothing can be named.
            let modules = found.iter().any(|meaning| matches!(meaning, Meaning::Module(_)));
            let mut next = BTreeSet::new();
            for meaning in found {
                match meaning {
                    Meaning::Module(at) => next.extend(self.look_up(at, module, name, trail)),
                    Meaning::Item(_) if modules => {}
                    Meaning::Item(_) | Meaning::Elsewhere => drop(next.insert(meaning)),
                }
            }
            if next.is_empty() && place == 0 && rest.len() == path.len() {
                // No name of this crate begins so.
                next.insert(Meaning::Elsewhere);
            }
            found = next;
        }
        found
    }

    /// The module where a path begins, and the names that are left.
    fn start<'p>(&self, module: Id, path: &'p [String]) -> Option<(Id, &'p [String])> {
        let mut at = module;
        let mut rest = path;
        while let Some((first, more)) = rest.split_first() {
            match first.as_str() {
                "crate" => at = 0,
                "self" => {}
                "super" => at = self.all[at].parent?,
                _ => break,
            }
            rest = more;
        }
        Some((at, rest))
    }

    /// What a name stands for in a module, as it is seen from another one.
    fn look_up(&self, at: Id, from: Id, name: &str, trail: &mut Trail) -> BTreeSet<Meaning> {
        let within = self.chain(from).contains(&at);
        let bindings = self.all[at].names.get(name).into_iter().flatten();
        let bindings = bindings.filter(|binding| binding.open || within);
        let key = (at, name.to_owned());
        // Met again on its own way, a name stands for what needs no import: `use step::step` begins at the module.
        let first = trail.insert(key.clone());
        let mut found = BTreeSet::new();
        for binding in bindings {
            match &binding.name {
                Name::Item => drop(found.insert(Meaning::Item(at))),
                Name::Module(child) => drop(found.insert(Meaning::Module(*child))),
                Name::Import(path) if first => found.extend(self.follow(at, path, trail)),
                Name::Import(_) => {}
            }
        }
        if !first {
            return found;
        }
        if found.is_empty() {
            found = self.by_globs(at, within, name, trail);
        }
        trail.remove(&key);
        found
    }

    /// What a name stands for in a module by its imports of all that others hold.
    fn by_globs(&self, at: Id, within: bool, name: &str, trail: &mut Trail) -> BTreeSet<Meaning> {
        let mut found = BTreeSet::new();
        let mut elsewhere = false;
        for glob in self.all[at].globs.iter().filter(|glob| glob.open || within) {
            for meaning in self.follow(at, &glob.path, &mut trail.clone()) {
                match meaning {
                    Meaning::Module(source) => found.extend(self.look_up(source, at, name, trail)),
                    Meaning::Item(_) => {}
                    Meaning::Elsewhere => elsewhere = true,
                }
            }
        }
        if elsewhere && found.is_empty() {
            found.insert(Meaning::Elsewhere);
        }
        found
    }
}
