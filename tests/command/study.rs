//! Studies: run, ended and gone on with, shown, exported, refused.

use super::*;

const STUDY: &str = "format = \"platewash-study/1\"
name = \"tools\"
scenario = \"kitchen-spiral\"
[[axis]]
key = \"tool.length_m\"
values = [0.12, 0.15]
[[axis]]
key = \"seed\"
seeds = \"1..2\"
";

fn rows(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// A journal cut short goes on to the same rows, and what is finished stays as it is.
#[test]
fn a_study_resumes_where_it_ended() {
    let folder = folder();
    let dir = folder.path();
    std::fs::write(dir.join("study.toml"), STUDY).unwrap();
    let run =
        |out: &str, threads: &str| platewash(dir, &["study", "run", "study.toml", "--out", out, "--threads", threads]);
    let ran = run("a", "2");
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let whole = platewash(dir, &["study", "export", "a"]).stdout;
    let found = rows(&whole);
    let lengths: Vec<_> = found
        .iter()
        .map(|row| row["axes"]["tool.length_m"].as_f64().unwrap())
        .collect();
    assert_eq!(lengths, [0.12, 0.12, 0.15, 0.15]);
    assert!(
        found
            .iter()
            .all(|row| row["outcome"] == "proved" && row["swept"].as_f64().unwrap() >= 0.995),
        "{whole}"
    );

    // The last row torn, another one gone.
    let journal = dir.join("a/rows.jsonl");
    let kept = std::fs::read_to_string(&journal).unwrap();
    let lines: Vec<_> = kept.lines().collect();
    let out = dir.join("b");
    assert_eq!(run("b", "1").code, 0);
    assert_eq!(platewash(dir, &["study", "export", "b"]).stdout, whole);
    let torn = format!("{}\n{}\n{}", lines[0], lines[1], &lines[2][..20]);
    std::fs::write(out.join("rows.jsonl"), torn).unwrap();
    // It was finished, and is evidence.
    for words in [
        ["study", "run", "study.toml", "--out", "b"].as_slice(),
        &["study", "show", "b"],
        &["study", "export", "b"],
    ] {
        platewash(dir, words).refused(2, &["rows.jsonl", "changed since the study was finished"]);
    }
    let manifest = out.join("manifest.json");
    let mut stated: Value = serde_json::from_slice(&std::fs::read(&manifest).unwrap()).unwrap();
    stated.as_object_mut().unwrap().remove("rows_sha256").unwrap();
    std::fs::write(&manifest, stated.to_string()).unwrap();
    assert_eq!(run("b", "2").code, 0);
    assert_eq!(platewash(dir, &["study", "export", "b"]).stdout, whole);

    let before = std::fs::read(&journal).unwrap();
    assert_eq!(run("a", "2").code, 0);
    assert_eq!(std::fs::read(&journal).unwrap(), before);
    let shown = platewash(dir, &["study", "show", "a"]);
    assert!(shown.stdout.contains("4 of 4 proved"), "{}", shown.stdout);
    // The longest motions come with their time, the longest first.
    let (_, slowest) = shown.stdout.split_once("proved with the longest motion\n").unwrap();
    let times_s: Vec<f64> = slowest
        .lines()
        .map_while(|line| line.split_once(" proved, ")?.1.split_once(" s")?.0.parse().ok())
        .collect();
    assert!(
        times_s.len() == 4 && times_s.windows(2).all(|pair| pair[0] >= pair[1]),
        "{slowest}"
    );
    // A row of it needs the folder alone.
    assert!(shown.stdout.contains("study scenario a --row"), "{}", shown.stdout);
    std::fs::remove_file(dir.join("study.toml")).unwrap();
    let alone = platewash(dir, &["study", "scenario", "a", "--row", "2"]);
    assert!(alone.stdout.contains("length_m = 0.15"), "{}", alone.stdout);
}

#[test]
fn errors_of_a_study_name_file_line_and_key() {
    let folder = folder();
    let dir = folder.path();
    let refused = |change: (&str, &str), words: &[&str]| {
        std::fs::write(dir.join("study.toml"), STUDY.replace(change.0, change.1)).unwrap();
        platewash(dir, &["study", "run", "study.toml", "--out", "out"]).refused(2, words);
        assert!(!dir.join("out").exists());
    };
    refused(
        ("0.15]", "\"long\"]"),
        &["study.toml", "line 5", "tool.length_m", "\"long\""],
    );
    refused(("tool.length_m", "tool.lenght_m"), &["study.toml", "tool.lenght_m"]);
    refused(("1..2", "2..1"), &["study.toml", "2..1"]);
    refused(("kitchen-spiral", "kitchn"), &["kitchn"]);
    refused(
        (
            "key = \"seed\"\nseeds = \"1..2\"",
            "key = \"job.program\"\nvalues = [\"certified\", \"paper\"]",
        ),
        &["line 8", "job.program", "certified jobs", "paper"],
    );
    refused(("\"tools\"", "3"), &["line 2", "'name' must be a text; found 3"]);
    refused(
        ("\"tools\"", "\"two\\nlines\""),
        &["line 2", "name must be a line of text"],
    );
    for range in [
        "[0.1, 0.2]",
        "[0.1, 0.2, -1]",
        "[0.1, 0.2, 2.5]",
        "[0.1, 0.1, 3]",
        "[0.1, nan, 3]",
        "[-1e308, 1e308, 3]",
    ] {
        refused(
            ("values = [0.12, 0.15]", &format!("range = {range}")),
            &["line 6", "tool.length_m: must be [from, to, count]", "found ["],
        );
    }
    std::fs::write(
        dir.join("study.toml"),
        STUDY.split("[[axis]]").next().unwrap().to_owned() + "rows = []\n",
    )
    .unwrap();
    platewash(dir, &["study", "run", "study.toml", "--out", "out"]).refused(2, &["rows: the list is empty"]);
    std::fs::write(dir.join("study.toml"), STUDY).unwrap();
    for global in [["--seed", "1"], ["--scenario", "kitchen"]] {
        let mut words = vec!["study", "run", "study.toml", "--out", "out"];
        words.extend(global);
        platewash(dir, &words).refused(2, &[global[0], "study"]);
    }
}

/// What an export may not take the place of, and what it is not made of.
#[test]
fn an_export_never_overwrites_foreign_files() {
    let folder = folder();
    let dir = folder.path();
    let one = STUDY
        .split("[[axis]]")
        .next()
        .unwrap()
        .replace("kitchen-spiral", "kitchen");
    std::fs::write(dir.join("study.toml"), &one).unwrap();
    platewash(dir, &["study", "run", "study.toml", "--out", "-a"]).refused(2, &["-a"]);
    assert_eq!(platewash(dir, &["study", "run", "study.toml", "--out", "./-a"]).code, 0);
    let shown = platewash(dir, &["study", "show", "./-a"]).stdout;
    assert!(shown.contains("study scenario ./-a --row 0"), "{shown}");
    for place in ["./-a/rows.jsonl", "./-a/manifest.json", "./-a/../-a/new"] {
        let before = std::fs::read(dir.join(place)).ok();
        platewash(dir, &["study", "export", "./-a", "--to", place]).refused(2, &["it is in the study's folder"]);
        assert_eq!(std::fs::read(dir.join(place)).ok(), before);
    }
    #[cfg(unix)]
    {
        std::os::unix::net::UnixListener::bind(dir.join("socket")).unwrap();
        platewash(dir, &["study", "export", "./-a", "--to", "socket"]).refused(2, &["it is no regular file"]);
    }
    assert_eq!(
        platewash(dir, &["study", "export", "./-a", "--to", "new/rows.jsonl"]).code,
        0
    );
    assert_eq!(
        std::fs::read(dir.join("new/rows.jsonl")).unwrap(),
        std::fs::read(dir.join("-a/rows.jsonl")).unwrap()
    );

    let more = format!("{one}[[axis]]\nkey = \"layout.positions_m\"\nvalues = [[[0.9, 0.9]], [[0.8, 0.9]]]\n");
    std::fs::write(dir.join("study.toml"), more).unwrap();
    assert_eq!(
        platewash(dir, &["study", "run", "study.toml", "--out", "b", "--quiet"]).code,
        0
    );
    let rows = std::fs::read_to_string(dir.join("b/rows.jsonl")).unwrap();
    std::fs::write(dir.join("b/rows.jsonl"), rows.lines().next().unwrap().to_owned() + "\n").unwrap();
    let manifest = std::fs::read_to_string(dir.join("b/manifest.json")).unwrap();
    let (stated, _) = manifest.split_once(",\n  \"rows_sha256\"").unwrap();
    std::fs::write(dir.join("b/manifest.json"), format!("{stated}\n}}\n")).unwrap();
    platewash(dir, &["study", "export", "b", "--quiet"]).refused(2, &["1 of 2 rows", "--partial"]);
    assert_eq!(
        platewash(dir, &["study", "export", "b", "--partial"])
            .stdout
            .lines()
            .count(),
        1
    );
}
