//! The documentation as a website: pages, Rust and Python API, playground. Links that lead nowhere are errors.

use crate::step::Step;
use crate::{page, python, web, wheel};
use anyhow::{Context, Result, bail};
use platewash_bundler::{Node, Packages, Workshop, copied, removed, root, target};
use std::path::Path;
use std::{env, fs};

/// What pages link to beside those of `docs`, at the same places as in the repository.
const LINKED: [&str; 6] = [
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "docs",
    "examples",
    "notebooks",
];

/// Makes all that the website holds, then the website, and says how to look at it.
pub fn make() -> Result<()> {
    page::make()?;
    documentation()?;
    wheel::install()?;
    built()?;
    println!("\nto look at it: {}", web::serving(&target().join("site")));
    Ok(())
}

/// Builds the website from what is made: rustdoc's pages, and the wheel in the environment of the tests.
pub fn built() -> Result<()> {
    let node = Node::found(Packages::All)?;
    let workshop = Workshop::new("the website", &root().join("docs/site"), target().join("site-sources"))?;
    workshop.fetch(&node, Packages::All)?;
    let folder = workshop.folder();
    for name in LINKED {
        copied(&root().join(name), &folder.join("pages").join(name))?;
    }
    removed(&folder.join("pages/docs/site"))?;
    let line = ["-m", "zensical", "build", "--clean", "--strict"];
    let pages = Step::program("website", python::environment()?, &line).at(folder);
    pages.with("NO_COLOR", "1").run()?;
    let site = folder.join("site");
    copied(&target().join("doc"), &site.join("rust"))?;
    copied(&web::folder()?, &site.join("playground"))?;
    let scripts = [
        ("formulas", "formulas"),
        ("pictures", "pictures"),
        ("links of the website", "links"),
    ];
    for (name, script) in scripts {
        Step::from_command(name, node.npm(folder, &["run", "--silent", script])).run()?;
    }
    formulas_of_page(&node, folder)?;
    removed(&target().join("site"))?;
    fs::rename(&site, target().join("site")).with_context(|| site.display().to_string())
}

/// Checks that the page in 3-D has the formulas as the documentation has them, or writes them anew where `PLATEWASH_WRITE_DOCS` is set.
fn formulas_of_page(node: &Node, folder: &Path) -> Result<()> {
    let new = folder.join("formulas.json");
    let out = new.to_string_lossy();
    let line = ["mathml.mjs", &out, "pages/docs/certificate.md", "pages/docs/contact.md"];
    Step::from_command("formulas of the page", node.node(folder, &line)).run()?;
    let kept = root().join("crates/viewer/page/src/formulas.json");
    let read = |file: &Path| fs::read_to_string(file).with_context(|| file.display().to_string());
    if read(&new)? == read(&kept)? {
        return Ok(());
    }
    if env::var_os("PLATEWASH_WRITE_DOCS").is_none() {
        bail!(
            "{} is not what the formulas of docs give: run PLATEWASH_WRITE_DOCS=1 cargo xtask check --only site",
            kept.display()
        );
    }
    copied(&new, &kept)
}

/// Makes rustdoc's pages.
pub fn documentation() -> Result<()> {
    let step = Step::cargo("documentation", &["doc", "--release", "--workspace", "--no-deps"]);
    wheel::with_its_settings(step).with("RUSTDOCFLAGS", "-D warnings").run()
}
