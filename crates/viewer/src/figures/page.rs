//! The sheet of a figure: its words, and the key of its lines and colours. It has the size of a slide.

use super::svg::{Drawing, GREY, INK, LINE, Rect, SMALL, Spot, WORDS, lines, stroke, width};
use platewash_workcell::words::shortened;

/// Width and height of a figure \[px\].
pub const SIZE: [f64; 2] = [1280.0, 960.0];

/// White around everything \[px\].
const MARGIN: f64 = 40.0;

/// From one line of the subtitle to the next \[px\].
const SUBTITLE: f64 = 27.0;

/// The words around a figure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FigureTexts {
    /// Title of the figure.
    pub title: String,
    /// More of it, smaller.
    pub subtitle: String,
    /// Caption that explains it, at the foot.
    pub caption: String,
    /// Source of the data, at the end of the caption.
    pub source: String,
}

/// A new sheet with its words, and where there is room for the rest.
pub fn begin(texts: &FigureTexts) -> (Drawing, Rect) {
    let mut drawing = Drawing::default();
    let [title, subtitle] =
        [(33, INK), (21, GREY)].map(|(size, colour)| format!("font-size=\"{size}\" fill=\"{colour}\""));
    // As many letters as there is room for, were all of them wide.
    drawing.text(
        [MARGIN, 66.0],
        &shortened(&texts.title, 49),
        &[&title, "font-weight=\"bold\""],
    );
    let right = SIZE[0] - MARGIN;
    let below = lines(&texts.subtitle, 21.0, right - MARGIN);
    for (k, line) in below.iter().enumerate() {
        drawing.text([MARGIN, 101.0 + SUBTITLE * k as f64], line, &[&subtitle]);
    }
    let words = format!("{} Source: {}.", texts.caption, texts.source);
    let words = lines(&words, 18.0, right - MARGIN);
    let foot = SIZE[1] - 26.0 - 23.0 * words.len() as f64;
    drawing.line([MARGIN, foot], [right, foot], &stroke(LINE, 1.0));
    for (k, line) in words.iter().enumerate() {
        drawing.text([MARGIN, foot + 26.0 + 23.0 * k as f64], line, &[SMALL]);
    }
    let top = 126.0 + SUBTITLE * below.len().saturating_sub(1) as f64;
    (drawing, Rect::new(MARGIN, top, right - MARGIN, foot - 18.0 - top))
}

/// Entry of a legend: a sign with its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    sign: Sign,
    look: String,
    words: String,
}

/// Sign in front of the words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sign {
    Line,
    Field,
    Dot,
}

impl Entry {
    /// A sign with its look, and its words.
    pub fn new(sign: Sign, look: impl Into<String>, words: impl Into<String>) -> Self {
        let (look, words) = (look.into(), words.into());
        Self { sign, look, words }
    }
}

/// Width of a sign with the white behind it, and from one line to the next \[px\].
const SIGN: f64 = 50.0;
const LEADING: f64 = 28.0;

/// Entries beside one another where `width` \[px\] has room, in lines else; their lower end \[px\].
pub fn legend(drawing: &mut Drawing, [left, top]: Spot, most: f64, entries: &[Entry]) -> f64 {
    let ([mut x, mut y], mut end) = ([left, top], top);
    for Entry { sign, look, words } in entries {
        let takes = SIGN + width(words, 20.0);
        if x > left && x + takes > left + most {
            (x, y) = (left, end + 9.0);
        }
        match sign {
            Sign::Line => drawing.line([x, y + 11.0], [x + 38.0, y + 11.0], look),
            Sign::Field => drawing.rect(Rect::new(x + 4.0, y + 2.0, 30.0, 18.0), look),
            Sign::Dot => drawing.circle([x + 19.0, y + 11.0], 7.0, look),
        }
        for (k, line) in lines(words, 20.0, most - SIGN).iter().enumerate() {
            let below = y + LEADING * k as f64;
            drawing.text([x + SIGN, below + 17.0], line, &[WORDS]);
            end = end.max(below + LEADING);
        }
        x += takes + 24.0;
    }
    end
}
