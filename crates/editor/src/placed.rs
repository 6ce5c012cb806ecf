//! The job of a scenario: the arm loaded, the plates placed.

use crate::arms::Loaded;
use crate::end::End;
use crate::subject::Subject;
use platewash_planner::Watch;
use platewash_scenario::Scenario;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::WashJob;
use platewash_workcell::layout::Layout;

/// A job, and what its scenario says beside it.
pub struct Placed {
    /// The scenario.
    pub scenario: Scenario,
    /// The arm.
    pub loaded: Loaded,
    /// The plates, and what is to be said about them.
    pub layout: Layout,
    /// The job.
    pub job: WashJob,
}

/// The job of a scenario.
pub fn placed(subject: &Subject, scenario: Scenario, cancel: &CancelToken) -> Result<Placed, End> {
    let loaded = subject.arms.of(&scenario)?;
    let layout = scenario.place(&loaded.arm, &Watch::silent(cancel))?;
    let job = scenario.job_on(&loaded.arm, &layout)?;
    Ok(Placed {
        scenario,
        loaded,
        layout,
        job,
    })
}
