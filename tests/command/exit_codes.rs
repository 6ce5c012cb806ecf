//! One rule for all verbs: what each condition ends with.

use super::*;

/// A shipped scenario with some fragments replaced, in a file of its own.
fn write(dir: &Path, name: &str, shipped: &str, changes: &[(&str, &str)]) {
    let file = format!("{}/scenarios/{shipped}.toml", env!("CARGO_MANIFEST_DIR"));
    let mut text = std::fs::read_to_string(file).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "no '{from}' in {shipped}");
        text = text.replacen(from, to, 1);
    }
    std::fs::write(dir.join(format!("{name}.toml")), text).unwrap();
}

const REPORT: (&str, &str) = ("on_failure = \"fail\"", "on_failure = \"report\"");
const FAIL: (&str, &str) = ("on_failure = \"report\"", "on_failure = \"fail\"");

/// One plate: its verdict ends the command as those of four do.
const FEWER: (&str, &str) = ("count = 4", "count = 1");

/// Scenarios by condition: each with `on_failure = "fail"`, and with "report" under a name that ends so.
fn conditions(dir: &Path) {
    let region = "region = \"appendix\"";
    let far = (region, "positions_m = [[0.8, 0.0]]");
    let same = (region, "positions_m = [[0.36, 0.0], [0.36, 0.0]]");
    let pd = ("[job]", "[control]\nlaw = \"pd\"\nfrequency_rad_s = 15\n[job]");
    for (name, changes) in [("far", &[far][..]), ("same", &[same]), ("pd", &[pd, FEWER])] {
        write(dir, name, "kitchen-spiral", changes);
        let report = [&[REPORT], changes].concat();
        write(dir, &format!("{name}-report"), "kitchen-spiral", &report);
    }
    write(dir, "one", "kitchen", &[FEWER]);
    let told = ("overlap = \"fail\"", "overlap = \"report\"");
    write(dir, "told", "kitchen-spiral", &[same, told]);
    write(dir, "paper-report", "paper-appendix", &[]);
    write(dir, "paper", "paper-appendix", &[FAIL]);
    let many = ("count = 4", "count = 9");
    write(dir, "full-report", "paper-appendix", &[many]);
    write(dir, "full", "paper-appendix", &[FAIL, many]);
}

/// Plan files by condition, and two that were changed after they were sealed.
fn plans(dir: &Path) {
    for name in ["one", "pd", "pd-report", "paper", "paper-report"] {
        platewash(dir, &["plan", "--scenario", &format!("{name}.toml"), "--out", name]);
    }
    for (name, altered) in [("one", "altered"), ("paper-report", "altered-report")] {
        let text = std::fs::read_to_string(dir.join(name).join("plan.json")).unwrap();
        let changed = text.replacen("\"seed\":1", "\"seed\":2", 1);
        assert_ne!(changed, text);
        std::fs::create_dir(dir.join(altered)).unwrap();
        std::fs::write(dir.join(altered).join("plan.json"), changed).unwrap();
    }
}

/// Runs each line of a table: arguments, exit code, how standard output begins (nothing where the exit code is 2).
fn judge(dir: &Path, table: &[(&str, i32, &str)]) {
    for (line, code, begins) in table {
        let arguments: Vec<_> = line.split_whitespace().chain(["--out", "o"]).collect();
        let ran = platewash(dir, &arguments);
        assert_eq!(ran.code, *code, "{line}: {}{}", ran.stdout, ran.stderr);
        assert!(ran.stdout.starts_with(begins), "{line}: {}", ran.stdout);
        assert_eq!(
            ran.stderr.matches("error:").count(),
            usize::from(*code == 2 || begins.is_empty()),
            "{line}: {}",
            ran.stderr
        );
    }
}

#[test]
fn a_job_ends_with_its_verdict_where_its_scenario_asks_for_that() {
    let folder = folder();
    let dir = folder.path();
    conditions(dir);
    let planned = "PLANNED, NOT PROVED: ";
    judge(
        dir,
        &[
            ("run --scenario one.toml", 0, "PROVED"),
            ("run --scenario far.toml", 3, "INFEASIBLE"),
            ("run --scenario far-report.toml", 0, "INFEASIBLE"),
            ("run --scenario same.toml", 3, "INFEASIBLE: plate 1 and plate 2 overlap"),
            ("run --scenario same-report.toml", 0, "INFEASIBLE"),
            ("run --scenario pd.toml", 4, "PROVED"),
            ("run --scenario pd-report.toml", 0, "PROVED"),
            ("run --scenario paper.toml", 3, "NOT SWEPT"),
            ("run --scenario paper-report.toml", 0, "NOT SWEPT"),
            ("run --scenario full.toml", 3, "INFEASIBLE"),
            ("run --scenario full-report.toml", 0, "INFEASIBLE"),
            ("run --scenario nowhere.toml", 2, ""),
            ("plan --scenario one.toml", 0, planned),
            ("plan --scenario far.toml", 3, "INFEASIBLE"),
            ("plan --scenario far-report.toml", 0, "INFEASIBLE"),
            ("plan --scenario same.toml", 3, "INFEASIBLE"),
            ("plan --scenario paper.toml", 3, planned),
            ("plan --scenario paper-report.toml", 0, planned),
            ("plan --scenario full.toml", 3, "INFEASIBLE"),
            ("plan --scenario full-report.toml", 0, "INFEASIBLE"),
            ("plan --scenario nowhere.toml", 2, ""),
            ("sweep --seeds 1..2 --scenario one.toml", 0, "seed,"),
            ("sweep --seeds 1..2 --scenario far.toml", 3, "seed,"),
            ("sweep --seeds 1..2 --scenario far-report.toml", 0, "seed,"),
            ("sweep --seeds 1..2 --scenario same.toml", 3, "seed,"),
            ("sweep --seeds 1..2 --scenario same-report.toml", 0, "seed,"),
            ("sweep --seeds 1..2 --scenario paper.toml", 2, ""),
        ],
    );
}

#[test]
fn a_question_is_answered_by_its_exit_code_whatever_the_scenario_says() {
    let folder = folder();
    let dir = folder.path();
    conditions(dir);
    plans(dir);
    judge(
        dir,
        &[
            ("validate --scenario kitchen", 0, "kitchen: valid"),
            ("validate --scenario same.toml", 3, ""),
            ("validate --scenario same-report.toml", 3, ""),
            ("layout --scenario same.toml", 3, "given"),
            ("layout --scenario same-report.toml", 3, "given"),
            ("layout --scenario told.toml", 0, "given"),
            ("validate --scenario paper-report.toml", 0, "paper-appendix: valid"),
            ("validate --scenario nowhere.toml", 2, ""),
            ("verify one/plan.json", 0, "PROVED"),
            ("verify paper-report/plan.json", 4, "NOT PROVED"),
            ("verify one/plan.json --against one.toml", 0, "PROVED"),
            ("verify one/plan.json --against pd.toml", 4, "OTHER JOB"),
            ("verify pd/plan.json --against pd-report.toml", 0, "PROVED"),
            ("verify paper/plan.json --against paper.toml", 4, "NOT PROVED"),
            ("verify one/plan.json --against full.toml", 3, ""),
            ("verify one/plan.json --against nowhere.toml", 2, ""),
            ("verify altered/plan.json", 4, "NOT PROVED"),
            ("verify nowhere.json", 2, ""),
            ("layout --scenario kitchen", 0, "sampled"),
            ("ik --position 0.3 0 0.3 --rpy-deg 0 90 0", 0, "solved"),
            ("ik --position 2 0 0.3 --rpy-deg 0 90 0", 3, "NOT solved"),
        ],
    );
    for verb in ["validate", "layout"] {
        for scenario in ["full.toml", "full-report.toml"] {
            platewash(dir, &[verb, "--scenario", scenario]).refused(3, &["9 plates cannot fit"]);
        }
    }
}

#[test]
fn a_simulation_is_answered_by_its_exit_code_and_an_altered_plan_never_well() {
    let folder = folder();
    let dir = folder.path();
    conditions(dir);
    plans(dir);
    let (tuned, spiral) = ("\"kitchen\" under ", "\"kitchen-spiral\" under ");
    judge(
        dir,
        &[
            ("simulate one/plan.json", 0, "WASHED"),
            ("simulate pd/plan.json", 4, "NOT SWEPT"),
            ("simulate pd-report/plan.json", 4, "NOT SWEPT"),
            ("simulate paper/plan.json", 4, "NOT SWEPT"),
            ("simulate paper-report/plan.json", 4, "NOT SWEPT"),
            ("simulate altered/plan.json", 4, "ALTERED"),
            ("simulate altered-report/plan.json", 4, "ALTERED"),
            ("simulate one/plan.json --frequency 5000", 2, ""),
            ("simulate nowhere.json", 2, ""),
            ("tune one/plan.json --frequencies 30,5000 --dampings 1", 0, tuned),
            ("tune pd/plan.json --frequencies 15 --dampings 1", 4, spiral),
            ("tune pd-report/plan.json --frequencies 15 --dampings 1", 4, spiral),
            ("tune altered/plan.json --frequencies 30 --dampings 1", 4, tuned),
            ("tune one/plan.json --frequencies 5000,6000 --dampings 1", 2, tuned),
            ("tune nowhere.json", 2, ""),
        ],
    );
}

/// The page says what the tables above hold.
#[test]
fn the_page_on_the_command_names_every_verb() {
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/command.md")).unwrap();
    let folder = folder();
    let help = platewash(folder.path(), &["--help"]).done().stdout;
    let verbs = help
        .split("Commands:")
        .nth(1)
        .unwrap()
        .split("Options:")
        .next()
        .unwrap();
    let verbs = verbs
        .lines()
        .filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let verbs: Vec<_> = verbs.filter(|verb| !verb.is_empty() && *verb != "help").collect();
    assert!(verbs.len() >= 12, "{verbs:?}");
    for verb in verbs {
        assert!(page.contains(&format!("`{verb}`")), "{verb} is not in docs/command.md");
    }
}
