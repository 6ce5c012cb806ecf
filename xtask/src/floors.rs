//! Which crate may know which, which words belong to which crate, and how large a crate may be.

use proc_macro2::{TokenStream, TokenTree};
use std::collections::BTreeSet;

/// The project's own packages, and what each may depend on among them; the root package may know all that are below it.
///
/// Packages that are not named here are no part of the product: the chores and what the benchmarks need.
const FLOORS: [(&str, &[&str]); 15] = [
    ("platewash-bundler", &[]),
    ("platewash-keys", &[]),
    ("platewash-kinematics", &[]),
    ("platewash-workcell", &["platewash-kinematics"]),
    ("platewash-certificate", &["platewash-kinematics", "platewash-workcell"]),
    ("platewash-simulator", &["platewash-kinematics", "platewash-workcell"]),
    ("platewash-planner", &["platewash-kinematics", "platewash-workcell"]),
    (
        "platewash-paper",
        &["platewash-kinematics", "platewash-workcell", "platewash-simulator"],
    ),
    (
        "platewash-scenario",
        &[
            "platewash-keys",
            "platewash-kinematics",
            "platewash-workcell",
            "platewash-certificate",
            "platewash-simulator",
            "platewash-planner",
            "platewash-paper",
        ],
    ),
    (
        "platewash-viewer",
        &[
            "platewash-kinematics",
            "platewash-workcell",
            "platewash-certificate",
            "platewash-simulator",
        ],
    ),
    (
        "platewash-export",
        &["platewash-kinematics", "platewash-workcell", "platewash-certificate"],
    ),
    (
        "platewash-editor",
        &[
            "platewash-kinematics",
            "platewash-workcell",
            "platewash-certificate",
            "platewash-planner",
            "platewash-scenario",
            "platewash-viewer",
        ],
    ),
    (
        "platewash-study",
        &[
            "platewash-kinematics",
            "platewash-workcell",
            "platewash-certificate",
            "platewash-planner",
            "platewash-scenario",
        ],
    ),
    (
        "platewash",
        &[
            "platewash-kinematics",
            "platewash-workcell",
            "platewash-certificate",
            "platewash-simulator",
            "platewash-planner",
            "platewash-paper",
            "platewash-scenario",
            "platewash-viewer",
            "platewash-export",
            "platewash-editor",
            "platewash-study",
        ],
    ),
    ("pyplatewash", &["platewash"]),
];

/// The crate that alone knows the sections of a scenario file.
const OF_SECTIONS: &str = "platewash-scenario";
/// The wheel, which is named after Python's way.
const WHEEL: &str = "pyplatewash";
/// The crates beyond it that may name a whole scenario: those that people change or make one with, or many.
const OF_SCENARIOS: [&str; 3] = ["platewash-editor", "platewash-study", WHEEL];

/// Largest share of the library's lines that one package may have: one in this many.
const SHARES: usize = 4;

/// What is wrong with a package's dependencies.
pub fn misplaced(package: &str, dependencies: &BTreeSet<String>) -> Vec<String> {
    let own = |name: &str| name.starts_with("platewash") || name == WHEEL;
    let known = dependencies.iter().filter(|name| own(name));
    let Some((_, allowed)) = FLOORS.iter().find(|(name, _)| *name == package) else {
        return vec![format!(
            "{package} has no floor: xtask/src/floors.rs names those that have one"
        )];
    };
    let unwanted = known.filter(|name| !allowed.contains(&name.as_str()));
    unwanted
        .map(|name| match allowed {
            [] => format!("{package} depends on {name}; it may know no crate of the project"),
            _ => format!("{package} depends on {name}; it may know {}", allowed.join(", ")),
        })
        .collect()
}

/// The scenario's types that a source of a package names and should not, each once. Comments and texts do not count.
///
/// # Errors
/// A source that is no Rust.
pub fn foreign_types(package: &str, source: &str) -> Result<BTreeSet<String>, proc_macro2::LexError> {
    let mut words = BTreeSet::new();
    collect_words(source.parse()?, &mut words);
    words.retain(|word| match word.as_str() {
        "Scenario" => package != OF_SECTIONS && !OF_SCENARIOS.contains(&package),
        _ => word.len() > "Section".len() && word.ends_with("Section") && package != OF_SECTIONS,
    });
    Ok(words)
}

fn collect_words(tokens: TokenStream, words: &mut BTreeSet<String>) {
    for token in tokens {
        match token {
            TokenTree::Ident(word) => drop(words.insert(word.to_string())),
            TokenTree::Group(group) => collect_words(group.stream(), words),
            _ => {}
        }
    }
}

/// Packages with more than their share of all lines.
pub fn too_large(lines: &[(String, usize)]) -> Vec<String> {
    let all: usize = lines.iter().map(|(_, lines)| lines).sum();
    let large = lines.iter().filter(|(_, lines)| lines * SHARES > all);
    large
        .map(|(package, lines)| format!("{package} has {lines} of {all} lines; at most one in {SHARES} is wanted"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn misplaced_of(package: &str, dependencies: &[&str]) -> Vec<String> {
        misplaced(package, &dependencies.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn a_crate_knows_only_what_is_below_it() {
        assert!(
            misplaced_of(
                "platewash-planner",
                &["nalgebra", "platewash-kinematics", "platewash-workcell"]
            )
            .is_empty()
        );
        assert!(misplaced_of("platewash-kinematics", &["nalgebra"]).is_empty());
        assert!(misplaced_of("pyplatewash", &["platewash", "pyo3"]).is_empty());
        let upward = misplaced_of("platewash-certificate", &["platewash-planner", "platewash-workcell"]);
        let expected =
            "platewash-certificate depends on platewash-planner; it may know platewash-kinematics, platewash-workcell";
        assert_eq!(upward, [expected]);
        let lowest = misplaced_of("platewash-kinematics", &["platewash-workcell"]);
        assert_eq!(
            lowest,
            ["platewash-kinematics depends on platewash-workcell; it may know no crate of the project"]
        );
        assert_eq!(
            misplaced_of("pyplatewash", &["platewash", "platewash-planner"]).len(),
            1
        );
        assert_eq!(misplaced_of("platewash", &["pyplatewash"]).len(), 1);
    }

    #[test]
    fn a_crate_without_a_floor_is_named() {
        let found = misplaced_of("platewash-attic", &[]);
        assert_eq!(
            found,
            ["platewash-attic has no floor: xtask/src/floors.rs names those that have one"]
        );
    }

    /// Each floor is written after those that it stands on: no two of them can know each other.
    #[test]
    fn floors_stand_on_earlier_ones() {
        for (at, (name, allowed)) in FLOORS.iter().enumerate() {
            for below in *allowed {
                assert!(
                    FLOORS[..at].iter().any(|(earlier, _)| earlier == below),
                    "{name}: {below}"
                );
            }
        }
    }

    #[test]
    fn sections_are_named_in_one_crate() {
        let source = "/// Reads a `Scenario`.\nfn f(s: &Scenario) { g(\"WashSection\", s.wash as x::WashSection, Section, Sectional) }";
        let found = |package| foreign_types(package, source).unwrap().into_iter().collect::<Vec<_>>();
        assert_eq!(found("platewash-planner"), ["Scenario", "WashSection"]);
        for package in OF_SCENARIOS {
            assert_eq!(found(package), ["WashSection"]);
        }
        assert!(found("platewash-scenario").is_empty());
        assert!(
            foreign_types("platewash-planner", "/// Scenario\nstruct Scenarios;")
                .unwrap()
                .is_empty()
        );
    }

    #[test]
    fn more_than_a_quarter_of_the_lines_is_too_much() {
        let lines = |counts: [usize; 4]| counts.map(|lines| ("crate".to_owned(), lines));
        assert!(too_large(&lines([25, 25, 25, 25])).is_empty());
        assert_eq!(
            too_large(&lines([26, 25, 25, 25])),
            ["crate has 26 of 101 lines; at most one in 4 is wanted"]
        );
    }
}
