//! Where an arm with its tool washes a plate, from above.

use super::map::{Map, arm_look};
use super::outline::Outline;
use super::page::{self, Entry, FigureTexts, SIZE, Sign, legend};
use super::svg::{DASHED, DOTTED, Drawing, GREY, GROUND, INK, Rect, TRANSIT, fill, outlined, stroke};
use platewash_kinematics::trig::sin_cos;

/// Corners of a sector's arc in a turn.
const CORNERS: f64 = 144.0;

/// The colour of washable squares.
const WASHABLE: &str = "#74c2b4";

/// Region to draw: world frame.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionMap {
    /// Name of the arm and size of the plate, in words.
    pub subtitle: String,
    /// Squares: middle \[m\], edge \[m\], whether the plate can be washed with its centre there.
    pub squares: Vec<([f64; 2], f64, bool)>,
    /// Distances from the base's axis \[m\], and directions from x \[deg\], of a sector that lies within them.
    pub sector: Option<([f64; 2], [f64; 2])>,
    /// The base's axis \[m\].
    pub axis_m: [f64; 2],
    /// The plate that the home is over: its centre and radius \[m\].
    pub plate: ([f64; 2], f64),
    /// The outlines of the arm at home ([`arm_outlines`](super::arm_outlines)).
    pub arm_m: Vec<Outline>,
}

/// Draws the map: a text in SVG.
#[must_use]
pub fn draw_region(region: &RegionMap) -> String {
    let words = FigureTexts {
        title: "Where plates can be washed".to_owned(),
        subtitle: region.subtitle.clone(),
        caption: "Seen from above: the room's x leads up the page, its y to the left. A square counts where the plate, with its centre in the \
                  middle, is washed from home by a policy of tilts: a guess, as transits are not looked at."
            .to_owned(),
        source: "platewash robot --suggest".to_owned(),
    };
    let (mut drawing, room) = page::begin(&words);
    let [x, y] = region.axis_m;
    let washable = region.squares.iter().filter(|(.., is_washable)| *is_washable);
    let outer = washable
        .map(|(at, edge_m, _)| (*at, 0.5 * edge_m))
        .chain([region.plate])
        .chain(region.arm_m.iter().flatten().map(|corner| (*corner, 0.0)));
    let half_m = outer
        .map(|([px, py], r)| (px - x).abs().max((py - y).abs()) + r)
        .fold(0.0, f64::max);
    let (map, beside) = Map::new(room, [x - half_m, y - half_m], [x + half_m, y + half_m]);
    let sector = stroke(TRANSIT, 2.4) + DASHED;
    let plate = stroke(INK, 1.6) + DOTTED;
    map.draw(&mut drawing, |drawing| {
        squares(drawing, &map, region);
        map.arm(drawing, &region.arm_m);
        if let Some(found) = region.sector {
            drawing.polygon(&map.spots(&corners(region.axis_m, found)), &sector);
        }
        drawing.circle(map.spot(region.plate.0), map.pixels(region.plate.1), &plate);
        drawing.circle(map.spot(region.axis_m), 6.0, &outlined(INK, GREY, 1.0));
    });
    let mut entries = vec![
        Entry::new(Sign::Field, fill(WASHABLE), "centres of plates that can be washed"),
        Entry::new(Sign::Field, plate, "the plate that home is over"),
        Entry::new(Sign::Field, arm_look(), "the arm with its tool at home"),
        Entry::new(Sign::Dot, fill(INK), "axis 1"),
    ];
    if region.sector.is_some() {
        entries.insert(1, Entry::new(Sign::Field, sector, "largest sector of them"));
    }
    legend(&mut drawing, beside.at, beside.size[0], &entries);
    drawing.finish(SIZE, &words.title)
}

fn squares(drawing: &mut Drawing, map: &Map, region: &RegionMap) {
    for (is_washable, colour) in [(false, GROUND), (true, WASHABLE)] {
        let squares = region.squares.iter().filter(|(.., answer)| *answer == is_washable);
        let cells = squares.map(|(centre, edge_m, _)| {
            let ([x, y], side) = (map.spot(*centre), map.pixels(*edge_m));
            Rect::new(x - 0.5 * side, y - 0.5 * side, side, side)
        });
        drawing.cells(&cells.collect::<Vec<_>>(), colour);
    }
}

/// The outline of a sector: along the far arc and back along the near one \[m\].
fn corners([x, y]: [f64; 2], ([near, far], [from, to]): ([f64; 2], [f64; 2])) -> Vec<[f64; 2]> {
    let steps = ((to - from) / 360.0 * CORNERS).ceil().max(1.0);
    let arc = |radius_m: f64, share: f64| {
        let (s, c) = sin_cos((from + share * (to - from)).to_radians());
        [x + radius_m * c, y + radius_m * s]
    };
    let shares = || (0..=steps as usize).map(|k| k as f64 / steps);
    let out = shares().map(|share| arc(far, share));
    out.chain(shares().map(|share| arc(near, 1.0 - share))).collect()
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
            arm_m: vec![vec![[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]]],
        };
        let svg = draw_region(&map);
        assert!(svg.starts_with("<svg"));
        assert!(svg.contains("irb120") && svg.contains(TRANSIT) && svg.contains(WASHABLE));
        // Nothing washable, and no sector.
        let none = RegionMap {
            squares: Vec::new(),
            sector: None,
            ..map.clone()
        };
        let none = draw_region(&none);
        assert!(!none.contains(DASHED) && !none.contains("sector"));
        // The arm is one group.
        assert_eq!(svg.matches("class=\"arm\"").count(), 1);
    }
}
