//! Frame from which an arm's controller counts Cartesian coordinates.
//!
//! ROS names it (REP-199): the link `base`. In many descriptions it lies apart from the root link, at the height of axis 2 or turned by half
//! a turn. Where there is no link `base`, the first link of the arm, `base_link`, stands for it; without either, the root link.

use crate::model::{Link, RobotModel};
use crate::rotation::Pose;
use crate::words::nonzero_decimals;
use std::fmt;

/// Largest distance \[m\] and turn \[rad\] of two frames that count as one.
const SAME: f64 = 1e-9;

/// Link from which the controller counts, where its frame is not that of the root link.
#[derive(Debug, Clone, PartialEq)]
pub struct ControllerBase<'a> {
    /// Name of the link.
    pub link: &'a str,
    /// Name of the root link.
    pub root: &'a str,
    /// `T_root_link`.
    pub pose: Pose,
}

impl RobotModel {
    /// Returns the link from which the controller counts, by its name; `None` where its frame is that of the root link. Names may have a
    /// prefix, as in `left_base` beside `left_base_link`.
    #[must_use]
    pub fn controller_base(&self) -> Option<ControllerBase<'_>> {
        let [root, ..] = self.links() else { return None };
        let fixed = || self.links().iter().filter(|link| link.frame.body() == 0);
        let named = |name: &str| fixed().find(|link| link.name == name);
        let is_prefixed = |link: &&Link| {
            let prefix = link.name.strip_suffix("base");
            prefix.is_some_and(|prefix| named(&format!("{prefix}base_link")).is_some())
        };
        let carrier = self.joints()[0].parent.as_str();
        let first = || named("base_link").or_else(|| named(carrier).filter(|link| link.name.ends_with("base_link")));
        let link = named("base").or_else(|| fixed().find(is_prefixed)).or_else(first)?;
        let pose = Pose::from(link.frame.on_body());
        let is_apart = pose.translation.vector.norm() > SAME || pose.rotation.angle() > SAME;
        is_apart.then_some(ControllerBase {
            link: &link.name,
            root: &root.name,
            pose,
        })
    }
}

impl fmt::Display for ControllerBase<'_> {
    /// Names the link and its place at the root link: "link 'base', 450.0 mm above link 'base_link'".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { link, root, pose } = self;
        let all = |numbers: [f64; 3]| {
            numbers
                .map(|v| {
                    if v == 0.0 {
                        "0".to_owned()
                    } else {
                        nonzero_decimals(v, 1)
                    }
                })
                .join(", ")
        };
        let at = pose.translation.vector;
        write!(f, "link '{link}', ")?;
        if at.xy().norm() <= SAME && at.z.abs() > SAME {
            let way = if at.z > 0.0 { "above" } else { "below" };
            write!(f, "{} mm {way} ", nonzero_decimals(1e3 * at.z.abs(), 1))?;
        } else if at.norm() > SAME {
            write!(f, "at ({}) mm of ", all((1e3 * at).into()))?;
        } else {
            f.write_str("at the place of ")?;
        }
        write!(f, "link '{root}'")?;
        if pose.rotation.angle() > SAME {
            let (roll, pitch, yaw) = pose.rotation.euler_angles();
            let turned = all([roll, pitch, yaw].map(f64::to_degrees));
            write!(f, ", turned by roll, pitch, yaw = ({turned})°")?;
        }
        Ok(())
    }
}
