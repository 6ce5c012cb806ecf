//! What the rows of a study come to, in words.

use platewash::study::{AxisValue, Outcome, Row, Summary};
use std::fmt::Write;
use std::path::Path;

/// How the rows ended, a line.
pub fn outcomes(of: &Summary) -> String {
    let counts = Outcome::ALL.iter().filter_map(|outcome| {
        let count = of.outcomes.get(outcome.code())?;
        Some(format!("{count} {}", outcome.code()))
    });
    let counts = counts.collect::<Vec<_>>().join(", ");
    let counts = if counts.is_empty() {
        "no row yet".to_owned()
    } else {
        counts
    };
    format!(
        "study {}: {} of {} rows: {counts}\n",
        of.manifest.name, of.done, of.manifest.rows
    )
}

/// All of what the rows in a folder come to.
pub fn shown(of: &Summary, folder: &Path) -> String {
    let mut text = outcomes(of);
    for (axis, values) in &of.by_axis {
        let _ = writeln!(text, "\n{axis}");
        for (AxisValue(value), counts) in values {
            let total: u64 = counts.values().sum();
            let proved = counts.get(Outcome::Proved.code()).copied().unwrap_or(0);
            let others = counts.iter().filter(|(code, _)| **code != Outcome::Proved.code());
            let others: String = others.map(|(code, count)| format!(", {count} {code}")).collect();
            let _ = writeln!(text, "  {value}: {proved} of {total} proved{others}");
        }
    }
    if let Some([least, low, middle, high, most]) = of.duration_s {
        let _ = writeln!(
            text,
            "\nduration of what is proved: {least:.2} s least, {low:.2} s at 5 %, {middle:.2} s at 50 %, {high:.2} s at 95 %, {most:.2} s most"
        );
    }
    list(&mut text, of, "not proved, the first of each outcome", &of.not_proved);
    list(&mut text, of, "proved with the least clearance", &of.nearest);
    list(&mut text, of, "proved with the longest motion", &of.slowest);
    if let Some(row) = of.not_proved.iter().chain(&of.nearest).next() {
        let _ = writeln!(
            text,
            "\na row alone, here row {}:\n  platewash study scenario {} --row {} > row.toml && platewash run --scenario row.toml",
            row.index,
            quoted(folder),
            row.index
        );
        if !of.manifest.files.is_empty() {
            text.push_str("  (it names files: write row.toml beside the study's scenario; in Python, StudyRows.scenario needs none of them)\n");
        }
    }
    text
}

fn list(text: &mut String, of: &Summary, title: &str, rows: &[Row]) {
    if rows.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n{title}");
    for row in rows {
        let several = (of.manifest.scenarios.len() > 1).then(|| row.scenario.clone());
        let axes = row.axes.iter().map(|(key, value)| format!("{key} = {value}"));
        let axes = several.into_iter().chain(axes).collect::<Vec<_>>().join(", ");
        let duration = row.duration_s.map(|s| format!(", {s:.2} s"));
        let clearance = row.clearance_m.map(|v| format!(", clearance {:.1} mm", 1e3 * v));
        let pair = row.clearance_pair.as_ref().map(|[a, b]| format!(" ({a}, {b})"));
        let reason = row.reason.as_ref().map(|reason| format!(": {reason}"));
        let _ = writeln!(
            text,
            "  row {} ({axes}) {}{}{}{}{}",
            row.index,
            row.outcome.code(),
            duration.unwrap_or_default(),
            clearance.unwrap_or_default(),
            pair.unwrap_or_default(),
            reason.unwrap_or_default()
        );
    }
}

/// A path as a shell takes it, and no command takes it for an option.
fn quoted(path: &Path) -> String {
    let path = path.display().to_string();
    let path = if path.starts_with('-') {
        format!("./{path}")
    } else {
        path
    };
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-".contains(c);
    match path.chars().all(plain) {
        true => path,
        false => format!("'{}'", path.replace('\'', "'\\''")),
    }
}
