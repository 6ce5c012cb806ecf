//! The certificate's verdict in one line.

use crate::certificate::{Certificate, Verdict};
use crate::check::{Check, Status};
use platewash_workcell::words::counted;

/// The first line: certified or not, for which scenario, what is not kept, and what is waived.
pub(crate) fn headline(certificate: &Certificate) -> String {
    let (scenario, duration_s) = (certificate.scenario.escape_debug(), certificate.duration_s);
    let judged = match certificate.not_kept() {
        None => format!("CERTIFIED{}: {scenario}, {duration_s:.3} s", certificate.but_for()),
        Some(broken) => format!(
            "NOT CERTIFIED: {scenario}, {duration_s:.3} s; not kept: {broken}{}",
            certificate.and_waived()
        ),
    };
    let judged = judged + certificate.rests_on.without_floor();
    match &certificate.rests_on.dry_run {
        // Before everything else: nobody shall take it for a washing.
        Some(dry_run) => format!("{}; {judged}{NOT_COMPARED}", dry_run.words()),
        None => judged,
    }
}

/// What the first line of a dry run ends with.
const NOT_COMPARED: &str = "; as stated: the parent plan was not compared";

impl Certificate {
    /// Takes back that the parent plan was not compared, for whoever has compared it.
    pub fn parent_compared(&mut self) {
        if let Some(before) = self.headline.strip_suffix(NOT_COMPARED) {
            self.headline = before.to_owned();
        }
    }

    /// What a verdict that passes must not be read without: the requirements that the job waives, and the first case of each. Empty
    /// where nothing is waived.
    #[must_use]
    pub fn but_for(&self) -> String {
        but_for(self).map_or_else(String::new, |but_for| format!(" {but_for}"))
    }

    /// The same at the end of a verdict that fails, where "but for" would read as if the rest were kept.
    #[must_use]
    pub fn and_waived(&self) -> String {
        waived(self).map_or_else(String::new, |waived| format!("; waived by the job: {waived}"))
    }

    /// What is not kept, by name; the hash where it is all that is wrong. `None` where everything is kept.
    #[must_use]
    pub fn not_kept(&self) -> Option<String> {
        let broken: Vec<_> = self.broken().map(|check| check.requirement.words()).collect();
        match (self.verdict, broken.is_empty()) {
            (Verdict::Pass, _) => None,
            (Verdict::Fail, true) => Some("the hash".to_owned()),
            (Verdict::Fail, false) => Some(broken.join(", ")),
        }
    }

    /// What there is to say of the verdict in a table: what is not kept, else what is waived.
    #[must_use]
    pub fn reason(&self) -> Option<String> {
        self.not_kept().or_else(|| but_for(self))
    }
}

fn but_for(certificate: &Certificate) -> Option<String> {
    waived(certificate).map(|waived| format!("BUT FOR {waived} (waived by the job)"))
}

fn waived(certificate: &Certificate) -> Option<String> {
    let waived = certificate.checks.iter().filter(|check| check.status == Status::Waived);
    let each: Vec<_> = waived.map(cases).collect();
    (!each.is_empty()).then(|| each.join("; "))
}

/// A requirement with the first case against it, and how many more there are.
fn cases(check: &Check) -> String {
    let name = check.requirement.words();
    let Some((first, others)) = check.discrepancies.split_first() else {
        return name;
    };
    let first = format!("{name}, {} {}", first.what, first.stated);
    match others.len() + check.more_discrepancies {
        0 => first,
        more => format!("{first} and {}", counted(more, "more case")),
    }
}
