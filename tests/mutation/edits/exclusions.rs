//! Pairs that need not keep clear: those that follow from the arm left out, and others put in.

use crate::mutation::edit::{Edits, ExpectedResult, Kind, good};
use platewash::Plan;
use platewash::bodies::clearance;
use platewash::certificate::Requirement::{Clearance, Exclusions};
use platewash::workcell::{Exclusion, ExclusionReason};

pub fn add(edits: &mut Edits) {
    stated(edits);
    added(edits);
}

/// Those that follow, as they follow from tool and obstacles.
pub fn restate(plan: &mut Plan) {
    let cell = &mut plan.job.workcell;
    cell.exclusions = clearance::exclusions(good()[0].robot, &cell.tool, &cell.obstacles).unwrap();
}

/// Leaves a pair out.
pub fn leave_out(plan: &mut Plan, pair: [&str; 2]) {
    plan.job.workcell.exclusions.push(Exclusion {
        pair: pair.map(str::to_owned),
        reason: ExclusionReason::Srdf,
    });
}

fn stated(edits: &mut Edits) {
    let mut fails = |what, apply| edits.fails(Kind::Exclusions, what, &[Exclusions], apply);
    fails("one dropped", |p| _ = p.job.workcell.exclusions.remove(3));
    fails("all dropped", |p| p.job.workcell.exclusions.clear());
    fails("one turned round", |p| p.job.workcell.exclusions[2].pair.reverse());
    fails("one for another reason", |p| {
        let all = &mut p.job.workcell.exclusions;
        let carried = all.iter_mut().find(|e| e.reason == ExclusionReason::CarriesTool);
        carried.unwrap().reason = ExclusionReason::Srdf;
    });
    fails("one of bodies that there are not", |p| {
        leave_out(p, ["link_3", "link_9"])
    });
    fails("one of a body with itself", |p| leave_out(p, ["link_3", "link_3"]));
    fails("one of a plate that there is not", |p| {
        leave_out(p, ["handle", "plate 5"])
    });
    edits.harmless(Kind::Exclusions, "in another order", |p| {
        p.job.workcell.exclusions.reverse()
    });
    edits.harmless(Kind::Exclusions, "one stated twice", |p| {
        let again = p.job.workcell.exclusions[1].clone();
        p.job.workcell.exclusions.push(again);
    });
}

/// A pair more: harmless where it keeps clear all the same, waived where it does not, and no excuse for any other.
fn added(edits: &mut Edits) {
    for pair in [
        ["link_4", "handle"],
        ["handle", "link_4"],
        ["link_3", "floor"],
        ["handle", "plate 2"],
        ["sponge", "plate 3"],
        ["link_6", "plate 1"],
        ["base_link", "link_5"],
    ] {
        let what = format!("{} and {}", pair[0], pair[1]);
        edits.add(Kind::Exclusions, what, ExpectedResult::Harmless, move |p, _| {
            leave_out(p, pair)
        });
    }
    // Where nothing need keep clear of anything, nothing is proved.
    edits.fails(Kind::Exclusions, "every pair that could meet", &[Clearance], |p| {
        every_pair(p).iter().for_each(|[a, b]| leave_out(p, [a, b]))
    });
    edits.harmless(Kind::Exclusions, "every pair but one", all_but_one);
    for clearance_m in [0.05, 0.15] {
        let what = format!("every pair but one, where {clearance_m} m are asked for");
        edits.add(
            Kind::Exclusions,
            what,
            ExpectedResult::Waived(vec![Exclusions]),
            move |p, _| {
                p.job.requirements.clearance_m = clearance_m;
                all_but_one(p);
            },
        );
    }
    edits.fails(
        Kind::Exclusions,
        "one pair, where others are too near",
        &[Clearance],
        |p| {
            p.job.requirements.clearance_m = 0.1;
            leave_out(p, ["base_link", "link_4"]);
        },
    );
}

/// Leaves out every pair but one that is far apart.
fn all_but_one(plan: &mut Plan) {
    let pairs = every_pair(plan);
    let others = pairs.iter().filter(|pair| **pair != ["link_2", "floor"]);
    others.for_each(|[a, b]| leave_out(plan, [a, b]));
}

/// The pairs of two bodies that are judged.
pub fn every_pair(plan: &Plan) -> Vec<[String; 2]> {
    let model = platewash::ClearanceModel::new(good()[0].robot, &plan.job.workcell, &plan.job.plates).unwrap();
    let names = model.pair_names().into_iter();
    names.map(|(a, b)| [a.to_owned(), b.to_owned()]).collect()
}
