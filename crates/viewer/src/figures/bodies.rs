//! The bodies of a workcell at one configuration, to be drawn.

use super::solid::light::Rgb;
use super::solid::shapes::{Facets, facets, hull, mesh};
use platewash_kinematics::geometry::VisualShape;
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_workcell::tool::Tool;
use platewash_workcell::workcell::{ObstacleShape, Workcell};

/// A body, where it is (`T_world_body`) and its colour.
pub(super) struct Placed {
    pub facets: Facets,
    pub pose: Pose,
    pub colour: Rgb,
}

const ARM: Rgb = [0.95, 0.62, 0.32];
const HANDLE: Rgb = [0.42, 0.45, 0.5];
const SPONGE: Rgb = [0.98, 0.83, 0.25];
const OBSTACLE: Rgb = [0.72, 0.74, 0.8];

/// The arm's links at `q` \[rad\].
pub(super) fn arm(arm: &RobotModel, mount: &Pose, q: &JointVector) -> Vec<Placed> {
    let poses = arm.fk(q);
    let mut all = Vec::new();
    for link in arm.links() {
        let at = mount * poses.pose(&link.frame);
        if link.visuals.is_empty() {
            // Of a description without looks, what can touch is drawn.
            all.extend(link.collision.iter().map(|body| Placed {
                facets: facets(&body.shape),
                pose: at * body.pose,
                colour: ARM,
            }));
        }
        all.extend(link.visuals.iter().map(|visual| Placed {
            facets: match &visual.shape {
                VisualShape::Solid(shape) => facets(shape),
                VisualShape::Mesh(triangles) => mesh(triangles),
            },
            pose: at * visual.pose,
            colour: visual.rgba.map_or(ARM, |[r, g, b, _]| [r, g, b]),
        }));
    }
    all
}

/// The tool on its flange, the sponge pressed in by so much \[m\].
pub(super) fn tool(tool: &Tool, flange: &Pose, pressed_m: f64) -> Vec<Placed> {
    if !tool.is_present() {
        return Vec::new();
    }
    let mut all: Vec<Placed> = tool
        .bodies
        .iter()
        .map(|body| Placed {
            facets: facets(&body.shape),
            pose: flange * body.pose,
            colour: HANDLE,
        })
        .collect();
    let mut sponge = tool.sponge;
    // Its far face stays where the tip is only where nothing is pressed in.
    sponge.height_m -= pressed_m;
    all.push(Placed {
        facets: facets(&sponge.shape()),
        pose: flange * sponge.pose * Pose::translation(0.0, 0.0, -0.5 * pressed_m),
        colour: SPONGE,
    });
    all
}

/// What stands around, the floor apart.
pub(super) fn obstacles(workcell: &Workcell) -> Vec<Placed> {
    let all = workcell.obstacles.iter();
    all.flat_map(|obstacle| {
        let shapes = match &obstacle.shape {
            ObstacleShape::HalfSpace => Vec::new(),
            ObstacleShape::Convex(shape) => vec![facets(shape)],
            ObstacleShape::Parts(hulls) => hulls.iter().map(|points| hull(points)).collect(),
        };
        shapes.into_iter().map(|facets| Placed {
            facets,
            pose: obstacle.pose,
            colour: OBSTACLE,
        })
    })
    .collect()
}
