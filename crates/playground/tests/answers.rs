//! Answers of the playground, here without a browser. `tests/playground` compares the module with the command.
#![allow(clippy::unwrap_used)]

use platewash_playground::Playground;
use platewash_scenario::{SHIPPED, Scenario};
use platewash_workcell::cancel::system_clock;
use serde_json::{Value, json};

fn ask(path: &str, question: &Value) -> Vec<Value> {
    let mut lines = Vec::new();
    let mut tell = |line: String| lines.push(serde_json::from_str(&line).unwrap());
    Playground::new(system_clock).answer(path, &question.to_string(), &mut tell);
    lines
}

/// The words of an answer that is one line of a kind.
fn words(kind: &str, path: &str, question: &Value) -> String {
    let lines = ask(path, question);
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert_eq!(lines[0]["kind"], kind, "{lines:?}");
    lines[0]["words"].as_str().unwrap().to_owned()
}

fn shipped(name: &str) -> &'static str {
    SHIPPED.iter().find(|shipped| shipped.name == name).unwrap().text
}

#[test]
fn lists_the_shipped_scenarios() {
    let lines = ask("/shipped", &json!({}));
    let listed: Vec<_> = lines[0].as_array().unwrap().iter().collect();
    assert_eq!(listed.len(), SHIPPED.len());
    for (line, shipped) in listed.iter().zip(SHIPPED) {
        assert_eq!(
            (&line["name"], &line["text"]),
            (&json!(shipped.name), &json!(shipped.text))
        );
        assert_eq!(line["is_paper"], json!(shipped.name.starts_with("paper")));
    }
}

#[test]
fn opens_any_text_as_it_is() {
    for text in [shipped("rack"), "wash.tuns = 3\n", "[[", ""] {
        let lines = ask("/open", &json!({ "text": text }));
        assert_eq!(lines[0]["edit"]["text"], text);
        assert_eq!(lines[0]["edit"]["channel"], "worker");
        assert_eq!(lines[0]["view"]["format"], "platewash-view/2");
    }
}

#[test]
fn a_plan_is_that_of_the_same_scenario_elsewhere() {
    let text = shipped("kitchen").replace("count = 4", "count = 1");
    let lines = ask("/file", &json!({ "text": text, "file": "plan.json", "bundle": null }));
    let job = Scenario::parse(&text, "case").unwrap().job().unwrap();
    let plan = platewash_planner::plan(&job).unwrap().plan;
    assert_eq!(lines[0]["name"], "plan.json");
    assert_eq!(lines[0]["text"], plan.to_json().unwrap());
}

#[test]
fn says_why_there_is_no_file() {
    let file = |text: &str, file: &str| {
        words(
            "failed",
            "/file",
            &json!({ "text": text, "file": file, "bundle": null }),
        )
    };
    let one = shipped("kitchen").replace("count = 4", "count = 1");
    assert!(file("wash.tuns = 3\n", "plan.json").contains("'wash.tuns'"));
    assert!(file(shipped("paper-text"), "plan.json").contains("job.program"));
    assert!(file(&one, "plan.xml").contains("expected plan.json, certificate.json, page.html, rapid"));
    assert!(file(&one, "page.html").contains("parts that all pages share"));
    assert!(file(&one, "urscript").contains("Universal Robots"));
    let away = one
        .replace("count = 1", "positions_m = [[1.5, 0]]")
        .replace("region = \"appendix\"", "");
    let words = file(&away, "certificate.json");
    assert!(words.contains("plate 1"), "{words}");
}

#[test]
fn refuses_files_and_unknown_questions() {
    let named = format!(
        "{}\n[robot]\nurdf = \"/etc/passwd\"\n",
        "layout.positions_m = [[0.3, 0]]"
    );
    assert!(
        !words(
            "failed",
            "/file",
            &json!({ "text": named, "file": "plan.json", "bundle": null })
        )
        .contains("root:")
    );
    assert!(words("failed", "/elsewhere", &json!({})).contains("/elsewhere"));
    assert!(words("failed", "/open", &json!({ "text": 3 })).contains("/open"));
}
