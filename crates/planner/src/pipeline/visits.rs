//! All plates, one after the other.
//!
//! A plate for which no way was found to wash it whole: why.

use crate::error::PlanError;
use crate::pattern::{Margin, Pattern, Promise, SampledWash};
use crate::pipeline::places::nearest_place;
use crate::pipeline::shared::Pipeline;
use crate::pipeline::visit::{self, Turn, Visit, turned, turned_as};
use crate::placed_arm::PlacedArm;
use crate::redundancy::beyond_reach::{required_share, share_beyond_reach};
use crate::redundancy::washability::{self, WashablePart};
use crate::redundancy::{self, RedundancyError, Task, Washing};
use crate::unwashable_plate::{PlaceSearch, UnwashablePlate};
use crate::watch::{Activity, Watch};
use nalgebra::Vector3;
use platewash_bodies::job::WashJob;
use platewash_kinematics::JointVector;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::wash_path::WashPath;
use rayon::prelude::*;

/// Time of a wash over the estimate for its pattern from which on others are timed, too.
const UNEXPECTED: f64 = 1.3;

/// A plate for which no configurations were found.
#[derive(Debug)]
pub(crate) struct FailedVisit {
    /// Wash path of the plate.
    pub path: WashPath,
    /// The configuration not far from which it was to start \[rad\].
    pub near: JointVector,
    /// Error with which the search ended.
    pub error: RedundancyError,
}

/// Function that finds the washing along a path from a configuration not far from the one given.
type FindWashing<P> = fn(&P, &PlacedArm<'_>, &WashPath, &JointVector) -> Result<Turn, RedundancyError>;

impl Pipeline<'_> {
    pub fn visits(&self, placed: &PlacedArm<'_>, order: &[usize]) -> Result<Vec<Visit>, PlanError> {
        // At once, before others are searched for minutes.
        for k in 0..order.len() {
            if let Some(failed) = self.blocked(placed, order, k)? {
                return Err(self.unwashable(placed, failed));
            }
        }
        let mut visits: Vec<Visit> = Vec::with_capacity(order.len());
        for turn in self.turns(placed, order, Self::quickest_washing, |_| true) {
            let mut turn = turn.map_err(|failed| self.unwashable(placed, *failed))?;
            self.check_promise(&turn)?;
            let wash = match turn.wash.take() {
                Some(wash) => wash,
                None => turn.timed(self, placed)?,
            };
            let Turn { path, washing, .. } = turn;
            visits.push(Visit {
                lines: visit::lines(self, placed, &path, &washing)?,
                path,
                washing,
                wash,
            });
        }
        Ok(visits)
    }

    /// Returns the `k`-th plate of an order if a check of a few points shows that it cannot be washed, and no policy of tilts
    /// washes it either.
    pub fn blocked(&self, placed: &PlacedArm<'_>, order: &[usize], k: usize) -> Result<Option<FailedVisit>, Cancelled> {
        placed.check_cancelled()?;
        let near = self.near_rad;
        let path = self.path_of(placed, order, k);
        let task = |path: &WashPath| Task::new(placed, path, self.clearance_m(), &near);
        let Ok(widest) = task(&path) else {
            return Ok(None);
        };
        if !redundancy::is_blocked(&widest)? {
            return Ok(None);
        }
        let farther_in = self.patterns[path.plate].farther_in();
        if let Some(Ok(farther_in)) = farther_in.map(|pattern| task(&by_pattern(&path, &pattern)))
            && !redundancy::is_blocked(&farther_in)?
        {
            return Ok(None);
        }
        self.report_visit(order, k);
        // A tilt between those of the search may still do.
        let error = redundancy::washing(&widest).err();
        Ok(error.map(|error| FailedVisit { path, near, error }))
    }

    /// Returns the washings of the plates that are `wanted`, in order; each starts where the last one ended. Plates that fail are
    /// left out.
    pub fn turns(
        &self,
        placed: &PlacedArm<'_>,
        order: &[usize],
        washing: FindWashing<Self>,
        wanted: impl Fn(usize) -> bool,
    ) -> impl Iterator<Item = Result<Turn, Box<FailedVisit>>> {
        let mut near = self.near_rad;
        let turns = (0..order.len()).filter(move |&k| wanted(order[k]));
        turns.map(move |k| {
            self.report_visit(order, k);
            let path = self.path_of(placed, order, k);
            match washing(self, placed, &path, &near) {
                Ok(turn) => {
                    near = turn.washing.q.last().copied().unwrap_or(near);
                    Ok(turn)
                }
                Err(error) => Err(Box::new(FailedVisit { path, near, error })),
            }
        })
    }

    fn report_visit(&self, order: &[usize], k: usize) {
        let (plate, turn, of) = (order[k], k + 1, order.len());
        (self.watch.tell)(&Activity::Wash { plate, turn, of });
    }

    /// The wash path on the `k`-th plate of an order: the one asked for, or one that ends towards the next plate, or home.
    pub fn path_of(&self, placed: &PlacedArm<'_>, order: &[usize], k: usize) -> WashPath {
        let home = || self.home_tip(placed, &self.terms.home_rad[1]);
        let next = order.get(k + 1).map(|&next| self.plates[next].centre());
        let path = self.widest_path(order[k], &next.unwrap_or_else(home));
        let asked = self.asked_paths.iter().find(|asked| asked.plate == path.plate);
        asked.map_or(path, |asked| WashPath {
            curve: asked.curve,
            ..path
        })
    }

    /// The wash path on a plate by the pattern that is tried first, with the widest cone of all.
    pub fn widest_path(&self, plate: usize, towards: &Vector3<f64>) -> WashPath {
        let pattern = self.patterns[plate].widest();
        WashPath {
            plate,
            curve: turned(pattern.curve, &self.plates[plate].local(towards)),
            lift_m: self.settings.lift_m,
            cone_rad: pattern.cone_rad,
        }
    }

    /// The washing of a plate by its patterns, with a path that ends where `like` does: by the first with which the arm finds a way and
    /// presses as is promised with a margin, or else without one; where it never presses so, by one with which it finds a way. Denser and
    /// slower patterns are tried last, where the arm finds a way by another one and does not press so with a little margin; one that stays farther
    /// from the rim where it finds none.
    pub fn washing_by_patterns(
        &self,
        placed: &PlacedArm<'_>,
        like: &WashPath,
        near: &JointVector,
    ) -> Result<Turn, RedundancyError> {
        let plate = like.plate;
        let patterns = &self.patterns[plate];
        let mut found: Result<Turn, RedundancyError> = Err(RedundancyError::Plate { plate, count: 0 });
        let mut offered = patterns.first().chain(patterns.wider_patterns());
        let mut denser = patterns.denser();
        let mut farther_in = std::iter::once_with(|| patterns.farther_in()).flatten();
        // Samples of the washing found, where the job promises contact.
        let mut samples: Option<SampledWash> = None;
        // True where it lacks a little of the margin, once that is checked.
        let mut lacks = None;
        loop {
            let Some(pattern) = offered.next().or_else(|| {
                if found.is_err() {
                    return farther_in.next();
                }
                let samples = samples.as_ref()?;
                let lacks = lacks.get_or_insert_with(|| samples.shortfall(&Margin::CLOSE).is_some());
                lacks.then(|| denser.next())?
            }) else {
                return found;
            };
            match self.washing_by(placed, like, near, &pattern) {
                Err(RedundancyError::Cancelled(cancelled)) => return Err(cancelled.into()),
                // The last error is reported: that of the widest cone.
                Err(error) => found = found.or(Err(error)),
                Ok((mut turn, sampled)) => {
                    let shortfall = |margin| sampled.as_ref().and_then(|sampled| sampled.shortfall(margin));
                    if shortfall(&Margin::ARM).is_none() {
                        return Ok(turn);
                    }
                    turn.shortfall = shortfall(&Margin::NONE);
                    let is_better = found
                        .as_ref()
                        .map_or(true, |found| found.shortfall.is_some() && turn.shortfall.is_none());
                    if is_better {
                        (found, samples, lacks) = (Ok(turn), sampled, None);
                    }
                }
            }
        }
    }

    /// The washing of [`washing_by_patterns`](Self::washing_by_patterns), timed; where the arm takes much longer than estimated, the quickest
    /// of this one and of those by the next patterns of the same cone.
    fn quickest_washing(
        &self,
        placed: &PlacedArm<'_>,
        like: &WashPath,
        near: &JointVector,
    ) -> Result<Turn, RedundancyError> {
        let mut best = self.washing_by_patterns(placed, like, near)?;
        if best.shortfall.is_some() {
            return Ok(best);
        }
        // An error of the timing is reported by the caller that needs it.
        let Ok(wash) = best.timed(self, placed) else {
            return Ok(best);
        };
        let mut time_s = wash.motion.duration_s();
        best.wash = Some(wash);
        let tried = best.pattern;
        if time_s < UNEXPECTED * tried.time_s {
            return Ok(best);
        }
        for pattern in self.patterns[like.plate].after(tried) {
            match self.washing_by(placed, like, near, &pattern) {
                Err(RedundancyError::Cancelled(cancelled)) => return Err(cancelled.into()),
                Ok((mut turn, sampled))
                    if sampled
                        .as_ref()
                        .is_none_or(|sampled| sampled.shortfall(&Margin::ARM).is_none()) =>
                {
                    turn.wash = turn.timed(self, placed).ok();
                    let other_s = turn
                        .wash
                        .as_ref()
                        .map_or(f64::INFINITY, |wash| wash.motion.duration_s());
                    if other_s < time_s {
                        (best, time_s) = (turn, other_s);
                    }
                }
                _ => {}
            }
        }
        Ok(best)
    }

    /// The washing of a plate by a pattern, with a path that ends where `like` does, and its samples where the job promises contact.
    fn washing_by(
        &self,
        placed: &PlacedArm<'_>,
        like: &WashPath,
        near: &JointVector,
        pattern: &Pattern,
    ) -> Result<(Turn, Option<SampledWash>), RedundancyError> {
        let path = by_pattern(like, pattern);
        let turn = Turn {
            path,
            washing: self.washing(placed, &path, near)?,
            pattern: *pattern,
            shortfall: None,
            wash: None,
        };
        let sampled = self.sampled(placed, &turn);
        Ok((turn, sampled))
    }

    /// Samples of a plate's washing at its configurations; `None` without a promise about contact.
    fn sampled(&self, placed: &PlacedArm<'_>, turn: &Turn) -> Option<SampledWash> {
        self.terms.requirements.contact?;
        let plate = &self.plates[turn.path.plate];
        let promise = Promise::new(self.terms, plate);
        let speed_m_s = turn.pattern.speed_share * self.terms.wash_speed_of(plate);
        Some(promise.sampled(placed, plate, &turn.washing.q, speed_m_s))
    }

    /// Refuses a washing with a chosen curve if no plan of it could be proved; the certificate judges stated curves.
    pub fn check_promise(&self, turn: &Turn) -> Result<(), PlanError> {
        let plate = turn.path.plate;
        match turn.shortfall {
            Some(shortfall) if self.patterns[plate].is_chosen() => Err(PlanError::Promise { plate, shortfall }),
            _ => Ok(()),
        }
    }

    /// The washing along a path from a configuration not far from `near` \[rad\].
    pub fn washing(
        &self,
        placed: &PlacedArm<'_>,
        path: &WashPath,
        near: &JointVector,
    ) -> Result<Washing, RedundancyError> {
        redundancy::washing(&Task::new(placed, path, self.clearance_m(), near)?)
    }
}

/// The path by a pattern that ends where another one does.
fn by_pattern(like: &WashPath, pattern: &Pattern) -> WashPath {
    WashPath {
        curve: turned_as(pattern.curve, &like.curve),
        cone_rad: pattern.cone_rad,
        ..*like
    }
}

/// Lists every plate of a job that cannot be washed whole or for which no way was found, with its obstructions, by index. Other
/// places are not searched for, and transits are not checked: a job without an entry here may still fail to be planned.
///
/// The one that [`plan_here`](crate::plan_here) reports is among them, with the same words.
///
/// # Errors
/// [`PlanError`] of the input, an end configuration that is not clear, and [`PlanError::Cancelled`].
pub fn unwashable_plates(job: &WashJob, watch: &Watch<'_>) -> Result<Vec<UnwashablePlate>, PlanError> {
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_homes()?;
    let placed = pipeline.placed()?;
    let (order, _) = pipeline.order(&placed)?;
    let failed = pipeline.failed(&placed, &order)?;
    let why = |failed: FailedVisit| pipeline.explain(&placed, failed);
    let plates: Result<Vec<UnwashablePlate>, Cancelled> = failed.into_par_iter().map(why).collect();
    let mut plates = plates?;
    plates.sort_unstable_by_key(|plate| plate.plate);
    Ok(plates)
}

/// The other plates of a job that [`plan_with`](crate::plan_with) fails for `first`: those of [`unwashable_plates`], where that looked for
/// another place each with its own, found with those before it, `first` among them, where they could be washed.
///
/// # Errors
/// As [`unwashable_plates`].
pub fn other_unwashable_plates(
    job: &WashJob,
    first: &UnwashablePlate,
    watch: &Watch<'_>,
) -> Result<Vec<UnwashablePlate>, PlanError> {
    let mut others = unwashable_plates(job, watch)?;
    others.retain(|other| other.plate != first.plate);
    let PlaceSearch::Within(_) = first.place_search else {
        return Ok(others);
    };
    let mut plates = job.terms().plates.clone();
    let mut before = first;
    for other in &mut others {
        if let Some(nearest_m) = before.nearest_m {
            plates[before.plate] = plates[before.plate].moved_to(nearest_m);
        }
        // Places that were found suit obstacles and plates too.
        let job = job.on_plates(plates.clone())?;
        other.nearest_m = nearest_place(&job, other.plate, watch)?;
        other.place_search = first.place_search;
        before = other;
    }
    Ok(others)
}

impl Pipeline<'_> {
    /// Returns all plates for which no configurations are found: those that a check of a few points rules out, and those whose
    /// washing fails.
    fn failed(&self, placed: &PlacedArm<'_>, order: &[usize]) -> Result<Vec<FailedVisit>, Cancelled> {
        let turns = (0..order.len()).into_par_iter();
        let blocked: Result<Vec<_>, Cancelled> = turns.map(|k| self.blocked(placed, order, k)).collect();
        let mut failed: Vec<FailedVisit> = blocked?.into_iter().flatten().collect();
        let known: Vec<usize> = failed.iter().map(|failed| failed.path.plate).collect();
        let others = self.turns(placed, order, Self::washing_by_patterns, |plate| {
            !known.contains(&plate)
        });
        failed.extend(others.filter_map(Result::err).map(|failed| *failed));
        placed.check_cancelled()?;
        Ok(failed)
    }

    /// Looks into a plate for which no configurations were found.
    pub fn unwashable(&self, placed: &PlacedArm<'_>, failed: FailedVisit) -> PlanError {
        match self.with_place(placed, failed) {
            Ok(plate) => PlanError::Unwashable(Box::new(plate)),
            Err(cancelled) => cancelled.into(),
        }
    }

    /// Returns the cause, and the nearest other place for the plate if the job asks for it.
    fn with_place(&self, placed: &PlacedArm<'_>, failed: FailedVisit) -> Result<UnwashablePlate, Cancelled> {
        let (path, near) = (failed.path, failed.near);
        let plate = self.explain(placed, failed)?;
        let nearest_m = match self.place_search {
            PlaceSearch::Within(_) => self.nearest(placed, &path, &near)?,
            PlaceSearch::Off | PlaceSearch::Later => None,
        };
        placed.check_cancelled()?;
        Ok(UnwashablePlate { nearest_m, ..plate })
    }

    /// Returns the cause, without a search for another place.
    fn explain(&self, placed: &PlacedArm<'_>, failed: FailedVisit) -> Result<UnwashablePlate, Cancelled> {
        let FailedVisit { path, near, error } = failed;
        if let RedundancyError::Cancelled(cancelled) = error {
            return Err(cancelled);
        }
        let plate = path.plate;
        (self.watch.tell)(&Activity::Cause { plate });
        let part = match Task::new(placed, &path, self.clearance_m(), &near) {
            Ok(task) if self.explains => washability::washable_part(&task)?,
            _ => None,
        };
        let share = part.as_ref().map(|part| part.share);
        let WashablePart { causes, points, .. } = part.unwrap_or_default();
        let lies = &self.plates[plate];
        Ok(UnwashablePlate {
            plate,
            centre_m: placed.centre_in_world(lies),
            error,
            beyond_reach_share: share_beyond_reach(self.robot, self.terms, lies),
            required_share: required_share(self.terms, lies),
            tilt_max_rad: self.terms.tilt_max_rad(),
            share,
            causes,
            free_m: points.free_m,
            dead_m: points.dead_m,
            nearest_m: None,
            place_search: self.place_search,
        })
    }
}
