//! Canonical JSON (RFC 8785) of the knots of a motion.

use crate::digits::push_shortest;
use crate::plan::Knots;
use platewash_kinematics::JointVector;

/// Text of the knots.
pub(crate) fn canonical(knots: &Knots) -> String {
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
        assert_eq!(canonical(&Knots::default()), crate::plan::NO_KNOTS);
    }
}
