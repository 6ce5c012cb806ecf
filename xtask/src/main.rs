//! The project's own chores.
//!
//!     cargo xtask test [OPTIONS]                    every test there is
//!         --only rust|python|browser                one part of them
//!         --without-browser                         all but what is looked at in a browser
//!     cargo xtask check [OPTIONS]                   what else must hold: format, clippy, documentation, types, packages, website, speed
//!         --only lint|types|packages|site|benchmarks|ledger    one part of it
//!         --without-browser                         all but what is looked at in a browser
//!     cargo xtask bench [ARGUMENTS]                 the benchmarks at the root; arguments go to criterion
//!     cargo xtask ledger                            counts instructions and writes them to docs/benchmarks.md; needs valgrind
//!         --check                                   fails where plan, verify or run take more instructions than written there
//!     cargo xtask packages                          makes the packages and uses them outside of the checkout, before a release
//!     cargo xtask page                              makes what all pages in 3-D share, crates/viewer/dist, where it is missing or old
//!     cargo xtask web                               makes the playground, the live cell for a static host, in target/playground
//!     cargo xtask site                              makes the website of the documentation, in target/site
//!     cargo xtask screenshots [SCENARIO ...]        pictures of the page in target/screenshots, to look at; edit: a live cell
//!     cargo xtask measure [DRAGS]                   times of the page in a browser: first frame, drop of a plate to its drawn proof
//!     cargo xtask docs                              writes the pages that are made from the program

mod benches;
mod browser;
mod check;
mod command;
#[cfg(test)]
mod comments;
#[cfg(test)]
mod glossary;
mod ledger;
mod packages;
mod page;
mod programs;
mod python;
#[cfg(test)]
mod rings;
mod site;
mod size;
mod sources;
mod step;
mod steps;
mod test;
mod web;
mod wheel;

use anyhow::{Result, bail};
use std::process::ExitCode;
use test::BrowserTests;

const USAGE: &str = "\
cargo xtask test [OPTIONS]                    every test there is
    --only rust|python|browser                one part of them
    --without-browser                         all but what is looked at in a browser
cargo xtask check [OPTIONS]                   what else must hold: format, clippy, documentation, types, packages, website, speed
    --only lint|types|packages|site|benchmarks|ledger    one part of it
    --without-browser                         all but what is looked at in a browser
cargo xtask bench [ARGUMENTS]                 the benchmarks at the root; arguments go to criterion
cargo xtask ledger                            counts instructions and writes them to docs/benchmarks.md; needs valgrind
    --check                                   fails where plan, verify or run take more instructions than written there
cargo xtask screenshots [SCENARIO ...]        pictures of the page in target/screenshots, to look at; edit: a live cell
cargo xtask packages                          makes the packages and uses them outside of the checkout, before a release
cargo xtask page                              makes what all pages in 3-D share, crates/viewer/dist, where it is missing or old
cargo xtask web                               makes the playground, the live cell for a static host, in target/playground
cargo xtask site                              makes the website of the documentation, in target/site
cargo xtask measure [DRAGS]                   times of the page in a browser: first frame, drop of a plate to its drawn proof
cargo xtask docs                              writes the pages that are made from the program";

/// What to do.
#[derive(Debug, PartialEq, Eq)]
enum Chore {
    Test(Option<test::Part>, BrowserTests),
    Check(Option<check::Part>, BrowserTests),
    Bench(Vec<String>),
    Ledger,
    LedgerCheck,
    Screenshots(Vec<String>),
    Measure(Vec<String>),
    Packages,
    Page,
    Web,
    Site,
    Docs,
    Help,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let chore = match parse(&arguments) {
        Ok(chore) => chore,
        Err(error) => {
            eprintln!("{error}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    let done = match chore {
        Chore::Test(only, in_browser) => test::run(only, in_browser),
        Chore::Check(only, in_browser) => check::run(only, in_browser),
        Chore::Bench(arguments) => benches::run(&arguments),
        Chore::Ledger => ledger::write(),
        Chore::LedgerCheck => ledger::check(),
        Chore::Screenshots(scenarios) => browser::screenshots(&scenarios),
        Chore::Measure(arguments) => browser::measure(&arguments),
        Chore::Packages => steps::all(&[
            page::make,
            command::build,
            wheel::install,
            packages::used,
            wheel::package_checked,
        ]),
        Chore::Page => page::make(),
        Chore::Web => web::make(),
        Chore::Site => site::make(),
        Chore::Docs => test::docs(),
        Chore::Help => {
            println!("{USAGE}");
            Ok(())
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("\nFAILED: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn parse(arguments: &[String]) -> Result<Chore> {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["test", ref options @ ..] => {
            let (only, in_browser) = chosen(options)?;
            Ok(Chore::Test(only.map(test::Part::named).transpose()?, in_browser))
        }
        ["check", ref options @ ..] => {
            let (only, in_browser) = chosen(options)?;
            Ok(Chore::Check(only.map(check::Part::named).transpose()?, in_browser))
        }
        ["bench", ..] => Ok(Chore::Bench(arguments[1..].to_vec())),
        ["ledger"] => Ok(Chore::Ledger),
        ["ledger", "--check"] => Ok(Chore::LedgerCheck),
        ["screenshots", ..] => Ok(Chore::Screenshots(arguments[1..].to_vec())),
        ["measure", ..] => Ok(Chore::Measure(arguments[1..].to_vec())),
        ["packages"] => Ok(Chore::Packages),
        ["page"] => Ok(Chore::Page),
        ["web"] => Ok(Chore::Web),
        ["site"] => Ok(Chore::Site),
        ["docs"] => Ok(Chore::Docs),
        [] | ["help" | "--help" | "-h"] => Ok(Chore::Help),
        _ => bail!("unknown arguments: {}", words.join(" ")),
    }
}

/// The part that options of `test` and `check` name, and what they say of the browser.
fn chosen<'a>(options: &[&'a str]) -> Result<(Option<&'a str>, BrowserTests)> {
    match *options {
        [] => Ok((None, BrowserTests::Run)),
        ["--without-browser"] => Ok((None, BrowserTests::LeftOut)),
        ["--only", part] => Ok((Some(part), BrowserTests::Run)),
        ["--only", part, "--without-browser"] => Ok((Some(part), BrowserTests::LeftOut)),
        _ => bail!("unknown options: {}", options.join(" ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Option<Chore> {
        parse(&line.split_whitespace().map(str::to_owned).collect::<Vec<_>>()).ok()
    }

    #[test]
    fn parses_every_chore() {
        assert_eq!(parsed("test"), Some(Chore::Test(None, BrowserTests::Run)));
        assert_eq!(
            parsed("test --only python"),
            Some(Chore::Test(Some(test::Part::Python), BrowserTests::Run))
        );
        assert_eq!(
            parsed("test --without-browser"),
            Some(Chore::Test(None, BrowserTests::LeftOut))
        );
        assert_eq!(
            parsed("test --only browser --without-browser"),
            Some(Chore::Test(Some(test::Part::Browser), BrowserTests::LeftOut))
        );
        assert_eq!(parsed("check"), Some(Chore::Check(None, BrowserTests::Run)));
        assert_eq!(
            parsed("check --only site --without-browser"),
            Some(Chore::Check(Some(check::Part::Site), BrowserTests::LeftOut))
        );
        assert_eq!(parsed("packages"), Some(Chore::Packages));
        assert_eq!(parsed("bench ik_warm"), Some(Chore::Bench(vec!["ik_warm".to_owned()])));
        assert_eq!(
            parsed("screenshots rack"),
            Some(Chore::Screenshots(vec!["rack".to_owned()]))
        );
        assert_eq!(parsed("page"), Some(Chore::Page));
        assert_eq!(parsed("web"), Some(Chore::Web));
        assert_eq!(parsed("docs"), Some(Chore::Docs));
        assert_eq!(parsed(""), Some(Chore::Help));
    }

    #[test]
    fn rejects_nonsense() {
        for line in [
            "tset",
            "test --only",
            "test --only ruby",
            "test --only lint",
            "check --only rust",
            "ledger now",
            "test --without-browser --only",
            "test now",
            "rings",
            "web now",
        ] {
            assert_eq!(parsed(line), None, "{line}");
        }
    }
}
