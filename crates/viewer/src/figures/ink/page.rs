//! The sheet of a figure: a title, what is drawn, and a foot. As large as a slide.

use super::drawing::{Drawing, Lettering, Rect};
use super::font::Weight;
use super::palette::{GREY, INK, LINE};
use super::style::Style;

/// Width and height of a figure \[px\].
pub const SIZE: [f64; 2] = [1600.0, 1000.0];

/// White around everything \[px\].
pub const MARGIN: f64 = 50.0;

/// The words around a figure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Words {
    /// What it shows.
    pub title: String,
    /// More of it, smaller.
    pub subtitle: String,
    /// How it is to be read: one or two lines at the foot.
    pub caption: String,
    /// Where it comes from, at the foot on the right.
    pub source: String,
}

/// A new sheet with its words, and where there is room for the rest.
#[must_use]
pub fn begin(words: &Words) -> (Drawing, Rect) {
    let mut drawing = Drawing::new(SIZE);
    let width = SIZE[0] - 2.0 * MARGIN;
    let title = Weight::Bold.fitted(&words.title, 33.0, width);
    drawing.text([MARGIN, 66.0], &title, &Lettering::new(33.0, INK).bold());
    let subtitle = Weight::Regular.fitted(&words.subtitle, 21.0, width);
    drawing.text([MARGIN, 101.0], &subtitle, &Lettering::new(21.0, GREY));
    let foot = SIZE[1] - 74.0;
    drawing.line([MARGIN, foot], [SIZE[0] - MARGIN, foot], &Style::line(LINE, 1.0));
    let how = Lettering::new(16.0, GREY);
    let source = Weight::Regular.fitted(&words.source, 16.0, 0.4 * width);
    let taken = Weight::Regular.width(&source, 16.0);
    drawing.text([SIZE[0] - MARGIN, foot + 26.0], &source, &how.to_the_left());
    let lines = Weight::Regular.lines(&words.caption, 16.0, width - taken - 60.0);
    for (k, line) in lines.iter().take(2).enumerate() {
        drawing.text([MARGIN, foot + 26.0 + 22.0 * k as f64], line, &how);
    }
    let top = 126.0;
    (drawing, Rect::new(MARGIN, top, width, foot - 18.0 - top))
}
