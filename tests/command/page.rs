//! The page beside the report: where the program has its bundle, and said where it has not.

use super::*;
use platewash::viewer::bundle::Bundle;

/// What a page is about.
fn document(page: &str) -> Value {
    let (_, data) = page.split_once("id=\"platewash-view\">").unwrap();
    serde_json::from_str(data.split_once("</script").unwrap().0).unwrap()
}

#[test]
fn a_run_writes_a_page_or_reports_the_reason() {
    for (scenario, process) in [("kitchen", "wash"), ("paper-text", "paper")] {
        let folder = folder();
        let ran = platewash(folder.path(), &["run", "--scenario", scenario]).done();
        let quiet = platewash(folder.path(), &["run", "-q", "--scenario", scenario]).done();
        assert_eq!(quiet.stderr.contains("no page: "), Bundle::embedded().is_none());
        let page = std::fs::read_to_string(folder.path().join("out/page.html")).ok();
        assert_eq!(page.is_some(), Bundle::embedded().is_some(), "{}", ran.stderr);
        match page {
            Some(page) => {
                assert!(ran.stderr.contains("page.html"), "{}", ran.stderr);
                let document = document(&page);
                assert_eq!(document["heading"]["process"], process);
                assert_eq!(document["execution"]["source"], "simulated");
                assert!(document["surroundings"]["polygon_m"].as_array().unwrap().len() == 4);
                assert_eq!(document["certificate"].is_null(), process == "paper");
            }
            None => assert!(ran.stderr.contains("no page: "), "{}", ran.stderr),
        }
    }
}

/// A page of an earlier call does not stay beside another plan.
#[test]
fn the_command_contains_its_page() {
    let folder = folder();
    let out = folder.path().join("out");
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("page.html"), "of an earlier call").unwrap();
    platewash(folder.path(), &["plan"]).done();
    assert!(!out.join("page.html").exists());
    std::fs::create_dir(out.join("page.html")).unwrap();
    platewash(folder.path(), &["run"]).refused(2, &["page.html", "folder"]);
}
