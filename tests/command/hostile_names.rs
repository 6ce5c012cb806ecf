//! Names that imitate verdicts or break lines: the name of a plan's scenario, which nobody checks.

use super::{folder, platewash};
use platewash::Plan;
use platewash::kinematics::words::is_hidden;
use platewash::workcell::words::quoted;
use std::fs;
use std::path::Path;

fn hostile() -> Vec<String> {
    let mut names = [
        "PROVED: 9 plates in 1.00 s, each pressed over at least 100 % (99.5 % required)",
        "CERTIFIED: kitchen, as asked; every plate 100 % pressed, 23.901 s",
        "kitchen\", as the plan names it\nhash is that of the contents",
        "x\n\nPROVED: 4 plates in 1.00 s",
        "x\r\nHOLDS: rapid program",
        "x\u{2028}WASHED: 4 of 4 plates washed",
        "x\u{85}PROVED",
        "\u{202e}DEVORP :4 setalp",
        "\u{2066}PROVED\u{2069}",
        "\"; PROVED: all; \"",
        "\\\"; PROVED: all; \\\"",
        "\u{1b}[2J\u{1b}[1;1HPROVED: all",
        "\u{8}\u{8}\u{8}\u{8}PROVED",
        "</title><script>document.title='PROVED'</script>",
        "-->PROVED<!--",
        "ENDMODULE\n! PROVED",
        "end\n  # PROVED",
        "\"\"\"\nprint('PROVED')\n\"\"\"",
        "",
    ]
    .map(str::to_owned)
    .to_vec();
    names.push("PROVED ".repeat(20_000));
    names
}

/// Those that are read at all.
fn readable() -> Vec<String> {
    hostile().into_iter().filter(|name| !name.contains(is_hidden)).collect()
}

/// A plan of one plate as `NAME.json`, of a scenario of this name.
fn write(dir: &Path, plan: &Plan, file: &str, name: &str) {
    let mut plan = plan.clone();
    name.clone_into(&mut plan.provenance.scenario);
    plan.hash = Some(plan.seal().unwrap());
    fs::write(dir.join(file), plan.to_json().unwrap()).unwrap();
}

/// A text without the name where it stands in quotes, and without hashes, which depend on it.
fn without(text: &str, name: &str) -> String {
    let hexadecimal = |word: &str| word.len() >= 12 && word.bytes().all(|digit| digit.is_ascii_hexdigit());
    let text = text.replace(&quoted(name), "NAME");
    let words = text
        .split(' ')
        .map(|word| if hexadecimal(word.trim_end()) { "HASH\n" } else { word });
    words.collect::<Vec<_>>().join(" ")
}

#[test]
fn names_never_read_as_a_verdict_or_add_a_line() {
    let folder = folder();
    let dir = folder.path();
    let scenario = super::spiral(dir, &[("region = \"appendix\"", "positions_m = [[0.35, 0.1]]")]);
    platewash(dir, &["plan", "--quiet", "--scenario", scenario.to_str().unwrap()]).done();
    let plan = Plan::from_json(&fs::read_to_string(dir.join("out/plan.json")).unwrap()).unwrap();
    let told = |name: &str| {
        write(dir, &plan, "plan.json", name);
        let verify = platewash(dir, &["verify", "plan.json", "--quiet"]).done().stdout;
        let simulate = platewash(dir, &["simulate", "plan.json", "--quiet"]).done().stdout;
        assert!(verify.starts_with("PROVED: 1 plate in "), "{verify}");
        [verify, simulate].map(|text| without(&text, name))
    };
    let innocent = told("x");
    for name in readable() {
        assert_eq!(told(&name), innocent, "{name:?}");
    }
    for name in hostile().iter().filter(|name| name.contains(is_hidden)) {
        write(dir, &plan, "plan.json", name);
        for verb in ["verify", "simulate", "figures"] {
            let message = ["provenance.scenario", "control or direction character"];
            platewash(dir, &[verb, "plan.json", "--quiet"]).refused(2, &message);
        }
    }
}

/// The first word of a comment; `None` of what is no comment, or continues the one before it.
fn first_word(line: &str) -> Option<String> {
    let comment = line.trim_start().strip_prefix(['!', '#'])?;
    let word = comment.split_whitespace().next().unwrap_or_default();
    (!comment.starts_with("   ")).then(|| word.to_owned())
}

#[test]
fn no_name_breaks_a_file() {
    let folder = folder();
    let dir = folder.path();
    let scenario = super::spiral(dir, &[("region = \"appendix\"", "positions_m = [[0.35, 0.1]]")]);
    platewash(dir, &["plan", "--quiet", "--scenario", scenario.to_str().unwrap()]).done();
    let plan = Plan::from_json(&fs::read_to_string(dir.join("out/plan.json")).unwrap()).unwrap();
    let made = |name: &str, targets: &[&str]| {
        write(dir, &plan, "plan.json", name);
        let mut lines = Vec::new();
        for target in targets {
            let out = dir.join(target);
            let _ = fs::remove_dir_all(&out);
            let out = out.to_str().unwrap();
            let answer = platewash(dir, &["export", "plan.json", "--to", target, "--out", out, "--json"])
                .done()
                .json();
            let files = answer["files"].as_array().unwrap();
            for file in files {
                let text = fs::read_to_string(dir.join(file.as_str().unwrap())).unwrap();
                lines.extend(text.lines().filter_map(first_word));
            }
        }
        lines
    };
    let judge = |names: &[String], targets: &[&str]| {
        let innocent = made("x", targets);
        for name in names {
            let words = made(name, targets);
            assert_eq!(words.len(), innocent.len(), "{name:?}");
            let verdicts = ["PROVED", "CERTIFIED", "WASHED", "HOLDS"];
            let reads = |word: &String| verdicts.iter().any(|verdict| word.starts_with(verdict));
            assert!(!words.iter().any(reads), "{name:?}");
        }
    };
    let names = readable();
    judge(&names, &["rapid"]);
    judge(&names[..3], &["ros2", "csv"]);
}
