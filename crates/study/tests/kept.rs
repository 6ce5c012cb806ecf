//! What is kept: a finished study stays as it is, and files are looked at within bounds.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use platewash_scenario::SHIPPED;
use platewash_study::{Journal, Outcome, Row, Study, export, read_manifest, run, summary};
use platewash_workcell::cancel::CancelToken;
use std::fs;
use std::path::Path;
use std::time::Duration;

fn empty(study: &Study, index: u64) -> Row {
    study.ended(index, Outcome::NotFound, "none").unwrap()
}

#[test]
fn what_is_finished_is_not_written_any_more_and_a_change_is_refused() {
    let text = "format = \"platewash-study/1\"\nname = \"p\"\nscenario = \"kitchen\"\n[[axis]]\nkey = \"seed\"\nseeds = \"1..4\"\n";
    let study = Study::parse(text, "p.toml", Path::new("")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let mut journal = Journal::open(out, &study).unwrap();
    journal.append(&empty(&study, 2).into(), Duration::ZERO).unwrap();
    assert!(!journal.finish().unwrap() && read_manifest(out).unwrap().rows_sha256.is_none());
    let (make, cancel) = (
        |index, _: &CancelToken| Ok(Some(empty(&study, index).into())),
        CancelToken::new(),
    );
    run(&study, &mut journal, &cancel, make, |_| ()).unwrap();
    drop(journal);
    let names = ["manifest.json", "study.toml", "rows.jsonl", "timings.jsonl"];
    let state = || {
        names.map(|name| {
            (
                fs::read(out.join(name)).unwrap(),
                fs::metadata(out.join(name)).unwrap().modified().unwrap(),
            )
        })
    };
    let before = state();
    let mut journal = Journal::open(out, &study).unwrap();
    run(&study, &mut journal, &cancel, make, |_| ()).unwrap();
    drop(journal);
    assert_eq!(state(), before);
    let mut bytes = Vec::new();
    assert_eq!(export(out, &mut bytes, Path::new("bytes")).unwrap(), 4);

    // A word more in a reason, and a row that is gone.
    let rows = String::from_utf8(before[2].0.clone()).unwrap();
    let gone = rows.lines().skip(1).map(|line| format!("{line}\n")).collect::<String>();
    for changed in [rows.replacen("none", "nothing", 1), gone] {
        assert_ne!(changed, rows);
        fs::write(out.join("rows.jsonl"), &changed).unwrap();
        bytes.clear();
        let refused = [
            export(out, &mut bytes, Path::new("bytes")).err(),
            summary(out).err(),
            Journal::open(out, &study).err(),
        ];
        for error in refused {
            let error = error.unwrap().to_string();
            assert!(
                error.contains("rows.jsonl: the rows were changed since the study was finished"),
                "{error}"
            );
        }
        assert!(bytes.is_empty());
        assert_eq!(fs::read_to_string(out.join("rows.jsonl")).unwrap(), changed);
    }
    // In another order they are the same rows.
    fs::write(
        out.join("rows.jsonl"),
        rows.lines().rev().map(|line| format!("{line}\n")).collect::<String>(),
    )
    .unwrap();
    assert_eq!(export(out, &mut bytes, Path::new("bytes")).unwrap(), 4);
}

#[test]
fn ten_thousand_values_are_looked_at_and_the_last_is_told() {
    let values: Vec<_> = (0..10_000)
        .map(|k| format!("{}", 0.001 + 1e-7 * f64::from(k)))
        .collect();
    let text = |last: &str| {
        format!(
            "format = \"platewash-study/1\"\nname = \"v\"\nscenario = \"kitchen\"\n[[axis]]\nkey = \"wash.clearance_m\"\nvalues = [{}, {last}]\n",
            values[1..].join(", ")
        )
    };
    assert_eq!(
        Study::parse(&text("0.5e-3"), "v.toml", Path::new("")).unwrap().rows(),
        10_000
    );
    let error = Study::parse(&text("-1"), "v.toml", Path::new(""))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("line 5") && error.contains("kitchen: wash.clearance_m must be"),
        "{error}"
    );
}

#[test]
fn combinations_of_files_are_bounded_and_words_are_no_files() {
    let head = "format = \"platewash-study/1\"\nname = \"v\"\nscenario = \"kitchen\"\n";
    let names: Vec<_> = (0..1001).map(|k| format!("\"{k}.urdf\"")).collect();
    let axis = |key: &str, values: &str| format!("[[axis]]\nkey = \"{key}\"\nvalues = [{values}]\n");
    let error = Study::parse(
        &format!("{head}{}", axis("robot.urdf", &names.join(", "))),
        "v.toml",
        Path::new(""),
    );
    let error = error.unwrap_err().to_string();
    assert!(
        error.contains("v.toml") && error.contains("1000 combinations of files"),
        "{error}"
    );
    let words = axis("name", &names.join(", "));
    assert_eq!(
        Study::parse(&format!("{head}{words}"), "v.toml", Path::new(""))
            .unwrap()
            .rows(),
        1001
    );
}

/// The same study by a path from here, and by its whole path.
#[test]
fn files_are_named_from_the_folder_of_the_study() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    fs::write(dir.join("arm.urdf"), platewash_kinematics::irb120::IRB120_URDF).unwrap();
    let kitchen = SHIPPED.iter().find(|shipped| shipped.name == "kitchen").unwrap().text;
    assert!(kitchen.contains("[robot]\n"));
    let base = kitchen.replacen("[robot]\n", "[robot]\nurdf = \"arm.urdf\"\n", 1);
    fs::write(dir.join("base.toml"), base).unwrap();
    fs::write(
        dir.join("a.toml"),
        "format = \"platewash-study/1\"\nname = \"a\"\nscenario = \"base.toml\"\n",
    )
    .unwrap();
    drop(Journal::open(&dir.join("out"), &Study::load(&dir.join("a.toml")).unwrap()).unwrap());
    let files = read_manifest(&dir.join("out")).unwrap().files;
    assert_eq!(
        files.iter().map(|file| file.path.as_str()).collect::<Vec<_>>(),
        ["arm.urdf"]
    );
    let elsewhere = dir.join("out").join("..").join("a.toml");
    Journal::open(&dir.join("out"), &Study::load(&elsewhere).unwrap()).unwrap();
}
