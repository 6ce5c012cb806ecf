//! The basis of a verdict in words: different jobs read differently, and a name never reads as more than a name.

use crate::maker::{good, post};
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};
use platewash_certificate::VerdictBasis;
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::words::rounded;
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::plate::{Foot, Plate};
use platewash_workcell::surface::{Knot, SHIPPED_PROFILES, Surface};
use platewash_workcell::{Exclusion, ExclusionReason, Obstacle, ObstacleShape};

/// The line of that name, where the terms are changed.
fn told(name: &str, change: impl Fn(&mut VerdictBasis)) -> String {
    let job = good().job;
    let mut rests = VerdictBasis {
        workcell: job.workcell,
        plates: job.plates,
        requirements: job.requirements,
        limits: job.limits,
        described_accelerations: Vec::new(),
        left_out_links: Vec::new(),
        home_rad: job.home_rad,
        waived_pairs: Vec::new(),
        soils: Vec::new(),
        dry_run: None,
        recovery: None,
        assumptions: vec!["nothing".to_owned()],
    };
    rests.workcell.obstacles = vec![Obstacle::floor()];
    change(&mut rests);
    let text = rests.to_string();
    let line = text.lines().find_map(|line| line.trim_start().strip_prefix(name));
    line.unwrap().trim_start().to_owned()
}

fn turned(degrees: f64, axis: Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(axis.normalize() * degrees.to_radians())
}

fn hull() -> Shape {
    let at = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
    Shape::Hull {
        points: vec![
            at(-0.01, 0.0, 0.0),
            at(0.03, 0.0, 0.0),
            at(0.0, 0.02, 0.0),
            at(0.0, 0.0, 0.0400004),
        ],
    }
}

#[test]
fn quotes_names_so_that_they_read_as_one() {
    let forged = "floor, all below 0; dust";
    let named = |name: &str| {
        let name = name.to_owned();
        told("obstacles", move |r| r.workcell.obstacles = vec![post(&name)])
    };
    let body = "a cylinder of radius 20 and length 600 mm at (0.4, 0, 0.3) m";
    assert_eq!(named(forged), format!("no floor; \"{forged}\", {body}"));
    assert_eq!(
        named("floor\", all below 0; \"dust"),
        format!(r#"no floor; "floor\", all below 0; \"dust", {body}"#)
    );
    assert_eq!(
        named("a\nb\u{202e}c\u{2028}"),
        format!(r#"no floor; "a\nb\u{{202e}}c\u{{2028}}", {body}"#)
    );
    let arm = told("arm", |r| r.workcell.arm.name = "irb120, description 0".to_owned());
    assert!(arm.starts_with("\"irb120, description 0\", description "), "{arm}");
    let tool = told("tool", |r| r.workcell.tool.bodies[0].name = "no body; a".to_owned());
    assert!(tool.starts_with("\"no body; a\", a cylinder "), "{tool}");
    let pair = Exclusion {
        pair: ["a – b".to_owned(), "c".to_owned()],
        reason: ExclusionReason::Srdf,
    };
    let left_out = told("not checked", |r| r.workcell.exclusions = vec![pair.clone()]);
    assert_eq!(left_out, "disabled by the SRDF: \"a – b\" – \"c\"");
    let waived = told("waived", |r| r.waived_pairs = vec![pair.clone()]);
    assert_eq!(waived, "by the job: \"a – b\" – \"c\"");
}

#[test]
fn a_dry_run_is_stated_first() {
    let dry_run = DryRun {
        parent: "0a".repeat(32),
        height_m: 0.05,
    };
    let line = told("dry run", |r| r.dry_run = Some(dry_run.clone()));
    let rest = ", its plates raised by 50 mm; nothing is there, and nothing is washed";
    assert_eq!(line, format!("of the plan {}{rest}", "0a".repeat(32)));
    assert_eq!(
        dry_run.words(),
        "DRY RUN of 0a0a0a0a0a0a: 50 mm above the plates, nothing is washed"
    );
    let odd = DryRun {
        height_m: 0.0123,
        ..dry_run
    };
    assert!(odd.words().contains(": 12.3 mm above"), "{}", odd.words());
}

#[test]
fn states_a_missing_floor() {
    assert_eq!(told("obstacles", |_| ()), "\"floor\", all below 0");
    assert_eq!(told("obstacles", |r| r.workcell.obstacles.clear()), "none; no floor");
}

#[test]
fn states_position_and_orientation_of_the_bodies_of_the_tool() {
    let straight = told("tool", |_| ());
    assert_eq!(
        straight,
        "\"handle\", a cylinder of radius 20 and length 125 mm at (0, 0, 62.5) mm of the flange; tip at (0, 0, 150) mm of the flange"
    );
    // About its own axis, the tip points where it pointed.
    let about_z = |r: &mut VerdictBasis| r.workcell.tool.tip.rotation = turned(40.0, Vector3::z());
    assert_eq!(told("tool", about_z), straight);
    let bend = |r: &mut VerdictBasis| {
        let tool = &mut r.workcell.tool;
        tool.bodies[0].pose.translation.x = 6.0004e-3;
        tool.bodies[0].pose.rotation = turned(-30.0, Vector3::y());
        tool.sponge.pose.rotation = turned(180.0, Vector3::x());
        tool.tip.rotation = turned(1e-12, Vector3::y());
    };
    let (bent, sponge) = (told("tool", bend), told("sponge", bend));
    let parts: Vec<_> = bent.split("; ").collect();
    assert!(
        parts[0].ends_with(" at (6.0004, 0, 62.5) mm of the flange, turned by 30 ° about (0, -1, 0)"),
        "{bent}"
    );
    assert!(
        sponge.contains(" mm of the flange, along (0, ") && sponge.ends_with(", -1)"),
        "{sponge}"
    );
    assert_eq!(
        parts[1],
        "tip at (0, 0, 150) mm of the flange, along (1.74532925e-14, 0, 1)"
    );
}

#[test]
fn states_axis_and_angle_of_a_turned_obstacle() {
    let post_turned = |rotation: UnitQuaternion<f64>| {
        told("obstacles", move |r| {
            let mut post = post("post");
            post.pose.rotation = rotation;
            r.workcell.obstacles.push(post);
        })
    };
    let upright = post_turned(UnitQuaternion::identity());
    assert!(upright.ends_with(" at (0.4, 0, 0.3) m"), "{upright}");
    let quarter = turned(90.0, Vector3::x());
    for rotation in [quarter, UnitQuaternion::new_unchecked(-quarter.into_inner())] {
        assert_eq!(
            post_turned(rotation),
            format!("{upright}, turned by 90 ° about (1, 0, 0)")
        );
    }
    let slight = post_turned(UnitQuaternion::new_unchecked(Quaternion::new(1.0, 0.0, 3e-200, 4e-200)));
    assert_eq!(
        slight,
        format!("{upright}, turned by 5.72957795e-198 ° about (0, 0.6, 0.8)")
    );
}

#[test]
fn states_the_points_and_bounds_of_a_hull() {
    let words = "the hull of 4 points, x from -10 to 30, y from 0 to 20, z from 0 to 40.0004 mm, at ";
    let obstacle = told("obstacles", |r| {
        let mut rock = post("rock");
        rock.shape = ObstacleShape::Convex(hull());
        r.workcell.obstacles.push(rock);
    });
    assert_eq!(
        obstacle,
        format!("\"floor\", all below 0; \"rock\", {words}(0.4, 0, 0.3) m")
    );
    let tool = told("tool", |r| r.workcell.tool.bodies[0].shape = hull());
    assert!(
        tool.starts_with(&format!("\"handle\", {words}(0, 0, 62.5) mm of the flange; ")),
        "{tool}"
    );
}

#[test]
fn states_all_sizes_of_plates_and_the_first_positions() {
    let row = |count: u32| (0..count).map(|i| Plate::level_disc([f64::from(i), 0.5, 0.03], 0.145, 0.02));
    let few = told("plates", |r| r.plates = row(2).collect());
    let size = "of radius 145 mm, 20 mm thick, faces 30 mm above 0";
    assert_eq!(few, format!("2 {size}: 1 at (0, 0.5), 2 at (1, 0.5) m"));
    let many = told("plates", |r| {
        r.plates = row(14).collect();
        r.plates[1].thickness_m = 0.0200001;
        r.plates.push(Plate::level_disc([20.0, 0.0, 0.04], 0.001, 0.02));
    });
    let groups: Vec<_> = many.split("; ").collect();
    assert!(
        groups[0].starts_with(&format!("15: 13 {size}: 1 at (0, 0.5), 3 at (2, 0.5), ")),
        "{many}"
    );
    assert!(groups[0].ends_with(", 12 at (11, 0.5) m and 2 more"), "{many}");
    assert_eq!(
        groups[1..],
        [
            "1 of radius 145 mm, 20.0001 mm thick, faces 30 mm above 0: 2 at (1, 0.5) m",
            "1 of radius 1 mm, 20 mm thick, faces 40 mm above 0"
        ]
    );
}

#[test]
fn states_the_tilt_of_tilted_plates() {
    let leaning = told("plates", |r| {
        r.plates = vec![Plate::level_disc([0.5, 0.0, 0.03], 0.145, 0.02); 2];
        r.plates[1].pose.rotation = nalgebra::UnitQuaternion::from_euler_angles(0.0, -45_f64.to_radians(), 0.0);
    });
    let size = "of radius 145 mm, 20 mm thick, faces 30 mm above 0";
    let axis = "tilted by 45°, axis (-0.707106781, 0, 0.707106781)";
    assert_eq!(
        leaning,
        format!("2: 1 {size}: 1 at (0.5, 0) m; 1 {size}, {axis}: 2 at (0.5, 0) m")
    );
}

#[test]
fn states_profiles_by_name_or_knots_with_rim_and_foot() {
    let plate = |surface: Surface, foot: Option<Foot>| {
        told("plates", move |r| {
            r.plates.truncate(1);
            (r.plates[0].surface, r.plates[0].foot) = (surface, foot);
        })
    };
    let foot = Foot {
        radius_m: 0.06,
        height_m: 0.004,
    };
    for name in SHIPPED_PROFILES {
        let surface = Surface::shipped(name).unwrap();
        let words = plate(surface, Some(foot));
        let start = format!(
            "1 of radius {} mm, of profile {name}, rim ",
            rounded(1e3 * surface.rim_m(), 9)
        );
        assert!(words.starts_with(&start), "{words}");
        assert!(words.contains(
            " mm over the pole, 20 mm thick, poles 30 mm above 0, on a foot of radius 60 mm, 4 mm high: 1 at ("
        ));
        // As it is read back.
        let read: Surface = serde_json::from_str(&serde_json::to_string(&surface).unwrap()).unwrap();
        assert_eq!(plate(read, Some(foot)), words);
    }
    let knot = |radius_m: f64, slope_deg: f64| Knot {
        radius_m,
        slope_rad: slope_deg.to_radians(),
    };
    let bowl = plate(Surface::profile(&[knot(0.105, 10.0)]).unwrap(), None);
    let start = "1 of radius 105 mm, of a profile by knots (105 mm 10°), rim 9.1863 mm over the pole, 20 mm thick, poles 30 mm above 0: ";
    assert!(bowl.starts_with(start), "{bowl}");
    let dome = plate(Surface::profile(&[knot(0.05, 0.0), knot(0.105, -10.0)]).unwrap(), None);
    assert!(
        dome.contains(" by knots (50 mm 0°, 105 mm -10°), rim ") && dome.contains(" mm below the pole"),
        "{dome}"
    );
}

#[test]
fn states_that_no_contact_is_required() {
    let words = "not required: a point counts as swept where the sponge's face touches it, pressed or not";
    assert_eq!(told("contact", |_| ()), words);
    let landing = told("contact", |r| r.requirements.landing_m_s = Some(0.05));
    assert_eq!(landing, format!("{words}; the free sponge lands with at most 0.05 m/s"));
}

#[test]
fn limits_are_printed_without_rounding() {
    let tip_at = |speed: f64| {
        let limits = told("limits", move |r| r.limits.tip_speed_m_s = speed);
        limits
            .split("tip speed ")
            .nth(1)
            .unwrap()
            .split(" m/s,")
            .next()
            .unwrap()
            .to_owned()
    };
    let cases = [
        (6.0004, "6.0004"),
        (6.000_000_01, "6.00000001"),
        (0.1 + 0.2, "0.3"),
        (-0.0, "0"),
        (1e-6, "0.000001"),
        (9.5e-7, "9.5e-7"),
        (1e6, "1000000"),
        (1_000_001.0, "1.000001e6"),
        (-2.5e12, "-2.5e12"),
    ];
    for (value, words) in cases {
        assert_eq!(tip_at(value), words);
    }
    let home = told("home", |r| r.home_rad[0][0] = 0.001_f64.to_radians());
    assert!(home.starts_with("0.001, "), "{home}");
    let place = told("plates", |r| r.plates[0].pose.translation.x = 0.3000004);
    assert!(place.contains(": 1 at (0.3000004, "), "{place}");
}
