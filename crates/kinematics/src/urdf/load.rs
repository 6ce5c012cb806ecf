//! A model is built from URDF text.

use crate::fingerprint::sha256_hex;
use crate::geometry::{Inertial, Primitive, Shape};
use crate::joints::AXES;
use crate::model::{Frame, Joint, Link, RobotModel};
use crate::rotation::RigidTransform;
use crate::urdf::error::{self, UrdfError};
use crate::urdf::fixed::{self, Fixed, FixedJoints};
use crate::urdf::mesh::MeshSource;
use crate::urdf::shapes::{self, VisualReader};
use crate::urdf::tree::{self, Tree, finite, pose, rigid, unit_axis};
use crate::urdf::{followers, scan, unused_statements};
use crate::words::message_in_words;
use nalgebra::{Matrix3, Vector3};

/// Greatest number of links that are read; real descriptions need fewer than 50.
const MAX_LINKS: usize = 1000;

/// Greatest number of collision elements that are read, all links together: every pair of them may need a check.
const MAX_COLLISIONS: usize = 500;

impl RobotModel {
    /// Builds a model from expanded URDF text. `meshes` finds `package://` and relative mesh files.
    ///
    /// # Errors
    /// [`UrdfError`], naming the joint or link at fault.
    pub fn from_urdf(text: &str, meshes: &MeshSource) -> Result<Self, UrdfError> {
        load(text, meshes, &FixedJoints::new())
    }

    /// Builds a model as [`RobotModel::from_urdf`] does, of a description with more than six moving joints: those in `fixed` are held at
    /// the stated positions, with those that mimic them, the outermost first, until six move. Other names in `fixed` are ignored.
    ///
    /// # Errors
    /// [`UrdfError`], naming the joint or link at fault.
    pub fn from_urdf_with_fixed(text: &str, meshes: &MeshSource, fixed: &FixedJoints) -> Result<Self, UrdfError> {
        load(text, meshes, fixed)
    }

    /// Checks that joints are held still as they were stated to be: [`RobotModel::from_urdf_with_fixed`] ignores names that it does not need.
    ///
    /// # Errors
    /// [`UrdfError::NotHeld`] for one of the six axes, a joint that follows one of them, and a name of no joint that moves.
    pub fn check_held(&self, stated: &FixedJoints) -> Result<(), UrdfError> {
        let Some(joint) = stated.keys().find(|joint| !self.fixed_joints().contains_key(*joint)) else {
            return Ok(());
        };
        let follower = self.left_out_links().iter().find(|link| link.joint == *joint);
        let reason = match follower {
            Some(link) => format!("it follows '{}', and what it carries is left out", link.leader),
            None if self.joints().iter().any(|axis| axis.name == *joint) => "it is one of the six axes".to_owned(),
            None => "the description has no joint of that name that moves".to_owned(),
        };
        let joint = joint.clone();
        Err(UrdfError::NotHeld { joint, reason })
    }
}

/// Builds the model from expanded URDF text.
///
/// # Errors
/// [`UrdfError`], naming the joint or link at fault.
pub(crate) fn load(text: &str, meshes: &MeshSource, fixed: &FixedJoints) -> Result<RobotModel, UrdfError> {
    scan::check(text)?;
    let stated = unused_statements::read(text)?;
    let used = &stated.used_text;
    let mut robot = urdf_rs::read_from_string(used).map_err(|e| syntax(used, &e))?;
    sizes(&robot)?;
    let fixed = fixed::fix(&mut robot, fixed)?;
    let left_out = followers::take_out(&mut robot)?;
    let tree = Tree::build(&robot)?;
    let limits = tree::limits(&tree, &stated.rates)?;
    let joints = tree.axes.map(|joint| Joint {
        name: joint.name.clone(),
        parent: joint.parent.link.clone(),
        child: joint.child.link.clone(),
    });
    let friction = tree::friction(&tree)?;
    let (folded, frames) = fold(&tree, &fixed)?;
    let last_link = frames[tree.position(&tree.axes[AXES - 1].child.link)];
    let mut looks = VisualReader::new(&robot, meshes);
    let links = tree
        .links
        .iter()
        .zip(&frames)
        .map(|(link, frame)| convert_link(link, *frame, meshes, &mut looks));
    let links = links.collect::<Result<Vec<_>, _>>()?;
    shapes::check_split_links(&links, meshes)?;
    let of_visuals = tree.links.iter().filter(|link| shapes::takes_visuals(link, meshes));
    let of_visuals: Vec<_> = of_visuals.map(|link| link.name.clone()).collect();
    let is_split = |link: &&Link| meshes.split_links().contains(&link.name);
    let split: Vec<_> = links.iter().filter(is_split).map(|link| link.name.clone()).collect();
    Ok(RobotModel {
        name: robot.name.clone(),
        sha256: fingerprint(text, &links, [&of_visuals, &split], &fixed.positions),
        joints,
        limits,
        friction,
        unused: stated.unused,
        left_out,
        folded,
        links,
        last_link,
        disabled: None,
        visual_findings: looks.findings,
        of_visuals,
        split,
        fixed: fixed.positions,
    })
}

/// Returns the SHA-256 of the text, followed by the vertices of its collision meshes, or of the parts of those that are split, if any, as
/// bytes of little-endian doubles in metres, by the names of the links whose visuals stand for collision shapes, by those of the links that
/// are split, with their numbers of shapes' vertices, and by names and positions of the joints that are fixed on request.
pub(crate) fn fingerprint(
    text: &str,
    links: &[Link],
    [of_visuals, split]: [&Vec<String>; 2],
    fixed: &FixedJoints,
) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for primitive in links.iter().flat_map(|link| &link.collision) {
        if let Shape::Hull { points } = &primitive.shape {
            let numbers = points.iter().flat_map(|p| p.coords.iter().copied());
            bytes.extend(numbers.flat_map(f64::to_le_bytes));
        }
    }
    bytes.extend(
        of_visuals
            .iter()
            .flat_map(|name| format!("\nvisual shapes: {name}").into_bytes()),
    );
    for link in links.iter().filter(|link| split.contains(&link.name)) {
        let vertices = |primitive: &Primitive| match &primitive.shape {
            Shape::Hull { points } => points.len(),
            _ => 0,
        };
        let counts: Vec<_> = link.collision.iter().map(vertices).collect();
        bytes.extend(format!("\nsplit: {} {counts:?}", link.name).into_bytes());
    }
    for (name, position) in fixed {
        bytes.extend(name.bytes().chain(position.to_le_bytes()));
    }
    sha256_hex(&bytes)
}

/// Refuses descriptions so large that the checks of every pair would take too long.
fn sizes(robot: &urdf_rs::Robot) -> Result<(), UrdfError> {
    let collisions = robot.links.iter().map(|link| link.collision.len()).sum();
    for (kind, found, limit) in [
        ("link", robot.links.len(), MAX_LINKS),
        ("collision", collisions, MAX_COLLISIONS),
    ] {
        if found > limit {
            return Err(UrdfError::TooMany { kind, found, limit });
        }
    }
    Ok(())
}

fn syntax(text: &str, error: &urdf_rs::UrdfError) -> UrdfError {
    let message = error.to_string();
    let message = message.trim_start_matches("custom: ");
    // The line is told once, by the place.
    let message = message.rsplit_once("Reason: ").map_or(message, |(_, reason)| reason);
    UrdfError::Syntax {
        at: error::find(text).unwrap_or_else(|| "an unknown place".to_owned()),
        detail: match message {
            "invalid float literal" | "cannot parse float from empty string" => "a value is not a number".to_owned(),
            other => match other.strip_prefix("Wrong vector element count, ") {
                Some(counts) => format!("a vector has the wrong count of numbers: {counts}"),
                None => message_in_words("", other),
            },
        },
    }
}

fn convert_link(
    link: &urdf_rs::Link,
    frame: Frame,
    meshes: &MeshSource,
    reader: &mut VisualReader<'_>,
) -> Result<Link, UrdfError> {
    Ok(Link {
        name: link.name.clone(),
        frame,
        collision: shapes::primitives(link, meshes)?,
        visuals: reader.visuals(link),
        inertial: inertial(link)?,
    })
}

/// Folds every fixed transform: joint frames with z along the axis, and each link as an offset from the
/// body that carries it.
fn fold(tree: &Tree<'_>, fixed: &Fixed) -> Result<([RigidTransform; AXES], Vec<Frame>), UrdfError> {
    let mut folded = [RigidTransform::identity(); AXES];
    let mut frames = vec![Frame::new(0, RigidTransform::identity())];
    for link in &tree.links[1..] {
        let joint = tree.joint_above(&link.name);
        let at = format!("joint '{}'", joint.name);
        let parent = frames[tree.position(&joint.parent.link)];
        let origin = rigid(&joint.origin, &at)?;
        let displaced = fixed
            .displacements
            .get(&joint.name)
            .map_or(origin, |by| origin.then(by));
        let placed = parent.offset(&displaced);
        let axis_index = tree.axes.iter().position(|axis| axis.name == joint.name);
        frames.push(match axis_index {
            None => placed,
            Some(i) => {
                let align = RigidTransform {
                    rotation: frame_with_z_along(&unit_axis(joint)?),
                    translation: Vector3::zeros(),
                };
                folded[i] = placed.offset.then(&align);
                Frame::new(i + 1, align.inverse())
            }
        });
    }
    Ok((folded, frames))
}

/// Returns a rotation whose third column is the given unit vector; exact (a permutation) for coordinate axes.
fn frame_with_z_along(z: &Vector3<f64>) -> Matrix3<f64> {
    let helper = if z.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let x = (helper - z * z.dot(&helper)).normalize();
    Matrix3::from_columns(&[x, z.cross(&x), *z])
}

/// Returns the mass properties of a link; `None` if the file states none (`urdf-rs` then reports zeros).
fn inertial(link: &urdf_rs::Link) -> Result<Option<Inertial>, UrdfError> {
    let at = format!("link '{}'", link.name);
    let urdf_rs::Inertial { origin, mass, inertia } = &link.inertial;
    let moments = [
        inertia.ixx,
        inertia.ixy,
        inertia.ixz,
        inertia.iyy,
        inertia.iyz,
        inertia.izz,
    ];
    if mass.value == 0.0 && moments == [0.0; 6] {
        return Ok(None);
    }
    finite(&at, "inertial mass", &[mass.value])?;
    if mass.value < 0.0 {
        return Err(UrdfError::Mass {
            link: link.name.clone(),
            found: mass.value,
        });
    }
    finite(&at, "inertial inertia", &moments)?;
    Ok(Some(Inertial {
        pose: pose(origin, &at)?,
        mass_kg: mass.value,
        inertia_kg_m2: moments,
    }))
}
