//! The shape of plates as a scenario states it.

use platewash_scenario::{Problem, Scenario};
use platewash_workcell::layout::base_footprint;
use platewash_workcell::plate::Foot;
use platewash_workcell::surface::{SHIPPED_PROFILES, Surface};

const HEAD: &str = "[job]\nprogram = \"certified\"\n[wash]\nheight_m = 0.0\n";

fn read(layout: &str) -> Result<Scenario, Problem> {
    let text = format!("{HEAD}[layout]\npositions_m = [[0.35, 0.1]]\n{layout}");
    Scenario::parse(&text, "plates.toml").map_err(|error| error.problem)
}

fn surface(layout: &str) -> Surface {
    read(layout).unwrap().layout.surface()
}

#[test]
fn a_plate_has_the_shape_that_is_stated() {
    let disc = |radius_m| Surface::Disc { radius_m };
    assert_eq!(surface(""), disc(0.145));
    assert_eq!(surface("plate_radius_m = 0.12"), disc(0.12));
    assert_eq!(surface("plate_profile = \"flat\"\nplate_radius_m = 0.12"), disc(0.12));
    assert_eq!(surface("plate_knots = [[0.12, 0.0]]"), disc(0.12));
    for name in SHIPPED_PROFILES {
        let found = surface(&format!("plate_profile = \"{name}\""));
        assert_eq!(Some(found), Surface::shipped(name));
    }
    let rim = surface("plate_knots = [[0.082, 0], [0.093, 38], [0.103, 11], [0.131, 11], [0.135, 0]]");
    assert!((rim.height_m(0.135) - Surface::shipped("rim270").unwrap().height_m(0.135)).abs() < 1e-12);
}

#[test]
fn plates_are_placed_in_their_shape() {
    let scenario = read("plate_profile = \"coupe275\"\nplate_foot_m = [0.087, 0.006]\nplate_height_m = 0.02").unwrap();
    let arm = scenario.arm().unwrap();
    let plate = scenario.layout(&arm).unwrap().plates[0];
    assert_eq!(Some(plate.surface), Surface::shipped("coupe275"));
    let foot = Foot {
        radius_m: 0.087,
        height_m: 0.006,
    };
    assert_eq!((plate.foot, plate.centre().z), (Some(foot), 0.02));
    assert!(plate.is_sound() && base_footprint(&arm).validate().is_ok());
}

#[test]
fn a_flat_profile_is_the_disc_to_the_byte() {
    let terms = |layout: &str| {
        let scenario = read(layout).unwrap();
        let arm = scenario.arm().unwrap();
        let job = scenario.job_on(&arm, &scenario.layout(&arm).unwrap()).unwrap();
        serde_json::to_string(job.terms()).unwrap()
    };
    let disc = terms("plate_radius_m = 0.12");
    assert_eq!(terms("plate_profile = \"flat\"\nplate_radius_m = 0.12"), disc);
    assert_eq!(terms("plate_knots = [[0.05, 0.0], [0.12, 0.0]]"), disc);
    assert_ne!(terms("plate_profile = \"coupe275\""), disc);
}

#[test]
fn shapes_that_contradict_each_other_are_refused_by_their_keys() {
    let cases = [
        (
            "plate_profile = \"coupe275\"\nplate_knots = [[0.1, 5.0]]",
            ["layout.plate_profile", "layout.plate_knots"],
        ),
        (
            "plate_profile = \"coupe275\"\nplate_radius_m = 0.145",
            ["layout.plate_profile", "layout.plate_radius_m"],
        ),
        (
            "plate_knots = [[0.1, 5.0]]\nplate_radius_m = 0.1",
            ["layout.plate_knots", "layout.plate_radius_m"],
        ),
        (
            "plate_profile = \"dessert190\"\nplate_foot_m = [0.1, 0.005]",
            ["layout.plate_foot_m", "layout.plate_profile"],
        ),
        (
            "plate_radius_m = 0.09\nplate_foot_m = [0.1, 0.005]",
            ["layout.plate_foot_m", "layout.plate_radius_m"],
        ),
    ];
    for (layout, named) in cases {
        let problem = read(layout).unwrap_err();
        let Problem::Conflict { keys, .. } = &problem else {
            panic!("{layout}: {problem:?}");
        };
        assert!(named.iter().all(|key| keys.contains(key)), "{layout}: {keys}");
    }
}

#[test]
fn the_papers_program_washes_flat_plates_alone() {
    let paper = |layout: &str| {
        let text = format!("[layout]\npositions_m = [[0.35, 0.1]]\n{layout}\n[job]\nprogram = \"paper\"\n");
        Scenario::parse(&text, "paper.toml").map_err(|error| error.problem)
    };
    for flat in [
        "",
        "plate_radius_m = 0.1",
        "plate_profile = \"flat\"",
        "plate_knots = [[0.1, 0]]",
    ] {
        assert!(paper(flat).is_ok(), "{flat}");
    }
    for (profile, named) in [
        ("plate_profile = \"coupe275\"", "layout.plate_profile"),
        ("plate_knots = [[0.105, 10]]", "layout.plate_knots"),
    ] {
        let problem = paper(profile).unwrap_err();
        let refused = matches!(&problem, Problem::Conflict { keys, .. } if keys == named);
        assert!(refused, "{profile}: {problem:?}");
    }
}

#[test]
fn knots_and_feet_out_of_range_are_refused() {
    for layout in [
        "plate_knots = []",
        "plate_knots = [[0.1, 5.0], [0.1, 6.0]]",
        "plate_knots = [[0.1, 5.0], [0.05, 6.0]]",
        "plate_knots = [[0.0, 5.0]]",
        "plate_knots = [[-0.1, 5.0]]",
        "plate_knots = [[0.1, 60.5]]",
        "plate_knots = [[0.1, nan]]",
        "plate_knots = [[inf, 1.0]]",
        "plate_knots = [[1e300, 1.0]]",
        "plate_knots = [[0.1, 5.0, 3.0]]",
        "plate_knots = [0.1, 5.0]",
        "plate_knots = \"coupe275\"",
        "plate_profile = \"bowl\"",
        "plate_foot_m = [0.05]",
        "plate_foot_m = [0.05, 0.0]",
        "plate_foot_m = [-0.05, 0.01]",
        "plate_foot_m = [0.05, nan]",
        "plate_foot_m = [0.05, inf]",
    ] {
        let problem = read(layout).unwrap_err();
        assert!(matches!(problem, Problem::Value { .. }), "{layout}: {problem:?}");
    }
    let many: Vec<_> = (1..=17).map(|k| format!("[{}, 1.0]", 0.01 * f64::from(k))).collect();
    assert!(read(&format!("plate_knots = [{}]", many.join(", "))).is_err());
}
