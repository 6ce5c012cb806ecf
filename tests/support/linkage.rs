//! An arm whose forearm a parallel linkage would drive: its description is like that of any other.

/// The description of the arm, by a name.
pub fn urdf(name: &str) -> String {
    let shapes = [
        ("base_link", "0 0 0.15", r#"<cylinder radius="0.15" length="0.3"/>"#),
        ("link_1", "0 0 0.42", r#"<box size="0.24 0.24 0.2"/>"#),
        ("link_2", "0 0 0.28", r#"<box size="0.16 0.14 0.62"/>"#),
        ("link_3", "0 0 0.06", r#"<box size="0.2 0.16 0.2"/>"#),
        ("link_4", "0.37 0 0", r#"<box size="0.5 0.12 0.12"/>"#),
        ("link_5", "0 0 0", r#"<sphere radius="0.055"/>"#),
        ("link_6", "0.11 0 0", r#"<box size="0.06 0.08 0.08"/>"#),
    ];
    // Place of the joint in the link before, axis, largest turn to either side [rad].
    let joints = [
        ("0 0 0", "0 0 1", 2.9),
        ("0.1 0 0.45", "0 1 0", 1.9),
        ("0 0 0.6", "0 1 0", 1.2),
        ("0 0 0.12", "1 0 0", 3.1),
        ("0.68 0 0", "0 1 0", 2.0),
        ("0 0 0", "1 0 0", 6.2),
    ];
    let mut text = format!("<robot name=\"{name}\">\n");
    for (link, at, shape) in shapes {
        text += &format!(
            "<link name=\"{link}\"><collision><origin xyz=\"{at}\"/><geometry>{shape}</geometry></collision></link>\n"
        );
    }
    for (k, (at, axis, most_rad)) in joints.into_iter().enumerate() {
        let [parent, child] = [shapes[k].0, shapes[k + 1].0];
        text += &format!(
            "<joint name=\"joint_{}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"{child}\"/><origin xyz=\"{at}\"/>\
             <axis xyz=\"{axis}\"/><limit lower=\"-{most_rad}\" upper=\"{most_rad}\" velocity=\"2.6\" effort=\"0\"/></joint>\n",
            k + 1
        );
    }
    text + "<link name=\"tool0\"/><joint name=\"flange\" type=\"fixed\"><parent link=\"link_6\"/><child link=\"tool0\"/>\
            <origin xyz=\"0.14 0 0\" rpy=\"0 1.5707963267948966 0\"/></joint>\n</robot>\n"
}
