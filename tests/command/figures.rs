//! A plan as pictures.

use super::*;

/// A plan of the paper's program.
fn planned() -> TempDir {
    let folder = folder();
    platewash(folder.path(), &["plan", "--scenario", "paper-appendix", "--out", "."]).done();
    folder
}

fn size(png: &[u8]) -> [u32; 2] {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

#[test]
fn each_figure_is_written_twice_and_named() {
    let folder = planned();
    let drawn = platewash(folder.path(), &["figures", "plan.json", "--json", "--quiet"]).done();
    let answer = drawn.json();
    assert_eq!(answer["left_out"].as_array().unwrap().len(), 0, "{answer}");
    let wanted = [
        "cleaning", "coverage", "flow", "joints", "layout", "sheet", "spiral", "transit",
    ];
    let files: Vec<String> = wanted
        .iter()
        .flat_map(|name| [format!("{name}.png"), format!("{name}.svg")])
        .collect();
    let out = folder.path().join("figures");
    assert_eq!(names(&out), files);
    assert_eq!(answer["written"].as_array().unwrap().len(), files.len());
    for name in wanted {
        let svg = std::fs::read_to_string(out.join(format!("{name}.svg"))).unwrap();
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"), "{name}");
        assert_eq!(
            size(&std::fs::read(out.join(format!("{name}.png"))).unwrap()),
            [1600, 1000]
        );
    }
    // The sheet says what was measured.
    let sheet = std::fs::read_to_string(out.join("sheet.svg")).unwrap();
    assert!(sheet.contains("216 of 220") && sheet.contains("the paper takes for granted"));
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
    assert_eq!(one.len(), 6);
    assert!(one == draw("3"));
}

#[test]
fn what_cannot_be_drawn_is_refused_and_nothing_is_written() {
    let folder = planned();
    let refused = |arguments: &[&str], fragments: &[&str]| {
        let line = [&["figures", "plan.json"], arguments].concat();
        platewash(folder.path(), &line).refused(2, fragments);
        assert!(!folder.path().join("figures").exists(), "{arguments:?}");
    };
    refused(&["--only", "layuot"], &["layuot", "layout, cleaning, transit"]);
    refused(&["--only", "moment"], &["plan.json", "--at SECONDS"]);
    refused(&["--at", "9"], &["plan.json", "from 0 to 3.7 s", "9 s"]);
    refused(&["--at", "nan"], &["NaN"]);
    refused(&["--at", "soon"], &["--at"]);
    refused(&["--scenario", "kitchen"], &["--scenario"]);
    std::fs::write(folder.path().join("none.json"), "{}").unwrap();
    platewash(folder.path(), &["figures", "none.json"]).refused(2, &["none.json"]);
    // A file stands where the folder should be.
    platewash(folder.path(), &["figures", "plan.json", "--out", "none.json"]).refused(2, &["none.json"]);
}
