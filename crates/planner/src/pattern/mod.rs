//! The curve of the tip on a plate: pitch, pattern and tilt chosen together, for a short wash that keeps the promises of the job.
//!
//! A curve that the job states is kept; parameters that it leaves out are chosen. Candidates (`candidates.rs`) are tried in order
//! of their estimated times: those are taken that bring enough of the bare face into contact (`promise.rs`), with the tool by its
//! rule, at the speed limit or at the greatest share of it that leaves enough time of contact. Where there is none, denser ones are
//! tried. Each plate is checked again with the arm's own tilts. Where the curve fails there, or the arm finds no way along it, or
//! takes longer than estimated, the next ones are tried.

mod candidates;
mod promise;
mod shortfall;
#[cfg(test)]
mod tests;

pub(crate) use crate::pattern::candidates::length_m;
pub(crate) use crate::pattern::promise::foundation;
pub use crate::pattern::promise::{Margin, Promise, SampledWash};
pub use crate::pattern::shortfall::{ContactPromise, Shortfall};

use crate::pattern::candidates::{ByTime, Candidate, Estimate, candidates};
use crate::pattern::promise::Kept;
use crate::placed_arm::{AXIS_SHARE, AxisRule};
use crate::timing::TipLimits;
use platewash_kinematics::trig::atan2;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::{JobTerms, PlannerSettings};
use platewash_workcell::plate::Plate;
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{CandidateRequest, Density, TRIMS_RAD, WashCurve, WashPath};
use std::sync::OnceLock;

/// Contact height on a flat face that the tilt of the tool may use up, besides the promised part \[m\]: a reserve for the error
/// of the tip.
const HEIGHT_RESERVE_M: f64 = 2e-4;

/// The share of the cone that leaves the whole sponge in contact which is tried first: tilted less, the sponge presses more evenly.
const NARROW: f64 = 0.5;

/// Share of the cone for places that are not reached with the narrow one.
const WIDE: f64 = 0.85;

/// Margins with which patterns are offered within a cone: the second one is for plates on which the arm presses less.
const OFFERED: [Margin; 2] = [Margin::BARE_FACE, Margin::STEADY];

/// Least share of the wash speed that is tried where a curve does not keep the promise at full speed.
const SLOWEST: f64 = 0.1;

/// Curves that are too quick at full speed among which is chosen.
const MOST_HASTY: usize = 12;

/// Radius of curves that stay farther from the rim, as a share of that of the others.
const INWARDS: f64 = 0.998;

/// Least share of the speed along a whole curve with which a trimmed one is quicker.
const TRIMMED: f64 = 0.97;

/// Denser and slower curves among which is chosen.
const MOST_SLOWED: usize = 4;

/// A curve and how far the tool may lean along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pattern {
    /// The curve; its first angle is for each plate to choose.
    pub curve: WashCurve,
    /// Largest angle of the tool from the normal of the face \[rad\].
    pub cone_rad: f64,
    /// The share of the speed limit of washing at which it is followed at most.
    pub speed_share: f64,
    /// Estimated time from rest to rest \[s\].
    pub time_s: f64,
}

impl Pattern {
    /// A curve within a cone at full speed.
    fn at_full_speed(estimate: &Estimate, cone_rad: f64) -> Self {
        Self {
            curve: estimate.curve,
            cone_rad,
            speed_share: 1.0,
            time_s: estimate.time_s,
        }
    }
}

/// The patterns to try on a surface.
#[derive(Debug, Clone)]
pub struct Patterns {
    surface: Surface,
    promise: Promise,
    rule: AxisRule,
    /// Limits of washing: the greatest speed, and the greatest acceleration in every direction, of the job and of the arm.
    limits: TipLimits,
    /// Curves among which is chosen; at least one.
    candidates: Vec<Candidate>,
    /// True where the job promises something about contact.
    has_contact: bool,
    /// Curves that cover the face more densely.
    dense: Vec<WashCurve>,
    /// The cones to plan with, the best first; at least one.
    cones: Vec<f64>,
    /// Patterns of each cone, those of each cone where there are none, and slower ones of each cone, once they were asked for.
    quick: Vec<[OnceLock<Option<Pattern>>; OFFERED.len()]>,
    instead: Vec<OnceLock<Vec<Pattern>>>,
    slower: Vec<OnceLock<Vec<Pattern>>>,
    /// Pattern farther from the rim, once it was asked for.
    farther_in: OnceLock<Option<Pattern>>,
    /// Token that ends the search for patterns; the patterns found by then are offered.
    cancel: CancelToken,
}

impl Patterns {
    /// Returns the patterns that a job offers on a plate where the arm accelerates the tip by up to `arm_m_s2` \[m/s²\].
    #[must_use]
    pub fn new(
        terms: &JobTerms,
        settings: &PlannerSettings,
        plate: &Plate,
        arm_m_s2: f64,
        cancel: &CancelToken,
    ) -> Self {
        let (surface, promise) = (&plate.surface, Promise::new(terms, plate));
        let limits = TipLimits {
            speed_m_s: terms.wash_speed_of(plate),
            acceleration_m_s2: terms.wash_acceleration_m_s2().min(arm_m_s2),
        };
        let laps = terms.passes_of(plate);
        let curves = |density| {
            let request = CandidateRequest {
                stated: settings.stated_numbers(),
                surface,
                sponge_m: promise.foundation.radius_m,
                density,
                laps,
            };
            candidates(settings.pattern, &request)
        };
        let usual = curves(Density::Usual).into_iter();
        let candidates = usual.map(|curve| Candidate::new(curve, surface, &limits)).collect();
        let cones = cones(terms, settings, plate);
        Self {
            surface: *surface,
            promise,
            rule: AxisRule::new(surface, settings.axis_share.unwrap_or(AXIS_SHARE)),
            limits,
            candidates,
            has_contact: terms.requirements.contact.is_some(),
            dense: curves(Density::Dense),
            quick: vec![Default::default(); cones.len()],
            instead: vec![OnceLock::new(); cones.len()],
            slower: vec![OnceLock::new(); cones.len()],
            farther_in: OnceLock::new(),
            cones,
            cancel: cancel.clone(),
        }
    }

    /// The same offer with one curve and one cone alone: those of another plan.
    #[must_use]
    pub fn along(&self, path: &WashPath) -> Self {
        Self {
            candidates: vec![Candidate::new(path.curve, &self.surface, &self.limits)],
            dense: Vec::new(),
            cones: vec![path.cone_rad],
            quick: vec![Default::default()],
            instead: vec![OnceLock::new()],
            slower: vec![OnceLock::new()],
            farther_in: OnceLock::new(),
            ..self.clone()
        }
    }

    /// Patterns that are tried first, the best first; at least one.
    pub fn first(&self) -> impl Iterator<Item = Pattern> {
        self.of_cone(0)
    }

    /// Patterns of wider cones, for places that the first ones do not reach.
    pub fn wider_patterns(&self) -> impl Iterator<Item = Pattern> {
        (1..self.cones.len()).flat_map(|k| self.of_cone(k))
    }

    /// The quickest pattern with the widest cone that stays farther from the rim than those tried first, for plates on which the arm does
    /// not reach as far out as these.
    pub fn farther_in(&self) -> Option<Pattern> {
        let Pattern { cone_rad, curve, .. } = self.widest();
        let search = || self.quickest(cone_rad, &Margin::BARE_FACE, INWARDS * curve.radius_m);
        *self.farther_in.get_or_init(search)
    }

    /// Patterns of the same cone that come after another one.
    pub fn after(&self, pattern: Pattern) -> impl Iterator<Item = Pattern> {
        let cone = self.cones.iter().position(|cone| *cone == pattern.cone_rad);
        let all = cone.into_iter().flat_map(|k| self.of_cone(k));
        all.skip_while(move |other| *other != pattern).skip(1)
    }

    /// The quickest candidates that keep the promise within a cone; where there are none, denser or slower ones, and a stated curve
    /// at full speed before these.
    fn of_cone(&self, k: usize) -> impl Iterator<Item = Pattern> {
        let quick = (0..OFFERED.len()).filter_map(move |n| self.quick(k, n));
        let instead = || self.instead[k].get_or_init(|| self.instead(self.cones[k]));
        let instead = self.quick(k, 0).is_none().then(instead);
        quick.chain(instead.into_iter().flatten().copied())
    }

    /// Denser and slower patterns, for plates on which the arm presses less of the face than the estimate on the bare face.
    pub fn denser(&self) -> impl Iterator<Item = Pattern> {
        let cones = self.cones.iter().zip(&self.slower).filter(|_| self.is_chosen());
        let slower = |cone: f64| self.slower(cone, &Margin::WEAK_ARM);
        cones.flat_map(move |(cone, known)| known.get_or_init(|| slower(*cone)).iter().copied())
    }

    /// The first pattern with the widest cone: a place that no tilt in it reaches is out of reach for all.
    #[must_use]
    pub fn widest(&self) -> Pattern {
        let cone_rad = self.cones.iter().copied().fold(0.0, f64::max);
        let any = || Pattern::at_full_speed(&self.estimate(self.candidates[0].curve), cone_rad);
        Pattern {
            cone_rad,
            ..self.first().next().unwrap_or_else(any)
        }
    }

    /// Returns true where the curve is chosen, not stated.
    #[must_use]
    pub fn is_chosen(&self) -> bool {
        self.candidates.len() > 1
    }

    /// Patterns where none of the usual curves keeps the promise: denser or slower ones. The longest of the usual ones comes last, as
    /// the arm may lean less than is assumed here; a stated curve comes first.
    fn instead(&self, cone_rad: f64) -> Vec<Pattern> {
        let mut chosen = self.slower(cone_rad, &Margin::BARE_FACE);
        let longest = self.by_time().last();
        let longest = longest.map(|estimate| Pattern::at_full_speed(&self.whole(estimate), cone_rad));
        let place = if self.is_chosen() { chosen.len() } else { 0 };
        chosen.splice(place..place, longest);
        chosen
    }

    /// Candidates, the quickest first.
    fn by_time(&self) -> ByTime<'_> {
        ByTime::new(&self.candidates, &self.surface, &self.limits)
    }

    /// The pattern that is offered within the `k`-th cone with the `n`-th margin; none where the curve is stated.
    fn quick(&self, k: usize, n: usize) -> Option<Pattern> {
        *self.quick[k][n].get_or_init(|| self.quickest(self.cones[k], &OFFERED[n], f64::INFINITY))
    }

    /// The quickest of the usual curves that keep the promise with a margin, at the speed of washing or at a share of it.
    /// Only curves of a radius below `within_m` are considered.
    fn quickest(&self, cone_rad: f64, margin: &Margin, within_m: f64) -> Option<Pattern> {
        let least = if self.has_contact { SLOWEST } else { 1.0 };
        let (mut best, mut hasty, mut suspects): (Option<Pattern>, _, _) = (None, Vec::new(), Vec::new());
        let mut kept = |estimate: &Estimate, least| {
            let sampled = estimate.sampled(&self.promise, &self.surface, &self.rule, cone_rad);
            sampled.keeps_shares(margin, least, &mut suspects)
        };
        let is_open = |estimate: &Estimate| self.is_chosen() && estimate.curve.radius_m < within_m;
        let candidates = self.by_time().filter(is_open);
        for trimmed in candidates.take_while(|_| !self.cancel.is_cancelled()) {
            if best.is_some_and(|best| best.time_s <= trimmed.time_s) {
                break;
            }
            // What a whole ring lacks, a trimmed one lacks, too.
            let whole = self.whole(trimmed);
            match kept(&whole, least) {
                Kept::AtFullSpeed => {
                    let mut trimmed = self.trimmed(whole.curve);
                    let trimmed = trimmed.find(|estimate| kept(estimate, 1.0) == Kept::AtFullSpeed);
                    let pattern = Pattern::at_full_speed(&trimmed.unwrap_or(whole), cone_rad);
                    best = best.filter(|best| best.time_s <= pattern.time_s).or(Some(pattern));
                }
                Kept::Slower(share) => hasty.push((self.quickest_s(&whole, share), whole)),
                Kept::Never => {}
            }
        }
        hasty.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut found = 0;
        for (time_s, whole) in hasty {
            let bound_s = best.map_or(f64::INFINITY, |best| best.time_s);
            if time_s >= bound_s || found == MOST_HASTY {
                break;
            }
            let least = (whole.length_m / (self.limits.speed_m_s * bound_s)).clamp(SLOWEST, 1.0);
            let mut slowed = |curve: &Estimate, least| self.slowed(curve, cone_rad, margin, least, &mut suspects);
            if let Some(pattern) = slowed(&whole, TRIMMED * least) {
                found += 1;
                let mut trimmed = self.trimmed(whole.curve);
                let trimmed = trimmed.find_map(|estimate| slowed(&estimate, TRIMMED * pattern.speed_share));
                let quicker = [Some(pattern), trimmed]
                    .into_iter()
                    .flatten()
                    .filter(|pattern| pattern.time_s < bound_s);
                best = quicker.min_by(|a, b| a.time_s.total_cmp(&b.time_s)).or(best);
            }
        }
        best
    }

    fn estimate(&self, curve: WashCurve) -> Estimate {
        Estimate::new(curve, &self.surface, &self.limits)
    }

    /// The curve of a candidate with its whole closing ring; a stated curve as it is.
    fn whole(&self, candidate: Estimate) -> Estimate {
        if self.is_chosen() {
            self.estimate(candidate.curve.trimmed(0.0))
        } else {
            candidate
        }
    }

    /// A curve with a trimmed closing ring, by the trims that the job leaves open, the greatest first.
    fn trimmed(&self, curve: WashCurve) -> impl Iterator<Item = Estimate> {
        let trims = TRIMS_RAD.into_iter();
        let open = trims.filter(|trim_rad| *trim_rad <= self.candidates[0].curve.trim_rad);
        open.map(move |trim_rad| self.estimate(curve.trimmed(trim_rad)))
    }

    /// Lower bound of the time along a curve at a share of the wash speed \[s\].
    fn quickest_s(&self, estimate: &Estimate, share: f64) -> f64 {
        estimate.time_s.max(estimate.length_m / (share * self.limits.speed_m_s))
    }

    /// A curve with the greatest share of the wash speed, at least `least`, at which it keeps the promise with a margin.
    fn slowed(
        &self,
        estimate: &Estimate,
        cone_rad: f64,
        margin: &Margin,
        least: f64,
        suspects: &mut Vec<u32>,
    ) -> Option<Pattern> {
        let sampled = estimate.sampled(&self.promise, &self.surface, &self.rule, cone_rad);
        let speed_share = sampled.speed_share(margin, least, suspects)?;
        let pattern = Pattern::at_full_speed(estimate, cone_rad);
        if speed_share == 1.0 {
            return Some(pattern);
        }
        let limits = TipLimits {
            speed_m_s: speed_share * self.limits.speed_m_s,
            ..self.limits
        };
        Some(Pattern {
            speed_share,
            time_s: Estimate::new(estimate.curve, &self.surface, &limits).time_s,
            ..pattern
        })
    }

    /// The quickest curves, dense ones among them, each with the greatest share of the wash speed at which it keeps the promise
    /// with a margin.
    fn slower(&self, cone_rad: f64, margin: &Margin) -> Vec<Pattern> {
        if !self.has_contact {
            return Vec::new();
        }
        let (dense, mut suspects) = (self.dense.iter(), Vec::new());
        let dense = dense.map(|curve| self.estimate(*curve));
        let all = self.by_time().chain(dense);
        let all = all.take_while(|_| !self.cancel.is_cancelled());
        let kept =
            all.filter_map(|estimate| self.slowed(&self.whole(estimate), cone_rad, margin, SLOWEST, &mut suspects));
        let kept = kept.filter(|pattern| self.is_chosen() || pattern.speed_share < 1.0);
        let mut kept: Vec<Pattern> = kept.take(MOST_SLOWED).collect();
        kept.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        kept.truncate(OFFERED.len());
        kept
    }
}

/// The cones to plan with, the best first: on a flat face as wide as leaves the whole sponge in contact, where a promise asks for it.
fn cones(terms: &JobTerms, settings: &PlannerSettings, plate: &Plate) -> Vec<f64> {
    let most = terms.tilt_max_rad();
    if let Some(tilt) = settings.tilt_rad {
        return vec![tilt.min(most)];
    }
    let (sponge, Some(contact)) = (&terms.workcell.tool.sponge, terms.contact_of(plate)) else {
        return vec![most];
    };
    if !plate.surface.is_flat() {
        return vec![most];
    }
    let spare_m = sponge.compression_m - contact.height_error_m - contact.compression_m - HEIGHT_RESERVE_M;
    let whole = atan2(spare_m, sponge.radius_m);
    if whole > 0.0 && whole < most {
        vec![NARROW * whole, WIDE * whole, most]
    } else {
        vec![most]
    }
}
