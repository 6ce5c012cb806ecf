//! The playground: the engine as a WebAssembly module, the folder of the page around it, and the test of the module.

use crate::command::with_command;
use crate::step::Step;
use anyhow::{Context, Result};
use platewash_bundler::{Node, Packages, alone, python_program, root, target, workshop};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const TRIPLE: &str = "wasm32-unknown-unknown";
/// Makes the folder of the playground, and says how to look at it.
pub fn make() -> Result<()> {
    let folder = folder()?;
    println!(
        "\n{}: {:.1} MB; to serve it:",
        shown(&folder),
        1e-6 * size(&folder)? as f64
    );
    println!("{}", serving(&folder));
    Ok(())
}

/// Makes the folder of the playground.
pub fn folder() -> Result<PathBuf> {
    let module = module()?;
    let _alone = alone()?;
    let node = Node::found(Packages::Bundled)?;
    let workshop = workshop()?;
    workshop.fetch(&node, Packages::Bundled)?;
    let folder = target().join("playground");
    let (module, out) = (module.to_string_lossy(), folder.to_string_lossy());
    let line = ["build.mjs", "--playground", &module, "--out", &out];
    Step::from_command("playground", node.node(workshop.folder(), &line)).run()?;
    Ok(folder)
}

/// Builds the module. Installs the WebAssembly target first where the toolchain lacks it.
fn module() -> Result<PathBuf> {
    if !is_installed()? {
        let line = ["target", "add", TRIPLE];
        let added = Step::program("WebAssembly target", "rustup", &line).run();
        added.with_context(|| format!("the playground needs the WebAssembly target: rustup {}", line.join(" ")))?;
    }
    let line = ["build", "--release", "--target", TRIPLE, "-p", "platewash-playground"];
    Step::cargo("module of the playground", &line).run()?;
    Ok(target().join(TRIPLE).join("release/platewash_playground.wasm"))
}

/// Builds the module, so that later steps find it built.
pub fn built() -> Result<()> {
    module().map(drop)
}

/// Compares what the module answers with what the release build of the command writes.
pub fn tested() -> Result<()> {
    let module = module()?;
    let node = Node::found(Packages::All)?;
    let line = ["--test", "--test-reporter=spec", "tests/playground/same.mjs"];
    let step = Step::from_command("module and command side by side", node.node(&root(), &line));
    with_command(step).with("PLATEWASH_MODULE", module).run()
}

/// True if the toolchain in use compiles for WebAssembly.
fn is_installed() -> Result<bool> {
    let rustc = std::env::var_os("RUSTC").unwrap_or("rustc".into());
    let line = ["--print", "target-libdir", "--target", TRIPLE];
    let output = Command::new(rustc).args(line).current_dir(root()).output();
    let output = output.context("cannot run rustc")?;
    let folder = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    Ok(output.status.success() && Path::new(&folder).is_dir())
}

/// A command that serves a folder on this machine.
pub fn serving(folder: &Path) -> String {
    format!(
        "{} -m http.server --bind 127.0.0.1 --directory {}",
        python_program(),
        shown(folder)
    )
}

/// Bytes of all files in a folder.
fn size(folder: &Path) -> Result<u64> {
    let mut bytes = 0;
    for entry in fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let place = entry?.path();
        bytes += if place.is_dir() {
            size(&place)?
        } else {
            place.metadata()?.len()
        };
    }
    Ok(bytes)
}

/// A place as one types it at the root of the repository.
fn shown(place: &Path) -> String {
    place.strip_prefix(root()).unwrap_or(place).display().to_string()
}
