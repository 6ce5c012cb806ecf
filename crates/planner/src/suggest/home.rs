//! A home with clearance: the tool points down over the plates, far from everything, from limits and singularities.

use crate::error::PlanError;
use crate::near_pair::NearPair;
use crate::placed_arm::{Contact, PlacedArm, Stretch, Width};
use nalgebra::Vector3;
use platewash_bodies::clearance::{ClearanceModel, PairClearance};
use platewash_kinematics::model::manipulability;
use platewash_kinematics::trig::{atan2, sin_cos};
use platewash_kinematics::{AXES, Axes, JointVector, RobotModel, halton};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_6;

/// Places of the tip that are tried, where all branches are known; fewer where each is a search.
const PLACES: u32 = 256;
const SEARCHED_PLACES: u32 = 64;
/// Clear configurations after which no further places are tried: an arm with eight branches at most places has them soon.
const ENOUGH_CLEAR: usize = 256;

/// Configurations that are tried where the tool points down at none of the places.
const ANYWHERE: u32 = 4000;

/// Distance of the tip from axis 1, and its height above the highest plate, as parts of the arm's reach.
const AWAY: [f64; 2] = [0.3, 0.65];
const ABOVE: [f64; 2] = [0.08, 0.35];

/// Largest sideways distance of the tip from the middle of plates that are not level with the base, as a part of the arm's reach;
/// and the least cosine of the angle to the axis of the base of plates that count as level.
const BESIDE: f64 = 0.2;
const LEVEL: f64 = 0.99;

/// More clearance of a pair than this \[m\], or than it has anywhere; farther from a limit than this \[rad\], and more manipulable than this part of the best is of no use.
const ENOUGH_M: f64 = 0.1;
const ENOUGH_RAD: f64 = FRAC_PI_6;
const ENOUGH_MANIPULABLE: f64 = 0.5;

/// A configuration to start from and return to.
#[derive(Debug, Clone, PartialEq)]
pub struct SuggestedHome {
    /// Joint positions in whole degrees \[deg\].
    pub q_deg: [f64; AXES],
    /// The nearest bodies there; `None` where nothing could touch.
    pub nearest: Option<PairClearance>,
    /// Distance of the joint nearest to a limit from that limit \[rad\]; infinite without limits.
    pub margin_rad: f64,
    /// The angle between the tool and the way straight onto the plates \[rad\].
    pub tilt_rad: f64,
    /// Configurations that were clear, out of which it is the best.
    pub clear: usize,
}

impl SuggestedHome {
    /// Joint positions \[rad\].
    #[must_use]
    pub fn q_rad(&self) -> JointVector {
        JointVector::from(self.q_deg).map(f64::to_radians)
    }
}

/// A candidate.
struct Candidate {
    q_deg: [f64; AXES],
    /// Distances of all pairs \[m\].
    distances_m: Vec<f64>,
    margin_rad: f64,
    manipulability: f64,
}

/// Suggests a home for terms, without regard to their own. Of many configurations with the tool pointing down over the plates, it
/// returns the best one by clearance, pair by pair, distance from limits and manipulability together, each up to a useful bound.
/// It keeps the clearance asked for among the plates of the terms.
///
/// The search draws nothing: the same arm, tool, obstacles and plates have the same home, for any number of threads.
///
/// # Errors
/// [`PlanError::NoHome`] where no configuration that was tried is clear, and [`PlanError`] for an arm or a tool with which nothing can be
/// planned.
pub fn suggest_home(robot: &RobotModel, terms: &JobTerms, cancel: &CancelToken) -> Result<SuggestedHome, PlanError> {
    search(robot, terms, cancel, best_home)
}

/// Returns the pairs of bodies that are too near in some of many configurations over all of the joints' limits, those first that are so in most
/// of them.
///
/// # Errors
/// [`PlanError`] for an arm or a tool with which nothing can be planned.
pub fn near_pairs(robot: &RobotModel, terms: &JobTerms, cancel: &CancelToken) -> Result<Vec<NearPair>, PlanError> {
    search(robot, terms, cancel, |search| search.in_the_way())
}

/// Sets up the search for a home, and carries out a part of it.
fn search<T>(
    robot: &RobotModel,
    terms: &JobTerms,
    cancel: &CancelToken,
    carry_out: impl Fn(&Search<'_>) -> Result<T, PlanError>,
) -> Result<T, PlanError> {
    let terms = &*terms.seen_from_base();
    let clearance = ClearanceModel::new(robot, &terms.workcell, &terms.plates)?;
    let reach = terms.planner_settings().ok_or(PlanError::PaperJob)?.reach;
    let placed = PlacedArm::new(robot, &terms.workcell.tool, &clearance, &terms.plates, reach)?.with_cancel(cancel);
    carry_out(&Search {
        placed: &placed,
        terms,
        clearance: &clearance,
    })
}

fn best_home(search: &Search<'_>) -> Result<SuggestedHome, PlanError> {
    let (placed, clearance) = (search.placed, search.clearance);
    let mut found = search.over_plates()?;
    if found.is_empty() {
        found = search.anywhere()?;
    }
    let most = found.iter().map(|c| c.manipulability).fold(0.0, f64::max);
    // Some pairs are near in every configuration: a forearm and the tool before it.
    let pairs = clearance.pair_names().len();
    let widest = |pair: usize| found.iter().map(|c| c.distances_m[pair]).fold(0.0, f64::max);
    let enough: Vec<f64> = (0..pairs).map(|pair| widest(pair).min(ENOUGH_M)).collect();
    let score = |c: &Candidate| {
        let share = |value: f64, enough: f64| (value / enough).min(1.0);
        let clear = c
            .distances_m
            .iter()
            .zip(&enough)
            .map(|(at, enough)| share(*at, *enough));
        clear.fold(1.0, f64::min) * share(c.margin_rad, ENOUGH_RAD) * share(c.manipulability, ENOUGH_MANIPULABLE * most)
    };
    // Of equals the first: places come in the order of the sequence.
    let best = found.iter().rev().max_by(|a, b| score(a).total_cmp(&score(b)));
    let Some(best) = best else {
        let tried = ANYWHERE as usize;
        let in_the_way = search.in_the_way()?;
        return Err(PlanError::NoHome { tried, in_the_way });
    };
    let q = JointVector::from(best.q_deg).map(f64::to_radians);
    let tool = placed.robot.fk(&q).rigid(&placed.tip).rotation.column(2).into_owned();
    let down = -search.outward_direction();
    Ok(SuggestedHome {
        q_deg: best.q_deg,
        nearest: clearance.smallest(&q, &[]),
        margin_rad: best.margin_rad,
        tilt_rad: atan2(tool.cross(&down).norm(), tool.dot(&down)),
        clear: found.len(),
    })
}

/// Two directions across another one.
fn spanning(out: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let least = if out.x.abs() < out.y.abs() {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let across = out.cross(&least).normalize();
    [across, out.cross(&across)]
}

struct Search<'a> {
    placed: &'a PlacedArm<'a>,
    terms: &'a JobTerms,
    clearance: &'a ClearanceModel,
}

impl Search<'_> {
    /// The clear configurations whose tool points down at places around the middle of the plates.
    fn over_plates(&self) -> Result<Vec<Candidate>, PlanError> {
        let placed = self.placed;
        let places = if placed.inverse.knows_all_branches() {
            PLACES
        } else {
            SEARCHED_PLACES
        };
        let limits = placed.robot.limits();
        let near = JointVector::from_fn(|joint, _| {
            let whole_turns = limits.turned_inside(joint, 0.0);
            whole_turns.unwrap_or(0.0_f64.clamp(limits.lower[joint], limits.upper[joint]))
        });
        let at = |k: u32| {
            placed.check_cancelled()?;
            let target = placed.tip_rigid(&Contact::on_normal(self.place(k), self.outward_direction()), 0.0);
            let starts = placed.inverse.starts(&target, &near, Width::Near).unwrap_or_default();
            Ok(starts.iter().filter_map(|start| self.candidate(&start.q)).collect())
        };
        let mut clear = Vec::new();
        for first in (1..=places).step_by(SEARCHED_PLACES as usize) {
            let some = first..first + SEARCHED_PLACES;
            let found: Result<Vec<Vec<Candidate>>, PlanError> = some.into_par_iter().map(at).collect();
            clear.extend(found?.into_iter().flatten());
            if clear.len() >= ENOUGH_CLEAR {
                break;
            }
        }
        Ok(clear)
    }

    /// The clear configurations of an even spread within the limits.
    fn anywhere(&self) -> Result<Vec<Candidate>, PlanError> {
        let at = |k: u32| {
            self.placed.check_cancelled()?;
            Ok(self.candidate(&self.spread(k)))
        };
        let found: Result<Vec<Option<Candidate>>, PlanError> = (1..=ANYWHERE).into_par_iter().map(at).collect();
        Ok(found?.into_iter().flatten().collect())
    }

    /// Configuration `k` of an even spread within the limits \[rad\].
    fn spread(&self, k: u32) -> JointVector {
        let (limits, share) = (self.placed.robot.limits(), halton::point(k));
        JointVector::from_fn(|joint, _| {
            let [lower, upper] = limits.sampling_range(joint);
            lower + share[joint] * (upper - lower)
        })
    }

    /// The pairs that are too near in some of these configurations, those first that are so in most of them.
    fn in_the_way(&self) -> Result<Vec<NearPair>, PlanError> {
        let distances = |k: u32| {
            self.placed.check_cancelled()?;
            Ok(self.clearance.all(&self.spread(k)))
        };
        let all: Result<Vec<Vec<PairClearance>>, PlanError> = (1..=ANYWHERE).into_par_iter().map(distances).collect();
        let (all, names) = (all?, self.clearance.pair_names());
        let of = |(index, (a, b)): (usize, &(&str, &str))| {
            let each = || all.iter().filter_map(|pairs| pairs.get(index));
            NearPair {
                pair: [(*a).to_owned(), (*b).to_owned()],
                count: each().filter(|pair| !pair.is_clear(self.required_m())).count(),
                tried: all.len(),
                is_of_arm: [a, b].iter().all(|name| self.clearance.is_of_arm(name)),
                most_m: each().map(|pair| pair.distance_m).fold(f64::NEG_INFINITY, f64::max),
            }
        };
        let mut near: Vec<_> = names.iter().enumerate().map(of).filter(|near| near.count > 0).collect();
        near.sort_by_key(|near| std::cmp::Reverse(near.count));
        Ok(near)
    }

    /// Clearance required of all pairs at a home \[m\].
    fn required_m(&self) -> f64 {
        self.terms.requirements.clearance_m + Stretch::Free.reserve_m()
    }

    /// The way out of the plates, taken together; up where there are none, or where they face all ways.
    fn outward_direction(&self) -> Vector3<f64> {
        let sum: Vector3<f64> = self.placed.plates.iter().map(Plate::axis).sum();
        sum.try_normalize(1e-3).unwrap_or_else(Vector3::z)
    }

    /// Place `k` of the tip \[m\]: over the plates' middle, beside it by up to a part of the reach. Where plates lie level with the base, in
    /// the direction of their middle, or of x where they lie around the base, give or take 30°.
    fn place(&self, k: u32) -> Vector3<f64> {
        let (from, reach_m) = self.placed.robot.reach_bound(&self.placed.tip);
        let (plates, out) = (self.placed.plates, self.outward_direction());
        let count = plates.len().max(1) as f64;
        let sum: Vector3<f64> = plates.iter().map(|plate| plate.centre() - from.coords).sum();
        let top_m = plates.iter().map(|plate| plate.centre().dot(&out)).reduce(f64::max);
        let top_m = top_m.map_or(0.0, |top_m| if out.z > LEVEL { top_m.max(0.0) } else { top_m });
        let [a, b, c, ..] = halton::point(k);
        let within = |[least, most]: [f64; 2], share: f64| reach_m * (least + share * (most - least));
        let height_m = top_m + within(ABOVE, c);
        if out.z.abs() < LEVEL {
            let [across, along] = spanning(&out);
            let middle = from.coords + sum / count;
            let beside = across * ((2.0 * a - 1.0) * BESIDE * reach_m) + along * ((2.0 * b - 1.0) * BESIDE * reach_m);
            return middle + beside + out * (height_m - middle.dot(&out));
        }
        let middle = sum.xy() / count;
        let towards = if middle.norm() > 0.1 * reach_m {
            atan2(middle.y, middle.x)
        } else {
            0.0
        };
        let (s, cosine) = sin_cos(towards + (2.0 * b - 1.0) * FRAC_PI_6);
        let away = within(AWAY, a);
        Vector3::new(from.x + away * cosine, from.y + away * s, height_m * out.z.signum())
    }

    /// The configuration in whole degrees, where it is within the limits and clear.
    fn candidate(&self, q: &JointVector) -> Option<Candidate> {
        let q_deg = q.map(|rad| rad.to_degrees().round() + 0.0);
        let q = q_deg.map(f64::to_radians);
        let limits = self.placed.robot.limits();
        if !limits.contain(&q) || !self.clearance.keeps_clearance(&q, self.required_m()) {
            return None;
        }
        let jacobian = self.placed.robot.fk(&q).jacobian(&self.placed.tip, Axes::Base);
        Some(Candidate {
            q_deg: q_deg.into(),
            distances_m: self.clearance.all(&q).iter().map(|pair| pair.distance_m).collect(),
            margin_rad: limits.margins(&q).min(),
            manipulability: manipulability(&jacobian),
        })
    }
}
