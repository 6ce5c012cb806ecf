//! The certificate of an edited plan held against the sampler and against what is known of the edit; and the summary, a line for each
//! kind of edit.

use crate::mutation::edit::{Edit, ExpectedResult, GoodPlan, Kind};
use crate::mutation::sampler::{Findings, WorstSample, is_sound};
use platewash::Plan;
use platewash::certificate::{Certificate, Check, Requirement, Sense, Status, prove};

/// Rounding of bounds, as a part of the limit or in SI.
const ROUNDING: f64 = 2e-9;

/// How much nearer or farther a waived pair may be between samples, and what distances are right to \[m\].
const WAIVED_M: f64 = 5e-4;

/// The requirements that no number decides and no sample.
pub const STATEMENTS: [Requirement; 7] = [
    Requirement::Arm,
    Requirement::Tool,
    Requirement::Plates,
    Requirement::Exclusions,
    Requirement::WashPaths,
    Requirement::Segments,
    Requirement::EveryPlateOnce,
];

/// What came of an edit.
pub struct Outcome {
    /// Requirements that the sampler found broken.
    pub sampled: Vec<Requirement>,
    /// Requirements that are not kept, by the certificate.
    pub refused: Vec<Requirement>,
    /// Where certificate, sampler and expectation disagree.
    pub complaints: Vec<String>,
}

/// Edits a plan and judges it.
pub fn judge(edit: &Edit, good: &GoodPlan) -> Outcome {
    let plan = edit.apply(&good.plan);
    let certificate = prove(&plan, good.robot).unwrap();
    hold(edit, &plan, &certificate, good)
}

/// Holds a certificate against the samples of an edited plan.
pub fn hold(edit: &Edit, plan: &Plan, certificate: &Certificate, good: &GoodPlan) -> Outcome {
    // The moments that the certificate complains of are looked at, too: what it finds broken must be so.
    let blamed: Vec<_> = certificate.broken().filter_map(|p| p.worst.time_s).collect();
    let findings = good.sampler.measure(plan, &blamed);
    let case = Case {
        edit,
        plan,
        good,
        certificate,
        findings: &findings,
        is_sound: is_sound(plan),
    };
    let mut complaints = Vec::new();
    case.statements(&mut complaints);
    let checks = certificate.checks.iter();
    checks.for_each(|check| case.number(check, &mut complaints));
    case.exclusions(&mut complaints);
    case.verdict(&mut complaints);
    let say = |complaint: String| format!("{} (plan {}): {complaint}", edit.what, edit.of);
    Outcome {
        sampled: findings.broken().map(|found| found.name).collect(),
        refused: certificate.broken().map(|check| check.requirement).collect(),
        complaints: complaints.into_iter().map(say).collect(),
    }
}

/// The complaints about a plan as it is.
pub fn complaints_unedited(good: &GoodPlan) -> Vec<String> {
    let certificate = prove(&good.plan, good.robot).unwrap();
    let findings = good.sampler.measure(&good.plan, &[]);
    let refused = certificate
        .broken()
        .map(|check| format!("{:?} refused", check.requirement));
    let sampled = findings.broken().map(|f| format!("{f:?}"));
    refused.chain(sampled).collect()
}

struct Case<'a> {
    edit: &'a Edit,
    plan: &'a Plan,
    good: &'a GoodPlan,
    certificate: &'a Certificate,
    findings: &'a Findings,
    is_sound: bool,
}

impl Case<'_> {
    fn named(&self) -> &[Requirement] {
        match &self.edit.expected {
            ExpectedResult::Fails(names) => names,
            _ => &[],
        }
    }

    /// The requirements about statements that fail are those named; those about numbers that are named fail.
    fn statements(&self, complaints: &mut Vec<String>) {
        for check in &self.certificate.checks {
            let (named, kept) = (self.named().contains(&check.requirement), check.status.is_kept());
            if named && kept {
                complaints.push(format!("MISSED {:?}, named beforehand", check.requirement));
            }
            if !named && !kept && STATEMENTS.contains(&check.requirement) {
                complaints.push(format!("{:?} fails: {:?}", check.requirement, check.discrepancies));
            }
        }
        if self.is_sound == self.named().contains(&Requirement::Segments) {
            complaints.push(format!(
                "the segments are {}sound",
                if self.is_sound { "" } else { "un" }
            ));
        }
    }

    /// A requirement about a number against its samples.
    fn number(&self, check: &Check, complaints: &mut Vec<String>) {
        if STATEMENTS.contains(&check.requirement) {
            return;
        }
        let Some(found) = self.findings.of(check.requirement) else {
            // Nothing was measured: it rests on segments that are unsound, or does not occur.
            if !self.is_sound && check.status != Status::NotProved {
                complaints.push(format!("{:?} is judged without segments", check.requirement));
            }
            return;
        };
        match (found.is_broken(), check.status) {
            (true, Status::Proved | Status::Waived) => complaints.push(format!("MISSED {found:?}")),
            (true, _) | (false, Status::Proved) => {}
            // What is waived is not measured.
            (false, Status::Waived) => {}
            (false, _) => self.unfounded(check, found, complaints),
        }
        if !encloses(check, found) {
            complaints.push(format!("worse than proved: {found:?}, {:?}", check.measure));
        }
    }

    /// What the certificate refuses though the sampler finds nothing.
    fn unfounded(&self, check: &Check, found: &WorstSample, complaints: &mut Vec<String>) {
        // Without segments nobody knows when the sponge may touch; a shape that is none has no deviation.
        let rests_on_segments = check.requirement == Requirement::Clearance && !self.is_sound;
        let open = rests_on_segments || self.named().contains(&check.requirement) || self.is_hard_to_prove(check);
        if check.status != Status::NotProved || !open {
            complaints.push(format!("unfounded: {check:?} but {found:?}"));
        }
    }

    /// Coverage is proved for the greatest tilt: with that the sponge may sweep too little.
    fn is_hard_to_prove(&self, check: &Check) -> bool {
        check.requirement == Requirement::Swept && self.good.sampler.least_coverage_is_short(self.plan)
    }

    /// Pairs that the job alone leaves out are named; where they are seen too near, that is said, and waived.
    fn exclusions(&self, complaints: &mut Vec<String>) {
        let check = self.certificate.check(Requirement::Exclusions).unwrap();
        if self.named().contains(&check.requirement) {
            return;
        }
        let stated = &self.plan.job.workcell.exclusions;
        let rests_on = &self.certificate.rests_on;
        let (own, others) = (&rests_on.workcell.exclusions, &rests_on.waived_pairs);
        if !stated.iter().all(|e| own.contains(e) != others.contains(e)) || !own.iter().all(|e| stated.contains(e)) {
            complaints.push(format!("left out: {stated:?}, told: {own:?}, {others:?}"));
        }
        let limit = self.plan.job.requirements.clearance_m;
        let least = self.findings.least_waived_m().unwrap_or(f64::INFINITY);
        match check.status {
            Status::Proved if least < limit - WAIVED_M => {
                complaints.push(format!("MISSED a waived pair at {least} m"));
            }
            Status::Waived if least > limit + WAIVED_M => {
                complaints.push(format!("unfounded: {check:?} but {least} m"));
            }
            _ => {}
        }
    }

    /// The verdict is what the checks make it.
    fn verdict(&self, complaints: &mut Vec<String>) {
        let refused = self.certificate.broken().count() > 0;
        if refused == self.certificate.passes() {
            complaints.push(format!("verdict {:?}", self.certificate.verdict));
        }
        if self.certificate.hash.status != Status::Proved {
            complaints.push("hash".to_owned());
        }
        let waived = match &self.edit.expected {
            ExpectedResult::Harmless => &[],
            ExpectedResult::Waived(names) => &names[..],
            _ => return,
        };
        if refused || self.findings.broken().count() > 0 || self.certificate.waived != waived {
            let names: Vec<_> = self.certificate.broken().map(|check| check.requirement).collect();
            complaints.push(format!(
                "not harmless: {names:?}, waived: {:?}",
                self.certificate.waived
            ));
        }
    }
}

/// Whether what was measured is no worse than what is proved. Joints have limits of their own: shares of them count.
fn encloses(check: &Check, found: &WorstSample) -> bool {
    let Some((bound, measure)) = check.measure.and_then(|m| m.bound.map(|b| (b, m))) else {
        return true;
    };
    // How far a path is from its curve is measured in samples only as long as it follows the curve.
    let follows = [Requirement::PathDeviation, Requirement::LineDeviation];
    if follows.contains(&check.requirement) && found.is_broken() {
        return true;
    }
    // What is allowed depends on the tilt that is proved: the excess is what counts.
    if check.requirement == Requirement::Reach {
        return found.value - found.limit <= bound - measure.limit + found.slack + ROUNDING;
    }
    // One limit for all joints and all moments.
    let is_one = found.limit <= 0.0 || check.requirement == Requirement::Tilt;
    match measure.sense {
        Sense::AtMost if is_one => found.value <= bound + found.slack + ROUNDING,
        Sense::AtMost => (found.value - found.slack) / found.limit <= bound / measure.limit + ROUNDING,
        _ => found.value >= bound - found.slack - ROUNDING,
    }
}

/// Prints how many edits of each kind there were and what came of them; `cargo test --test main mutation -- --nocapture` shows it.
pub fn print(edits: &[Edit], outcomes: &[Outcome]) {
    let line = |words: &str, [all, sampled, refused]: [usize; 3]| {
        println!("{words:<18} {all:>5} {sampled:>9} {refused:>8} {:>7}", all - refused);
    };
    println!(
        "{:<18} {:>5} {:>9} {:>8} {:>7}",
        "edit of", "edits", "by sample", "refused", "passed"
    );
    let mut sum = [0; 3];
    for kind in Kind::ALL {
        let of_kind = || edits.iter().zip(outcomes).filter(|(e, _)| e.kind == kind);
        let counts = [
            of_kind().count(),
            of_kind().filter(|(_, o)| !o.sampled.is_empty()).count(),
            of_kind().filter(|(_, o)| !o.refused.is_empty()).count(),
        ];
        line(kind.words(), counts);
        (0..3).for_each(|i| sum[i] += counts[i]);
    }
    line("all", sum);
}
