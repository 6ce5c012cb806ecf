//! What a scenario asks of the contact, and the wash path that it leaves open.

use platewash_scenario::Scenario;
use platewash_scenario::keys::KEYS;
use platewash_workcell::job::{ContactRequirements, Planner};
use platewash_workcell::wash_path::PatternName;

const REGION: &str = "layout.region = \"appendix\"\n";

fn parsed(lines: &str) -> Result<Scenario, String> {
    Scenario::parse(&format!("{REGION}tool.length_m = 0.15\n{lines}"), "case").map_err(|e| e.problem.to_string())
}

fn requirements(lines: &str) -> (platewash_workcell::job::Requirements, Option<[f64; 2]>) {
    let job = parsed(&format!("wash.height_m = 0\n{lines}")).unwrap().job().unwrap();
    let terms = job.terms();
    (terms.requirements, terms.workcell.tool.sponge.stiffness_pa)
}

#[test]
fn the_contact_promise_has_defaults_and_is_optional() {
    let (asked, stiffness) = requirements("wash.contact = true");
    let promised = ContactRequirements {
        compression_m: 0.001,
        height_error_m: 0.001,
        share: 0.995,
        strain: 0.6,
        force_n: [1.0, 40.0],
        time_s: 0.1,
        time_share: 0.99,
        dose_pa_m: 50.0,
        dose_share: 0.99,
    };
    assert_eq!(asked.contact, Some(promised));
    assert_eq!((asked.landing_m_s, asked.lifting_m_s), (Some(0.05), Some(0.05)));
    assert_eq!(asked.wrist_rad, Some(3_f64.to_radians()));
    assert_eq!(stiffness, Some([11e3, 44e3]));
    for off in ["", "wash.contact = false"] {
        let (asked, stiffness) = requirements(off);
        assert_eq!((asked.contact, asked.wrist_rad, stiffness), (None, None, None));
        assert_eq!((asked.landing_m_s, asked.lifting_m_s), (None, None));
    }
}

#[test]
fn keys_of_contact_need_the_contact_promise() {
    let keys: Vec<_> = KEYS
        .iter()
        .filter(|key| key.path.starts_with("wash.contact_"))
        .collect();
    assert_eq!(keys.len(), 9);
    let (default, _) = requirements("wash.contact = true");
    for key in keys {
        let value = if key.path.ends_with("force_n") {
            "[2, 30]"
        } else if key.path.ends_with("_m") {
            "0.002"
        } else {
            "0.25"
        };
        let line = format!("{} = {value}\n", key.path);
        let refused = parsed(&line).unwrap_err();
        assert!(
            refused.starts_with(key.path) && refused.contains("wash.contact = true"),
            "{refused}"
        );
        let (asked, _) = requirements(&format!("wash.contact = true\n{line}"));
        assert_ne!(asked.contact, default.contact, "{line}");
        // Nothing else changes.
        let rest = platewash_workcell::job::Requirements {
            contact: default.contact,
            ..asked
        };
        assert_eq!(rest, default, "{line}");
    }
}

#[test]
fn requirements_equal_the_stated_keys() {
    let (asked, stiffness) = requirements(
        "wash.contact = true\nwash.landing_speed_m_s = 0.1\nwash.wrist_min_deg = 5\ntool.sponge_stiffness_kpa = [15, 20]",
    );
    assert_eq!((asked.landing_m_s, asked.lifting_m_s), (Some(0.1), Some(0.05)));
    assert_eq!(
        (asked.wrist_rad, stiffness),
        (Some(5_f64.to_radians()), Some([15e3, 20e3]))
    );
    // Speeds, wrist and stiffness mean something without the promise, too.
    let (asked, stiffness) =
        requirements("wash.lifting_speed_m_s = 0.2\nwash.wrist_min_deg = 0\ntool.sponge_stiffness_kpa = [15, 20]");
    assert_eq!(
        (asked.landing_m_s, asked.lifting_m_s, asked.contact),
        (None, Some(0.2), None)
    );
    assert_eq!((asked.wrist_rad, stiffness), (Some(0.0), Some([15e3, 20e3])));
}

#[test]
fn the_planner_chooses_an_unstated_wash_path() {
    let settings = |lines: &str| {
        let job = parsed(&format!("wash.height_m = 0\n{lines}")).unwrap().job().unwrap();
        let Planner::Wash(settings) = job.terms().planner.clone() else {
            unreachable!("a washing")
        };
        settings
    };
    let free = settings("");
    assert_eq!((free.path_radius_m, free.turns, free.closing_ring), (None, None, None));
    assert_eq!((free.pattern, free.tilt_rad, free.axis_share), (None, None, None));
    for pattern in PatternName::ALL {
        let name = pattern.rules().name;
        assert!(PatternName::NAMES.contains(&name), "{name}");
        let pinned = settings(&format!(
            "wash.pattern = \"{name}\"\nwash.turns = 2\nwash.path_radius_m = 0.12\nwash.tilt_deg = 8\nwash.axis_share = 0.5"
        ));
        assert_eq!(
            (pinned.pattern, pinned.turns, pinned.path_radius_m),
            (Some(pattern), Some(2.0), Some(0.12))
        );
        assert_eq!(
            (pinned.tilt_rad, pinned.axis_share),
            (Some(8_f64.to_radians()), Some(0.5))
        );
    }
}

#[test]
fn keys_that_contradict_each_other_are_refused_with_both() {
    for (lines, parts) in [
        (
            "job.program = \"paper\"\nwash.contact = true",
            &["wash.contact", "job.program = \"certified\""][..],
        ),
        (
            "wash.tilt_deg = 15.5",
            &["wash.tilt_deg", "wash.tilt_max_deg = 15", "15.5"],
        ),
        (
            "wash.pattern = \"rings\"\nwash.closing_ring = false",
            &["wash.closing_ring", "wash.pattern"],
        ),
        (
            "wash.pattern = \"rings\"\nwash.turns = 2.5",
            &["wash.turns", "wash.pattern = \"rings\"", "from 1 to 99", "found 2.5"],
        ),
        (
            "wash.pattern = \"rings\"\nwash.turns = 100",
            &["wash.turns", "found 100.0"],
        ),
    ] {
        let refused = parsed(lines).unwrap_err();
        assert!(parts.iter().all(|part| refused.contains(part)), "{refused}");
    }
    for lines in [
        "wash.tilt_deg = 15",
        "wash.pattern = \"rings\"\nwash.turns = 99\nwash.path_radius_m = 0.1\nwash.closing_ring = true",
        "wash.pattern = \"spiral\"\nwash.closing_ring = false\nwash.turns = 2.5",
        // The paper's program accepts keys that it does not use.
        "job.program = \"paper\"\nwash.pattern = \"rings\"\nwash.turns = 2.5",
    ] {
        assert!(parsed(lines).is_ok(), "{lines}");
    }
}

#[test]
fn a_promise_that_no_plan_keeps_is_refused_with_its_keys() {
    // By hand: H = 30 mm, 60 % of it 18 mm; c + δ cos 15° = 5 + 13.5 · 0.966 = 18.04 mm, and 17.94 mm with 13.4 mm.
    // c + 0.2 − δ cos 15° + 25 tan 15° = 5 + 0.2 − 0.966 + 6.699 = 10.933 mm. 11 kPa · π · 25² mm² · 0.6 = 12.96 N.
    for (line, parts) in [
        (
            "wash.contact_height_error_m = 0.0135",
            &[
                "tool.sponge_compression_m",
                "wash.contact_strain",
                "0.018040 m",
                "at most",
                "0.018000 m",
            ][..],
        ),
        (
            "wash.contact_compression_m = 0.01094",
            &[
                "tool.sponge_compression_m",
                "wash.contact_compression_m",
                "0.0109",
                "expected at least",
                "0.01094",
            ],
        ),
        (
            "wash.contact_force_n = [12.97, 40]",
            &[
                "wash.contact_force_n",
                "tool.sponge_stiffness_kpa",
                "12.959 N",
                "at least 12.97 N",
            ],
        ),
    ] {
        let refused = parsed(&format!("wash.tilt_max_deg = 15\nwash.contact = true\n{line}")).unwrap_err();
        assert!(parts.iter().all(|part| refused.contains(part)), "{refused}");
    }
    for lines in [
        // A hollow face may press more.
        "wash.contact_height_error_m = 0.0134\nlayout.plate_profile = \"deep230\"",
        "wash.contact_compression_m = 0.01093",
        "wash.contact_force_n = [12.95, 40]",
        "wash.contact_compression_m = 0.01094\nlayout.plate_profile = \"deep230\"",
    ] {
        let lines = format!("wash.tilt_max_deg = 15\nwash.contact = true\n{lines}");
        assert!(parsed(&lines).is_ok(), "{lines}: {:?}", parsed(&lines));
    }
}

#[test]
fn rejects_senseless_values_with_their_range() {
    for (line, key) in [
        ("tool.sponge_stiffness_kpa = [0, 44]", "tool.sponge_stiffness_kpa"),
        ("tool.sponge_stiffness_kpa = [44, 11]", "tool.sponge_stiffness_kpa"),
        ("tool.sponge_stiffness_kpa = [11, inf]", "tool.sponge_stiffness_kpa"),
        ("tool.sponge_stiffness_kpa = 20", "tool.sponge_stiffness_kpa"),
        ("wash.contact = 1", "wash.contact"),
        ("wash.contact_strain = 0", "wash.contact_strain"),
        ("wash.contact_strain = nan", "wash.contact_strain"),
        ("wash.contact_share = 1.001", "wash.contact_share"),
        ("wash.contact_height_error_m = -0.001", "wash.contact_height_error_m"),
        ("wash.contact_compression_m = 1.5", "wash.contact_compression_m"),
        ("wash.contact_force_n = [40, 1]", "wash.contact_force_n"),
        ("wash.contact_force_n = []", "wash.contact_force_n"),
        ("wash.contact_time_s = inf", "wash.contact_time_s"),
        ("wash.contact_dose_pa_m = 1e300", "wash.contact_dose_pa_m"),
        ("wash.landing_speed_m_s = 0", "wash.landing_speed_m_s"),
        ("wash.lifting_speed_m_s = 1e-9", "wash.lifting_speed_m_s"),
        ("wash.wrist_min_deg = 90.1", "wash.wrist_min_deg"),
        ("wash.axis_share = 1.1", "wash.axis_share"),
        ("wash.pattern = \"raster\"", "wash.pattern"),
    ] {
        let refused = parsed(line).unwrap_err();
        assert!(
            refused.starts_with(key) && refused.contains("must be"),
            "{line}: {refused}"
        );
    }
}
