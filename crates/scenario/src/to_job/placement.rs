//! From the `[layout]` section to plates.
//!
//! The plates that a scenario states one by one or kind by kind: their numbers and shapes, and their checks.

use crate::error::{Problem, conflict};
use crate::failure::Failure;
use crate::scenario::Scenario;
use crate::sections::layout::{LayoutSection, PLATE_RADIUS_M, PlateSection};
use crate::sections::motion::Program;
use platewash_kinematics::RobotModel;
use platewash_planner::Watch;
use platewash_workcell::job::Overlap;
use platewash_workcell::layout::{
    self, BaseFootprint, Finding, Layout, LayoutError, MAX_PLATES, Placement, PlateGeometry, Region, Sampler, Spacing,
    TaskRegion,
};
use platewash_workcell::plate::{Foot, Plate, PlateTerms};
use platewash_workcell::random;
use platewash_workcell::surface::{Knot, MeridianError, Surface};
use rand_pcg::Pcg64;
use std::borrow::Cow;
use std::sync::Arc;

impl LayoutSection {
    /// Source of the plates' positions.
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

    /// Geometry that all plates share.
    #[must_use]
    pub fn geometry(&self) -> PlateGeometry {
        PlateGeometry {
            surface: self.surface(),
            height_m: self.plate_height_m,
            thickness_m: self.plate_thickness_m,
            foot: self
                .plate_foot_m
                .map(|[radius_m, height_m]| Foot { radius_m, height_m }),
            terms: PlateTerms::default(),
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

    /// Least distances between plates, and from the base.
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
    /// [`Failure`]: no room, or a file of plates that cannot be used.
    pub fn layout(&self, arm: &RobotModel) -> Result<Layout, Failure> {
        if let Cow::Owned(read) = self.plates_read()? {
            return read.layout(arm);
        }
        self.check_mount(arm)?;
        let base = layout::mounted_footprint(arm, &self.robot.mount(arm));
        Ok(self.draw(arm, base.as_ref(), &mut random::stream(self.seed, "layout"))?)
    }

    /// A layout, in the world. It is drawn about the foot of the arm's mount, along the world's axes: there the rules of spacing hold.
    fn draw(&self, arm: &RobotModel, base: Option<&BaseFootprint>, rng: &mut Pcg64) -> Result<Layout, LayoutError> {
        if let Some(plates) = self.listed_plates() {
            return Ok(Layout::with_overlaps(plates, self.foot_m(arm), base));
        }
        let (foot_m, kinds) = (self.foot_m(arm), self.kinds());
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
        let mut layout = placement.place(&self.layout.spacing(), &self.geometry_of(None), base, rng)?;
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
    pub fn foot_m(&self, arm: &RobotModel) -> [f64; 2] {
        self.robot.mount(arm).translation.vector.xy().into()
    }

    /// Region in which plates are drawn at random, for display: world frame.
    #[must_use]
    pub fn task_region(&self, arm: &RobotModel) -> TaskRegion {
        let ([x, y], layout) = (self.foot_m(arm), &self.layout);
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
    /// [`Failure`]: no room, too much work, or none of the drawn layouts can be washed.
    pub fn place(&self, arm: &Arc<RobotModel>, watch: &Watch<'_>) -> Result<Layout, Failure> {
        if let Cow::Owned(read) = self.plates_read()? {
            return read.place(arm, watch);
        }
        if self.lists_plates() || !self.layout.placement().needs_planner() {
            return self.layout(arm);
        }
        self.check_work()?;
        self.check_mount(arm)?;
        let base = layout::mounted_footprint(arm, &self.robot.mount(arm));
        let mut rng = random::stream(self.seed, "layout");
        let mut draw = || self.draw(arm, base.as_ref(), &mut rng);
        let terms = self.terms(arm, &Layout::from_plates(Vec::new()))?;
        Ok(platewash_planner::draw_washable_layout(arm, &terms, &mut draw, watch)?)
    }

    /// Checks that plates of a layout share a place, with each other or the base, so that no plan of them can be proved.
    #[must_use]
    pub fn has_forbidden_overlap(&self, layout: &Layout) -> bool {
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

impl Scenario {
    /// Returns true where plates are given one by one: by `[[plate]]` or `layout.positions_m`.
    #[must_use]
    pub fn lists_plates(&self) -> bool {
        let given = |plate: &PlateSection| plate.at_m.is_some();
        self.layout.positions_m.is_some()
            || self.layout.plate_file.is_some()
            || (!self.plate.is_empty() && self.plate.iter().all(given))
    }

    /// Plates that are asked for.
    #[must_use]
    pub fn plates(&self) -> usize {
        self.kinds().iter().map(|(count, _)| count).sum()
    }

    /// The plates that `[[plate]]` gives one by one, if it does.
    pub(crate) fn listed_plates(&self) -> Option<Vec<Plate>> {
        let rows = self.plate.iter().enumerate();
        let plates: Option<Vec<_>> = rows.map(|(k, row)| row.faces_of(&self.geometry_of(Some(k)))).collect();
        Some(plates?.concat()).filter(|plates| !plates.is_empty())
    }

    /// Index of the `[[plate]]` section that states the position of each plate, counted from 0; `None` where there is none.
    #[must_use]
    pub fn plate_sections(&self) -> Option<Vec<usize>> {
        let listed = !self.plate.is_empty() && self.plate.iter().all(|row| row.at_m.is_some());
        let faces = |row: &PlateSection| if row.has_both() { 2 } else { 1 };
        let rows = self.plate.iter().enumerate();
        listed.then(|| rows.flat_map(|(index, row)| vec![index; faces(row)]).collect())
    }

    /// Numbers of plates with their shapes, in the order of the plates.
    pub(crate) fn kinds(&self) -> Vec<(usize, PlateGeometry)> {
        let layout = &self.layout;
        let listed = layout.positions_m.as_ref().map_or(layout.count, Vec::len);
        if self.plate.is_empty() {
            return vec![(listed, self.geometry_of(None))];
        }
        let faces = |row: &PlateSection| if row.has_both() { 2 } else { 1 };
        let kind = |(k, row): (usize, &PlateSection)| (row.count.unwrap_or(faces(row)), self.geometry_of(Some(k)));
        self.plate.iter().enumerate().map(kind).collect()
    }

    /// Geometry of the plates of a `[[plate]]` section by its index, or of `[layout]`.
    fn geometry_of(&self, section: Option<usize>) -> PlateGeometry {
        let row = section.and_then(|k| self.plate.get(k));
        let own = row.map_or_else(|| self.layout.clone(), |row| row.as_layout(&self.layout));
        PlateGeometry {
            terms: self.plate_terms(section, &own),
            ..own.geometry()
        }
    }

    /// The `[layout]` that each shape of plates is stated by, and the words for its keys.
    pub(crate) fn shapes(&self) -> Vec<(LayoutSection, ShapeKeys)> {
        if self.plate.is_empty() {
            return vec![(self.layout.clone(), ShapeKeys(None))];
        }
        let rows = self.plate.iter().enumerate();
        rows.map(|(index, row)| (row.as_layout(&self.layout), ShapeKeys(Some(index))))
            .collect()
    }

    /// Refuses sections that state no plates.
    pub(crate) fn check_plates(&self) -> Result<(), Problem> {
        for (layout, keys) in self.shapes() {
            layout.check_shape().map_err(|problem| keys.of_problem(problem))?;
        }
        self.check_plate_files()?;
        if self.plate.is_empty() {
            return Ok(());
        }
        if self.layout.positions_m.is_some() {
            return conflict(
                "plate, layout.positions_m",
                "give [[plate]] sections or positions_m, not both",
            );
        }
        if self.layout.plate_file.is_some() {
            return Ok(());
        }
        if self.job.program == Program::Paper {
            let detail =
                "the paper's program washes plates of one kind: state them in [layout], or job.program = \"certified\"";
            return conflict("plate", detail);
        }
        let first_is_given = self.plate[0].at_m.is_some();
        for (index, row) in self.plate.iter().enumerate() {
            let at = |name: &str| format!("plate[{index}].{name}");
            match (row.at_m, row.count) {
                (None, None) => conflict(
                    at("at_m"),
                    "is missing: say where the plate is, or how many of its kind are sampled (count)",
                )?,
                (Some(_), Some(_)) => conflict(
                    at("count"),
                    "is for plates that are sampled; this one has its place, at_m",
                )?,
                (Some(_), None) if first_is_given => {}
                (None, Some(_)) if !first_is_given => {}
                _ => conflict(
                    at("at_m"),
                    "either every [[plate]] has its place, at_m, or every one a count",
                )?,
            }
            let geometry = row.as_layout(&self.layout).geometry();
            if row.has_both() && (!geometry.surface.is_flat() || geometry.foot.is_some() || row.count.is_some()) {
                let detail = "both faces are those of a flat plate without a foot that has its place, at_m";
                conflict(at("faces"), detail)?;
            }
            if row.has_both() && self.holder.friction.is_some() {
                let detail = "a plate that stands on a ring (holder.friction) has one face to wash: state a fixture, or leave one face out";
                conflict(at("faces"), detail)?;
            }
            if row.count.is_some() && row.rpy_deg.is_some() {
                conflict(
                    at("rpy_deg"),
                    "plates that are sampled lie level: give at_m to tilt one",
                )?;
            }
        }
        let found = self.plates();
        if found > MAX_PLATES {
            return conflict(
                "plate.count",
                format!("there may be at most {MAX_PLATES} plates in all; found {found}"),
            );
        }
        Ok(())
    }
}

/// Names of the keys of a plate's shape: those of `[layout]`, or those of a `[[plate]]` by its index.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShapeKeys(pub Option<usize>);

impl ShapeKeys {
    /// A key of `[layout]`, as it is called here.
    pub fn called(self, key: &str) -> String {
        match self.0 {
            Some(index) => key.replace("layout.plate_", &format!("plate[{index}].")),
            None => key.to_owned(),
        }
    }

    /// The same problem with the names of the keys here.
    fn of_problem(self, problem: Problem) -> Problem {
        match problem {
            Problem::Conflict { keys, detail } => Problem::Conflict {
                keys: self.called(&keys),
                detail: self.called(&detail).replace("plate_radius_m", "radius_m"),
            },
            other => other,
        }
    }
}
