//! Diagrams: scales, ticks, grids and their words.

use super::drawing::{Drawing, Lettering, Rect, Spot};
use super::palette::{GREY, GRID, INK, LINE, PAPER};
use super::style::Style;

/// From numbers to places along an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Least and greatest number.
    pub numbers: [f64; 2],
    /// Where they are \[px\].
    pub places: [f64; 2],
}

impl Scale {
    /// Where a number is \[px\].
    #[must_use]
    pub fn at(&self, number: f64) -> f64 {
        let [low, high] = self.numbers;
        let [from, to] = self.places;
        from + (number - low) / (high - low) * (to - from)
    }

    /// Round numbers along the axis, about `wanted` of them, and not fewer than three where that can be.
    #[must_use]
    pub fn ticks(&self, wanted: usize) -> Vec<f64> {
        let some = self.ticks_at_most(wanted);
        if some.len() < 3 {
            self.ticks_at_most(2 * wanted)
        } else {
            some
        }
    }

    fn ticks_at_most(&self, wanted: usize) -> Vec<f64> {
        let [from, to] = self.numbers;
        let (low, high) = (from.min(to), from.max(to));
        let step = step((high - low) / wanted.max(1) as f64);
        let first = (low / step - 1e-9).ceil();
        let last = (high / step + 1e-9).floor();
        if !(step > 0.0 && first.is_finite() && last - first < 1e3) {
            return Vec::new();
        }
        let count = (last - first).max(0.0) as usize;
        (0..=count).map(|k| (first + k as f64) * step).collect()
    }
}

/// The round step that is nearest above: 1, 2 or 5 times a power of ten.
fn step(least: f64) -> f64 {
    let mut power = 1.0;
    if !(least > 0.0 && least.is_finite()) {
        return 0.0;
    }
    while power > least {
        power /= 10.0;
    }
    while power * 10.0 <= least {
        power *= 10.0;
    }
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|factor| factor * power >= least * (1.0 - 1e-9));
    power * factor.unwrap_or(10.0)
}

/// Numbers of an axis as words, with as many decimals as tell them apart.
#[must_use]
pub fn words(ticks: &[f64]) -> Vec<String> {
    let gap = ticks
        .windows(2)
        .map(|two| two[1] - two[0])
        .fold(f64::INFINITY, f64::min);
    let decimals = (0..6).find(|&n| {
        let scaled = gap * 10_f64.powi(n);
        (scaled - scaled.round()).abs() < 1e-6 * scaled
    });
    let decimals = usize::try_from(decimals.unwrap_or(0)).unwrap_or(0);
    ticks
        .iter()
        .map(|tick| minus(&format!("{:.decimals$}", tick + 0.0)))
        .collect()
}

/// A number's text with the minus that is as wide as a plus; "-0" is 0.
#[must_use]
pub fn minus(number: &str) -> String {
    match number.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| "0.".contains(c)) => rest.to_owned(),
        Some(rest) => format!("−{rest}"),
        None => number.to_owned(),
    }
}

/// A number with as many digits as it is worth, thousands apart.
#[must_use]
pub fn grouped(number: f64) -> String {
    if number.abs() < 1e3 {
        return format!("{number:.0}");
    }
    let digits = format!("{:.0}", number.abs());
    let mut all = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k) % 3 == 0 {
            all.push(' ');
        }
        all.push(digit);
    }
    if number < 0.0 { format!("-{all}") } else { all }
}

/// A diagram: a frame with a scale in either direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// The frame.
    pub frame: Rect,
    /// Numbers from left to right.
    pub across: Scale,
    /// Numbers from below to above.
    pub up: Scale,
}

/// Size of the numbers at axes \[px\].
const TICK_SIZE: f64 = 17.0;

impl Axes {
    /// A diagram in a frame, with the least and the greatest number at its edges.
    #[must_use]
    pub fn new(frame: Rect, across: [f64; 2], up: [f64; 2]) -> Self {
        let [left, top] = frame.at;
        let [right, bottom] = frame.end();
        Self {
            frame,
            across: Scale {
                numbers: across,
                places: [left, right],
            },
            up: Scale {
                numbers: up,
                places: [bottom, top],
            },
        }
    }

    /// Where a pair of numbers is.
    #[must_use]
    pub fn at(&self, across: f64, up: f64) -> Spot {
        [self.across.at(across), self.up.at(up)]
    }

    /// The ground and lines at these numbers.
    pub fn grid(&self, drawing: &mut Drawing, across: &[f64], up: &[f64]) {
        let ([left, top], [right, bottom]) = (self.frame.at, self.frame.end());
        drawing.rect(self.frame, 0.0, &Style::fill(PAPER));
        let upright = across
            .iter()
            .map(|&x| self.across.at(x))
            .map(|x| [[x, top], [x, bottom]]);
        let level = up.iter().map(|&y| self.up.at(y)).map(|y| [[left, y], [right, y]]);
        let lines: Vec<_> = upright.chain(level).collect();
        drawing.polylines(&lines, &Style::line(GRID, 1.0));
    }

    /// The frame's outline, above what was drawn in it.
    pub fn outline(&self, drawing: &mut Drawing) {
        drawing.rect(self.frame, 0.0, &Style::fill("none").outlined(LINE, 1.2));
    }

    /// Numbers below the frame.
    pub fn numbers_below(&self, drawing: &mut Drawing, ticks: &[f64]) {
        let y = self.frame.end()[1] + TICK_SIZE + 5.0;
        for (tick, words) in ticks.iter().zip(words(ticks)) {
            let how = Lettering::new(TICK_SIZE, GREY).centred();
            drawing.text([self.across.at(*tick), y], &words, &how);
        }
    }

    /// Numbers to the left of the frame.
    pub fn numbers_left(&self, drawing: &mut Drawing, ticks: &[f64]) {
        let how = Lettering::new(TICK_SIZE, GREY).to_the_left();
        for (tick, words) in ticks.iter().zip(words(ticks)) {
            let place = [self.frame.at[0] - 9.0, self.up.at(*tick) + how.drop()];
            drawing.text(place, &words, &how);
        }
    }

    /// What the numbers below are.
    pub fn name_below(&self, drawing: &mut Drawing, words: &str) {
        let place = [self.frame.middle()[0], self.frame.end()[1] + 2.0 * TICK_SIZE + 17.0];
        drawing.text(place, words, &Lettering::new(19.0, INK).centred());
    }

    /// What the numbers to the left are, `away` from the frame \[px\].
    pub fn name_left(&self, drawing: &mut Drawing, words: &str, away: f64) {
        let place = [self.frame.at[0] - away, self.frame.middle()[1]];
        drawing.text(place, words, &Lettering::new(19.0, INK).centred().upwards());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(numbers: [f64; 2]) -> Scale {
        Scale {
            numbers,
            places: [0.0, 100.0],
        }
    }

    #[test]
    fn thousands_stand_apart() {
        assert_eq!(
            [999.6, -1234.0, 1_164_700.0].map(grouped),
            ["1000", "-1 234", "1 164 700"]
        );
    }

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(scale([0.0, 42.7]).ticks(8), [0.0, 10.0, 20.0, 30.0, 40.0]);
        let ticks = scale([-0.31, 0.29]).ticks(6);
        assert_eq!(ticks, scale([0.29, -0.31]).ticks(6));
        assert_eq!(words(&ticks), ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2"]);
        assert_eq!(words(&scale([0.0, 2.0]).ticks(4)), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        for nonsense in [[0.0, 0.0], [f64::NAN, 1.0], [0.0, f64::INFINITY]] {
            assert!(scale(nonsense).ticks(5).is_empty(), "{nonsense:?}");
        }
    }
}
