//! The reference of scenario keys (`docs/scenario.md`), made from the table and the types' defaults.

use crate::key::Key;
use crate::keys::KEYS;
use crate::lists::LISTS;
use crate::scenario::Scenario;
use crate::values::values_of;
use crate::write::on_one_line;
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
fn in_order() -> Vec<(&'static Key, bool)> {
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

    fn leaves(value: &toml::Value, prefix: &str, into: &mut BTreeSet<String>) {
        for (name, v) in value.as_table().unwrap() {
            match v {
                toml::Value::Table(_) => leaves(v, &format!("{prefix}{name}."), into),
                toml::Value::Array(all) if all.first().is_some_and(toml::Value::is_table) => {
                    leaves(&all[0], &format!("{prefix}{name}."), into);
                }
                _ => {
                    into.insert(format!("{prefix}{name}"));
                }
            }
        }
    }

    /// The table and the types know the same keys: every optional one is filled in here.
    #[test]
    fn the_table_lists_the_types_keys_and_no_others() {
        let mut full = Scenario::default();
        (full.robot.urdf, full.robot.srdf) = (Some("a".into()), Some("b".into()));
        full.robot.package_path = vec!["c".into()];
        (full.robot.start_deg, full.robot.home_deg) = (Some([0.0; 6]), Some([0.0; 6]));
        full.robot.payload_kg = Some(3.0);
        full.tool.mounted_on = Some("flange".to_owned());
        (full.tool.com_m, full.tool.inertia_kg_m2) = (Some(0.1), Some([0.0; 6]));
        full.tool.sponge_stiffness_kpa = Some([11.0, 44.0]);
        let every = crate::StatedShape {
            shape: Some(crate::BodyShape::Box),
            size_m: Some([0.1; 3]),
            radius_m: Some(0.1),
            length_m: Some(0.1),
            mesh: Some("a.stl".into()),
            mesh_scale: Some([1.0; 3]),
        };
        full.tool_body = vec![crate::ToolBodySection {
            body: every.clone(),
            mass_kg: Some(0.1),
            ..crate::ToolBodySection::default()
        }];
        full.obstacle = vec![crate::ObstacleSection {
            body: every,
            mesh_parts: Some(crate::MeshPartsName::Hull),
            at_m: Some([1.0; 3]),
            holds_plates: Some(crate::HeldPlates::These(vec![0])),
            ..crate::ObstacleSection::default()
        }];
        (full.floor.height_m, full.floor.margin_m) = (Some(0.0), Some(0.0));
        full.table = crate::TableSection {
            size_m: Some([1.0; 2]),
            height_m: Some(0.7),
            thickness_m: Some(0.03),
            at_m: Some([0.0; 2]),
            yaw_deg: Some(0.0),
            margin_m: Some(0.0),
        };
        full.plate = vec![crate::PlateSection {
            at_m: Some([0.3, 0.0, 0.03]),
            rpy_deg: Some([0.0; 3]),
            faces: Some(crate::Faces::Both),
            count: Some(2),
            radius_m: Some(0.1),
            profile: Some(crate::layout::ProfileName::Flat),
            knots: Some(vec![[0.1, 0.0]]),
            foot_m: Some([0.05, 0.01]),
            thickness_m: Some(0.02),
        }];
        let wash = &mut full.wash;
        (wash.pattern, wash.turns) = (Some(platewash_workcell::job::PatternName::Rings), Some(2.0));
        (wash.path_radius_m, wash.closing_ring) = (Some(0.1), Some(true));
        (wash.tilt_deg, wash.axis_share, wash.wrist_min_deg) = (Some(8.0), Some(0.5), Some(3.0));
        (wash.landing_speed_m_s, wash.lifting_speed_m_s) = (Some(0.05), Some(0.05));
        (wash.contact_compression_m, wash.contact_height_error_m) = (Some(1e-3), Some(1e-3));
        (wash.contact_share, wash.contact_strain, wash.contact_force_n) = (Some(0.9), Some(0.6), Some([1.0, 40.0]));
        (wash.contact_time_s, wash.contact_time_share) = (Some(0.1), Some(0.9));
        (wash.contact_dose_pa_m, wash.contact_dose_share) = (Some(50.0), Some(0.9));
        full.control.law = Some(platewash_workcell::simulation::ControlLawName::Pd);
        (full.control.joint_kp, full.control.joint_kd) = (Some([0.0; 6]), Some([0.0; 6]));
        full.plant.torque_limit_n_m = Some([1.0; 6]);
        (full.plant.contact_stiffness_pa, full.plant.contact_damping_pa_s) = (Some(2e4), Some(0.0));
        full.plant.contact_force_n = Some(0.0);
        let layout = &mut full.layout;
        (layout.plate_radius_m, layout.plate_profile) = (Some(0.1), Some(crate::layout::ProfileName::Flat));
        (layout.plate_knots, layout.plate_foot_m) = (Some(vec![[0.1, 0.0]]), Some([0.05, 0.01]));
        layout.region = Some(crate::layout::RegionName::Text);
        (layout.x_m, layout.y_m) = (Some([0.0, 1.0]), Some([0.0, 1.0]));
        (layout.rho_m, layout.azimuth_deg) = (Some([0.0, 1.0]), Some([0.0, 1.0]));
        layout.positions_m = Some(vec![[0.3, 0.0]]);
        full.transition.mid_radius_m = Some(0.3);
        let mut of_types = BTreeSet::new();
        leaves(&toml::Value::try_from(full).unwrap(), "", &mut of_types);
        let rows = in_order();
        let of_table: BTreeSet<_> = rows.iter().map(|(key, _)| key.path.to_owned()).collect();
        assert_eq!(of_table, of_types);
        assert_eq!(of_table.len(), rows.len(), "no key twice");
    }

    #[test]
    fn the_committed_page_is_current() {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scenario.md");
        if std::env::var_os("PLATEWASH_WRITE_DOCS").is_some() {
            std::fs::write(page, reference()).unwrap();
        }
        let committed = std::fs::read_to_string(page).unwrap();
        assert!(
            committed == reference(),
            "docs/scenario.md is out of date: run `cargo xtask docs`"
        );
    }
}
