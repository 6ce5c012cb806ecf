//! How much work a question may be: the page is answered while somebody waits, beside other pages, in bounded memory.

use platewash_scenario::Scenario;
use platewash_workcell::words::counted;
use std::time::Duration;

/// Longest question \[bytes\]: a scenario of the largest size, with all its characters escaped.
pub const MOST_QUESTION_BYTES: usize = 2 << 20;

/// Contact points of all wash paths together, at most. Memory and time of a plan and its proof grow with them.
pub const MOST_CONTACT_POINTS: usize = 60_000;

/// Changes of one question, at most.
pub const MOST_EDITS: usize = 1000;

/// How long a question may take to its proof.
pub const LONGEST: Duration = Duration::from_secs(60);

/// How long a map may take.
pub const LONGEST_MAP: Duration = Duration::from_secs(120);

/// Why a scenario is too much work for a page that waits; `None` where it is not.
pub fn too_much(scenario: &Scenario) -> Option<String> {
    let points = scenario.contact_points();
    (points > MOST_CONTACT_POINTS).then(|| {
        format!(
            "layout.count or positions_m, wash.turns, wash.path_radius_m: {} have {points} contact points in all; up to \
             {MOST_CONTACT_POINTS} are planned while you wait (`platewash run` plans more)",
            counted(scenario.plates(), "plate")
        )
    })
}
