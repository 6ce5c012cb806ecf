//! The first line of a report: the verdict on a plan, with the numbers reached and required. `verify`, `run`, the page, Python and the
//! heads of robot programs show it. Names from files are always quoted.
//!
//! The file also holds the usual requirements of a washing. A job that requires less is named in the first line.

use crate::report::certificate::{Certificate, Verdict};
use crate::report::check::{Check, Measure, Sense, Status};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::report::words::{number, rounded_bound};
use crate::washing::plate_contact::PlateContact;
use platewash_kinematics::words::distinct_decimals;
use platewash_motion::plan::Plan;
use platewash_workcell::dry_run;
use platewash_workcell::job::{
    CONTACT_SPEED_M_S, ContactRequirements, Limits, PlanKind, RETREAT_M_S, Requirements, WRIST_DEG,
};
use platewash_workcell::words::{count_with_noun, pair_text, plate_name};

/// Number of broken requirements that are shown with their numbers.
const MOST_NUMBERS: usize = 3;

/// End of the first line of a dry run until both plans are compared.
const NOT_COMPARED: &str = "; not checked: whether it follows the plan that it names";

/// End of the first line of a recovery until both plans are compared.
const NOT_FROM_STOP: &str = "; not checked: whether the plan that it names was stopped so";

/// Returns the first line of a plan that is not proved yet.
#[must_use]
pub fn planned_headline(plan: &Plan) -> String {
    let [plates, duration_s] = [count_with_noun(plan.order.len(), "plate"), seconds(plan.duration_s())];
    format!("PLANNED, NOT PROVED: {plates} in {duration_s}, from home to home")
}

/// Returns the first line of a run of the paper's program, which has no certificate.
#[must_use]
pub fn paper_headline(plan: &Plan) -> String {
    format!(
        "NOT PROVED: a run of the paper's program, {}; it has no certificate",
        seconds(plan.duration_s())
    )
}

/// Returns the first line: verdict, share of each plate, clearance, waived requirements and laxer ones.
pub(crate) fn headline(certificate: &Certificate) -> String {
    let basis = &certificate.rests_on;
    let left_out = basis.recovery.as_ref().map_or(0, |recovery| recovery.left_out.len());
    let duration = seconds(certificate.duration_s);
    let judged = match basis.plates.len() - left_out.min(basis.plates.len()) {
        0 => format!("home in {duration}"),
        plates => format!("{} in {duration}", count_with_noun(plates, "plate")),
    };
    let judged = match certificate.verdict {
        Verdict::Pass => format!(
            "PROVED{}: {judged}{}",
            certificate.but_for(),
            achieved_text(certificate)
        ),
        Verdict::Fail => format!(
            "NOT PROVED: {judged}; {}{}",
            broken(certificate),
            certificate.and_waived()
        ),
    };
    let judged = format!(
        "{judged}{}{}{}",
        laxer_text(certificate),
        basis.without_floor(),
        basis.without_links()
    );
    let judged = match &basis.recovery {
        Some(recovery) if basis.dry_run.is_none() => {
            let compared = if certificate.parent_compared { "" } else { NOT_FROM_STOP };
            format!("{}; {judged}{compared}", recovery.words())
        }
        Some(recovery) => format!("{}; {judged}", recovery.words()),
        None => judged,
    };
    match &certificate.rests_on.dry_run {
        // Before everything else: nobody shall take it for a washing.
        Some(dry_run) => {
            let compared = if certificate.parent_compared { "" } else { NOT_COMPARED };
            format!("{}; {judged}{compared}", dry_run.words())
        }
        None => judged,
    }
}

/// Formats a duration \[s\] as all reports show it.
fn seconds(duration_s: f64) -> String {
    format!("{duration_s:.2} s")
}

/// Returns the share of each plate that is pressed, or swept where contact is not required, and the clearance, in words.
fn achieved_text(certificate: &Certificate) -> String {
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
    let reduced = certificate.clearance.iter().filter_map(|line| {
        let bounds = [line.at_least_m, line.seen_m];
        let measure = Measure::new(Sense::AtLeast, line.required_m?, Unit::Metre, bounds);
        Some(format!(", between {} {}", pair_text(&line.pair), at_least(&measure)?))
    });
    let is_motion_home = certificate.rests_on.kind() == PlanKind::MotionHome;
    let contact = if wanted.contact.is_some() || in_air || is_motion_home {
        ""
    } else {
        ", contact not required"
    };
    [share, clearance]
        .into_iter()
        .flatten()
        .chain(reduced)
        .collect::<String>()
        + contact
}

/// Formats a lower bound with its requirement: "at least 99.8 % (99.5 % required)".
fn at_least(measure: &Measure) -> Option<String> {
    let (scale, unit) = measure.unit.scale();
    let reached = rounded_bound(measure, measure.bound?, 1);
    let at_least = if reached == "100" { "" } else { "at least " };
    Some(format!(
        "{at_least}{reached} {unit} ({} {unit} required)",
        number(measure.limit * scale)
    ))
}

fn laxer_text(certificate: &Certificate) -> String {
    let basis = &certificate.rests_on;
    let laxer = laxer_requirements(basis.kind(), &basis.laxest(), &basis.limits);
    if laxer.is_empty() {
        String::new()
    } else {
        format!("; requires less than usual: {}", laxer.join(", "))
    }
}

/// Returns the violated and the unproved requirements in words, the first ones with numbers; the hash if nothing else is wrong.
fn broken(certificate: &Certificate) -> String {
    let broken: Vec<_> = certificate.broken().collect();
    let (told, others) = broken.split_at(broken.len().min(MOST_NUMBERS));
    let of = |status, words| {
        let each: Vec<_> = told
            .iter()
            .filter(|check| check.status == status)
            .map(|check| shortfall(check) + &ring_fault(certificate, check))
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

/// Returns the way in which a plate may leave its ring, for the check that plates stay; empty for others.
fn ring_fault(certificate: &Certificate, check: &Check) -> String {
    let is_worst = |contact: &&PlateContact| {
        check.requirement == Requirement::PlateStays && Some(contact.plate) == check.worst.plate
    };
    let worst = certificate.contact.iter().find(is_worst);
    let fault = worst.and_then(|contact| contact.holder_load?.ring?.fault().map(|fault| (contact.plate, fault)));
    fault.map_or_else(String::new, |(plate, fault)| {
        format!(": {}, {fault}", plate_name(plate))
    })
}

/// Formats a requirement that is not kept, with the value found or shown and the required one.
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
            let decimals = enough_decimals(measure.limit * scale);
            let [value, limit] = distinct_decimals(value * scale, measure.limit * scale, decimals);
            format!("{name} {value} {unit} ({side} {limit} {unit} required)")
        }
        None => format!("{name} ({side} {} {unit} required)", number(measure.limit * scale)),
    }
}

/// Number of decimals, at least 1, that show a limit to within 2 %.
fn enough_decimals(limit: f64) -> usize {
    const MOST: usize = 9;
    let is_close = |decimals: &usize| {
        let shown: f64 = format!("{limit:.decimals$}").parse().unwrap_or(limit);
        (shown - limit).abs() <= 0.02 * limit.abs()
    };
    (1..MOST).find(is_close).unwrap_or(MOST)
}

impl Certificate {
    /// Records that the parent plan of a dry run was compared, and rewrites the first line.
    pub fn set_parent_compared(&mut self) {
        self.parent_compared = true;
        self.headline = headline(self);
    }

    /// Returns the requirements that are laxer than usual, as the first line ends; empty where none is.
    #[must_use]
    pub fn laxer(&self) -> String {
        laxer_text(self)
    }

    /// Returns the words " but for …" that belong to a passing verdict: the waived requirements with the first case of each. Empty if
    /// nothing is waived.
    #[must_use]
    pub fn but_for(&self) -> String {
        but_for(self).map_or_else(String::new, |but_for| format!(" {but_for}"))
    }

    /// Returns the waived requirements for the end of a failing verdict. "But for" would read there as if the rest were kept.
    fn and_waived(&self) -> String {
        waived(self).map_or_else(String::new, |waived| format!("; waived by the job: {waived}"))
    }

    /// Returns the remark on the verdict for a table: the broken requirements by name, else the waived ones.
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

/// Formats a requirement with the first case against it, and the number of further ones.
fn cases(check: &Check) -> String {
    let name = check.requirement.words();
    let Some((first, others)) = check.discrepancies.split_first() else {
        return name;
    };
    let first = format!("{name}, {} {}", first.what, first.stated);
    match others.len() + check.more_discrepancies {
        0 => first,
        more => format!("{first} and {}", count_with_noun(more, "more case")),
    }
}

/// Share of each plate that must be swept.
const SWEPT: f64 = 0.995;

/// Least clearance \[m\].
const CLEARANCE_M: f64 = 0.01;

/// Greatest speed of the tip \[m/s\], and its greatest acceleration \[m/s²\].
const TIP_SPEED_M_S: f64 = 1.0;
const TIP_ACCELERATION_M_S2: f64 = 8.0;

/// Greatest angle of the tool from the plate's normal \[deg\].
const TILT_DEG: f64 = 30.0;

/// Greatest speed of the tip while it washes \[m/s\].
const WASH_SPEED_M_S: f64 = 0.25;

/// Greatest acceleration of the tip while it washes \[m/s²\].
const WASH_ACCELERATION_M_S2: f64 = 4.0;

/// Words of `wash.landing_speed_m_s` and `wash.lifting_speed_m_s`, the two limits of the contact speed. A row names the key, so that the
/// reader knows which of both to change.
const LANDING_SPEED: &str = "landing speed";
const LIFTING_SPEED: &str = "lifting speed";

/// Usual contact requirements.
const CONTACT: ContactRequirements = ContactRequirements {
    compression_m: 0.001,
    height_error_m: 0.001,
    share: 0.995,
    strain: 0.6,
    force_n: [1.0, 40.0],
    time_s: 0.05,
    time_share: 0.98,
    dose_pa_m: 25.0,
    dose_share: 0.98,
};

/// Requirement with its usual value.
struct Row {
    /// Words of the requirement, or of the key that states the value.
    name: String,
    required: f64,
    usual: f64,
    unit: &'static str,
    /// True if a greater value requires more.
    more_is_stricter: bool,
}

/// Scale and unit that a number is told in.
type Told = (f64, &'static str);

const PERCENT: Told = (100.0, " %");
const MILLIMETRE: Told = (1e3, " mm");
const METRE_PER_SECOND: Told = (1.0, " m/s");
const METRE_PER_SECOND_SQUARED: Told = (1.0, " m/s²");
const NEWTON: Told = (1.0, " N");
const DEGREE: Told = (1.0, "°");

impl Row {
    fn at_least(name: impl Into<String>, required: f64, usual: f64, (scale, unit): Told) -> Self {
        Self {
            name: name.into(),
            required: scale * required,
            usual: scale * usual,
            unit,
            more_is_stricter: true,
        }
    }

    fn at_most(name: impl Into<String>, required: f64, usual: f64, told: Told) -> Self {
        Self {
            more_is_stricter: false,
            ..Self::at_least(name, required, usual, told)
        }
    }

    fn is_laxer(&self) -> bool {
        let slack = 1e-9 * self.usual.abs();
        if self.more_is_stricter {
            self.required < self.usual - slack
        } else {
            self.required > self.usual + slack
        }
    }

    fn words(&self) -> String {
        let side = if self.more_is_stricter { "" } else { "up to " };
        let Self { name, unit, .. } = self;
        format!(
            "{name} {side}{}{unit} (usual {}{unit})",
            number(self.required),
            number(self.usual)
        )
    }
}

/// Returns the requirements of a job that are laxer than usual for its kind, in words. A requirement that is not judged is left out.
pub(crate) fn laxer_requirements(kind: PlanKind, wanted: &Requirements, limits: &Limits) -> Vec<String> {
    use Requirement as R;
    let tip_speed_m_s = match kind {
        PlanKind::DryRun => dry_run::SPEED_M_S,
        PlanKind::Wash | PlanKind::MotionHome | PlanKind::Rest => TIP_SPEED_M_S,
    };
    let mut rows = vec![Row::at_least(
        R::Clearance.words(),
        wanted.clearance_m,
        CLEARANCE_M,
        MILLIMETRE,
    )];
    match (kind, wanted.lifting_m_s) {
        (PlanKind::MotionHome, Some(lifting_m_s)) => {
            rows.push(Row::at_most(LIFTING_SPEED, lifting_m_s, RETREAT_M_S, METRE_PER_SECOND));
        }
        (PlanKind::MotionHome, None) => {}
        (PlanKind::Wash | PlanKind::DryRun | PlanKind::Rest, _) => {
            rows.insert(0, Row::at_least(R::Swept.words(), wanted.coverage, SWEPT, PERCENT));
            rows.extend(of_washing(wanted));
        }
    }
    let (speed, acceleration) = (limits.tip_speed_m_s, limits.tip_acceleration_m_s2);
    let unit = METRE_PER_SECOND_SQUARED;
    rows.extend([
        Row::at_most(R::TipSpeed.words(), speed, tip_speed_m_s, METRE_PER_SECOND),
        Row::at_most(R::TipAcceleration.words(), acceleration, TIP_ACCELERATION_M_S2, unit),
    ]);
    rows.iter().filter(|row| row.is_laxer()).map(Row::words).collect()
}

/// Rows of a plan that washes plates.
fn of_washing(wanted: &Requirements) -> Vec<Row> {
    use Requirement as R;
    let (speed_m_s, unit) = (wanted.wash_speed_m_s, METRE_PER_SECOND_SQUARED);
    let acceleration = wanted.wash_acceleration_m_s2;
    let mut rows = vec![
        Row::at_most(R::Tilt.words(), wanted.tilt_rad.to_degrees(), TILT_DEG, DEGREE),
        Row::at_most(R::WashSpeed.words(), speed_m_s, WASH_SPEED_M_S, METRE_PER_SECOND),
        Row::at_most(R::WashAcceleration.words(), acceleration, WASH_ACCELERATION_M_S2, unit),
    ];
    if let Some(contact) = &wanted.contact {
        // Where the job states no contact speed, the wash speed is the limit.
        let speed = |stated: Option<f64>| stated.unwrap_or(speed_m_s);
        let [landing, lifting] = [wanted.landing_m_s, wanted.lifting_m_s].map(speed);
        let wrist_deg = wanted.wrist_rad.unwrap_or(0.0).to_degrees();
        let ([least_n, most_n], error_m) = (contact.force_n, contact.height_error_m);
        rows.extend([
            Row::at_least(R::Pressed.words(), contact.share, CONTACT.share, PERCENT),
            Row::at_least("compression", contact.compression_m, CONTACT.compression_m, MILLIMETRE),
            Row::at_least("height error", error_m, CONTACT.height_error_m, MILLIMETRE),
            Row::at_least(R::ContactTime.words(), contact.time_s, CONTACT.time_s, (1.0, " s")),
            Row::at_least(
                R::ContactTime.words() + " on",
                contact.time_share,
                CONTACT.time_share,
                PERCENT,
            ),
            Row::at_least(
                R::ContactDose.words(),
                contact.dose_pa_m,
                CONTACT.dose_pa_m,
                (1.0, " Pa·m"),
            ),
            Row::at_least(
                R::ContactDose.words() + " on",
                contact.dose_share,
                CONTACT.dose_share,
                PERCENT,
            ),
            Row::at_most(R::Strain.words(), contact.strain, CONTACT.strain, PERCENT),
            Row::at_least(R::ContactForce.words(), least_n, CONTACT.force_n[0], NEWTON),
            Row::at_most(R::ContactForce.words(), most_n, CONTACT.force_n[1], NEWTON),
            Row::at_most(LANDING_SPEED, landing, CONTACT_SPEED_M_S, METRE_PER_SECOND),
            Row::at_most(LIFTING_SPEED, lifting, CONTACT_SPEED_M_S, METRE_PER_SECOND),
            Row::at_least(R::Wrist.words(), wrist_deg, WRIST_DEG, DEGREE),
        ]);
    }
    rows
}
