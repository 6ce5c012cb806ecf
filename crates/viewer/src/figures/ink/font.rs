//! Letters as outlines: a figure looks alike on every machine, whatever fonts it has.
//!
//! The typeface is DejaVu Sans Condensed, which the crate `dejavu` carries. Letters stand one after the other as they are stored:
//! scripts that join or turn letters are not shaped.

use super::style::push_number;
use std::sync::LazyLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Weight of letters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// For text.
    Regular,
    /// For headings.
    Bold,
}

/// A letter that a drawing uses: weight and index in its font.
pub type Letter = (Weight, u16);

static REGULAR: LazyLock<Option<Face<'static>>> = LazyLock::new(|| parsed(dejavu::sans_condensed::regular()));
static BOLD: LazyLock<Option<Face<'static>>> = LazyLock::new(|| parsed(dejavu::sans_condensed::bold()));

/// The font is a part of the program: without it, texts are empty, and tests fail.
fn parsed(bytes: &'static [u8]) -> Option<Face<'static>> {
    Face::parse(bytes, 0).ok()
}

impl Weight {
    fn face(self) -> Option<&'static Face<'static>> {
        match self {
            Self::Regular => REGULAR.as_ref(),
            Self::Bold => BOLD.as_ref(),
        }
    }

    /// Units of the font to the height of its letters, which a text's size states.
    pub(super) fn units(self) -> f64 {
        self.face().map_or(1.0, |face| f64::from(face.units_per_em()))
    }

    /// How far letters reach above the line they stand on, and below it, as shares of the size.
    pub(super) fn reach(self) -> [f64; 2] {
        let units = self.units();
        self.face().map_or([0.0; 2], |face| {
            [f64::from(face.ascender()) / units, -f64::from(face.descender()) / units]
        })
    }

    /// The letters of a text and where each begins, and where the last one ends, in units of the font.
    pub(super) fn letters(self, words: &str) -> (Vec<(Letter, f64)>, f64) {
        let Some(face) = self.face() else {
            return (Vec::new(), 0.0);
        };
        let (mut all, mut x) = (Vec::new(), 0.0);
        for c in words.chars() {
            let glyph = face.glyph_index(c).unwrap_or(GlyphId(0));
            all.push(((self, glyph.0), x));
            x += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        }
        (all, x)
    }

    /// Width of a text of that size \[px\].
    #[must_use]
    pub fn width(self, words: &str, size: f64) -> f64 {
        self.letters(words).1 * size / self.units()
    }

    /// A text of that size that is no wider than `most` \[px\]: where it would be, it ends in "…".
    #[must_use]
    pub fn fitted(self, words: &str, size: f64, most: f64) -> String {
        // No name is read to its end that could not be shown.
        let words: String = words.chars().take(LONGEST).map(printable).collect();
        if self.width(&words, size) <= most {
            return words;
        }
        let mut kept: Vec<char> = words.chars().collect();
        while !kept.is_empty() {
            kept.pop();
            let shortened: String = kept.iter().collect::<String>().trim_end().to_owned() + "…";
            if self.width(&shortened, size) <= most {
                return shortened;
            }
        }
        String::new()
    }

    /// A text in lines of that size, none wider than `most` \[px\] where words can be parted.
    #[must_use]
    pub fn lines(self, words: &str, size: f64, most: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in words.split_whitespace() {
            let longer = lines.last().map(|line| format!("{line} {word}"));
            match (lines.last_mut(), longer) {
                (Some(line), Some(longer)) if self.width(&longer, size) <= most => *line = longer,
                _ => lines.push(self.fitted(word, size, most)),
            }
        }
        lines
    }
}

/// Most letters of one text.
const LONGEST: usize = 400;

/// A letter, or a space in place of what would move the pen or the lines.
fn printable(c: char) -> char {
    if c.is_control() { ' ' } else { c }
}

/// The outline of a letter as SVG's path data, in units of the font, y up.
pub(super) fn outline((weight, glyph): Letter) -> String {
    let mut outline = Outline(String::new());
    if let Some(face) = weight.face() {
        // A space has none.
        let _ = face.outline_glyph(GlyphId(glyph), &mut outline);
    }
    outline.0
}

/// Path data in the making.
struct Outline(String);

impl Outline {
    fn push(&mut self, letter: char, numbers: &[f32]) {
        self.0.push(letter);
        for (k, &value) in numbers.iter().enumerate() {
            if k > 0 {
                self.0.push(' ');
            }
            push_number(&mut self.0, f64::from(value));
        }
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.push('M', &[x, y]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.push('L', &[x, y]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.push('Q', &[x1, y1, x, y]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.push('C', &[x1, y1, x2, y2, x, y]);
    }

    fn close(&mut self) {
        self.0.push('Z');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_what_figures_say() {
        for weight in [Weight::Regular, Weight::Bold] {
            let said = "AZaz09 °²·×–…≤≥→±µ½ΔΣ√−✓✗“”";
            let missing: Vec<char> = said
                .chars()
                .filter(|&c| weight.letters(&c.to_string()).0[0].0.1 == 0)
                .collect();
            assert!(missing.is_empty(), "{weight:?}: {missing:?}");
            assert!(outline(weight.letters("o").0[0].0).matches('Z').count() == 2);
            assert!(weight.width("mm", 20.0) > weight.width("m", 20.0));
        }
    }

    #[test]
    fn what_is_too_long_is_shortened_or_parted() {
        let (weight, words) = (Weight::Regular, "a name of many words, \n\u{7} or of one");
        let all = weight.fitted(words, 10.0, 1e3);
        assert!(!all.contains(char::is_control) && all.ends_with("one"));
        for most in [0.0, 20.0, 60.0, 120.0] {
            let fitted = weight.fitted(words, 10.0, most);
            assert!(weight.width(&fitted, 10.0) <= most && (fitted.is_empty() || fitted.ends_with('…')));
        }
        assert!(weight.fitted(&"x".repeat(10_000), 1.0, 1e9).len() <= LONGEST);
        let lines = weight.lines(words, 10.0, 60.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| weight.width(line, 10.0) <= 60.0));
    }
}
