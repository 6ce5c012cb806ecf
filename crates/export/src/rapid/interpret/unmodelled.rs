//! Instructions that are not modelled, and why.

use crate::rapid::syntax::ast::Name;

const MOVES: &str = "it needs inverse kinematics or moves on its own; only MoveAbsJ with \\T is judged";
const TIMES: &str = "it changes how long motions take";
const FRAMES: &str = "it changes what motions mean: their frames, loads or axes";
const WAITS: &str = "it waits for somebody or something, for an unknown time";
const OUTPUTS: &str = "it sets a signal, and what that does is not judged";
const INTERRUPTS: &str = "it lets a trap run at any time";

/// Names in small letters, each group with its reason.
const REASONS: [(&[&str], &str); 6] = [
    (
        &[
            "movej",
            "movel",
            "movec",
            "moveextj",
            "movejdo",
            "moveldo",
            "movecdo",
            "movejsync",
            "movelsync",
            "movecsync",
            "movejao",
            "movelao",
            "movecao",
            "movejgo",
            "movelgo",
            "movecgo",
            "movepnp",
            "triggj",
            "triggl",
            "triggc",
            "triggabsj",
            "triggjios",
            "trigglios",
            "searchl",
            "searchc",
            "searchextj",
            "egmrunjoint",
            "egmrunpose",
            "indamove",
            "indrmove",
            "indcmove",
            "stepbwdpath",
            "restopath",
            "startmove",
            "stopmove",
            "corrcon",
            "corrwrite",
        ],
        MOVES,
    ),
    (
        &[
            "speedrefresh",
            "speedlimaxis",
            "speedlimcheckpoint",
            "pathacclim",
            "pathresol",
            "worldacclim",
            "cirpathmode",
            "motionsup",
            "motionprocessmodeset",
            "softact",
            "softdeact",
            "tuneservo",
            "tunereset",
            "mechunitload",
        ],
        TIMES,
    ),
    (
        &[
            "actunit",
            "deactunit",
            "eoffson",
            "eoffsoff",
            "eoffsset",
            "pdispon",
            "pdispoff",
            "pdispset",
            "gripload",
            "syncmoveon",
            "syncmoveoff",
            "syncmoveundo",
            "waitsynctask",
            "dropwobj",
        ],
        FRAMES,
    ),
    (
        &[
            "stop",
            "break",
            "systemstopaction",
            "waituntil",
            "waitdi",
            "waitdo",
            "waitgi",
            "waitgo",
            "waitai",
            "waitao",
            "waitrob",
            "waitload",
            "tpreadfk",
            "tpreadnum",
            "tpreaddnum",
            "uimsgbox",
            "uishow",
        ],
        WAITS,
    ),
    (
        &["set", "reset", "setdo", "setgo", "setao", "pulsedo", "invertdo"],
        OUTPUTS,
    ),
    (
        &[
            "isignaldi",
            "isignaldo",
            "itimer",
            "ipers",
            "ierror",
            "ienable",
            "idisable",
            "iwatch",
            "isleep",
        ],
        INTERRUPTS,
    ),
];

/// Why an instruction is refused.
#[must_use]
pub fn why_not(name: &Name) -> String {
    let text = &name.text;
    match REASONS.iter().find(|(names, _)| names.contains(&&*name.key)) {
        Some((_, why)) => format!("{text} is not modelled: {why}"),
        None => format!("{text} is no procedure of the program, and no instruction that is modelled"),
    }
}

/// Whether a name, in small letters, is that of an instruction that is refused with a reason.
#[must_use]
pub fn is_unmodelled(key: &str) -> bool {
    REASONS.iter().any(|(names, _)| names.contains(&key))
}
