//! Basis of a verdict: the job that the motion was judged for, the parts that were not judged, and the assumptions.

use crate::clearance::exclusions::Exclusions;
use crate::report::words::{list, mm, number, plates};
use nalgebra::{Point3, Vector3};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::tool_mount::ToolMount;
use platewash_kinematics::trig::atan2;
use platewash_kinematics::urdf::FollowerLink;
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel};
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::job::{ContactRequirements, JobTerms, Limits, Overlap, PlanKind, Recovery, Requirements, Soil};
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::{Sponge, Tool};
use platewash_workcell::words::{count_with_noun, pair_text, plate_name, plate_number, printable, quoted};
use platewash_workcell::{ArmId, Exclusion, ExclusionReason, Obstacle, ObstacleShape, Workcell};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Number of digits of a hash that are shown.
const HASH_DIGITS: usize = 12;

/// Assumption about accelerations, of an arm whose description limits none, and of another.
const REACHED: [&str; 2] = [
    "the joints and the tip reach the stated accelerations; no published values are known",
    "the joints and the tip reach the stated accelerations",
];

/// Assumptions that hold for every job.
const ASSUMPTIONS: [&str; 2] = [
    "the arm matches its description and follows the planned motion exactly",
    "the collision shapes enclose the arm, the tool and the obstacles",
];

/// Assumption about plates if all are flat, and below if some are not.
const FLAT: &str = "plates are rigid, flat and round, and lie where the job says";
const CURVED: &str = "plates are rigid and round, have the stated profiles, and lie where the job says";

/// Text about contact where the job has no contact requirements.
const NOT_ASKED: &str = "not required: a point counts as swept where the sponge's face touches it, pressed or not";

/// Assumptions about the sponge: without contact requirements on flat plates, without them on other faces, and with them.
const WHOLE_FACE: &str = "the sponge is round and soft, so that its whole face touches; its compression is not judged";
const TOUCHES: &str = "the sponge is round and a bed of independent columns: it touches where its free face would reach into the plate; its \
                       compression is not judged";
const FOUNDATION: &str = "the sponge is round and each column of it presses with stiffness × strain; its stiffness lies in the stated range, \
                          which nobody measured";

/// Text added with contact requirements: the height error of the plates.
const ERROR_OF_HEIGHT: &str = "contact and contact speed hold for plates too high or too low by up to the stated height error; everything else, \
                               clearance too, at the stated height";

/// Assumptions added for plates out of meshes, and out of points that a probe touched.
const MESHED: &str = "plates out of meshes are as their meshes; these lie within the stated deviation of the fitted profile, and shares are those of \
                      the fitted face";
const PROBED: &str = "plates out of touched points have the fitted profile within the stated deviation between the points, too, where nobody measured";

/// Assumptions added where the job states what holds the plates: a fixture, and below a ring on which they stand.
const IN_FIXTURE: &str = "what holds a plate takes the stated force and torque at once; the friction of the sponge is at most the stated one";
const ON_RING: &str = "a plate on its ring is rigid and moves slowly if at all, stands on the whole ring, has its centre of mass on its axis, and is \
                       held by Coulomb friction of at least the stated coefficient; gravity is 9.81 m/s² along −z of the world; the friction of the \
                       sponge is at most the stated one";

/// Assumption added for a dry run.
const PARENT: &str =
    "the dry run tries out the plan with the stated hash; checking that takes that plan (verify --parent)";

/// Remark added for a dry run.
const IN_AIR: &str = "nothing is pressed in the air: contact, forces and what holds the plates are judged of the plan that is tried out, not here";

/// Assumptions added for both parts of a recovery.
const STANDS: &str = "the arm stands still where the motion begins, after a stop of the plan with the stated hash";
const WASHED_BEFORE: &str = "the plates that are left out were washed before the plan with the stated hash was stopped";

/// Basis of a verdict: the job as it was judged, and the assumptions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VerdictBasis {
    /// Mount, tool and obstacles. The arm is the one that the motion was judged for, and the exclusions are the pairs that were not judged.
    pub workcell: Workcell,
    /// The plates.
    pub plates: Vec<Plate>,
    /// Requirements of the washing.
    pub requirements: Requirements,
    /// Limits of joints and tip, in addition to those of the arm's description.
    pub limits: Limits,
    /// Numbers of the joints whose acceleration limit is that of the arm's description, from 1; the others are assumed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub described_accelerations: Vec<usize>,
    /// Links of the arm's description that are left out, as joints carry them that follow an axis: nothing is judged of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out_links: Vec<FollowerLink>,
    /// Joint positions at the start and at the end \[rad\].
    pub home_rad: [JointVector; 2],
    /// Pairs that only the job excludes. They were judged, and are waived where they do not keep clear.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waived_pairs: Vec<Exclusion>,
    /// Kinds of soil on the plates.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub soils: Vec<Soil>,
    /// Parent plan of a dry run, as stated by the job; not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry_run: Option<DryRun>,
    /// Stopped plan, as stated by the job; not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recovery: Option<Recovery>,
    /// Assumptions in words.
    pub assumptions: Vec<String>,
}

impl VerdictBasis {
    pub(crate) fn new(job: &JobTerms, arm: &RobotModel, exclusions: Exclusions) -> Self {
        Self {
            workcell: Workcell {
                arm: ArmId::new(arm),
                exclusions: exclusions.own,
                ..job.workcell.clone()
            },
            plates: job.plates.clone(),
            soils: job.soils.clone(),
            requirements: job.requirements,
            limits: job.limits,
            described_accelerations: described_accelerations(job, arm),
            left_out_links: arm.left_out_links().to_vec(),
            home_rad: job.home_rad,
            waived_pairs: exclusions.waived,
            assumptions: assumptions(job, arm)
                .into_iter()
                .map(str::to_owned)
                .chain(links(arm))
                .chain(
                    arm.unused_words()
                        .map(|words| format!("the arm's description states {words}")),
                )
                .chain(controller_base(arm))
                .collect(),
            dry_run: job.dry_run.clone(),
            recovery: job.recovery.clone(),
        }
    }
}

impl VerdictBasis {
    /// Returns the kind of the plan.
    pub(crate) fn kind(&self) -> PlanKind {
        PlanKind::stated(self.dry_run.as_ref(), self.recovery.as_ref())
    }

    /// Requirements of the washing, each as lax as it is for any plate.
    pub(crate) fn laxest(&self) -> Requirements {
        let lax = |contact: ContactRequirements| {
            let of_plates = self.plates.iter().map(|plate| contact.of_plate(plate, &self.soils));
            let laxer = |a: ContactRequirements, b: ContactRequirements| ContactRequirements {
                height_error_m: a.height_error_m.min(b.height_error_m),
                dose_pa_m: a.dose_pa_m.min(b.dose_pa_m),
                force_n: [a.force_n[0].min(b.force_n[0]), a.force_n[1].max(b.force_n[1])],
                ..a
            };
            of_plates.reduce(laxer).unwrap_or(contact)
        };
        Requirements {
            contact: self.requirements.contact.map(lax),
            ..self.requirements
        }
    }
}

/// Returns the assumptions about a job.
fn assumptions(job: &JobTerms, arm: &RobotModel) -> Vec<&'static str> {
    let flat = job.plates.iter().all(|plate| plate.surface.is_flat());
    let mut all = Vec::from(ASSUMPTIONS);
    let is_limited = arm.limits().acceleration.iter().any(Option::is_some);
    all.insert(1, REACHED[usize::from(is_limited)]);
    all.push(if flat { FLAT } else { CURVED });
    all.push(match (&job.requirements.contact, flat) {
        (Some(_), _) => FOUNDATION,
        (None, true) => WHOLE_FACE,
        (None, false) => TOUCHES,
    });
    all.extend(job.requirements.contact.map(|_| ERROR_OF_HEIGHT));
    all.extend(
        job.requirements
            .holder
            .map(|holder| if holder.ring.is_some() { ON_RING } else { IN_FIXTURE }),
    );
    let is_measured = |probed: bool| job.measured.iter().any(|shape| shape.is_probed == probed);
    all.extend(is_measured(false).then_some(MESHED));
    all.extend(is_measured(true).then_some(PROBED));
    if job.dry_run.is_some() {
        all.extend([IN_AIR, PARENT]);
    }
    let of_recovery = |recovery: &Recovery| {
        if recovery.is_motion_home() {
            STANDS
        } else {
            WASHED_BEFORE
        }
    };
    all.extend(job.recovery.as_ref().map(of_recovery));
    all
}

/// Returns notes about links of the arm: those without collision shapes, those whose shapes are convex hulls, those that are split into convex
/// parts, and those whose visuals stand for collision shapes.
fn links(arm: &RobotModel) -> impl Iterator<Item = String> {
    let (split, of_visuals) = (arm.split_links(), arm.links_with_visual_shapes());
    let notes = [
        (
            arm.links_without_shapes().map(quoted).collect::<Vec<_>>(),
            "links without collision shapes keep clear of everything; they were not checked",
        ),
        (
            arm.links_with_hulls().map(quoted).collect(),
            "links are within the convex hulls of their meshes",
        ),
        (
            split.iter().map(|link| quoted(link)).collect(),
            "links are within convex parts that enclose their meshes",
        ),
        (
            of_visuals.iter().map(|link| quoted(link)).collect(),
            "links are within their visuals, as they have no collision shapes",
        ),
    ];
    let told = notes.into_iter().filter(|(links, _)| !links.is_empty());
    told.map(|(links, what)| format!("{what}: {}", links.join(", ")))
}

/// Returns the numbers of the joints whose acceleration limit in a job is that of the arm's description, from 1.
fn described_accelerations(job: &JobTerms, arm: &RobotModel) -> Vec<usize> {
    let pairs = arm
        .limits()
        .acceleration
        .into_iter()
        .zip(job.limits.joint_acceleration_rad_s2);
    let is_described = |(described, of_job): (Option<f64>, f64)| described.is_some_and(|limit| limit <= of_job);
    let numbered = pairs.enumerate().filter(|(_, pair)| is_described(*pair));
    numbered.map(|(joint, _)| joint + 1).collect()
}

fn listed(numbers: &[usize]) -> String {
    numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// Returns a note about the frame from which the controller counts, if it is not that of the root link.
fn controller_base(arm: &RobotModel) -> Option<String> {
    let base = arm.controller_base()?;
    Some(format!(
        "the mount is that of the root link {}; the controller counts from {base}",
        quoted(base.root)
    ))
}

/// Greatest sine of the angle between the vertical and the normal of a half-space that counts as a floor.
const LEVEL: f64 = 0.5;

impl VerdictBasis {
    /// Returns the end of the first line for a job without a floor; empty for a job with one.
    #[must_use]
    pub fn without_floor(&self) -> &'static str {
        match self.workcell.obstacles.iter().any(is_floor) {
            true => "",
            false => "; the job has no floor: nothing was checked against one",
        }
    }

    /// Returns the end of the first line for an arm with links that are left out; empty for one without.
    #[must_use]
    pub fn without_links(&self) -> String {
        FollowerLink::clause(&self.left_out_links).map_or_else(String::new, |clause| format!("; {clause}"))
    }

    /// Returns the basis in words: a name and its text for each line.
    #[must_use]
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let dry_run = self.dry_run.iter().map(|dry_run| ("dry run", dry_run_text(dry_run)));
        let mut lines: Vec<_> = dry_run.collect();
        let recovery = self.recovery.iter();
        lines.extend(recovery.map(|recovery| ("recovery", recovery_text(recovery))));
        lines.extend([
            ("arm", arm(&self.workcell)),
            ("tool", tool(&self.workcell.tool)),
            ("tool mount", tool_mount(&self.workcell.tool)),
            ("sponge", sponge(&self.workcell.tool.sponge)),
            ("plates", plates(&self.plates, &self.soils)),
            ("obstacles", obstacles(&self.workcell.obstacles)),
            ("home", homes(&self.home_rad)),
            ("limits", limits(&self.limits, &self.described_accelerations)),
            ("requirements", requirements(&self.requirements)),
        ]);
        let reduced = self.workcell.reduced_clearances.iter().map(|reduced| {
            let required_m = self.requirements.clearance_m - reduced.by_m;
            (
                "less clearance",
                format!("{} mm between {}", mm(required_m), pair_text(&reduced.pair)),
            )
        });
        lines.extend(reduced);
        lines.extend(
            contact(&self.workcell.tool, &self.requirements, self.dry_run.as_ref()).map(|what| ("contact", what)),
        );
        lines.extend(self.assumptions.iter().map(|what| ("assumed", printable(what))));
        let (once, never) = self.left_out();
        lines.push(("not checked", grouped(&never)));
        if !self.left_out_links.is_empty() {
            let links: Vec<_> = self.left_out_links.iter().map(ToString::to_string).collect();
            lines.push(("links left out", links.join(", ")));
        }
        if !once.is_empty() {
            lines.push(("checked once", grouped(&once)));
        }
        if !self.waived_pairs.is_empty() {
            let pairs = self
                .waived_pairs
                .iter()
                .map(|exclusion| pair_text(&exclusion.pair))
                .collect::<Vec<_>>();
            lines.push(("waived", format!("by the job: {}", pairs.join(", "))));
        }
        lines
    }

    /// Returns the pairs that are checked once, as their distance does not change, and those that are not checked; both with the reason in
    /// words.
    fn left_out(&self) -> (Vec<LeftOut<'_>>, Vec<LeftOut<'_>>) {
        let obstacles = self.workcell.obstacles_from_base();
        let is_ground = |name: &String| obstacles.iter().any(|o| o.name == *name && o.is_ground());
        let told = self
            .workcell
            .exclusions
            .iter()
            .map(|Exclusion { pair, reason }| match reason {
                ExclusionReason::Srdf => (false, 0, "disabled by the SRDF", pair),
                ExclusionReason::Neighbours => (false, 1, "neighbours", pair),
                ExclusionReason::AlwaysTouching => (false, 2, "always touching", pair),
                ExclusionReason::CarriesTool => (false, 3, "carries the tool", pair),
                ExclusionReason::NeitherMoves if pair.iter().any(is_ground) => (false, 4, "stands on the ground", pair),
                ExclusionReason::NeitherMoves => (true, 5, "neither moves", pair),
                ExclusionReason::KeepsItsHeight => (true, 6, "stays at its height", pair),
            });
        let mut told: Vec<_> = told.collect();
        told.sort_by_key(|(_, order, ..)| *order);
        let (once, never): (Vec<_>, Vec<_>) = told.into_iter().partition(|(is_checked, ..)| *is_checked);
        let [once, never] = [once, never].map(|all| all.into_iter().map(|(_, _, words, pair)| (words, pair)).collect());
        (once, never)
    }
}

/// Reason for leaving a pair out, in words, and the pair.
type LeftOut<'a> = (&'static str, &'a [String; 2]);

impl fmt::Display for VerdictBasis {
    /// Some compact lines; a name stands before the first of its lines.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\nthe proof rests on")?;
        let mut before = "";
        for (name, what) in self.lines() {
            let shown = if name == before { "" } else { name };
            writeln!(f, "  {shown:<13} {what}")?;
            before = name;
        }
        Ok(())
    }
}

fn dry_run_text(dry_run: &DryRun) -> String {
    format!(
        "of the plan {}, its plates raised by {} mm; nothing is there, and nothing is washed",
        printable(&dry_run.parent),
        mm(dry_run.height_m)
    )
}

fn recovery_text(recovery: &Recovery) -> String {
    format!("{}; of the plan {}", recovery.words(), printable(&recovery.parent))
}

fn arm(world: &Workcell) -> String {
    let arm = &world.arm;
    let short = |hash: &str| printable(&hash.chars().take(HASH_DIGITS).collect::<String>());
    let srdf = arm.srdf_sha256.as_deref();
    let srdf = srdf.map_or("without an SRDF".to_owned(), |hash| format!("SRDF {}", short(hash)));
    let at = world.mount.translation.vector;
    let place = if at == Vector3::zeros() {
        "at the origin".to_owned()
    } else {
        format!("at ({}) m", list(at.iter().copied()))
    };
    let held = match arm.fixed.is_empty() {
        true => String::new(),
        false => format!("; held still: {}", arm.fixed_words()),
    };
    format!(
        "{}, description {}, {srdf}; mounted {place}{}{held}",
        quoted(&arm.name),
        short(&arm.urdf_sha256),
        turned(&world.mount)
    )
}

fn tool_mount(tool: &Tool) -> String {
    match &tool.mounted_on {
        Some(mount) => {
            let ToolMount { link, axis } = ToolMount::from_text(mount);
            format!("on link {} along its {axis}", quoted(link))
        }
        None => "on tool0 along its z".to_owned(),
    }
}

fn sponge(sponge: &Sponge) -> String {
    format!(
        "radius {} and height {} mm, compressed by {} mm (assumed), {}{}",
        mm(sponge.radius_m),
        mm(sponge.height_m),
        mm(sponge.compression_m),
        of_flange(&sponge.pose),
        axis_text(&sponge.pose)
    )
}

fn tool(tool: &Tool) -> String {
    let bodies = tool.bodies.iter().map(|body| {
        let (name, shape) = (quoted(&body.name), shape(&body.shape));
        format!("{name}, {shape} {}{}", of_flange(&body.pose), turned(&body.pose))
    });
    let mut parts: Vec<_> = bodies.collect();
    if parts.is_empty() {
        parts.push("no body".to_owned());
    }
    parts.push(format!("tip {}{}", of_flange(&tool.tip), axis_text(&tool.tip)));
    parts.join("; ")
}

fn of_flange(pose: &Pose) -> String {
    let at = pose.translation.vector;
    format!("at ({}) mm of the flange", list(at.iter().map(|v| 1e3 * v)))
}

/// Formats the direction of a z axis that is not along the z axis of its reference frame.
fn axis_text(pose: &Pose) -> String {
    let axis = pose.rotation * Vector3::z();
    if axis.xy() == Vector3::zeros().xy() && axis.z > 0.0 {
        return String::new();
    }
    format!(", along ({})", list(axis.iter().copied()))
}

/// Formats a rotation; empty for none.
fn turned(pose: &Pose) -> String {
    let [x, y, z, w] = pose.rotation.quaternion().coords.into();
    let along = Vector3::new(x, y, z);
    if along == Vector3::zeros() {
        return String::new();
    }
    // Scaled, so that the squares of the least rotation are not 0.
    let most = along.amax();
    let length = (along / most).norm();
    let side = if w < 0.0 { -1.0 } else { 1.0 };
    let axis = along / most / length * side;
    let angle_rad = 2.0 * atan2(length * most, w.abs());
    format!(
        ", turned by {} ° about ({})",
        number(angle_rad.to_degrees()),
        list(axis.iter().copied())
    )
}

fn shape(shape: &Shape) -> String {
    match shape {
        Shape::Box { half_m } => format!("a box of {} mm", list(half_m.iter().map(|v| 2e3 * v))),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => format!(
            "a cylinder of radius {} and length {} mm",
            mm(*radius_m),
            mm(2.0 * half_length_m)
        ),
        Shape::Sphere { radius_m } => format!("a sphere of radius {} mm", mm(*radius_m)),
        Shape::Capsule {
            radius_m,
            half_length_m,
        } => format!(
            "a capsule of radius {} and length {} mm",
            mm(*radius_m),
            mm(2.0 * (half_length_m + radius_m))
        ),
        Shape::Hull { points } => format!(
            "the hull of {}, {} mm,",
            count_with_noun(points.len(), "point"),
            bounds(points)
        ),
    }
}

/// Formats the range of points along each axis, in millimetres.
fn bounds(points: &[Point3<f64>]) -> String {
    let along = |(axis, name): (usize, &str)| {
        let least = points.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let most = points.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        format!("{name} from {} to {}", mm(least), mm(most))
    };
    ["x", "y", "z"]
        .into_iter()
        .enumerate()
        .map(along)
        .collect::<Vec<_>>()
        .join(", ")
}

fn obstacles(obstacles: &[Obstacle]) -> String {
    let one = |obstacle: &Obstacle| {
        let at = || {
            let at = list(obstacle.pose.translation.vector.iter().copied());
            format!("at ({at}) m{}", turned(&obstacle.pose))
        };
        let body = match &obstacle.shape {
            ObstacleShape::HalfSpace => beyond(&obstacle.pose),
            ObstacleShape::Convex(solid) => format!("{} {}", shape(solid), at()),
            ObstacleShape::Parts(hulls) => {
                let (count, points) = (count_with_noun(hulls.len(), "hull"), hulls.concat());
                let together = count_with_noun(points.len(), "point");
                format!("{count} of {together} together, {} mm, {}", bounds(&points), at())
            }
        };
        format!(
            "{}, {body}{}{}",
            quoted(&obstacle.name),
            grown(obstacle.margin_m),
            holding(&obstacle.holds_plates)
        )
    };
    let mut parts: Vec<_> = obstacles.iter().map(one).collect();
    if !obstacles.iter().any(is_floor) {
        parts.insert(0, "no floor".to_owned());
    }
    if obstacles.is_empty() {
        parts.insert(0, "none".to_owned());
    }
    parts.join("; ")
}

/// True if an obstacle is a half-space whose normal points up, at any height. A ceiling or a wall is no floor.
fn is_floor(obstacle: &Obstacle) -> bool {
    let up = obstacle.pose.rotation * Vector3::z();
    obstacle.shape == ObstacleShape::HalfSpace && up.z > 0.0 && up.xy().norm() <= LEVEL
}

/// Returns a note about the margin of an obstacle; empty for none.
fn grown(margin_m: f64) -> String {
    if margin_m == 0.0 {
        return String::new();
    }
    format!(", grown by {} mm", mm(margin_m))
}

/// Returns a note about the plates that an obstacle holds; empty for none.
fn holding(plates: &[usize]) -> String {
    match plates {
        [] => String::new(),
        &[plate] => format!(", holding {}", plate_name(plate)),
        plates => format!(
            ", holding plates {}",
            list(plates.iter().map(|plate| plate_number(*plate) as f64))
        ),
    }
}

/// The half-space z ≤ 0 of a pose.
fn beyond(pose: &Pose) -> String {
    let (at, up) = (pose.translation.vector, pose.rotation * Vector3::z());
    if up == Vector3::z() && at.z == 0.0 {
        return "all below 0".to_owned();
    }
    if up == Vector3::z() {
        return format!("all below {} m", number(at.z));
    }
    format!(
        "all behind the plane through ({}) m that faces ({})",
        list(at.iter().copied()),
        list(up.iter().copied())
    )
}

fn homes([start, end]: &[JointVector; 2]) -> String {
    let degrees = |q: &JointVector| list(q.iter().map(|v| v.to_degrees()));
    if start == end {
        return format!("{} ° at the start and at the end", degrees(start));
    }
    format!("{} ° at the start, {} ° at the end", degrees(start), degrees(end))
}

fn limits(limits: &Limits, described: &[usize]) -> String {
    let source = match described.len() {
        0 => "assumed".to_owned(),
        AXES => "from the description".to_owned(),
        _ => format!("of joints {} from the description, others assumed", listed(described)),
    };
    format!(
        "joint positions and speeds from the description; joint accelerations {} rad/s² ({source}); tip speed {} m/s, tip acceleration {} m/s² (assumed)",
        list(limits.joint_acceleration_rad_s2),
        number(limits.tip_speed_m_s),
        number(limits.tip_acceleration_m_s2)
    )
}

fn requirements(wanted: &Requirements) -> String {
    let overlap = match wanted.overlap {
        Overlap::Report => "overlapping plates reported",
        Overlap::Fail => "no overlapping plates",
    };
    let order = if wanted.as_listed { "as listed" } else { "in any order" };
    format!(
        "swept {} %, clearance {} mm, tilt {} °, wash speed {} m/s, wash acceleration {} m/s², {overlap}, {order}",
        number(100.0 * wanted.coverage),
        mm(wanted.clearance_m),
        number(wanted.tilt_rad.to_degrees()),
        number(wanted.wash_speed_m_s),
        number(wanted.wash_acceleration_m_s2)
    )
}

/// Returns the text about contact and its requirements, with a note where there are none; `None` for a dry run without them, which washes
/// nothing.
fn contact(tool: &Tool, wanted: &Requirements, dry_run: Option<&DryRun>) -> Option<String> {
    let speed = |what: &str, limit: Option<f64>| limit.map(|limit| format!("{what} at most {} m/s", number(limit)));
    let wrist = wanted.wrist_rad.map(|wrist| {
        let kept = number(wrist.to_degrees());
        format!("joint 5 stays at least {kept} ° from 0, on one side at every plate")
    });
    let promise = wanted.contact.map(|contact| {
        let [least, most] = tool.sponge.stiffness_pa.unwrap_or_default();
        let [softest_n, stiffest_n] = contact.force_n;
        format!(
            "a point is in contact where the sponge is compressed by {} mm or more, with the plate up to {} mm too high or too low and a \
             stiffness from {} to {} kPa (assumed); in contact {} % of the face, for {} s or more {} %, with a dose of {} Pa·m or more {} %; \
             strain at most {} %, contact force {} to {} N",
            mm(contact.compression_m),
            mm(contact.height_error_m),
            number(1e-3 * least),
            number(1e-3 * most),
            number(100.0 * contact.share),
            number(contact.time_s),
            number(100.0 * contact.time_share),
            number(contact.dose_pa_m),
            number(100.0 * contact.dose_share),
            number(100.0 * contact.strain),
            number(softest_n),
            number(stiffest_n)
        )
    });
    let held = wanted.holder.map(|holder| {
        let by = match (holder.fixture, holder.ring) {
            (Some(fixture), _) => format!(
                "a fixture that takes {} N across its axis and {} N·m about it",
                number(fixture.force_n),
                number(fixture.torque_nm)
            ),
            (_, Some(ring)) => format!(
                "friction of {} or more alone, on a ring of radius {} mm",
                number(ring.friction),
                mm(ring.radius_m)
            ),
            _ => "nothing".to_owned(),
        };
        let mass = holder
            .plate_mass_kg
            .map(|mass_kg| format!(" with a mass of {} kg", number(mass_kg)));
        format!(
            "each plate{} stays, held by {by}, with a friction of the sponge of at most {} (assumed)",
            mass.unwrap_or_default(),
            number(holder.sponge_friction)
        )
    });
    let parts = [
        promise.or_else(|| dry_run.is_none().then(|| NOT_ASKED.to_owned())),
        speed("the free sponge lands with", wanted.landing_m_s),
        speed("it lifts off with", wanted.lifting_m_s),
        wrist,
        held,
    ];
    let told: Vec<_> = parts.into_iter().flatten().collect();
    (!told.is_empty()).then(|| told.join("; "))
}

/// Groups neighbouring pairs by reason, in words.
fn grouped(pairs: &[LeftOut<'_>]) -> String {
    let group = |group: &[LeftOut<'_>]| {
        let pairs: Vec<_> = group.iter().map(|(_, pair)| pair_text(pair)).collect();
        format!("{}: {}", group[0].0, pairs.join(", "))
    };
    let said: Vec<_> = pairs.chunk_by(|a, b| a.0 == b.0).map(group).collect();
    if said.is_empty() {
        "no pair".to_owned()
    } else {
        said.join("; ")
    }
}
