//! Changes of scenario texts, case by case.

use platewash_scenario::keys::KEYS;
use platewash_scenario::{Draft, EditError, FormKey, Problem, SHIPPED, Scenario, form, values_of};
use serde_json::{Value, json};
use std::path::Path;

fn changed(text: &str, key: &str, value: Value) -> String {
    let mut draft = Draft::new(text).unwrap();
    let value = Some(value).filter(|value| !value.is_null());
    draft.set(key, value.as_ref()).unwrap();
    draft.text().to_owned()
}

fn refused(text: &str, key: &str, value: Value) -> EditError {
    let mut draft = Draft::new(text).unwrap();
    let error = draft.set(key, Some(&value)).unwrap_err();
    assert_eq!(draft.text(), text);
    error
}

/// Text, key, value (null takes out), text.
#[rustfmt::skip]
const CASES: &[(&str, &str, &str, &str)] = &[
    // Values: style and comment stay.
    ("[wash]\nturns = 3.50   # w\npoints=1_0\n", "wash.turns", "4", "[wash]\nturns = 4   # w\npoints=1_0\n"),
    ("[wash]\nturns = 3.50   # w\n", "wash.turns", "4.0", "[wash]\nturns = 4.0   # w\n"),
    ("[wash]\nturns = 3.50   # w\n", "wash.turns", "3.5", "[wash]\nturns = 3.50   # w\n"),
    ("[wash]\nturns = 3\n", "wash.turns", "4.0", "[wash]\nturns = 4\n"),
    ("[wash]\nturns = 3\n", "wash.turns", "0.1", "[wash]\nturns = 0.1\n"),
    ("name = 'a'\n", "name", "\"b\\\\c\"", "name = 'b\\c'\n"),
    ("name = 'a'\n", "name", "\"it's\"", "name = \"it's\"\n"),
    ("[wash]\npoints = 3.0\n", "wash.points", "3", "[wash]\npoints = 3\n"),
    ("[wash]\npoints = 3\n", "wash.points", "55.0", "[wash]\npoints = 55\n"),
    // Where a new key goes.
    ("[wash]\n  turns = 3 # w\n# end\n\n# next\n[limits]\n", "wash.points", "9", "[wash]\n  turns = 3 # w\n  points = 9\n# end\n\n# next\n[limits]\n"),
    ("[wash]\nturns = 3\n# next\n[limits]\n", "wash.points", "9", "[wash]\nturns = 3\npoints = 9\n# next\n[limits]\n"),
    ("[wash]\nturns = 3", "wash.points", "9", "[wash]\nturns = 3\npoints = 9"),
    ("[wash]\r\nturns = 3\r\n\r\n[limits]\r\n", "wash.points", "9", "[wash]\r\nturns = 3\r\npoints = 9\r\n\r\n[limits]\r\n"),
    ("seed = 1\nwash.turns = 3\nwash.points = 9 # p\n\n[tool]\n", "wash.lift_m", "0.03", "seed = 1\nwash.turns = 3\nwash.points = 9 # p\nwash.lift_m = 0.03\n\n[tool]\n"),
    ("# top\n\n# tool\n[tool]\n", "name", "\"a\"", "# top\n\nname = \"a\"\n\n# tool\n[tool]\n"),
    ("", "name", "\"a\"", "name = \"a\"\n"),
    ("# top", "seed", "2", "# top\n\nseed = 2"),
    ("[wash.more]\nx = 1\n", "wash.turns", "3", "[wash]\nturns = 3\n[wash.more]\nx = 1\n"),
    // Where a new section goes.
    ("name = \"a\"\n", "tool.mass_kg", "1", "name = \"a\"\n\n[tool]\nmass_kg = 1\n"),
    ("[job]\n\n# w\n[wash]\nturns = 3\n", "tool.mass_kg", "1.0", "[job]\n\n[tool]\nmass_kg = 1.0\n\n# w\n[wash]\nturns = 3\n"),
    ("[wash]\nturns = 3\n", "tool.mass_kg", "1.0", "[tool]\nmass_kg = 1.0\n\n[wash]\nturns = 3\n"),
    ("[wash]\nturns = 3", "plant.substeps", "2", "[wash]\nturns = 3\n\n[plant]\nsubsteps = 2"),
    // Taking out.
    ("# a\n[wash]\n# t\nturns = 3 # w\n\n[tool]\n", "wash.turns", "null", "# a\n[wash]\n# t\n\n[tool]\n"),
    ("[wash]\nturns = 3\npoints = 9", "wash.points", "null", "[wash]\nturns = 3"),
    ("[wash]\nturns = 3\n", "wash.points", "null", "[wash]\nturns = 3\n"),
    ("name = \"\"\"\na\"\"\" # n\nseed = 1\n", "name", "null", "seed = 1\n"),
    // Sections of lists.
    ("# a\n[[plate]] # one\nat_m = [0.3, 0, 0.03] # here\n\n[[plate]]\nat_m = [0, 0.3, 0.03]\n", "plate[1].at_m", "[0.01, 0.3, 0.03]", "# a\n[[plate]] # one\nat_m = [0.3, 0, 0.03] # here\n\n[[plate]]\nat_m = [0.01, 0.3, 0.03]\n"),
    ("[[plate]]\nat_m = [0.3, 0, 0.03] # here\n[[plate]]\nat_m = [0, 0.3, 0.03]\n", "plate[0].at_m", "[0.31, -0.5, 0.03]", "[[plate]]\nat_m = [0.31, -0.5, 0.03] # here\n[[plate]]\nat_m = [0, 0.3, 0.03]\n"),
    ("[[plate]]\nat_m = [0.3, 0, 0.03] # here\n", "plate[0].at_m", "[0.3, 0.0, 0.03]", "[[plate]]\nat_m = [0.3, 0, 0.03] # here\n"),
    ("[[plate]]\n  at_m = [0.3, 0, 0.03]\n\n# walls\n[[obstacle]]\n", "plate[0].rpy_deg", "[0, 45, 0]", "[[plate]]\n  at_m = [0.3, 0, 0.03]\n  rpy_deg = [0, 45, 0]\n\n# walls\n[[obstacle]]\n"),
    ("[[obstacle]]\n[[tool_body]]\nname = \"a\"\n[[obstacle]]\n", "obstacle[1].at_m", "[1, 2, 3]", "[[obstacle]]\n[[tool_body]]\nname = \"a\"\n[[obstacle]]\nat_m = [1, 2, 3]\n"),
    ("[[plate]]\nat_m = [0.3, 0, 0.03]\nrpy_deg = [0, 1, 0] # t\n[wash]\n", "plate[0].rpy_deg", "null", "[[plate]]\nat_m = [0.3, 0, 0.03]\n[wash]\n"),
    ("plate = [{ at_m = [0.3, 0, 0.03] }, { at_m = [0, 0.3, 0.03] }] # p\n", "plate[1].at_m", "[0, 0.4, 0.03]", "plate = [{ at_m = [0.3, 0, 0.03] }, { at_m = [0, 0.4, 0.03] }] # p\n"),
    // Braces.
    ("wash = { turns = 3 } # w\n", "wash.points", "9", "wash = { turns = 3, points = 9 } # w\n"),
    ("wash = {}\n", "wash.points", "9", "wash = { points = 9 }\n"),
    ("wash = { turns = 3, points = 9 }\n", "wash.points", "null", "wash = { turns = 3 }\n"),
    ("wash = { turns = 3, points = 9 }\n", "wash.turns", "null", "wash = { points = 9 }\n"),
    ("wash = { turns = 3 }\n", "wash.turns", "null", "wash = {}\n"),
    // Lists: what is the same stays, with its comments.
    ("[robot]\nstart_deg = [0, 0, 0, 0, 90, 0]   # h\n", "robot.start_deg", "[0,10,0,0,45.5,0]", "[robot]\nstart_deg = [0, 10, 0, 0, 45.5, 0]   # h\n"),
    ("[robot]\nstart_deg = [ 0,0,\t0, # three\n 0, 90 ,0 ]\n", "robot.start_deg", "[0,0,0,1.0,90.0,0]", "[robot]\nstart_deg = [ 0,0,\t0, # three\n 1, 90 ,0 ]\n"),
    ("[layout]\nx_m = [0.0, 0.3]\n", "layout.x_m", "[0.1,0.3]", "[layout]\nx_m = [0.1, 0.3]\n"),
    ("[layout]\npositions_m = [[0.3, 0.1], [0.2, 0.2]] # p\n", "layout.positions_m", "[[0.3,0.1],[0.2,0.25]]", "[layout]\npositions_m = [[0.3, 0.1], [0.2, 0.25]] # p\n"),
    ("[layout]\npositions_m = [[0.3, 0.1], [0.2, 0.2], [0.0, 0.5]]\n", "layout.positions_m", "[[0.3,0.1],[0.0,0.5]]", "[layout]\npositions_m = [[0.3, 0.1], [0.0, 0.5]]\n"),
    ("[layout]\npositions_m = [[0.3, 0.1], [0.2, 0.2]]\n", "layout.positions_m", "[[0.3,0.1]]", "[layout]\npositions_m = [[0.3, 0.1]]\n"),
    ("[layout]\npositions_m = [[0.3, 0.1]]\n", "layout.positions_m", "[[0.3,0.1],[0.2,0.2]]", "[layout]\npositions_m = [[0.3, 0.1], [0.2, 0.2]]\n"),
    ("[layout]\npositions_m = [\n  # sink\n  [0.3, 0.1], # a\n  # stove\n  [0.2, 0.2] # b\n]\n", "layout.positions_m", "[[0.2,0.2]]", "[layout]\npositions_m = [\n  # sink\n  # stove\n  [0.2, 0.2] # b\n]\n"),
    ("[layout]\npositions_m = [\n  [0.3, 0.1], # a\n  [0.2, 0.2] # b\n]\n", "layout.positions_m", "[[0.3,0.1]]", "[layout]\npositions_m = [\n  [0.3, 0.1] # a\n]\n"),
    ("[layout]\npositions_m = [\n  [0.3, 0.1], # a\n  [0.2, 0.2] # b\n]\n", "layout.positions_m", "[[0.3,0.1],[0.2,0.2],[0.0,0.4]]", "[layout]\npositions_m = [\n  [0.3, 0.1], # a\n  [0.2, 0.2], # b\n  [0.0, 0.4]\n]\n"),
    ("[layout]\r\npositions_m = [\r\n  [0.3, 0.1], # a\r\n]\r\n", "layout.positions_m", "[[0.1,0.4],[0.3,0.1],[0.0,0.4]]", "[layout]\r\npositions_m = [\r\n  [0.1, 0.4], # a\r\n  [0.3, 0.1],\r\n  [0.0, 0.4],\r\n]\r\n"),
    ("[layout]\npositions_m = [[1, 2]] # p\n", "layout.positions_m", "[[1,2],[1,3],[1,4],[1,5],[1,6]]", "[layout]\npositions_m = [\n    [1, 2],\n    [1, 3],\n    [1, 4],\n    [1, 5],\n    [1, 6],\n] # p\n"),
    ("[layout]\ncount = 2\n", "layout.positions_m", "[[1.0,2.0],[1,3]]", "[layout]\ncount = 2\npositions_m = [[1.0, 2.0], [1, 3]]\n"),
    ("[robot]\npackage_path = []\n", "robot.package_path", "[\"a\\\"\"]", "[robot]\npackage_path = [\"a\\\"\"]\n"),
];

#[test]
fn changes_of_a_draft_give_the_expected_texts() {
    for (text, key, value, expected) in CASES {
        let value = serde_json::from_str(value).unwrap();
        let found = std::panic::catch_unwind(|| changed(text, key, value)).unwrap_or_else(|_| "PANIC".to_owned());
        if found != *expected {
            eprintln!("CASE {key} in {text:?}\n  {expected:?}\n  {found:?}");
        }
    }
}

#[test]
fn refuses_edits_that_cannot_keep_the_text() {
    for text in [
        "wash = {\n  turns = 3, # t\n}\n",
        "wash.turns = 3\nseed = 1\nwash.lift_m = 0.03\n",
    ] {
        let error = refused(text, "wash.points", json!(9));
        assert!(matches!(error, EditError::Unplaced { .. }), "{error}");
    }
    assert_eq!(
        changed("wash = {\n  turns = 3, # t\n}\n", "wash.turns", json!(4)),
        "wash = {\n  turns = 4, # t\n}\n"
    );
}

#[test]
fn rejects_values_with_the_messages_of_files() {
    let of_file = |line: &str| {
        let message = Scenario::parse(line, "case").unwrap_err().to_string();
        message.strip_prefix("scenario case, line 1: ").unwrap().to_owned()
    };
    for (key, value, line) in [
        ("wash.turns", json!(0), "wash.turns = 0"),
        ("wash.turns", json!("a\u{1b}[2J"), "wash.turns = \"a\\u001b[2J\""),
        ("layout.plate_radius_m", json!(145), "layout.plate_radius_m = 145"),
        ("wash.points", json!(2.5), "wash.points = 2.5"),
        ("job.order", json!("nearst"), "job.order = \"nearst\""),
        ("name", json!(" "), "name = \" \""),
        ("robot.start_deg", json!([1, 2, 3]), "robot.start_deg = [1, 2, 3]"),
        ("layout.x_m", json!([0.5, 0.1]), "layout.x_m = [0.5, 0.1]"),
        ("layout.positions_m", json!([]), "layout.positions_m = []"),
        (
            "layout.positions_m",
            json!([[0, [1]], [[[]]]]),
            "layout.positions_m = [[0, [1]], [[[]]]]",
        ),
        (
            "layout.positions_m",
            json!(vec![[20, 0]; 9]),
            &format!("layout.positions_m = {:?}", [[20, 0]; 9]),
        ),
        ("wash.tunrs", json!(3), "wash.tunrs = 3"),
        ("wash", json!(3), "\"wash\".wash = 3"),
    ] {
        let error = refused("", key, value);
        if key == "wash" {
            assert!(error.to_string().starts_with("unknown key 'wash'"), "{error}");
        } else {
            assert_eq!(error.to_string(), of_file(line));
        }
        assert_eq!(error.key(), Some(key));
    }
    for (value, words) in [
        (json!([[0.1, null]]), "found [[0.1, nothing]]"),
        (json!({"a": 1}), "found a section"),
        (json!(vec![[0.1, 0.2]; 1001]), "[0.1, 0.2], …]"),
        (json!("x".repeat(1 << 20)), "x\"… (1048576 characters)"),
    ] {
        let message = refused("[layout]\n", "layout.positions_m", value).to_string();
        assert!(message.contains(words) && message.len() < 1000, "{message}");
    }
}

#[test]
fn names_the_conflicting_line_of_an_edit() {
    for (text, key, line) in [
        ("# a\nwash = 3\n", "wash.turns", 2),
        ("seed = 1\n[[wash]]\nturns = 1\n", "wash.turns", 2),
        ("[wash]\n\n[wash.turns]\nx = 1\n", "wash.turns", 3),
        ("wash.turns.x = 1", "wash.turns", 1),
        ("wash = { turns.x = 1 }", "wash.turns", 1),
        ("[name]\n", "name", 1),
    ] {
        match refused(text, key, if key == "name" { json!("a") } else { json!(3) }) {
            EditError::Blocked { key: of, line: at, .. } => assert_eq!((&*of, at), (key, line)),
            other => panic!("{other}"),
        }
        assert!(Draft::new(text).unwrap().set(key, None).is_err(), "{text}");
    }
}

#[test]
fn texts_that_are_too_long_are_refused() {
    let problem = Draft::new(&"#".repeat((1 << 20) + 1)).unwrap_err().problem;
    assert!(matches!(problem, Problem::TooLarge { .. }));
    let full = "#".repeat(1 << 20);
    assert!(matches!(refused(&full, "seed", json!(2)), EditError::TooLong { .. }));
    let error = Draft::new("a = 1\nb = \n").unwrap_err();
    assert_eq!((error.line(), error.key()), (Some(2), None));
}

#[test]
fn errors_name_their_key() {
    let key = |text: &str| Scenario::parse(text, "case").unwrap_err().key().map(str::to_owned);
    assert_eq!(key("wash.turns = -1").as_deref(), Some("wash.turns"));
    assert_eq!(key("wash.tunrs = 1").as_deref(), Some("wash.tunrs"));
    assert_eq!(key("").as_deref(), Some("layout"));
    assert_eq!(key("a = ").as_deref(), None);
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.layout.count = 1000;
    assert_eq!(scenario.check_work().unwrap_err().key(), Some("layout.count"));
}

#[test]
fn a_draft_states_the_values_of_its_scenario() {
    for shipped in SHIPPED {
        let draft = Draft::new(shipped.text).unwrap();
        let scenario = draft.scenario(shipped.name, None).unwrap();
        assert_eq!(scenario, Scenario::load(shipped.name).unwrap());
        let values = values_of(&scenario);
        for (key, value) in draft.stated() {
            let (stated, counts) = (
                value.to_string().replace(".0", ""),
                values[&key].to_string().replace(".0", ""),
            );
            assert_eq!(stated, counts, "{key}");
        }
    }
    let mut draft = Draft::new(SHIPPED[0].text).unwrap();
    draft.set("robot.urdf", Some(&json!("arm.urdf"))).unwrap();
    let path = |folder| draft.scenario("case", folder).unwrap().robot.urdf.unwrap();
    assert_eq!(path(None), Path::new("arm.urdf"));
    assert_eq!(path(Some(Path::new("here"))), Path::new("here/arm.urdf"));
    let odd = Draft::new("seed = inf\nwash = { turns = { a = 1 } }\nlayout.x_m = [nan, 1]").unwrap();
    let expected = json!({"seed": "inf", "wash.turns": "a section", "layout.x_m": ["nan", 1]});
    assert_eq!(json!(odd.stated()), expected);
}

/// Every row is one of the table and of the reference, word for word.
#[test]
fn the_form_is_the_table_of_keys() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/scenario.md");
    let page = std::fs::read_to_string(page).unwrap();
    let form = form();
    assert_eq!(form.len(), KEYS.len());
    for (row, key) in form.iter().zip(KEYS.iter()) {
        assert_eq!((row.path, row.unit, row.meaning), (key.path, key.unit, key.meaning));
        let name = key.path.rsplit('.').next().unwrap();
        let words = page.lines().any(|line| {
            line.starts_with(&format!("| `{name}` |"))
                && line.ends_with(&format!("| {} | {} |", row.expected, row.meaning))
        });
        assert!(words, "{}", key.path);
        if let Some(default) = &row.default {
            let mut draft = Draft::new("").unwrap();
            draft.set(key.path, Some(default)).unwrap();
            assert_eq!(
                draft.stated().get(key.path).map(ToString::to_string),
                Some(default.to_string())
            );
        }
    }
    let of = |path: &str| json!(form.iter().find(|row| row.path == path).map(|row: &FormKey| row));
    assert_eq!(
        of("wash.points"),
        json!({
            "path": "wash.points", "unit": "", "domain": {"kind": "integer", "least": 2, "most": 100_000},
            "expected": "a whole number from 2 to 100000", "meaning": "Waypoints of the paper's spiral.", "default": 55,
        })
    );
    assert_eq!(
        of("layout.positions_m")["domain"],
        json!({"kind": "points", "least": -10.0, "most": 10.0})
    );
    assert_eq!(of("layout.positions_m")["default"], Value::Null);
    assert_eq!(
        of("job.program")["domain"],
        json!({"kind": "word", "words": ["paper", "certified"]})
    );
    assert_eq!(of("name")["domain"], json!({"kind": "text"}));
}

#[test]
fn keys_of_sections_that_are_not_there_are_refused() {
    let text = "[[plate]]\nat_m = [0.3, 0, 0.03]\n";
    for (key, words) in [
        (
            "plate[1].at_m",
            "plate[1].at_m cannot be changed: there is no such [[plate]] section",
        ),
        ("obstacle[0].at_m", "there is no such [[obstacle]] section"),
        ("plate[0].at_n", "unknown key 'plate[0].at_n'"),
        ("plate[00].at_m", "unknown key"),
        ("plate[-1].at_m", "unknown key"),
        ("plate[18446744073709551616].at_m", "unknown key"),
        ("plate.at_m", "unknown key"),
        ("plates[0].at_m", "unknown key"),
    ] {
        let said = refused(text, key, json!([0.1, 0.2, 0.3])).to_string();
        assert!(said.contains(words), "{key}: {said}");
    }
    let said = refused(text, "plate[0].at_m", json!([0.1, 11, 0.3])).to_string();
    assert!(said.starts_with("plate[0].at_m must be three numbers"), "{said}");
    let nested = refused("[[plate]]\n[plate.at_m]\nx = 1\n", "plate[0].at_m", json!([0, 0, 0]));
    assert!(matches!(nested, EditError::Blocked { line: 2, .. }), "{nested}");
}

#[test]
fn a_section_is_taken_out_with_its_comments() {
    let without = |text: &str, key: &str| {
        let mut draft = Draft::new(text).unwrap();
        draft.set(key, None).unwrap();
        draft.text().to_owned()
    };
    let text = "# head\n\n[[obstacle]]\nname = \"a\"   # one\n\n# About b.\n[[obstacle]]\nname = \"b\"\n\n# Kept.\n\n# About c.\n\
                [[obstacle]]\nname = \"c\"\n\n[wash]\nturns = 3\n# end\n";
    let b = "# About b.\n[[obstacle]]\nname = \"b\"\n";
    let c = "# About c.\n[[obstacle]]\nname = \"c\"\n";
    let (kept, end) = ("\n# Kept.\n", "\n[wash]\nturns = 3\n# end\n");
    assert_eq!(without(text, "obstacle[0]"), format!("# head\n\n{b}{kept}\n{c}{end}"));
    assert_eq!(without(text, "obstacle[1]"), text.replace(&format!("\n{b}"), ""));
    assert_eq!(without(text, "obstacle[2]"), text.replace(&format!("\n{c}"), ""));
    // All of them, the ends of lines and the mark kept.
    let ends = format!("\u{feff}{}", text.replace('\n', "\r\n"));
    let none = ["obstacle[2]", "obstacle[0]", "obstacle[0]"]
        .iter()
        .fold(ends, |text, key| without(&text, key));
    assert_eq!(
        none,
        "\u{feff}# head\r\n\r\n# Kept.\r\n\r\n[wash]\r\nturns = 3\r\n# end\r\n"
    );
    assert_eq!(
        without("obstacle = [{name = \"a\"}, {name = \"b\"}]\n", "obstacle[0]"),
        "obstacle = [ {name = \"b\"}]\n"
    );
    let mut draft = Draft::new(text).unwrap();
    for key in [
        "obstacle[3]",
        "plate[0]",
        "obstacle[-1]",
        "obstacle[01]",
        "wash",
        "wash[0]",
    ] {
        draft.set(key, None).unwrap_err();
    }
    draft.set("obstacle[0]", Some(&Value::from(1))).unwrap_err();
    assert_eq!(draft.text(), text);
}

/// Joints that are held still are a table: in braces, with a header of its own, or with dots.
#[test]
fn positions_of_joints_are_a_table() {
    let all = json!({"rail": 0.3, "tip/finger 2": -2.0});
    for text in [
        "[robot]\nurdf = \"arm.urdf\"\nfixed = { rail = 0.3, \"tip/finger 2\" = -2 }\n",
        "[robot]\nurdf = \"arm.urdf\"\n[robot.fixed]\nrail = 0.3\n\"tip/finger 2\" = -2\n",
        "robot.urdf = \"arm.urdf\"\nrobot.fixed.rail = 0.3\nrobot.fixed.\"tip/finger 2\" = -2\n",
    ] {
        let draft = Draft::new(&format!("{text}[layout]\nregion = \"text\"\n")).unwrap();
        let fixed = &draft.stated()["robot.fixed"];
        assert_eq!(fixed.to_string(), r#"{"rail":0.3,"tip/finger 2":-2}"#, "{text}");
        let scenario = draft.scenario("case", None).unwrap();
        assert_eq!(json!(scenario.robot.fixed), all);
    }
    let mut draft = Draft::new("[robot]\nurdf = \"arm.urdf\"  # mine\n").unwrap();
    for (value, line) in [
        (json!({"rail": 0.3}), "fixed = { rail = 0.3 }\n"),
        (
            json!({"rail": 0.25, "tip/finger 2": 1.0}),
            "fixed = { rail = 0.25, \"tip/finger 2\" = 1.0 }\n",
        ),
        (json!({}), "fixed = {}\n"),
    ] {
        draft.set("robot.fixed", Some(&value)).unwrap();
        assert_eq!(draft.text(), format!("[robot]\nurdf = \"arm.urdf\"  # mine\n{line}"));
    }
    draft.set("robot.fixed", None).unwrap();
    assert_eq!(draft.text(), "[robot]\nurdf = \"arm.urdf\"  # mine\n");
    for (wrong, found) in [
        ("[\"rail\"]", "[\"rail\"]"),
        ("{ rail = \"far\" }", "a section"),
        ("{ rail = nan }", "a section"),
        ("{ rail = 1001.0 }", "a section"),
        ("{ \"\" = 1 }", "a section"),
        ("{ rail = { at = 1 } }", "a section"),
        ("0.3", "0.3"),
    ] {
        let text = format!("[robot]\nurdf = \"arm.urdf\"\nfixed = {wrong}\n[layout]\nregion = \"text\"\n");
        let error = Draft::new(&text)
            .unwrap()
            .scenario("case", None)
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("line 3: robot.fixed") && error.contains("a table of numbers") && error.contains(found),
            "{error}"
        );
    }
    let error = Draft::new("[robot]\nfixed = { rail = 1 }\n[layout]\nregion = \"text\"\n")
        .unwrap()
        .scenario("case", None)
        .unwrap_err()
        .to_string();
    assert!(error.contains("robot.fixed needs a robot.urdf"), "{error}");
}
