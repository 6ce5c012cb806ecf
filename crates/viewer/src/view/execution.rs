//! What an arm did with a plan.

use super::coverage::{self, PlateCoverage};
use super::error::ViewError;
use super::executed::{Executed, Source};
use super::numbers::Numbers;
use super::tips::{Tip, Tips};
use platewash_certificate as proved;
use platewash_kinematics::JointVector;
use platewash_workcell::csv::RecordedSample;
use platewash_workcell::plan::Plan;
use serde::Serialize;

/// Time between two samples at least \[s\].
const LEAST_STEP_S: f64 = 0.01;

/// Samples at most: so many, and so many more a plate.
const MOST_SAMPLES: [usize; 2] = [1500, 250];

/// Time between two moments of a wash at least \[s\].
const WASH_STEP_S: f64 = 4e-3;

/// How much later than the plan a motion may end \[s\].
const SLACK_S: f64 = 1.0;

/// What an arm did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Execution {
    /// Where it comes from.
    pub source: Source,
    /// Name of the control law, where it is known.
    pub law: Option<String>,
    /// First line of its report, where there is one.
    pub headline: Option<String>,
    /// Whether every plate is washed, where that is judged.
    pub washed: Option<bool>,
    /// \[n\] \[s\].
    pub t_s: Numbers,
    /// \[n, 6\] \[rad\].
    pub q_rad: Numbers,
    /// \[n, 6\] \[rad/s\].
    pub qd_rad_s: Numbers,
    /// \[n, 6\] \[rad/s²\].
    pub qdd_rad_s2: Option<Numbers>,
    /// \[n, 6\] \[N·m\]; `None` where no torques are known.
    pub torque_n_m: Option<Numbers>,
    /// Six limits \[N·m\]; `None` where not all are known.
    pub torque_limit_n_m: Option<[f64; 6]>,
    /// \[n\]: distance of the tip from where the plan has it at that time \[m\].
    pub error_m: Numbers,
    /// What was swept.
    pub coverage: Vec<PlateCoverage>,
}

impl Execution {
    /// # Errors
    /// [`ViewError::BeyondEnd`].
    pub(super) fn new(
        executed: &Executed,
        plan: &Plan,
        tips: &Tips<'_>,
        certificate: Option<&proved::Certificate>,
    ) -> Result<Self, ViewError> {
        let (samples, plan_s) = (&executed.samples, plan.duration_s());
        let end_s = samples.last().map_or(0.0, |sample| sample.t_s);
        if end_s > plan_s + SLACK_S {
            let slack_s = SLACK_S;
            return Err(ViewError::BeyondEnd { end_s, plan_s, slack_s });
        }
        let shown = shown(samples, plan.job.plates.len());
        let off_m = |sample: &&RecordedSample| {
            let planned = tips.at(sample.t_s)?.at;
            Some((tips.of(&sample.q, sample.t_s).at - planned).norm())
        };
        let coverage = if samples.is_empty() {
            Vec::new()
        } else {
            coverage::plates(plan, certificate, |span| way(samples, tips, span))
        };
        Ok(Self {
            source: executed.source,
            law: executed.law.clone(),
            headline: executed.headline.clone(),
            washed: executed.washed,
            t_s: Numbers::f64(&shown.iter().map(|sample| sample.t_s).collect::<Vec<_>>()),
            q_rad: Numbers::f32_rows(shown.iter().map(|sample| &sample.q)),
            qd_rad_s: Numbers::f32_rows(shown.iter().map(|sample| &sample.qd)),
            qdd_rad_s2: column(&shown, |sample| Some(&sample.qdd)),
            torque_n_m: column(&shown, |sample| sample.torque.as_ref()),
            torque_limit_n_m: executed.torque_limit_n_m,
            error_m: Numbers::f32(shown.iter().map(|sample| off_m(sample).unwrap_or(f64::NAN))),
            coverage,
        })
    }
}

/// The samples that are shown.
fn shown(samples: &[RecordedSample], plates: usize) -> Vec<&RecordedSample> {
    let most = MOST_SAMPLES[0] + MOST_SAMPLES[1] * plates;
    let [first_s, last_s] = [samples.first(), samples.last()].map(|sample| sample.map_or(0.0, |sample| sample.t_s));
    thinned(samples, LEAST_STEP_S.max((last_s - first_s) / (most - 1) as f64))
}

/// A column that is shown where every sample has it, and there are samples.
fn column<'a>(
    samples: &[&'a RecordedSample],
    of: impl Fn(&'a RecordedSample) -> Option<&'a JointVector>,
) -> Option<Numbers> {
    let rows: Option<Vec<&JointVector>> = samples.iter().map(|sample| of(sample)).collect();
    rows.filter(|rows| !rows.is_empty())
        .map(|rows| Numbers::f32_rows(rows.into_iter()))
}

/// The executed tip from one time to another \[s\], as the samples have it.
fn way(samples: &[RecordedSample], tips: &Tips<'_>, [from_s, to_s]: [f64; 2]) -> Vec<Tip> {
    let first = samples.partition_point(|sample| sample.t_s < from_s);
    let last = samples.partition_point(|sample| sample.t_s <= to_s);
    let during = thinned(samples.get(first..last).unwrap_or_default(), WASH_STEP_S);
    during
        .into_iter()
        .map(|sample| tips.of(&sample.q, sample.t_s))
        .collect()
}

/// The first sample, the last one, and those between that are at least so far apart in time \[s\]. Steps that come out a little
/// short count as whole ones.
fn thinned(samples: &[RecordedSample], step_s: f64) -> Vec<&RecordedSample> {
    let Some((last, before)) = samples.split_last() else {
        return Vec::new();
    };
    let mut next_s = f64::NEG_INFINITY;
    let far_enough = |sample: &&RecordedSample| {
        let is_kept = sample.t_s >= next_s;
        if is_kept {
            next_s = sample.t_s + (1.0 - 1e-6) * step_s;
        }
        is_kept
    };
    before.iter().filter(far_enough).chain([last]).collect()
}
