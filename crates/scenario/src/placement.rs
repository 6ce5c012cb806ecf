//! From the `[layout]` section to plates.

use crate::failure::Failure;
use crate::job::Program;
use crate::layout::{LayoutSection, PLATE_RADIUS_M};
use crate::scenario::Scenario;
use platewash_kinematics::RobotModel;
use platewash_planner::Watch;
use platewash_workcell::job::Overlap;
use platewash_workcell::layout::{
    self, BaseFootprint, Finding, Layout, LayoutError, Placement, PlateGeometry, Region, Sampler, Spacing, TaskRegion,
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
}

impl Scenario {
    /// Places the plates round an arm: as given, or drawn from the seed's own stream, whether they can be washed or not.
    ///
    /// # Errors
    /// [`LayoutError`].
    pub fn layout(&self, arm: &RobotModel) -> Result<Layout, LayoutError> {
        let base = layout::mounted_footprint(arm, &self.robot.mount());
        self.draw(base.as_ref(), &mut random::stream(self.seed, "layout"))
    }

    /// A layout, in the world. It is drawn about the foot of the arm's mount, along the world's axes: there the rules of spacing hold.
    fn draw(&self, base: Option<&BaseFootprint>, rng: &mut Pcg64) -> Result<Layout, LayoutError> {
        if let Some(plates) = self.listed_plates() {
            return Ok(Layout::listed(plates, self.foot_m(), base));
        }
        let (foot_m, kinds) = (self.foot_m(), self.kinds());
        let placement = match self.layout.placement() {
            Placement::Given { centres_m, region } => Placement::Given {
                centres_m: centres_m.iter().map(|[x, y]| [x - foot_m[0], y - foot_m[1]]).collect(),
                region,
            },
            Placement::Sampled {
                region, washable_only, ..
            } => Placement::Sampled {
                region,
                count: self.plates(),
                washable_only,
            },
        };
        let mut layout = placement.place(&self.layout.spacing(), &self.layout.geometry(), base, rng)?;
        if !self.plate.is_empty() {
            layout = layout.of_kinds(&kinds, base);
        }
        if foot_m != [0.0; 2] {
            layout = layout.moved_by(foot_m);
            // To the bit where they are said to be.
            for (plate, centre_m) in layout.plates.iter_mut().zip(self.layout.positions_m.iter().flatten()) {
                *plate = plate.moved_to(*centre_m);
            }
        }
        Ok(layout)
    }

    /// The foot of the arm's mount, seen from above, in the world \[m\].
    #[must_use]
    pub fn foot_m(&self) -> [f64; 2] {
        let [x, y, _] = self.robot.mount_m;
        [x, y]
    }

    /// Where plates are drawn, to look at: in the world.
    #[must_use]
    pub fn task_region(&self) -> TaskRegion {
        let ([x, y], layout) = (self.foot_m(), &self.layout);
        let moved = |outline: Vec<[f64; 2]>| outline.into_iter().map(|[u, v]| [u + x, v + y]).collect();
        let drawn = self.listed_plates().is_none();
        TaskRegion {
            base_circle_m: (drawn && layout.base_radius_m > 0.0).then_some(layout.base_radius_m),
            polygon_m: layout
                .region()
                .filter(|_| drawn)
                .map(|region| moved(region.outline_m())),
        }
    }

    /// Places the plates round an arm; where `layout.only_washable` asks for it, layouts are drawn until every plate can be washed
    /// whole.
    ///
    /// # Errors
    /// [`Failure`]: no room, too much work, or none of the layouts drawn will do.
    pub fn place(&self, arm: &Arc<RobotModel>, watch: &Watch<'_>) -> Result<Layout, Failure> {
        if self.lists_plates() || !self.layout.placement().needs_planner() {
            return Ok(self.layout(arm)?);
        }
        self.check_work()?;
        let base = layout::mounted_footprint(arm, &self.robot.mount());
        let mut rng = random::stream(self.seed, "layout");
        let mut draw = || self.draw(base.as_ref(), &mut rng);
        let terms = self.terms(arm, &Layout::of(Vec::new()))?;
        Ok(platewash_planner::draw_washable_layout(arm, &terms, &mut draw, watch)?)
    }

    /// Whether plates of a layout share a place, with each other or the base, and no plan of them can be proved for that.
    #[must_use]
    pub fn forbids(&self, layout: &Layout) -> bool {
        let shared =
            |finding: &Finding| matches!(finding, Finding::PlatesOverlap { .. } | Finding::OverlapsBase { .. });
        let judged = self.job.program == Program::Certified && self.layout.overlap == Overlap::Fail;
        judged && layout.findings.iter().any(shared)
    }

    /// Refuses a region in which not even one plate has room.
    pub(crate) fn check_region(&self) -> Result<(), LayoutError> {
        match self.layout.placement() {
            _ if self.lists_plates() => Ok(()),
            Placement::Given { .. } => Ok(()),
            Placement::Sampled { region, .. } => Sampler::new(&region, &self.layout.spacing()).map(|_| ()),
        }
    }
}
