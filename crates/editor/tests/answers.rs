//! Questions as a page asks them, and the lines of their answers.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use platewash_editor::{Editor, Keeper, MOST_CONTACT_POINTS, Save, SaveError, SaveReport};
use platewash_scenario::Scenario;
use platewash_workcell::cancel::CancelToken;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const KITCHEN: &str = include_str!("../../../scenarios/kitchen-spiral.toml");

fn kitchen() -> Editor {
    Editor::of_text("kitchen-spiral", KITCHEN, None).unwrap()
}

/// All lines of an answer.
fn ask(editor: &Editor, path: &str, question: &Value) -> Vec<Value> {
    ask_bytes(editor, path, question.to_string().as_bytes())
}

fn ask_bytes(editor: &Editor, path: &str, question: &[u8]) -> Vec<Value> {
    let mut lines = Vec::new();
    let mut tell = |line: String| {
        assert!(!line.contains('\n'));
        lines.push(serde_json::from_str(&line).unwrap());
        true
    };
    editor.answer(path, question, &mut tell, &CancelToken::new());
    lines
}

fn cell(text: &str, edits: &Value) -> Value {
    json!({"session": "sessionofthistest", "text": text, "edits": edits, "want": "proof", "arm": null})
}

fn kinds(lines: &[Value]) -> Vec<&str> {
    lines.iter().map(|line| line["kind"].as_str().unwrap()).collect()
}

fn line<'a>(lines: &'a [Value], kind: &str) -> &'a Value {
    let found = lines.iter().find(|line| line["kind"] == kind);
    found.unwrap_or_else(|| panic!("no {kind} in {:?}", kinds(lines)))
}

/// The kitchen with its plates listed, one of them elsewhere.
fn with_plate(editor: &Editor, plate: usize, at: Value) -> Vec<Value> {
    let lines = ask(editor, "/cell", &cell(KITCHEN, &json!([])));
    let mut centres = line(&lines, "cell")["centres_m"].clone();
    centres[plate] = at;
    ask(
        editor,
        "/cell",
        &cell(KITCHEN, &json!([{"key": "layout.positions_m", "value": centres}])),
    )
}

#[test]
fn answers_a_scenario_from_its_text_to_its_proof() {
    let editor = kitchen().with_memory();
    let lines = ask(&editor, "/cell", &cell(KITCHEN, &json!([])));
    assert_eq!(kinds(&lines), ["scenario", "cell", "preview", "plan", "proof"]);
    assert_eq!(lines[0]["text"], KITCHEN);
    assert_eq!(lines[0]["values"]["wash.turns"], 3.5);
    assert_eq!(lines[0]["stated"].get("ik.method"), None);
    assert_eq!(lines[0]["values"]["ik.method"], "numeric");
    assert_eq!(lines[1]["listed"], false);
    assert_eq!(lines[1]["arm"]["id"], lines[1]["arm_id"]);
    let chances = lines[2]["plates"].as_array().unwrap();
    assert!(chances.iter().all(|plate| plate["chance"] == "washable"), "{chances:?}");
    let job = Scenario::load("kitchen-spiral").unwrap().job().unwrap();
    let planned = platewash_planner::plan(&job).unwrap().plan;
    assert_eq!(lines[3]["heading"]["hash"].as_str(), planned.hash.as_deref());
    assert_eq!(lines[4]["certificate"]["passes"], true);
    assert_eq!(lines[4]["proved"].as_array().unwrap().len(), 4);
    let mut guessed = cell(KITCHEN, &json!([]));
    guessed["guessed"] = json!(true);
    assert_eq!(
        kinds(&ask(&editor, "/cell", &guessed)),
        ["scenario", "cell", "plan", "proof"]
    );
    let latest = editor.latest().unwrap();
    assert_eq!(latest.plan.unwrap().hash, planned.hash);
    assert!(latest.certificate.unwrap().passes());
}

#[test]
fn an_arm_that_the_page_has_is_not_sent_again() {
    let editor = kitchen();
    let first = ask(&editor, "/cell", &cell(KITCHEN, &json!([])));
    let id = line(&first, "cell")["arm_id"].clone();
    let question = json!({"session": "sessionofthistest", "text": KITCHEN, "edits": [], "want": "preview", "arm": id});
    let again = ask(&editor, "/cell", &question);
    assert_eq!(kinds(&again), ["scenario", "cell", "preview"]);
    assert_eq!(again[1]["arm"], Value::Null);
    let other = json!({"session": "sessionofthistest", "text": KITCHEN, "want": "preview", "arm": id,
        "edits": [{"key": "limits.joint_acceleration_rad_s2", "value": [3, 3, 3, 3, 3, 3]}]});
    assert_ne!(ask(&editor, "/cell", &other)[1]["arm"], Value::Null);
}

#[test]
fn a_plate_out_of_reach_is_explained_and_proved_at_the_place_that_is_shown() {
    let editor = kitchen().with_memory();
    let lines = with_plate(&editor, 1, json!([0.62, 0.12]));
    assert_eq!(kinds(&lines), ["scenario", "cell", "preview", "unplanned", "place"]);
    assert_eq!(line(&lines, "preview")["plates"][1]["chance"], "unwashable");
    let unplanned = line(&lines, "unplanned");
    assert_eq!(unplanned["proved"], true);
    assert!(
        unplanned["headline"]
            .as_str()
            .unwrap()
            .starts_with("INFEASIBLE: plate 2 ")
    );
    let plate = &unplanned["plates"][0];
    assert_eq!(plate["plate"], 1);
    assert!(plate["causes"][0].as_str().unwrap().contains("out of reach"), "{plate}");
    for part in ["free_m", "dead_m"] {
        assert!(plate[part].as_array().unwrap().len() > 10, "{part}");
    }
    assert!(editor.latest().unwrap().plan.is_none());
    let place = line(&lines, "place");
    assert_eq!(place["plate"], 1);
    let there = with_plate(&editor, 1, place["nearest_m"].clone());
    assert_eq!(line(&there, "proof")["certificate"]["passes"], true);
}

#[test]
fn refusals_name_the_key_and_the_expected_value() {
    let editor = kitchen();
    let cases = [
        (
            json!([{"key": "wash.tilt_max_dg", "value": 3}]),
            "wash.tilt_max_dg",
            "did you mean 'wash.tilt_max_deg'?",
        ),
        (
            json!([{"key": "wash.tilt_max_deg", "value": 90}]),
            "wash.tilt_max_deg",
            "a number from 0 to 60",
        ),
        (json!([{"key": "wash.turns", "value": "many"}]), "wash.turns", "found"),
        (
            json!([{"key": "job.program", "value": "paper"}]),
            "job.order",
            "nearest",
        ),
        (
            json!([{"key": "job.order", "value": "nearest"}, {"key": "job.program", "value": "paper"}]),
            "job.program",
            "certified",
        ),
        (
            json!([{"key": "tool.length_m", "value": 0}]),
            "tool.length_m",
            "needs a tool",
        ),
        (
            json!([{"key": "robot.urdf", "value": "/nowhere.urdf"}]),
            "robot.urdf",
            "nowhere",
        ),
    ];
    for (edits, key, words) in cases {
        let lines = ask(&editor, "/cell", &cell(KITCHEN, &edits));
        let last = lines.last().unwrap();
        assert_eq!(last["kind"], "refused", "{edits} {last}");
        assert_eq!(last["key"], key, "{last}");
        assert!(last["words"].as_str().unwrap().contains(words), "{last}");
    }
    let lines = ask(&editor, "/cell", &cell("name = \"a\"\nwash.turns = nan\n", &json!([])));
    let refused = line(&lines, "refused");
    assert_eq!((&refused["key"], &refused["line"]), (&json!("wash.turns"), &json!(2)));
    let lines = ask(&editor, "/cell", &cell("name = \n", &json!([])));
    assert_eq!(kinds(&lines), ["refused"]);
    assert_eq!(lines[0]["line"], 1);
}

#[test]
fn keeps_and_shows_a_text_that_is_no_scenario_yet() {
    let half = KITCHEN.replace("turns = 3.5", "turns = -1");
    let lines = ask(
        &kitchen(),
        "/cell",
        &cell(&half, &json!([{"key": "wash.lift_m", "value": 0.04}])),
    );
    assert_eq!(kinds(&lines), ["scenario", "refused"]);
    assert_eq!(lines[0]["text"], half.replace("lift_m = 0.03 ", "lift_m = 0.04 "));
    assert_eq!(lines[0]["stated"]["wash.turns"], -1);
    assert_eq!(lines[0]["values"], json!({}));
}

#[test]
fn bounds_work_before_it_begins() {
    for edits in [
        json!([{"key": "layout.count", "value": 1000}, {"key": "layout.min_distance_m", "value": 0}]),
        json!([{"key": "wash.turns", "value": 200}, {"key": "layout.count", "value": 30}]),
    ] {
        let begin = Instant::now();
        let lines = ask(&kitchen(), "/cell", &cell(KITCHEN, &edits));
        let last = lines.last().unwrap();
        assert_eq!(last["kind"], "refused", "{last}");
        assert!(
            last["words"]
                .as_str()
                .unwrap()
                .contains(&MOST_CONTACT_POINTS.to_string()),
            "{last}"
        );
        assert!(begin.elapsed() < Duration::from_secs(120));
    }
}

#[test]
fn answers_an_invalid_question_with_its_error() {
    let editor = kitchen();
    let deep = format!("{{\"session\":{}", "[".repeat(100_000));
    let big = json!({"session": "sessionofthistest", "text": "", "edits": vec![json!({"key": "seed", "value": 1}); 1001], "want": "proof", "arm": null});
    let big = big.to_string();
    let cases: [(&str, &[u8], &str); 9] = [
        ("/cell", b"", "question"),
        ("/cell", b"\xff\xfe", "question"),
        ("/cell", b"{}", "session"),
        ("/cell", deep.as_bytes(), "question"),
        (
            "/cell",
            br#"{"session":"","text":"","edits":[],"want":"proof","arm":null}"#,
            "session",
        ),
        (
            "/cell",
            br#"{"session":"sessionofthistest","text":"","edits":[],"want":"everything","arm":null}"#,
            "everything",
        ),
        ("/cell", big.as_bytes(), "1001 changes"),
        (
            "/save",
            br#"{"session":"sessionofthistest","text":"","disk":null,"force":true}"#,
            "no question",
        ),
        ("/etc/passwd", b"{}", "no question"),
    ];
    for (path, question, words) in cases {
        let lines = ask_bytes(&editor, path, question);
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!(["failed", "refused"].contains(&lines[0]["kind"].as_str().unwrap()));
        assert!(lines[0]["words"].as_str().unwrap().contains(words), "{}", lines[0]);
    }
    let lines = ask(
        &editor,
        "/map",
        &json!({"session": "sessionofthistest", "text": KITCHEN, "plate": 4}),
    );
    assert_eq!(kinds(&lines), ["refused"]);
}

#[test]
fn a_new_question_ends_the_one_before() {
    let editor = kitchen();
    // Two minutes of looking.
    let slow = json!({"session": "sessionofthistest", "text": KITCHEN, "plate": 0});
    std::thread::scope(|scope| {
        let (begun, is_begun) = std::sync::mpsc::channel();
        let map = scope.spawn({
            let editor = &editor;
            move || {
                let mut last = Value::Null;
                let mut tell = |line: String| {
                    last = serde_json::from_str(&line).unwrap();
                    let _ = begun.send(());
                    true
                };
                editor.answer("/map", slow.to_string().as_bytes(), &mut tell, &CancelToken::new());
                last
            }
        });
        is_begun.recv().unwrap();
        let other =
            json!({"session": "anothersessionofit", "text": KITCHEN, "edits": [], "want": "proof", "arm": null});
        assert_eq!(kinds(&ask(&editor, "/cell", &other)).last(), Some(&"proof"));
        assert_eq!(
            kinds(&ask(&editor, "/cell", &cell(KITCHEN, &json!([])))).last(),
            Some(&"proof")
        );
        let last = map.join().unwrap();
        // One that was done before it was ended is as good.
        assert!(
            ["superseded", "map_done"].contains(&last["kind"].as_str().unwrap()),
            "{last}"
        );
    });
}

#[test]
fn ends_work_when_the_client_has_left() {
    let (token, mut told) = (CancelToken::new(), 0);
    let mut tell = |_: String| {
        told += 1;
        false
    };
    kitchen().answer(
        "/cell",
        cell(KITCHEN, &json!([])).to_string().as_bytes(),
        &mut tell,
        &token,
    );
    assert!(token.is_cancelled());
    // The first line, and at most that nothing follows.
    assert!(told <= 3, "{told} lines");
}

#[test]
fn sends_meshes_like_other_files() {
    for section in ["obstacle", "tool_body"] {
        let mesh = |file: &str| {
            format!(
                "{KITCHEN}\n[[{section}]]\nname = \"thing\"\nshape = \"mesh\"\nat_m = [0.8, 0, 0]\nmesh = \"{file}\"\n"
            )
        };
        let words = |editor: &Editor, text: &str| {
            let lines = ask(editor, "/cell", &cell(text, &json!([])));
            lines.last().unwrap().to_string()
        };
        let opened = || Editor::of_text("cell", &mesh("a.stl"), Some(Path::new("/nowhere"))).unwrap();
        let said = words(&opened().open_to_others(), &mesh("/etc/b.stl"));
        assert!(said.contains("other machines"), "{said}");
        let said = words(&opened().open_to_others(), &mesh("a.stl"));
        assert!(said.contains("was not found") && said.contains("a.stl"), "{said}");
        assert!(words(&opened(), &mesh("/etc/b.stl")).contains("was not found"));
    }
}

#[test]
fn changes_keys_of_sections_and_states_their_positions() {
    let text = "# a rack\n[tool]\nlength_m = 0.15\n[job]\nprogram = \"certified\"\n[wash]\nheight_m = 0\n\n[[plate]]  # one\nat_m = [0.4, 0, 0.03] # here\n\n\
                [[obstacle]]\nname = \"post\"\nshape = \"box\"\nsize_m = [0.02, 0.02, 0.02]\nat_m = [0.8, 0, 0.05]\n";
    let editor = Editor::of_text("cell", text, None).unwrap();
    let edits = json!([
        {"key": "plate[0].at_m", "value": [0.41, 0.02, 0.03]},
        {"key": "obstacle[0].at_m", "value": [0.9, -0.1, 0.05]},
    ]);
    let mut question = cell(text, &edits);
    question["want"] = json!("preview");
    let lines = ask(&editor, "/cell", &question);
    let moved = text
        .replace("[0.4, 0, 0.03] # here", "[0.41, 0.02, 0.03] # here")
        .replace("[0.8, 0, 0.05]", "[0.9, -0.1, 0.05]");
    assert_eq!(lines[0]["text"], json!(moved));
    let moves = &lines[1]["moves"];
    assert_eq!(
        moves["plates"],
        json!({"by": "sections", "sections": [0], "at_m": [[0.41, 0.02, 0.03]]})
    );
    assert_eq!(
        moves["bodies"][1],
        json!({"key": "obstacle[0].at_m", "at_m": [0.9, -0.1, 0.05], "words": null, "holds": []})
    );
    assert!(moves["bodies"][0]["key"].is_null() && moves["bodies"][0]["words"].is_string());
    let lines = ask(
        &editor,
        "/cell",
        &cell(text, &json!([{"key": "plate[1].at_m", "value": [0, 0, 0]}])),
    );
    assert!(
        lines[0]["words"]
            .as_str()
            .unwrap()
            .contains("no such [[plate]] section"),
        "{lines:?}"
    );
}

#[test]
fn a_page_on_the_network_names_no_files() {
    let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../urdf/irb120.urdf");
    let other = |editor: &Editor, text: &str| {
        let edits = json!([{"key": "robot.urdf", "value": "/etc/passwd"}]);
        let lines = ask(editor, "/cell", &cell(text, &edits));
        lines.last().unwrap()["words"].as_str().unwrap().to_owned()
    };
    let text = KITCHEN.replace("model = \"irb120\"", &format!("urdf = {urdf:?}"));
    let (open, own) = (kitchen().open_to_others(), kitchen());
    assert!(other(&open, KITCHEN).contains("other machines"));
    assert!(!other(&own, KITCHEN).contains("other machines"));
    let named = Editor::of_text("cell", &text, None).unwrap().open_to_others();
    assert!(other(&named, &text).contains("other machines"));
    let folder = tempfile::tempdir().unwrap();
    let kept = |editor: Editor| editor.with_keeper(Box::new(FolderFile(folder.path().join("cell.toml"))));
    let save =
        json!({"session": "sessionofthistest", "disk": null, "force": true, "text": text.replace(urdf, "/etc/passwd")});
    let lines = ask(&kept(kitchen().open_to_others()), "/save", &save);
    assert!(
        lines[0]["words"].as_str().unwrap().contains("other machines"),
        "{lines:?}"
    );
    assert!(!folder.path().join("cell.toml").exists());
    assert_eq!(kinds(&ask(&kept(kitchen()), "/save", &save)), ["saved"]);
    if Path::new(urdf).is_file() {
        let lines = ask(&named, "/cell", &cell(&text, &json!([])));
        assert!(!lines.last().unwrap().to_string().contains("other machines"));
    }
}

/// A file of a test.
#[derive(Debug)]
struct FolderFile(PathBuf);

impl Keeper for FolderFile {
    fn file(&self) -> String {
        "cell.toml".to_owned()
    }

    fn is_scenario(&self) -> bool {
        true
    }

    fn on_disk(&self) -> Result<Option<Vec<u8>>, String> {
        match fs::read(&self.0) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error.to_string()),
        }
    }

    fn write(&self, save: &Save<'_>, still: &dyn Fn() -> bool, _: &CancelToken) -> Result<SaveReport, SaveError> {
        if save.text == "slow" {
            fs::write(&self.0, "meanwhile").unwrap();
        }
        if !still() {
            return Err(SaveError::Changed);
        }
        fs::write(&self.0, save.text).map_err(|error| SaveError::Cannot(error.to_string()))?;
        Ok(SaveReport {
            files: vec!["cell.toml".to_owned()],
            words: "PROVED".to_owned(),
        })
    }
}

#[test]
fn never_overwrites_changes_of_others() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("cell.toml");
    let editor = kitchen().with_keeper(Box::new(FolderFile(file.clone())));
    let save = |text: &str, disk: &Value, force: bool| {
        let lines = ask(
            &editor,
            "/save",
            &json!({"session": "sessionofthistest", "text": text, "disk": disk, "force": force}),
        );
        assert_eq!(lines.len(), 1);
        lines[0].clone()
    };
    let look = |disk: &Value| ask(&editor, "/disk", &json!({"session": "sessionofthistest", "disk": disk}))[0].clone();
    assert_eq!(
        look(&Value::Null),
        json!({"kind": "disk", "disk": null, "text": null, "words": null})
    );
    let first = save("a", &Value::Null, false);
    assert_eq!(first["kind"], "saved");
    assert_eq!(fs::read_to_string(&file).unwrap(), "a");
    assert_eq!(look(&first["disk"])["text"], Value::Null);
    fs::write(&file, "somebody else's").unwrap();
    let seen = look(&first["disk"]);
    assert_eq!(seen["text"], "somebody else's");
    let refused = save("b", &first["disk"], false);
    assert_eq!(
        (&refused["kind"], &refused["text"]),
        (&json!("conflict"), &json!("somebody else's"))
    );
    assert_eq!(refused["disk"], seen["disk"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "somebody else's");
    assert_eq!(save("b", &seen["disk"], false)["kind"], "saved");
    fs::write(&file, "once more").unwrap();
    assert_eq!(save("c", &Value::Null, true)["kind"], "saved");
    assert_eq!(fs::read_to_string(&file).unwrap(), "c");
    // Somebody writes while the answer is made.
    let slow = save("slow", &Value::Null, true);
    assert_eq!(
        (&slow["kind"], &slow["text"]),
        (&json!("conflict"), &json!("meanwhile"))
    );
    assert_eq!(fs::read_to_string(&file).unwrap(), "meanwhile");
    fs::write(&file, b"\xff").unwrap();
    let seen = look(&Value::Null);
    assert_eq!(seen["text"], Value::Null);
    assert!(seen["words"].as_str().unwrap().contains("not a text file"));
    assert_eq!(save("d", &Value::Null, false)["text"], Value::Null);
    fs::remove_file(&file).unwrap();
    let gone = save("d", &seen["disk"], false);
    assert_eq!((&gone["kind"], &gone["disk"]), (&json!("conflict"), &Value::Null));
    fs::create_dir(&file).unwrap();
    assert_eq!(save("d", &Value::Null, true)["kind"], "failed");
}

#[test]
fn sends_a_map_from_coarse_to_fine() {
    let lines = ask(
        &kitchen(),
        "/map",
        &json!({"session": "sessionofthistest", "text": KITCHEN, "plate": 2}),
    );
    assert_eq!(kinds(&lines).last(), Some(&"map_done"));
    let patches: Vec<_> = lines.iter().filter(|line| line["kind"] == "map").collect();
    let steps: Vec<_> = patches.iter().map(|patch| patch["step_m"].as_f64().unwrap()).collect();
    assert!(steps.is_sorted_by(|a, b| a >= b), "{steps:?}");
    let count = |part: &str| {
        patches
            .iter()
            .map(|patch| patch[part].as_array().unwrap().len())
            .sum::<usize>()
    };
    assert!(count("washable_m") > 20 && count("unwashable_m") > 20);
}

/// The files that a scenario names are read, and plates out of a table stay where they are.
#[test]
fn answers_a_scenario_with_a_table_of_plates_and_soils() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/plates");
    let text = fs::read_to_string(folder.join("twelve.toml")).unwrap();
    let editor = Editor::of_text("twelve", &text, Some(&folder)).unwrap();
    let lines = ask(&editor, "/cell", &cell(&text, &json!([])));
    assert_eq!(kinds(&lines).last(), Some(&"proof"), "{:?}", lines.last());
    let told = line(&lines, "cell");
    assert_eq!(
        (told["plates"].as_array().unwrap().len(), &told["listed"]),
        (12, &json!(true))
    );
    assert!(
        told["plates"][0]["own"]
            .as_str()
            .unwrap()
            .contains("soil dried sauce (assumed): dose 150 Pa·m, 2 passes")
    );
    let moves = told["moves"].to_string() + &lines[0].to_string();
    assert!(moves.contains("change their places in that file"), "{moves}");
}

fn recovery(stopped_s: Value, at_deg: Value) -> Value {
    json!({"session": "sessionofthistest", "text": KITCHEN, "stopped_s": stopped_s, "at_deg": at_deg})
}

#[test]
fn a_stop_is_answered_with_the_motion_home_and_what_is_left() {
    let editor = kitchen();
    let lines = ask(&editor, "/recover", &recovery(json!(14.0), Value::Null));
    let found = line(&lines, "recovery");
    assert_eq!((kinds(&lines), &found["proved"]), (vec!["recovery"], &json!(true)));
    assert!(
        found["stop"]
            .as_str()
            .unwrap()
            .starts_with("at 14.00 s of the plan (as stated; "),
        "{}",
        found["stop"]
    );
    assert!(
        found["rest"]
            .as_str()
            .unwrap()
            .starts_with("REST of a stopped plan, without plate "),
        "{}",
        found["rest"]
    );
    let view = &found["view"];
    assert!(
        view["certificate"]["headline"]
            .as_str()
            .unwrap()
            .starts_with("RECOVERY: from the stop home")
    );
    assert_eq!(view["segments"].as_array().unwrap().last().unwrap()["kind"], "return");
    // From joints alone.
    let lines = ask(&editor, "/recover", &recovery(Value::Null, json!([0, 0, 0, 0, 60, 0])));
    assert_eq!(line(&lines, "recovery")["proved"], true);
}

#[test]
fn what_is_no_stop_is_refused_in_words() {
    let editor = kitchen();
    for (question, words) in [
        (recovery(Value::Null, Value::Null), "where the arm stands"),
        (recovery(json!(-1), Value::Null), "the time of the stop"),
        (recovery(json!(1e9), json!([0, 0, 0, 0, 60, 0])), "the time of the stop"),
        (recovery(Value::Null, json!([999, 0, 0, 0, 0, 0])), "joint 1"),
    ] {
        let lines = ask(&editor, "/recover", &question);
        let said = line(&lines, "refused")["words"].as_str().unwrap();
        assert!(said.contains(words), "{said}");
    }
    let six = recovery(Value::Null, json!([1, 2, 3]));
    assert!(
        line(&ask(&editor, "/recover", &six), "failed")["words"]
            .as_str()
            .unwrap()
            .contains("question")
    );
}
