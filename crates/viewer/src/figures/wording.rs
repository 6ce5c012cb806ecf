//! Words that figures share.

use super::ink::page::Words;
use super::subject::Subject;
use platewash_certificate::{Measure, Sense, Status, Unit, Worst};
use platewash_kinematics::words::{decimals_down, decimals_up, percent};
use platewash_workcell::segment::SegmentKind;
use platewash_workcell::words::quoted;

/// Letters of a hash that are shown.
const HASH: usize = 12;

impl Subject<'_> {
    /// The words around a figure.
    pub(super) fn words(&self, title: &str, caption: &str) -> Words {
        Words {
            title: format!("{title}: {}", quoted(&self.plan.provenance.scenario)),
            subtitle: self.about(),
            caption: caption.to_owned(),
            source: self.source(),
        }
    }

    /// What the plan is: how many plates, how long, what is known of it.
    fn about(&self) -> String {
        let plates = match self.plan.job.plates.len() {
            1 => "1 plate".to_owned(),
            count => format!("{count} plates"),
        };
        let dry_run = self.plan.job.dry_run.as_ref();
        let dry_run = dry_run.map_or_else(String::new, |dry_run| dry_run.words() + "; ");
        let first = format!(
            "{dry_run}{plates}, seed {}, {}",
            self.plan.job.seed,
            seconds(self.motion.duration_s())
        );
        let proof = match self.certificate {
            _ if self.is_paper() => "the paper's program, followed to the letter".to_owned(),
            None => "planned, not proved".to_owned(),
            Some(certificate) if certificate.passes() => {
                let waived = certificate.waived.iter().map(|waived| waived.words());
                let waived: Vec<_> = waived.collect();
                match waived.is_empty() {
                    true => "proved for every moment".to_owned(),
                    false => format!("proved, but for {}, which the job waives", waived.join(", ")),
                }
            }
            Some(certificate) => {
                let broken: Vec<_> = certificate.broken().map(|check| check.requirement.words()).collect();
                match broken.is_empty() {
                    true => "NOT PROVED: the plan was changed after it was written".to_owned(),
                    false => format!("NOT PROVED: {}", broken.join(", ")),
                }
            }
        };
        format!("{first}; {proof}")
    }

    /// Where a figure comes from.
    fn source(&self) -> String {
        let hash: String = match &self.plan.hash {
            Some(hash) => hash.chars().take(HASH).collect(),
            None => "without a hash".to_owned(),
        };
        format!("plan {hash} · platewash {}", env!("CARGO_PKG_VERSION"))
    }
}

/// A time in words.
pub(super) fn seconds(t_s: f64) -> String {
    format!("{t_s:.2} s")
}

/// A share as per cent, rounded down, so that none looks greater than it is.
pub(super) fn per_cent(share: f64) -> String {
    format!("{} %", percent(share))
}

/// What an arm does in a segment, and where.
pub(super) fn doing(kind: SegmentKind, plate: usize) -> String {
    match kind {
        SegmentKind::Depart => format!("from home to plate {plate}"),
        SegmentKind::Approach => format!("comes down to plate {plate}"),
        SegmentKind::Wash => format!("washes plate {plate}"),
        SegmentKind::Retreat => format!("leaves plate {plate}"),
        SegmentKind::Transit => format!("crosses over to plate {plate}"),
        SegmentKind::Return => "returns home".to_owned(),
    }
}

/// What came of a requirement, in a word.
pub(super) fn status(status: Status) -> &'static str {
    match status {
        Status::Proved => "proved",
        Status::Violated => "violated",
        Status::NotProved => "not proved",
        Status::Waived => "waived",
    }
}

/// What is proved of a measure, and what is required, with units; the bound rounded towards the limit.
pub(super) fn measure(measure: &Measure) -> [String; 2] {
    let (scale, unit) = match measure.unit {
        Unit::Radian => (1f64.to_degrees(), "°"),
        Unit::RadianPerSecond => (1.0, " rad/s"),
        Unit::RadianPerSecondSquared => (1.0, " rad/s²"),
        Unit::Metre => (1e3, " mm"),
        Unit::MetrePerSecond => (1.0, " m/s"),
        Unit::MetrePerSecondSquared => (1.0, " m/s²"),
        Unit::Newton => (1.0, " N"),
        Unit::Share => (100.0, " %"),
    };
    let (sign, towards): (_, fn(f64, usize) -> String) = match measure.sense {
        Sense::AtMost => ("≤", decimals_up),
        Sense::AtLeast => ("≥", decimals_down),
        Sense::Above => (">", decimals_down),
    };
    let decimals = if measure.unit == Unit::Share { 1 } else { 3 };
    let stated = |value: f64| towards(scale * value, decimals);
    let bound = match (measure.bound, measure.seen) {
        (Some(bound), _) => format!("{sign} {}{unit}", stated(bound)),
        (None, Some(seen)) => format!("seen: {}{unit}", stated(seen)),
        (None, None) => "nothing finite".to_owned(),
    };
    [bound, format!("{sign} {}{unit}", number(scale * measure.limit))]
}

/// A number to three decimals, as short as it goes.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Where and when something is worst.
pub(super) fn place(worst: &Worst) -> String {
    let mut all = Vec::new();
    all.extend(worst.time_s.map(|t_s| format!("{t_s:.2} s")));
    all.extend(worst.joint.map(|joint| format!("joint {}", joint + 1)));
    all.extend(worst.pair.as_ref().map(|[a, b]| format!("{a} and {b}")));
    all.extend(
        worst
            .segment
            .map(|(index, kind)| format!("segment {index} ({})", kind.name())),
    );
    all.extend(worst.plate.map(|plate| format!("plate {plate}")));
    all.join(", ")
}
