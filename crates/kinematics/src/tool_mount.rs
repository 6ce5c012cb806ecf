//! Where an arm carries its tool: a link behind joint 6 and the axis of that link along which the tool leaves it, stated or found.
//!
//! The names follow REP-199: z of `tool0` and x of `flange` leave the arm. Other names, and a last link without any, count where an axis of
//! the link lies along axis 6 and leads away from axis 5. Where the description allows two answers, there is none: the user is asked.

use crate::geometry::Shape;
use crate::joints::AXES;
use crate::model::{Frame, Link, RobotModel};
use crate::rotation::Pose;
use crate::rotation::RigidTransform;
use crate::tool_frame::{ToolFrame, ToolFrameError};
use crate::trig::cos;
use nalgebra::{Matrix3, Vector3};
use std::fmt;

/// Axis of a link's frame, either way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkAxis {
    /// +x.
    X,
    /// −x.
    MinusX,
    /// +y.
    Y,
    /// −y.
    MinusY,
    /// +z.
    Z,
    /// −z.
    MinusZ,
}

impl LinkAxis {
    /// All axes with their names in files and on the command line.
    const NAMES: [(Self, &str); 6] = [
        (Self::Z, "z"),
        (Self::MinusZ, "-z"),
        (Self::X, "x"),
        (Self::MinusX, "-x"),
        (Self::Y, "y"),
        (Self::MinusY, "-y"),
    ];

    /// Returns the name in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        let found = Self::NAMES.iter().find(|(axis, _)| *axis == self);
        found.map_or("z", |(_, name)| name)
    }

    /// Returns the axis of a link's frame for which a condition holds, if there is one.
    fn find(is: impl Fn(Self) -> bool) -> Option<Self> {
        Self::NAMES.into_iter().map(|(axis, _)| axis).find(|axis| is(*axis))
    }

    /// Rotation from the mounting frame, whose z axis this is, to the link: about y for ±x, about x for the others.
    fn turn(self) -> Matrix3<f64> {
        let columns = match self {
            Self::Z => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Self::MinusZ => [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]],
            Self::X => [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
            Self::MinusX => [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
            Self::Y => [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
            Self::MinusY => [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]],
        };
        Matrix3::from_columns(&columns.map(Vector3::from))
    }
}

impl fmt::Display for LinkAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Link that carries a tool, and its axis along which the tool leaves it. As text it is `LINK` for z, or `LINK:AXIS`: `flange:x`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ToolMount<'a> {
    /// Link behind joint 6.
    pub link: &'a str,
    /// Axis of the link.
    pub axis: LinkAxis,
}

impl<'a> ToolMount<'a> {
    /// Returns the mount of a text.
    #[must_use]
    pub fn from_text(text: &'a str) -> Self {
        let stated = text.rsplit_once(':').and_then(|(link, name)| {
            let axis = LinkAxis::find(|axis| axis.name() == name)?;
            Some(Self { link, axis })
        });
        stated.unwrap_or(Self {
            link: text,
            axis: LinkAxis::Z,
        })
    }
}

impl fmt::Display for ToolMount<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.axis {
            LinkAxis::Z => f.write_str(self.link),
            axis => write!(f, "{}:{axis}", self.link),
        }
    }
}

/// Greatest angle between axes that count as one \[rad\].
const ALIGNED_RAD: f64 = 0.01;
/// Greatest distance of mounting points that count as one \[m\].
const SAME_PLACE_M: f64 = 1e-6;
/// Least distance from axis 5, along axis 6, that tells which way leads out \[m\].
const OUT_M: f64 = 1e-3;
/// Greatest distance of a last link's origin from the end of its shape at which it counts as the flange \[m\].
const FACE_M: f64 = 2e-3;

/// Names of frames for a tool, without a prefix, beside `tool0` and `flange`.
const OTHER_NAMES: [&str; 11] = [
    "ee_link",
    "end_effector_link",
    "end_effector",
    "link_eef",
    "eef_link",
    "eef",
    "ee",
    "tool_frame",
    "tool_link",
    "tool",
    "tcp",
];

/// True if a link has this name, alone or behind a prefix such as `left_`.
fn is_named(link: &Link, name: &str) -> bool {
    let prefix = link.name.strip_suffix(name);
    prefix.is_some_and(|prefix| prefix.is_empty() || prefix.ends_with(['_', '-', '/']))
}

impl RobotModel {
    /// Returns the frame that carries a tool, z along the stated axis of the link. The text is that of a [`ToolMount`]; `None` stands for
    /// `tool0`.
    ///
    /// # Errors
    /// [`ToolFrameError::NoMount`] for a link that is not behind joint 6, and for `None` if the description has no `tool0`.
    pub fn tool_mount(&self, mounted_on: Option<&str>) -> Result<Frame, ToolFrameError> {
        let ToolMount { link, axis } = ToolMount::from_text(mounted_on.unwrap_or(ToolFrame::Tool0.name()));
        let found = self
            .behind_joint_6(link)
            .ok_or_else(|| self.no_mount(format!("has no link '{}' behind joint 6", link.escape_debug())))?;
        // Unchanged to the bit where there is no turn.
        Ok(match axis {
            LinkAxis::Z => found.frame,
            _ => found.frame.offset(&RigidTransform {
                rotation: axis.turn(),
                translation: Vector3::zeros(),
            }),
        })
    }

    /// Returns the link that carries a tool, by the names and shapes of the description: `tool0` (z), a link named `tool0` behind a prefix,
    /// `flange` (x), a link with another usual name, or the last link. The z axis of a `tool0` must lie along axis 6. See the
    /// [module](self) text.
    ///
    /// # Errors
    /// [`ToolFrameError::NoMount`] where there is no such link, or more than one answer.
    pub fn find_tool_mount(&self) -> Result<ToolMount<'_>, ToolFrameError> {
        let tool0 = ToolFrame::Tool0.name();
        if let Some(link) = self.behind_joint_6(tool0) {
            return self.one_of(&[link], Some(LinkAxis::Z));
        }
        let groups: [(&[&str], Option<LinkAxis>); 3] = [
            (&[tool0], Some(LinkAxis::Z)),
            (&["flange"], Some(LinkAxis::X)),
            (&OTHER_NAMES, None),
        ];
        for (names, by_name) in groups {
            let links: Vec<_> = self
                .links_behind_joint_6()
                .filter(|link| names.iter().any(|name| is_named(link, name)))
                .collect();
            if !links.is_empty() {
                return self.one_of(&links, by_name);
            }
        }
        self.last_link_as_mount()
    }

    /// Returns the only answer among links of one kind of name.
    fn one_of<'a>(&'a self, links: &[&'a Link], by_name: Option<LinkAxis>) -> Result<ToolMount<'a>, ToolFrameError> {
        let mut mounts = Vec::new();
        for link in links {
            let found = self.outward_axis(link);
            let along_6 = |axis: &LinkAxis| along(link, *axis).z.abs() >= cos(ALIGNED_RAD);
            let axis = match (by_name.filter(along_6), found) {
                (None, _) if by_name == Some(LinkAxis::Z) => {
                    let off = link.frame.tilt_rad().to_degrees();
                    return Err(self.no_mount(format!(
                        "has a link '{}' whose z axis is {off:.1}° from axis 6, so that it is not the tool0 of a controller",
                        link.name
                    )));
                }
                (Some(by_name), Some(found)) if by_name != found => {
                    let reason = format!(
                        "has a link '{}' whose {by_name} axis should leave the arm by its name, but {found} leads away from axis 5",
                        link.name
                    );
                    return Err(self.no_mount(reason));
                }
                (Some(axis), _) | (None, Some(axis)) => axis,
                (None, None) => {
                    let reason = format!("has a link '{}' without an axis that leads out along axis 6", link.name);
                    return Err(self.no_mount(reason));
                }
            };
            mounts.push((*link, axis));
        }
        let (first, axis) = mounts[0];
        let place = |link: &Link| link.frame.on_body().translation;
        let differs = mounts
            .iter()
            .find(|(link, _)| (place(link) - place(first)).norm() > SAME_PLACE_M);
        match differs {
            Some((other, _)) => Err(self.no_mount(format!(
                "has the links '{}' and '{}' at different places, and either could carry the tool",
                first.name, other.name
            ))),
            None => Ok(ToolMount {
                link: &first.name,
                axis,
            }),
        }
    }

    /// Returns the link behind joint 6 whose origin is where its shape ends.
    fn last_link_as_mount(&self) -> Result<ToolMount<'_>, ToolFrameError> {
        let refused = |why: String| {
            self.no_mount(format!(
                "has no link with a usual name for a tool behind joint 6, and {why}"
            ))
        };
        let link = self.links_behind_joint_6().next();
        let Some((link, axis)) = link.and_then(|link| Some((link, self.outward_axis(link)?))) else {
            return Err(refused("no axis of its last link leads out along axis 6".to_owned()));
        };
        let name = &link.name;
        let Some([low, high]) = self.extent_along_6() else {
            return Err(refused(format!("no shape that tells where link '{name}' ends")));
        };
        let sense = along(link, axis).z.signum();
        let end_m = if sense > 0.0 { high } else { -low };
        let beyond_m = end_m - sense * link.frame.on_body().translation.z;
        if beyond_m.abs() > FACE_M {
            let beyond_mm = 1e3 * beyond_m;
            return Err(refused(format!(
                "the shape of link '{name}' ends {beyond_mm:.1} mm from its origin"
            )));
        }
        Ok(ToolMount { link: name, axis })
    }

    /// Returns the axis of a link behind joint 6 that lies along axis 6 and leads away from axis 5, if one does.
    #[must_use]
    pub fn outward_axis(&self, link: &Link) -> Option<LinkAxis> {
        let out = self.outward_sense()?;
        LinkAxis::find(|axis| out * along(link, axis).z >= cos(ALIGNED_RAD))
    }

    /// True if the z axis of a frame behind joint 6 lies along axis 6 and leads away from axis 5, false if not; `None` where the description does
    /// not tell which way is away.
    #[must_use]
    pub fn leads_out(&self, frame: &Frame) -> Option<bool> {
        let z = frame.on_body().rotation.column(2).z;
        if z.abs() < cos(ALIGNED_RAD) {
            return Some(false);
        }
        self.outward_sense().map(|out| out * z > 0.0)
    }

    /// Returns +1 where axis 6 leads out of the arm, −1 where it leads in: by the origins of the links behind joint 6 and by their shapes,
    /// seen from axis 5. `None` where these do not tell, or not the same.
    fn outward_sense(&self) -> Option<f64> {
        let foot = self.foot_of_axis_5()?;
        let mut senses = self
            .links_behind_joint_6()
            .map(|link| link.frame.on_body().translation.z - foot)
            .filter(|along| along.abs() > OUT_M)
            .map(f64::signum);
        let by_origins = senses.next().filter(|first| senses.all(|sense| sense == *first));
        let by_shapes = self.extent_along_6().and_then(|[low, high]| {
            let more = (high - foot) - (foot - low);
            (more.abs() > OUT_M).then_some(more.signum())
        });
        match (by_origins, by_shapes) {
            (Some(origin), Some(shape)) if origin != shape => None,
            (origin, shape) => origin.or(shape),
        }
    }

    /// Place on axis 6 that is nearest to axis 5, along axis 6 from the origin of body 6 \[m\]; `None` if the axes are parallel.
    fn foot_of_axis_5(&self) -> Option<f64> {
        // Body 5 in body 6's frame at q₆ = 0: turning joint 6 does not move the foot.
        let fifth = self.folded()[AXES - 1].inverse();
        let (point, direction) = (fifth.translation, fifth.rotation.column(2).into_owned());
        let across = 1.0 - direction.z * direction.z;
        (across > 1e-6).then(|| (point.z - direction.z * direction.dot(&point)) / across)
    }

    /// Range of the collision shapes behind joint 6 along axis 6, from the origin of body 6 \[m\].
    fn extent_along_6(&self) -> Option<[f64; 2]> {
        let shapes = self.links_behind_joint_6().flat_map(|link| {
            let on_body = Pose::from(link.frame.on_body());
            link.collision
                .iter()
                .map(move |primitive| (on_body * primitive.pose, &primitive.shape))
        });
        let reach = |pose: &Pose, shape: &Shape, way: Vector3<f64>| {
            pose.translation.vector.dot(&way) + shape.support(&pose.inverse_transform_vector(&way))
        };
        let ranges =
            shapes.map(|(pose, shape)| [-reach(&pose, shape, -Vector3::z()), reach(&pose, shape, Vector3::z())]);
        ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }

    fn no_mount(&self, reason: String) -> ToolFrameError {
        let named = self.links_behind_joint_6().map(|link| match self.outward_axis(link) {
            Some(axis) => format!("'{}' ({axis} leads out)", link.name),
            None => match LinkAxis::find(|axis| along(link, axis).z >= cos(ALIGNED_RAD)) {
                Some(axis) => format!("'{}' ({axis} along axis 6)", link.name),
                None => format!(
                    "'{}' (z is {:.1}° from axis 6)",
                    link.name,
                    link.frame.tilt_rad().to_degrees()
                ),
            },
        });
        ToolFrameError::NoMount {
            robot: self.name().to_owned(),
            reason,
            candidates: named.collect::<Vec<_>>().join(", "),
        }
    }
}

/// Direction of a link's axis in the frame of body 6, whose z axis is axis 6.
fn along(link: &Link, axis: LinkAxis) -> Vector3<f64> {
    link.frame.on_body().rotation * axis.turn().column(2)
}
