//! Files of a planned and proved scenario, byte for byte as the command writes them.

use platewash_certificate::certify_with;
use platewash_editor::{LastResult, paper_beside};
use platewash_export::dialect::Dialect;
use platewash_export::dialects;
use platewash_export::{ExportSettings, export};
use platewash_simulator::{SimulationReport, simulate};
use platewash_viewer::bundle::Bundle;
use platewash_viewer::page;
use platewash_viewer::view::{ExecutedMotion, View, ViewExtras};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::json;
use serde::{Deserialize, Serialize};

/// Question for a file of a scenario.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileQuestion {
    /// The scenario.
    pub text: String,
    /// `plan.json`, `certificate.json` or `page.html`, which `platewash run` writes; or a kind of program of `platewash export`.
    file: String,
    /// Parts that all pages share; for `page.html` alone.
    bundle: Option<BundleText>,
}

/// Parts that all pages share.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BundleText {
    template: String,
    style: String,
    script: String,
    notices: String,
}

/// A file.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename = "file")]
pub struct FileLine {
    name: String,
    text: String,
}

/// The files that a question asks for: one, or those of a robot program.
///
/// # Errors
/// The reason that there are none, in words.
pub fn files(result: &LastResult, question: &FileQuestion) -> Result<Vec<FileLine>, String> {
    let name = question.file.as_str();
    let text = match (name, dialects::by_name(name)) {
        (_, Some(dialect)) => return program(result, dialect),
        ("plan.json", _) => plan(result)?.to_json().map_err(|error| error.to_string()),
        ("certificate.json", _) => {
            let certificate = result.certificate.as_deref().ok_or(&result.headline)?;
            json::write(certificate).map_err(|error| error.to_string())
        }
        ("page.html", _) => html(result, question.bundle.as_ref()),
        _ => Err(format!(
            "{name}: no such file; expected plan.json, certificate.json, page.html, {}",
            dialects::names()
        )),
    };
    let name = name.to_owned();
    Ok(vec![FileLine { name, text: text? }])
}

fn plan(result: &LastResult) -> Result<&platewash_motion::plan::Plan, String> {
    result.plan.as_deref().ok_or_else(|| result.headline.clone())
}

/// The page of a plan with its proof and its simulation, as `platewash run` writes it.
fn html(result: &LastResult, bundle: Option<&BundleText>) -> Result<String, String> {
    let bundle = bundle.ok_or("page.html needs the parts that all pages share")?;
    let (plan, arm) = (plan(result)?, arm(result)?);
    let executed = simulate(plan, &arm, &plan.job.simulation).ok().and_then(|execution| {
        let report = SimulationReport::new(plan, &arm, &plan.job.simulation, &execution).ok()?;
        Some(ExecutedMotion::simulated(&execution, &report))
    });
    let region = result.scenario.task_region(&arm);
    let extras = ViewExtras {
        certificate: result.certificate.as_deref(),
        executed: executed.as_ref(),
        region: Some(&region),
        events: None,
    };
    let view = View {
        beside: paper_beside(plan, &arm),
        ..View::of_plan(plan, &arm, &extras).map_err(|error| error.to_string())?
    };
    let bundle = Bundle {
        template: bundle.template.clone().into(),
        style: bundle.style.clone().into(),
        script: bundle.script.clone().into(),
        notices: bundle.notices.clone().into(),
    };
    page::html(&view, &bundle).map_err(|error| error.to_string())
}

/// The robot program of a proved plan, as `platewash export` writes it.
fn program(result: &LastResult, dialect: &dyn Dialect) -> Result<Vec<FileLine>, String> {
    let (plan, arm, cancel) = (plan(result)?, arm(result)?, CancelToken::new());
    let certified = certify_with(plan.clone(), &arm, &cancel).map_err(|error| error.to_string())?;
    let exported = export(&certified, &arm, dialect, &ExportSettings::default(), &cancel);
    let exported = exported.map_err(|error| error.to_string())?;
    let files = exported.files.into_iter().map(|file| FileLine {
        name: file.name,
        text: file.text,
    });
    Ok(files.collect())
}

fn arm(result: &LastResult) -> Result<std::sync::Arc<platewash_kinematics::RobotModel>, String> {
    result.scenario.arm().map_err(|error| error.to_string())
}
