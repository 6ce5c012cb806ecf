//! A study has all that its rows name: it is sent to whoever has none of its files, and knows them again.

use platewash_kinematics::irb120::IRB120_URDF;
use platewash_study::{Journal, Outcome, RowMaker, RowWithPlan, Study, StudyError, StudyParts};
use platewash_workcell::cancel::CancelToken;
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// Corners and faces of a tetrahedron of 40 mm, in millimetres.
const OBJ: &str = "v 0 0 0\nv 40 0 0\nv 0 40 0\nv 0 0 40\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// A study of one plate with arms and meshes out of files.
fn laid(folder: &Path) -> Study {
    fs::create_dir_all(folder.join("parts")).unwrap();
    fs::write(folder.join("arm.urdf"), IRB120_URDF).unwrap();
    fs::write(
        folder.join("arm2.urdf"),
        IRB120_URDF.replace("<robot", "<!-- other --><robot"),
    )
    .unwrap();
    for name in ["a.obj", "b.obj"] {
        fs::write(folder.join("parts").join(name), OBJ).unwrap();
    }
    let kitchen = platewash_scenario::source("kitchen").unwrap().text;
    let kitchen = kitchen
        .replace("model = \"irb120\"", "urdf = \"arm.urdf\"")
        .replace("count = 4", "count = 1");
    let body = "\n[[obstacle]]\nname = \"box\"\nshape = \"mesh\"\nmesh = \"parts/a.obj\"\nmesh_scale = [0.001, 0.001, 0.001]\nat_m = [-0.5, 0, 0.5]\n";
    fs::write(folder.join("base.toml"), kitchen + body).unwrap();
    let text = "format = \"platewash-study/1\"\nname = \"files\"\nscenario = \"base.toml\"\n[[axis]]\nkey = \"robot.urdf\"\nvalues = [\"arm.urdf\", \"arm2.urdf\"]\n\
                [[axis]]\nkey = \"obstacle[0].mesh\"\nvalues = [\"parts/a.obj\", \"parts/b.obj\", \"parts/none.obj\"]\n";
    fs::write(folder.join("study.toml"), text).unwrap();
    Study::load(&folder.join("study.toml")).unwrap()
}

fn rows(study: Study) -> Vec<RowWithPlan> {
    let (rows, cancel) = (study.rows(), CancelToken::new());
    let maker = RowMaker::new(Arc::new(study));
    (0..rows)
        .map(|index| maker.row(index, &cancel).unwrap().unwrap())
        .collect()
}

#[test]
fn a_loaded_study_needs_no_files() {
    let folder = tempfile::tempdir().unwrap();
    let study = laid(folder.path());
    assert_eq!(study.files.len(), 4, "{:?}", study.files.keys());
    let before = rows(study.clone());
    let sent = serde_json::to_vec(&study.parts()).unwrap();
    fs::remove_dir_all(folder.path()).unwrap();
    let parts: StudyParts = serde_json::from_slice(&sent).unwrap();
    let received = Study::from_parts(parts).unwrap();
    assert_eq!(received.parts(), study.parts());
    assert_eq!(rows(study), before);
    assert_eq!(rows(received), before);
    let outcomes: Vec<_> = before.iter().map(|made| made.row.outcome).collect();
    assert_eq!(outcomes[0], Outcome::Proved, "{:?}", before[0]);
    assert_eq!(outcomes[1], Outcome::Proved);
    let missing = &before[2].row;
    assert_eq!(missing.outcome, Outcome::Error);
    assert!(missing.reason.as_ref().unwrap().contains("none.obj"), "{missing:?}");
    // Two descriptions are two arms, and two plans.
    assert_ne!(before[0].row.plan, before[3].row.plan);
}

#[test]
fn refuses_to_resume_after_a_changed_file() {
    let folder = tempfile::tempdir().unwrap();
    let study = laid(folder.path());
    let out = folder.path().join("out");
    drop(Journal::open(&out, &study).unwrap());
    drop(Journal::open(&out, &laid(folder.path())).unwrap());
    fs::write(folder.path().join("parts/b.obj"), OBJ.replace("40", "41")).unwrap();
    let changed = Study::load(&folder.path().join("study.toml")).unwrap();
    let refused = Journal::open(&out, &changed).err().unwrap();
    assert!(matches!(refused, StudyError::Other { .. }));
    let words = refused.to_string();
    assert!(words.contains("b.obj") && !words.contains("a.obj"), "{words}");
}

#[test]
fn names_an_unreadable_file_before_planning() {
    let folder = tempfile::tempdir().unwrap();
    laid(folder.path());
    fs::remove_file(folder.path().join("arm2.urdf")).unwrap();
    let words = Study::load(&folder.path().join("study.toml")).unwrap_err().to_string();
    assert!(
        words.contains("arm2.urdf") && words.contains("cannot be read"),
        "{words}"
    );
}
