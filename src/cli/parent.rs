//! A dry run against the plan that it says it is one of.

use super::failure::Failure;
use super::plan_file::{self, PlanFile};
use anyhow::anyhow;
use platewash::Plan;
use platewash::certificate::{Difference, differences};
use platewash::workcell::raised::{DryRunError, dry_run_terms};
use platewash::workcell::words::counted;
use serde::Serialize;
use std::fmt;
use std::path::Path;

/// Where a dry run is not one of the plan that is given.
#[derive(Debug, Serialize)]
pub struct OfParent {
    /// Hash of the plan that is given.
    hash: Option<String>,
    differences: Vec<Difference>,
}

impl OfParent {
    /// Compares a dry run, field by field, with what a dry run of the plan at `path` would ask for, and its order and paths with those of
    /// that plan.
    pub fn compare(file: &PlanFile<'_>, path: &Path) -> Result<Self, Failure> {
        let Some(dry_run) = &file.plan.job.dry_run else {
            return Err(file.refused("it is not a dry run; --parent is for plans of platewash dry-run"));
        };
        let parent = plan_file::read(path)?;
        let (found, speed_m_s) = (&file.plan, file.plan.job.limits.tip_speed_m_s);
        let mut all = match dry_run_terms(&parent, &file.arm, dry_run.height_m, speed_m_s) {
            Ok(expected) => differences(&found.job, &expected),
            Err(error @ (DryRunError::Height { .. } | DryRunError::TooLow { .. } | DryRunError::Speed { .. })) => {
                vec![difference("dry_run", &error.to_string(), "is one of the plan given")]
            }
            Err(error) => return Err(refused(path, error)),
        };
        all.extend(motions(found, &parent));
        Ok(Self {
            hash: parent.hash,
            differences: all,
        })
    }

    /// Whether it is one of that plan.
    pub fn agrees(&self) -> bool {
        self.differences.is_empty()
    }

    /// What stands before everything else; nothing where they agree.
    pub fn first_words(&self) -> String {
        match self.agrees() {
            true => String::new(),
            false => format!("NO DRY RUN of the plan given: {}; ", self.count()),
        }
    }

    fn count(&self) -> String {
        match self.differences.len() {
            0 => "no field differs from what a dry run must have".to_owned(),
            1 => "1 field differs".to_owned(),
            several => format!("{} differ", counted(several, "field")),
        }
    }
}

/// Why the plan that is given has no dry run.
fn refused(path: &Path, error: DryRunError) -> Failure {
    let words = anyhow!("{}: {error}", path.display());
    match error {
        DryRunError::NotSealed => Failure::not_verified(words),
        _ => Failure::input(words),
    }
}

/// The order of the plates and their wash paths, where they are not the parent's.
fn motions(found: &Plan, parent: &Plan) -> Vec<Difference> {
    let mut all = Vec::new();
    if found.order != parent.order {
        all.push(difference(
            "order",
            &format!("{:?}", found.order),
            &format!("{:?}", parent.order),
        ));
    }
    for k in 0..found.wash_paths.len().max(parent.wash_paths.len()) {
        let [ours, theirs] = [found, parent].map(|plan| plan.wash_paths.get(k));
        if ours != theirs {
            let said = |path: Option<_>| path.map_or_else(|| "nothing".to_owned(), |path| format!("{path:?}"));
            all.push(difference(&format!("wash_paths[{k}]"), &said(ours), &said(theirs)));
        }
    }
    all
}

fn difference(key: &str, found: &str, expected: &str) -> Difference {
    Difference {
        key: key.to_owned(),
        found: found.to_owned(),
        expected: expected.to_owned(),
    }
}

impl fmt::Display for OfParent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hash = self.hash.as_deref().unwrap_or("without a hash");
        writeln!(
            f,
            "dry run of {hash}: {}; that plan itself is not proved here",
            self.count()
        )?;
        self.differences.iter().try_for_each(|difference| {
            let Difference { key, found, expected } = difference;
            writeln!(f, "  {key}: the plan says {found}, a dry run {expected}")
        })
    }
}
