//! What lines and colours mean.

use super::drawing::{Drawing, Lettering, Rect, Spot};
use super::palette::INK;
use super::style::Style;

/// A sign and its words.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    sign: Sign,
    words: String,
}

/// What stands before the words.
#[derive(Debug, Clone, PartialEq)]
enum Sign {
    Line(Style),
    Field(Style),
    Dot(Style),
}

impl Entry {
    /// A line.
    #[must_use]
    pub fn line(style: Style, words: impl Into<String>) -> Self {
        let words = words.into();
        Self {
            sign: Sign::Line(style),
            words,
        }
    }

    /// A field.
    #[must_use]
    pub fn field(style: Style, words: impl Into<String>) -> Self {
        let words = words.into();
        Self {
            sign: Sign::Field(style),
            words,
        }
    }

    /// A dot.
    #[must_use]
    pub fn dot(style: Style, words: impl Into<String>) -> Self {
        let words = words.into();
        Self {
            sign: Sign::Dot(style),
            words,
        }
    }
}

/// Size of the words \[px\].
const SIZE: f64 = 18.0;
/// Width of a sign \[px\].
const SIGN: f64 = 38.0;
/// From one line to the next \[px\].
const LEADING: f64 = 27.0;

/// Entries one below the other, no wider than `width` \[px\]; where they end \[px\].
pub fn column(drawing: &mut Drawing, [x, mut y]: Spot, width: f64, entries: &[Entry]) -> f64 {
    let how = Lettering::new(SIZE, INK);
    for entry in entries {
        draw_sign(drawing, [x, y + 0.5 * LEADING], &entry.sign);
        for line in how.weight.lines(&entry.words, SIZE, width - SIGN - 12.0) {
            drawing.text([x + SIGN + 12.0, y + 0.5 * LEADING + how.drop()], &line, &how);
            y += LEADING - 3.0;
        }
        y += 9.0;
    }
    y
}

/// Entries beside one another, in further lines where `width` \[px\] does not suffice; where they end \[px\].
pub fn row(drawing: &mut Drawing, [x0, mut y]: Spot, width: f64, entries: &[Entry]) -> f64 {
    let how = Lettering::new(SIZE, INK);
    let mut x = x0;
    for entry in entries {
        let takes = SIGN + 10.0 + how.weight.width(&entry.words, SIZE) + 34.0;
        if x > x0 && x + takes - 34.0 > x0 + width {
            (x, y) = (x0, y + LEADING);
        }
        draw_sign(drawing, [x, y + 0.5 * LEADING], &entry.sign);
        let words = how.weight.fitted(&entry.words, SIZE, width - SIGN - 10.0);
        drawing.text([x + SIGN + 10.0, y + 0.5 * LEADING + how.drop()], &words, &how);
        x += takes;
    }
    y + LEADING
}

fn draw_sign(drawing: &mut Drawing, [x, y]: Spot, sign: &Sign) {
    match sign {
        Sign::Line(style) => drawing.line([x, y], [x + SIGN, y], style),
        Sign::Field(style) => drawing.rect(Rect::new(x + 4.0, y - 9.0, SIGN - 8.0, 18.0), 2.0, style),
        Sign::Dot(style) => drawing.circle([x + 0.5 * SIGN, y], 7.0, style),
    }
}
