//! Instruction counts of the command and of single solves, kept in a table of `docs/benchmarks.md` with their ratios to the counts before.
//!
//! Counts are callgrind's, on one thread. They do not drift with the load of the machine.

use anyhow::{Context, Result, bail};
use platewash_bundler::{Step, root, target};
use std::fs;
use std::path::Path;
use std::process::Command;

const PAGE: &str = "docs/benchmarks.md";

/// Lines of the page around the table.
const MARKS: [&str; 2] = ["<!-- counted by `cargo xtask ledger` -->", "<!-- end of the counts -->"];

/// Shipped scenarios that are planned and proved; the first one is simulated, too.
const SCENARIOS: [&str; 6] = ["kitchen", "coupe", "rim", "deep", "dessert", "rack"];

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
pub fn run() -> Result<()> {
    let build = [
        "build",
        "--release",
        "-p",
        "platewash",
        "-p",
        "platewash-problems",
        "--bins",
    ];
    Step::cargo("command and solves", &build).run()?;
    let page = root().join(PAGE);
    let text = fs::read_to_string(&page).with_context(|| page.display().to_string())?;
    let text = with_table(&text, &counts()?)?;
    fs::write(&page, text).with_context(|| page.display().to_string())
}

/// Names and counts of all rows.
fn counts() -> Result<Vec<(String, u64)>> {
    let folder = target().join("ledger");
    let (platewash, one_solve) = (target().join("release/platewash"), target().join("release/one_solve"));
    let mut rows = Vec::new();
    let mut add = |name: String, count: u64| {
        println!("    {name}: {}", in_words(count));
        rows.push((name, count));
    };
    for (k, scenario) in SCENARIOS.into_iter().enumerate() {
        let out = folder.join(scenario).display().to_string();
        let (plan, common) = (format!("{out}/plan.json"), ["--threads", "1", "--quiet", "--out", &out]);
        let planning = [&["plan", "--scenario", scenario, "--seed", "1"], &common[..]].concat();
        add(format!("`plan`, {scenario}"), instructions(&platewash, &planning)?);
        let proving = ["verify", &plan, "--threads", "1", "--quiet"];
        add(format!("`verify`, {scenario}"), instructions(&platewash, &proving)?);
        if k == 0 {
            let simulating = [&["simulate", &plan], &common[..]].concat();
            add(
                format!("`simulate`, {scenario}"),
                instructions(&platewash, &simulating)?,
            );
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

/// The page with a new table, whose ratios are to the old one.
fn with_table(page: &str, rows: &[(String, u64)]) -> Result<String> {
    let [begins, ends] = MARKS;
    let parts = page
        .split_once(begins)
        .and_then(|(before, rest)| Some((before, rest.split_once(ends)?)));
    let Some((before, (old, after))) = parts else {
        bail!("{PAGE} has no lines '{begins}' and '{ends}'");
    };
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
}
