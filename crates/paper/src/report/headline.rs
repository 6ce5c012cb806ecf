//! How a run ended, in a word and in a line.

use super::motion::{MotionReport, ViolationKind};
use super::plate::PlateReport;
use super::transits::TransitReport;
use platewash_kinematics::words::percent;
use platewash_workcell::verdict::Verdict;
use platewash_workcell::words::part_of;

/// How the run ended.
pub(super) fn verdict(
    plates: &[PlateReport],
    transits: &TransitReport,
    plan: &MotionReport,
    done: &MotionReport,
) -> Verdict {
    let reached = plates.iter().all(|p| p.reached == p.waypoints) && transits.reached == transits.waypoints;
    let clear = !plan.violations.iter().any(|v| v.kind == ViolationKind::Clearance);
    if !reached || !clear {
        Verdict::Infeasible
    } else if plates.iter().all(|p| p.washed) && plan.violations.is_empty() && done.violations.is_empty() {
        Verdict::Swept
    } else {
        Verdict::NotVerified
    }
}

/// The first line: whether the run washes, and the main reasons if not.
pub(super) fn headline(
    verdict: Verdict,
    plates: &[PlateReport],
    transits: &TransitReport,
    plan: &MotionReport,
    done: &MotionReport,
    required_coverage: f64,
) -> String {
    let washed = plates.iter().filter(|p| p.washed).count();
    let washed = part_of(washed, plates.len(), "plate");
    if verdict == Verdict::Swept {
        return format!("SWEPT: {washed}, every limit kept; contact was not judged.");
    }
    let mut reasons = Vec::new();
    let asked: usize = plates.iter().map(|p| p.waypoints).sum();
    let unreached = asked - plates.iter().map(|p| p.reached).sum::<usize>();
    if unreached > 0 {
        reasons.push(format!("{unreached} of {asked} washing waypoints out of reach"));
    }
    if transits.reached < transits.waypoints {
        let unreached = transits.waypoints - transits.reached;
        reasons.push(format!(
            "{unreached} of {} waypoints between plates out of reach",
            transits.waypoints
        ));
    }
    let off = asked - plates.iter().map(|p| p.in_contact).sum::<usize>();
    if off > 0 {
        reasons.push(format!("the sponge off the plate at {off} of {asked} waypoints"));
    }
    let all = || plan.violations.iter().chain(&done.violations);
    if all().any(|v| v.kind == ViolationKind::Clearance) {
        reasons.push("too little clearance".to_owned());
    }
    let least = plates.iter().map(|p| p.executed_coverage.lower).fold(1.0, f64::min);
    if least < required_coverage {
        reasons.push(format!("as little as {} % of a plate swept", percent(least)));
    }
    if all().any(|v| v.kind != ViolationKind::Clearance) {
        reasons.push("joint limits broken".to_owned());
    }
    let word = if plates.iter().all(|p| p.washed) {
        "SWEPT, LIMITS BROKEN"
    } else {
        "NOT SWEPT"
    };
    format!("{word}: {washed} swept; {}.", reasons.join(", "))
}
