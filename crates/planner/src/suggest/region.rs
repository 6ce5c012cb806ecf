//! Where an arm with its tool washes a plate: a map of squares, and the widest sector about axis 1 within them.

use crate::error::PlanError;
use crate::pipeline::fill;
use crate::washable_map::{Levels, MapArea, Square};
use crate::watch::Watch;
use nalgebra::Vector3;
use platewash_bodies::job::WashJob;
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::{Pose, RobotModel};
use platewash_workcell::tool::Tool;

/// Finest squares across the radius of the map.
const ACROSS: f64 = 24.0;

/// Steps of a sector: directions in a turn, and distances across the radius of the map.
const DIRECTIONS: usize = 72;
const DISTANCES: usize = 48;

/// Distance of a plate in front of an arm, as a part of the arm's reach.
const IN_FRONT: f64 = 0.45;
/// Step to which its coordinates are rounded \[m\].
const PLACE_M: f64 = 1e-3;

/// Sine of the angle to the vertical up to which axis 1 is vertical.
const UPRIGHT: f64 = 1e-9;

/// A square of the map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegionSquare {
    /// Its middle \[m\].
    pub centre_m: [f64; 2],
    /// Its edge \[m\].
    pub edge_m: f64,
    /// True where the plate could be washed with its centre there.
    pub is_washable: bool,
}

/// A part of a ring about axis 1 for the centres of plates, as a layout states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sector {
    /// Distances from axis 1 \[m\].
    pub rho_m: [f64; 2],
    /// Directions from the world's x \[deg\], no more than a turn.
    pub azimuth_deg: [f64; 2],
}

impl Sector {
    /// The sector in whole centimetres and degrees, rounded inwards.
    #[must_use]
    pub fn in_whole_units(&self) -> Self {
        let within =
            |[from, to]: [f64; 2], unit: f64| [(from / unit - 1e-9).ceil() * unit, (to / unit + 1e-9).floor() * unit];
        let millimetres = |m: f64| (1e3 * m).round() / 1e3;
        Self {
            rho_m: within(self.rho_m, 0.01).map(millimetres),
            azimuth_deg: within(self.azimuth_deg, 1.0),
        }
    }
}

/// Region in which a plate can be washed.
#[derive(Debug, Clone, PartialEq)]
pub struct SuggestedRegion {
    /// The map: coarse squares, and finer ones along the border.
    pub squares: Vec<RegionSquare>,
    /// False where the time ended before the map was done: squares are missing, the farthest from the plate first.
    pub is_complete: bool,
    /// Edge of the finest squares \[m\].
    pub step_m: f64,
    /// Total area of the squares with a washable plate \[m²\].
    pub area_m2: f64,
    /// Least and greatest distance of their middles from axis 1 \[m\]; `None` where there is none, or axis 1 is not vertical.
    pub rho_m: Option<[f64; 2]>,
    /// The largest sector that lies within them; `None` where there is none, or axis 1 is not vertical.
    pub sector: Option<Sector>,
}

/// A place in front of an arm mounted at `T_world_base` with its tool, seen from above in the world \[m\]: along x of its base, or along
/// axis 1 where that is more level.
#[must_use]
pub fn place_in_front(arm: &RobotModel, tool: &Tool, mount: &Pose) -> [f64; 2] {
    let (from, reach_m) = arm.reach_bound(&tool.tip_frame(arm));
    let from = mount * from;
    let [along_x, along_axis] = [Vector3::x(), Vector3::z()].map(|way| (mount.rotation * way).xy());
    let ahead = if along_x.norm() + PLACE_M < along_axis.norm() {
        along_axis
    } else {
        along_x
    };
    let place = |from: f64, away: f64| ((from + away * IN_FRONT * reach_m) / PLACE_M).round() * PLACE_M;
    [place(from.x, ahead.x), place(from.y, ahead.y)]
}

/// Computes the region in which the first plate of a job could be washed from its home, were it alone: a map that takes a second
/// or two, longer for arms whose inverse kinematics is a search, and a summary of it. It is an estimate, as [`washable_map`](crate::washable_map) is: transits are
/// not checked, and a search may wash more. Where the token's time passes, the map is that of the squares checked until then.
///
/// # Errors
/// As [`washable_map`](crate::washable_map).
pub fn suggest_region(job: &WashJob, watch: &Watch<'_>) -> Result<SuggestedRegion, PlanError> {
    let alone = job.on_plates(job.terms().plates.iter().take(1).copied().collect())?;
    let reach = MapArea::within_reach(&alone, 0)?;
    let area = MapArea {
        step_m: reach.radius_m / ACROSS,
        ..reach
    };
    let mut levels = Levels::new(&area);
    let done = fill(&mut levels, &alone, 0, &mut |_| (), watch);
    let is_complete = done.is_ok();
    match done {
        Err(PlanError::Cancelled(_)) if watch.cancel.is_late() => {}
        done => done?,
    }
    let axis = alone.terms().workcell.mount.rotation * Vector3::z();
    let (region, is_vertical) = (region(&levels), axis.xy().norm() <= UPRIGHT);
    Ok(SuggestedRegion {
        is_complete,
        // Seen from above, only a vertical axis 1 is a place.
        sector: region.sector.filter(|_| is_vertical),
        rho_m: region.rho_m.filter(|_| is_vertical),
        ..region
    })
}

/// The region that the squares make.
fn region(levels: &Levels<'_>) -> SuggestedRegion {
    let mut squares = Vec::new();
    for (level, told) in levels.found.iter().enumerate() {
        let edge_m = levels.edge_m(level).unwrap_or_default();
        // One of its quarters stands for it.
        let is_quartered = |(column, row): Square| {
            let finer = levels.found.get(level + 1);
            finer.is_some_and(|finer| finer.contains_key(&(2 * column, 2 * row)))
        };
        for (&square, &is_washable) in told.iter().filter(|(square, _)| !is_quartered(**square)) {
            squares.push(RegionSquare {
                centre_m: levels.centre(edge_m, square),
                edge_m,
                is_washable,
            });
        }
    }
    let washable: Vec<_> = squares.iter().filter(|square| square.is_washable).collect();
    let [x, y] = levels.area.centre_m;
    let rho = washable.iter().map(|s| {
        let [dx, dy] = [s.centre_m[0] - x, s.centre_m[1] - y];
        (dx * dx + dy * dy).sqrt()
    });
    let ends = rho.fold([f64::INFINITY, 0.0_f64], |[least, most], rho| {
        [least.min(rho), most.max(rho)]
    });
    SuggestedRegion {
        is_complete: true,
        step_m: levels.area.step_m,
        area_m2: washable.iter().map(|square| square.edge_m * square.edge_m).sum(),
        rho_m: (!washable.is_empty()).then_some(ends),
        sector: sector(levels),
        squares,
    }
}

/// The sector of the greatest area all of whose steps are washable.
fn sector(levels: &Levels<'_>) -> Option<Sector> {
    let step_m = levels.area.radius_m / DISTANCES as f64;
    let degrees = 360.0 / DIRECTIONS as f64;
    // By distance and by direction from −180° on: how many washable steps in a row end there.
    let [x, y] = levels.area.centre_m;
    let ways: Vec<_> = (0..DIRECTIONS)
        .map(|direction| sin_cos((degrees * direction as f64 - 180.0).to_radians()))
        .collect();
    let mut run = vec![0; DIRECTIONS];
    let mut runs: Vec<Vec<usize>> = Vec::with_capacity(DISTANCES);
    for k in 0..DISTANCES {
        let away = step_m * k as f64;
        for (run, (s, c)) in run.iter_mut().zip(&ways) {
            *run = if levels.at([x + away * c, y + away * s]) {
                *run + 1
            } else {
                0
            };
        }
        runs.push(run.clone());
    }
    let mut best: Option<(f64, Sector)> = None;
    for (far, ends) in runs.iter().enumerate() {
        for near in 1..far {
            let fits = |direction: usize| ends[direction % DIRECTIONS] > far - near;
            let Some((first, count)) = longest(fits) else { continue };
            let [a, b] = [near, far].map(|k| step_m * k as f64);
            let area = (b * b - a * a) * (count - 1) as f64;
            if best.as_ref().is_none_or(|(most, _)| area > *most) {
                let from = degrees * first as f64 - 180.0;
                let azimuth_deg = [from, from + degrees * (count - 1) as f64];
                let rho_m = [a, b];
                best = Some((area, Sector { rho_m, azimuth_deg }));
            }
        }
    }
    best.filter(|(area, _)| *area > 0.0).map(|(_, sector)| sector)
}

/// The first direction of the longest run of those that fit, round the turn, and how many these are.
fn longest(fits: impl Fn(usize) -> bool) -> Option<(usize, usize)> {
    let mut best: Option<(usize, usize)> = None;
    for first in 0..DIRECTIONS {
        if !fits(first) || (first > 0 && fits(first - 1)) {
            continue;
        }
        let count = (0..DIRECTIONS).take_while(|k| fits(first + k)).count();
        if best.is_none_or(|(_, most)| count > most) {
            best = Some((first, count));
        }
    }
    best
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;

    const AREA: MapArea = MapArea {
        centre_m: [0.0, 0.0],
        radius_m: 1.0,
        step_m: 0.01,
    };

    /// Map with all squares of one level, washable by a rule.
    fn map(rule: impl Fn(f64, f64) -> bool) -> SuggestedRegion {
        let mut levels = Levels::new(&AREA);
        let (step_m, squares) = levels.next().unwrap();
        for square in squares {
            let [x, y] = levels.centre(step_m, square);
            levels.add([(square, rule(x, y))]);
        }
        region(&levels)
    }

    #[test]
    fn the_sector_of_a_ring_is_the_ring() {
        let region = map(|x, y| (0.3..0.7).contains(&x.hypot(y)));
        let sector = region.sector.unwrap();
        assert!(
            (sector.rho_m[0] - 0.3).abs() < 0.05 && (sector.rho_m[1] - 0.7).abs() < 0.05,
            "{sector:?}"
        );
        assert_eq!(sector.azimuth_deg[1] - sector.azimuth_deg[0], 355.0);
        assert!((region.area_m2 - std::f64::consts::PI * (0.49 - 0.09)).abs() < 0.05);
    }

    /// The sector crosses −x, the direction from which directions count.
    #[test]
    fn the_sector_of_a_wedge_lies_in_it() {
        for middle in [0.0_f64, 90.0, 180.0] {
            let (s, c) = middle.to_radians().sin_cos();
            let region = map(|x, y| (0.3..0.7).contains(&x.hypot(y)) && (x * c + y * s) / x.hypot(y) > 0.5);
            let Sector {
                azimuth_deg: [from, to],
                ..
            } = region.sector.unwrap();
            assert!(
                (0.5 * (from + to) - middle)
                    .rem_euclid(360.0)
                    .min((middle - 0.5 * (from + to)).rem_euclid(360.0))
                    < 6.0,
                "{from} {to}"
            );
            assert!((to - from - 120.0).abs() < 16.0, "{from} {to}");
        }
        assert_eq!(map(|_, _| false).sector, None);
        assert_eq!(map(|_, _| false).rho_m, None);
    }
}
