//! Where the plates lie: drawn at random or given, and what is wrong with the result.
//!
//! All positions are in the frame of the layout: origin on the base axis, axes along those of the world, z = 0 at the height 0 of the
//! world, metres. Of an arm that stands at the world's origin that is its base frame.

mod cells;
mod discs;
mod error;
mod findings;
mod footprint;
mod outline;
mod packing;
mod placement;
mod region;
mod sampling;
mod space;
mod spacing;
mod task_region;
mod wedge;

use crate::plate::Plate;
use platewash_kinematics::Pose;
use rand::Rng;
use serde::{Deserialize, Serialize};

pub use error::{EmptyReason, InputProblem, LayoutError};
pub use findings::Finding;
pub use footprint::{base_footprint, mounted_footprint};
pub use packing::packing_bound;
pub use placement::Placement;
pub use region::Region;
pub use sampling::{Attempt, Sampler};
pub use spacing::{BaseFootprint, MAX_PLATES, PlateGeometry, Spacing};
pub use task_region::TaskRegion;

use sampling::Work;

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
