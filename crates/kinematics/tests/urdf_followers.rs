//! Joints that follow an axis: what they carry is left out by name.

use crate::urdf::load;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{DisabledPairs, JointVector, RobotModel, UrdfError};

fn joint(name: &str, kind: &str, parent: &str, rest: &str) -> String {
    let shape = "<collision><geometry><sphere radius=\"0.05\"/></geometry></collision>";
    format!(
        "<link name=\"{name}_link\">{shape}</link><joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/>\
         <child link=\"{name}_link\"/><origin xyz=\"0 0 0.1\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" velocity=\"0\"/>{rest}</joint>"
    )
}

/// A balancing cylinder: its piston slides in it, a cover is screwed to the piston, and a lever follows the piston's joint.
fn balanced() -> String {
    let more = [
        joint(
            "piston",
            "prismatic",
            "cylinder_link",
            "<mimic joint=\"joint_2\" multiplier=\"0.15\"/>",
        ),
        joint(
            "cylinder",
            "revolute",
            "link_1",
            "<mimic joint=\"joint_2\" multiplier=\"-0.25\"/>",
        ),
        joint("cover", "fixed", "piston_link", ""),
        joint("lever", "continuous", "link_3", "<mimic joint=\"piston\"/>"),
    ];
    with(&more.concat())
}

fn with(more: &str) -> String {
    IRB120_URDF.replace("</robot>", &format!("{more}</robot>"))
}

#[test]
fn what_follows_an_axis_is_left_out_by_name() {
    let [plain, arm] = [IRB120_URDF, &balanced()].map(|text| load(text).unwrap());
    let mut told: Vec<_> = arm.left_out_links().iter().map(ToString::to_string).collect();
    told.sort();
    let expected = [
        "'cover_link' (joint 'piston' follows 'joint_2')",
        "'cylinder_link' (joint 'cylinder' follows 'joint_2')",
        "'lever_link' (joint 'lever' follows 'joint_2')",
        "'piston_link' (joint 'piston' follows 'joint_2')",
    ];
    assert_eq!(told, expected);
    assert_eq!(arm.links(), plain.links());
    let q = JointVector::repeat(0.4);
    assert_eq!(arm.fk(&q), plain.fk(&q));
    assert!(plain.left_out_links().is_empty());
    assert_ne!(arm.sha256(), plain.sha256());
}

/// A follower of a joint that is held still stands where that joint brings it, whatever follows it in turn.
#[test]
fn followers_of_a_joint_held_still_stand_still() {
    let more = [
        joint("left", "prismatic", "tool0", ""),
        joint(
            "tip",
            "revolute",
            "right_link",
            "<mimic joint=\"right\" offset=\"0.1\"/>",
        ),
        joint(
            "right",
            "prismatic",
            "tool0",
            "<mimic joint=\"left\" multiplier=\"-2\"/>",
        ),
        joint(
            "cylinder",
            "revolute",
            "link_1",
            "<mimic joint=\"joint_2\" multiplier=\"-0.25\"/>",
        ),
    ];
    let text = with(&more.concat());
    let hold = |stated: &[(&str, f64)]| {
        let stated = stated.iter().map(|(name, at)| ((*name).to_owned(), *at)).collect();
        RobotModel::from_urdf_with_fixed(&text, &MeshSource::none(), &stated)
    };
    for stated in [
        &[("left", 0.25)][..],
        &[("left", 0.25), ("right", -0.5), ("joint_1", 0.0)],
    ] {
        let arm = hold(stated).unwrap();
        let held: Vec<_> = arm
            .fixed_joints()
            .iter()
            .map(|(name, at)| (name.as_str(), *at))
            .collect();
        assert_eq!(held, [("left", 0.25), ("right", -0.5), ("tip", -0.4)]);
        assert_eq!(arm.left_out_links().len(), 1, "{:?}", arm.left_out_links());
    }
    let error = hold(&[("left", 0.25), ("right", -0.4)]).unwrap_err();
    assert!(matches!(error, UrdfError::FixedFollowerElsewhere { .. }), "{error}");
    assert!(
        error.to_string().contains("'right' is fixed elsewhere than at -0.5"),
        "{error}"
    );
    let error = hold(&[]).unwrap_err().to_string();
    assert!(
        error.contains("joint 'left' is prismatic") && error.contains("--fix left=VALUE"),
        "{error}"
    );
}

#[test]
fn lists_of_pairs_may_name_links_that_are_left_out() {
    let pairs = |link: &str| {
        DisabledPairs::parse(&format!(
            "<robot name=\"irb120\"><disable_collisions link1=\"link_1\" link2=\"{link}\" reason=\"Adjacent\"/></robot>"
        ))
        .unwrap()
    };
    let arm = load(&balanced()).unwrap();
    assert!(arm.clone().with_disabled_pairs(pairs("piston_link")).is_ok());
    assert!(arm.with_disabled_pairs(pairs("piston")).is_err());
}
