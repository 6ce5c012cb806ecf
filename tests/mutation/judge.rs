//! The certificate of an edited plan held against the sampler and against what is known of the edit.

use crate::edit::{Edit, Expected};
use crate::good::Good;
use crate::sampler::{Findings, Found, is_sound};
use platewash::Plan;
use platewash::planner::certificate::{self, Certificate, CertificateVerdict, Promise, PromiseName, Sense, Status};

/// Rounding of bounds, as a part of the limit or in SI.
const ROUNDING: f64 = 2e-9;

/// The promises that no number decides and no sample.
pub const STATEMENTS: [PromiseName; 10] = [
    PromiseName::Arm,
    PromiseName::Tool,
    PromiseName::Plates,
    PromiseName::Limits,
    PromiseName::Tolerances,
    PromiseName::ClearancePairs,
    PromiseName::Segments,
    PromiseName::ToolPath,
    PromiseName::EveryPlateOnce,
    PromiseName::Summary,
];

/// What came of an edit.
pub struct Outcome {
    /// Promises that the sampler found broken.
    pub sampled: Vec<PromiseName>,
    /// Promises that the certificate does not give.
    pub refused: Vec<PromiseName>,
    /// Where certificate, sampler and expectation disagree.
    pub complaints: Vec<String>,
}

/// Edits a plan and judges it.
pub fn judge(edit: &Edit, good: &Good) -> Outcome {
    let plan = edit.apply(&good.plan);
    let certificate = certificate::verify(&plan, good.robot).unwrap();
    hold(edit, &plan, &certificate, good)
}

/// Holds a certificate against the samples of an edited plan.
pub fn hold(edit: &Edit, plan: &Plan, certificate: &Certificate, good: &Good) -> Outcome {
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
    let promises = certificate.promises.iter();
    promises.for_each(|promise| case.number(promise, &mut complaints));
    case.verdict(&mut complaints);
    let say = |complaint: String| format!("{} (plan {}): {complaint}", edit.what, edit.of);
    Outcome {
        sampled: findings.broken().map(|found| found.name).collect(),
        refused: certificate.broken().map(|promise| promise.name).collect(),
        complaints: complaints.into_iter().map(say).collect(),
    }
}

/// The complaints about a plan as it is.
pub fn complaints_unedited(good: &Good) -> Vec<String> {
    let certificate = certificate::verify(&good.plan, good.robot).unwrap();
    let findings = good.sampler.measure(&good.plan, &[]);
    let refused = certificate.broken().map(|p| format!("{:?} refused", p.name));
    let sampled = findings.broken().map(|f| format!("{f:?}"));
    refused.chain(sampled).collect()
}

struct Case<'a> {
    edit: &'a Edit,
    plan: &'a Plan,
    good: &'a Good,
    certificate: &'a Certificate,
    findings: &'a Findings,
    is_sound: bool,
}

impl Case<'_> {
    fn named(&self) -> &[PromiseName] {
        match &self.edit.expected {
            Expected::Fails(names) => names,
            _ => &[],
        }
    }

    /// The promises about statements that fail are those named; those about numbers that are named fail.
    fn statements(&self, complaints: &mut Vec<String>) {
        for promise in &self.certificate.promises {
            let (named, passes) = (self.named().contains(&promise.name), promise.status == Status::Pass);
            if named && passes {
                complaints.push(format!("MISSED {:?}, named beforehand", promise.name));
            }
            let overstated = promise.name == PromiseName::Summary && self.is_unwashed();
            if !named && !passes && !overstated && STATEMENTS.contains(&promise.name) {
                complaints.push(format!("{:?} fails: {:?}", promise.name, promise.discrepancies));
            }
        }
        if self.is_sound == self.named().contains(&PromiseName::Segments) {
            complaints.push(format!(
                "the segments are {}sound",
                if self.is_sound { "" } else { "un" }
            ));
        }
    }

    /// Whether a plate is not proved to be washed, so that the summary counts one too many.
    fn is_unwashed(&self) -> bool {
        let washes = [PromiseName::Coverage, PromiseName::ContactHeight];
        self.certificate.broken().any(|p| washes.contains(&p.name))
    }

    /// A promise about a number against its samples.
    fn number(&self, promise: &Promise, complaints: &mut Vec<String>) {
        if STATEMENTS.contains(&promise.name) {
            return;
        }
        let Some(found) = self.findings.of(promise.name) else {
            // Nothing was measured: it rests on segments that are unsound, or does not occur.
            if !self.is_sound && promise.status != Status::NotProved {
                complaints.push(format!("{:?} is judged without segments", promise.name));
            }
            return;
        };
        match (found.is_broken(), promise.status) {
            (true, Status::Pass) => complaints.push(format!("MISSED {found:?}")),
            (true, _) | (false, Status::Pass) => {}
            (false, _) => self.unfounded(promise, found, complaints),
        }
        if !encloses(promise, found) {
            complaints.push(format!("worse than proved: {found:?}, {:?}", promise.measure));
        }
    }

    /// What the certificate refuses though the sampler finds nothing.
    fn unfounded(&self, promise: &Promise, found: &Found, complaints: &mut Vec<String>) {
        // Without segments nobody knows when the sponge may touch; a shape that is none has no deviation.
        let rests_on_segments = promise.name == PromiseName::Clearance && !self.is_sound;
        let open = rests_on_segments || self.named().contains(&promise.name) || self.is_hard_to_prove(promise);
        if promise.status != Status::NotProved || !open {
            complaints.push(format!("unfounded: {promise:?} but {found:?}"));
        }
    }

    /// Coverage is proved for the greatest tilt: with that the sponge may sweep too little.
    fn is_hard_to_prove(&self, promise: &Promise) -> bool {
        promise.name == PromiseName::Coverage && self.good.sampler.least_coverage_is_short(self.plan)
    }

    /// The verdict is what the promises make it.
    fn verdict(&self, complaints: &mut Vec<String>) {
        let refused = self.certificate.broken().count() > 0;
        if refused != (self.certificate.verdict == CertificateVerdict::Fail) {
            complaints.push(format!("verdict {:?}", self.certificate.verdict));
        }
        if self.certificate.hash.status != Status::Pass {
            complaints.push("hash".to_owned());
        }
        if self.edit.expected == Expected::Harmless && (refused || self.findings.broken().count() > 0) {
            let names: Vec<_> = self.certificate.broken().map(|p| p.name).collect();
            complaints.push(format!("not harmless: {names:?}"));
        }
    }
}

/// Whether what was measured is no worse than what is proved. Joints have limits of their own: shares of them count.
fn encloses(promise: &Promise, found: &Found) -> bool {
    let Some((bound, measure)) = promise.measure.and_then(|m| m.bound.map(|b| (b, m))) else {
        return true;
    };
    // How far a path is from its curve is measured in samples only as long as it follows the curve.
    let follows = [PromiseName::StrokeDeviation, PromiseName::LineDeviation];
    if follows.contains(&promise.name) && found.is_broken() {
        return true;
    }
    // What is allowed depends on the tilt that is proved: the excess is what counts.
    if promise.name == PromiseName::Reach {
        return found.value - found.limit <= bound - measure.limit + found.slack + ROUNDING;
    }
    match measure.sense {
        Sense::AtMost if found.limit <= 0.0 => found.value <= bound + found.slack + ROUNDING,
        Sense::AtMost => (found.value - found.slack) / found.limit <= bound / measure.limit + ROUNDING,
        _ => found.value >= bound - found.slack - ROUNDING,
    }
}
