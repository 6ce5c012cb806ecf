//! Largest distance of an arm from the start of a plan, at which a program moves.

use platewash_workcell::job::JobTerms;

/// Place in an assumption for the largest distance of the arm from the start \[°\].
pub const START_WITHIN: &str = "{start_within_deg}";

/// Largest distances of the arm from the start of a plan, joint by joint \[°\]: at home, and after a stop, where the sponge may be at a plate.
/// Programs check it where they can. The way from there to the start is not proved.
pub const START_WITHIN_DEG: [f64; 2] = [0.5, 0.1];

/// Largest distance of the arm from the start of a job's plan, joint by joint \[°\].
#[must_use]
pub fn start_within_deg(job: &JobTerms) -> f64 {
    let [at_home, after_stop] = START_WITHIN_DEG;
    if job.is_motion_home() { after_stop } else { at_home }
}
