//! Layout: positions of the plates, drawn at random or given, and the problems of the result.
//!
//! All positions are in the frame of the layout \[m\]: origin on the base axis, axes along those of the world, z = 0 at the height 0 of the
//! world. For an arm that stands at the world's origin that is its base frame.
//!
//! | concept | module |
//! | --- | --- |
//! | the geometry that all plates of a layout share, and their spacing | here |
//! | region in which plates are drawn; its outline for display | `region`, `outline` |
//! | random layouts | `sampling`, `free_cells` |
//! | upper bound on the number of plates: the proof that no arrangement fits | `packing` |
//! | findings about a layout; errors | `findings`, `error` |

mod error;
mod findings;
mod free_cells;
mod outline;
mod packing;
mod region;
mod sampling;

pub use crate::layout::error::{EmptyReason, InputProblem, LayoutError};
pub use crate::layout::findings::Finding;
pub use crate::layout::outline::TaskRegion;
pub use crate::layout::packing::packing_bound;
pub use crate::layout::region::{Region, base_footprint, mounted_footprint};
pub use crate::layout::sampling::{Attempt, Placement, Sampler};

use crate::layout::error::{finite, not_negative, positive, range};
use crate::layout::sampling::Work;
use crate::plate::{Foot, Plate, PlateTerms};
use crate::surface::Surface;
use platewash_kinematics::Pose;
use rand::Rng;
use serde::{Deserialize, Serialize};

/// Source of the positions of a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum LayoutSource {
    /// Drawn at random.
    Sampled {
        /// Number of layouts begun and abandoned before this one.
        restarts: u32,
        /// Number of candidate positions drawn, all restarts included.
        draws: u64,
    },
    /// Given one by one.
    Explicit,
}

/// Plates with the findings about their positions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layout {
    /// Plates, in the order in which they were drawn or given.
    pub plates: Vec<Plate>,
    /// Source of their positions.
    pub source: LayoutSource,
    /// Problems of their positions.
    pub findings: Vec<Finding>,
}

impl Layout {
    /// Returns a layout of given plates without findings.
    #[must_use]
    pub fn of(plates: Vec<Plate>) -> Self {
        Self {
            plates,
            source: LayoutSource::Explicit,
            findings: Vec::new(),
        }
    }

    /// Returns a layout of plates given in the world, with their overlaps as findings. `[x, y]` is the foot of the arm's mount \[m\].
    #[must_use]
    pub fn with_overlaps(plates: Vec<Plate>, [x, y]: [f64; 2], base: Option<&BaseFootprint>) -> Self {
        let to_foot = Pose::translation(-x, -y, 0.0);
        let about_foot: Vec<_> = plates.iter().map(|plate| plate.seen_from(&to_foot)).collect();
        Self {
            findings: findings::overlaps(&about_foot, base),
            ..Self::of(plates)
        }
    }

    /// Returns the same positions with plates of several kinds: a number of each, in their order.
    #[must_use]
    pub fn of_kinds(self, kinds: &[(usize, PlateGeometry)], base: Option<&BaseFootprint>) -> Self {
        let each = kinds.iter().flat_map(|(count, kind)| std::iter::repeat_n(kind, *count));
        let centres = self.plates.iter().map(Plate::centre_xy);
        let plates: Vec<_> = centres
            .zip(each)
            .flat_map(|(centre, kind)| kind.plates(&[centre]))
            .collect();
        Self {
            findings: findings::overlaps(&plates, base),
            plates,
            ..self
        }
    }

    /// Returns the layout moved by `[x, y]` \[m\], for another origin.
    #[must_use]
    pub fn moved_by(mut self, [x, y]: [f64; 2]) -> Self {
        let by = Pose::translation(x, y, 0.0);
        for plate in &mut self.plates {
            *plate = plate.seen_from(&by);
        }
        for finding in &mut self.findings {
            finding.move_by([x, y]);
        }
        self
    }
}

/// Request for a random layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleRequest {
    /// Region of the plates' centres.
    pub region: Region,
    /// Distances of the centres from each other and from the base axis.
    pub spacing: Spacing,
    /// Number of plates, 1 to [`MAX_PLATES`].
    pub count: usize,
    /// Shape and height of the plates.
    pub geometry: PlateGeometry,
    /// Footprint of the robot's base, only for [`Finding::OverlapsBase`]; `None` if no plate is level with it.
    pub base: Option<BaseFootprint>,
}

/// Greatest number of restarts after the first layout came to a dead end, and number of steps (positions drawn plus quadtree cells examined)
/// after which no layout is begun. It is a count and not a time, so that the outcome does not depend on the machine.
const MOST_WORK: (u32, u64) = (1000, 20_000_000);

/// The same for a count that is impossible: enough to measure how many plates random layouts hold.
const WORK_OF_A_MEASURE: (u32, u64) = (99, 1_000_000);

/// Draws a layout by the paper's law (see [`Sampler`]), and begins anew at every dead end. It ends in bounded time for every request. The
/// same generator state gives the same layout on every machine. Findings are overlaps, which the law allows: with the paper's numbers
/// plates of 0.145 m radius may be 0.28 m apart.
///
/// # Errors
///
/// [`LayoutError::InvalidInput`] names the invalid number; [`LayoutError::EmptyRegion`] if not even a first plate has room;
/// [`LayoutError::NoRoom`] if every layout came to a dead end. If [`packing_bound`] rules the request out, at most a hundred layouts are
/// begun, only to measure how many plates they held.
pub fn sample<R: Rng + ?Sized>(request: &SampleRequest, rng: &mut R) -> Result<Layout, LayoutError> {
    let SampleRequest {
        region,
        spacing,
        count,
        geometry,
        base,
    } = request;
    let count = *count;
    geometry.validate()?;
    base.as_ref().map_or(Ok(()), BaseFootprint::validate)?;
    check_count(count)?;
    let sampler = Sampler::new(region, spacing)?;
    let upper_bound = packing_bound(region, spacing.min_distance_m);
    let (max_restarts, max_steps) = match upper_bound {
        Some(bound) if count > bound => WORK_OF_A_MEASURE,
        _ => MOST_WORK,
    };
    let mut work = Work::default();
    let (mut most_placed, mut restarts) = (0, 0);
    loop {
        match sampler.attempt_counting(count, rng, &mut work) {
            Attempt::Placed(centres) => {
                let plates = geometry.plates(&centres);
                let findings = findings::overlaps(&plates, base.as_ref());
                let source = LayoutSource::Sampled {
                    restarts,
                    draws: work.draws,
                };
                return Ok(Layout {
                    plates,
                    source,
                    findings,
                });
            }
            Attempt::DeadEnd { placed } => most_placed = most_placed.max(placed),
        }
        if restarts == max_restarts || work.draws + work.cells >= max_steps {
            return Err(LayoutError::NoRoom {
                count,
                most_placed,
                layouts_tried: restarts.saturating_add(1),
                upper_bound,
            });
        }
        restarts += 1;
    }
}

/// Builds a layout from given centres (`[x, y]` \[m\], base frame) and reports every rule that they break. `region` is `None` if no region
/// was given.
///
/// # Errors
///
/// [`LayoutError::InvalidInput`] or [`LayoutError::InvalidPosition`] for an invalid number. A bad layout is not an error but has findings.
pub fn check_explicit(
    positions_m: &[[f64; 2]],
    region: Option<&Region>,
    spacing: &Spacing,
    geometry: &PlateGeometry,
    base: Option<&BaseFootprint>,
) -> Result<Layout, LayoutError> {
    region.map_or(Ok(()), Region::validate)?;
    spacing.validate()?;
    geometry.validate()?;
    base.map_or(Ok(()), BaseFootprint::validate)?;
    check_count(positions_m.len())?;
    if let Some(plate) = positions_m.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
        return Err(LayoutError::InvalidPosition { plate });
    }
    let plates = geometry.plates(positions_m);
    let mut findings = findings::broken_rules(&plates, region, spacing);
    findings.extend(findings::overlaps(&plates, base));
    Ok(Layout {
        plates,
        source: LayoutSource::Explicit,
        findings,
    })
}

fn check_count(count: usize) -> Result<(), LayoutError> {
    match count {
        0 => Err(LayoutError::invalid("count", InputProblem::NotPositive)),
        1..=MAX_PLATES => Ok(()),
        _ => Err(LayoutError::invalid(
            "count",
            InputProblem::TooLarge { max: MAX_PLATES },
        )),
    }
}

/// Greatest number of plates of a layout.
pub const MAX_PLATES: usize = 1000;

/// Shape and height that all plates of a layout share.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlateGeometry {
    /// Washing surface; plates keep apart by the radius of its rim.
    pub surface: Surface,
    /// Height of the pole of the washing surface (z, base frame) \[m\].
    pub height_m: f64,
    /// Thickness, from the washing surface down \[m\].
    pub thickness_m: f64,
    /// Ring that a plate stands on, if it has one.
    pub foot: Option<Foot>,
    /// Terms of plates of this kind, where they differ from those of the job.
    pub terms: PlateTerms,
}

/// Rule for the distances between plates. It applies to centres and does not keep plates from overlapping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spacing {
    /// Distance between centres that must be exceeded \[m\].
    pub min_distance_m: f64,
    /// Distance of centres from the base axis that must be exceeded \[m\].
    pub base_radius_m: f64,
}

/// Rectangle that the robot's base covers, base frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BaseFootprint {
    /// Least and greatest x \[m\].
    pub x_m: [f64; 2],
    /// Least and greatest y \[m\].
    pub y_m: [f64; 2],
}

impl PlateGeometry {
    /// Refuses a radius or thickness that is not greater than zero, a height that is not finite, and an invalid foot.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the key.
    pub fn validate(&self) -> Result<(), LayoutError> {
        positive("plate_radius_m", self.surface.rim_m())?;
        finite("plate_height_m", self.height_m)?;
        positive("plate_thickness_m", self.thickness_m)?;
        for size in self.foot.iter().flat_map(|foot| [foot.radius_m, foot.height_m]) {
            positive("plate_foot_m", size)?;
        }
        Ok(())
    }

    /// Returns plates of this geometry at the centres `[x, y]` \[m\], base frame.
    fn plates(&self, centres: &[[f64; 2]]) -> Vec<Plate> {
        let at = |&[x, y]: &[f64; 2]| Plate {
            surface: self.surface,
            thickness_m: self.thickness_m,
            foot: self.foot,
            pose: Pose::translation(x, y, self.height_m),
            terms: self.terms,
        };
        centres.iter().map(at).collect()
    }
}

impl Spacing {
    /// Refuses distances that are negative or not finite.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the key.
    pub fn validate(&self) -> Result<(), LayoutError> {
        not_negative("min_distance_m", self.min_distance_m)?;
        not_negative("base_radius_m", self.base_radius_m)
    }
}

impl BaseFootprint {
    /// Refuses sides that are not finite, reversed or of zero length.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the side.
    pub fn validate(&self) -> Result<(), LayoutError> {
        range("base footprint x", self.x_m)?;
        range("base footprint y", self.y_m)
    }

    /// Distance between the footprint and the rim of a level plate, seen from above \[m\]; negative if the plate lies over it. `None` for a
    /// plate that is not level, which is checked by its bodies.
    #[must_use]
    pub fn gap_m(&self, plate: &Plate) -> Option<f64> {
        let away_m = plate.is_level().then(|| self.signed_distance(plate.centre_xy()));
        away_m.map(|away_m| away_m - plate.rim_m())
    }

    /// Distance of a point from the footprint \[m\]; negative inside.
    fn signed_distance(&self, [x, y]: [f64; 2]) -> f64 {
        let beyond = |value: f64, [low, high]: [f64; 2]| (low - value).max(value - high);
        let (dx, dy) = (beyond(x, self.x_m), beyond(y, self.y_m));
        let (outside_x, outside_y) = (dx.max(0.0), dy.max(0.0));
        (outside_x * outside_x + outside_y * outside_y).sqrt() + dx.max(dy).min(0.0)
    }
}
