//! Options that a verb does not take: its help does not show them, and where one is given the command is refused.

use super::failure::Failure;
use anyhow::anyhow;
use clap::parser::ValueSource;
use clap::{ArgMatches, Command};

/// Options that some verbs do not take.
struct Refused {
    verbs: &'static [&'static str],
    options: &'static [&'static str],
    why: &'static str,
}

/// Of verbs of plan files.
pub const PLAN_STATES: &str =
    "the plan file states its job and its seed; leave it out (verify --against compares them with a scenario)";

const REFUSED: [Refused; 7] = [
    Refused {
        verbs: &[
            "verify", "simulate", "tune", "view", "figures", "export", "dry-run", "compare",
        ],
        options: &["scenario", "tool_mount"],
        why: PLAN_STATES,
    },
    Refused {
        verbs: &["simulate", "tune", "view", "figures", "export", "dry-run", "compare"],
        options: &["seed"],
        why: PLAN_STATES,
    },
    Refused {
        verbs: &["align"],
        options: &["scenario", "seed", "urdf", "package_path", "srdf", "tool_mount", "out"],
        why: "align works from the points of its file alone, without a scenario or a seed, and writes no file; leave it out",
    },
    Refused {
        verbs: &["study"],
        options: &["scenario", "seed", "urdf", "package_path", "srdf", "tool_mount"],
        why: "the study file states its scenarios and seeds; leave it out",
    },
    Refused {
        verbs: &["sweep"],
        options: &["seed"],
        why: "sweep plans one layout for each of --seeds; leave it out",
    },
    Refused {
        verbs: &["scenario"],
        options: &["scenario", "seed", "urdf", "package_path", "srdf", "tool_mount", "out"],
        why: "scenario prints a shipped scenario as it is, `platewash scenario NAME`; leave it out",
    },
    Refused {
        verbs: &["reproduce"],
        options: &["scenario", "urdf", "package_path", "srdf", "tool_mount"],
        why: "reproduce measures the paper's own scenarios and arm; leave it out",
    },
];

/// The command with the options that a verb does not take left out of its help.
pub fn hide(command: Command) -> Command {
    let all: Vec<_> = command.get_arguments().cloned().collect();
    REFUSED.iter().fold(command, |command, refused| {
        refused.verbs.iter().fold(command, |command, verb| {
            command.mut_subcommand(verb, |mut sub| {
                for argument in all
                    .iter()
                    .filter(|argument| refused.options.contains(&argument.get_id().as_str()))
                {
                    sub = sub.arg(argument.clone().hide(true));
                }
                sub
            })
        })
    })
}

/// Refuses an option that the verb does not take.
pub fn refuse(matches: &ArgMatches) -> Result<(), Failure> {
    let Some((verb, given)) = matches.subcommand() else {
        return Ok(());
    };
    let of_verb = REFUSED.iter().filter(|refused| refused.verbs.contains(&verb));
    for Refused { options, why, .. } in of_verb {
        let is_given = |id: &&&str| given.value_source(id) == Some(ValueSource::CommandLine);
        if let Some(id) = options.iter().find(is_given) {
            return Err(Failure::input(anyhow!("--{}: {why}", id.replace('_', "-"))));
        }
    }
    Ok(())
}
