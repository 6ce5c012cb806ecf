//! Where plate centres may be.

use serde::{Deserialize, Serialize};

use super::error::{InputProblem, LayoutError, not_negative, range};
use super::wedge::Wedge;

/// The region of plate centres, in the base frame (z up, origin on the base axis): the points that satisfy every range
/// that is given. Boundaries belong to it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Least and greatest x, metres.
    pub x_m: [f64; 2],
    /// Least and greatest y, metres.
    pub y_m: [f64; 2],
    /// Least and greatest distance from the base axis, metres; `None` for no such rule.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rho_m: Option<[f64; 2]>,
    /// Range of azimuths about the base axis, degrees counter-clockwise from base x, at most 360 wide and written in
    /// any turn (`[-110, 110]`, `[250, 470]`); `None` for no such rule.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub azimuth_deg: Option<[f64; 2]>,
}

impl Region {
    /// The region of the paper's text.
    pub const PAPER_TEXT: Self = Self {
        x_m: [0.0, 0.32],
        y_m: [-0.38, 0.32],
        rho_m: None,
        azimuth_deg: None,
    };
    /// The region of the program in the paper's appendix.
    pub const PAPER_APPENDIX: Self = Self {
        x_m: [0.0, 0.30],
        y_m: [-0.38, 0.38],
        rho_m: None,
        azimuth_deg: None,
    };

    /// Refuses ranges that are not finite, reversed or of zero width, a negative `rho_m` and an `azimuth_deg` wider than
    /// a turn.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the key.
    pub fn validate(&self) -> Result<(), LayoutError> {
        range("x_m", self.x_m)?;
        range("y_m", self.y_m)?;
        if let Some(rho) = self.rho_m {
            not_negative("rho_m", rho[0])?;
            range("rho_m", rho)?;
        }
        if let Some(azimuth) = self.azimuth_deg {
            range("azimuth_deg", azimuth)?;
            if azimuth[1] - azimuth[0] > 360.0 {
                return Err(LayoutError::invalid("azimuth_deg", InputProblem::MoreThanATurn));
            }
        }
        Ok(())
    }

    /// Whether the point `[x, y]`, metres in the base frame, belongs to the region.
    #[must_use]
    pub fn contains(&self, point_m: [f64; 2]) -> bool {
        Area::new(self).contains(point_m)
    }
}

/// A region made ready for many queries.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    low: [f64; 2],
    high: [f64; 2],
    rho_squared: Option<[f64; 2]>,
    wedge: Wedge,
}

/// An axis-aligned rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct QuadCell {
    pub(super) middle: [f64; 2],
    pub(super) half: [f64; 2],
}

impl QuadCell {
    /// Square of the greatest distance from `p` to a point of the rectangle.
    pub(super) fn farthest_squared(&self, p: [f64; 2]) -> f64 {
        let dx = (self.middle[0] - p[0]).abs() + self.half[0];
        let dy = (self.middle[1] - p[1]).abs() + self.half[1];
        dx * dx + dy * dy
    }

    /// Square of the least distance from `p` to a point of the rectangle.
    pub(super) fn nearest_squared(&self, p: [f64; 2]) -> f64 {
        let dx = ((self.middle[0] - p[0]).abs() - self.half[0]).max(0.0);
        let dy = ((self.middle[1] - p[1]).abs() - self.half[1]).max(0.0);
        dx * dx + dy * dy
    }

    fn corners(&self) -> [[f64; 2]; 4] {
        let ([x, y], [hx, hy]) = (self.middle, self.half);
        [[x - hx, y - hy], [x + hx, y - hy], [x + hx, y + hy], [x - hx, y + hy]]
    }
}

impl Area {
    pub(super) fn new(region: &Region) -> Self {
        let reach = region.rho_m.map_or(f64::INFINITY, |rho| rho[1]);
        Self {
            low: [region.x_m[0].max(-reach), region.y_m[0].max(-reach)],
            high: [region.x_m[1].min(reach), region.y_m[1].min(reach)],
            rho_squared: region.rho_m.map(|[low, high]| [low * low, high * high]),
            wedge: region.azimuth_deg.map_or(Wedge::Full, Wedge::new),
        }
    }

    pub(super) fn wedge(&self) -> &Wedge {
        &self.wedge
    }

    /// Lower corner of a box around the area.
    pub(super) fn low(&self) -> [f64; 2] {
        self.low
    }

    /// Extents of that box; not positive when the area is empty.
    pub(super) fn size(&self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }

    pub(super) fn contains(&self, p: [f64; 2]) -> bool {
        let in_box = p[0] >= self.low[0] && p[0] <= self.high[0] && p[1] >= self.low[1] && p[1] <= self.high[1];
        in_box
            && self
                .rho_squared
                .is_none_or(|[low, high]| (low..=high).contains(&(p[0] * p[0] + p[1] * p[1])))
            && self.wedge.contains(p)
    }

    /// Whether a cell of the box is surely outside. May miss one that is outside, never the reverse.
    pub(super) fn excludes(&self, cell: &QuadCell) -> bool {
        let ring = self
            .rho_squared
            .is_some_and(|[low, high]| cell.farthest_squared([0.0; 2]) < low || cell.nearest_squared([0.0; 2]) > high);
        ring || self.wedge.excludes(&cell.corners())
    }
}
