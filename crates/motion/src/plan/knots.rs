//! Knots of a motion, and their canonical JSON (RFC 8785).

use crate::digits::push_shortest;
use crate::trajectory::{KnotError, Trajectory};
use platewash_kinematics::JointVector;
use serde::{Deserialize, Serialize};

/// Knots of a motion.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Knots {
    /// Times \[s\].
    pub t_s: Vec<f64>,
    /// Positions \[rad\], one row per knot.
    pub q_rad: Vec<JointVector>,
    /// Speeds \[rad/s\], one row per knot.
    pub qd_rad_s: Vec<JointVector>,
}

impl Knots {
    /// Returns the motion through the knots.
    ///
    /// # Errors
    /// [`KnotError`] with the first knot that does not fit.
    pub fn motion(&self) -> Result<Trajectory, KnotError> {
        Trajectory::from_knots(self.t_s.clone(), self.q_rad.clone(), self.qd_rad_s.clone())
    }
}

impl From<&Trajectory> for Knots {
    fn from(motion: &Trajectory) -> Self {
        Self {
            t_s: motion.times().to_vec(),
            q_rad: motion.positions().to_vec(),
            qd_rad_s: motion.speeds().to_vec(),
        }
    }
}

/// Text of a plan without knots, where those of others are.
pub(super) const NO_KNOTS: &str = r#"{"q_rad":[],"qd_rad_s":[],"t_s":[]}"#;

/// Text of the knots.
pub(super) fn canonical(knots: &Knots) -> String {
    let mut text = Text::default();
    text.0.push_str(r#"{"q_rad":"#);
    text.rows(&knots.q_rad);
    text.0.push_str(r#","qd_rad_s":"#);
    text.rows(&knots.qd_rad_s);
    text.0.push_str(r#","t_s":"#);
    text.list(&knots.t_s, |text, t_s| text.number(*t_s));
    text.0.push('}');
    text.0
}

#[derive(Default)]
struct Text(String);

impl Text {
    fn rows(&mut self, rows: &[JointVector]) {
        self.list(rows, |text, row| {
            text.list(row.as_slice(), |text, number| text.number(*number));
        });
    }

    fn list<T>(&mut self, all: &[T], add: impl Fn(&mut Self, &T)) {
        self.0.push('[');
        for (k, one) in all.iter().enumerate() {
            if k > 0 {
                self.0.push(',');
            }
            add(self, one);
        }
        self.0.push(']');
    }

    /// Adds a number as ECMAScript writes it; one that is not finite is `null`.
    fn number(&mut self, number: f64) {
        if number == 0.0 {
            self.0.push('0');
        } else if number.abs() < 1e15 && !(1e-6..1e-4).contains(&number.abs()) {
            // Shortest digits; below 1e-6 with an exponent, as in ECMAScript.
            push_shortest(&mut self.0, number);
        } else {
            // Where the two differ on the exponent.
            self.0 += &serde_json_canonicalizer::to_string(&number).unwrap_or_else(|_| "null".to_owned());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The text is that of the general writer.
        #[test]
        fn the_text_is_canonical(bits in prop::array::uniform6(any::<u64>()), near in prop::array::uniform6(-10.0..10.0_f64)) {
            let any = bits.map(f64::from_bits);
            let small = [1e-4, 1e-5, 1e-6, 1e-7, 1e-20, 1e-310];
            let small = std::array::from_fn(|k| near[k] * small[k]);
            let knots = Knots {
                t_s: vec![0.0, -0.0, 1.0, near[0].round(), near[1] * 1e20, near[2] * 1e-6],
                q_rad: [any, near, small].map(JointVector::from).to_vec(),
                qd_rad_s: vec![JointVector::zeros(), JointVector::from(near.map(f64::round))],
            };
            let general = serde_json_canonicalizer::to_string(&knots);
            prop_assume!(general.is_ok());
            prop_assert_eq!(canonical(&knots), general.unwrap());
        }
    }

    #[test]
    fn no_knots_are_empty_lists() {
        assert_eq!(canonical(&Knots::default()), NO_KNOTS);
    }
}
