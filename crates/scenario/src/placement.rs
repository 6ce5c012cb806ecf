//! From the `[layout]` section to plates.

use crate::failure::Failure;
use crate::layout::{LayoutSection, PLATE_RADIUS_M};
use crate::scenario::Scenario;
use platewash_kinematics::RobotModel;
use platewash_planner::Watch;
use platewash_workcell::layout::{
    self, BaseFootprint, Layout, LayoutError, Placement, PlateGeometry, Region, Sampler, Spacing, TaskRegion,
};
use platewash_workcell::plate::Foot;
use platewash_workcell::random;
use platewash_workcell::surface::{Knot, MeridianError, Surface};
use rand_pcg::Pcg64;
use std::sync::Arc;

impl LayoutSection {
    /// Where the plates come from.
    #[must_use]
    pub fn placement(&self) -> Placement {
        let region = self.region();
        match &self.positions_m {
            Some(positions) => Placement::Given {
                centres_m: positions.clone(),
                region,
            },
            None => Placement::Sampled {
                region: region.unwrap_or(Region::PAPER_APPENDIX),
                count: self.count,
                washable_only: self.only_washable,
            },
        }
    }

    /// What all plates share.
    #[must_use]
    pub fn geometry(&self) -> PlateGeometry {
        PlateGeometry {
            surface: self.surface(),
            height_m: self.plate_height_m,
            thickness_m: self.plate_thickness_m,
            foot: self
                .plate_foot_m
                .map(|[radius_m, height_m]| Foot { radius_m, height_m }),
        }
    }

    /// The face of every plate. A list of knots that is no meridian, which no scenario that was read has, counts as none.
    #[must_use]
    pub fn surface(&self) -> Surface {
        let of_knots = || self.profile_of_knots()?.ok();
        let named = || self.plate_profile.and_then(|profile| Surface::shipped(profile.name()));
        of_knots().or_else(named).unwrap_or(Surface::Disc {
            radius_m: self.plate_radius_m.unwrap_or(PLATE_RADIUS_M),
        })
    }

    /// The face by its knots, where they are stated, or why they are no meridian.
    pub(crate) fn profile_of_knots(&self) -> Option<Result<Surface, MeridianError>> {
        let knot = |&[radius_m, slope_deg]: &[f64; 2]| Knot {
            radius_m,
            slope_rad: slope_deg.to_radians(),
        };
        let knots: Vec<_> = self.plate_knots.as_ref()?.iter().map(knot).collect();
        Some(Surface::profile(&knots))
    }

    /// How far they keep apart.
    #[must_use]
    pub fn spacing(&self) -> Spacing {
        Spacing {
            min_distance_m: self.min_distance_m,
            base_radius_m: self.base_radius_m,
        }
    }

    /// Where plates are drawn, to look at.
    #[must_use]
    pub fn task_region(&self) -> TaskRegion {
        TaskRegion {
            base_circle_m: (self.base_radius_m > 0.0).then_some(self.base_radius_m),
            polygon_m: self.region().map(|region| region.outline_m()),
        }
    }

    /// The region stated; `None` where none is (explicit positions only).
    #[must_use]
    pub fn region(&self) -> Option<Region> {
        if let Some(named) = self.region {
            return Some(named.region());
        }
        let around = self.rho_m.map(|[_, most]| [-most, most]);
        Some(Region {
            x_m: self.x_m.or(around)?,
            y_m: self.y_m.or(around)?,
            rho_m: self.rho_m,
            azimuth_deg: self.azimuth_deg,
        })
    }

    fn draw(&self, base: &BaseFootprint, rng: &mut Pcg64) -> Result<Layout, LayoutError> {
        self.placement().place(&self.spacing(), &self.geometry(), base, rng)
    }
}

impl Scenario {
    /// Places the plates round an arm: as given, or drawn from the seed's own stream, whether they can be washed or not.
    ///
    /// # Errors
    /// [`LayoutError`].
    pub fn layout(&self, arm: &RobotModel) -> Result<Layout, LayoutError> {
        let base = layout::base_footprint(arm);
        self.layout.draw(&base, &mut random::stream(self.seed, "layout"))
    }

    /// Places the plates round an arm; where `layout.only_washable` asks for it, layouts are drawn until every plate can be washed
    /// whole.
    ///
    /// # Errors
    /// [`Failure`]: no room, too much work, or none of the layouts drawn will do.
    pub fn place(&self, arm: &Arc<RobotModel>, watch: &Watch<'_>) -> Result<Layout, Failure> {
        if !self.layout.placement().needs_planner() {
            return Ok(self.layout(arm)?);
        }
        self.check_work()?;
        let base = layout::base_footprint(arm);
        let mut rng = random::stream(self.seed, "layout");
        let mut draw = || self.layout.draw(&base, &mut rng);
        let terms = self.terms(arm, &Layout::of(Vec::new()))?;
        Ok(platewash_planner::draw_washable_layout(arm, &terms, &mut draw, watch)?)
    }

    /// Refuses a region in which not even one plate has room.
    pub(crate) fn check_region(&self) -> Result<(), LayoutError> {
        match self.layout.placement() {
            Placement::Given { .. } => Ok(()),
            Placement::Sampled { region, .. } => Sampler::new(&region, &self.layout.spacing()).map(|_| ()),
        }
    }
}
