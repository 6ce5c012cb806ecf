//! How shapes are filled and lines are drawn.

use std::fmt::Write;

/// A colour as SVG writes it, `#rrggbb`.
pub type Colour = &'static str;

/// Fill and stroke of a shape. Widths and dashes are in pixels of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    fill: String,
    stroke: Option<(String, f64)>,
    dashes: &'static [f64],
    fill_opacity: f64,
    round: bool,
}

impl Style {
    /// Filled, without an outline.
    #[must_use]
    pub fn fill(colour: impl Into<String>) -> Self {
        Self {
            fill: colour.into(),
            stroke: None,
            dashes: &[],
            fill_opacity: 1.0,
            round: false,
        }
    }

    /// A line of that width \[px\], not filled, its ends and corners round.
    #[must_use]
    pub fn line(colour: impl Into<String>, width: f64) -> Self {
        Self {
            stroke: Some((colour.into(), width)),
            round: true,
            ..Self::fill("none")
        }
    }

    /// The same with an outline of that width \[px\].
    #[must_use]
    pub fn outlined(self, colour: impl Into<String>, width: f64) -> Self {
        Self {
            stroke: Some((colour.into(), width)),
            ..self
        }
    }

    /// The same line dashed: lengths of dashes and gaps \[px\].
    #[must_use]
    pub fn dashed(self, dashes: &'static [f64]) -> Self {
        Self {
            dashes,
            round: false,
            ..self
        }
    }

    /// The same with a fill that lets what is below through: 0 for all of it, 1 for nothing.
    #[must_use]
    pub fn see_through(self, opacity: f64) -> Self {
        Self {
            fill_opacity: opacity,
            ..self
        }
    }

    /// As attributes of an SVG element, a space before each.
    pub(super) fn attributes(&self) -> String {
        let mut all = format!(" fill=\"{}\"", self.fill);
        if self.fill_opacity != 1.0 {
            all += &attribute("fill-opacity", self.fill_opacity);
        }
        if let Some((colour, width)) = &self.stroke {
            all += &format!(" stroke=\"{colour}\"");
            all += &attribute("stroke-width", *width);
            all += " stroke-linejoin=\"round\"";
        }
        if self.round {
            all += " stroke-linecap=\"round\"";
        }
        if !self.dashes.is_empty() {
            let dashes: Vec<_> = self.dashes.iter().map(|&dash| number(dash)).collect();
            all += &format!(" stroke-dasharray=\"{}\"", dashes.join(" "));
        }
        all
    }
}

/// An attribute that is a number, with a space before.
pub(super) fn attribute(name: &str, value: f64) -> String {
    format!(" {name}=\"{}\"", number(value))
}

/// A number to a hundredth, as short as it goes; what is not finite is 0, as SVG knows no other.
pub(super) fn number(value: f64) -> String {
    let mut text = String::new();
    push_number(&mut text, value);
    text
}

/// [`number`] at the end of a text.
pub(super) fn push_number(text: &mut String, value: f64) {
    let hundredths = (100.0 * value).round();
    if !hundredths.is_finite() || hundredths == 0.0 {
        text.push('0');
        return;
    }
    let from = text.len();
    // Writing to a string does not fail.
    let _ = write!(text, "{:.2}", hundredths / 100.0);
    let kept = text[from..].trim_end_matches('0').trim_end_matches('.').len();
    text.truncate(from + kept);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_never_nothing() {
        for (value, text) in [
            (0.0, "0"),
            (-0.001, "0"),
            (10.0, "10"),
            (-1.5, "-1.5"),
            (2.0 / 3.0, "0.67"),
            (100.0, "100"),
            (f64::NAN, "0"),
            (f64::INFINITY, "0"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
