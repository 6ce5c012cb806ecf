//! Instruction counts of the command and of single solves, kept in a table of `docs/benchmarks.md` with their ratios to the counts before.
//!
//! Counts are callgrind's, on one thread. They do not drift with the load of the machine.

use crate::command;
use crate::step::Step;
use anyhow::{Context, Result, bail};
use platewash_bundler::{root, target};
use std::fs;
use std::path::Path;
use std::process::Command;

const PAGE: &str = "docs/benchmarks.md";

/// Lines of the page around the table.
const MARKS: [&str; 2] = ["<!-- counted by `cargo xtask ledger` -->", "<!-- end of the counts -->"];

/// Shipped scenarios that are planned and proved; the first one is simulated, too.
const SCENARIOS: [&str; 6] = ["kitchen", "coupe", "rim", "deep", "dessert", "rack"];

/// Shipped scenarios whose counts must not grow.
const CHECKED: [&str; 2] = ["kitchen", "deep"];

/// Verbs whose counts must not grow.
const VERBS: [&str; 3] = ["plan", "verify", "run"];

/// Greatest ratio of a count to the one of the table.
const GREATEST: f64 = 1.03;

/// Words of the program `one_solve`, and what one solve is.
const SOLVES: [(&str, &str); 6] = [
    ("warm", "`solve`, next point of a spiral"),
    ("path", "`solve_path`, next point of a spiral"),
    ("cold-solve", "`solve`, random pose and start"),
    ("cold", "`nearest`, random pose and start"),
    ("fk-batch", "`batch::fk` of 1000"),
    ("ik-batch", "`batch::solve` of 1000, starts 0.01 rad off"),
];

/// Solves between the two runs whose difference is taken.
const SOLVED: u64 = 500;

/// Counts all instructions and writes the table.
pub fn write() -> Result<()> {
    command::build()?;
    // Named beside the solves, the others have the same features as in the release build.
    let build = [
        "build",
        "--release",
        "-p",
        "platewash",
        "-p",
        "pyplatewash",
        "-p",
        "platewash-problems",
    ];
    Step::cargo("solves", &[&build[..], &["--bin", "one_solve"]].concat()).run()?;
    let page = root().join(PAGE);
    let text = fs::read_to_string(&page).with_context(|| page.display().to_string())?;
    let text = with_table(&text, &counts()?)?;
    fs::write(&page, text).with_context(|| page.display().to_string())
}

/// Compares counts of the release build of the command with the table; where nothing can be compared, it says so and passes.
///
/// # Errors
/// A count that is more than 3 % above that of the table, or that the table lacks.
pub fn check() -> Result<()> {
    println!("\n==> instruction counts against {PAGE}");
    if let Some(reason) = reason_not_to_count() {
        println!("    NOT COMPARED: {reason}");
        return Ok(());
    }
    let page = fs::read_to_string(root().join(PAGE)).context(PAGE)?;
    let mut rows = Vec::new();
    for scenario in CHECKED {
        for verb in VERBS {
            rows.push((row(verb, scenario), of_verb(verb, scenario)?));
        }
    }
    let (said, grown) = compared(table(&page)?.1, &rows)?;
    println!("{said}");
    if !grown.is_empty() {
        bail!(
            "more instructions than {PAGE} says, by more than {:.0} %: {}; make it faster again, or, where the work is worth its time, write \
             the new counts with `cargo xtask ledger` and say why in the commit",
            100.0 * (GREATEST - 1.0),
            grown.join("; ")
        );
    }
    Ok(())
}

/// Why this machine cannot count what the table has; `None` where it can.
fn reason_not_to_count() -> Option<&'static str> {
    if Command::new("valgrind").arg("--version").output().is_err() {
        return Some("there is no valgrind, which counts the instructions");
    }
    #[cfg(target_arch = "x86_64")]
    let has_avx2 = std::arch::is_x86_feature_detected!("avx2");
    #[cfg(not(target_arch = "x86_64"))]
    let has_avx2 = false;
    (!has_avx2).then_some("the counts are those of a processor with AVX2")
}

/// Counts beside those of a table: a line for each, and the names with both counts of those that have grown too much.
fn compared(table: &str, rows: &[(String, u64)]) -> Result<(String, Vec<String>)> {
    let (mut lines, mut grown) = (Vec::new(), Vec::new());
    for (name, count) in rows {
        let Some(before) = counted(table, name) else {
            bail!("{PAGE} has no count of {name}: write it with `cargo xtask ledger`");
        };
        let ratio = *count as f64 / before;
        let line = format!("{name}: {}, {ratio:.3} of the count before", in_words(*count));
        if ratio > GREATEST {
            grown.push(line.clone());
        }
        lines.push(format!("    {line}"));
    }
    Ok((lines.join("\n"), grown))
}

/// Name of the row of a verb and a scenario.
fn row(verb: &str, scenario: &str) -> String {
    format!("`{verb}`, {scenario}")
}

/// Instructions of a verb of the command for a scenario. All but `plan` and `run` need the plan that `plan` writes.
fn of_verb(verb: &str, scenario: &str) -> Result<u64> {
    let out = target().join("ledger").join(scenario).display().to_string();
    let plan = format!("{out}/plan.json");
    let mut words = match verb {
        "plan" | "run" => vec![verb, "--scenario", scenario, "--seed", "1"],
        _ => vec![verb, &plan],
    };
    words.extend(["--threads", "1", "--quiet"]);
    if verb != "verify" {
        words.extend(["--out", &out]);
    }
    instructions(&command::program(), &words)
}

/// Names and counts of all rows.
fn counts() -> Result<Vec<(String, u64)>> {
    let one_solve = target().join("release/one_solve");
    let mut rows = Vec::new();
    let mut add = |name: String, count: u64| {
        println!("    {name}: {}", in_words(count));
        rows.push((name, count));
    };
    for (k, scenario) in SCENARIOS.into_iter().enumerate() {
        let more = if CHECKED.contains(&scenario) { &VERBS[2..] } else { &[] };
        let simulated: &[&str] = if k == 0 { &["simulate"] } else { &[] };
        for verb in [&VERBS[..2], more, simulated].concat() {
            add(row(verb, scenario), of_verb(verb, scenario)?);
        }
    }
    for (word, name) in SOLVES {
        let solves = |count: u64| instructions(&one_solve, &[word, &count.to_string()]);
        add(name.to_owned(), (solves(1 + SOLVED)? - solves(1)?) / SOLVED);
    }
    Ok(rows)
}

/// Instructions of a program that ends well.
fn instructions(program: &Path, words: &[&str]) -> Result<u64> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(words)
        .current_dir(root())
        .output()
        .context("cannot run valgrind, which counts the instructions: install it")?;
    let log = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        bail!(
            "{} {} ended with {}\n{log}",
            program.display(),
            words.join(" "),
            output.status
        );
    }
    let count = log
        .rsplit_once("Collected : ")
        .and_then(|(_, count)| count.split_whitespace().next());
    let count = count.with_context(|| format!("valgrind counted nothing:\n{log}"))?;
    Ok(count.parse()?)
}

/// The page before its table, the table, and the page after it.
fn table(page: &str) -> Result<(&str, &str, &str)> {
    let [begins, ends] = MARKS;
    let parts = page
        .split_once(begins)
        .and_then(|(before, rest)| Some((before, rest.split_once(ends)?)));
    let Some((before, (table, after))) = parts else {
        bail!("{PAGE} has no lines '{begins}' and '{ends}'");
    };
    Ok((before, table, after))
}

/// The page with a new table, whose ratios are to the old one.
fn with_table(page: &str, rows: &[(String, u64)]) -> Result<String> {
    let [begins, ends] = MARKS;
    let (before, old, after) = table(page)?;
    let mut table = "| work | instructions | to the count before |\n| --- | ---: | ---: |\n".to_owned();
    for (name, count) in rows {
        let ratio = counted(old, name).map_or("–".to_owned(), |old| format!("{:.3}", *count as f64 / old));
        table += &format!("| {name} | {} | {ratio} |\n", in_words(*count));
    }
    Ok(format!("{before}{begins}\n\n{table}\n{ends}{after}"))
}

/// Count of a row of a table.
fn counted(table: &str, name: &str) -> Option<f64> {
    let cells = table.lines().map(|line| line.split(" | ").collect::<Vec<_>>());
    let row = cells
        .into_iter()
        .find(|cells| cells[0].strip_prefix("| ") == Some(name))?;
    let (digits, unit) = row.get(1)?.split_once(' ').unwrap_or((row.get(1)?, ""));
    let unit = if unit == "M" { 1e6 } else { 1.0 };
    Some(digits.parse::<f64>().ok()? * unit)
}

/// A count: millions above a million.
fn in_words(count: u64) -> String {
    if count < 1_000_000 {
        return count.to_string();
    }
    format!("{:.1} M", count as f64 / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_table_has_the_ratios_to_the_old_one() {
        let [begins, ends] = MARKS;
        let rows = |counts: [u64; 2]| {
            ["`plan`, kitchen", "`solve`"]
                .map(str::to_owned)
                .into_iter()
                .zip(counts)
                .collect::<Vec<_>>()
        };
        let first = with_table(&format!("a\n{begins}\n{ends}\nb"), &rows([800_000_000, 7000])).unwrap();
        assert!(first.contains("| `plan`, kitchen | 800.0 M | – |"), "{first}");
        let second = with_table(&first, &rows([400_000_000, 3500])).unwrap();
        assert!(
            second.contains("| `plan`, kitchen | 400.0 M | 0.500 |\n| `solve` | 3500 | 0.500 |"),
            "{second}"
        );
        assert!(second.starts_with("a\n") && second.ends_with("\nb"), "{second}");
        assert!(with_table("no marks", &rows([1, 1])).is_err());
    }

    #[test]
    fn a_count_that_grows_by_more_than_three_percent_is_named() {
        let [begins, ends] = MARKS;
        let rows = |plan: u64| {
            [
                ("`plan`, kitchen".to_owned(), plan),
                ("`run`, kitchen".to_owned(), 900_000_000),
            ]
        };
        let page = with_table(&format!("a\n{begins}\n{ends}\nb"), &rows(800_000_000)).unwrap();
        let (_, table, _) = table(&page).unwrap();
        assert!(compared(table, &rows(823_000_000)).unwrap().1.is_empty());
        let grown = compared(table, &rows(825_000_000)).unwrap().1;
        assert_eq!(grown, ["`plan`, kitchen: 825.0 M, 1.031 of the count before"]);
        assert!(compared(table, &[("`verify`, rim".to_owned(), 1)]).is_err());
    }
}
