//! The first line: what is proved of a plan, with the numbers reached and required. `verify`, `run`, the page, Python and the heads of
//! robot programs show it. No name out of a file stands in it unquoted.

use crate::amounts::{kept, number};
use crate::certificate::{Certificate, Verdict};
use crate::check::{Check, Measure, Sense, Status};
use crate::requirement::Requirement;
use crate::usual;
use platewash_kinematics::words::told_apart;
use platewash_workcell::plan::Plan;
use platewash_workcell::words::counted;

/// Requirements that are not kept and told with their numbers.
const MOST_NUMBERS: usize = 3;

/// What the first line of a dry run ends with until both plans are compared.
const NOT_COMPARED: &str = "; not checked: whether it follows the plan that it names";

/// The first line of a plan of which nothing was proved yet.
#[must_use]
pub fn planned_headline(plan: &Plan) -> String {
    let [plates, duration_s] = [counted(plan.order.len(), "plate"), seconds(plan.duration_s())];
    format!("PLANNED, NOT PROVED: {plates} in {duration_s}, from home to home")
}

/// The first line of a run of the paper's program, which has no certificate.
#[must_use]
pub fn paper_headline(plan: &Plan) -> String {
    format!(
        "NOT PROVED: a run of the paper's program, {}; it has no certificate",
        seconds(plan.duration_s())
    )
}

/// The first line: proved or not, how much of each plate, at which clearance, what is waived and what is laxer than usual.
pub(crate) fn headline(certificate: &Certificate) -> String {
    let plates = counted(certificate.rests_on.plates.len(), "plate");
    let subject = format!("{plates} in {}", seconds(certificate.duration_s));
    let judged = match certificate.verdict {
        Verdict::Pass => format!("PROVED{}: {subject}{}", certificate.but_for(), reached(certificate)),
        Verdict::Fail => format!(
            "NOT PROVED: {subject}; {}{}",
            broken(certificate),
            certificate.and_waived()
        ),
    };
    let judged = format!("{judged}{}{}", laxer(certificate), certificate.rests_on.without_floor());
    match &certificate.rests_on.dry_run {
        // Before everything else: nobody shall take it for a washing.
        Some(dry_run) => {
            let compared = if certificate.parent_compared { "" } else { NOT_COMPARED };
            format!("{}; {judged}{compared}", dry_run.words())
        }
        None => judged,
    }
}

/// A duration as all reports state it.
fn seconds(duration_s: f64) -> String {
    format!("{duration_s:.2} s")
}

/// How much of each plate is pressed, or swept where contact is not required, and the clearance.
fn reached(certificate: &Certificate) -> String {
    let wanted = &certificate.rests_on.requirements;
    let in_air = certificate.rests_on.dry_run.is_some();
    let (verb, requirement) = match wanted.contact {
        _ if in_air => ("swept in the air over", Requirement::Swept),
        Some(_) => ("pressed over", Requirement::Pressed),
        None => ("swept over", Requirement::Swept),
    };
    let number = |requirement| at_least(certificate.check(requirement)?.measure.as_ref()?);
    let share = number(requirement).map(|share| format!(", each {verb} {share}"));
    let clearance = number(Requirement::Clearance).map(|least| format!(", clearance {least}"));
    let contact = if wanted.contact.is_some() || in_air {
        ""
    } else {
        ", contact not required"
    };
    [share, clearance].into_iter().flatten().collect::<String>() + contact
}

/// A lower bound beside what is required: "at least 99.8 % (99.5 % required)".
fn at_least(measure: &Measure) -> Option<String> {
    let (scale, unit) = measure.unit.scale();
    let reached = kept(measure, measure.bound?, 1);
    let at_least = if reached == "100" { "" } else { "at least " };
    Some(format!(
        "{at_least}{reached} {unit} ({} {unit} required)",
        number(measure.limit * scale)
    ))
}

fn laxer(certificate: &Certificate) -> String {
    let laxer = usual::laxer(&certificate.rests_on.requirements);
    if laxer.is_empty() {
        laxer.concat()
    } else {
        format!("; requires less than usual: {}", laxer.join(", "))
    }
}

/// What is violated, what is not proved, the first of them with their numbers; the hash where it is all that is wrong.
fn broken(certificate: &Certificate) -> String {
    let broken: Vec<_> = certificate.broken().collect();
    let (told, others) = broken.split_at(broken.len().min(MOST_NUMBERS));
    let of = |status, words| {
        let each: Vec<_> = told
            .iter()
            .filter(|check| check.status == status)
            .map(|check| shortfall(check))
            .collect();
        (!each.is_empty()).then(|| format!("{words}: {}", each.join(", ")))
    };
    let others: Vec<_> = others.iter().map(|check| check.requirement.words()).collect();
    let hash = (certificate.hash.status != Status::Proved)
        .then(|| "the plan was changed after it was written: its hash does not match the contents".to_owned());
    let parts = [
        of(Status::Violated, "violated"),
        of(Status::NotProved, "not proved"),
        (!others.is_empty()).then(|| format!("also not kept: {}", others.join(", "))),
        hash,
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
}

/// A requirement that is not kept, with what was found or what could be shown, and what is required.
fn shortfall(check: &Check) -> String {
    let name = check.requirement.words();
    let Some(measure) = &check.measure else { return name };
    let (scale, unit) = measure.unit.scale();
    let value = if check.status == Status::Violated {
        measure.seen
    } else {
        measure.bound
    };
    let side = match measure.sense {
        Sense::AtLeast => "at least",
        Sense::AtMost => "at most",
        Sense::Above => "above",
    };
    match value {
        Some(value) => {
            let [value, limit] = told_apart(value * scale, measure.limit * scale, 1);
            format!("{name} {value} {unit} ({side} {limit} {unit} required)")
        }
        None => format!("{name} ({side} {} {unit} required)", number(measure.limit * scale)),
    }
}

impl Certificate {
    /// Whoever has compared the parent plan of a dry run says so.
    pub fn set_parent_compared(&mut self) {
        self.parent_compared = true;
        self.headline = headline(self);
    }

    /// What a verdict that passes must not be read without: the requirements that the job waives, and the first case of each. Empty
    /// where nothing is waived.
    #[must_use]
    pub fn but_for(&self) -> String {
        but_for(self).map_or_else(String::new, |but_for| format!(" {but_for}"))
    }

    /// The same at the end of a verdict that fails, where "but for" would read as if the rest were kept.
    fn and_waived(&self) -> String {
        waived(self).map_or_else(String::new, |waived| format!("; waived by the job: {waived}"))
    }

    /// What there is to say of the verdict in a table: what is not kept, by name, else what is waived.
    #[must_use]
    pub fn reason(&self) -> Option<String> {
        let broken: Vec<_> = self.broken().map(|check| check.requirement.words()).collect();
        match (self.verdict, broken.is_empty()) {
            (Verdict::Pass, _) => but_for(self),
            (Verdict::Fail, true) => Some("the hash".to_owned()),
            (Verdict::Fail, false) => Some(broken.join(", ")),
        }
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
