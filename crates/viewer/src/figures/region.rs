//! Where an arm with its tool washes a plate, from above.

use super::error::FigureError;
use super::ink::axes::Axes;
use super::ink::drawing::{Drawing, Rect, Spot};
use super::ink::legend::{self, Entry};
use super::ink::page::{self, Words};
use super::ink::palette::{GREY, GROUND, INK, STEPS, TRANSIT};
use super::ink::png::png;
use super::ink::style::Style;
use platewash_kinematics::trig::sin_cos;

/// Width of what stands beside the map \[px\].
const BESIDE: f64 = 430.0;

/// White between the outermost square and the frame \[m\].
const WHITE_M: f64 = 0.05;

/// Corners of a sector's arc in a turn.
const CORNERS: f64 = 144.0;

const SECTOR_DASHES: &[f64] = &[12.0, 5.0];
const CIRCLE_DASHES: &[f64] = &[3.0, 5.0];

/// What is drawn of a region: base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionMap {
    /// What the arm is called, and the plate's size, in words.
    pub subtitle: String,
    /// Squares: middle \[m\], edge \[m\], whether the plate can be washed with its centre there.
    pub squares: Vec<([f64; 2], f64, bool)>,
    /// Distances from the base's axis \[m\], and directions from x \[deg\], of a sector that lies within them.
    pub sector: Option<([f64; 2], [f64; 2])>,
    /// The base's axis \[m\].
    pub axis_m: [f64; 2],
    /// The plate that the home is over: its centre and radius \[m\].
    pub plate: ([f64; 2], f64),
}

/// A figure of a region.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionSheet {
    /// The drawing, a text in SVG.
    pub svg: String,
}

impl RegionSheet {
    /// The drawing as PNG: what the SVG shows.
    ///
    /// # Errors
    /// [`FigureError::Png`].
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        Ok(png(&self.svg)?)
    }
}

/// Draws the map.
#[must_use]
pub fn draw_region(map: &RegionMap) -> RegionSheet {
    let words = Words {
        title: "Where plates can be washed".to_owned(),
        subtitle: map.subtitle.clone(),
        caption: "Seen from above, from behind the arm: x leads away from it, y to its left. A square counts where the plate, with its \
                  centre in the middle, is washed from home by a policy of tilts: a guess, as transits are not looked at."
            .to_owned(),
        source: "platewash robot --suggest".to_owned(),
    };
    let (mut drawing, room) = page::begin(&words);
    let [left, top] = room.at;
    let frame = Rect::new(left + 62.0, top, room.size[0] - BESIDE - 92.0, room.size[1] - 58.0);
    let axes = axes(map, frame);
    let [across, up] = [axes.across.ticks(8), axes.up.ticks(7)];
    axes.grid(&mut drawing, &across, &up);
    drawing.within_rect(axes.frame, |drawing| Map { axes: &axes, map }.draw(drawing));
    axes.outline(&mut drawing);
    axes.numbers_below(&mut drawing, &across);
    axes.numbers_left(&mut drawing, &up);
    axes.name_below(&mut drawing, "y [m]");
    axes.name_left(&mut drawing, "x [m]", 54.0);
    let entries = [
        Entry::field(Style::fill(STEPS[3]), "centres of plates that can be washed"),
        Entry::field(Style::fill("none").outlined(TRANSIT, 2.4), "largest sector of them"),
        Entry::field(Style::fill("none").outlined(INK, 1.6), "the plate that home is over"),
        Entry::dot(Style::fill(INK), "axis 1"),
    ];
    legend::column(&mut drawing, [axes.frame.end()[0] + 34.0, top], BESIDE - 34.0, &entries);
    let said: Vec<&str> = drawing.texts().iter().map(|text| text.words.as_str()).collect();
    let description = said.join("; ");
    let svg = drawing.finish(&words.title, &description);
    RegionSheet { svg }
}

/// World x upwards, world y to the left, at one scale.
fn axes(map: &RegionMap, room: Rect) -> Axes {
    let [x, y] = map.axis_m;
    let washable = map.squares.iter().filter(|(.., is_washable)| *is_washable);
    let away = washable.map(|([sx, sy], edge_m, _)| (sx - x).abs().max((sy - y).abs()) + 0.5 * edge_m);
    let ([px, py], radius_m) = map.plate;
    let of_plate = (px - x).abs().max((py - y).abs()) + radius_m;
    let half_m = away.fold(of_plate, f64::max) + WHITE_M;
    let side = room.size[0].min(room.size[1]);
    let frame = Rect::new(room.at[0], room.at[1], side, side);
    Axes::new(frame, [y + half_m, y - half_m], [x - half_m, x + half_m])
}

struct Map<'a> {
    axes: &'a Axes,
    map: &'a RegionMap,
}

impl Map<'_> {
    fn spot(&self, [x, y]: [f64; 2]) -> Spot {
        self.axes.at(y, x)
    }

    fn pixels(&self, length_m: f64) -> f64 {
        (self.axes.up.at(length_m) - self.axes.up.at(0.0)).abs()
    }

    fn draw(&self, drawing: &mut Drawing) {
        for (is_washable, colour) in [(false, GROUND), (true, STEPS[3])] {
            let squares = self.map.squares.iter().filter(|(.., answer)| *answer == is_washable);
            let cells: Vec<Rect> = squares
                .map(|(centre, edge_m, _)| {
                    let ([x, y], side) = (self.spot(*centre), self.pixels(*edge_m));
                    Rect::new(x - 0.5 * side, y - 0.5 * side, side, side)
                })
                .collect();
            drawing.cells(&cells, colour);
        }
        if let Some(sector) = &self.map.sector {
            let style = Style::fill("none").outlined(TRANSIT, 2.4).dashed(SECTOR_DASHES);
            drawing.polygon(&self.sector(sector), &style);
        }
        let (centre, radius_m) = self.map.plate;
        let plate = Style::fill("none").outlined(INK, 1.6).dashed(CIRCLE_DASHES);
        drawing.circle(self.spot(centre), self.pixels(radius_m), &plate);
        drawing.circle(self.spot(self.map.axis_m), 6.0, &Style::fill(INK).outlined(GREY, 1.0));
    }

    /// The outline: along the far arc and back along the near one.
    fn sector(&self, ([near, far], [from, to]): &([f64; 2], [f64; 2])) -> Vec<Spot> {
        let steps = ((to - from) / 360.0 * CORNERS).ceil().max(1.0);
        let arc = |radius_m: f64, share: f64| {
            let (s, c) = sin_cos((from + share * (to - from)).to_radians());
            let [x, y] = self.map.axis_m;
            self.spot([x + radius_m * c, y + radius_m * s])
        };
        let shares = || (0..=steps as usize).map(|k| k as f64 / steps);
        let out = shares().map(|share| arc(*far, share));
        out.chain(shares().map(|share| arc(*near, 1.0 - share))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_is_drawn_with_its_words() {
        let map = RegionMap {
            subtitle: "irb120, plates of radius 145 mm".to_owned(),
            squares: vec![([0.3, 0.0], 0.1, true), ([0.5, 0.0], 0.1, false)],
            sector: Some(([0.25, 0.35], [-90.0, 90.0])),
            axis_m: [0.0, 0.0],
            plate: ([0.4, 0.0], 0.145),
        };
        let sheet = draw_region(&map);
        assert!(sheet.svg.starts_with("<svg") || sheet.svg.starts_with("<?xml"));
        assert!(sheet.svg.contains("irb120") && sheet.svg.contains(TRANSIT) && sheet.svg.contains(STEPS[3]));
        assert!(sheet.png().unwrap().starts_with(b"\x89PNG"));
        // Nothing washable, and no sector.
        let none = RegionMap {
            squares: Vec::new(),
            sector: None,
            ..map
        };
        assert!(!draw_region(&none).svg.contains("stroke-dasharray=\"12"));
    }
}
