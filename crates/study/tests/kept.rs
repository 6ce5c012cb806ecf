//! What is kept: a finished study stays as it is, and files are looked at within bounds.

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
fn a_finished_study_is_not_rewritten_and_changes_are_refused() {
    let study = four();
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let mut journal = Journal::open(out, &study).unwrap();
    journal.append(&empty(&study, 2).into(), Duration::ZERO).unwrap();
    assert!(!journal.finish().unwrap() && read_manifest(out).unwrap().rows_sha256.is_none());
    let (make, cancel) = (
        |index, _: &CancelToken| Ok(Some(empty(&study, index).into())),
        CancelToken::new(),
    );
    run(&mut journal, &cancel, make, |_| ()).unwrap();
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
    run(&mut journal, &cancel, make, |_| ()).unwrap();
    drop(journal);
    assert_eq!(state(), before);
    fs::remove_file(out.join("timings.jsonl")).unwrap();
    assert_eq!(Journal::open(out, &study).unwrap().done(), 4);
    assert!(!out.join("timings.jsonl").exists());
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

fn four() -> Study {
    let text = "format = \"platewash-study/1\"\nname = \"p\"\nscenario = \"kitchen\"\n[[axis]]\nkey = \"seed\"\nseeds = \"1..4\"\n";
    Study::parse(text, "p.toml", Path::new("")).unwrap()
}

/// An editor that saves, or a copy that comes back.
#[test]
fn rows_removed_meanwhile_are_computed_again() {
    let (study, folder) = (four(), tempfile::tempdir().unwrap());
    let out = folder.path();
    let mut journal = Journal::open(out, &study).unwrap();
    for index in 0..4 {
        journal.append(&empty(&study, index).into(), Duration::ZERO).unwrap();
        if index == 1 {
            let [rows, copy] = ["rows.jsonl", "copy"].map(|name| out.join(name));
            fs::copy(&rows, &copy).unwrap();
            fs::rename(&copy, &rows).unwrap();
        }
    }
    let error = journal.finish().unwrap_err().to_string();
    assert!(
        error.contains("rows.jsonl: has 2 rows, though 4 were written"),
        "{error}"
    );
    assert_eq!(read_manifest(out).unwrap().rows_sha256, None);
    drop(journal);
    let mut journal = Journal::open(out, &study).unwrap();
    assert_eq!(journal.missing().collect::<Vec<_>>(), [2, 3]);
    for index in [2, 3] {
        journal.append(&empty(&study, index).into(), Duration::ZERO).unwrap();
    }
    assert!(journal.finish().unwrap());
    assert_eq!(export(out, &mut Vec::new(), Path::new("bytes")).unwrap(), 4);
}

#[test]
fn never_overwrites_files_of_other_origin() {
    let study = four();
    for name in ["study.toml", "study.json", "rows.jsonl", "timings.jsonl"] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(name), "mine\n").unwrap();
        let error = Journal::open(folder.path(), &study).err().unwrap().to_string();
        assert!(error.contains(name) && error.contains("give another folder"), "{error}");
        assert_eq!(fs::read_to_string(folder.path().join(name)).unwrap(), "mine\n");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
    // Whoever was ended at the very beginning has left its own.
    let folder = tempfile::tempdir().unwrap();
    drop(Journal::open(folder.path(), &study).unwrap());
    for gone in ["manifest.json", "study.json"] {
        fs::remove_file(folder.path().join(gone)).unwrap();
        assert_eq!(Journal::open(folder.path(), &study).unwrap().done(), 0);
        assert!(folder.path().join(gone).is_file());
    }
}

#[test]
fn readers_refuse_altered_rows_of_an_unfinished_study() {
    let (study, folder) = (four(), tempfile::tempdir().unwrap());
    let out = folder.path();
    let mut journal = Journal::open(out, &study).unwrap();
    for index in 0..2 {
        journal.append(&empty(&study, index).into(), Duration::ZERO).unwrap();
    }
    drop(journal);
    let path = out.join("rows.jsonl");
    let kept = fs::read_to_string(&path).unwrap();
    let first = kept.lines().next().unwrap();
    let anyone: [(String, &str); 5] = [
        (kept.replace('\n', "\r\n"), "line 1: row 0 is not as it was written"),
        (
            kept.replacen("\"index\":1", "\"index\": 1", 1),
            "line 2: row 1 is not as it was written",
        ),
        (
            kept.replacen("\"schema\":2", "\"schema\":1", 1),
            "line 1: is a row of schema 1",
        ),
        (
            kept.replacen("\"index\":1", "\"index\":4", 1),
            "line 2: row 4 is none of 4",
        ),
        (format!("{kept}{first}\n"), "line 3: row 0 is there before"),
    ];
    let only_the_study: [(String, &str); 2] = [
        (kept.replacen("\"seed\":2", "\"seed\":3", 1), "line 2: row 1"),
        (
            kept.replacen("\"scenario\":\"kitchen\"", "\"scenario\":\"sink\"", 1),
            "line 1: row 0",
        ),
    ];
    for (place, (changed, words)) in anyone.iter().chain(&only_the_study).enumerate() {
        assert_ne!(*changed, kept);
        fs::write(&path, changed).unwrap();
        let mut errors = vec![Journal::open(out, &study).err()];
        if place < anyone.len() {
            errors.extend([summary(out).err(), export(out, &mut Vec::new(), Path::new("b")).err()]);
        }
        for error in errors {
            let error = error.unwrap().to_string();
            assert!(error.contains("rows.jsonl: ") && error.contains(words), "{error}");
        }
        assert_eq!(fs::read_to_string(&path).unwrap(), *changed);
    }
}

#[test]
fn an_unfinished_study_restores_its_damaged_manifest() {
    let (study, folder) = (four(), tempfile::tempdir().unwrap());
    let out = folder.path();
    drop(Journal::open(out, &study).unwrap());
    for name in ["study.json", "study.toml"] {
        let whole = fs::read(out.join(name)).unwrap();
        for torn in [&whole[..whole.len() / 2], b""] {
            fs::write(out.join(name), torn).unwrap();
            drop(Journal::open(out, &study).unwrap());
            assert_eq!(fs::read(out.join(name)).unwrap(), whole, "{name}");
        }
    }
    assert_eq!(Study::load(out).unwrap().parts(), study.parts());
}

#[test]
fn a_manifest_of_other_axes_is_refused() {
    let (study, folder) = (four(), tempfile::tempdir().unwrap());
    let out = folder.path();
    let mut journal = Journal::open(out, &study).unwrap();
    journal.append(&empty(&study, 0).into(), Duration::ZERO).unwrap();
    drop(journal);
    let whole = fs::read_to_string(out.join("manifest.json")).unwrap();
    let begin = whole.find("\"axes\": [").unwrap() + 9;
    let end = begin + whole[begin..].find(']').unwrap();
    let axis = whole[begin..end].trim();
    for axes in [String::new(), format!("{axis}, {axis}")] {
        fs::write(
            out.join("manifest.json"),
            format!("{}{axes}{}", &whole[..begin], &whole[end..]),
        )
        .unwrap();
        let error = Journal::open(out, &study).err().unwrap().to_string();
        assert!(error.contains("an axis"), "{error}");
        for error in [summary(out).err(), export(out, &mut Vec::new(), Path::new("b")).err()] {
            let error = error.unwrap().to_string();
            assert!(
                error.contains("line 1: row 0 has other axes than manifest.json states"),
                "{error}"
            );
        }
    }
}

/// Nobody knows how long a row took that killed its worker.
#[test]
fn an_ended_row_has_no_duration() {
    let (study, folder) = (four(), tempfile::tempdir().unwrap());
    let out = folder.path();
    let mut journal = Journal::open(out, &study).unwrap();
    let crashed = study.ended(1, Outcome::Crashed, "gone").unwrap();
    journal.append(&crashed.into(), None).unwrap();
    journal.append(&empty(&study, 0).into(), Duration::ZERO).unwrap();
    assert_eq!(journal.done(), 2);
    let timings = fs::read_to_string(out.join("timings.jsonl")).unwrap();
    assert_eq!(timings, "{\"index\":0,\"wall_s\":0.0}\n");
}

#[test]
fn checks_ten_thousand_values_and_reports_the_last_error() {
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
fn bounds_combinations_of_files_and_rejects_words_as_files() {
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
fn file_paths_are_relative_to_the_folder_of_the_study() {
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
