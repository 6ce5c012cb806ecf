//! Notes, not errors: values that were probably meant in another unit, a home that is left open, links that nothing checks.

use crate::scenario::Scenario;
use platewash_kinematics::inertia::ImplausibleInertia;
use platewash_kinematics::urdf::FollowerLink;
use platewash_kinematics::words::{decimals_up, rounded};
use platewash_kinematics::{AXES, RobotModel};
use platewash_workcell::Obstacle;
use platewash_workcell::tool::Tool;
use platewash_workcell::words::quoted;
use serde::Serialize;
use std::f64::consts::TAU;
use std::fmt;

/// An arm that reaches farther than this is described in millimetres \[m\]: six axes reach some five metres.
const LONGEST_REACH_M: f64 = 20.0;

/// Least and greatest length of a body at which its numbers are probably metres \[m\].
const SMALLEST_BODY_M: f64 = 1e-3;
const LARGEST_BODY_M: f64 = 10.0;

/// Significant digits of suggested values.
const DIGITS: usize = 4;

/// Notice to the user about a scenario or an arm that is accepted.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Note {
    /// A home whose values all lie within ±2π, not all zero and not all whole numbers: degrees are expected, radians were
    /// probably meant.
    HomeInRadians {
        /// The key.
        key: &'static str,
        /// Values stated \[deg\].
        found_deg: [f64; AXES],
        /// The values in degrees, if radians were intended \[deg\].
        meant_deg: [f64; AXES],
    },
    /// A certified job without a home: one is looked for.
    HomeLeftOpen,
    /// An arm that reaches tens of metres and more: URDF states metres, millimetres were probably meant.
    ArmInMillimetres {
        /// Name of the arm.
        robot: String,
        /// Greatest reach, as described \[m\].
        reach_m: f64,
    },
    /// Links whose visuals stand for collision shapes.
    VisualShapes {
        /// Name of the arm.
        robot: String,
        /// The links.
        links: Vec<String>,
    },
    /// A controller that counts from another link than the root link of the arm's description.
    ControllerBase {
        /// Name of the arm.
        robot: String,
        /// Name of the root link.
        root: String,
        /// Link from which the controller counts, and its place at the root link.
        base: String,
    },
    /// Links that move and have no collision shapes: no clearance of theirs is checked.
    NoShapes {
        /// Name of the arm.
        robot: String,
        /// The links.
        links: Vec<String>,
    },
    /// Statements of an arm's description that are not used or not complete.
    UnusedStatements {
        /// Name of the arm.
        robot: String,
        /// The first ones in words.
        words: String,
    },
    /// Links that are left out, as joints carry them that follow an axis: nothing is judged of them.
    LeftOutLinks {
        /// Name of the arm.
        robot: String,
        /// Clause that names the links.
        words: String,
    },
    /// Inertias that no body of the link's mass and size has.
    ImplausibleInertias {
        /// Name of the arm.
        robot: String,
        /// The first of them.
        first: ImplausibleInertia,
        /// Number of further ones.
        more: usize,
    },
    /// A plate that was measured.
    MeasuredPlate {
        /// Name of the file.
        file: String,
        /// Unit of the file, and whether it was guessed.
        unit: String,
        /// True for points on the face, false for a mesh.
        is_probed: bool,
        /// Greatest deviation of the measured plate from the fitted one \[m\].
        deviation_m: f64,
    },
    /// A body that is very small or very large for its place: its numbers may be in another unit.
    UnusualSize {
        /// Name of the body.
        body: String,
        /// Longest side of the box around it \[m\].
        extent_m: f64,
    },
    /// A body of the tool or an obstacle whose convex parts hold more than its mesh.
    LargerThanMesh {
        /// Name of the body.
        body: String,
        /// Upper bound on how far the parts reach beyond the mesh \[m\].
        by_m: f64,
        /// Stand-in for the mesh.
        as_what: MeshAs,
    },
}

/// Stand-in for a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MeshAs {
    /// Its convex hull.
    Hull,
    /// Its convex hull, of a body of the tool.
    HullOfTool,
    /// Convex parts.
    Parts,
}

impl Scenario {
    /// Notes on values of the scenario that are probably meant in another unit; the arm's description is for [`Note::of_arm`].
    #[must_use]
    pub fn notes(&self) -> Vec<Note> {
        let robot = &self.robot;
        let homes = [("robot.start_deg", robot.start_deg), ("robot.home_deg", robot.home_deg)];
        let notes = homes.into_iter().filter_map(|(key, home)| Note::of_home(key, home?));
        let [start, _] = self.homes();
        let open = start.is_none().then_some(Note::HomeLeftOpen);
        let measured = self.measured().iter().map(|shape| Note::MeasuredPlate {
            file: shape.file.clone(),
            unit: shape.unit.clone(),
            is_probed: shape.is_probed,
            deviation_m: shape.deviation_m,
        });
        notes.chain(open).chain(measured).collect()
    }
}

impl Note {
    fn of_home(key: &'static str, found_deg: [f64; AXES]) -> Option<Self> {
        let small = found_deg.iter().all(|v| v.abs() <= TAU);
        let broken = found_deg.iter().any(|v| v.fract() != 0.0);
        (small && broken).then(|| Self::HomeInRadians {
            key,
            found_deg,
            meant_deg: found_deg.map(|v| rounded(v.to_degrees(), DIGITS)),
        })
    }

    /// Notes on values of an arm's description that are probably meant in another unit, on links without collision shapes, and on a
    /// controller that does not count from the root link.
    #[must_use]
    pub fn of_arm(robot: &RobotModel) -> Vec<Self> {
        let (_, reach_m) = robot.reach_bound(&robot.last_link_frame());
        let name = || robot.name().to_owned();
        let long = (reach_m > LONGEST_REACH_M).then(|| Self::ArmInMillimetres { robot: name(), reach_m });
        let links: Vec<_> = robot.links_without_shapes().map(str::to_owned).collect();
        let bare = (!links.is_empty()).then(|| Self::NoShapes { robot: name(), links });
        let of_visuals = robot.links_with_visual_shapes();
        let visual = (!of_visuals.is_empty()).then(|| Self::VisualShapes {
            robot: name(),
            links: of_visuals.to_vec(),
        });
        let base = robot.controller_base().map(|base| Self::ControllerBase {
            robot: name(),
            root: base.root.to_owned(),
            base: base.to_string(),
        });
        let words = robot.unused_words();
        let unused = words.map(|words| Self::UnusedStatements { robot: name(), words });
        let words = FollowerLink::clause(robot.left_out_links());
        let left_out = words.map(|words| Self::LeftOutLinks { robot: name(), words });
        let mut inertias = robot.implausible_inertias();
        let inertias = inertias.next().map(|first| Self::ImplausibleInertias {
            robot: name(),
            first,
            more: inertias.count(),
        });
        let all = [long, bare, visual, base, unused, left_out, inertias];
        let sizes = robot.links().iter().filter_map(|link| {
            let extents = link.collision.iter().map(|part| part.shape.extent_m());
            Self::of_size(&link.name, extents.reduce(f64::max)?)
        });
        all.into_iter().flatten().chain(sizes).collect()
    }

    /// Notes on bodies of a tool and obstacles that are very small or very large.
    #[must_use]
    pub fn of_sizes(tool: &Tool, obstacles: &[Obstacle]) -> Vec<Self> {
        let of_tool = tool.bodies.iter().map(|body| (&body.name, Some(body.shape.extent_m())));
        let of_obstacles = obstacles.iter().map(|body| (&body.name, body.shape.extent_m()));
        let all = of_tool.chain(of_obstacles);
        all.filter_map(|(name, extent_m)| Self::of_size(name, extent_m?))
            .collect()
    }

    fn of_size(body: &str, extent_m: f64) -> Option<Self> {
        let is_usual = (SMALLEST_BODY_M..=LARGEST_BODY_M).contains(&extent_m);
        (!is_usual).then(|| Self::UnusualSize {
            body: body.to_owned(),
            extent_m,
        })
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::HomeInRadians {
                key,
                found_deg,
                meant_deg,
            } => write!(
                f,
                "{key} = {found_deg:?} is taken in degrees; radians were probably meant, as all of it lies within ±2π: write \
                 {meant_deg:?}"
            ),
            Self::HomeLeftOpen => f.write_str(
                "robot.start_deg is not stated for this arm: a clear home is looked for, and stands in the plan; `platewash robot --suggest` shows one",
            ),
            Self::ArmInMillimetres { robot, reach_m } => write!(
                f,
                "robot {robot} reaches {} m: URDF states metres; millimetres were probably meant",
                rounded(*reach_m, DIGITS)
            ),
            Self::NoShapes { robot, links } => write!(
                f,
                "robot {robot}: links without collision shapes, whose clearance is not checked (--visual-shapes, robot.visual_shapes, takes \
                 their visuals): {}",
                links.join(", ")
            ),
            Self::VisualShapes { robot, links } => write!(
                f,
                "robot {robot}: visuals stand for the collision shapes of {}",
                links.join(", ")
            ),
            Self::ControllerBase { robot, root, base } => write!(
                f,
                "robot {robot}: the controller counts from {base}; places here count from the world, poses of the arm from link '{root}'"
            ),
            Self::UnusedStatements { robot, words } => write!(f, "robot {robot}: the description states {words}"),
            Self::LeftOutLinks { robot, words } => write!(f, "robot {robot}: {words}"),
            Self::ImplausibleInertias { robot, first, more } => {
                let [least, most] = first.possible_kg_m2.map(|moment| rounded(moment, DIGITS));
                write!(
                    f,
                    "robot {robot}: link '{}' of {} kg, within {} m of its centre of mass, has a moment of inertia of {} kg·m²; bodies of \
                     that mass and size have {least} to {most}{}",
                    first.link,
                    first.mass_kg,
                    rounded(first.radius_m, DIGITS),
                    rounded(first.found_kg_m2, DIGITS),
                    match more {
                        0 => String::new(),
                        more => format!("; {more} more links have implausible ones, too"),
                    }
                )
            }
            Self::MeasuredPlate {
                file,
                unit,
                is_probed,
                deviation_m,
            } => {
                let (file, by_mm) = (quoted(file), decimals_up(1e3 * deviation_m, 2));
                let at_points = if *is_probed { " at the points" } else { "" };
                let between = if *is_probed { "; between them the face is not measured" } else { "" };
                write!(
                    f,
                    "{file} is in {unit}; its plate deviates from the fitted profile by up to {by_mm} mm{at_points}, which adds to its height error{between}"
                )
            }
            Self::UnusualSize { body, extent_m } => {
                let body = quoted(body);
                let (size, unit) = match *extent_m < SMALLEST_BODY_M {
                    true => (format!("{:.2} mm", 1e3 * extent_m), "scaled twice, or in metres where another unit was meant"),
                    false => (format!("{extent_m:.1} m"), "in millimetres or inches where metres are expected"),
                };
                write!(f, "{body} is {size} long at most; its numbers may be {unit}")
            }
            Self::LargerThanMesh {
                body,
                by_m,
                as_what,
            } => {
                let (body, by_mm) = (quoted(body), decimals_up(1e3 * by_m, 1));
                let (counts, advice) = match as_what {
                    MeshAs::Parts => ("convex parts, which reach", "cut the mesh into several closed bodies, or state boxes in its place"),
                    MeshAs::Hull => (
                        "its convex hull, which reaches",
                        "mesh_parts = \"decomposed\", or a mesh cut into several bodies, is nearer to it",
                    ),
                    MeshAs::HullOfTool => (
                        "its convex hull, which reaches",
                        "several bodies of the tool, each with a part of the mesh, are nearer to it",
                    ),
                };
                write!(
                    f,
                    "{body} counts as {counts} up to {by_mm} mm beyond its mesh: it may fill a hollow, and a proof can fail for that alone; {advice}"
                )
            }
        }
    }
}
