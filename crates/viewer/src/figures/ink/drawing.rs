//! A drawing in the making: shapes and texts one above the other, as SVG.

use super::font::{self, Letter, Weight};
use super::style::{Style, attribute, number, push_number};
use std::collections::BTreeSet;
use std::fmt::Write;

/// A place on a drawing \[px\]: x to the right, y down.
pub type Spot = [f64; 2];

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
    #[must_use]
    pub fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self {
            at: [x, y],
            size: [width, height],
        }
    }

    /// The right lower corner.
    #[must_use]
    pub fn end(&self) -> Spot {
        [self.at[0] + self.size[0], self.at[1] + self.size[1]]
    }

    /// Its middle.
    #[must_use]
    pub fn middle(&self) -> Spot {
        [self.at[0] + 0.5 * self.size[0], self.at[1] + 0.5 * self.size[1]]
    }

    /// Whether another rectangle lies within it.
    #[cfg(test)]
    #[must_use]
    pub fn holds(&self, other: &Self) -> bool {
        (0..2).all(|k| other.at[k] >= self.at[k] && other.end()[k] <= self.end()[k])
    }

    /// Whether another rectangle has a part in it.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        (0..2).all(|k| other.at[k] < self.end()[k] && self.at[k] < other.end()[k])
    }
}

/// Which part of a text stands at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// Which way a text runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Run {
    /// To the right.
    Across,
    /// Upwards.
    Up,
}

/// How a text is set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lettering {
    /// Size \[px\].
    pub size: f64,
    /// Weight.
    pub weight: Weight,
    /// Colour.
    pub colour: &'static str,
    /// What of it stands at its place.
    pub anchor: Anchor,
    /// Which way it runs.
    pub run: Run,
    /// Width of the white around its letters \[px\].
    pub halo: f64,
}

impl Lettering {
    /// Regular letters of a size \[px\] and a colour, from their place to the right.
    #[must_use]
    pub fn new(size: f64, colour: &'static str) -> Self {
        Self {
            size,
            weight: Weight::Regular,
            colour,
            anchor: Anchor::Start,
            run: Run::Across,
            halo: 0.0,
        }
    }

    /// The same in bold.
    #[must_use]
    pub fn bold(self) -> Self {
        Self {
            weight: Weight::Bold,
            ..self
        }
    }

    /// The same with its middle at its place.
    #[must_use]
    pub fn centred(self) -> Self {
        Self {
            anchor: Anchor::Middle,
            ..self
        }
    }

    /// The same with its end at its place.
    #[must_use]
    pub fn to_the_left(self) -> Self {
        Self {
            anchor: Anchor::End,
            ..self
        }
    }

    /// The same, upwards.
    #[must_use]
    pub fn upwards(self) -> Self {
        Self { run: Run::Up, ..self }
    }

    /// The same on a white ground as wide \[px\].
    #[must_use]
    pub fn on_white(self, halo: f64) -> Self {
        Self { halo, ..self }
    }

    /// How far below its middle a text's line is \[px\].
    #[must_use]
    pub fn drop(&self) -> f64 {
        // Half the height of a capital.
        0.365 * self.size
    }
}

/// A text that was drawn, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The text.
    pub words: String,
    /// What its letters keep within.
    pub bounds: Rect,
}

/// A drawing in the making.
#[derive(Debug, Clone)]
pub struct Drawing {
    size: [f64; 2],
    body: String,
    letters: BTreeSet<Letter>,
    clips: usize,
    texts: Vec<Drawn>,
}

impl Drawing {
    /// A white sheet of a width and height \[px\].
    #[must_use]
    pub fn new(size: [f64; 2]) -> Self {
        Self {
            size,
            body: String::new(),
            letters: BTreeSet::new(),
            clips: 0,
            texts: Vec::new(),
        }
    }

    /// The texts so far.
    #[must_use]
    pub fn texts(&self) -> &[Drawn] {
        &self.texts
    }

    /// A straight line.
    pub fn line(&mut self, from: Spot, to: Spot, style: &Style) {
        self.polyline(&[from, to], style);
    }

    /// A line through places.
    pub fn polyline(&mut self, through: &[Spot], style: &Style) {
        self.outline(&[through], "", style);
    }

    /// Several lines in one style, as one shape.
    pub fn polylines<P: AsRef<[Spot]>>(&mut self, lines: &[P], style: &Style) {
        self.outline(lines, "", style);
    }

    /// A closed shape.
    pub fn polygon(&mut self, corners: &[Spot], style: &Style) {
        self.outline(&[corners], "Z", style);
    }

    /// Several closed shapes in one style, as one.
    pub fn polygons<P: AsRef<[Spot]>>(&mut self, shapes: &[P], style: &Style) {
        self.outline(shapes, "Z", style);
    }

    fn outline<P: AsRef<[Spot]>>(&mut self, parts: &[P], end: &str, style: &Style) {
        let mut path = String::new();
        for part in parts {
            for (k, [x, y]) in part.as_ref().iter().enumerate() {
                path.push(if k == 0 { 'M' } else { 'L' });
                push_number(&mut path, *x);
                path.push(' ');
                push_number(&mut path, *y);
            }
            path += end;
        }
        if !path.is_empty() {
            self.element("path", &format!(" d=\"{path}\"{}", style.attributes()));
        }
    }

    /// A rectangle, its corners rounded \[px\].
    pub fn rect(&mut self, rect: Rect, rounded: f64, style: &Style) {
        let mut attributes = String::new();
        let [x, y] = rect.at;
        let [width, height] = rect.size;
        for (name, value) in [("x", x), ("y", y), ("width", width), ("height", height)] {
            attributes += &attribute(name, value);
        }
        if rounded > 0.0 {
            attributes += &attribute("rx", rounded);
        }
        self.element("rect", &(attributes + &style.attributes()));
    }

    /// Rectangles of one colour, as one shape without seams between them.
    pub fn cells(&mut self, cells: &[Rect], colour: &str) {
        let mut path = String::new();
        for Rect { at: [x, y], size } in cells {
            path.push('M');
            push_number(&mut path, *x);
            path.push(' ');
            push_number(&mut path, *y);
            for (letter, value) in [('h', size[0]), ('v', size[1]), ('h', -size[0])] {
                path.push(letter);
                push_number(&mut path, value);
            }
            path.push('z');
        }
        if !path.is_empty() {
            let crisp = format!(" d=\"{path}\" fill=\"{colour}\" shape-rendering=\"crispEdges\"");
            self.element("path", &crisp);
        }
    }

    /// A circle.
    pub fn circle(&mut self, [x, y]: Spot, radius: f64, style: &Style) {
        let place = attribute("cx", x) + &attribute("cy", y) + &attribute("r", radius);
        self.element("circle", &(place + &style.attributes()));
    }

    /// What `draw` adds, seen within a circle alone.
    pub fn within_circle(&mut self, [x, y]: Spot, radius: f64, draw: impl FnOnce(&mut Self)) {
        let place = attribute("cx", x) + &attribute("cy", y) + &attribute("r", radius);
        self.within(&format!("<circle{place}/>"), draw);
    }

    /// What `draw` adds, seen within a rectangle alone.
    pub fn within_rect(&mut self, rect: Rect, draw: impl FnOnce(&mut Self)) {
        let ([x, y], [width, height]) = (rect.at, rect.size);
        let place = attribute("x", x) + &attribute("y", y);
        let size = attribute("width", width) + &attribute("height", height);
        self.within(&format!("<rect{place}{size}/>"), draw);
    }

    /// What `draw` adds, seen within a polygon alone.
    pub fn within_polygon(&mut self, corners: &[Spot], draw: impl FnOnce(&mut Self)) {
        let places: Vec<_> = corners
            .iter()
            .map(|[x, y]| format!("{},{}", number(*x), number(*y)))
            .collect();
        self.within(&format!("<polygon points=\"{}\"/>", places.join(" ")), draw);
    }

    fn within(&mut self, shape: &str, draw: impl FnOnce(&mut Self)) {
        let clip = self.clips;
        self.clips += 1;
        self.body += &format!("<clipPath id=\"c{clip}\">{shape}</clipPath>\n<g clip-path=\"url(#c{clip})\">\n");
        draw(self);
        self.body += "</g>\n";
    }

    /// What `draw` adds, as one layer that lets what is below through: 0 for all of it, 1 for nothing.
    pub fn layer(&mut self, opacity: f64, draw: impl FnOnce(&mut Self)) {
        self.body += &format!("<g{}>\n", attribute("opacity", opacity));
        draw(self);
        self.body += "</g>\n";
    }

    /// What `draw` adds, under a name that a reader of the file finds.
    pub fn named(&mut self, name: &str, draw: impl FnOnce(&mut Self)) {
        self.body += &format!("<g id=\"{}\">\n", escaped(name));
        draw(self);
        self.body += "</g>\n";
    }

    /// A text on one line, which is at its place.
    pub fn text(&mut self, place: Spot, words: &str, how: &Lettering) {
        let words: String = words.chars().filter(|c| !c.is_control()).collect();
        let (letters, end) = how.weight.letters(&words);
        if letters.is_empty() {
            return;
        }
        let scale = how.size / how.weight.units();
        let width = end * scale;
        let before = match how.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * width,
            Anchor::End => width,
        };
        let [x, y] = place;
        let [above, below] = how.weight.reach().map(|share| share * how.size);
        let (origin, bounds, turn) = match how.run {
            Run::Across => {
                let from = [x - before, y];
                (from, Rect::new(from[0], y - above, width, above + below), "")
            }
            Run::Up => {
                let from = [x, y + before];
                let bounds = Rect::new(x - above, from[1] - width, above + below, width);
                (from, bounds, " rotate(-90)")
            }
        };
        self.set(&letters, &words, origin, turn, how);
        self.texts.push(Drawn { words, bounds });
    }

    /// Letters at an origin, turned.
    fn set(&mut self, letters: &[(Letter, f64)], words: &str, [x, y]: Spot, turn: &str, how: &Lettering) {
        let scale = how.size / how.weight.units();
        let halo = if how.halo > 0.0 {
            let width = number(2.0 * how.halo / scale);
            format!(" stroke=\"#ffffff\" stroke-width=\"{width}\" stroke-linejoin=\"round\" paint-order=\"stroke\"")
        } else {
            String::new()
        };
        // Writing to a string does not fail.
        let _ = write!(
            self.body,
            "<g role=\"img\" aria-label=\"{}\" fill=\"{}\"{halo} transform=\"translate({} {}){turn} scale({scale:.6} -{scale:.6})\">",
            escaped(words),
            how.colour,
            number(x),
            number(y)
        );
        for &(letter, at) in letters {
            let at = if at == 0.0 { String::new() } else { attribute("x", at) };
            self.body += &format!("<use xlink:href=\"#{}\"{at}/>", id(letter));
            self.letters.insert(letter);
        }
        self.body += "</g>\n";
    }

    fn element(&mut self, name: &str, attributes: &str) {
        self.body += &format!("<{name}{attributes}/>\n");
    }

    /// The drawing as an SVG file; title and description are for those who hear it.
    #[must_use]
    pub fn finish(&self, title: &str, description: &str) -> String {
        let [width, height] = self.size.map(number);
        let (title, description) = (escaped(title), escaped(description));
        let mut letters = String::new();
        for &letter in &self.letters {
            letters += &format!("<path id=\"{}\" d=\"{}\"/>\n", id(letter), font::outline(letter));
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{width}\" \
             height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\">\n\
             <title>{title}</title>\n<desc>{description}</desc>\n<defs>\n{letters}</defs>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.body
        )
    }
}

fn id((weight, glyph): Letter) -> String {
    let weight = match weight {
        Weight::Regular => 'r',
        Weight::Bold => 'b',
    };
    format!("{weight}{glyph}")
}

/// A text as XML has it between tags and in attributes; what XML cannot say is left out.
fn escaped(text: &str) -> String {
    let mut all = String::new();
    for c in text.chars() {
        match c {
            '&' => all += "&amp;",
            '<' => all += "&lt;",
            '>' => all += "&gt;",
            '"' => all += "&quot;",
            '\n' | '\t' => all.push(' '),
            '\u{fffe}' | '\u{ffff}' => {}
            c if c.is_control() => {}
            c => all.push(c),
        }
    }
    all
}
