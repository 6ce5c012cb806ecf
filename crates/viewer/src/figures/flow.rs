//! How the program goes on, from a scenario to a proved motion (the place of the paper's Fig. 1).

use super::ink::drawing::{Drawing, Lettering, Rect, Spot};
use super::ink::font::Weight;
use super::ink::page::{self, Words};
use super::ink::palette::{BAD, GOOD, GREY, GROUND, INK, LINE, PAPER, TRANSIT, WASH};
use super::ink::style::Style;

/// A step: what is in it, and what it is.
struct Step {
    at: Rect,
    title: &'static str,
    words: &'static str,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Something that is read or written.
    Data,
    /// Work.
    Work,
    /// A question.
    Question,
}

/// Draws it: it is the same for every plan.
#[must_use]
pub fn draw() -> Drawing {
    let (mut drawing, _) = page::begin(&Words {
        title: "How a table of plates becomes a proved motion".to_owned(),
        subtitle: "the way of a washing; the paper's own program is run beside it, to the letter, and measured".to_owned(),
        caption: "Rounded boxes are data, boxes work, magenta ones questions. Each arrow is one function from values to a value; nothing \
                  flows back but a refusal with its reason."
            .to_owned(),
        source: format!("platewash {}", env!("CARGO_PKG_VERSION")),
    });
    let steps = steps();
    arrows(&mut drawing, &steps);
    steps.iter().for_each(|step| step.draw(&mut drawing));
    drawing
}

/// The steps by their places.
fn steps() -> Vec<Step> {
    let (w, h) = (292.0, 122.0);
    let (x, y) = ([50.0, 452.0, 854.0, 1256.0], [142.0, 342.0, 542.0, 752.0]);
    let step = |column: usize, row: usize, kind, title, words| Step {
        at: Rect::new(x[column], y[row], w, h),
        title,
        words,
        kind,
    };
    vec![
        step(
            0,
            0,
            Kind::Data,
            "Scenario",
            "a TOML file: arm, tool, plates or their region, what is required",
        ),
        step(
            0,
            1,
            Kind::Work,
            "Place the plates",
            "given, or drawn from the seed until all have room; dead ends begin anew",
        ),
        step(
            0,
            2,
            Kind::Question,
            "Can each be washed?",
            "every tilt and branch is tried; where not, which part and where else",
        ),
        step(
            1,
            0,
            Kind::Work,
            "Order",
            "the tour of least travel time, or the nearest next, or as listed",
        ),
        step(
            1,
            1,
            Kind::Work,
            "Wash each plate",
            "its pattern; tilt and branch along it, smooth and clear",
        ),
        step(
            1,
            2,
            Kind::Work,
            "Transits",
            "direct, raised, on an arc round the base, or sampled; clear on the whole way",
        ),
        step(
            2,
            0,
            Kind::Work,
            "Timing",
            "as fast as joints and tip may go, from home to home",
        ),
        step(
            2,
            1,
            Kind::Data,
            "Plan",
            "job, wash paths, knots (t, q, dq/dt), sealed with a hash",
        ),
        step(
            2,
            2,
            Kind::Work,
            "Prove",
            "from plan and arm alone: limits, clearance, contact, coverage, at every moment",
        ),
        step(
            3,
            2,
            Kind::Question,
            "All proved?",
            "each requirement is proved, violated, not proved or waived",
        ),
        step(
            3,
            1,
            Kind::Work,
            "Simulate",
            "the arm's dynamics under a control law: what is really washed",
        ),
        step(
            3,
            0,
            Kind::Data,
            "Report and figures",
            "certificate, motion as CSV, page, figures, for people and programs",
        ),
        step(
            0,
            3,
            Kind::Data,
            "Cannot be done",
            "exit code 3 with the reason, the place and what would help",
        ),
        step(
            3,
            3,
            Kind::Data,
            "Not certified",
            "exit code 4 with what is broken, where and when",
        ),
    ]
}

/// From which edge to which a way goes.
fn arrows(drawing: &mut Drawing, steps: &[Step]) {
    let at = |k: usize| steps[k].at;
    let down = |drawing: &mut Drawing, from: usize, to: usize, words: &str, colour| {
        let (a, b) = (at(from), at(to));
        arrow(
            drawing,
            &[[a.middle()[0], a.end()[1]], [b.middle()[0], b.at[1]]],
            words,
            colour,
        );
    };
    let up = |drawing: &mut Drawing, from: usize, to: usize, words: &str, colour| {
        let (a, b) = (at(from), at(to));
        arrow(
            drawing,
            &[[a.middle()[0], a.at[1]], [b.middle()[0], b.end()[1]]],
            words,
            colour,
        );
    };
    // To the top of the next column.
    let over = |drawing: &mut Drawing, from: usize, to: usize, words: &str, colour| {
        let (a, b) = (at(from), at(to));
        let between = 0.5 * (a.end()[0] + b.at[0]);
        let bend = [
            [a.end()[0], a.middle()[1]],
            [between, a.middle()[1]],
            [between, b.middle()[1]],
            [b.at[0], b.middle()[1]],
        ];
        arrow(drawing, &bend, words, colour);
    };
    down(drawing, 0, 1, "", GREY);
    down(drawing, 1, 2, "", GREY);
    over(drawing, 2, 3, "yes", GOOD);
    down(drawing, 3, 4, "", GREY);
    down(drawing, 4, 5, "", GREY);
    over(drawing, 5, 6, "", GREY);
    down(drawing, 6, 7, "", GREY);
    down(drawing, 7, 8, "", GREY);
    over(drawing, 8, 9, "", GREY);
    up(drawing, 9, 10, "yes", GOOD);
    up(drawing, 10, 11, "", GREY);
    down(drawing, 2, 12, "no, or no way was found", BAD);
    down(drawing, 9, 13, "no", BAD);
}

/// An arrow through places, with words beside its first stretch.
fn arrow(drawing: &mut Drawing, through: &[Spot], words: &str, colour: &'static str) {
    drawing.polyline(through, &Style::line(colour, 2.2));
    if let [.., before, end] = through {
        let (dx, dy) = (end[0] - before[0], end[1] - before[1]);
        let length = (dx * dx + dy * dy).sqrt();
        let (ux, uy) = (dx / length, dy / length);
        let side = |s: f64| [end[0] - 14.0 * ux - s * uy, end[1] - 14.0 * uy + s * ux];
        drawing.polygon(&[*end, side(6.5), side(-6.5)], &Style::fill(colour));
    }
    if let ([from, to, ..], false) = (through, words.is_empty()) {
        let how = Lettering::new(17.0, colour).bold().on_white(3.0);
        let upright = from[0] == to[0];
        let place = if upright {
            [from[0] + 12.0, 0.5 * (from[1] + to[1]) + how.drop()]
        } else {
            [from[0] + 8.0, from[1] - 9.0]
        };
        drawing.text(place, words, &how);
    }
}

impl Step {
    fn draw(&self, drawing: &mut Drawing) {
        let (fill, edge, rounded) = match self.kind {
            Kind::Data => (GROUND, LINE, 26.0),
            Kind::Work => (PAPER, TRANSIT, 3.0),
            Kind::Question => ("#fdf0f8", WASH, 3.0),
        };
        drawing.rect(self.at, rounded, &Style::fill(fill).outlined(edge, 2.0));
        let [x, y] = [self.at.middle()[0], self.at.at[1]];
        drawing.text([x, y + 33.0], self.title, &Lettering::new(20.0, INK).bold().centred());
        let how = Lettering::new(16.0, GREY).centred();
        let lines = Weight::Regular.lines(self.words, 16.0, self.at.size[0] - 26.0);
        for (k, line) in lines.iter().enumerate() {
            drawing.text([x, y + 60.0 + 21.0 * k as f64], line, &how);
        }
    }
}
