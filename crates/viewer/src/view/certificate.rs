//! What is proved, in the words of the certificate.

use platewash_certificate::{self as proved, Status, Worst};
use platewash_workcell::job::ContactRequirements;
use platewash_workcell::words::printable;
use serde::Serialize;

/// The proof.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Certificate {
    /// Whether every requirement is kept, and the hash is that of the contents.
    pub passes: bool,
    /// Its first line.
    pub headline: String,
    /// Of the hash in the file.
    pub hash: Status,
    /// The requirements, in the certificate's order.
    pub checks: Vec<Check>,
    /// What is proved of the contact with each plate; `None` where none is asked for.
    pub contact: Option<Contact>,
    /// What the verdict rests on, a line each.
    pub rests_on: Vec<String>,
}

/// What is asked of the contact with plates, and what is proved of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Contact {
    /// What is asked.
    pub asked: ContactRequirements,
    /// In the order of washing.
    pub plates: Vec<PlateContact>,
}

/// What is proved of the contact with a plate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlateContact {
    /// Index of the plate.
    pub plate: usize,
    /// Least share that is pressed.
    pub pressed: f64,
    /// Least share that is in contact long enough.
    pub time_share: f64,
    /// Least share that gets enough of a dose.
    pub dose_share: f64,
    /// Greatest strain; `None` where nothing is proved.
    pub strain: Option<f64>,
    /// Least and greatest force \[N\].
    pub force_n: [Option<f64>; 2],
    /// Greatest torque of friction with least and greatest friction, which are assumptions \[N·m\].
    pub friction_torque_n_m: Option<[f64; 2]>,
}

/// A requirement and what came of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// Its name in the certificate's file.
    pub requirement: proved::Requirement,
    /// In words.
    pub words: String,
    /// What came of it.
    pub status: Status,
    /// Bound, limit, what was found, and what does not agree; empty where there is nothing to add.
    pub detail: String,
    /// Where it is worst.
    pub worst: Option<Place>,
}

/// A place in time and space.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// When \[s\].
    pub time_s: Option<f64>,
    /// World frame \[m\].
    pub place_m: Option<[f64; 3]>,
    /// Pair, joint, segment and plate in words.
    pub words: String,
}

impl Certificate {
    /// As it is shown.
    #[must_use]
    pub fn new(certificate: &proved::Certificate) -> Self {
        let check = |check: &proved::Check| Check {
            requirement: check.requirement,
            words: check.requirement.words(),
            status: check.status,
            detail: check.detail(),
            worst: place(&check.worst),
        };
        let line = |(name, what): (&str, String)| format!("{name}: {what}");
        Self {
            passes: certificate.passes(),
            headline: printable(&certificate.headline),
            hash: certificate.hash.status,
            checks: certificate.checks.iter().map(check).collect(),
            contact: certificate.rests_on.requirements.contact.map(|asked| Contact {
                asked,
                plates: certificate.contact.iter().map(PlateContact::from).collect(),
            }),
            rests_on: certificate.rests_on.lines().into_iter().map(line).collect(),
        }
    }
}

impl From<&proved::PlateContact> for PlateContact {
    fn from(contact: &proved::PlateContact) -> Self {
        Self {
            plate: contact.plate,
            pressed: contact.pressed.at_least,
            time_share: contact.time.at_least,
            dose_share: contact.dose.at_least,
            strain: contact.strain.bound,
            force_n: [contact.least_force_n.bound, contact.greatest_force_n.bound],
            friction_torque_n_m: contact.friction_torque_nm,
        }
    }
}

/// A worst place; `None` where nothing is said.
fn place(worst: &Worst) -> Option<Place> {
    let in_words = Worst {
        time_s: None,
        place_m: None,
        ..worst.clone()
    };
    (*worst != Worst::default()).then(|| Place {
        time_s: worst.time_s,
        place_m: worst.place_m,
        words: in_words.to_string(),
    })
}
