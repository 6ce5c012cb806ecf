//! Each element and attribute of a description is used, cannot matter, or is named.

use crate::urdf::{edited, load, with_joint};
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointFriction, JointVector, RobotModel, UrdfError};
use quick_xml::events::Event;
use quick_xml::reader::Reader;

/// An arm that states about everything.
fn detailed(version: &str) -> String {
    with_limits(version, ["-1.5", "1.25", "7", "6"])
}

/// The same with soft limits, acceleration and deceleration.
fn with_limits(version: &str, [lower, upper, acceleration, deceleration]: [&str; 4]) -> String {
    let joint = |k: usize, axis: &str, kind: &str| {
        format!(
            r#"<joint name="j{k}" type="{kind}"><parent link="l{}"/><child link="l{k}"/><origin xyz="0.05 0 0.3" rpy="0.1 0 0.2"/>
  <axis xyz="{axis}"/><limit lower="-2" upper="2.5" velocity="3" effort="40" acceleration="{acceleration}" deceleration="{deceleration}" jerk="90"/>
  <dynamics damping="0.4" friction="0.2"/><calibration rising="0.1" falling="0.2"/>
  <safety_controller soft_lower_limit="{lower}" soft_upper_limit="{upper}" k_position="20" k_velocity="10"/></joint>"#,
            k - 1
        )
    };
    let link = |k: usize| {
        format!(
            r#"<link name="l{k}"><inertial><origin xyz="0 0.01 0.1" rpy="0 0.1 0"/><mass value="2"/>
  <inertia ixx="0.1" ixy="0.001" ixz="0.002" iyy="0.11" iyz="0.003" izz="0.12"/></inertial>
  <visual name="v"><origin xyz="0 0 0.1" rpy="0 0.2 0"/><geometry><sphere radius="0.05"/></geometry>
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/><texture filename="grey.png"/></material></visual>
  <collision name="c"><origin xyz="0 0 0.1" rpy="0.3 0 0"/><geometry><box size="0.05 0.06 0.2"/></geometry></collision>
  <collision><geometry><cylinder radius="0.03" length="0.1"/></geometry></collision></link>"#
        )
    };
    let links: String = (0..=6).map(link).collect();
    let axes = ["0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"];
    let kinds = ["revolute", "revolute", "revolute", "continuous", "revolute", "revolute"];
    let joints: String = (0..6).map(|k| joint(k + 1, axes[k], kinds[k])).collect();
    format!(
        r#"<robot name="detailed" version="{version}" xmlns:xacro="http://ros.org/wiki/xacro">{links}{joints}
<link name="tool0"/><joint name="f" type="fixed"><parent link="l6"/><child link="tool0"/><origin xyz="0 0 0.1"/><axis xyz="0 1 0"/>
  <limit lower="0" upper="0" velocity="1" effort="1"/><dynamics damping="1"/></joint>
<transmission name="t"><type>transmission_interface/SimpleTransmission</type><joint name="j1"/></transmission>
<gazebo reference="l1"><mu1>0.2</mu1></gazebo>
<ros2_control name="r" type="system"><joint name="j1"><command_interface name="position"><param name="min">-1</param>
  <param name="max">1</param></command_interface></joint></ros2_control>
<stiffness joint="j1" value="3000"/></robot>"#
    )
}

/// A plain arm as many packages have them: capsules, no masses, colours of the robot.
fn plain() -> String {
    let mut text =
        r#"<robot name="plain" version="1.2"><material name="blue"><color rgba="0 0 1 1"/></material><link name="base">
  <visual><geometry><capsule radius="0.1" length="0.2"/></geometry><material name="blue"/></visual></link>"#
            .to_owned();
    let mut parent = "base".to_owned();
    for (k, axis) in ["0 0 1", "0 1 0", "0 1 0", "0 0 1", "0 1 0", "0 0 1"]
        .iter()
        .enumerate()
    {
        text += &format!(
            r#"<link name="link{k}"><collision><geometry><capsule radius="0.04" length="0.1"/></geometry></collision></link>
<joint name="axis{k}" type="revolute"><origin xyz="0 0 0.2" quat_xyzw="0 0 0.6 0.8"/><parent link="{parent}"/><child link="link{k}"/>
  <axis xyz="{axis}"/><limit lower="-3" upper="3" velocity="2" effort="0"/></joint>"#
        );
        parent = format!("link{k}");
    }
    text + "</robot>"
}

/// Everything of a model that can matter, in words; not its hash and not what it names as unused.
fn meaning(text: &str) -> Result<String, UrdfError> {
    let model = RobotModel::from_urdf(text, &MeshSource::none())?;
    let poses = [0.3, -0.7].map(|q| model.fk(&JointVector::repeat(q)));
    let frames: Vec<_> = poses
        .iter()
        .flat_map(|poses| model.links().iter().map(|link| poses.pose(&link.frame)))
        .collect();
    Ok(format!(
        "{} {:?} {:?} {:?} {:?} {frames:?} {:?}",
        model.name(),
        model.joints(),
        model.limits(),
        model.friction(),
        model.links(),
        model.visual_findings(),
    ))
}

/// Paths that `docs/urdf.md` says cannot matter.
fn cannot_matter() -> Vec<String> {
    let docs = include_str!("../../../docs/urdf.md");
    let from = docs.find("These cannot matter").unwrap();
    let table = docs[from..]
        .lines()
        .skip_while(|line| !line.starts_with('|'))
        .take_while(|line| line.starts_with('|'));
    let cells = table.filter_map(|row| row.split('|').nth(1).map(str::to_owned));
    cells
        .flat_map(|cell| {
            cell.split('`')
                .skip(1)
                .step_by(2)
                .map(str::to_owned)
                .collect::<Vec<_>>()
        })
        .collect()
}

/// A statement that is left out or changed: the path of its element or attribute, true for one of a fixed joint, its line, and the text.
struct Change {
    path: String,
    of_fixed_joint: bool,
    line: usize,
    statement: String,
    /// The text that is left out; empty for a change.
    removed: String,
    text: String,
}

/// Every element and attribute left out, and every attribute changed, one at a time.
fn changes(text: &str) -> Vec<Change> {
    let (mut reader, mut all) = (Reader::from_str(text), Vec::new());
    let mut open: Vec<(String, usize, bool)> = Vec::new();
    loop {
        let start = usize::try_from(reader.buffer_position()).unwrap();
        let event = reader.read_event().unwrap();
        let end = usize::try_from(reader.buffer_position()).unwrap();
        let line = 1 + text[..end].matches('\n').count();
        let path_of = |open: &[(String, usize, bool)]| {
            let below = open.iter().skip(1).map(|(tag, ..)| tag.as_str());
            below.collect::<Vec<_>>().join("/")
        };
        let mut removed = |open: &[(String, usize, bool)]| {
            let (tag, from, _) = open.last().unwrap();
            if open.len() > 1 {
                let gone = "\n".repeat(text[*from..end].matches('\n').count());
                all.push(Change {
                    path: path_of(open),
                    of_fixed_joint: open[1].2,
                    line: 1 + text[..*from].matches('\n').count(),
                    statement: format!("<{tag}"),
                    removed: text[*from..end].to_owned(),
                    text: format!("{}{gone}{}", &text[..*from], &text[end..]),
                });
            }
        };
        match &event {
            Event::Start(tag) | Event::Empty(tag) => {
                let source = &text[start..end];
                let name = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
                open.push((name, start, source.contains("type=\"fixed\"")));
                if matches!(event, Event::Empty(_)) {
                    removed(&open);
                }
                for attribute in tag.attributes().flatten() {
                    let key = String::from_utf8_lossy(attribute.key.as_ref()).into_owned();
                    let value = String::from_utf8_lossy(&attribute.value).into_owned();
                    let old = format!("{key}=\"{value}\"");
                    let changed = |word: &str| match word.parse::<f64>() {
                        Ok(number) => (number * 0.875 + 0.0625).to_string(),
                        Err(_) => word.to_owned() + "_other",
                    };
                    let words: Vec<_> = value.split(' ').map(changed).collect();
                    for new in [String::new(), format!("{key}=\"{}\"", words.join(" "))] {
                        let path = path_of(&open);
                        all.push(Change {
                            path: format!("{path}{}{key}", if path.is_empty() { "" } else { "/" }),
                            of_fixed_joint: open.get(1).is_some_and(|(.., fixed)| *fixed),
                            line,
                            statement: old.clone(),
                            removed: if new.is_empty() { old.clone() } else { String::new() },
                            text: format!("{}{}{}", &text[..start], source.replacen(&old, &new, 1), &text[end..]),
                        });
                    }
                }
                if matches!(event, Event::Empty(_)) {
                    open.pop();
                }
            }
            Event::End(_) => {
                removed(&open);
                open.pop();
            }
            Event::Eof => return all,
            _ => {}
        }
    }
}

#[test]
fn each_statement_is_used_or_cannot_matter_or_is_named() {
    let known = cannot_matter();
    assert!(
        known.len() >= 11 && known.iter().all(|path| !path.contains(' ')),
        "{known:?}"
    );
    // Of two limits the tighter one counts: each must matter in one of two texts.
    let [soft, hard] = [["-1.5", "1.25", "7", "6"], ["-9", "9", "5", "6"]].map(|limits| with_limits("1.2", limits));
    for texts in [
        vec![IRB120_URDF.to_owned()],
        vec![soft, hard],
        vec![detailed("1.0")],
        vec![plain()],
    ] {
        let mut used = 0;
        let all: Vec<_> = texts.iter().map(|text| changes(text)).collect();
        let before: Vec<_> = texts
            .iter()
            .map(|text| (load(text).unwrap(), meaning(text).unwrap()))
            .collect();
        assert!(all[0].len() > 150, "{}", all[0].len());
        for index in 0..all[0].len() {
            let each = before
                .iter()
                .zip(&all)
                .map(|(before, all)| judged(before, &all[index], &known));
            let each: Vec<_> = each.collect();
            let best = each.iter().max().unwrap();
            let Change {
                path, line, statement, ..
            } = &all[0][index];
            // Version 1.0 is the second one but for limits, which are masked alike.
            let is_masked = texts[0].contains("version=\"1.0\"") && path.starts_with("joint/limit/");
            assert!(
                *best > Use::None || is_masked,
                "{}: line {line}: {path} {statement}",
                &texts[0][..40]
            );
            used += usize::from(*best == Use::Matters);
        }
        assert!(used > 100, "{used}");
    }
}

/// Use of a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Use {
    /// Nothing changes, and nothing is said.
    None,
    /// It cannot matter, is named, or has the value that counts without it.
    Known,
    /// The model changes, or the text is refused.
    Matters,
}

fn judged((model, before): &(RobotModel, String), change: &Change, known: &[String]) -> Use {
    let Change {
        path, line, statement, ..
    } = change;
    let is_within = |known: &String| {
        let of_fixed = [
            "joint/name",
            "joint/axis",
            "joint/limit",
            "joint/dynamics",
            "joint/safety_controller",
            "joint/mimic",
        ];
        (change.of_fixed_joint || !of_fixed.contains(&known.as_str()))
            && (path == known || path.starts_with(&format!("{known}/")))
    };
    let mut unused = model.unused_statements().iter();
    let outermost = format!("<{}>", path.split('/').next().unwrap());
    let is_named = unused
        .any(|unused| unused.statement == outermost || unused.line == *line && unused.statement.starts_with(statement));
    // What is left out may have the value that counts without it.
    let mut numbers = change
        .removed
        .split(['"', ' '])
        .filter_map(|word| word.parse::<f64>().ok());
    let is_zero = !change.removed.is_empty() && numbers.all(|number| number == 0.0);
    let is_default = is_zero || change.removed.contains("\"1 0 0\"");
    // A version that means the same.
    if known.iter().any(is_within) || is_named || is_default || statement.starts_with("xmlns") || path == "version" {
        return Use::Known;
    }
    match meaning(&change.text) {
        Ok(after) if after == *before => Use::None,
        _ => Use::Matters,
    }
}

#[test]
fn accelerations_count_in_any_version_and_the_lesser_of_two() {
    for version in ["1.0", "1.2"] {
        let model = load(&detailed(version)).unwrap();
        assert_eq!(model.limits().acceleration, [Some(6.0); 6], "{version}");
        assert_eq!(model.limits().jerk, [Some(90.0); 6]);
        let least = model
            .limits()
            .within_acceleration(&JointVector::new(4.0, 9.0, 6.0, 5.0, 7.0, 1.0));
        assert_eq!(least, JointVector::new(4.0, 6.0, 6.0, 5.0, 6.0, 1.0));
    }
    let limits = |acceleration: &str| {
        let text = with_joint(
            "joint_2",
            "effort=\"0\"",
            &format!("effort=\"0\" acceleration=\"{acceleration}\""),
        );
        load(&text).map(|model| model.limits().acceleration[1])
    };
    assert_eq!(limits("2.5").unwrap(), Some(2.5));
    assert_eq!(limits("0").unwrap(), None, "unknown, as for torques; it is named");
    assert_eq!(limits("inf").unwrap(), None);
    for wrong in ["-1", "NaN", "fast", ""] {
        let error = limits(wrong).unwrap_err().to_string();
        assert!(
            error.contains("joint 'joint_2'") && error.contains("acceleration"),
            "{error}"
        );
    }
}

#[test]
fn soft_limits_hold_where_they_are_tighter_and_friction_is_kept() {
    let model = load(&detailed("1.0")).unwrap();
    let limits = model.limits();
    for joint in 0..6 {
        assert_eq!(
            [limits.lower[joint], limits.upper[joint]],
            [-1.5, 1.25],
            "joint {joint}, continuous or not"
        );
        assert_eq!(limits.is_soft[joint], [true; 2]);
    }
    let viscous = [0.4; 6];
    assert_eq!(
        *model.friction(),
        JointFriction {
            viscous,
            coulomb: [0.2; 6]
        }
    );
    let wide = "effort=\"0\"/><safety_controller soft_lower_limit=\"-9\" soft_upper_limit=\"9\" k_velocity=\"1\"/>";
    let wide = with_joint("joint_2", "effort=\"0\"/>", wide);
    let [before, after] = [IRB120_URDF, &wide].map(|text| load(text).unwrap().limits().clone());
    assert_eq!(before, after);
    for (damping, words) in [("-1", "not negative"), ("inf", "finite")] {
        let text = detailed("1.0").replace("damping=\"0.4\"", &format!("damping=\"{damping}\""));
        let error = load(&text).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("joint 'j1'"), "{error}");
    }
}

#[test]
fn statements_are_named_with_place_and_line() {
    let named = |text: &str| {
        load(text)
            .unwrap()
            .unused_statements()
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
    };
    assert_eq!(named(IRB120_URDF), [""; 0]);
    let all = named(&detailed("1.2"));
    for words in [
        "joint 'j1', limit: jerk=\"90\" (line ",
        "joint 'j4', limit: lower=\"-2\" (line ",
        "<stiffness> (line ",
        "ros2_control 'r', joint, command_interface: <param name=\"min\"> (line ",
    ] {
        assert!(all.iter().any(|line| line.starts_with(words)), "{words}: {all:?}");
    }
    // A turn by a quaternion counts from version 1.1 on only.
    let old = plain().replace(" version=\"1.2\"", "").replace("capsule", "cylinder");
    assert!(
        named(&old)
            .iter()
            .any(|line| line.contains("quat_xyzw=\"0 0 0.6 0.8\"")),
        "{:?}",
        named(&old)
    );
    assert_eq!(named(&plain()), [""; 0]);
    let text = edited(&[("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 1\"/> see the manual")]);
    assert!(
        named(&text)[0].starts_with("joint 'joint_1': the text \"see the manual\""),
        "{:?}",
        named(&text)
    );
}

/// Every element emptied, left out or unknown, and every attribute left out, emptied or a word, one at a time.
fn broken(text: &str) -> Vec<String> {
    let mut all: Vec<_> = changes(text).into_iter().map(|change| change.text).collect();
    for (at, _) in text.match_indices("=\"") {
        let end = at + 2 + text[at + 2..].find('"').unwrap();
        all.extend(["", "x", "1 2 x", "nan"].map(|value| format!("{}{value}{}", &text[..at + 2], &text[end..])));
    }
    for (at, _) in text.match_indices('<') {
        let Some(name) = text[at + 1..]
            .split([' ', '>', '/'])
            .next()
            .filter(|name| name.starts_with(char::is_alphabetic))
        else {
            continue;
        };
        let end = at + text[at..].find('>').unwrap();
        let is_empty = text[..end].ends_with('/');
        if is_empty {
            all.push(format!("{}<unheard_of/>{}", &text[..at], &text[end + 1..]));
        } else {
            let close = format!("</{name}>");
            let close_at = end + text[end..].find(&close).unwrap();
            all.push(format!("{}<{name}>{}", &text[..at], &text[close_at..]));
        }
    }
    all
}

#[test]
fn no_message_shows_the_insides_of_a_parser() {
    let mut messages = std::collections::BTreeSet::new();
    for text in [IRB120_URDF.to_owned(), detailed("1.2"), plain()] {
        messages.extend(
            broken(&text)
                .iter()
                .filter_map(|text| load(text).err())
                .map(|error| error.to_string()),
        );
    }
    assert!(messages.len() > 300, "{}", messages.len());
    let insides = [
        "XmlEvent",
        "token",
        "serial",
        "::",
        "Some(",
        "ustom",
        "invalid type",
        "struct",
        "variant",
        "Vec",
        "Wrong",
        "cannot parse",
    ];
    let shown = messages
        .iter()
        .find(|message| insides.iter().any(|word| message.contains(word)));
    assert_eq!(shown, None);
}
