//! Diagrams: scales, ticks, grids and their words.

use super::svg::{Drawing, END, LINE, MIDDLE, PAPER, Rect, SMALL, Spot, fill, stroke};

/// Scale from numbers to positions along an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Least and greatest number.
    pub numbers: [f64; 2],
    /// Positions on the page \[px\].
    pub places: [f64; 2],
}

impl Scale {
    /// Position of a number \[px\].
    pub fn at(&self, number: f64) -> f64 {
        let ([low, high], [from, to]) = (self.numbers, self.places);
        from + (number - low) / (high - low) * (to - from)
    }

    /// Round numbers along the axis, about `wanted` of them, and not fewer than three where that can be.
    pub fn ticks(&self, wanted: usize) -> Vec<f64> {
        let [low, high] = [
            self.numbers[0].min(self.numbers[1]),
            self.numbers[0].max(self.numbers[1]),
        ];
        let at_most = |wanted: usize| {
            let step = round_above((high - low) / wanted.max(1) as f64);
            let [first, last] = [(low / step - 1e-9).ceil(), (high / step + 1e-9).floor()];
            if !(step > 0.0 && first.is_finite() && last - first < 1e3) {
                return Vec::new();
            }
            let count = (last - first).max(0.0) as usize;
            (0..=count).map(|k| (first + k as f64) * step).collect()
        };
        let some = at_most(wanted);
        if some.len() < 3 { at_most(2 * wanted) } else { some }
    }
}

/// The round number that is nearest above: 1, 2 or 5 times a power of ten; 0 where there is none.
pub fn round_above(least: f64) -> f64 {
    if !(least > 0.0 && least.is_finite()) {
        return 0.0;
    }
    let mut power = 1.0;
    while power > least {
        power /= 10.0;
    }
    while power * 10.0 <= least {
        power *= 10.0;
    }
    let round = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    round
        .into_iter()
        .find(|step| *step >= least * (1.0 - 1e-9))
        .unwrap_or(least)
}

/// Numbers of an axis as words, with enough decimals to distinguish them.
pub fn tick_labels(ticks: &[f64]) -> Vec<String> {
    let gaps = ticks.windows(2).map(|two| two[1] - two[0]);
    let gap = gaps.fold(f64::INFINITY, f64::min);
    let is_whole = |decimals: &usize| {
        let scaled = gap * [1.0, 1e1, 1e2, 1e3, 1e4, 1e5][*decimals];
        (scaled - scaled.round()).abs() < 1e-6 * scaled
    };
    let decimals = (0..6).find(is_whole).unwrap_or(0);
    ticks.iter().map(|tick| fixed(*tick, decimals)).collect()
}

/// Formats a number with the given decimals and a minus as wide as a plus; "-0" is 0.
pub fn fixed(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| "0.".contains(c)) => rest.to_owned(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
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

/// Room that numbers and names need to the left of a frame, and below it \[px\].
pub const ROOM: [f64; 2] = [92.0, 64.0];

impl Axes {
    /// A diagram in a frame, with the least and the greatest number at its edges.
    pub fn new(frame: Rect, across: [f64; 2], up: [f64; 2]) -> Self {
        let ([left, top], [right, bottom]) = (frame.at, frame.end());
        let scale = |numbers, places| Scale { numbers, places };
        Self {
            frame,
            across: scale(across, [left, right]),
            up: scale(up, [bottom, top]),
        }
    }

    /// Position of a pair of numbers on the page.
    pub fn at(&self, across: f64, up: f64) -> Spot {
        [self.across.at(across), self.up.at(up)]
    }

    /// Draws the diagram with about the given number of ticks in either direction, their names where they have some, and the drawing of
    /// `draw` in the frame.
    pub fn draw(
        &self,
        drawing: &mut Drawing,
        wanted: [usize; 2],
        [below, beside]: [Option<&str>; 2],
        draw: impl FnOnce(&mut Drawing),
    ) {
        let ([left, top], [right, bottom]) = (self.frame.at, self.frame.end());
        let [middle, level] = self.frame.middle();
        let [across, up] = [self.across.ticks(wanted[0]), self.up.ticks(wanted[1])];
        let upright = across
            .iter()
            .map(|&x| self.across.at(x))
            .map(|x| vec![[x, top], [x, bottom]]);
        let flat = up.iter().map(|&y| self.up.at(y)).map(|y| vec![[left, y], [right, y]]);
        drawing.rect(self.frame, &fill(PAPER));
        drawing.lines(&upright.chain(flat).collect::<Vec<_>>(), &stroke("#e4e8ec", 1.0));
        drawing.within(self.frame, draw);
        drawing.rect(self.frame, &stroke(LINE, 1.2));
        for (tick, words) in up.iter().zip(tick_labels(&up)) {
            drawing.text([left - 9.0, self.up.at(*tick) + 6.0], &words, &[SMALL, END]);
        }
        if let Some(name) = below {
            for (tick, words) in across.iter().zip(tick_labels(&across)) {
                drawing.text([self.across.at(*tick), bottom + 23.0], &words, &[SMALL, MIDDLE]);
            }
            drawing.text([middle, bottom + 53.0], name, &[SMALL, MIDDLE]);
        }
        if let Some(name) = beside {
            let turned = format!("transform=\"translate({:.1} {level:.1}) rotate(-90)\"", left - 72.0);
            drawing.group(&turned, |drawing| drawing.text([0.0; 2], name, &[SMALL, MIDDLE]));
        }
    }

    /// A line across the frame at a limit.
    pub fn limit(&self, drawing: &mut Drawing, at: f64, look: &str) {
        let [left, right] = self.across.places;
        drawing.line([left, self.up.at(at)], [right, self.up.at(at)], look);
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
    fn ticks_are_round_numbers_within_the_range() {
        assert_eq!(scale([0.0, 42.7]).ticks(8), [0.0, 10.0, 20.0, 30.0, 40.0]);
        let ticks = scale([-0.31, 0.29]).ticks(6);
        assert_eq!(ticks, scale([0.29, -0.31]).ticks(6));
        assert_eq!(tick_labels(&ticks), ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2"]);
        assert_eq!(
            tick_labels(&scale([0.0, 2.0]).ticks(4)),
            ["0.0", "0.5", "1.0", "1.5", "2.0"]
        );
        for nonsense in [[0.0, 0.0], [f64::NAN, 1.0], [0.0, f64::INFINITY]] {
            assert!(scale(nonsense).ticks(5).is_empty(), "{nonsense:?}");
        }
    }
}
