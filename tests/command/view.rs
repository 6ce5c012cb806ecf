//! Pages that are served: `view`, and `run --live`.
//!
//! A program that was built without the page shows none, and says so; the suite makes the page first.

use super::served::{all, ask, command, line_after, start};
use super::*;
use platewash::viewer::bundle::Bundle;
use std::io::{BufRead, BufReader};
use std::net::TcpListener;

/// One small plate, washed in two seconds.
const QUICK: [(&str, &str); 7] = [
    ("region = \"appendix\"", "positions_m = [[0.36, 0.0]]"),
    ("plate_radius_m = 0.145", "plate_radius_m = 0.06"),
    ("path_radius_m = 0.12385", "path_radius_m = 0.03885"),
    ("turns = 3.5", "turns = 1.2"),
    (
        "joint_acceleration_rad_s2 = [4, 4, 4, 5, 5, 6]",
        "joint_acceleration_rad_s2 = [30, 30, 30, 30, 30, 30]",
    ),
    ("tip_acceleration_m_s2 = 8", "tip_acceleration_m_s2 = 30"),
    ("\nacceleration_m_s2 = 4", "\nacceleration_m_s2 = 20"),
];

fn plan(dir: &Path) {
    let quick = spiral(dir, &QUICK);
    let plan = ["plan", "--out", ".", "--quiet", "--scenario", quick.to_str().unwrap()];
    platewash(dir, &plan).done();
}

/// Whether there is a page; where there is none, that `view` says so.
fn is_there_a_page(dir: &Path) -> bool {
    if Bundle::embedded().is_some() {
        return true;
    }
    let ran = command(dir, &["view", "plan.json", "--no-open"]).output().unwrap();
    let said = String::from_utf8(ran.stderr).unwrap();
    assert_eq!(ran.status.code(), Some(1), "{said}");
    assert!(
        said.contains("error: there is no page to show") && said.contains("cargo xtask page"),
        "{said}"
    );
    false
}

#[test]
fn rejects_unusable_addresses_before_any_work() {
    let folder = folder();
    let dir = folder.path();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    for verb in [&["view", "nowhere.json"][..], &["run", "--live"]] {
        let refused = |arguments: &[&str], fragments: &[&str]| {
            let line = [verb, arguments, &["--no-open"]].concat();
            platewash(dir, &line).refused(2, fragments);
        };
        refused(&["--port", &port], &["--port: cannot listen on 127.0.0.1:", &port]);
        for port in ["65536", "-1", "http", ""] {
            refused(&["--port", port], &["--port"]);
        }
        for address in ["256.0.0.1", "evil.example", "127.0.0.1:80", ""] {
            refused(&["--bind", address], &["--bind"]);
        }
        // An address for documentation, which no machine has.
        refused(&["--bind", "192.0.2.1"], &["--bind: cannot listen on 192.0.2.1:0"]);
    }
    assert!(names(dir).is_empty());
}

#[test]
fn rejects_options_that_have_no_effect() {
    let folder = folder();
    let dir = folder.path();
    for given in [&["--port", "0"][..], &["--bind", "127.0.0.1"], &["--no-open"]] {
        platewash(dir, &[&["run"], given].concat()).refused(2, &[given[0], "--live"]);
        platewash(dir, &[&["view", "plan.json", "--save", "page.html"], given].concat())
            .refused(2, &[given[0], "--save"]);
    }
    platewash(dir, &["run", "--live", "--scenario", "paper-text"]).refused(2, &["--live", "platewash view"]);
    platewash(dir, &["view", "plan.json", "--scenario", "kitchen"]).refused(2, &["--scenario", "leave it out"]);
    platewash(dir, &["view", "plan.json", "--seed", "1"]).refused(2, &["--seed", "leave it out"]);
    platewash(dir, &["view", "plan.json", "--no-open"]).refused(2, &["plan.json"]);
    std::fs::write(dir.join("plan.json"), "{}").unwrap();
    platewash(dir, &["view", "plan.json", "--no-open"]).refused(2, &["plan.json"]);
    platewash(dir, &["view", "plan.json", "--save", "plan.json/page.html"]).refused(2, &["plan.json"]);
    assert_eq!(names(dir), ["plan.json"]);
}

#[cfg(unix)]
#[test]
fn a_plan_is_served_until_ctrl_c() {
    let folder = folder();
    let dir = folder.path();
    plan(dir);
    if !is_there_a_page(dir) {
        return;
    }
    for json in [false, true] {
        let arguments = ["view", "plan.json", "--no-open", "--json"];
        let mut view = start(&mut command(dir, &arguments[..3 + usize::from(json)]));
        let url = if json {
            line_after(&mut view.stdout, "  \"url\": ").trim_matches('"').to_owned()
        } else {
            line_after(&mut view.stdout, "")
        };
        let page = all(ask(&url, "/", ""));
        assert!(
            page.starts_with("HTTP/1.1 200 OK\r\n") && page.contains("kitchen"),
            "{}",
            page.len()
        );
        assert!(all(ask(&url, "/events", "")).starts_with("HTTP/1.1 404 "));
        view.interrupt();
        let rest = if json { "}\n" } else { "" };
        assert_eq!(view.end(), (Some(0), rest.to_owned(), "Ctrl-C ends it\n".to_owned()));
    }
}

/// Nothing is on an empty path, no browser either.
#[cfg(unix)]
#[test]
fn a_missing_browser_does_not_fail_the_command() {
    let folder = folder();
    let dir = folder.path();
    plan(dir);
    if !is_there_a_page(dir) {
        return;
    }
    let mut view = start(command(dir, &["view", "plan.json"]).env("PATH", dir));
    let url = line_after(&mut view.stdout, "");
    assert!(line_after(&mut view.stderr, "no browser can be opened").contains(&url));
    assert!(all(ask(&url, "/", "")).starts_with("HTTP/1.1 200 OK\r\n"));
    view.interrupt();
    assert_eq!(view.end().0, Some(0));
}

#[test]
fn a_page_is_saved_whole_and_the_same_each_time() {
    let folder = folder();
    let dir = folder.path();
    plan(dir);
    if !is_there_a_page(dir) {
        return;
    }
    let saved = |threads: &str| {
        let save = ["view", "plan.json", "--save", "deep/page.html", "--threads", threads];
        assert_eq!(platewash(dir, &save).done().stdout, "deep/page.html\n");
        std::fs::read(dir.join("deep/page.html")).unwrap()
    };
    let first = saved("1");
    assert!(String::from_utf8(first.clone()).unwrap().contains("kitchen"));
    assert_eq!(saved("3"), first);
    assert_eq!(std::fs::read_dir(dir.join("deep")).unwrap().count(), 1);
}

#[test]
fn a_recorded_motion_takes_the_place_of_the_simulation() {
    let folder = folder();
    let dir = folder.path();
    plan(dir);
    platewash(dir, &["simulate", "plan.json", "--out", ".", "--quiet", "--dt", "0.01"]).done();
    if !is_there_a_page(dir) {
        return;
    }
    let source = |more: &[&str]| {
        platewash(dir, &[&["view", "plan.json", "--save", "page.html"], more].concat()).done();
        let page = std::fs::read_to_string(dir.join("page.html")).unwrap();
        let (_, source) = page.split_once("\"execution\":{\"source\":\"").unwrap();
        source.split('"').next().unwrap().to_owned()
    };
    assert_eq!(source(&[]), "simulated");
    assert_eq!(source(&["--executed", "simulated.csv"]), "recorded");
    std::fs::remove_file(dir.join("page.html")).unwrap();
    let table = std::fs::read_to_string(dir.join("simulated.csv")).unwrap();
    let last = table.lines().last().unwrap();
    let late = format!("1000{}", &last[last.find(',').unwrap()..]);
    for (content, fragments) in [
        (String::new(), &["empty"][..]),
        (table.replacen("t_s", "t_ms", 1), &["line 1", "t_ms"]),
        (format!("{table}x{last}\n"), &["line"]),
        (format!("{table}{late}\n"), &["1000 s", "not of this plan"]),
    ] {
        std::fs::write(dir.join("bad.csv"), content).unwrap();
        let line = ["view", "plan.json", "--save", "page.html", "--executed", "bad.csv"];
        platewash(dir, &line).refused(2, &[&["bad.csv: "], fragments].concat());
    }
    let line = ["view", "plan.json", "--save", "page.html", "--executed", "nowhere.csv"];
    platewash(dir, &line).refused(2, &["nowhere.csv: cannot be read"]);
    assert!(!names(dir).contains(&"page.html".to_owned()));
}

/// A page loses its connection half-way, comes again, and has every sample once; the files are those of a run that nobody watches.
#[test]
fn a_live_run_is_streamed_and_writes_the_usual_files() {
    let folder = folder();
    let dir = folder.path();
    plan(dir);
    let run = ["run", "--scenario", "case.toml", "--out", "still"];
    let still = platewash(dir, &run).done();
    let live = ["run", "--scenario", "case.toml", "--out", "live", "--live", "--no-open"];
    if !is_there_a_page(dir) {
        let ran = command(dir, &live).output().unwrap();
        assert_eq!(ran.status.code(), Some(0));
        assert!(String::from_utf8(ran.stderr).unwrap().contains("no page: "));
        return;
    }
    let mut running = start(&mut command(dir, &live));
    let url = line_after(&mut running.stderr, "live at ");
    let page = all(ask(&url, "/", ""));
    let events = page.split('"').find(|part| part.starts_with("/events?run=")).unwrap();
    let mut seen = Vec::new();
    let mut first = BufReader::new(ask(&url, events, "")).lines().map(Result::unwrap);
    while seen.len() < 20 {
        seen.extend(rows(&first.next().unwrap()));
    }
    drop(first);
    let again = all(ask(&url, events, &format!("Last-Event-ID: {}\r\n", seen.len() - 1)));
    again.lines().for_each(|line| seen.extend(rows(line)));
    let times: Vec<f64> = seen.iter().map(|row| row[0]).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
    assert!(
        times[0] == 0.0 && times.windows(2).all(|pair| pair[1] - pair[0] < 0.03),
        "{times:?}"
    );
    let end = again.split("event: done\ndata: ").nth(1).unwrap();
    let end: Value = serde_json::from_str(end.lines().next().unwrap()).unwrap();
    assert!(
        end["headline"].as_str().unwrap().starts_with("1 of 1 plate swept") && end["washed"] == true,
        "{end}"
    );
    let (code, stdout, _) = running.end();
    assert_eq!((code, stdout), (Some(0), still.stdout));
    let (still, live) = (dir.join("still"), dir.join("live"));
    assert_eq!(names(&live), names(&still));
    for name in names(&live) {
        let content = |dir: &Path| std::fs::read(dir.join(&name)).unwrap();
        assert!(content(&live) == content(&still), "{name}");
    }
}

/// Samples in a line of events.
fn rows(line: &str) -> Vec<Vec<f64>> {
    let data = line.strip_prefix("data: ").map(serde_json::from_str::<Value>);
    let samples = data.and_then(|data| data.unwrap().get("samples").cloned());
    samples.map_or_else(Vec::new, |samples| serde_json::from_value(samples).unwrap())
}

#[cfg(unix)]
#[test]
fn a_live_run_that_waits_for_its_page_can_be_interrupted() {
    let folder = folder();
    let dir = folder.path();
    plan(dir);
    if !is_there_a_page(dir) {
        return;
    }
    let live = ["run", "--scenario", "case.toml", "--live", "--no-open"];
    let mut running = start(&mut command(dir, &live));
    line_after(&mut running.stderr, "live at ");
    running.interrupt();
    assert_eq!(running.end(), (Some(130), String::new(), "interrupted\n".to_owned()));
    assert_eq!(names(dir), ["case.toml", "plan.json", "trajectory.csv"]);
}
