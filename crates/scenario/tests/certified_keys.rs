//! Keys that no certified job can have, and work that is too much.

use platewash_scenario::{Problem, Scenario};

type Change = fn(&mut Scenario);

#[test]
fn rejects_keys_that_no_certified_job_can_have() {
    let cases: [(&str, Change); 18] = [
        ("layout.plate_foot_m", |s| s.layout.plate_foot_m = Some([1e-6, 0.01])),
        ("layout.plate_foot_m", |s| s.layout.plate_foot_m = Some([0.05, 1e-6])),
        ("tool.sponge_compression_m", |s| {
            s.tool.sponge_compression_m = 1.001 * s.tool.sponge_height_m
        }),
        ("layout.plate_thickness_m", |s| s.layout.plate_thickness_m = 1e-6),
        ("layout.plate_radius_m", |s| s.layout.plate_radius_m = Some(1e-6)),
        ("wash.turns", |s| s.wash.turns = Some(0.249)),
        ("wash.turns", |s| s.wash.turns = Some(200.1)),
        ("wash.path_radius_m", |s| s.wash.path_radius_m = Some(0.99e-4)),
        ("wash.path_radius_m", |s| {
            (s.wash.path_radius_m, s.wash.turns) = (Some(10.0), Some(3.0))
        }),
        // Without a path radius the plate decides.
        ("layout.plate_radius_m", |s| {
            (s.wash.path_radius_m, s.layout.plate_radius_m) = (None, Some(2e-6))
        }),
        ("layout.plate_radius_m", |s| {
            (s.wash.path_radius_m, s.layout.plate_radius_m) = (None, Some(9.0))
        }),
        ("wash.landing_speed_m_s", |s| s.wash.landing_speed_m_s = Some(1e-7)),
        ("wash.lifting_speed_m_s", |s| s.wash.lifting_speed_m_s = Some(1e-7)),
        ("wash.speed_m_s", |s| s.wash.speed_m_s = 1e-300),
        ("wash.acceleration_m_s2", |s| s.wash.acceleration_m_s2 = 1e-9),
        ("limits.tip_speed_m_s", |s| s.limits.tip_speed_m_s = 1e-9),
        ("limits.tip_acceleration_m_s2", |s| {
            s.limits.tip_acceleration_m_s2 = 1e-9
        }),
        ("limits.joint_acceleration_rad_s2", |s| {
            s.limits.joint_acceleration_rad_s2[3] = 1e-9
        }),
    ];
    for (key, change) in cases {
        let mut scenario = Scenario::load("kitchen").unwrap();
        assert!(scenario.validate().is_ok());
        change(&mut scenario);
        let problem = scenario.validate().unwrap_err().problem;
        assert!(
            matches!(&problem, Problem::Value { key: named, .. } if named == key),
            "{problem}"
        );
        // The paper's program takes them.
        let mut paper = Scenario::load("paper-text").unwrap();
        change(&mut paper);
        assert!(paper.validate().is_ok(), "{key}");
    }
}

fn with(points: usize, plates: usize) -> Scenario {
    let mut scenario = Scenario::load("paper-text").unwrap();
    scenario.wash.points = points;
    scenario.layout.count = plates;
    scenario
}

#[test]
fn refuses_too_much_work_before_it_begins() {
    assert!(with(49_950, 4).validate().is_ok());
    let message = with(49_951, 4).validate().unwrap_err().to_string();
    assert!(
        message.contains("200004 waypoints") && message.contains("wash.points"),
        "{message}"
    );
    assert!(with(55, 218).check_work().is_ok());
    let message = with(55, 1000).check_work().unwrap_err().to_string();
    assert!(
        message.contains("1000 plates") && message.contains("5000000"),
        "{message}"
    );
}

/// Waypoints are the paper program's alone: they refuse no certified job, whose own wash paths count.
#[test]
fn rejects_keys_that_the_program_does_not_use() {
    let mut scenario = Scenario::load("kitchen-spiral").unwrap();
    (scenario.wash.points, scenario.transition.samples) = (100_000, 100_000);
    scenario.layout.count = 200;
    assert!(scenario.validate().is_ok() && scenario.check_work().is_ok());
    scenario.layout.count = 1000;
    let message = scenario.check_work().unwrap_err().to_string();
    assert!(
        message.contains("1000 plates") && message.contains("wash.turns") && !message.contains("wash.points"),
        "{message}"
    );
}
