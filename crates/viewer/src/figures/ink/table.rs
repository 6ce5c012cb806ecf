//! A table of words.

use super::drawing::{Drawing, Lettering, Rect};
use super::font::Weight;
use super::palette::{GREY, GROUND, INK, LINE};
use super::style::Style;

/// A column: its heading, its width \[px\] and which side its words keep to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column {
    /// Heading.
    pub heading: &'static str,
    /// Width \[px\].
    pub width: f64,
    /// Whether words end at its right edge, as numbers do.
    pub side: Side,
}

/// Which edge of a column words keep to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// They begin at the left one.
    Left,
    /// They end at the right one.
    Right,
}

/// A cell: words and their colour; in bold where they are what counts.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The words.
    pub words: String,
    /// Their colour.
    pub colour: &'static str,
    /// Their weight.
    pub weight: Weight,
}

impl Cell {
    /// Words in ink.
    #[must_use]
    pub fn new(words: impl Into<String>) -> Self {
        Self {
            words: words.into(),
            colour: INK,
            weight: Weight::Regular,
        }
    }

    /// Bold words of a colour.
    #[must_use]
    pub fn marked(words: impl Into<String>, colour: &'static str) -> Self {
        Self {
            words: words.into(),
            colour,
            weight: Weight::Bold,
        }
    }
}

/// Room between a column's edge and its words \[px\].
const PAD: f64 = 10.0;

/// Draws a table from the left upper corner of a room, with rows as high as fit between `least` and `most` \[px\]; how many rows there
/// was room for.
pub fn draw(
    drawing: &mut Drawing,
    room: Rect,
    [least, most]: [f64; 2],
    columns: &[Column],
    rows: &[Vec<Cell>],
) -> usize {
    let [x0, y0] = room.at;
    let fits = room.size[1] / (rows.len() + 1) as f64;
    let height = fits.clamp(least, most);
    let size = (0.56 * height).clamp(11.0, 19.0);
    let shown = (((room.size[1] / height) + 1e-9).floor() as usize)
        .saturating_sub(1)
        .min(rows.len());
    let width: f64 = columns.iter().map(|column| column.width).sum();
    let line = |y: f64| [[x0, y], [x0 + width, y]];
    for k in (1..shown).step_by(2) {
        let stripe = Rect::new(x0, y0 + height * (k + 1) as f64, width, height);
        drawing.rect(stripe, 0.0, &Style::fill(GROUND));
    }
    let heading = |column: &Column| Cell {
        words: column.heading.to_owned(),
        colour: GREY,
        weight: Weight::Bold,
    };
    row(
        drawing,
        [x0, y0, height, size],
        columns,
        &columns.iter().map(heading).collect::<Vec<_>>(),
    );
    for (k, cells) in rows.iter().take(shown).enumerate() {
        row(
            drawing,
            [x0, y0 + height * (k + 1) as f64, height, size],
            columns,
            cells,
        );
    }
    let ends = [y0 + height, y0 + height * (shown + 1) as f64];
    drawing.polylines(&ends.map(line), &Style::line(LINE, 1.2));
    shown
}

fn row(drawing: &mut Drawing, [x0, y, height, size]: [f64; 4], columns: &[Column], cells: &[Cell]) {
    let mut x = x0;
    for (column, cell) in columns.iter().zip(cells) {
        let words = cell.weight.fitted(&cell.words, size, column.width - 2.0 * PAD);
        let how = Lettering {
            weight: cell.weight,
            ..Lettering::new(size, cell.colour)
        };
        let line = y + 0.5 * height + how.drop();
        match column.side {
            Side::Left => drawing.text([x + PAD, line], &words, &how),
            Side::Right => drawing.text([x + column.width - PAD, line], &words, &how.to_the_left()),
        }
        x += column.width;
    }
}
