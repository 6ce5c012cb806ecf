//! The certificate's verdict in one line.

use super::{Certificate, CertificateVerdict, Promise, Status};

/// The first line: certified or not, what is waived, for which scenario, and what is not kept.
pub(super) fn headline(certificate: &Certificate) -> String {
    let verdict = match certificate.verdict {
        CertificateVerdict::Pass => "CERTIFIED",
        CertificateVerdict::Fail => "NOT CERTIFIED",
    };
    let (scenario, duration_s) = (certificate.scenario.escape_debug(), certificate.duration_s);
    let waived = but_for(certificate);
    let broken = not_kept(certificate).map_or_else(String::new, |broken| format!("; not kept: {broken}"));
    format!("{verdict}{waived}: {scenario}, {duration_s:.3} s{broken}")
}

/// What a verdict must not be read without: the promises that are waived, by whom, and the first case of each.
#[must_use]
pub(crate) fn but_for(certificate: &Certificate) -> String {
    let exempt = certificate.promises.iter().filter(|p| p.status == Status::Exempt);
    let each: Vec<_> = exempt.map(waived).collect();
    if each.is_empty() {
        return String::new();
    }
    format!(" BUT FOR {} (waived by layout.overlap = \"report\")", each.join("; "))
}

fn waived(promise: &Promise) -> String {
    let name = promise.name.words();
    match &promise.discrepancies[..] {
        [] => name.to_owned(),
        [first] => format!("{name}, {} {}", first.what, first.stated),
        [first, others @ ..] => {
            let cases = if others.len() == 1 { "case" } else { "cases" };
            format!(
                "{name}, {} {} and {} more {cases}",
                first.what,
                first.stated,
                others.len()
            )
        }
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
