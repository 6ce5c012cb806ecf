//! The curve of the tip on a plate: pitch, pattern and tilt chosen together, for a short wash that keeps what is promised.
//!
//! What the job states is kept; what it leaves out is chosen. Candidates (`candidates.rs`) are tried the shortest first (`estimate.rs`):
//! the first that on the bare face, with the tool by its rule and at the speed limit, brings enough of it into contact (`promise.rs`) is
//! taken. Whether it does so with the arm's own tilts is asked again on each plate; where it does not, or the arm finds no way along it,
//! the next ones are tried.

mod candidates;
mod estimate;
mod promise;

pub use promise::Promise;
pub(crate) use promise::foundation;

#[cfg(test)]
mod tests;

use crate::scene::{AXIS_SHARE, AxisRule};
use crate::trig::atan2;
use candidates::candidates;
use estimate::Estimate;
use platewash_workcell::job::{JobTerms, PlannerSettings};
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{WashCurve, WashPath};

/// What the tilt of the tool may take of the sponge's contact on a flat face, besides what is promised \[m\]: for the tip's own error.
const HEIGHT_RESERVE_M: f64 = 2e-4;

/// The share of the cone that leaves the whole sponge in contact which is tried first: tilted less, the sponge presses more evenly.
const NARROW: f64 = 0.5;

/// The same for places that are not reached so.
const WIDE: f64 = 0.85;

/// Patterns that are offered within a cone at most.
const MOST_OFFERED: usize = 2;

/// A curve and how far the tool may lean along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pattern {
    /// The curve; its first angle is for each plate to choose.
    pub curve: WashCurve,
    /// Largest angle of the tool from the normal of the face \[rad\].
    pub cone_rad: f64,
    /// What it takes at the limits of washing, from rest to rest, the arm apart \[s\].
    pub least_s: f64,
}

/// The patterns to try on a surface.
#[derive(Debug, Clone)]
pub struct Patterns {
    surface: Surface,
    promise: Promise,
    rule: AxisRule,
    /// The shortest first; at least one.
    candidates: Vec<Estimate>,
    /// The cones to plan with, the best first; at least one.
    cones: Vec<f64>,
    first: Vec<Pattern>,
}

impl Patterns {
    /// What a job offers on a surface.
    #[must_use]
    pub fn new(terms: &JobTerms, settings: &PlannerSettings, surface: &Surface) -> Self {
        let promise = Promise::of(terms, surface);
        let estimate = |curve: WashCurve| Estimate::new(curve, surface, terms);
        let mut all: Vec<Estimate> = candidates(settings, surface, &promise)
            .into_iter()
            .map(estimate)
            .collect();
        all.sort_by(|a, b| a.least_s.total_cmp(&b.least_s));
        let mut patterns = Self {
            surface: *surface,
            promise,
            rule: AxisRule::new(surface, settings.axis_share.unwrap_or(AXIS_SHARE)),
            candidates: all,
            cones: cones(terms, settings, surface),
            first: Vec::new(),
        };
        patterns.first = patterns.within(patterns.cones[0]);
        patterns
    }

    /// The same with one curve and one cone alone: those of another plan.
    #[must_use]
    pub fn along(&self, terms: &JobTerms, path: &WashPath) -> Self {
        let mut patterns = Self {
            candidates: vec![Estimate::new(path.curve, &self.surface, terms)],
            cones: vec![path.cone_rad],
            ..self.clone()
        };
        patterns.first = patterns.within(path.cone_rad);
        patterns
    }

    /// Those that are tried first, the best first; at least one.
    #[must_use]
    pub fn first(&self) -> &[Pattern] {
        &self.first
    }

    /// Those of wider cones, for places that the first ones do not reach.
    pub fn wider(&self) -> impl Iterator<Item = Pattern> {
        self.cones[1..].iter().flat_map(|cone| self.within(*cone))
    }

    /// The first one with the widest cone: what no tilt of it reaches, none does.
    #[must_use]
    pub fn widest(&self) -> Pattern {
        let cone_rad = self.cones.iter().copied().fold(0.0, f64::max);
        Pattern {
            cone_rad,
            ..self.first[0]
        }
    }

    /// The shortest candidates that keep what is promised within a cone; where none does, the longest one: what it lacks is for the
    /// certificate to say.
    fn within(&self, cone_rad: f64) -> Vec<Pattern> {
        let offered = |estimate: &Estimate| Pattern {
            curve: estimate.curve,
            cone_rad,
            least_s: estimate.least_s,
        };
        if let [only] = &self.candidates[..] {
            return vec![offered(only)];
        }
        let keeps = |estimate: &&Estimate| estimate.keeps(&self.promise, &self.surface, (&self.rule, cone_rad));
        let kept = self.candidates.iter().filter(keeps).take(MOST_OFFERED);
        let chosen: Vec<Pattern> = kept.map(offered).collect();
        if chosen.is_empty() {
            return self.candidates.last().map(offered).into_iter().collect();
        }
        chosen
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
