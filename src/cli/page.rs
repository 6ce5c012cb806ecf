//! The page of a plan: what a scenario says of its surroundings, and the file beside the report.

use super::failure::Failure;
use super::options::Options;
use super::output::{self, File};
use super::{bundle, results};
use anyhow::Context;
use platewash::viewer::bundle::Bundle;
use platewash::viewer::page;
use platewash::viewer::view::{Beside, View};
use platewash::{Plan, RobotModel};

/// The page of a plan.
pub fn html(plan: &Plan, arm: &RobotModel, beside: &Beside<'_>, bundle: &Bundle) -> anyhow::Result<String> {
    let view = View::of_plan(plan, arm, beside)?;
    Ok(page::html(&view, bundle)?)
}

/// The page of a plan as a file beside its report. The first page of a checkout may take a minute. Without a bundle there is none, and a line
/// on standard error says why.
pub fn file(
    options: &Options,
    plan: &Plan,
    arm: &RobotModel,
    beside: &Beside<'_>,
) -> Result<Option<File<'static>>, Failure> {
    let Some(bundle) = bundle::bundle() else {
        return Ok(None);
    };
    options.cancel.check()?;
    let page = html(plan, arm, beside, &bundle)
        .context("the page of the plan")
        .map_err(Failure::internal)?;
    Ok(Some(output::file(results::folder(options).join(results::PAGE), page)))
}
