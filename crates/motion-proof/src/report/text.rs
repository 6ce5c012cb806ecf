//! The report as text.

use crate::report::words::position;
use crate::report::{JudgedRule, MotionMoment, MotionReport};
use platewash_certificate::{Requirement, Status};
use platewash_kinematics::words::{decimals_down, rounded};
use platewash_workcell::words::count_with_noun;
use platewash_workcell::{Exclusion, ExclusionReason};
use std::fmt;

impl fmt::Display for MotionMoment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(exact) = self.exact {
            write!(f, "at {exact} s, ")?;
        }
        if let Some(stopping_s) = self.stopping_s {
            return write!(
                f,
                "{} s after the last point, while the arm stops",
                rounded(stopping_s, 7)
            );
        }
        match self.share {
            0.0 => write!(f, "at point {}", self.point),
            1.0 => write!(f, "at point {}", self.point + 1),
            share => write!(
                f,
                "{:.1} % of the way from point {} to point {}",
                1e2 * share,
                self.point,
                self.point + 1
            ),
        }
    }
}

impl fmt::Display for MotionReport {
    /// Writes one screen; with `{:#}` every pair of bodies, too.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        let worst = self.at_fault().or(self.rules.last()).and_then(|rule| rule.worst);
        if let Some(moment) = worst {
            let q: Vec<_> = moment.q_rad.iter().map(|q| position(*q).to_string()).collect();
            writeln!(f, "joint positions there [rad]: {}", q.join(", "))?;
        }
        writeln!(
            f,
            "\narm {}, {} motion, {}",
            self.robot,
            self.interpolation,
            self.span_words()
        )?;
        writeln!(
            f,
            "\n{:<20} {:<12} {:>12} {:>12} {:<7} worst",
            "rule", "status", "bound", "limit", "unit"
        )?;
        for rule in &self.rules {
            rule.fmt(f)?;
        }
        if !self.shapeless.is_empty() {
            writeln!(
                f,
                "\nlinks without a collision shape, which keep clear of nothing: {}",
                self.shapeless.join(", ")
            )?;
        }
        if f.alternate() {
            writeln!(f, "\nclearance of each pair [mm]: proved, seen")?;
            for pair in &self.clearance {
                let [a, b] = &pair.pair;
                let mm = |m: Option<f64>| m.map_or("–".to_owned(), |m| decimals_down(1e3 * m, 2));
                writeln!(f, "  {a} – {b}: {}, {}", mm(pair.at_least_m), mm(pair.seen_m))?;
            }
            writeln!(f, "\npairs that are not judged")?;
            for Exclusion { pair: [a, b], reason } in &self.excluded {
                writeln!(f, "  {a} – {b}: {}", reason_words(*reason))?;
            }
        }
        writeln!(f, "\nassumptions")?;
        self.assumptions
            .iter()
            .try_for_each(|sentence| writeln!(f, "  {sentence}"))
    }
}

impl MotionReport {
    fn span_words(&self) -> String {
        let points = count_with_noun(self.points, "point");
        match self.span {
            Some([from, to]) => format!("{points} from {from} s to {to} s"),
            None => format!("{points} without times"),
        }
    }
}

impl fmt::Display for JudgedRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self.requirement {
            Requirement::JointPosition => "joint limit margin".to_owned(),
            other => other.words(),
        };
        let status = match self.status {
            Status::Proved => "proved",
            Status::Violated => "broken",
            Status::NotProved | Status::Waived => "not proved",
        };
        write!(f, "{name:<20} {status:<12}")?;
        match &self.measure {
            Some(measure) => {
                let words = measure.words();
                write!(f, " {:>12} {:>12} {:<7}", words.bound, words.limit, words.unit)?;
            }
            None => write!(f, " {:>12} {:>12} {:<7}", "–", "–", "")?,
        }
        let who = self
            .joint
            .clone()
            .or_else(|| self.pair.as_ref().map(|[a, b]| format!("{a} and {b}")));
        let at = self.worst.map(|moment| moment.to_string());
        writeln!(f, " {}", who.into_iter().chain(at).collect::<Vec<_>>().join(", "))
    }
}

fn reason_words(reason: ExclusionReason) -> &'static str {
    match reason {
        ExclusionReason::Srdf => "the SRDF leaves it out",
        ExclusionReason::Neighbours => "neighbours",
        ExclusionReason::AlwaysTouching => "they touch in every configuration tried",
        ExclusionReason::CarriesTool => "one carries the other",
        ExclusionReason::NeitherMoves => "neither moves (they do not overlap; a floor at height 0 is not compared)",
        ExclusionReason::KeepsItsHeight => "the link keeps its height over the floor",
    }
}
