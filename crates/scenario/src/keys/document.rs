//! The reference of scenario keys (`docs/scenario.md`), made from the table and the types' defaults.

use crate::keys::key::Key;
use crate::keys::table::{KEYS, LISTS};
use crate::keys::toml_text::on_one_line;
use crate::keys::value::values_of;
use crate::scenario::Scenario;
use std::fmt::Write;

/// Markdown reference of every key: unit, default, range, meaning.
#[must_use]
pub fn reference() -> String {
    let defaults = values_of(&Scenario::default());
    let mut text = String::from(HEAD);
    let mut section = None;
    for (key, is_listed) in in_order() {
        let (here, name) = key.path.rsplit_once('.').unwrap_or(("", key.path));
        if section != Some(here) {
            let title = match (here, is_listed) {
                ("", _) => "Top level".to_owned(),
                (_, false) => format!("`[{here}]`"),
                (_, true) => format!("`[[{here}]]`, as often as there are any"),
            };
            // Writing to a String cannot fail.
            let _ = write!(
                text,
                "\n## {title}\n\n| key | unit | default | range | meaning |\n| --- | --- | --- | --- | --- |\n"
            );
            section = Some(here);
        }
        let default = defaults.get(key.path);
        let default = default.map_or_else(|| "none".to_owned(), |v| format!("`{}`", on_one_line(v)));
        let unit = if key.unit.is_empty() { "–" } else { key.unit };
        let _ = writeln!(
            text,
            "| `{name}` | {unit} | {default} | {} | {} |",
            key.domain.describe(),
            key.meaning
        );
    }
    text
}

/// Every key, and whether it is one of a list: a list stands behind the section that its name begins with, or at the end.
pub(super) fn in_order() -> Vec<(&'static Key, bool)> {
    let mut keys: Vec<_> = KEYS.iter().map(|key| (key, false)).collect();
    for list in LISTS {
        let section = |key: &Key| key.path.split_once('.').map_or("", |(section, _)| section);
        let owner = list.name.split('_').next();
        let behind = keys.iter().rposition(|(key, _)| Some(section(key)) == owner);
        let at = behind.map_or(keys.len(), |last| last + 1);
        keys.splice(at..at, list.keys.iter().map(|key| (key, true)));
    }
    keys
}

const HEAD: &str = "# The scenario file

A TOML file that decides a job in full. Unknown keys, values out of range, NaN and infinity are refused with the line, the
key, what was expected and what was found. `platewash validate --scenario FILE` checks one without running it. Files in
`scenarios/` are shipped: their names work in place of a path.

This page is made from the program's own table of keys by `cargo xtask docs`; a test keeps it current. Places are
those of the world, in metres, z up. The arm's base stands at its origin unless robot.mount_m and robot.mount_rpy_deg say otherwise, and
the floor is at z = 0 unless floor.height_m does. Where a key is in another frame, its row says so.
";

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Sections with a shape state their keys beside their type: both have the same ones.
    #[test]
    fn the_keys_of_bodies_are_those_of_their_types() {
        let body = crate::StatedShape {
            shape: Some(crate::BodyShape::Box),
            size_m: Some([0.1; 3]),
            radius_m: Some(0.1),
            length_m: Some(0.1),
            mesh: Some("a.stl".into()),
            mesh_scale: Some([1.0; 3]),
        };
        let tool_body = crate::ToolBodySection {
            body: body.clone(),
            mass_kg: Some(0.1),
            ..crate::ToolBodySection::default()
        };
        let obstacle = crate::ObstacleSection {
            body,
            mesh_parts: Some(crate::MeshPartsName::Hull),
            at_m: Some([1.0; 3]),
            holds_plates: Some(crate::HeldPlates::These(vec![0])),
            ..crate::ObstacleSection::default()
        };
        let of_types = [
            ("tool_body", toml::Value::try_from(tool_body).unwrap()),
            ("obstacle", toml::Value::try_from(obstacle).unwrap()),
        ];
        for (name, of_type) in of_types {
            let list = LISTS.iter().find(|list| list.name == name).unwrap();
            let mut leaves: Vec<_> = of_type.as_table().unwrap().keys().cloned().collect();
            let mut keys: Vec<_> = list
                .keys
                .iter()
                .map(|key| crate::keys::key::own_name(key).to_owned())
                .collect();
            leaves.sort();
            keys.sort();
            assert_eq!(keys, leaves, "{name}");
        }
    }

    #[test]
    fn every_key_exists_once() {
        let paths: BTreeSet<_> = in_order().iter().map(|(key, _)| key.path).collect();
        assert_eq!(paths.len(), in_order().len());
    }
}
