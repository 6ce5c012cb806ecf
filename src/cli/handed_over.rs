//! `platewash verify PLAN --program FILE`: a program that was handed over, read back: what changed since, and whether it still holds.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::{export, output};
use anyhow::anyhow;
use platewash::certificate::Check;
use platewash::export::dialect::ProgramFile;
use platewash::export::{Change, CompareError, Compared, compare, contact_not_judged, ros2};
use platewash::kinematics::urdf::file;
use platewash::workcell::dry_run::DryRun;
use platewash::workcell::plan::Plan;
use platewash::workcell::words::{counted, printable};
use serde::Serialize;
use std::ffi::OsStr;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Longest program file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 26;

/// What is said of a program.
#[derive(Debug, Serialize)]
struct Answer {
    headline: String,
    target: &'static str,
    holds: bool,
    unchanged: bool,
    /// Whether the program refuses to start where the arm does not stand at the start.
    checks_start: bool,
    /// The files that were read.
    files: Vec<String>,
    changes: Vec<Change>,
    more_changes: usize,
    /// What is proved of it as it stands: the worst over all assumptions about corners.
    checks: Vec<Check>,
    implied: Vec<Check>,
    /// That the tool of the program is not the plan's.
    #[serde(skip_serializing_if = "Option::is_none")]
    tool: Option<String>,
    /// What the plan promises of contact: of the program it is not judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    proved_of_the_plan_alone: Option<String>,
}

/// Compares the files of a program with the one that is made of the plan, and judges them as they stand.
pub fn run(options: &Options, plan: &Path, program: &[PathBuf]) -> Result<ExitCode, Failure> {
    let program = with_siblings(program);
    let files = program.iter().map(|path| read(path)).collect::<Result<Vec<_>, _>>()?;
    let plan = PlanFile::read(options, plan)?;
    let certified = match export::certified(options, &plan)? {
        Ok(certified) => certified,
        Err(words) => return export::uncertified(options, &words),
    };
    let compared = {
        let _progress = Progress::new(options.quiet, "judging the program");
        compare(&certified, &plan.arm, &files, &options.cancel)
    };
    let compared = compared.map_err(|error| match error {
        CompareError::Prove(error) => plan.failure(error.into()),
        error => Failure::input(error),
    })?;
    let names = files.into_iter().map(|file| file.name).collect();
    let answer = Answer::of(&compared, &plan.plan, names, &certified.certificate().but_for());
    output::print_either(options.json, &answer, || answer.text())?;
    let outcome = if answer.holds {
        Outcome::Good
    } else {
        Outcome::NotVerified
    };
    Ok(outcome.answer())
}

/// The files of a program, and those beside them that can be sent in their place: of a ROS 2 program, all that `export` writes.
fn with_siblings(program: &[PathBuf]) -> Vec<PathBuf> {
    let mut all = program.to_vec();
    let is_own = |path: &&PathBuf| {
        let name = path.file_name().and_then(OsStr::to_str);
        name.is_some_and(|name| ros2::FILES.contains(&name))
    };
    for path in program.iter().filter(is_own) {
        let beside = ros2::FILES.map(|name| path.with_file_name(name));
        for sibling in beside.into_iter().filter(|sibling| sibling.exists()) {
            if !all.contains(&sibling) {
                all.push(sibling);
            }
        }
    }
    all
}

fn read(path: &Path) -> Result<ProgramFile, Failure> {
    let text = file::read_text(path, MAX_BYTES)
        .map_err(|e| Failure::input(anyhow!("{}: cannot be read: {e}", path.display())))?;
    let name = path.file_name().unwrap_or(path.as_os_str());
    Ok(ProgramFile {
        name: name.to_string_lossy().into_owned(),
        text,
    })
}

impl Answer {
    fn of(compared: &Compared, plan: &Plan, files: Vec<String>, but_for: &str) -> Self {
        let dry_run = plan.job.dry_run.as_ref();
        let (holds, unchanged) = (compared.holds(), compared.is_unchanged());
        let changed = match (unchanged, compared.changes.len() + compared.more_changes) {
            (true, _) => "as it was handed over".to_owned(),
            (false, count) => format!("CHANGED in {}", counted(count, "place")),
        };
        let verdict = match (holds, compared.checks_start) {
            (true, true) => "HOLDS",
            (true, false) => "HOLDS, START NOT CHECKED",
            (false, _) => "DOES NOT HOLD",
        };
        let within = format!("tip within {} mm of the plan", 1e3 * compared.tolerance_m);
        Self {
            headline: format!(
                "{}{verdict}{but_for}: {} program, {within}; {changed}",
                export::before(dry_run.map(DryRun::words).as_deref()),
                compared.dialect
            ),
            target: compared.dialect,
            holds,
            unchanged,
            checks_start: compared.checks_start,
            files,
            changes: compared.changes.clone(),
            more_changes: compared.more_changes,
            checks: compared.judged.worst(),
            implied: compared.judged.implied(),
            tool: compared.tool.as_ref().map(ToString::to_string),
            proved_of_the_plan_alone: contact_not_judged(&plan.job.requirements),
        }
    }

    fn text(&self) -> String {
        let files: Vec<_> = self.files.iter().map(|name| printable(name)).collect();
        let mut text = format!("{}\n  read: {}\n", self.headline, files.join(", "));
        for Change {
            place,
            what,
            found,
            expected,
        } in &self.changes
        {
            // A text that grows cannot fail to be written.
            let _ = writeln!(text, "  {place}: {what}: {found}; handed over: {expected}");
        }
        if self.more_changes > 0 {
            let _ = writeln!(text, "  and {} more", self.more_changes);
        }
        if !self.unchanged {
            text +=
                "  only the motion is judged; changed checks before the start, messages and comments are only named\n";
        }
        if !self.checks_start {
            text += "  the start is not checked: the program starts to move wherever the arm stands\n";
        }
        if let Some(tool) = &self.tool {
            let _ = writeln!(text, "  {:<20} {:<9} {tool}", "tool", "NOT KEPT");
        }
        for check in &self.checks {
            let status = if check.status.is_kept() { "kept" } else { "NOT KEPT" };
            let (name, detail) = (check.requirement.words(), check.detail());
            let _ = writeln!(text, "  {name:<20} {status:<9} {detail}; {}", check.worst);
        }
        if let Some(all) = &self.proved_of_the_plan_alone {
            let _ = writeln!(text, "  proved for the plan, not for the program: {all}");
        }
        text
    }
}
