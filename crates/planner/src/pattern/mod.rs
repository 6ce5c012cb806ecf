//! The curve of the tip on a plate: pitch, pattern and tilt chosen together, for a short wash that keeps the promises of the job.
//!
//! A curve that the job states is kept; parameters that it leaves out are chosen. Candidates (`candidates.rs`) are tried in order
//! of length: the first one is taken that brings enough of the bare face into contact (`promise.rs`), with the tool by its rule
//! and at the speed limit. Where there is none, denser and slower ones are tried. Each plate is checked again with the arm's own
//! tilts. Where the curve fails there, or the arm finds no way along it, the next ones are tried.

mod candidates;
mod promise;
#[cfg(test)]
mod tests;

pub(crate) use crate::pattern::promise::foundation;
pub use crate::pattern::promise::{ContactPromise, Margin, Promise, SampledWash, Shortfall};

use crate::pattern::candidates::{ByTime, Candidate, Density, Estimate, candidates};
use crate::scene::{AXIS_SHARE, AxisRule};
use crate::trig::atan2;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::{JobTerms, PlannerSettings};
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{WashCurve, WashPath};
use std::sync::OnceLock;

/// Contact height on a flat face that the tilt of the tool may use up, besides the promised part \[m\]: a reserve for the error
/// of the tip.
const HEIGHT_RESERVE_M: f64 = 2e-4;

/// The share of the cone that leaves the whole sponge in contact which is tried first: tilted less, the sponge presses more evenly.
const NARROW: f64 = 0.5;

/// Share of the cone for places that are not reached with the narrow one.
const WIDE: f64 = 0.85;

/// Patterns that are offered within a cone at most.
const MOST_OFFERED: usize = 2;

/// Least share of the wash speed that is tried where no curve keeps the promise at full speed.
const SLOWEST: f64 = 0.1;

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
    /// Least time at the limits of washing, from rest to rest, without the limits of the arm \[s\].
    pub least_s: f64,
}

impl Pattern {
    /// A curve within a cone, at a share of the wash speed.
    fn candidate(estimate: &Estimate, cone_rad: f64, speed_share: f64) -> Self {
        Self {
            curve: estimate.curve,
            cone_rad,
            speed_share,
            least_s: estimate.least_s / speed_share,
        }
    }
}

/// The patterns to try on a surface.
#[derive(Debug, Clone)]
pub struct Patterns {
    surface: Surface,
    promise: Promise,
    rule: AxisRule,
    /// Greatest speed and acceleration of washing \[m/s, m/s²\].
    limits: [f64; 2],
    /// Curves among which is chosen; at least one.
    candidates: Vec<Candidate>,
    /// True where the job promises something about contact.
    has_contact: bool,
    /// Curves that cover the face more densely.
    dense: Vec<WashCurve>,
    /// The cones to plan with, the best first; at least one.
    cones: Vec<f64>,
    first: Vec<Pattern>,
    /// Patterns of each cone but the first, and slower ones of each cone, once they were asked for.
    wider: Vec<OnceLock<Vec<Pattern>>>,
    slower: Vec<OnceLock<Vec<Pattern>>>,
    /// Token that ends the search for patterns; the patterns found by then are offered.
    cancel: CancelToken,
}

impl Patterns {
    /// Returns the patterns that a job offers on a surface.
    #[must_use]
    pub fn new(terms: &JobTerms, settings: &PlannerSettings, surface: &Surface, cancel: &CancelToken) -> Self {
        let promise = Promise::of(terms, surface);
        let limits = [terms.wash_speed_m_s(), terms.wash_acceleration_m_s2()];
        let curves = |density| candidates(settings, surface, promise.foundation.radius_m, density);
        let usual = curves(Density::Usual).into_iter();
        let candidates = usual.map(|curve| Candidate::new(curve, surface, limits)).collect();
        let cones = cones(terms, settings, surface);
        let unasked = || vec![OnceLock::new(); cones.len()];
        let mut patterns = Self {
            surface: *surface,
            promise,
            rule: AxisRule::new(surface, settings.axis_share.unwrap_or(AXIS_SHARE)),
            limits,
            candidates,
            has_contact: terms.requirements.contact.is_some(),
            dense: curves(Density::Dense),
            first: Vec::new(),
            wider: unasked(),
            slower: unasked(),
            cones,
            cancel: cancel.clone(),
        };
        patterns.first = patterns.within(patterns.cones[0]);
        patterns
    }

    /// The same offer with one curve and one cone alone: those of another plan.
    #[must_use]
    pub fn along(&self, path: &WashPath) -> Self {
        let mut patterns = Self {
            candidates: vec![Candidate::new(path.curve, &self.surface, self.limits)],
            dense: Vec::new(),
            cones: vec![path.cone_rad],
            wider: vec![OnceLock::new()],
            slower: vec![OnceLock::new()],
            ..self.clone()
        };
        patterns.first = patterns.within(path.cone_rad);
        patterns
    }

    /// Patterns that are tried first, the best first; at least one.
    #[must_use]
    pub fn first(&self) -> &[Pattern] {
        &self.first
    }

    /// Patterns of wider cones, for places that the first ones do not reach.
    pub fn wider_patterns(&self) -> impl Iterator<Item = Pattern> {
        let cones = self.cones.iter().zip(&self.wider).skip(1);
        cones.flat_map(|(cone, known)| known.get_or_init(|| self.within(*cone)).iter().copied())
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
        Pattern {
            cone_rad,
            ..self.first[0]
        }
    }

    /// Returns true where the curve is chosen, not stated.
    #[must_use]
    pub fn is_chosen(&self) -> bool {
        self.candidates.len() > 1
    }

    /// The shortest candidates that keep the promise within a cone: at full speed, or else denser or slower; a stated curve comes
    /// at full speed first. Where none of the usual ones keeps it, the longest of them comes last: the arm may lean less than is
    /// assumed here.
    fn within(&self, cone_rad: f64) -> Vec<Pattern> {
        let mut chosen = self.usual(cone_rad);
        if self.is_chosen() && !chosen.is_empty() {
            return chosen;
        }
        chosen.extend(self.slower(cone_rad, &Margin::BARE_FACE));
        if self.is_chosen() {
            let last = self.by_time().last();
            chosen.extend(last.map(|last| Pattern::candidate(&last, cone_rad, 1.0)));
        }
        chosen
    }

    /// Candidates, the quickest first.
    fn by_time(&self) -> ByTime<'_> {
        ByTime::new(&self.candidates, &self.surface, self.limits)
    }

    /// The shortest of the usual curves that keep the promise at full speed; a stated curve is taken in any case.
    fn usual(&self, cone_rad: f64) -> Vec<Pattern> {
        let keeps = |estimate: &Estimate| estimate.keeps_promise(&self.promise, &self.surface, &self.rule, cone_rad);
        let tried = self.by_time().take_while(|_| !self.cancel.is_cancelled());
        let kept = tried.filter(|estimate| !self.is_chosen() || keeps(estimate));
        kept.take(MOST_OFFERED)
            .map(|estimate| Pattern::candidate(&estimate, cone_rad, 1.0))
            .collect()
    }

    /// The quickest curves, dense ones among them, each with the greatest share of the wash speed at which it keeps the promise
    /// with a margin.
    fn slower(&self, cone_rad: f64, margin: &Margin) -> Vec<Pattern> {
        if !self.has_contact {
            return Vec::new();
        }
        let dense = self.dense.iter();
        let dense = dense.map(|curve| Estimate::new(*curve, &self.surface, self.limits));
        let all = self.by_time().chain(dense);
        let all = all.take_while(|_| !self.cancel.is_cancelled());
        let kept = all.filter_map(|estimate| {
            let moments = estimate.moments(&self.surface, &self.rule, cone_rad);
            let share = SampledWash::new(self.promise, self.surface, moments).speed_share(margin, SLOWEST)?;
            Some(Pattern::candidate(&estimate, cone_rad, share))
        });
        let kept = kept.filter(|pattern| self.is_chosen() || pattern.speed_share < 1.0);
        let mut kept: Vec<Pattern> = kept.take(MOST_SLOWED).collect();
        kept.sort_by(|a, b| a.least_s.total_cmp(&b.least_s));
        kept.truncate(MOST_OFFERED);
        kept
    }
}

/// The cones to plan with, the best first: on a flat face as wide as leaves the whole sponge in contact, where a promise asks for it.
fn cones(terms: &JobTerms, settings: &PlannerSettings, surface: &Surface) -> Vec<f64> {
    let most = terms.tilt_max_rad();
    if let Some(tilt) = settings.tilt_rad {
        return vec![tilt.min(most)];
    }
    let (sponge, Some(contact)) = (&terms.workcell.tool.sponge, &terms.requirements.contact) else {
        return vec![most];
    };
    if !surface.is_flat() {
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
