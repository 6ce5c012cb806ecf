//! The project's own chores.
//!
//!     cargo xtask test [OPTIONS]                    every test there is
//!         --only lint|rust|python|browser|site      one part of them
//!         --without-browser                         all but what is looked at in a browser
//!     cargo xtask bench [ARGUMENTS]                 the benchmarks at the root; arguments go to criterion
//!     cargo xtask ledger                            counts instructions and writes them to docs/benchmarks.md; needs valgrind
//!     cargo xtask page                              makes what all pages in 3-D share, crates/viewer/dist, where it is missing or old
//!     cargo xtask web                               makes the playground, the live cell for a static host, in target/playground
//!     cargo xtask site                              makes the website of the documentation, in target/site
//!     cargo xtask screenshots [SCENARIO ...]        pictures of the page in target/screenshots, to look at; edit: a live cell
//!     cargo xtask measure [DRAGS]                   times of the page in a browser: first frame, drop of a plate to its drawn proof
//!     cargo xtask docs                              writes the pages that are made from the program

mod benches;
mod browser;
#[cfg(test)]
mod comments;
mod ledger;
mod packages;
mod page;
mod python;
mod site;
mod sources;
mod suite;
mod web;
mod wheel;

use anyhow::{Result, bail};
use std::process::ExitCode;
use suite::{BrowserTests, Part};

const USAGE: &str = "\
cargo xtask test [OPTIONS]                    every test there is
    --only lint|rust|python|browser|site      one part of them
    --without-browser                         all but what is looked at in a browser
cargo xtask bench [ARGUMENTS]                 the benchmarks at the root; arguments go to criterion
cargo xtask ledger                            counts instructions and writes them to docs/benchmarks.md; needs valgrind
cargo xtask screenshots [SCENARIO ...]        pictures of the page in target/screenshots, to look at; edit: a live cell
cargo xtask page                              makes what all pages in 3-D share, crates/viewer/dist, where it is missing or old
cargo xtask web                               makes the playground, the live cell for a static host, in target/playground
cargo xtask site                              makes the website of the documentation, in target/site
cargo xtask measure [DRAGS]                   times of the page in a browser: first frame, drop of a plate to its drawn proof
cargo xtask docs                              writes the pages that are made from the program";

/// What to do.
#[derive(Debug, PartialEq, Eq)]
enum Chore {
    Test(Option<Part>, BrowserTests),
    Bench(Vec<String>),
    Ledger,
    Screenshots(Vec<String>),
    Measure(Vec<String>),
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
        Chore::Test(only, in_browser) => suite::run(only, in_browser),
        Chore::Bench(arguments) => benches::run(&arguments),
        Chore::Ledger => ledger::run(),
        Chore::Screenshots(scenarios) => browser::screenshots(&scenarios),
        Chore::Measure(arguments) => browser::measure(&arguments),
        Chore::Page => page::make(),
        Chore::Web => web::make(),
        Chore::Site => site::make(),
        Chore::Docs => suite::docs(),
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
        ["test", ref options @ ..] => tests(options),
        ["bench", ..] => Ok(Chore::Bench(arguments[1..].to_vec())),
        ["ledger"] => Ok(Chore::Ledger),
        ["screenshots", ..] => Ok(Chore::Screenshots(arguments[1..].to_vec())),
        ["measure", ..] => Ok(Chore::Measure(arguments[1..].to_vec())),
        ["page"] => Ok(Chore::Page),
        ["web"] => Ok(Chore::Web),
        ["site"] => Ok(Chore::Site),
        ["docs"] => Ok(Chore::Docs),
        [] | ["help" | "--help" | "-h"] => Ok(Chore::Help),
        _ => bail!("unknown arguments: {}", words.join(" ")),
    }
}

fn tests(options: &[&str]) -> Result<Chore> {
    match *options {
        [] => Ok(Chore::Test(None, BrowserTests::Run)),
        ["--without-browser"] => Ok(Chore::Test(None, BrowserTests::LeftOut)),
        ["--only", part] => Ok(Chore::Test(Some(Part::named(part)?), BrowserTests::Run)),
        ["--only", part, "--without-browser"] => Ok(Chore::Test(Some(Part::named(part)?), BrowserTests::LeftOut)),
        _ => bail!("unknown options of test: {}", options.join(" ")),
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
            Some(Chore::Test(Some(Part::Python), BrowserTests::Run))
        );
        assert_eq!(
            parsed("test --without-browser"),
            Some(Chore::Test(None, BrowserTests::LeftOut))
        );
        assert_eq!(
            parsed("test --only browser --without-browser"),
            Some(Chore::Test(Some(Part::Browser), BrowserTests::LeftOut))
        );
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
            "test --without-browser --only",
            "test now",
            "rings",
            "web now",
        ] {
            assert_eq!(parsed(line), None, "{line}");
        }
    }
}
