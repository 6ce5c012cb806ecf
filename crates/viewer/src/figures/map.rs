//! Maps from above: world x upwards, world y to the left, at one scale.

use super::axes::{Axes, ROOM};
use super::outline::Outline;
use super::svg::{Drawing, Rect, Spot};

/// White between the outermost thing and the frame \[m\].
const WHITE_M: f64 = 0.05;

/// Width of the texts beside a map \[px\].
const BESIDE: f64 = 420.0;

/// The arm's colour and that of its edge.
const ARM: &str = "#d3d8de";
const ARM_EDGE: &str = "#6b7783";

/// The look of the arm in a legend.
pub fn arm_look() -> String {
    format!("fill=\"{ARM}\" stroke=\"{ARM_EDGE}\" stroke-width=\"1.4\"")
}

/// A map of a part of the workcell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map(Axes);

impl Map {
    /// A map of all places between the least and the greatest x and y \[m\], and where there is room beside it.
    pub fn new(room: Rect, low: [f64; 2], high: [f64; 2]) -> (Self, Rect) {
        let most = [room.size[0] - ROOM[0] - BESIDE, room.size[1] - ROOM[1]];
        let need = [1, 0].map(|k| high[k] - low[k] + 2.0 * WHITE_M);
        let scale = (most[0] / need[0]).min(most[1] / need[1]);
        // No larger than there is something to see.
        let size = [0, 1].map(|k| most[k].min(1.25 * need[k] * scale));
        let frame = Rect::new(room.at[0] + ROOM[0], room.at[1], size[0], size[1]);
        let [across, up] = size.map(|size| 0.5 * size / scale);
        let [x, y] = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
        let axes = Axes::new(frame, [y + across, y - across], [x - up, x + up]);
        let beside = frame.end()[0] + 28.0;
        (
            Self(axes),
            Rect::new(beside, room.at[1], room.end()[0] - beside, room.size[1]),
        )
    }

    /// Position of a place on the page.
    pub fn spot(&self, [x, y]: [f64; 2]) -> Spot {
        self.0.at(y, x)
    }

    /// Positions of places on the page.
    pub fn spots<'p>(&self, places: impl IntoIterator<Item = &'p [f64; 2]>) -> Vec<Spot> {
        places.into_iter().map(|place| self.spot(*place)).collect()
    }

    /// Length on the page \[px\] of a length in metres.
    pub fn pixels(&self, length_m: f64) -> f64 {
        (self.0.up.at(length_m) - self.0.up.at(0.0)).abs()
    }

    /// Draws an arm as one outline, through which one sees what is below.
    pub fn arm(&self, drawing: &mut Drawing, outlines: &[Outline]) {
        let shapes: Vec<Vec<Spot>> = outlines.iter().map(|outline| self.spots(outline)).collect();
        drawing.group("class=\"arm\" opacity=\"0.8\"", |drawing| {
            drawing.silhouette(&shapes, ARM, ARM_EDGE)
        });
    }

    /// Draws the map with its numbers, and the drawing of `draw`.
    pub fn draw(&self, drawing: &mut Drawing, draw: impl FnOnce(&mut Drawing)) {
        self.0.draw(drawing, [8, 7], [Some("y [m]"), Some("x [m]")], draw);
    }
}
