//! A requirement has one name: in the table of requirements, in the documentation, on the page and in the second prover.

use crate::contact::{disc, rings};
use crate::maker::{good, irb120};
use platewash_certificate::{Certificate, Requirement, RequirementGroup, RequirementRow, Unit, prove};
use platewash_workcell::job::{CONTACT_SPEED_M_S, FixtureTerms, HolderTerms, WRIST_DEG};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Sections of statements, which have a table together.
const STATEMENTS: &str = "1–11. Statements";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(file: &str) -> String {
    fs::read_to_string(root().join(file)).unwrap()
}

fn rows() -> impl Iterator<Item = (Requirement, RequirementRow)> {
    Requirement::ALL
        .iter()
        .map(|&requirement| (requirement, requirement.row()))
}

/// First and last section of a heading: "22, 23. Path deviation" and "12–14. …" have two, "19. Tilt" has one.
fn sections(heading: &str) -> Option<[u8; 2]> {
    let numbers = heading.split_once(". ")?.0.split([',', '–']);
    let numbers: Option<Vec<u8>> = numbers.map(|number| number.trim().parse().ok()).collect();
    let numbers = numbers?;
    Some([*numbers.first()?, *numbers.last()?])
}

/// Joins words as a heading does: "Clearance and reduced clearance".
fn heading_of(names: &[String]) -> String {
    let words = match names {
        [others @ .., last] if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => names.concat(),
    };
    words[..1].to_uppercase() + &words[1..]
}

#[test]
fn headings_of_the_documentation_are_the_words_of_requirements() {
    let page = read("docs/certificate.md");
    let headings = page.lines().filter_map(|line| line.strip_prefix("## "));
    let mut found = BTreeSet::new();
    for (heading, [from, to]) in headings.filter_map(|heading| Some((heading, sections(heading)?))) {
        let own: Vec<_> = rows().filter(|(_, row)| (from..=to).contains(&row.section)).collect();
        found.extend(own.iter().map(|(requirement, _)| *requirement));
        if heading == STATEMENTS {
            for (requirement, row) in own {
                let line = format!(
                    "| {} | {} (`{}`) |",
                    row.section,
                    requirement.words(),
                    requirement.name()
                );
                assert!(page.contains(&line), "{line}");
            }
            continue;
        }
        let names: Vec<_> = own.iter().map(|(requirement, _)| requirement.words()).collect();
        let (_, words) = heading.split_once(". ").unwrap();
        assert_eq!(words, heading_of(&names), "{heading}");
    }
    assert!(found.iter().eq(Requirement::ALL));
    for requirement in Requirement::ALL {
        assert!(page.contains(&format!("`{}`", requirement.name())), "{requirement:?}");
    }
}

#[test]
fn rows_of_contact_are_the_words_and_defaults_of_requirements() {
    use Requirement as R;
    let page = read("docs/contact.md");
    let table = page
        .split("\n## ")
        .find(|part| part.starts_with("Requirements\n"))
        .unwrap();
    let lines = table
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| |") && !line.starts_with("| ---"));
    let mut found = BTreeMap::new();
    for line in lines {
        let mut cells = line.trim_matches('|').split(" | ").map(str::trim);
        let (section, name, default) = (cells.next().unwrap(), cells.next().unwrap(), cells.nth(1).unwrap());
        found.insert(section.to_owned(), (name.to_owned(), default.to_owned()));
    }
    let expected = [
        R::Pressed,
        R::ContactTime,
        R::ContactDose,
        R::Strain,
        R::ContactForce,
        R::ContactSpeed,
        R::Wrist,
        R::PlateStays,
    ];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for requirement in expected {
        let (name, _) = &found[&requirement.row().section.to_string()];
        assert_eq!(*name, format!("{} (`{}`)", requirement.words(), requirement.name()));
    }
    assert_eq!(found["21"].1, format!("{CONTACT_SPEED_M_S} m/s"));
    assert_eq!(found["32"].1, format!("{WRIST_DEG}°"));
}

#[test]
fn requirements_have_a_sentence_and_formulas_of_the_documentation() {
    let both = read("docs/certificate.md") + &read("docs/contact.md");
    for (requirement, row) in rows() {
        assert!(row.sentence.ends_with('.'), "{}", row.sentence);
        for formula in row.formulas {
            assert!(both.contains(&format!("\\tag{{{formula}}}")), "{formula}");
        }
        // Statements, 1 to 11, measure nothing.
        let is_measured = !row.units.is_empty();
        assert_eq!(is_measured, row.section >= 12, "{requirement:?}");
        assert!(!is_measured || !row.formulas.is_empty(), "{requirement:?}");
    }
}

/// The page gets the group of each requirement from the table; its headings are those that its documentation names.
#[test]
fn groups_of_the_page_are_those_of_the_table() {
    let name = |group: RequirementGroup| serde_json::to_value(group).unwrap().as_str().unwrap().to_owned();
    let groups: BTreeSet<_> = rows().map(|(_, row)| name(row.group)).collect();
    let all = [
        RequirementGroup::Washed,
        RequirementGroup::Safe,
        RequirementGroup::WithinLimits,
    ]
    .map(name);
    assert_eq!(groups, BTreeSet::from(all.clone()));
    let [first, second, third] = all;
    let told = format!("in the groups {first}, {second} and {third}");
    assert!(read("docs/viewer.md").contains(&told), "{told}");
    let source = read("crates/viewer/page/src/limits.ts");
    for requirement in Requirement::ALL {
        assert!(
            !source.contains(&format!("\"{}\"", requirement.name())),
            "{requirement:?} is named again"
        );
    }
    // The table of the contact has a column for each of these.
    use Requirement as R;
    let heads = [R::Pressed, R::ContactTime, R::ContactDose, R::Strain, R::ContactForce].map(|requirement| {
        let unit = if requirement == R::ContactForce { " [N]" } else { "" };
        format!("\"{}{unit}\"", requirement.words())
    });
    let heads = format!("const heads = [\"\", {}];", heads.join(", "));
    assert!(
        read("crates/viewer/page/src/shell/requirements.ts").contains(&heads),
        "{heads}"
    );
}

#[test]
fn the_checked_requirements_of_a_program_have_their_words() {
    let page = read("docs/robot-programs.md");
    let part = page
        .split("\n## ")
        .find(|part| part.starts_with("What is checked\n"))
        .unwrap();
    let found = first_column(part, "| requirement | limit |");
    assert!(
        found.contains(&Requirement::PlanDeviation) && found.len() >= 7,
        "{found:?}"
    );
}

/// Requirements in the first column of a table, separated by commas.
fn first_column(text: &str, head: &str) -> BTreeSet<Requirement> {
    let rows = text.lines().skip_while(|line| *line != head).skip(2);
    let cells = rows
        .take_while(|line| line.starts_with('|'))
        .filter_map(|line| line.split('|').nth(1));
    let names = cells.flat_map(|cell| cell.split(','));
    names
        .map(|name| Requirement::named(name).unwrap_or_else(|| panic!("no requirement: {name}")))
        .collect()
}

/// Requirements that the second prover names, as the first argument of its answers, and as keys of shares.
fn of_checker() -> BTreeMap<Requirement, BTreeSet<String>> {
    let mut found: BTreeMap<Requirement, BTreeSet<String>> = BTreeMap::new();
    let folder = root().join("checker/platewash_check");
    for file in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if file.extension().is_none_or(|end| end != "py") {
            continue;
        }
        let text = fs::read_to_string(&file).unwrap();
        for call in ["judged(\"", "stated(\"", "not_checked(\""] {
            for rest in text.split(call).skip(1) {
                let name = rest.split('"').next().unwrap();
                // An answer of its own beside those on requirements.
                if name == "rounding" {
                    continue;
                }
                let requirement =
                    Requirement::named(name).unwrap_or_else(|| panic!("no requirement: {name} in {file:?}"));
                assert_eq!(name, requirement.name());
                let units = found.entry(requirement).or_default();
                if call == "judged(\"" {
                    units.extend(unit_in(rest.lines().next().unwrap()));
                }
            }
        }
        // Shares of a face are judged in a loop over what is asked for; they have no unit.
        for key in ["asked[\"", "asked = {\""] {
            for name in text.split(key).skip(1).map(|rest| rest.split('"').next().unwrap()) {
                let requirement =
                    Requirement::named(name).unwrap_or_else(|| panic!("no requirement: {name} in {file:?}"));
                assert_eq!(name, requirement.name());
                found.entry(requirement).or_default().insert(String::new());
            }
        }
    }
    found
}

/// Unit in the rest of a call, after its first text: the next text that is no key in brackets.
fn unit_in(call: &str) -> Option<String> {
    let parts: Vec<_> = call.split('"').collect();
    let texts = parts[1..].chunks_exact(2);
    let mut others = texts.filter(|pair| !pair[0].ends_with('['));
    others.next().map(|pair| pair[1].to_owned())
}

#[test]
fn the_second_prover_has_the_names_and_units_of_requirements() {
    let found = of_checker();
    let unit_of = |unit: &Unit| match unit {
        // Shares have no unit there.
        Unit::Share => String::new(),
        unit => serde_json::to_value(unit).unwrap().as_str().unwrap().to_owned(),
    };
    for (requirement, units) in &found {
        let allowed: BTreeSet<_> = requirement.row().units.iter().map(unit_of).collect();
        assert!(units.is_subset(&allowed), "{requirement:?}: {units:?}");
    }
    let sources = ["statements", "washing"].map(|name| read(&format!("checker/platewash_check/{name}.py")));
    let sources = sources.concat();
    // What it judges with a number has a theorem.
    let theorems = first_column(&read("checker/README.md"), "| requirement | theorem |");
    for (requirement, row) in rows().filter(|(_, row)| !row.units.is_empty()) {
        let is_judged = !matches!(requirement, Requirement::ReducedClearance | Requirement::PlanDeviation);
        assert_eq!(
            theorems.contains(&requirement),
            is_judged,
            "{requirement:?} in section {}",
            row.section
        );
        // Loops judge some: these names are texts there, or put together of two.
        let (first, last) = requirement.name().split_once('_').unwrap_or((requirement.name(), ""));
        let is_put_together = [first, last]
            .iter()
            .all(|part| sources.contains(&format!("\"{part}\"")));
        let is_named = found.contains_key(&requirement) || sources.contains(&format!("\"{}\"", requirement.name()));
        assert!(
            is_named || is_put_together || !is_judged,
            "{requirement:?} is judged nowhere"
        );
    }
}

fn assert_units(certificate: &Certificate, seen: &mut BTreeSet<Requirement>) {
    for check in &certificate.checks {
        let units = check.requirement.row().units;
        match &check.measure {
            Some(measure) => assert!(
                units.contains(&measure.unit),
                "{:?}: {:?}",
                check.requirement,
                measure.unit
            ),
            None => assert!(units.is_empty(), "{:?} has no measure", check.requirement),
        }
        seen.insert(check.requirement);
    }
}

#[test]
fn measures_have_the_units_of_their_requirements() {
    let mut seen = BTreeSet::new();
    assert_units(&prove(&good(), &irb120()).unwrap(), &mut seen);
    let mut recipe = disc(0.006, 2.0, rings());
    let wanted = &mut recipe.terms.requirements;
    wanted.wrist_rad = Some(0.01);
    wanted.holder = Some(HolderTerms {
        sponge_friction: 0.5,
        plate_mass_kg: None,
        fixture: Some(FixtureTerms {
            force_n: 12.0,
            torque_nm: 1.5,
        }),
        ring: None,
    });
    assert_units(&prove(&recipe.plan(), &irb120()).unwrap(), &mut seen);
    let others: Vec<_> = Requirement::ALL
        .iter()
        .filter(|requirement| !seen.contains(requirement))
        .collect();
    assert_eq!(
        others,
        [
            &Requirement::DryRun,
            &Requirement::ReducedClearance,
            &Requirement::PlanDeviation
        ]
    );
}
