//! The first lines of commits.

use anyhow::{Context, Result, bail};
use platewash_bundler::root;
use std::process::Command;

/// Longest first line \[characters\].
const LONGEST: usize = 72;

/// Fails unless the first line of every commit since a revision is made as it should be; merges do not count.
pub fn since(revision: &str) -> Result<()> {
    // What begins with a dash would be an option of git's.
    if revision.starts_with('-') {
        bail!("'{revision}' is no revision");
    }
    let range = format!("{revision}..HEAD");
    let mut git = Command::new("git");
    git.args(["log", "--no-merges", "--format=%h %s", &range])
        .current_dir(root());
    let output = git.output().context("cannot start git")?;
    if !output.status.success() {
        bail!("git log {range}: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let commits: Vec<(&str, &str)> = text.lines().filter_map(|line| line.split_once(' ')).collect();
    let wrong = commits
        .iter()
        .filter_map(|(commit, subject)| Some(format!("{commit} '{subject}': {}", fault(subject)?)));
    let wrong: Vec<String> = wrong.collect();
    if !wrong.is_empty() {
        bail!(
            "first lines are \"area: what\" in at most {LONGEST} characters\n{}",
            wrong.join("\n")
        );
    }
    println!("{} commits since {revision}", commits.len());
    Ok(())
}

/// What is wrong with a first line.
fn fault(subject: &str) -> Option<String> {
    let length = subject.chars().count();
    if length > LONGEST {
        return Some(format!("{length} characters"));
    }
    let Some((areas, what)) = subject.split_once(": ") else {
        return Some("no area".to_owned());
    };
    let is_area = |area: &str| {
        area.starts_with(char::is_lowercase) && area.chars().all(|sign| sign.is_alphanumeric() || "-_".contains(sign))
    };
    if let Some(area) = areas.split(", ").find(|area| !is_area(area)) {
        return Some(format!(
            "'{area}' is no area: a word in small letters, or several with commas"
        ));
    }
    if what.trim() != what || what.is_empty() {
        return Some("nothing, or spaces, around what was done".to_owned());
    }
    what.ends_with('.').then(|| "a full stop at the end".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_area_and_what_was_done_is_a_first_line() {
        let longest = format!("docs: {}", "ä".repeat(LONGEST - 6));
        for subject in [
            "workcell: a crate for the world and its words",
            "tests, wheel: C² paths: both",
            "x-task: URDF",
            &longest,
        ] {
            assert_eq!(fault(subject), None, "{subject}");
        }
    }

    #[test]
    fn anything_else_is_none() {
        let long = format!("docs: {}", "a".repeat(LONGEST - 5));
        let cases = [
            ("Say what the pictures show", "no area"),
            ("Merge branch 'main' of /tmp/x", "no area"),
            ("fixup! docs: x", "'fixup! docs'"),
            ("Docs: x", "'Docs' is no area"),
            ("docs,wheel: x", "'docs,wheel'"),
            (": x", "'' is no area"),
            ("docs:x", "no area"),
            ("docs: ", "nothing"),
            ("docs:  x", "spaces"),
            ("docs: x.", "full stop"),
            (long.as_str(), "73 characters"),
        ];
        for (subject, expected) in cases {
            let found = fault(subject).unwrap_or_default();
            assert!(found.contains(expected), "{subject}: {found}");
        }
    }
}
