//! Samples of a simulation into a live run, in real time.

use crate::live::{LiveRun, Row};
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_simulator::simulate::Sample;
use platewash_workcell::cancel::CancelToken;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Least time between two samples that are sent \[s\].
const STEP_S: f64 = 0.02;

/// Most rows of a live run that are kept.
const ROWS: usize = 60_000;

/// Time between two checks that the waiting caller gives up.
const LOOK: Duration = Duration::from_millis(20);

/// Takes the samples of a simulation as they are computed, slows it down to real time, and sends some of them to a live run.
#[derive(Debug)]
pub struct Feed<'a> {
    live: &'a LiveRun,
    arm: &'a RobotModel,
    token: &'a CancelToken,
    tip: Frame,
    step_s: f64,
    /// Time at which the simulation's clock was at 0 s.
    start: Option<Instant>,
    told: usize,
    /// The last sample, where it was not sent.
    left_out: Option<Sample>,
    late_s: f64,
}

impl<'a> Feed<'a> {
    /// Feed for the simulation of a plan on its arm; it begins with its first sample. `token` ends all waiting.
    #[must_use]
    pub fn new(live: &'a LiveRun, plan: &Plan, arm: &'a RobotModel, token: &'a CancelToken) -> Self {
        Self {
            live,
            arm,
            token,
            tip: plan.job.workcell.tool.tip_frame(arm),
            // Fifty a second, fewer where a plan is long: all of it is kept for pages that come late.
            step_s: STEP_S.max(plan.duration_s() / ROWS as f64),
            start: None,
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
        if self.start.is_none() {
            self.live.begin();
        }
        let start = *self.start.get_or_insert_with(Instant::now);
        self.late_s = wait(start, sample.t_s, self.token);
        self.left_out = None;
        self.tell(sample);
    }

    /// Sends the last sample. Returns the delay of the simulation behind real time at its end \[s\]: zero, unless it was too
    /// slow.
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

/// Waits until so much time has passed since `start` \[s\], no longer than `token` allows; how late it is then \[s\].
fn wait(start: Instant, t_s: f64, token: &CancelToken) -> f64 {
    // A time too long for the clock is not reached.
    let due = Duration::try_from_secs_f64(t_s.max(0.0)).unwrap_or(Duration::MAX);
    loop {
        let left = due.saturating_sub(start.elapsed());
        if left.is_zero() || token.is_cancelled() {
            return (start.elapsed().as_secs_f64() - t_s).max(0.0);
        }
        sleep(left.min(LOOK));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_fixtures::kitchen;
    use platewash_planner::plan;
    use platewash_simulator::{SimulationReport, simulate};

    /// All rows that a run sends of samples, fed without waiting.
    fn rows(plan: &Plan, arm: &RobotModel, samples: &[Sample]) -> Vec<Row> {
        let (live, token) = (LiveRun::new(""), CancelToken::new());
        token.cancel();
        let mut feed = Feed::new(&live, plan, arm, &token);
        samples.iter().for_each(|sample| feed.sample(sample));
        feed.end();
        live.rows()
    }

    #[test]
    fn samples_are_never_early_and_cancelling_ends_the_wait() {
        let (start, token) = (Instant::now(), CancelToken::new());
        wait(start, 0.05, &token);
        assert!(start.elapsed() >= Duration::from_millis(50));
        token.cancel();
        assert_eq!([1e9, f64::INFINITY].map(|t_s| wait(start, t_s, &token)), [0.0; 2]);
    }

    #[test]
    fn sends_fifty_samples_a_second_with_the_first_and_the_last() {
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
    fn a_long_run_is_sent_in_a_bounded_number_of_rows() {
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
