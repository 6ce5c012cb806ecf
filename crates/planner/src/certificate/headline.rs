//! The certificate's verdict in one line.

use super::{Certificate, CertificateVerdict, Promise, Status};
use platewash_workcell::words::counted;

/// The first line: certified or not, for which scenario, what is not kept, and what is waived.
pub(super) fn headline(certificate: &Certificate) -> String {
    let (scenario, duration_s) = (certificate.scenario.escape_debug(), certificate.duration_s);
    match not_kept(certificate) {
        None => format!("CERTIFIED{}: {scenario}, {duration_s:.3} s", but_for(certificate)),
        Some(broken) => format!(
            "NOT CERTIFIED: {scenario}, {duration_s:.3} s; not kept: {broken}{}",
            and_waived(certificate)
        ),
    }
}

/// What a verdict that passes must not be read without: the promises that are waived, by whom, and the first case of each.
#[must_use]
pub(crate) fn but_for(certificate: &Certificate) -> String {
    waived(certificate).map_or_else(String::new, |waived| {
        format!(" BUT FOR {waived} (waived by layout.overlap = \"report\")")
    })
}

/// The same at the end of a verdict that fails, where "but for" would read as if the rest were kept.
#[must_use]
pub(crate) fn and_waived(certificate: &Certificate) -> String {
    waived(certificate).map_or_else(String::new, |waived| {
        format!("; waived by layout.overlap = \"report\": {waived}")
    })
}

fn waived(certificate: &Certificate) -> Option<String> {
    let exempt = certificate.promises.iter().filter(|p| p.status == Status::Exempt);
    let each: Vec<_> = exempt.map(cases).collect();
    (!each.is_empty()).then(|| each.join("; "))
}

/// A promise with the first case against it, and how many more there are.
fn cases(promise: &Promise) -> String {
    let name = promise.name.words();
    let Some((first, others)) = promise.discrepancies.split_first() else {
        return name.to_owned();
    };
    let first = format!("{name}, {} {}", first.what, first.stated);
    match others.len() + promise.more_discrepancies {
        0 => first,
        more => format!("{first} and {}", counted(more, "more case")),
    }
}

/// What is not kept, by name; the hash where it is all that is wrong.
#[must_use]
pub(crate) fn not_kept(certificate: &Certificate) -> Option<String> {
    let broken: Vec<_> = certificate.broken().map(|promise| promise.name.words()).collect();
    match (certificate.verdict, broken.is_empty()) {
        (CertificateVerdict::Pass, _) => None,
        (CertificateVerdict::Fail, true) => Some("the hash".to_owned()),
        (CertificateVerdict::Fail, false) => Some(broken.join(", ")),
    }
}
