//! The proof, in the words of the certificate.

use platewash_certificate::{self as proved, Explanation, Status, VerdictBasis, WorstCase};
use platewash_workcell::job::ContactRequirements;
use platewash_workcell::words::printable;
use serde::Serialize;
use ts_rs::TS;

/// The proof.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Certificate {
    /// True where every requirement is kept, and the hash is that of the contents.
    pub passes: bool,
    /// Its first line.
    pub headline: String,
    /// State of the hash in the file.
    pub hash: Status,
    /// The requirements, in the certificate's order.
    pub checks: Vec<Check>,
    /// Proof of the contact with each plate; `None` where the job requires no contact.
    pub contact: Option<Contact>,
    /// Assumptions of the verdict, one line each.
    pub rests_on: Vec<String>,
}

/// Requirements on the contact with plates, and the proof of it.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Contact {
    /// Requirements.
    pub asked: ContactRequirements,
    /// In the order of washing.
    pub plates: Vec<proved::PlateContact>,
}

/// A requirement and its result.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Check {
    /// The certificate's.
    #[serde(flatten)]
    pub check: proved::Check,
    /// The requirement in words.
    pub words: String,
    /// Bound, limit, value found, and discrepancies; empty where there is nothing to add.
    pub detail: String,
    /// Worst place: pair, joint, segment and plate in words; empty where none is known.
    pub place: String,
    /// The requirement in a sentence, its formula, and whose its limit is.
    pub why: Explanation,
}

impl Certificate {
    /// As it is shown.
    #[must_use]
    pub fn new(certificate: &proved::Certificate) -> Self {
        let line = |(name, what): (&str, String)| format!("{name}: {what}");
        Self {
            passes: certificate.passes(),
            headline: printable(&certificate.headline),
            hash: certificate.hash.status,
            checks: (certificate.checks.iter())
                .map(|check| Check::new(check, Some(&certificate.rests_on)))
                .collect(),
            contact: certificate.rests_on.requirements.contact.map(|asked| Contact {
                asked,
                plates: certificate.contact.clone(),
            }),
            rests_on: certificate.rests_on.lines().into_iter().map(line).collect(),
        }
    }
}

impl Check {
    pub(super) fn new(check: &proved::Check, basis: Option<&VerdictBasis>) -> Self {
        Self {
            words: check.requirement.words(),
            detail: check.detail(),
            place: place(&check.worst),
            why: Explanation::new(check, basis),
            check: check.clone(),
        }
    }
}

/// A worst place in words, but for its time and its coordinates.
fn place(worst: &WorstCase) -> String {
    let named = WorstCase {
        time_s: None,
        place_m: None,
        ..worst.clone()
    };
    named.to_string()
}
