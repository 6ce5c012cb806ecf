//! Cells that are refused, or told: by which file, line and key, and in which words.

use super::*;

const CELL: &str = "name = \"t\"
[robot]
start_deg = [0, 0, 0, 0, 90, 0]
[tool]
length_m = 0.15
[layout]
plate_radius_m = 0.1
positions_m = [[0.35, 0.1]]
[wash]
height_m = 0
";

/// A box, from line 11 on.
fn with_box(dir: &Path, name: &str, at_m: &str, more: &str) {
    let text = format!(
        "{CELL}[[obstacle]]\nname = \"{name}\"\nshape = \"box\"\nsize_m = [0.1, 0.1, 0.1]\nat_m = {at_m}\n{more}"
    );
    std::fs::write(dir.join("cell.toml"), text).unwrap();
}

/// What `validate` lets pass is not refused before planning, and the other way round.
#[test]
fn every_verb_rejects_invalid_obstacles_by_file_and_key() {
    let folder = folder();
    let dir = folder.path();
    let far = "[1, 1, 1]";
    for (name, at_m, more, words) in [
        (
            "x",
            far,
            "holds_plates = [5]",
            "scenario cell.toml, line 16: obstacle[0].holds_plates: it holds the plate with index 5; there is 1 plate",
        ),
        (
            "sponge",
            far,
            "",
            "scenario cell.toml: obstacle[0].name: 'sponge' is the name of the sponge",
        ),
        (
            "x",
            "[-0.1, 0, 0.05]",
            "",
            "scenario cell.toml: obstacle 'x' reaches 90.0 mm into base_link",
        ),
        (
            "",
            far,
            "",
            "scenario cell.toml, line 12: obstacle[0].name must be text, not empty, without control or direction characters; found \"\"",
        ),
    ] {
        with_box(dir, name, at_m, more);
        for verb in ["validate", "plan", "run"] {
            platewash(dir, &[verb, "--scenario", "cell.toml"]).refused(2, &[words]);
        }
    }
}

/// No home is looked for where something stands in the base, nor for a program that needs none.
#[test]
fn names_the_bodies_that_leave_no_home() {
    let folder = folder();
    let dir = folder.path();
    with_box(dir, "x", "[-0.1, 0, 0.05]", "");
    let suggest = |scenario: &str| platewash(dir, &["robot", "--suggest", "--scenario", scenario]);
    suggest("cell.toml").refused(2, &["obstacle 'x' reaches 90.0 mm into base_link"]);
    suggest("paper-text").refused(
        2,
        &[
            "wash.height_m: what is suggested is for a certified job",
            "it needs wash.height_m = 0",
        ],
    );
}

#[test]
fn layouts_say_which_plates_are_tilted() {
    let folder = folder();
    let said = platewash(folder.path(), &["layout", "--scenario", "rack"])
        .done()
        .stdout;
    assert_eq!(said.matches("tilted by ").count(), 3, "{said}");
    let said = platewash(folder.path(), &["layout", "--scenario", "kitchen"])
        .done()
        .stdout;
    assert!(!said.contains("tilted"), "{said}");
}

#[test]
fn alignment_takes_no_seed() {
    let folder = folder();
    platewash(folder.path(), &["align", "touched.csv", "--seed", "2"]).refused(
        2,
        &["--seed: align needs no more than the points of its file and the links of an arm"],
    );
}
