//! Input that makes no sense, and arms of other kinds.

use super::*;
use platewash_kinematics::model::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;

#[test]
fn numbers_that_make_no_sense_are_refused_by_name() {
    let plates = [plate_at(0.36, 0.0)];
    let (good, fine) = (stroke(RADIUS_M), settings(15.0));
    within(&TOOL, &plates, |cell| {
        let at = centre(&plates[0]);
        let refused = |stroke: &Stroke, at: Vector3<f64>, settings: &PostureSettings, near: &JointVector| match washing(
            cell, stroke, at, 0, settings, near,
        ) {
            Err(PostureError::Input { name, .. }) => name,
            other => panic!("{other:?}"),
        };
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 1e300] {
            assert_eq!(
                refused(&Stroke { radius_m: bad, ..good }, at, &fine, &HOME),
                "stroke.radius_m"
            );
            assert_eq!(
                refused(&Stroke { turns: bad, ..good }, at, &fine, &HOME),
                "stroke.turns"
            );
            let settings = |tilt_max_rad, clearance_m| PostureSettings {
                tilt_max_rad,
                clearance_m,
            };
            assert_eq!(refused(&good, at, &settings(bad, 0.01), &HOME), "tilt_max_rad");
            assert_eq!(refused(&good, at, &settings(0.1, bad), &HOME), "clearance_m");
        }
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            assert_eq!(
                refused(
                    &Stroke {
                        start_angle_rad: bad,
                        ..good
                    },
                    at,
                    &fine,
                    &HOME
                ),
                "stroke.start_angle_rad"
            );
            assert_eq!(refused(&good, Vector3::new(0.3, bad, 0.0), &fine, &HOME), "centre");
            assert_eq!(refused(&good, at, &fine, &JointVector::repeat(bad)), "near");
        }
        let (radius_m, turns) = (9.0, 100.0);
        let long = Stroke {
            radius_m,
            turns,
            ..good
        };
        assert_eq!(refused(&long, at, &fine, &HOME), "length of the stroke");
        assert_eq!(
            washing(cell, &good, at, 7, &fine, &HOME).unwrap_err(),
            PostureError::Plate { plate: 7, count: 1 }
        );
    });
}

/// Extremes of what is allowed end with an answer or a reason.
#[test]
fn extremes_end() {
    for (x, y, z) in [
        (0.0, 0.0, 0.03),
        (10.0, -10.0, 10.0),
        (0.0, 0.05, -3.0),
        (0.36, 0.0, 0.9),
    ] {
        let plates = [Plate {
            x_m: x,
            y_m: y,
            z_m: z,
            ..plate_at(0.3, 0.0)
        }];
        within(&TOOL, &plates, |cell| {
            for (radius_m, turns, tilt) in [
                (1e-4, 0.25, 0.0),
                (8.0, 1.5, 15.0),
                (0.12, 40.0, 80.0),
                (0.05, 0.25, 15.0),
            ] {
                let stroke = Stroke {
                    turns,
                    ..stroke(radius_m)
                };
                match washing(cell, &stroke, centre(&plates[0]), 0, &settings(tilt), &HOME) {
                    Ok(washing) => check(cell, &stroke, 0, &settings(tilt), &washing),
                    Err(error) => assert!(error.to_string().contains("plate 0"), "{error}"),
                }
            }
        });
    }
}

/// The sponge may touch other plates while it works on one; how near they lie changes nothing.
#[test]
fn other_plates_may_lie_as_near_as_they_like() {
    let first = plate_at(0.36, 0.0);
    let (stroke, settings) = (stroke(RADIUS_M), settings(15.0));
    let alone = within(&TOOL, &[first], |cell| {
        washing(cell, &stroke, centre(&first), 0, &settings, &HOME).unwrap()
    });
    for gap in [-0.02, -1e-6, 0.0005, 0.0035, 0.01] {
        let beside = Plate {
            y_m: 0.29 + gap,
            ..first
        };
        within(&TOOL, &[first, beside], |cell| {
            let washing = washing(cell, &stroke, centre(&first), 0, &settings, &HOME).unwrap();
            check(cell, &stroke, 0, &settings, &washing);
            assert_eq!(washing.q, alone.q, "{gap}");
        });
    }
}

/// An arm without a spherical wrist has no named branches: the branch is the one that the path follows.
#[test]
fn an_arm_without_a_closed_form_washes_too() {
    let offset = r#"<origin xyz="0.072 0 0"/>"#;
    assert!(IRB120_URDF.contains(offset));
    let text = IRB120_URDF.replace(offset, r#"<origin xyz="0.072 0 0.012"/>"#);
    let robot = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    let robot = robot
        .with_disabled_pairs(RobotModel::irb120().unwrap().disabled_pairs().unwrap().clone())
        .unwrap();
    let plates = [plate_at(0.36, 30.0)];
    let clearance = ClearanceModel::new(&robot, &TOOL, &plates).unwrap();
    let cell = Cell::new(&robot, &TOOL, &clearance, &plates).unwrap();
    assert!(matches!(cell.inverse, inverse::Inverse::Numeric(_)));
    let (stroke, settings) = (stroke(0.1), settings(15.0));
    let washing = washing(&cell, &stroke, centre(&plates[0]), 0, &settings, &HOME).unwrap();
    check(&cell, &stroke, 0, &settings, &washing);
    assert!(washing.travel_rad() < 15.0, "{}", washing.travel_rad());
}
