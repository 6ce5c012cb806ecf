//! A drawing in the making, as SVG: shapes and texts one above the other.
//!
//! Looks are SVG's own attributes, made by [`fill`], [`stroke`] and [`outlined`], so that a drawing within a page needs no style sheet and
//! no names that another drawing could have, too.

use crate::page::escaped_but_for_apostrophes;

/// A place on a drawing \[px\]: x to the right, y down.
pub type Spot = [f64; 2];

/// Text and frames of importance. Colours that mean something are those of the page, `page/src/palette.ts`.
pub const INK: &str = "#16202a";
/// Text beside.
pub const GREY: &str = "#56636f";
/// Outlines and frames.
pub const LINE: &str = "#8c959f";
/// Grounds of boxes.
pub const GROUND: &str = "#f6f8fa";
/// White.
pub const PAPER: &str = "#ffffff";
/// The six joints, in their order.
pub const JOINTS: [&str; 6] = ["#0072b2", "#b57b00", "#00805e", "#c4500a", "#3aa0d8", "#a9427f"];
/// The path on a plate, magenta as in the paper. The colours also differ for readers with colour blindness (after Okabe and Ito).
pub const WASH: &str = "#cc00a0";
/// The way between plates.
pub const TRANSIT: &str = "#0072b2";
/// Down to a plate and up from it.
pub const LIFT: &str = "#e69f00";
/// From home and to it.
pub const HOME: &str = "#7c8b98";
/// Colour of the executed motion, and of places that were not reached.
pub const EXECUTED: &str = "#c4500a";
/// Colour of requirements that are kept.
pub const GOOD: &str = "#00775a";
/// Colour of requirements that are not kept, and of limits.
pub const BAD: &str = "#b5460b";

/// Looks of texts: size, weight and colour.
pub const WORDS: &str = "font-size=\"20\" fill=\"#16202a\"";
pub const BOLD: &str = "font-size=\"20\" fill=\"#16202a\" font-weight=\"bold\"";
pub const SMALL: &str = "font-size=\"18\" fill=\"#56636f\"";
/// Anchor of a text that does not begin at its place.
pub const MIDDLE: &str = "text-anchor=\"middle\"";
pub const END: &str = "text-anchor=\"end\"";
/// Dashes of a line.
pub const DASHED: &str = " stroke-dasharray=\"9 6\"";
pub const DOTTED: &str = " stroke-dasharray=\"3 5\"";

/// The look of a shape that is filled, without an outline.
pub fn fill(colour: &str) -> String {
    format!("fill=\"{colour}\"")
}

/// The look of a line of that width \[px\].
pub fn stroke(colour: &str, width: f64) -> String {
    outlined("none", colour, width)
}

/// The look of a shape that is filled and has an outline of that width \[px\].
pub fn outlined(ground: &str, colour: &str, width: f64) -> String {
    format!("fill=\"{ground}\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"")
}

/// A rectangle on a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// The left upper corner.
    pub at: Spot,
    /// Width and height \[px\].
    pub size: [f64; 2],
}

impl Rect {
    /// A rectangle by its corner, its width and its height \[px\].
    pub fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self {
            at: [x, y],
            size: [width, height],
        }
    }

    /// The right lower corner.
    pub fn end(&self) -> Spot {
        [self.at[0] + self.size[0], self.at[1] + self.size[1]]
    }

    /// Its middle.
    pub fn middle(&self) -> Spot {
        [self.at[0] + 0.5 * self.size[0], self.at[1] + 0.5 * self.size[1]]
    }

    fn attributes(&self) -> String {
        let ([x, y], [width, height]) = (self.at.map(number), self.size.map(number));
        format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
    }
}

/// A drawing in the making.
#[derive(Debug, Clone, Default)]
pub struct Drawing(String);

impl Drawing {
    /// Elements as they are.
    pub fn raw(&mut self, elements: &str) {
        self.0 += elements;
    }

    /// A straight line.
    pub fn line(&mut self, from: Spot, to: Spot, look: &str) {
        self.lines(&[vec![from, to]], look);
    }

    /// Lines through places, as one shape.
    pub fn lines(&mut self, lines: &[Vec<Spot>], look: &str) {
        let path: String = lines.iter().map(|line| path_data(line)).collect();
        if !path.is_empty() {
            self.0 += &format!("<path d=\"{path}\" {look}/>\n");
        }
    }

    /// A closed shape.
    pub fn polygon(&mut self, corners: &[Spot], look: &str) {
        self.0 += &format!("<path d=\"{}Z\" {look}/>\n", path_data(corners));
    }

    /// Closed shapes as one, with an edge around all of them and none between: the edges lie below the grounds, which reach out a little.
    pub fn silhouette(&mut self, shapes: &[Vec<Spot>], ground: &str, edge: &str) {
        let path: String = shapes.iter().map(|corners| path_data(corners) + "Z").collect();
        for (colour, width) in [(edge, 4.0), (ground, 1.2)] {
            self.0 += &format!("<path d=\"{path}\" {}/>\n", outlined(ground, colour, width));
        }
    }

    /// A rectangle.
    pub fn rect(&mut self, rect: Rect, look: &str) {
        self.0 += &format!("<rect {} {look}/>\n", rect.attributes());
    }

    /// Rectangles of one colour, as one shape without seams between them.
    pub fn cells(&mut self, cells: &[Rect], colour: &str) {
        let cell = |rect: &Rect| {
            // Neighbours share the edge that both have, rounded.
            let ([x, y], [right, below]) = (rect.at.map(number), rect.end().map(number));
            let [width, height] = [right - x, below - y].map(number);
            format!("M{x} {y}h{width}v{height}h{}z", -width)
        };
        let path: String = cells.iter().map(cell).collect();
        self.0 += &format!("<path d=\"{path}\" fill=\"{colour}\" shape-rendering=\"crispEdges\"/>\n");
    }

    /// A circle.
    pub fn circle(&mut self, at: Spot, radius: f64, look: &str) {
        let [x, y] = at.map(number);
        self.0 += &format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\" {look}/>\n", number(radius));
    }

    /// Draws what `draw` adds, clipped to a rectangle.
    pub fn within(&mut self, rect: Rect, draw: impl FnOnce(&mut Self)) {
        let ([x, y], [width, height]) = (rect.at.map(number), rect.size.map(number));
        let attributes = rect.attributes();
        self.0 += &format!("<svg {attributes} viewBox=\"{x} {y} {width} {height}\" overflow=\"hidden\">\n");
        draw(self);
        self.0 += "</svg>\n";
    }

    /// Draws what `draw` adds, as a group with attributes.
    pub fn group(&mut self, attributes: &str, draw: impl FnOnce(&mut Self)) {
        self.0 += &format!("<g {attributes}>\n");
        draw(self);
        self.0 += "</g>\n";
    }

    /// A text on one line, its line at the place.
    pub fn text(&mut self, at: Spot, words: &str, looks: &[&str]) {
        let ([x, y], looks) = (at.map(number), looks.join(" "));
        self.0 += &format!("<text x=\"{x}\" y=\"{y}\" {looks}>{}</text>\n", escaped(words));
    }

    /// The drawing as a white sheet of a width and height \[px\], with a title for those who hear it.
    pub fn finish(&self, size: [f64; 2], title: &str) -> String {
        let ([width, height], title) = (size, escaped(title));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"Arial, Helvetica, sans-serif\">\n<title>{title}</title>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{PAPER}\"/>\n{}</svg>\n",
            self.0
        )
    }
}

/// A line's path data, without the places that are not needed to draw it.
fn path_data(line: &[Spot]) -> String {
    let mut path = String::new();
    for [x, y] in thinned(line) {
        let letter = if path.is_empty() { 'M' } else { 'L' };
        path += &format!("{letter}{} {}", number(x), number(y));
    }
    path
}

/// Farthest that a line without some of its places is from one of them \[px\].
const OFF_PX: f64 = 0.15;

/// The places of a line that are needed to draw it (Douglas and Peucker).
fn thinned(line: &[Spot]) -> Vec<Spot> {
    let mut is_kept = vec![line.len() < 3; line.len()];
    let mut stretches = vec![(0, line.len().saturating_sub(1))];
    while let Some((from, to)) = stretches.pop().filter(|_| line.len() >= 3) {
        (is_kept[from], is_kept[to]) = (true, true);
        let [a, b] = [line[from], line[to]];
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0] * along[0] + along[1] * along[1];
        let off = |k: usize| {
            let out = [line[k][0] - a[0], line[k][1] - a[1]];
            let share = (out[0] * along[0] + out[1] * along[1]) / length;
            let share = if length > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 };
            let [x, y] = [0, 1].map(|axis| out[axis] - share * along[axis]);
            x * x + y * y
        };
        let farthest = (from + 1..to).max_by(|&a, &b| off(a).total_cmp(&off(b)));
        if let Some(k) = farthest.filter(|&k| off(k) > OFF_PX * OFF_PX) {
            stretches.extend([(from, k), (k, to)]);
        }
    }
    let places = line.iter().zip(is_kept);
    places.filter_map(|(at, is_kept)| is_kept.then_some(*at)).collect()
}

/// A number to a tenth of a pixel; numbers that are not finite become 0, as SVG has no others.
fn number(value: f64) -> f64 {
    let tenths = (10.0 * value).round() / 10.0;
    if tenths.is_finite() { tenths + 0.0 } else { 0.0 }
}

/// A text as XML has it between tags and in attributes; characters that XML cannot hold are left out.
fn escaped(text: &str) -> String {
    let is_said = |c: &char| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}');
    let said: String = text.chars().filter(is_said).collect();
    escaped_but_for_apostrophes(&said)
}

/// About how wide a text of a size is in common sans-serif typefaces, rather more than less \[px\].
pub fn width(words: &str, size: f64) -> f64 {
    let share = |c: char| match c {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | ' ' => 0.33,
        'f' | 'r' | 't' | '(' | ')' | '[' | ']' | '/' | '-' | '"' => 0.42,
        'm' | 'w' | 'M' | 'W' | '%' | '@' | '…' | '≥' | '−' => 0.96,
        '\u{1100}'.. => 1.1,
        c if c.is_uppercase() => 0.72,
        _ => 0.63,
    };
    words.chars().map(share).sum::<f64>() * size
}

/// The size at which a text is no wider than `most` \[px\], at most `size`.
pub fn fitted(words: &str, size: f64, most: f64) -> String {
    format!("font-size=\"{:.1}\"", size.min(size * most / width(words, size)))
}

/// A text in lines of a size, none wider than `most` \[px\] where words can be parted.
pub fn lines(words: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) + 0.33 * size <= most => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_keep_corners_and_labels_are_text() {
        let line: Vec<Spot> = (0..=20_i32)
            .map(|k| [f64::from(k), f64::from((k - 10).abs())])
            .collect();
        assert_eq!(thinned(&line), [line[0], line[10], line[20]]);
        // There and back.
        assert_eq!(thinned(&[[0.0; 2], [5.0, 0.0], [0.0; 2]]).len(), 3);
        assert_eq!(
            [thinned(&[]).len(), thinned(&line[..1]).len(), thinned(&line[..2]).len()],
            [0, 1, 2]
        );
        assert_eq!(
            [0.0, -0.01, 2.0 / 3.0, f64::NAN].map(number).map(|n| n.to_string()),
            ["0", "0", "0.7", "0"]
        );
        assert_eq!(escaped("a<b>&\"\u{7}\n"), "a&lt;b&gt;&amp;&quot;");
        let parted = lines("a name of many words", 10.0, 60.0);
        assert!(
            parted.len() > 2 && parted.iter().all(|line| width(line, 10.0) <= 60.0),
            "{parted:?}"
        );
    }
}
