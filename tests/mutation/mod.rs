//! Certificates of real plans, each edited once and sealed again: what an independent sampler finds broken is refused under
//! that requirement's name, and what is not broken passes.
//!
//! | what | where |
//! | --- | --- |
//! | the plans that are edited; an edit and what is known of it beforehand; all of them | `edit.rs`, `edits/` |
//! | edits after which there is no plan | `refused.rs` |
//! | edits of the job, found against its scenario | `against.rs` |
//! | contact, paths along a face, faces that are not flat: edited field by field | `contact.rs` |
//! | the requirements measured on samples | `sampler/` |
//! | certificate, samples and expectation held against each other; the summary | `judge.rs` |

mod against;
mod contact;
mod edit;
mod edits;
mod judge;
mod refused;
mod sampler;

use crate::mutation::edit::{Edit, ExpectedResult, good};
use crate::mutation::judge::{Outcome, STATEMENTS};
use platewash::certificate::prove;
use platewash_fixtures::is_thorough;
use rayon::prelude::*;

#[test]
fn the_plans_are_good() {
    for good in good() {
        let complaints = judge::complaints_unedited(good);
        assert!(complaints.is_empty(), "{complaints:#?}");
    }
}

/// Every fourth edit and, for each requirement, the first that names it; all of them with `PLATEWASH_THOROUGH=1`.
fn chosen() -> Vec<Edit> {
    let mut named = Vec::new();
    let is_chosen = |(k, edit): (usize, Edit)| {
        let names = match &edit.expected {
            ExpectedResult::Fails(names) | ExpectedResult::Waived(names) => &names[..],
            _ => &[],
        };
        let before = named.len();
        let new = names.iter().filter(|name| !named.contains(*name)).copied();
        named.extend(new.collect::<Vec<_>>());
        (is_thorough() || k % 4 == 0 || named.len() > before).then_some(edit)
    };
    edits::all().into_iter().enumerate().filter_map(is_chosen).collect()
}

#[test]
fn edited_plans_are_refused_by_the_requirement_that_is_broken() {
    let edits = chosen();
    let outcomes: Vec<Outcome> = edits
        .par_iter()
        .map(|edit| judge::judge(edit, &good()[edit.of]))
        .collect();
    judge::print(&edits, &outcomes);
    let complaints: Vec<_> = outcomes.iter().flat_map(|o| &o.complaints).collect();
    assert!(complaints.is_empty(), "{}: {complaints:#?}", complaints.len());
    let refused = outcomes.iter().filter(|o| !o.refused.is_empty()).count();
    let passed = outcomes.len() - refused;
    let share = if is_thorough() { 1 } else { 4 };
    assert!(
        share * refused >= 250 && share * passed >= 120,
        "{refused} refused, {passed} passed"
    );
    // Every requirement was broken at least once, and those about numbers were seen broken.
    for name in good()[0].requirements() {
        let sampled = outcomes.iter().any(|o| o.sampled.contains(&name));
        assert!(sampled || STATEMENTS.contains(&name), "{name:?} was never seen broken");
        assert!(
            outcomes.iter().any(|o| o.refused.contains(&name)),
            "{name:?} was never refused"
        );
    }
}

/// A certificate that sees nothing of an edit is found out wherever there is something to see.
#[test]
fn the_sampler_finds_errors_of_a_blind_certificate() {
    let blind = good().each_ref().map(|good| prove(&good.plan, good.robot).unwrap());
    let edits = edits::all();
    let mut found_out = 0;
    for edit in edits.iter().step_by(26) {
        let good = &good()[edit.of];
        let plan = edit.apply(&good.plan);
        if prove(&plan, good.robot).unwrap().broken().count() > 0 {
            let complaints = judge::hold(edit, &plan, &blind[edit.of], good).complaints;
            assert!(
                complaints.iter().any(|c| c.contains("MISSED")),
                "{}: {complaints:?}",
                edit.what
            );
            found_out += 1;
        }
    }
    assert!(found_out >= 6, "{found_out}");
}
