//! The release build of the command.

use crate::size::no_larger;
use crate::step::Step;
use anyhow::Result;
use platewash_bundler::{root, target};
use std::path::PathBuf;

/// Largest command \[bytes\].
const LARGEST: u64 = 24_000_000;

/// Builds the command with the release profile, no larger than wanted; returns cargo's messages.
pub fn messages() -> Result<String> {
    // Named beside it, the extension has the command's dependencies built with the features that it needs, too.
    let line = [
        "build",
        "--release",
        "-p",
        "platewash",
        "-p",
        "pyplatewash",
        "--bin",
        "platewash",
        "--message-format",
        "json-render-diagnostics",
    ];
    let messages = Step::cargo("release build", &line).output()?;
    no_larger(&program(), LARGEST)?;
    Ok(messages)
}

/// Builds the command with the release profile.
pub fn build() -> Result<()> {
    messages().map(drop)
}

/// The command, where the release build puts it.
pub fn program() -> PathBuf {
    let name = format!("platewash{}", std::env::consts::EXE_SUFFIX);
    target().join("release").join(name)
}

/// Names the release build of the command and the project's folder to a step.
pub fn with_command(step: Step) -> Step {
    step.with("PLATEWASH_BIN", program()).with("PLATEWASH_ROOT", root())
}
