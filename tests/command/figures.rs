//! A plan as pictures.

use super::*;

/// A plan of the paper's program.
fn planned() -> TempDir {
    let folder = folder();
    platewash(folder.path(), &["plan", "--scenario", "paper-appendix", "--out", "."]).done();
    folder
}

#[test]
fn each_figure_is_written_and_named() {
    let folder = planned();
    let drawn = platewash(folder.path(), &["figures", "plan.json", "--json", "--quiet"]).done();
    let answer = drawn.json();
    assert_eq!(answer["left_out"].as_array().unwrap().len(), 0, "{answer}");
    let wanted = ["coverage.svg", "joints.svg", "layout.svg", "spiral.svg"];
    let out = folder.path().join("figures");
    assert_eq!(names(&out), wanted);
    assert_eq!(answer["written"].as_array().unwrap().len(), wanted.len());
    for name in wanted {
        let svg = std::fs::read_to_string(out.join(name)).unwrap();
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"), "{name}");
        assert!(svg.contains("the paper's program"), "{name}");
    }
}

#[test]
fn the_figures_do_not_depend_on_the_number_of_threads() {
    let folder = planned();
    let draw = |threads: &str| {
        let line = [
            "figures",
            "plan.json",
            "--only",
            "coverage,joints,layout",
            "--out",
            threads,
            "--threads",
            threads,
        ];
        platewash(folder.path(), &line).done();
        let out = folder.path().join(threads);
        let files = names(&out)
            .into_iter()
            .map(|name| std::fs::read(out.join(name)).unwrap());
        files.collect::<Vec<_>>()
    };
    let one = draw("1");
    assert_eq!(one.len(), 3);
    assert!(one == draw("3"));
}

#[test]
fn refuses_impossible_figures_and_writes_nothing() {
    let folder = planned();
    let refused = |arguments: &[&str], fragments: &[&str]| {
        let line = [&["figures", "plan.json"], arguments].concat();
        platewash(folder.path(), &line).refused(2, fragments);
        assert!(!folder.path().join("figures").exists(), "{arguments:?}");
    };
    refused(&["--only", "layuot"], &["layuot", "layout, joints, coverage, spiral"]);
    refused(&["--scenario", "kitchen"], &["--scenario"]);
    std::fs::write(folder.path().join("none.json"), "{}").unwrap();
    platewash(folder.path(), &["figures", "none.json"]).refused(2, &["none.json"]);
    // A file stands where the folder should be.
    platewash(folder.path(), &["figures", "plan.json", "--out", "none.json"]).refused(2, &["none.json"]);
}
