//! Where a scenario's plates lie and where its arm starts.

use crate::robot::RobotError;
use crate::scenario::{LayoutSection, Scenario};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::layout::{
    self, Layout, LayoutError, PlateGeometry, Region, SampleRequest, SampleSettings, Spacing,
};
use platewash_workcell::random;
use rand_pcg::Pcg64;

/// Places the plates of a scenario: sampled from the seed's own stream, or as given and checked.
///
/// # Errors
/// [`LayoutError`].
pub fn place_plates(scenario: &Scenario, robot: &RobotModel) -> Result<Layout, LayoutError> {
    draw_plates(scenario, robot, &mut random::stream(scenario.seed, "layout"))
}

/// The same from a stream of the caller's, so that one layout after the other can be drawn.
pub(crate) fn draw_plates(scenario: &Scenario, robot: &RobotModel, rng: &mut Pcg64) -> Result<Layout, LayoutError> {
    let section = &scenario.layout;
    let spacing = spacing(section);
    let geometry = PlateGeometry {
        radius_m: section.plate_radius_m,
        height_m: section.plate_height_m,
        thickness_m: section.plate_thickness_m,
    };
    let base = layout::base_footprint(robot);
    let region = region(section);
    match (&section.positions_m, region) {
        (Some(positions), region) => layout::check_explicit(positions, region.as_ref(), &spacing, &geometry, &base),
        (None, region) => {
            let request = SampleRequest {
                region: region.unwrap_or(Region::PAPER_APPENDIX),
                spacing,
                count: section.count,
                geometry,
                base,
            };
            layout::sample(&request, &SampleSettings::default(), rng)
        }
    }
}

/// The start configuration \[rad\], within the limits.
pub(crate) fn start(scenario: &Scenario, robot: &RobotModel) -> Result<JointVector, RobotError> {
    let [start, _] = scenario.homes();
    match robot.limits().violation(&start) {
        Some(violation) => Err(RobotError::Start(violation)),
        None => Ok(start),
    }
}

pub(crate) fn spacing(section: &LayoutSection) -> Spacing {
    Spacing {
        min_distance_m: section.min_distance_m,
        base_radius_m: section.base_radius_m,
    }
}

/// The region that a section states; `None` when it states none (explicit positions only).
pub(crate) fn region(section: &LayoutSection) -> Option<Region> {
    if let Some(named) = section.region {
        return Some(named.region());
    }
    let around = section.rho_m.map(|[_, most]| [-most, most]);
    Some(Region {
        x_m: section.x_m.or(around)?,
        y_m: section.y_m.or(around)?,
        rho_m: section.rho_m,
        azimuth_deg: section.azimuth_deg,
    })
}
