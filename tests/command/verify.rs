//! `platewash verify`.

use super::{folder, platewash};

#[test]
fn a_plan_of_the_papers_program_is_judged_and_not_certified() {
    let folder = folder();
    platewash(folder.path(), &["plan", "--scenario", "paper-appendix", "--quiet"]).done();
    let ran = platewash(folder.path(), &["verify", "out/plan.json"]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    assert!(
        ran.stdout.starts_with("NOT CERTIFIED: paper-appendix"),
        "{}",
        ran.stdout
    );
    assert!(ran.stdout.contains("hash is that of the contents"), "{}", ran.stdout);
    let ran = platewash(folder.path(), &["verify", "out/plan.json", "--json"]);
    assert_eq!(ran.code, 4);
    let certificate = ran.json();
    assert_eq!(certificate["verdict"], "fail");
    let promises = certificate["promises"].as_array().unwrap();
    let status = |name: &str| promises.iter().find(|p| p["name"] == name).unwrap()["status"].clone();
    assert_eq!(status("arm"), "fail", "the program is not the certified one");
    assert_eq!(status("segments"), "fail");
    assert_eq!(status("joint_position"), "fail", "the commanded jumps overshoot");
    assert_eq!(status("limits"), "pass");
    assert_eq!(status("coverage"), "not_proved");
}

#[test]
fn what_is_no_plan_is_refused() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["verify", "missing.json"]).refused(2, &["missing.json", "cannot be read"]);
    platewash(dir, &["verify", "."]).refused(2, &["not a regular file"]);
    std::fs::write(dir.join("text.json"), "{\"format\": 1}").unwrap();
    platewash(dir, &["verify", "text.json"]).refused(2, &["text.json", "not a plan file"]);
    platewash(dir, &["plan", "--scenario", "paper-appendix", "--quiet"]).done();
    let text = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    std::fs::write(
        dir.join("other.json"),
        text.replace("platewash-plan/1", "platewash-plan/9"),
    )
    .unwrap();
    platewash(dir, &["verify", "other.json"]).refused(2, &["platewash-plan/9"]);
    std::fs::write(dir.join("edited.json"), text.replacen("\"seed\":1", "\"seed\":2", 1)).unwrap();
    let ran = platewash(dir, &["verify", "edited.json"]);
    assert_eq!(ran.code, 4);
    assert!(
        ran.stdout.contains("hash is NOT that of the contents"),
        "{}",
        ran.stdout
    );
}
