//! A dry run against the plan that it says it is one of.

use super::against::Against;
use super::failure::Failure;
use super::plan_file::{self, PlanFile};
use anyhow::anyhow;
use platewash::Plan;
use platewash::certificate::{Difference, differences};
use platewash::workcell::dry_run::{DryRunError, dry_run_terms};
use platewash::workcell::wash_path::WashPath;
use serde::Serialize;
use std::path::Path;

/// What a dry run has of its parent beside the job.
#[derive(Serialize)]
struct Motion<'a> {
    order: &'a [usize],
    wash_paths: &'a [WashPath],
}

/// Compares a dry run, field by field, with what a dry run of the plan at `path` would ask for, and its order and paths with those of
/// that plan.
pub fn compare(file: &PlanFile<'_>, path: &Path) -> Result<Against, Failure> {
    let Some(dry_run) = &file.plan.job.dry_run else {
        return Err(file.refused("it is not a dry run; --parent is for plans of platewash dry-run"));
    };
    let parent = plan_file::read(path)?;
    let (found, speed_m_s) = (&file.plan, file.plan.job.limits.tip_speed_m_s);
    let mut all = match dry_run_terms(&parent, &file.arm, dry_run.height_m, speed_m_s) {
        Ok(expected) => differences(&found.job, &expected),
        Err(error @ (DryRunError::Height { .. } | DryRunError::TooLow { .. } | DryRunError::Speed { .. })) => {
            vec![Difference {
                key: "dry_run".to_owned(),
                found: error.to_string(),
                expected: "is one of the plan given".to_owned(),
            }]
        }
        Err(error) => return Err(refused(path, error)),
    };
    all.extend(differences(&Motion::of(found), &Motion::of(&parent)));
    Ok(Against::parent(parent.hash, all))
}

impl<'a> Motion<'a> {
    fn of(plan: &'a Plan) -> Self {
        Self {
            order: &plan.order,
            wash_paths: &plan.wash_paths,
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
