//! Transits between the plates, and from and to home.

use super::shared::Pipeline;
use crate::activity::Activity;
use crate::error::PlanError;
use crate::scene::Scene;
use crate::transit::{self, BaseArc, LiftLine, Transit, TransitRules};
use platewash_workcell::random;

impl Pipeline<'_> {
    /// Transits between neighbours of the lines over the plates, and from and to home; those that `wanted` names by their index.
    /// Each draws from a stream of its own.
    pub fn transits(
        &self,
        scene: &Scene<'_>,
        lines: &[[&LiftLine; 2]],
        wanted: impl Fn(usize) -> bool,
    ) -> Result<Vec<Transit>, PlanError> {
        let [start, end] = self.terms.home_rad.map(LiftLine::home);
        let leaving = std::iter::once(&start).chain(lines.iter().map(|[_, exit]| *exit));
        let entering = lines.iter().map(|[entry, _]| *entry).chain(std::iter::once(&end));
        let rules = TransitRules {
            scene,
            limits: &self.transit,
            clearance_m: self.clearance_m(),
            arc: Some(BaseArc {
                arc: self.settings.arc,
                policy: self.policy(),
            }),
        };
        let pairs = leaving.zip(entering).enumerate().filter(|(k, _)| wanted(*k));
        let of = self.plates.len() + 1;
        pairs
            .map(|(k, (from, to))| {
                (self.watch.tell)(&Activity::Transit { turn: k + 1, of });
                let mut rng = random::stream(self.terms.seed, &format!("crossing {k}"));
                Ok(transit::plan(&rules, from, to, &mut rng)?)
            })
            .collect()
    }
}
