//! A point of a program with the time since the point before, and its differences from another one.

use crate::reading::{ReadPoint, Reading};
use platewash_kinematics::words::distinct_decimals;
use platewash_kinematics::{AXES, JointVector};
use std::collections::HashMap;

/// Differences that count as rounding: of angles and their speeds \[rad, rad/s\], and of lengths \[m\].
const ROUNDING: (f64, f64) = (1e-12, 1e-9);

/// Differences that count as rounding of a step computed from sums of times \[s\]: between programs that run at the same share of
/// the speed, and at different ones.
const ROUNDING_S: [f64; 2] = [1e-10, 2e-7];

/// A point, with speeds and the time since the point before in the plan's time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step<'a> {
    point: &'a ReadPoint,
    /// \[s\]
    lasts_s: f64,
    /// \[rad/s\]
    qd_rad_s: Option<JointVector>,
}

/// Difference that counts as rounding between the steps of two programs \[s\].
pub(crate) fn rounding_s(a: &Reading, b: &Reading) -> f64 {
    ROUNDING_S[usize::from(a.share() != b.share())]
}

/// The points that each line names, in order; lines by file and number.
pub(crate) fn by_line(reading: &Reading) -> HashMap<(&str, usize), Vec<Step<'_>>> {
    let share = reading.share();
    let mut before_s = 0.0;
    let mut all: HashMap<_, Vec<_>> = HashMap::new();
    for point in &reading.points {
        let step = Step {
            point,
            lasts_s: (point.t_s - before_s) * share,
            qd_rad_s: point.qd_rad_s.map(|qd| qd / share),
        };
        before_s = point.t_s;
        let place = &point.place;
        all.entry((place.file.as_str(), place.line)).or_default().push(step);
    }
    all
}

impl Step<'_> {
    /// Returns the differences, as name, found and expected.
    pub fn differences(&self, other: &Self, most_s: f64) -> Vec<(String, String, String)> {
        let (most_rad, most_m) = ROUNDING;
        let mut all = Vec::new();
        let mut tell = |what: String, [a, b]: [f64; 2], most: f64, (decimals, unit): (usize, &str)| {
            if a.is_nan() || (a - b).abs() > most {
                let [a, b] = distinct_decimals(a, b, decimals);
                all.push((what, format!("{a} {unit}"), format!("{b} {unit}")));
            }
        };
        for j in 0..AXES {
            let most_deg = most_rad.to_degrees();
            let joint = format!("joint {}", j + 1);
            let speeds = self.qd_rad_s.zip(other.qd_rad_s);
            let speeds = speeds.map(|(a, b)| [a[j], b[j]].map(f64::to_degrees));
            let positions = [self, other].map(|step| step.point.q_rad[j].to_degrees());
            tell(joint.clone(), positions, most_deg, (4, "deg"));
            if let Some(speeds) = speeds {
                tell(format!("speed of {joint}"), speeds, most_deg, (4, "deg/s"));
            }
        }
        tell("time".to_owned(), [self.lasts_s, other.lasts_s], most_s, (6, "s"));
        let corners = [self, other].map(|step| step.point.corner_m);
        let is_same = match corners {
            [Some(a), Some(b)] => (a - b).abs() <= most_m,
            [a, b] => a.is_none() == b.is_none(),
        };
        if !is_same {
            let told = |corner: Option<f64>| corner.map_or_else(|| "stop".to_owned(), |m| format!("{} mm", 1e3 * m));
            let [a, b] = corners.map(told);
            all.push(("corner".to_owned(), a, b));
        }
        all
    }
}
