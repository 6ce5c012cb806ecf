//! The page: its bundle, its own tests, and whether it is made twice alike.

use crate::step::Step;
use anyhow::{Context, Result, bail};
use platewash_bundler::{Node, Outcome, Packages, Workshop, alone, bundle, removed, sources, stamp, target, workshop};
use std::fs;
use std::path::PathBuf;

/// Makes the bundle where it is missing or old.
pub fn make() -> Result<()> {
    if platewash_bundler::make()? == Outcome::Fresh {
        println!("\n==> page: made already");
    }
    Ok(())
}

/// Checks the types of the page's sources.
pub fn types() -> Result<()> {
    let _alone = alone()?;
    let (node, workshop) = everything()?;
    Step::from_command("types of the page", node.npm(workshop.folder(), &["run", "check"])).run()
}

/// Node, and the page's sources with all their packages.
fn everything() -> Result<(Node, Workshop)> {
    let node = Node::found(Packages::All)?;
    let workshop = workshop()?;
    workshop.fetch(&node, Packages::All)?;
    Ok((node, workshop))
}

/// Runs the tests of the page's sources, which need no browser.
pub fn tested() -> Result<()> {
    let _alone = alone()?;
    let (node, workshop) = everything()?;
    let tests = Step::from_command("tests of the page", node.npm(workshop.folder(), &["test"]));
    // Later versions run TypeScript without being told to.
    tests.with("NODE_OPTIONS", "--experimental-strip-types").run()
}

/// Makes the bundle once more, elsewhere and with packages fetched anew: the same bytes come of it.
pub fn again() -> Result<()> {
    make()?;
    let _alone = alone()?;
    let node = Node::found(Packages::Bundled)?;
    let elsewhere = target().join("page made again");
    removed(&elsewhere)?;
    let workshop = Workshop::new("the page", &sources(), elsewhere.join("page"))?;
    workshop.fetch(&node, Packages::Bundled)?;
    workshop.bundle(&node, &elsewhere.join("dist"))?;
    for name in stamp::FILES.into_iter().chain([stamp::STAMP]) {
        let read = |place: PathBuf| fs::read(&place).with_context(|| place.display().to_string());
        if read(elsewhere.join("dist").join(name))? != read(bundle().join(name))? {
            bail!("the page made twice: {name} differs");
        }
    }
    removed(&elsewhere)
}
