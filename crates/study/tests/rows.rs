//! Rows are the same bytes however they were made, and none is lost.

use platewash_study::{Journal, Outcome, Row, RowMaker, RowWithPlan, Study, StudyError, export, run, summary};
use platewash_workcell::cancel::CancelToken;
use proptest::prelude::*;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

const GRID: &str = "format = \"platewash-study/1\"\nname = \"grid\"\nscenario = [\"kitchen\", \"sink\"]\n[[axis]]\nkey = \"wash.clearance_m\"\nrange = [0.001, 0.004, 4]\n[[axis]]\nkey = \"seed\"\nseeds = \"1..5\"\n";

fn study(text: &str) -> Result<Study, StudyError> {
    Study::parse(text, "grid.toml", Path::new(""))
}

/// A row of a planner that does nothing.
fn empty(study: &Study, index: u64) -> RowWithPlan {
    let address = study.row(index).unwrap();
    let text = format!(
        "{{\"schema\":2,\"index\":{index},\"key\":\"{}\",\"scenario\":\"{}\",\"axes\":{},\"outcome\":\"not_found\",\"reason\":\"none\",\
         \"place\":{{}},\"duration_s\":0.1}}",
        address.key,
        study.bases[address.base].name,
        serde_json::to_string(&address.axes).unwrap()
    );
    serde_json::from_str::<Row>(&text).unwrap().into()
}

fn exported(folder: &Path) -> Vec<u8> {
    let mut bytes = Vec::new();
    export(folder, &mut bytes, Path::new("bytes")).unwrap();
    bytes
}

fn undisturbed(study: &Study) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let mut journal = Journal::open(folder.path(), study).unwrap();
    for index in 0..study.rows() {
        journal.append(&empty(study, index), Duration::ZERO).unwrap();
    }
    exported(folder.path())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// In any order, torn at any byte, gone on with by any number of threads.
    #[test]
    fn any_order_any_cut_and_any_threads_give_the_same_bytes(
        order in Just((0..40_u64).collect::<Vec<_>>()).prop_shuffle(),
        done in 0_usize..40,
        torn in 0_u64..600,
        threads in 1_usize..5,
    ) {
        let study = study(GRID).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let mut journal = Journal::open(folder.path(), &study).unwrap();
        for index in &order[..done] {
            journal.append(&empty(&study, *index), Duration::ZERO).unwrap();
        }
        drop(journal);
        let rows = fs::File::options().write(true).open(folder.path().join("rows.jsonl")).unwrap();
        let length = rows.metadata().unwrap().len();
        rows.set_len(length.saturating_sub(torn)).unwrap();
        drop(rows);
        let mut journal = Journal::open(folder.path(), &study).unwrap();
        prop_assert!(journal.done() <= done as u64);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&mut journal, &CancelToken::new(), |i, _| Ok(Some(empty(&study, i))), |_| ())).unwrap();
        prop_assert_eq!(journal.done(), study.rows());
        prop_assert_eq!(exported(folder.path()), undisturbed(&study));
    }
}

#[test]
fn axes_multiply_and_the_last_is_the_fastest() {
    let study = study(GRID).unwrap();
    assert_eq!(study.rows(), 40);
    let row = study.row(20 + 5 + 2).unwrap();
    assert_eq!(
        (row.base, &row.axes["seed"], row.axes["wash.clearance_m"].as_f64()),
        (1, &3.into(), Some(0.002))
    );
    let keys: std::collections::BTreeSet<_> = (0..40).map(|i| study.row(i).unwrap().key).collect();
    assert_eq!(keys.len(), 40);
    assert!(matches!(study.row(40), Err(StudyError::NoRow { .. })));
    assert!(study_text_has(&study, 27, "clearance_m = 0.002"));
}

fn study_text_has(study: &Study, index: u64, part: &str) -> bool {
    study.scenario_text(index).unwrap().contains(part)
}

#[test]
fn errors_of_a_study_name_line_and_key() {
    let axis = "seeds = \"1..5\"";
    let cases = [
        ("seeds = \"5..1\"", "line 9", "FIRST..LAST"),
        ("values = []", "line 9", "values of seed"),
        ("values = [1, 2.0, 2]", "line 9", "twice"),
        ("values = [1, nan]", "line 9", "found nan"),
        ("values = [-1]", "line 8", "seed must be"),
        ("range = [1, inf, 3]", "line 9", "range of seed"),
        ("range = [1, 3, 4000000000]", "line 9", "range of seed"),
        ("steps = 3", "line 9", "unknown key 'steps'"),
        ("seeds = 3", "line 9", "must be a text; found 3"),
        ("", "line 7", "needs one of"),
        ("seeds = \"1..9000000\"", "", "more than 10000000 rows"),
        (
            "seeds = \"1..5\"\n[[axis]]\nkey = \"seed\"\nvalues = [1]",
            "line 11",
            "there is an axis of seed before",
        ),
        (
            "seeds = \"1..5\"\n[[axis]]\nkey = \"tool.lenth_m\"\nvalues = [1]",
            "line 11",
            "unknown key 'tool.lenth_m'",
        ),
        ("seeds = \"1..5\"\n[[rows]]\nseed = 1", "line 10", "found both"),
    ];
    for (text, line, part) in cases {
        let error = study(&GRID.replace(axis, text)).unwrap_err().to_string();
        assert!(
            error.contains("study grid.toml") && error.contains(line) && error.contains(part),
            "{text}: {error}"
        );
        assert!(!error.contains('\n'), "{error}");
    }
    for (was, is, part) in [
        ("study/1", "study/2", "format"),
        ("\"sink\"", "\"kitchen\"", "twice"),
        ("sink", "paper-text", "paper"),
        ("sink", "none", "neither"),
    ] {
        let error = study(&GRID.replace(was, is)).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn reads_rows_one_by_one() {
    let head = "format = \"platewash-study/1\"\nname = \"rows\"\nscenario = \"kitchen\"\n";
    let rows = "[[rows]]\nseed = 7\nwash.clearance_m = 0.002\n[[rows]]\nseed = 9\n\"wash.clearance_m\" = 0.003\n";
    let listed = study(&format!("{head}{rows}")).unwrap();
    assert_eq!((listed.rows(), &listed.row(1).unwrap().axes["seed"]), (2, &9.into()));
    for (more, part) in [
        ("[[rows]]\nseed = 1\n", "same keys"),
        ("[[rows]]\nseed = 7\nwash.clearance_m = 2e-3\n", "before"),
    ] {
        let error = study(&format!("{head}{rows}{more}")).unwrap_err().to_string();
        assert!(error.contains(part) && error.contains("line 10"), "{error}");
    }
}

#[test]
fn a_folder_keeps_one_study_and_one_process_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let first = study(GRID).unwrap();
    let mut journal = Journal::open(folder.path(), &first).unwrap();
    assert!(matches!(
        Journal::open(folder.path(), &first),
        Err(StudyError::Busy { .. })
    ));
    journal.append(&empty(&first, 3), Duration::ZERO).unwrap();
    journal.append(&empty(&first, 3), Duration::ZERO).unwrap();
    drop(journal);
    let other = study(&GRID.replace("1..5", "1..6")).unwrap();
    let error = Journal::open(folder.path(), &other).err().unwrap().to_string();
    assert!(
        error.contains("another study") && error.contains("the study file"),
        "{error}"
    );
    assert_eq!(Journal::open(folder.path(), &first).unwrap().done(), 1);
    let path = folder.path().join("rows.jsonl");
    let line = fs::read(&path).unwrap();
    fs::OpenOptions::new()
        .append(true)
        .open(&path)
        .unwrap()
        .write_all(&line)
        .unwrap();
    let error = Journal::open(folder.path(), &first).err().unwrap().to_string();
    assert!(error.contains("line 2: row 3 is there before"), "{error}");
}

#[test]
fn cancelled_studies_keep_their_finished_rows() {
    let (folder, study, cancel) = (tempfile::tempdir().unwrap(), study(GRID).unwrap(), CancelToken::new());
    let mut journal = Journal::open(folder.path(), &study).unwrap();
    let make = |index, _: &CancelToken| {
        if index == 17 {
            cancel.cancel();
        }
        Ok((index != 17).then(|| empty(&study, index)))
    };
    let ended = run(&mut journal, &cancel, make, |_| ());
    assert!(matches!(ended, Err(StudyError::Cancelled(_))));
    assert!(journal.done() >= 1 && journal.done() < 40);
    assert_eq!(summary(folder.path()).unwrap().done, journal.done());
}

#[test]
fn a_scenario_may_be_a_text() {
    let kitchen = platewash_scenario::source("kitchen").unwrap().text;
    let text = |scenario: &str| {
        format!(
            "format = \"platewash-study/1\"\nname = \"texts\"\nscenario = [\"kitchen\", {scenario}]\n[[axis]]\nkey = \"seed\"\nvalues = [3]\n"
        )
    };
    let own = format!("{{ name = \"own\", text = '''{kitchen}''' }}");
    let two = Arc::new(study(&text(&own)).unwrap());
    let of = |index| {
        RowMaker::new(two.clone())
            .row(index, &CancelToken::new())
            .unwrap()
            .unwrap()
            .row
    };
    let (shipped, own) = (of(0), of(1));
    assert_eq!((shipped.scenario.as_str(), own.scenario.as_str()), ("kitchen", "own"));
    assert_eq!(
        (own.clearance_m, own.duration_s),
        (shipped.clearance_m, shipped.duration_s)
    );
    assert_ne!(own.key, shipped.key);
    for (wrong, words) in [
        ("{ name = \"kitchen\", text = \"\" }", "kitchen is there twice"),
        ("{ name = \" \", text = \"\" }", "a name must not be empty"),
        ("{ name = \"own\", text = \"x = 1\" }", "own"),
        ("{ name = \"own\" }", "scenario must be a name, a file or a table"),
    ] {
        let said = study(&text(wrong)).unwrap_err().to_string();
        assert!(said.contains(words) && said.contains("line 3"), "{said}");
    }
}

#[test]
fn a_row_depends_on_its_scenario_alone() {
    let text = "format = \"platewash-study/1\"\nname = \"tools\"\nscenario = \"kitchen\"\n[[axis]]\nkey = \"tool.length_m\"\nvalues = [0.1, 0]\n[[axis]]\nkey = \"seed\"\nvalues = [1, 2]\n";
    let study = Arc::new(study(text).unwrap());
    let of = |index| {
        RowMaker::new(study.clone())
            .row(index, &CancelToken::new())
            .unwrap()
            .unwrap()
    };
    let (shared, cancel) = (RowMaker::new(study.clone()), CancelToken::new());
    for index in [3, 0, 2, 1] {
        assert_eq!(shared.row(index, &cancel).unwrap().unwrap(), of(index));
    }
    let row = of(1).row;
    assert_eq!(row.outcome, Outcome::Proved, "{row:?}");
    assert!(
        row.swept.unwrap() > 0.9 && row.duration_s.unwrap() > 1.0 && row.clearance_pair.is_some() && row.plan.is_some()
    );
    let refused = of(3).row;
    assert!(
        refused.outcome != Outcome::Proved && refused.reason.is_some() && refused.plan.is_none(),
        "{refused:?}"
    );
}
