//! Samples of a simulation into a live run, in real time.

use super::limits::ROWS;
use super::live::{Live, Row};
use super::pace::Pace;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_simulator::simulate::Sample;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::plan::Plan;

/// Least time between two samples that are told \[s\].
const STEP_S: f64 = 0.02;

/// Takes the samples of a simulation as they are computed, holds it back to real time, and tells a live run of some of them.
#[derive(Debug)]
pub struct Feed<'a> {
    live: &'a Live,
    arm: &'a RobotModel,
    token: &'a CancelToken,
    tip: Frame,
    step_s: f64,
    pace: Option<Pace>,
    told: usize,
    /// The last sample, where it was not told.
    left_out: Option<Sample>,
    late_s: f64,
}

impl<'a> Feed<'a> {
    /// For the simulation of a plan on its arm; it begins with its first sample. `token` ends all waiting.
    #[must_use]
    pub fn new(live: &'a Live, plan: &Plan, arm: &'a RobotModel, token: &'a CancelToken) -> Self {
        Self {
            live,
            arm,
            token,
            tip: plan.job.workcell.tool.tip_frame(arm),
            // Fifty a second, fewer where a plan is long: all of it is kept for pages that come late.
            step_s: STEP_S.max(plan.duration_s() / ROWS as f64),
            pace: None,
            told: 0,
            left_out: None,
            late_s: 0.0,
        }
    }

    /// Takes a sample; returns when it is its time.
    pub fn sample(&mut self, sample: &Sample) {
        // A sample that is due but for rounding is due.
        if sample.t_s < self.told as f64 * self.step_s - 1e-9 {
            self.left_out = Some(*sample);
            return;
        }
        if self.pace.is_none() {
            self.live.begin();
        }
        self.late_s = self.pace.get_or_insert_with(Pace::start).wait(sample.t_s, self.token);
        self.left_out = None;
        self.tell(sample);
    }

    /// Tells the last sample, whenever it comes. How far the simulation was behind real time when it ended \[s\]: zero, but where it could
    /// not keep up.
    pub fn end(mut self) -> f64 {
        if let Some(sample) = self.left_out.take() {
            self.tell(&sample);
        }
        self.late_s
    }

    fn tell(&mut self, sample: &Sample) {
        self.told += 1;
        self.live.push(self.row(sample));
    }

    fn row(&self, sample: &Sample) -> Row {
        let tip = |q: &JointVector| self.arm.fk(q).rigid(&self.tip).translation;
        let error_m = (tip(&sample.state.q) - tip(&sample.commanded)).norm();
        let mut row = [0.0; 20];
        row[0] = sample.t_s;
        row[1..7].copy_from_slice(sample.state.q.as_slice());
        row[7..13].copy_from_slice(sample.state.qd.as_slice());
        row[13..19].copy_from_slice(sample.torque.as_slice());
        row[19] = error_m;
        row
    }
}

#[cfg(test)]
mod tests {
    use super::super::live::News;
    use super::*;
    use platewash_planner::plan;
    use platewash_simulator::{SimulationReport, simulate};
    use platewash_workcell::fixtures::kitchen;
    use std::time::Duration;

    /// All that a run tells of samples, fed without waiting.
    fn rows(plan: &Plan, arm: &RobotModel, samples: &[Sample]) -> Vec<Row> {
        let (live, token) = (Live::new(""), CancelToken::new());
        token.cancel();
        let mut feed = Feed::new(&live, plan, arm, &token);
        samples.iter().for_each(|sample| feed.sample(sample));
        feed.end();
        let (mut follower, mut all) = (live.follow(None).unwrap(), Vec::new());
        loop {
            match follower.news(Duration::ZERO) {
                News::Samples(rows, _) => all.extend(rows),
                News::Silence => return all,
                News::State(_) => {}
                other => panic!("{other:?} before the end"),
            }
        }
    }

    #[test]
    fn fifty_samples_a_second_are_told_the_first_and_the_last_among_them() {
        let job = kitchen();
        let (arm, plan) = (job.shared_arm(), plan(&job).unwrap().plan);
        let execution = simulate(&plan, &arm, &plan.job.simulation).unwrap();
        let rows = rows(&plan, &arm, &execution.samples);
        let last = execution.samples.last().unwrap();
        assert_eq!(rows[0][0], 0.0);
        assert_eq!(rows[rows.len() - 1][0], last.t_s);
        let expected = last.t_s / STEP_S;
        assert!(
            (rows.len() as f64 - expected).abs() < 3.0,
            "{} of {expected}",
            rows.len()
        );
        assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]));
        let of_t = |t: f64| execution.samples.iter().find(|sample| sample.t_s == t).unwrap();
        for row in &rows {
            let sample = of_t(row[0]);
            assert_eq!(row[1..7], *sample.state.q.as_slice());
            assert_eq!(row[7..13], *sample.state.qd.as_slice());
            assert_eq!(row[13..19], *sample.torque.as_slice());
        }
        let report = SimulationReport::new(&plan, &arm, &plan.job.simulation, &execution).unwrap();
        let most = rows.iter().map(|row| row[19]).fold(0.0, f64::max);
        let tip_m = report.tracking.tip_m;
        assert!(0.3 * tip_m.rms < most && most <= tip_m.max, "{most} {tip_m:?}");
    }

    #[test]
    fn a_long_run_is_told_in_so_many_rows() {
        let job = kitchen();
        let (arm, mut plan) = (job.shared_arm(), plan(&job).unwrap().plan);
        let mut sample = simulate(&plan, &arm, &plan.job.simulation).unwrap().samples[0];
        plan.knots.t_s.last_mut().map(|end| *end = 1e6).unwrap();
        let samples: Vec<_> = (0..=100_000)
            .map(|n| {
                sample.t_s = 10.0 * f64::from(n);
                sample
            })
            .collect();
        let rows = rows(&plan, &arm, &samples);
        assert!((ROWS / 2..=ROWS + 2).contains(&rows.len()), "{}", rows.len());
        assert_eq!(rows[rows.len() - 1][0], 1e6);
    }
}
