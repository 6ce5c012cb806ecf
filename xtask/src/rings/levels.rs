//! Rings among the members of each level of a crate.

use super::module::{Id, Mention, Modules, shown};
use super::resolve::Meaning;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A member of a level uses another one: the place that shows it.
struct Example {
    module: Id,
    line: usize,
    path: String,
}

/// Uses among the members of one level: the children of a module, and its own file under its own number.
type Level = BTreeMap<(Id, Id), Example>;

/// Every ring of a crate, as text with one example for each use; files are named relative to `root`.
pub fn rings(modules: &Modules, root: &Path) -> Vec<String> {
    let levels = levels(modules);
    let rings = levels.iter().flat_map(|(parent, level)| {
        let rings = components(level).into_iter();
        rings.map(move |ring| text(modules, root, *parent, level, &ring))
    });
    rings.collect()
}

/// Paths within the crate that end at nothing that was read: where there are any, rings may be missed.
pub fn lost(modules: &Modules, root: &Path) -> Vec<String> {
    let lost = mentions(modules).filter(|(id, mention)| modules.meanings(*id, &mention.path).is_empty());
    lost.map(|(id, mention)| {
        format!(
            "{}: `{}` cannot be followed",
            place(modules, root, id, mention.line),
            mention.path.join("::")
        )
    })
    .collect()
}

fn mentions(modules: &Modules) -> impl Iterator<Item = (Id, &Mention)> {
    let modules = modules.all.iter().enumerate();
    modules.flat_map(|(id, module)| module.mentions.iter().map(move |mention| (id, mention)))
}

fn place(modules: &Modules, root: &Path, id: Id, line: usize) -> String {
    let file = &modules.all[id].file;
    format!("{}:{line}", shown(file.strip_prefix(root).unwrap_or(file)))
}

fn levels(modules: &Modules) -> BTreeMap<Id, Level> {
    let mut levels: BTreeMap<Id, Level> = BTreeMap::new();
    for (module, mention) in mentions(modules) {
        for meaning in modules.meanings(module, &mention.path) {
            // To name a module is not yet to use what it holds.
            let Meaning::Item(definer) = meaning else { continue };
            let Some((parent, edge)) = edge(modules, module, definer, mention) else {
                continue;
            };
            let example = || Example {
                module,
                line: mention.line,
                path: mention.path.join("::"),
            };
            levels.entry(parent).or_default().entry(edge).or_insert_with(example);
        }
    }
    levels
}

/// The level at which two modules part, and their members of it.
fn edge(modules: &Modules, user: Id, definer: Id, mention: &Mention) -> Option<(Id, (Id, Id))> {
    let (users, definers) = (modules.chain(user), modules.chain(definer));
    let common = users.iter().zip(&definers).take_while(|(a, b)| a == b).count();
    let parent = *users.get(common.checked_sub(1)?)?;
    let member = |chain: &[Id]| chain.get(common).copied().unwrap_or(parent);
    let edge = (member(&users), member(&definers));
    let handed_on = edge.0 == parent && mention.reexport;
    (edge.0 != edge.1 && !handed_on).then_some((parent, edge))
}

/// Members that can be reached from each other, two or more.
fn components(level: &Level) -> Vec<BTreeSet<Id>> {
    let members: BTreeSet<Id> = level.keys().flat_map(|(user, definer)| [*user, *definer]).collect();
    let reached: BTreeMap<Id, BTreeSet<Id>> = members.iter().map(|member| (*member, reach(level, *member))).collect();
    let both = |a: &Id, b: &Id| reached[a].contains(b) && reached[b].contains(a);
    let rings = members
        .iter()
        .map(|a| members.iter().filter(|b| both(a, b)).copied().collect());
    let rings: BTreeSet<BTreeSet<Id>> = rings.filter(|ring: &BTreeSet<Id>| !ring.is_empty()).collect();
    rings.into_iter().collect()
}

fn reach(level: &Level, start: Id) -> BTreeSet<Id> {
    let mut seen = BTreeSet::new();
    let mut left = vec![start];
    while let Some(at) = left.pop() {
        let next = level
            .keys()
            .filter(|(user, _)| *user == at)
            .map(|(_, definer)| *definer);
        left.extend(next.filter(|definer| seen.insert(*definer)));
    }
    seen
}

fn text(modules: &Modules, root: &Path, parent: Id, level: &Level, ring: &BTreeSet<Id>) -> String {
    let name = |id: Id| {
        if id == parent {
            format!("{}'s own file", modules.path(id))
        } else {
            modules.path(id)
        }
    };
    let names: Vec<String> = ring.iter().map(|id| name(*id)).collect();
    let uses = level
        .iter()
        .filter(|((user, definer), _)| ring.contains(user) && ring.contains(definer));
    let uses = uses.map(|((user, definer), example)| {
        let place = place(modules, root, example.module, example.line);
        format!(
            "\n    {} uses {}: {place} (`{}`)",
            name(*user),
            name(*definer),
            example.path
        )
    });
    format!("{}{}", names.join(" ↔ "), uses.collect::<String>())
}
