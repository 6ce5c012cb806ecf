//! The bundle that all pages share: in the program, else on disk in the checkout that cargo runs it from, where it is made if need be.

use super::failure::Failure;
use super::options::Options;
use super::output;
use super::progress::Progress;
use anyhow::{Context, bail};
use platewash::viewer::bundle::Bundle;
use std::fs::File;
use std::io::{Read, Seek};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// With `0`, no bundle is made: for tests, and for whoever has no network to wait for.
const SWITCH: &str = "PLATEWASH_MAKE_PAGE";

/// The longest that making it may take: a minute on a slow network.
const LONGEST: Duration = Duration::from_secs(300);

/// Time between two looks at whoever makes it.
const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

/// The bundle; none where there is none and it cannot be made, which a line on standard error explains. It may take a minute and need a
/// network, so that results should be written before.
pub fn bundle(options: &Options) -> Option<Bundle> {
    match find(options) {
        Ok(bundle) => Some(bundle),
        Err(why) => {
            output::message(options.quiet, &format!("no page: {why:#}"));
            None
        }
    }
}

/// The bundle, for a verb that can do nothing without it.
pub fn needed(options: &Options) -> Result<Bundle, Failure> {
    let found = find(options);
    options.cancel.check()?;
    found.map_err(|why| Failure::internal(why.context("there is no page to show")))
}

fn find(options: &Options) -> anyhow::Result<Bundle> {
    Bundle::embedded().map_or_else(|| from_checkout(options), Ok)
}

fn from_checkout(options: &Options) -> anyhow::Result<Bundle> {
    let variable = |name: &str| std::env::var_os(name).map(PathBuf::from);
    let Some(checkout) = checkout(variable("CARGO_MANIFEST_DIR")) else {
        bail!("this program was built without it; `cargo xtask page` in its sources makes it, then build again");
    };
    let folder = checkout.join("crates/viewer/dist");
    if let Ok(bundle) = Bundle::read(&folder) {
        return Ok(bundle);
    }
    if std::env::var_os(SWITCH).is_some_and(|value| value == "0") {
        bail!("it is not made yet, and {SWITCH}=0 says not to; `cargo xtask page` makes it");
    }
    let cargo = variable("CARGO").unwrap_or_else(|| "cargo".into());
    let _progress = Progress::new(options.quiet, "making the page, which later runs have");
    make(
        options,
        Command::new(cargo).args(["xtask", "page"]).current_dir(&checkout),
    )?;
    Bundle::read(&folder).map_err(anyhow::Error::from)
}

/// The checkout that cargo runs this program from, if it does: the folder that it names has the sources of the page and the chore
/// that makes it.
fn checkout(named_by_cargo: Option<PathBuf>) -> Option<PathBuf> {
    let has = |folder: &PathBuf| {
        let needed = ["crates/viewer/page/package.json", "xtask/Cargo.toml"];
        needed.iter().all(|name| folder.join(name).is_file())
    };
    named_by_cargo.filter(has)
}

/// Runs what makes the bundle, until it is done, takes too long or nobody waits any more.
fn make(options: &Options, command: &mut Command) -> anyhow::Result<()> {
    let mut said = tempfile::tempfile()?;
    let errors = said.try_clone()?;
    let child = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(errors)
        .spawn();
    let mut child = child.context("cargo cannot be started")?;
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if options.cancel.is_cancelled() || start.elapsed() > LONGEST {
            end(&mut child);
            bail!(
                "given up after {} s; `cargo xtask page` makes it",
                start.elapsed().as_secs()
            );
        }
        std::thread::sleep(BETWEEN_LOOKS);
    };
    match status.success() {
        true => Ok(()),
        false => bail!("{}", reason(&mut said)),
    }
}

fn end(child: &mut Child) {
    // One that has ended meanwhile is as good.
    let _ = child.kill();
    let _ = child.wait();
}

/// The last thing that was said, in one line.
fn reason(said: &mut File) -> String {
    let mut text = Vec::new();
    let read = said.rewind().and_then(|()| said.read_to_end(&mut text));
    let text = String::from_utf8_lossy(&text);
    let last = text.lines().rev().map(str::trim).find(|line| !line.is_empty());
    match (read, last) {
        (Ok(_), Some(line)) => line.trim_start_matches("FAILED: ").to_owned(),
        _ => "`cargo xtask page` fails and does not say why".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn a_checkout_has_the_page_and_the_chore() {
        let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        assert_eq!(checkout(Some(here.clone())), Some(here.clone()));
        for other in [Some(here.join("xtask")), Some(PathBuf::from("/nowhere")), None] {
            assert_eq!(checkout(other.clone()), None, "{other:?}");
        }
    }

    #[test]
    fn the_last_line_is_the_reason() {
        let reason_of = |text: &str| {
            let mut said = tempfile::tempfile().unwrap();
            said.write_all(text.as_bytes()).unwrap();
            reason(&mut said)
        };
        assert_eq!(reason_of("npm error\n\nFAILED: no network\n\n"), "no network");
        assert!(reason_of("\n").contains("does not say why"));
    }
}
