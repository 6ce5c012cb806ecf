use platewash::cli::alignment::*;

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{Pose, RobotModel};
use proptest::prelude::*;

/// Corners and a stud of a table, drawn \[m\].
const TABLE: [[f64; 3]; 5] = [
    [0.2, -0.3, 0.0],
    [0.7, -0.3, 0.0],
    [0.7, 0.4, 0.0],
    [0.25, 0.35, 0.0],
    [0.5, 0.0, 0.06],
];

/// What a pendant shows of drawn points, of an arm that stands at `mount`.
fn touched(mount: &Pose, drawn: &[[f64; 3]]) -> Vec<Touch> {
    let touch = |p: &[f64; 3]| Touch {
        drawn_m: *p,
        touched_m: mount.inverse_transform_point(&(*p).into()).coords.into(),
    };
    drawn.iter().map(touch).collect()
}

fn mount(axis: [f64; 3], turn_rad: f64, place: [f64; 3], yaw_rad: f64) -> Pose {
    let tilt = UnitQuaternion::from_scaled_axis(Vector3::from(axis) * turn_rad);
    let yaw = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw_rad);
    Pose::from_parts(Vector3::from(place).into(), yaw * tilt)
}

proptest! {
    /// Exact points give the exact pose, a rotation, whatever the pose short of upside down.
    #[test]
    fn exact_points_recover_the_mount(
        axis in prop::array::uniform3(-1.0..1.0f64),
        turn in 0.0..0.8f64,
        place in prop::array::uniform3(-2.0..2.0f64),
        yaw in -3.1..3.1f64,
        count in 3..=5usize,
    ) {
        let mount = mount(axis, turn, place, yaw);
        let found = align(&touched(&mount, &TABLE[..count])).unwrap();
        prop_assert!((found.mount.translation.vector - mount.translation.vector).norm() < 1e-9);
        prop_assert!(found.mount.rotation.angle_to(&mount.rotation) < 1e-7);
        prop_assert!(found.rms_m < 1e-12 && found.worst().1 < 1e-12, "{}", found.rms_m);
        let matrix = found.mount.rotation.to_rotation_matrix();
        prop_assert!((matrix.matrix().determinant() - 1.0).abs() < 1e-12);
        for p in TABLE {
            let there = Vector3::from(found.in_base(p));
            let exact = mount.inverse_transform_point(&p.into()).coords;
            prop_assert!((there - exact).norm() < 1e-9);
        }
    }

    /// The pendant counts from a link `base` anywhere at the root link; the mount of the root link is found all the same.
    #[test]
    fn points_touched_from_another_link_give_the_mount_of_the_root_link(
        axis in prop::array::uniform3(-1.0..1.0f64),
        turn in 0.0..0.5f64,
        place in prop::array::uniform3(-2.0..2.0f64),
        yaw in -3.1..3.1f64,
        at in prop::array::uniform3(-0.8..0.8f64),
        roll in -0.2..0.2f64,
        half_turn in any::<bool>(),
    ) {
        let [x, y, z] = at;
        let base_yaw = if half_turn { std::f64::consts::PI } else { 0.1 };
        let old = "<child link=\"base\"/>\n    <origin xyz=\"0 0 0\"/>";
        let new = format!("<child link=\"base\"/>\n    <origin xyz=\"{x} {y} {z}\" rpy=\"{roll} 0 {base_yaw}\"/>");
        let text = IRB120_URDF.replace(old, &new);
        prop_assert!(text != IRB120_URDF);
        let arm = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
        // By hand, without the code that reads the description.
        let base = Pose::from_parts(Vector3::from(at).into(), UnitQuaternion::from_euler_angles(roll, 0.0, base_yaw));
        let root = mount(axis, turn, place, yaw);
        let found = align(&touched(&(root * base), &TABLE)).unwrap().of_root(&arm);
        prop_assert!((found.mount.translation.vector - root.translation.vector).norm() < 1e-7);
        prop_assert!(found.mount.rotation.angle_to(&root.rotation) < 1e-7);
        prop_assert!(found.worst().1 < 1e-12);
    }

    /// No pose nearby fits noisy points better: least squares.
    #[test]
    fn noisy_points_give_the_pose_that_fits_best(
        noise in prop::array::uniform5(prop::array::uniform3(-5e-4..5e-4f64)),
        yaw in -3.1..3.1f64,
        nudge in prop::array::uniform6(-1.0..1.0f64),
    ) {
        let mount = mount([1.0, 0.0, 0.0], 0.01, [0.1, -0.2, 0.03], yaw);
        let mut touches = touched(&mount, &TABLE);
        for (touch, noise) in touches.iter_mut().zip(noise) {
            for (coordinate, off) in touch.touched_m.iter_mut().zip(noise) {
                *coordinate += off;
            }
        }
        let found = align(&touches).unwrap();
        prop_assert!(found.rms_m < 1e-3);
        let rms = |pose: &Pose| {
            let off = |t: &Touch| Vector3::from(t.drawn_m) - pose.transform_point(&t.touched_m.into()).coords;
            (touches.iter().map(|t| off(t).norm_squared()).sum::<f64>() / touches.len() as f64).sqrt()
        };
        prop_assert!((rms(&found.mount) - found.rms_m).abs() < 1e-9);
        let [x, y, z, a, b, c] = nudge;
        let step = Pose::from_parts(
            (Vector3::new(x, y, z) * 1e-4).into(),
            UnitQuaternion::from_scaled_axis(Vector3::new(a, b, c) * 1e-4),
        );
        prop_assert!(rms(&(found.mount * step)) >= found.rms_m - 1e-12);
        prop_assert!(rms(&(step * found.mount)) >= found.rms_m - 1e-12);
        // The residuals of a best fit cancel.
        let sum: Vector3<f64> = found.residuals_m.iter().map(|r| Vector3::from(*r)).sum();
        prop_assert!(sum.norm() < 1e-9);
    }

    /// Whatever stands in a text, it is read or refused.
    #[test]
    fn any_text_is_printed_without_panic(text in "(x_m|y_m|z_m|touched_x_mm|name|,|\n|#|-?[0-9]{1,3}(\\.[0-9]{1,3})?|nan|1e999|\u{feff}|é){0,40}") {
        let _ = touched_points(&text);
        let _ = drawn_points(&text);
    }
}

fn level() -> Vec<Touch> {
    touched(&mount([0.0; 3], 0.0, [0.1, 0.2, 0.0], 0.4), &TABLE)
}

#[test]
fn states_the_tilt_of_the_table() {
    let tilted = mount([0.0, 1.0, 0.0], 0.02, [0.0; 3], 0.0);
    let found = align(&touched(&tilted, &TABLE[..3])).unwrap();
    assert!((found.tilt_rad() - 0.02).abs() < 1e-9, "{}", found.tilt_rad());
    assert!((found.stretch - 1.0).abs() < 1e-12);
    let [along, beside] = found.spread_m;
    assert!(along > beside && beside > 0.1, "{along} {beside}");
}

#[test]
fn rejects_points_that_do_not_fix_a_pose() {
    let mut touches = level();
    for count in 0..3 {
        let error = align(&touches[..count]).unwrap_err();
        assert!(
            matches!(error, AlignError::Count { found, .. } if found == count),
            "{error}"
        );
    }
    touches[1] = touches[0];
    let error = align(&touches).unwrap_err();
    assert!(
        matches!(error, AlignError::Coincident { points: [0, 1], .. }),
        "{error}"
    );
    let straight = [[0.0, 0.0, 0.0], [0.3, 0.3, 0.0], [0.7, 0.701, 0.0]];
    let error = align(&touched(&Pose::identity(), &straight)).unwrap_err();
    assert!(matches!(error, AlignError::InLine { how: "drawn", .. }), "{error}");
    assert!(error.to_string().contains("touch one at least"), "{error}");
    for bad in [f64::NAN, f64::INFINITY, 1e9] {
        let mut touches = level();
        touches[2].touched_m[1] = bad;
        let error = align(&touches).unwrap_err();
        assert!(matches!(error, AlignError::Coordinate { point: 2, .. }), "{error}");
    }
    // Touched in line, although drawn apart.
    let mut touches = level();
    for (k, touch) in touches.iter_mut().enumerate() {
        touch.touched_m = [0.1 * k as f64, 0.0, 0.0];
    }
    let error = align(&touches).unwrap_err();
    assert!(matches!(error, AlignError::InLine { how: "touched", .. }), "{error}");
}

#[test]
fn names_a_mistake_of_units() {
    let mut touches = level();
    touches.iter_mut().for_each(|t| t.drawn_m = t.drawn_m.map(|c| 1e3 * c));
    let error = align(&touches).unwrap_err();
    assert!(
        matches!(
            error,
            AlignError::Units {
                which: "drawn",
                found: "millimetres",
                expected: "metres",
                ..
            }
        ),
        "{error}"
    );
    let mut touches = level();
    touches
        .iter_mut()
        .for_each(|t| t.touched_m = t.touched_m.map(|c| 1e-3 * c));
    let error = align(&touches).unwrap_err();
    assert!(
        matches!(
            error,
            AlignError::Units {
                which: "touched",
                found: "metres",
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn a_mirrored_drawing_is_refused() {
    // With a point off the plane only a mirror fits; in the plane the table would hang upside down.
    let mirrored = |touches: Vec<Touch>| {
        let flip = |t: Touch| Touch {
            drawn_m: [t.drawn_m[0], -t.drawn_m[1], t.drawn_m[2]],
            ..t
        };
        align(&touches.into_iter().map(flip).collect::<Vec<_>>()).unwrap_err()
    };
    assert!(
        matches!(mirrored(level()), AlignError::Mirrored { .. }),
        "{}",
        mirrored(level())
    );
    let flat = mirrored(level()[..4].to_vec());
    assert!(
        matches!(flat, AlignError::UpsideDown { tilt_deg } if tilt_deg > 179.0),
        "{flat}"
    );
}

#[test]
fn finds_points_touched_in_another_order() {
    let mut touches = level();
    let exact = touches.clone();
    assert_eq!(fitting_order(&touches, 1e-3), None, "they fit as they are");
    let was: Vec<_> = exact.iter().map(|t| t.touched_m).collect();
    let order = [2, 0, 1, 4, 3];
    for (k, touch) in touches.iter_mut().enumerate() {
        touch.touched_m = was[order[k]];
    }
    let found = fitting_order(&touches, 1e-3).unwrap();
    for (k, at) in found.iter().enumerate() {
        assert_eq!(touches[*at].touched_m, was[k]);
    }
    assert!(align(&touches).map_or(true, |bad| bad.rms_m > 0.05));
    let many: Vec<_> = (0..7).map(|k| exact[k % 5]).collect();
    assert_eq!(fitting_order(&many, 1e-3), None);
}

#[test]
fn a_table_is_read_in_any_order_of_its_columns() {
    let text = "\u{feff}# touched on Monday\n\nname, z_m,y_m,x_m,touched_x_mm,touched_y_mm,touched_z_mm\r\nleft, 0.0,-0.3,0.2,300,-1.5e2,0 # with the tip\r\n";
    let [point] = &touched_points(text).unwrap()[..] else {
        panic!("one point");
    };
    assert_eq!((point.line, point.name.as_deref()), (4, Some("left")));
    assert_eq!(point.touch.drawn_m, [0.2, -0.3, 0.0]);
    for (found, expected) in point.touch.touched_m.iter().zip([0.3, -0.15, 0.0]) {
        assert!((found - expected).abs() < 1e-15);
    }
    let [point] = &drawn_points("x_m,y_m,z_m\n1,2,3\n").unwrap()[..] else {
        panic!("one point");
    };
    assert_eq!((point.drawn_m, point.name.as_ref()), ([1.0, 2.0, 3.0], None));
}

#[test]
fn rejects_an_invalid_table_with_its_line() {
    let header = "x_m,y_m,z_m,touched_x_mm,touched_y_mm,touched_z_mm\n";
    let says = |text: &str, words: &[&str]| {
        let said = touched_points(text).unwrap_err().to_string();
        for word in words {
            assert!(said.contains(word), "no '{word}' in: {said}");
        }
    };
    says("", &["line 1", "it is empty", "touched_x_mm"]);
    says("# nothing\n\n", &["it is empty"]);
    says(header, &["line 1", "no rows"]);
    says("x_m,y_m,z_m\n", &["\"touched_x_mm\" is missing"]);
    says(
        "x_mm,y_m,z_m\n",
        &["line 1", "\"x_mm\" is unknown", "expected the header"],
    );
    says(&format!("x_m,{header}"), &["\"x_m\" is there twice"]);
    says(
        &format!("{header}1,2,3,4,5\n"),
        &["line 2: found 5 columns; expected 6"],
    );
    says(
        &format!("{header}1,2,3,4,5,6\n\n1,2,,4,5,6\n"),
        &["line 4, column 3 (z_m)", "found \"\""],
    );
    for bad in ["nan", "inf", "1e999", "0.5m", "\u{1b}[31m"] {
        says(
            &format!("{header}{bad},2,3,4,5,6\n"),
            &["line 2, column 1 (x_m)", "expected a number from"],
        );
    }
    let many = format!("{header}{}", "1,2,3,4,5,6\n".repeat(10_001));
    says(&many, &["line 10002: it has more than 10000 rows"]);
}

#[test]
fn a_half_turn_about_the_vertical_is_a_mount_like_any_other() {
    let behind = Pose::from_parts(
        Vector3::new(1.0, 0.0, 0.0).into(),
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI)),
    );
    let found = align(&touched(&behind, &TABLE[..3])).unwrap();
    assert!(found.mount.rotation.angle_to(&behind.rotation) < 1e-7);
}
