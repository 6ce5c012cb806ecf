//! Pairs of bodies that need not keep clear: those that follow from the arm and its SRDF, and no others.
//!
//! Requirement 5 of `docs/certificate.md`.

use crate::clearance::pairs::PairBound;
use crate::judged_job::JudgedJob;
use crate::report::check::{Check, Discrepancy, Status};
use crate::report::requirement::Requirement;
use platewash_bodies::clearance::{self, ClearanceError, ClearanceModel};
use platewash_kinematics::{AXES, RobotModel};
use platewash_workcell::job::NEARER_M;
use platewash_workcell::words::{millimetres, pair_text, plate_name};
use platewash_workcell::{Exclusion, ReducedClearance, Workcell, is_pair};
use std::collections::BTreeSet;

/// Excluded pairs: those that follow from the arm, and those that only the job excludes.
#[derive(Debug)]
pub(crate) struct Exclusions {
    /// Pairs that follow from the arm, its SRDF, the tool and the obstacles. They are not judged.
    pub own: Vec<Exclusion>,
    /// Pairs that only the job excludes. They are judged all the same.
    pub waived: Vec<Exclusion>,
}

impl Exclusions {
    /// Returns the exclusions of a job with its arm.
    ///
    /// # Errors
    /// [`ClearanceError`] for a shape that is none.
    pub fn find(judged: &JudgedJob<'_>) -> Result<Self, ClearanceError> {
        let world = &judged.job.workcell;
        let own = clearance::exclusions(judged.robot, &world.tool, &world.obstacles)?;
        let others = world.exclusions.iter().filter(|stated| !own.contains(stated));
        let waived = others.cloned().collect();
        Ok(Self { own, waived })
    }

    /// Builds the collision model. The pairs that only the job excludes are part of it.
    ///
    /// # Errors
    /// [`ClearanceError`] for a shape that is none.
    pub fn model(&self, judged: &JudgedJob<'_>) -> Result<ClearanceModel, ClearanceError> {
        let world = Workcell {
            exclusions: self.own.clone(),
            ..judged.job.workcell.clone()
        };
        ClearanceModel::new(judged.robot, &world, judged.plates())
    }

    /// Returns the indices of the model's pairs that only the job excludes.
    pub fn waived_in(&self, model: &ClearanceModel) -> Vec<usize> {
        let pairs = model.pair_names().into_iter().enumerate();
        let is_waived = |pair: (&str, &str)| self.waived.iter().any(|e| is_pair(&e.pair, pair));
        pairs.filter(|(_, pair)| is_waived(*pair)).map(|(i, _)| i).collect()
    }

    /// Checks that the job excludes the pairs that follow from the arm, and that every body has a shape and a unique name. A pair that only
    /// the job excludes keeps clear, or is named as waived.
    pub fn check(&self, judged: &JudgedJob<'_>, model: &ClearanceModel, clearance: &[PairBound]) -> Check {
        let mut wrong = shapeless(judged);
        wrong.extend(twice(judged));
        wrong.extend(not_near_at_stop(judged, model));
        let stated = &judged.job.workcell.exclusions;
        let missing = self.own.iter().filter(|own| !stated.contains(own));
        wrong.extend(missing.map(|own| {
            let what = format!("exclusion of {}", exclusion_text(own));
            Discrepancy::new(
                what,
                "not stated",
                "stated, as it follows from the arm: the pair is not judged",
            )
        }));
        let pairs = model.pair_names();
        let unknown = self
            .waived
            .iter()
            .filter(|e| !pairs.iter().any(|pair| is_pair(&e.pair, *pair)));
        wrong.extend(unknown.map(|other| {
            let what = format!("exclusion of {}", exclusion_text(other));
            Discrepancy::new(
                what,
                "stated",
                "two bodies that could meet, or a reason that follows from the arm",
            )
        }));
        if !wrong.is_empty() {
            return Check::stated(Requirement::Exclusions, wrong);
        }
        let near = clearance.iter().filter(|line| line.status == Status::Waived);
        let near = near
            .map(|line| not_clear(line, judged.job.requirements.clearance_m))
            .collect();
        Check::stated(Requirement::Exclusions, near).waived_if(true)
    }
}

/// Finds pairs that the job calls near at the stop and that are farther apart there: each keeps what it has, less a little.
fn not_near_at_stop(judged: &JudgedJob<'_>, model: &ClearanceModel) -> Vec<Discrepancy> {
    let reduced = &judged.job.workcell.reduced_clearances;
    if !reduced.iter().any(|reduced| reduced.at_stop) {
        return Vec::new();
    }
    let there = model.all(&judged.job.home_rad[0]);
    let too_little = |reduced: &&ReducedClearance| {
        let kept_m = judged.job.requirements.clearance_m - reduced.by_m;
        let found = there.iter().find(|pair| is_pair(&reduced.pair, (&pair.a, &pair.b)))?;
        (kept_m < found.distance_m - NEARER_M - STATED_ROUNDING_M).then(|| {
            let what = format!("clearance of {}, as near at the stop", pair_text(&reduced.pair));
            let expected = format!("no less than {}, which they have there", millimetres(found.distance_m));
            Discrepancy::new(what, millimetres(kept_m), expected)
        })
    };
    let at_stop = reduced.iter().filter(|reduced| reduced.at_stop);
    at_stop.filter_map(|reduced| too_little(&reduced)).collect()
}

/// Rounding of a clearance that a plan states for its stop \[m\].
const STATED_ROUNDING_M: f64 = 1e-6;

/// Returns the discrepancy of a waived pair that does not keep clear.
fn not_clear(line: &PairBound, clearance_m: f64) -> Discrepancy {
    let [a, b] = &line.pair;
    let near = line.seen_m.map(|seen_m| format!("as near as {}", millimetres(seen_m)));
    let stated = near.unwrap_or_else(|| "not proved to keep clear".to_owned());
    let expected = format!(
        "at least {}, as neither the arm nor its SRDF leaves the pair out",
        millimetres(clearance_m)
    );
    Discrepancy::new(format!("{a:?} and {b:?}"), stated, expected)
}

/// Finds bodies of the arm without a shape. They keep clear of nothing.
fn shapeless(judged: &JudgedJob<'_>) -> Vec<Discrepancy> {
    let wrong = bodies_without_shape(judged.robot).into_iter().map(|names| {
        let names: Vec<_> = names.iter().map(|name| format!("{name:?}")).collect();
        let what = format!("collision geometry of {}", names.join(", "));
        Discrepancy::new(what, "none", "a shape, so that its clearance can be proved")
    });
    wrong.collect()
}

/// Returns the names of the links of each rigid body of the arm of which none has a shape.
pub(crate) fn bodies_without_shape(robot: &RobotModel) -> Vec<Vec<&str>> {
    let links = robot.links();
    let has_shape = |body: &usize| links.iter().any(|l| l.frame.body() == *body && !l.collision.is_empty());
    let without = (0..=AXES).filter(|body| !has_shape(body));
    let names = |body| {
        links
            .iter()
            .filter(move |l| l.frame.body() == body)
            .map(|l| l.name.as_str())
    };
    without.map(|body| names(body).collect()).collect()
}

/// Finds names that more than one body has. Exclusions refer to bodies by name.
fn twice(judged: &JudgedJob<'_>) -> Vec<Discrepancy> {
    let again = bodies_named_twice(judged.robot, &judged.job.workcell, judged.plates().len());
    let wrong = again
        .into_iter()
        .map(|name| Discrepancy::new(format!("bodies named {name:?}"), "more than one", "one"));
    wrong.collect()
}

/// Returns the names that more than one body has, in a workcell with so many plates.
pub(crate) fn bodies_named_twice(robot: &RobotModel, world: &Workcell, plates: usize) -> Vec<String> {
    let links = robot.links().iter().filter(|link| !link.collision.is_empty());
    let names = links
        .map(|link| link.name.clone())
        .chain(world.tool.bodies.iter().map(|body| body.name.clone()))
        .chain(["sponge".to_owned()])
        .chain(world.obstacles.iter().map(|obstacle| obstacle.name.clone()))
        .chain((0..plates).map(plate_name));
    let mut known = BTreeSet::new();
    names.filter(|name| !known.insert(name.clone())).collect()
}

fn exclusion_text(exclusion: &Exclusion) -> String {
    let [a, b] = &exclusion.pair;
    format!("{a:?} and {b:?}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_fixtures::kitchen;
    use platewash_workcell::ExclusionReason;
    use platewash_workcell::job::JobTerms;

    #[test]
    fn only_pairs_that_follow_from_the_arm_are_excluded_without_a_waiver() {
        let job = kitchen();
        let mut terms = job.terms().clone();
        let waived = |terms: &JobTerms| {
            let judged = JudgedJob::new(terms, job.arm(), Vec::new());
            Exclusions::find(&judged).unwrap().waived
        };
        assert_eq!(waived(&terms), []);
        let added = Exclusion {
            pair: ["handle".to_owned(), "link_2".to_owned()],
            reason: ExclusionReason::Srdf,
        };
        terms.workcell.exclusions.push(added.clone());
        assert_eq!(waived(&terms), [added]);
    }
}
