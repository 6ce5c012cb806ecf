//! The IRB 120's URDF, edited.

use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{RobotModel, UrdfError};

/// The IRB 120's URDF with every edit (old, new) applied to the first place that fits; each must fit.
pub fn edited(edits: &[(&str, &str)]) -> String {
    edits.iter().fold(IRB120_URDF.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "nothing to edit: {old}");
        let after = text.replacen(old, new, 1);
        assert_ne!(after, text, "the edit changes nothing: {old}");
        after
    })
}

/// One joint of the file, from `<joint name="NAME"` to `</joint>`.
pub fn joint(name: &str) -> &'static str {
    between(&format!("<joint name=\"{name}\""), "</joint>")
}

/// One link with content, from `<link name="NAME">` to `</link>`.
pub fn link(name: &str) -> &'static str {
    between(&format!("<link name=\"{name}\">"), "</link>")
}

fn between(start: &str, end: &str) -> &'static str {
    let from = IRB120_URDF.find(start).expect(start);
    let length = IRB120_URDF[from..].find(end).expect(end) + end.len();
    &IRB120_URDF[from..from + length]
}

/// The file with one joint changed by (old, new).
pub fn with_joint(name: &str, old: &str, new: &str) -> String {
    let before = joint(name);
    assert!(before.contains(old), "joint {name} has no {old}");
    edited(&[(before, &before.replacen(old, new, 1))])
}

/// Reads a text that names no mesh.
pub fn load(text: &str) -> Result<RobotModel, UrdfError> {
    RobotModel::from_urdf(text, &MeshSource::none())
}
