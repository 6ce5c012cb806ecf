//! Where the plates lie: drawn at random or given, and what is wrong with the result.
//!
//! All positions are in the frame of the layout: origin on the base axis, axes along those of the world, z = 0 at the height 0 of the
//! world, metres. Of an arm that stands at the world's origin that is its base frame.
//!
//! What all plates of a layout share, and the distances that they keep.

mod error;
mod findings;
pub(crate) mod free_cells;
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
use crate::plate::{Foot, Plate};
use crate::surface::Surface;
use platewash_kinematics::Pose;
use rand::Rng;
use serde::{Deserialize, Serialize};

/// Where the positions of a layout come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum LayoutSource {
    /// Drawn at random.
    Sampled {
        /// Layouts begun and given up before this one.
        restarts: u32,
        /// Candidate positions drawn, all restarts included.
        draws: u64,
    },
    /// Given one by one.
    Explicit,
}

/// Plates, and what is to be said about them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layout {
    /// The plates, in the order in which they were drawn or given.
    pub plates: Vec<Plate>,
    /// Where their positions come from.
    pub source: LayoutSource,
    /// What is wrong with them.
    pub findings: Vec<Finding>,
}

impl Layout {
    /// Some plates, given, about which nothing is to be said.
    #[must_use]
    pub fn of(plates: Vec<Plate>) -> Self {
        Self {
            plates,
            source: LayoutSource::Explicit,
            findings: Vec::new(),
        }
    }

    /// Plates given one by one in the world, and which of them overlap; `foot_m` is the foot of the arm's mount.
    #[must_use]
    pub fn listed(plates: Vec<Plate>, [x, y]: [f64; 2], base: Option<&BaseFootprint>) -> Self {
        let to_foot = Pose::translation(-x, -y, 0.0);
        let about_foot: Vec<_> = plates.iter().map(|plate| plate.seen_from(&to_foot)).collect();
        Self {
            findings: findings::overlaps(&about_foot, base),
            ..Self::of(plates)
        }
    }

    /// The same places with plates of several kinds, so many of each, in their order.
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

    /// The same about another origin: everything is farther by as much \[m\].
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

/// What to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleRequest {
    /// Where centres may be.
    pub region: Region,
    /// How far they keep from each other and from the base axis.
    pub spacing: Spacing,
    /// Number of plates, 1 to [`MAX_PLATES`].
    pub count: usize,
    /// Shape and height of the plates.
    pub geometry: PlateGeometry,
    /// What the robot's base covers, for [`Finding::OverlapsBase`] alone; `None` where no plate is level with it.
    pub base: Option<BaseFootprint>,
}

/// When to stop trying.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SampleSettings {
    /// Layouts begun after the first one came to a dead end. Any number is valid.
    pub max_restarts: u32,
    /// No layout is begun after this many steps (positions drawn plus quadtree cells examined). Any number is valid; a count
    /// rather than a time, so that the outcome does not depend on the machine.
    pub max_steps: u64,
}

impl Default for SampleSettings {
    fn default() -> Self {
        Self {
            max_restarts: 1000,
            max_steps: 20_000_000,
        }
    }
}

impl SampleSettings {
    /// Enough to say how many plates random layouts hold where the count asked for is out of the question.
    fn for_a_measure(self) -> Self {
        Self {
            max_restarts: self.max_restarts.min(99),
            max_steps: self.max_steps.min(1_000_000),
        }
    }
}

/// Draws a layout by the paper's law (see [`Sampler`]), beginning anew at every dead end. It ends in bounded time for every
/// request. The same generator state gives the same layout on every machine. Findings are overlaps, which the law allows:
/// with the paper's numbers plates of 0.145 m radius may be 0.28 m apart.
///
/// # Errors
///
/// [`LayoutError::InvalidInput`] names the number that makes no sense; [`LayoutError::EmptyRegion`] when not even a first
/// plate has room; [`LayoutError::NoRoom`] when every layout begun came to a dead end. Where [`packing_bound`] rules the
/// request out, at most a hundred layouts are begun, only to say how many plates they held.
pub fn sample<R: Rng + ?Sized>(
    request: &SampleRequest,
    settings: &SampleSettings,
    rng: &mut R,
) -> Result<Layout, LayoutError> {
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
    let settings = match upper_bound {
        Some(bound) if count > bound => settings.for_a_measure(),
        _ => *settings,
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
        if restarts == settings.max_restarts || work.draws + work.cells >= settings.max_steps {
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

/// Makes a layout of given centres (`[x, y]`, metres, base frame) and reports every rule that they break; `region` is `None`
/// when no region was given.
///
/// # Errors
///
/// [`LayoutError::InvalidInput`] or [`LayoutError::InvalidPosition`] for a number that makes no sense. A bad layout is not
/// an error but has findings.
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

/// The largest number of plates that a layout may have.
pub const MAX_PLATES: usize = 1000;

/// Shape and height that all plates of a layout share.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlateGeometry {
    /// The washing surface; plates keep apart by the radius of its rim.
    pub surface: Surface,
    /// Height of the pole of the washing surface (z, base frame), metres.
    pub height_m: f64,
    /// Thickness, from the washing surface down, metres.
    pub thickness_m: f64,
    /// The ring that a plate stands on, where it has one.
    pub foot: Option<Foot>,
}

/// The rule by which plates keep their distance. It concerns centres: it does not keep plates from overlapping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spacing {
    /// Centres must be farther apart than this, metres.
    pub min_distance_m: f64,
    /// Centres must be farther from the base axis than this, metres.
    pub base_radius_m: f64,
}

/// The rectangle that the robot's base covers, base frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BaseFootprint {
    /// Least and greatest x, metres.
    pub x_m: [f64; 2],
    /// Least and greatest y, metres.
    pub y_m: [f64; 2],
}

impl PlateGeometry {
    /// Refuses a radius or thickness that is not greater than zero, a height that is not finite, and a foot of no size.
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

    /// Plates of this geometry at the centres `[x, y]`, metres, base frame.
    pub(crate) fn plates(&self, centres: &[[f64; 2]]) -> Vec<Plate> {
        let at = |&[x, y]: &[f64; 2]| Plate {
            surface: self.surface,
            thickness_m: self.thickness_m,
            foot: self.foot,
            pose: Pose::translation(x, y, self.height_m),
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

    /// How far a plate that lies level with the base is apart from it, seen from above; negative where it lies over it \[m\]. `None` of a plate
    /// that does not lie level: what it meets is for the bodies to tell.
    #[must_use]
    pub fn gap_m(&self, plate: &Plate) -> Option<f64> {
        let away_m = plate.is_level().then(|| self.signed_distance(plate.centre_xy()));
        away_m.map(|away_m| away_m - plate.rim_m())
    }

    /// Distance of a point \[m\], negative inside.
    fn signed_distance(&self, [x, y]: [f64; 2]) -> f64 {
        let beyond = |value: f64, [low, high]: [f64; 2]| (low - value).max(value - high);
        let (dx, dy) = (beyond(x, self.x_m), beyond(y, self.y_m));
        let (outside_x, outside_y) = (dx.max(0.0), dy.max(0.0));
        (outside_x * outside_x + outside_y * outside_y).sqrt() + dx.max(dy).min(0.0)
    }
}
