//! Pairs of links that need no check, found where nobody listed them, as an SRDF.

use super::error::ClearanceError;
use super::pairs::{SAMPLES, exclusions};
use crate::tool::{StraightTool, Tool};
use crate::workcell::{Exclusion, ExclusionReason};
use platewash_kinematics::RobotModel;
use std::fmt::Write;

/// Pairs of links that need no check, as they are left out of an arm without an SRDF.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TouchingPairs {
    /// Those whose links share a joint.
    pub neighbours: Vec<[String; 2]>,
    /// Those of all others that touch in every configuration sampled.
    pub always_touching: Vec<[String; 2]>,
    /// Configurations that were sampled.
    pub samples: usize,
    robot: String,
}

impl TouchingPairs {
    /// Those of an arm, whatever its SRDF lists.
    ///
    /// # Errors
    /// [`ClearanceError`] for a shape that is none.
    pub fn of(robot: &RobotModel) -> Result<Self, ClearanceError> {
        let bare = Tool::from(StraightTool::default());
        let found = exclusions(&robot.clone().without_disabled_pairs(), &bare, &[])?;
        let of = |reason: ExclusionReason| {
            let found = found.iter().filter(move |e: &&Exclusion| e.reason == reason);
            found.map(|e| e.pair.clone()).collect()
        };
        Ok(Self {
            neighbours: of(ExclusionReason::Neighbours),
            always_touching: of(ExclusionReason::AlwaysTouching),
            samples: SAMPLES,
            robot: robot.name().to_owned(),
        })
    }

    /// The list as an SRDF, which says in comments why each pair is in it.
    #[must_use]
    pub fn srdf(&self) -> String {
        let name = escaped(&self.robot);
        let mut text = format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<robot name=\"{name}\">\n");
        let always = format!(
            "touch in each of {} configurations spread over the limits of the joints: look whether the real links may",
            self.samples
        );
        for (pairs, why, reason) in [
            (&self.neighbours, "adjacent: the links share a joint", "Adjacent"),
            (&self.always_touching, &*always, "Default"),
        ] {
            if !pairs.is_empty() {
                // Writing to a String cannot fail.
                let _ = writeln!(text, "  <!-- {why} -->");
            }
            for [a, b] in pairs {
                let [a, b] = [a, b].map(|link| escaped(link));
                let _ = writeln!(
                    text,
                    "  <disable_collisions link1=\"{a}\" link2=\"{b}\" reason=\"{reason}\"/>"
                );
            }
        }
        text + "</robot>\n"
    }
}

/// Text as an attribute of XML has it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::kitchen_tool;
    use crate::workcell::Obstacle;
    use platewash_kinematics::DisabledPairs;

    /// Read back, the list leaves out what was found.
    #[test]
    fn the_srdf_leaves_out_what_was_found() {
        let robot = RobotModel::irb120().unwrap();
        let found = TouchingPairs::of(&robot).unwrap();
        assert_eq!(found.neighbours.len(), 6);
        assert!(
            found
                .always_touching
                .contains(&["link_4".to_owned(), "link_6".to_owned()]),
            "{found:?}"
        );
        let text = found.srdf();
        assert!(
            text.contains("<!-- adjacent") && text.contains("in each of 64 configurations"),
            "{text}"
        );
        let listed = robot
            .clone()
            .with_disabled_pairs(DisabledPairs::parse(&text).unwrap())
            .unwrap();
        let floor = [Obstacle::floor()];
        let pairs = |robot: &RobotModel| -> Vec<_> {
            let left_out = exclusions(robot, &kitchen_tool(), &floor).unwrap();
            left_out.into_iter().map(|e| e.pair).collect()
        };
        assert_eq!(pairs(&listed), pairs(&robot.without_disabled_pairs()));
    }

    #[test]
    fn names_are_written_as_xml_has_them() {
        let pairs = TouchingPairs {
            neighbours: vec![["a<b".to_owned(), "c\"&d".to_owned()]],
            always_touching: Vec::new(),
            samples: 64,
            robot: "r&d".to_owned(),
        };
        let read = DisabledPairs::parse(&pairs.srdf()).unwrap();
        assert!(read.contains("a<b", "c\"&d"));
    }
}
