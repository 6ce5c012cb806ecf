//! Obstacles out of a planning scene of MoveIt, a text file `.scene`.
//!
//! The first line is the scene's name. Each object begins with `* NAME`, and its shapes follow, each with a pose and a colour; a line `.` ends
//! the scene. Newer files state the pose of the object before its shapes, which are then placed in its frame, and its subframes after them;
//! older files place the shapes in the frame of the scene. The line after the first object's name tells them apart. Numbers are metres;
//! a pose is x y z and a quaternion x y z w.

use crate::place::ReadError;
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use platewash_bodies::clearance::{SolidParts, excess_m, solid_parts};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::trig::sin_cos;
use platewash_workcell::words::{quoted, shortened};
use platewash_workcell::{Obstacle, ObstacleShape};

/// Greatest coordinate and size \[m\]; a larger one is probably in millimetres.
const GREATEST_M: f64 = 100.0;

/// Greatest difference of a quaternion's length from 1.
const QUATERNION: f64 = 0.01;

/// Number of corners of the prism around a cone.
const CORNERS: usize = 64;

/// Most shapes of an object, and corners and triangles of a mesh.
const MOST: usize = 1_000_000;

/// Longest word that a message repeats, in characters.
const LONGEST: usize = 40;

/// Reads the obstacles of a scene, in its frame. Meshes become convex parts that enclose their surface, and a cone the hull of a prism around
/// it. `name` is that of the file, for messages.
///
/// # Errors
/// [`ReadError`] with the line.
pub fn read(name: &str, text: &str) -> Result<Vec<Obstacle>, ReadError> {
    let mut reader = Reader::new(text);
    reader
        .scene()
        .map_err(|reason| ReadError::at(name, reader.line, reason))
}

/// Distance by which the convex parts of an obstacle reach beyond its mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshExcess {
    /// Name of the obstacle.
    pub obstacle: String,
    /// The distance \[m\].
    pub by_m: f64,
}

/// Returns how far the convex parts of each mesh of a scene reach beyond it; none for a scene that cannot be read.
#[must_use]
pub fn mesh_excesses(text: &str) -> Vec<MeshExcess> {
    let mut reader = Reader::new(text);
    reader.keeps_meshes = true;
    if reader.scene().is_err() {
        return Vec::new();
    }
    let excess = |mesh: SceneMesh| MeshExcess {
        by_m: excess_m(&mesh.triangles, &mesh.parts),
        obstacle: mesh.name,
    };
    reader.meshes.into_iter().map(excess).collect()
}

/// Mesh of a scene, and its convex parts.
struct SceneMesh {
    /// Name of the obstacle.
    name: String,
    triangles: Vec<[Point3<f64>; 3]>,
    parts: Vec<Vec<Point3<f64>>>,
}

/// Rest of a text.
#[derive(Default)]
struct Reader<'a> {
    rest: &'a str,
    line: usize,
    /// Names of the objects so far.
    names: Vec<&'a str>,
    /// True where meshes are kept.
    keeps_meshes: bool,
    meshes: Vec<SceneMesh>,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str) -> Self {
        Self {
            rest: text,
            line: 1,
            ..Self::default()
        }
    }

    fn scene(&mut self) -> Result<Vec<Obstacle>, String> {
        self.rest_of_line();
        let states_poses = self.states_poses();
        let mut all: Vec<Obstacle> = Vec::new();
        loop {
            match self.word() {
                Some("*") => {
                    let object = self.object(states_poses)?;
                    all.extend(object);
                }
                // Older versions do not need the end.
                Some(".") | None => return Ok(all),
                Some(other) => return Err(expected("'* NAME' of an object, or '.' at the end of the scene", other)),
            }
        }
    }

    /// True if the pose of an object stands before its shapes: the line after the first name has more than their number.
    fn states_poses(&self) -> bool {
        let mut lines = self.rest.lines().skip_while(|line| !line.starts_with('*'));
        lines.nth(1).is_some_and(|line| line.trim().contains(' '))
    }

    fn object(&mut self, states_poses: bool) -> Result<Vec<Obstacle>, String> {
        let name = self.rest_of_line().trim();
        if name.is_empty() {
            return Err("expected the name of an object after '*'; found none".to_owned());
        }
        if self.names.contains(&name) {
            return Err(format!("object {} is there twice", quoted(name)));
        }
        self.names.push(name);
        let object = if states_poses { self.pose()? } else { Pose::identity() };
        let count = self.count("a number of shapes")?;
        let mut all = Vec::new();
        for index in 0..count {
            let meshes = self.meshes.len();
            let (shape, inner) = self.shape(name)?;
            let pose = self.pose()?;
            self.numbers::<4>("a colour, four numbers")?;
            let name = match count {
                1 => name.to_owned(),
                _ => format!("{name}[{index}]"),
            };
            if let Some(mesh) = self.meshes.get_mut(meshes) {
                mesh.name.clone_from(&name);
            }
            all.push(Obstacle::new(&name, shape, object * pose * inner));
        }
        if states_poses {
            for _ in 0..self.count("a number of subframes")? {
                self.word().ok_or("expected the name of a subframe; the file ends")?;
                self.pose()?;
            }
        }
        Ok(all)
    }

    /// A shape, and its pose in its own frame.
    fn shape(&mut self, object: &str) -> Result<(ObstacleShape, Pose), String> {
        let word = self.word().unwrap_or_default();
        let convex = match word {
            "box" => {
                let size = self.sizes::<3>("three sizes")?;
                Shape::Box {
                    half_m: size.map(|size| 0.5 * size),
                }
            }
            "sphere" => {
                let [radius_m] = self.sizes("a radius")?;
                Shape::Sphere { radius_m }
            }
            "cylinder" => {
                let [radius_m, length_m] = self.sizes("radius and length")?;
                Shape::Cylinder {
                    radius_m,
                    half_length_m: 0.5 * length_m,
                }
            }
            "cone" => {
                let [radius_m, length_m] = self.sizes("radius and length")?;
                cone(radius_m, length_m)
            }
            "plane" => return self.plane(),
            "mesh" => return self.mesh(object),
            other => return Err(expected("a shape: box, sphere, cylinder, cone, plane or mesh", other)),
        };
        Ok((ObstacleShape::Convex(convex), Pose::identity()))
    }

    /// The half-space behind a plane a x + b y + c z + d = 0, to which (a, b, c) points.
    fn plane(&mut self) -> Result<(ObstacleShape, Pose), String> {
        let [a, b, c, d] = self.numbers("four numbers of a plane")?;
        let normal = Vector3::new(a, b, c);
        let Some(up) = nalgebra::Unit::try_new(normal, 1e-9) else {
            return Err("expected a plane with a normal; found 0, 0, 0".to_owned());
        };
        let turn = UnitQuaternion::rotation_between_axis(&Vector3::z_axis(), &up)
            .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
        let foot = up.into_inner() * (-d / normal.norm());
        Ok((
            ObstacleShape::HalfSpace,
            Isometry3::from_parts(Translation3::from(foot), turn),
        ))
    }

    fn mesh(&mut self, object: &str) -> Result<(ObstacleShape, Pose), String> {
        let (corners, triangles) = (self.count("a number of corners")?, self.count("a number of triangles")?);
        let corners: Vec<Point3<f64>> = (0..corners)
            .map(|_| Ok(Point3::from(self.numbers::<3>("a corner of a mesh, three numbers")?)))
            .collect::<Result<_, String>>()?;
        let mut corner = || {
            let index = self.count("the index of a corner")?;
            let found = corners.get(index).copied();
            found.ok_or_else(|| format!("expected the index of a corner below {}; found {index}", corners.len()))
        };
        let triangles: Vec<[Point3<f64>; 3]> = (0..triangles)
            .map(|_| Ok([corner()?, corner()?, corner()?]))
            .collect::<Result<_, String>>()?;
        let parts = solid_parts(&triangles, SolidParts::Decomposed);
        let mut parts = parts.map_err(|why| format!("mesh of object {}: {why}", quoted(object)))?;
        if self.keeps_meshes {
            self.meshes.push(SceneMesh {
                name: object.to_owned(),
                triangles,
                parts: parts.clone(),
            });
        }
        let shape = match (parts.len(), parts.pop()) {
            (1, Some(points)) => ObstacleShape::Convex(Shape::Hull { points }),
            (_, last) => ObstacleShape::Parts(parts.into_iter().chain(last).collect()),
        };
        Ok((shape, Pose::identity()))
    }

    fn pose(&mut self) -> Result<Pose, String> {
        let [x, y, z] = self.numbers("a position, three numbers")?;
        let [i, j, k, w] = self.numbers("a quaternion x y z w")?;
        let turn = Quaternion::new(w, i, j, k);
        if (turn.norm() - 1.0).abs() > QUATERNION {
            let length = turn.norm();
            return Err(format!(
                "expected a quaternion x y z w of length 1; found one of length {length}"
            ));
        }
        Ok(Isometry3::from_parts(
            Translation3::new(x, y, z),
            UnitQuaternion::from_quaternion(turn),
        ))
    }

    fn sizes<const N: usize>(&mut self, what: &str) -> Result<[f64; N], String> {
        let sizes = self.numbers(what)?;
        match sizes.iter().find(|size| **size <= 0.0) {
            Some(found) => Err(format!("expected {what} above 0 m; found {found}")),
            None => Ok(sizes),
        }
    }

    fn numbers<const N: usize>(&mut self, what: &str) -> Result<[f64; N], String> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            let word = self.word().unwrap_or_default();
            *number = match word.parse::<f64>() {
                Ok(found) if found.abs() <= GREATEST_M => found,
                Ok(found) if found.is_finite() => {
                    return Err(format!(
                        "expected {what}, of at most {GREATEST_M} m; found {found}: these may be millimetres"
                    ));
                }
                _ => return Err(expected(what, word)),
            };
        }
        Ok(numbers)
    }

    fn count(&mut self, what: &str) -> Result<usize, String> {
        let word = self.word().unwrap_or_default();
        word.parse::<usize>()
            .ok()
            .filter(|count| *count <= MOST)
            .ok_or_else(|| expected(what, word))
    }

    /// The next word; `None` at the end.
    fn word(&mut self) -> Option<&'a str> {
        let start = self.rest.trim_start();
        self.advance(self.rest.len() - start.len());
        let end = start.find(char::is_whitespace).unwrap_or(start.len());
        self.advance(end);
        Some(&start[..end]).filter(|word| !word.is_empty())
    }

    fn rest_of_line(&mut self) -> &'a str {
        let line = self.rest.split('\n').next().unwrap_or_default();
        self.advance(line.len());
        line
    }

    fn advance(&mut self, bytes: usize) {
        let (passed, rest) = self.rest.split_at(bytes);
        self.line += passed.matches('\n').count();
        self.rest = rest;
    }
}

/// Hull around a cone along z, whose base is at half its length below the origin and whose tip is as far above.
fn cone(radius_m: f64, length_m: f64) -> Shape {
    let step = std::f64::consts::TAU / CORNERS as f64;
    let around_m = radius_m / sin_cos(0.5 * step).1;
    let corner = |k: usize| {
        let (sin, cos) = sin_cos(step * k as f64);
        Point3::new(around_m * cos, around_m * sin, -0.5 * length_m)
    };
    let tip = Point3::new(0.0, 0.0, 0.5 * length_m);
    Shape::Hull {
        points: (0..CORNERS).map(corner).chain([tip]).collect(),
    }
}

fn expected(what: &str, found: &str) -> String {
    match found {
        "" => format!("expected {what}; the file ends"),
        found => format!("expected {what}; found {}", quoted(&shortened(found, LONGEST))),
    }
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const OLD: &str = "(noname)+\n* table top\n1\nbox\n0.4 0.6 0.02\n0.5 0 0.2\n0 0 0 1\n0 0 0 0\n* post\n2\ncylinder\n0.05 0.8\n0 0.5 0.4\n0 0 0 1\n0 0 0 0\n\
                       sphere\n0.1\n0 0.5 0.9\n0 0 0 1\n1 0 0 1\n.\n";

    fn found(text: &str) -> Vec<Obstacle> {
        read("a.scene", text).unwrap()
    }

    #[test]
    fn older_scenes_place_shapes_in_their_own_frame() {
        let all = found(OLD);
        let names: Vec<_> = all.iter().map(|obstacle| obstacle.name.as_str()).collect();
        assert_eq!(names, ["table top", "post[0]", "post[1]"]);
        assert_eq!(
            all[0].shape,
            ObstacleShape::Convex(Shape::Box {
                half_m: [0.2, 0.3, 0.01]
            })
        );
        assert_eq!(all[2].pose.translation.vector, Vector3::new(0.0, 0.5, 0.9));
        assert_eq!(found(OLD.strip_suffix(".\n").unwrap()), all, "the end may be missing");
    }

    #[test]
    fn newer_scenes_place_shapes_in_the_frame_of_their_object() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let text = format!(
            "scene\n* shelf\n1 2 0\n0 0 {half} {half}\n1\nbox\n0.2 0.4 0.1\n0.5 0 0\n0 0 0 1\n0 0 0 0\n1\nfront\n0 0 0\n0 0 0 1\n* ball\n0 0 1\n0 0 0 1\n1\nsphere\n0.1\n\
             0 0 0\n0 0 0 1\n0 0 0 0\n0\n.\n"
        );
        let [shelf, ball] = &found(&text)[..] else { panic!() };
        assert!((shelf.pose.translation.vector - Vector3::new(1.0, 2.5, 0.0)).norm() < 1e-12);
        assert!((shelf.pose * Vector3::x() - Vector3::y()).norm() < 1e-12);
        assert_eq!(ball.pose.translation.vector, Vector3::z());
    }

    #[test]
    fn planes_are_half_spaces_and_meshes_convex_parts() {
        let end = "0 0 0\n0 0 0 1\n0 0 0 0\n";
        let text = format!(
            "s\n* floor\n1\nplane\n0 0 2 1\n{end}* roof\n1\nplane\n0 0 -1 2\n{end}* tent\n1\nmesh\n4 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 2 1\n0 1 3\n1 2 3\n2 0 3\n{end}.\n"
        );
        let [floor, roof, tent] = &found(&text)[..] else {
            panic!()
        };
        assert_eq!(
            (&floor.shape, &roof.shape),
            (&ObstacleShape::HalfSpace, &ObstacleShape::HalfSpace)
        );
        assert!((floor.pose.translation.z + 0.5).abs() < 1e-12 && (floor.pose * Vector3::z()).z > 0.999);
        assert!((roof.pose.translation.z - 2.0).abs() < 1e-12 && (roof.pose * Vector3::z()).z < -0.999);
        let points: Vec<Point3<f64>> = match &tent.shape {
            ObstacleShape::Convex(Shape::Hull { points }) => points.clone(),
            ObstacleShape::Parts(parts) => parts.concat(),
            other => panic!("{other:?}"),
        };
        for corner in [
            Point3::origin(),
            Point3::new(1.0, 0.0, 0.0),
            Point3::new(0.0, 1.0, 0.0),
            Point3::new(0.0, 0.0, 1.0),
        ] {
            assert!(points.iter().any(|point| (point - corner).norm() < 1e-9), "{corner}");
        }
    }

    proptest! {
        #[test]
        fn a_cone_is_enclosed(radius_m in 0.01..1.0_f64, length_m in 0.01..2.0_f64, angle in 0.0..7.0_f64, height in 0.0..1.0_f64) {
            let Shape::Hull { points } = cone(radius_m, length_m) else { panic!() };
            // A point of the cone's surface is below each plane through the tip and two neighbours of the base.
            let around_m = radius_m * (1.0 - height);
            let point = Point3::new(around_m * angle.cos(), around_m * angle.sin(), (height - 0.5) * length_m);
            let tip = points[CORNERS];
            for k in 0..CORNERS {
                let normal = (points[k] - tip).cross(&(points[(k + 1) % CORNERS] - tip));
                prop_assert!(normal.dot(&(point - tip)) <= 1e-12);
            }
        }

        #[test]
        fn no_text_panics(text in "[*.a-z0-9 \n-]{0,80}") {
            let _ = read("a.scene", &format!("s\n* {text}"));
        }
    }

    #[test]
    fn faults_name_the_line() {
        let cases = [
            (OLD.replace("0.4 0.6", "-0.4 0.6"), "a.scene:5", "above 0 m; found -0.4"),
            (OLD.replace("0.4 0.6", "400 600"), "a.scene:5", "millimetres"),
            (OLD.replace("box", "octree"), "a.scene:4", "\"octree\""),
            (OLD.replace("0.05 0.8", "0.05 nan"), "a.scene:12", "\"nan\""),
            (OLD.replace("0 0 0 1\n1 0", "0 0 0 2\n1 0"), "a.scene:19", "length 2"),
            (OLD.replace("* post", "* table top"), "a.scene:9", "twice"),
            (OLD.replace("* post", "post"), "a.scene:9", "'* NAME'"),
            (
                OLD.replace("1 0 0 1\n.\n", ""),
                "a.scene:20",
                "a colour, four numbers; the file ends",
            ),
        ];
        for (text, line, words) in cases {
            let found = read("a.scene", &text).map(|all| all.len());
            let found = found.map_err(|e| e.to_string()).unwrap_err();
            assert!(found.contains(line) && found.contains(words), "{line} {words}: {found}");
        }
    }
}
