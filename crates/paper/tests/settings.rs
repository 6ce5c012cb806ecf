//! Settings that are refused, and the most work that they may ask for.

use platewash_paper::PaperSettings;

type Change = fn(&mut PaperSettings);

#[test]
fn rejects_unusable_settings_by_name() {
    assert_eq!(PaperSettings::appendix().validate(), Ok(()));
    let cases: [(&str, Change); 9] = [
        ("spiral.points", |s| s.spiral.points = 1),
        ("spiral.turns", |s| s.spiral.turns = 0.0),
        ("spiral.radius_m", |s| s.spiral.radius_m = f64::INFINITY),
        ("height_m", |s| s.height_m = f64::NAN),
        ("transit.samples", |s| s.transit.samples = 1),
        ("arc.points", |s| s.arc.points = 0),
        ("arc.points", |s| s.arc.points = 1001),
        ("arc.radius_m", |s| s.arc.radius_m = -0.35),
        ("arc.height_m", |s| s.arc.height_m = f64::NEG_INFINITY),
    ];
    for (name, change) in cases {
        let mut settings = PaperSettings::appendix();
        change(&mut settings);
        assert_eq!(settings.validate().unwrap_err().name, name);
    }
}

#[test]
fn reads_settings_and_rejects_unknown_keys() {
    let mut value = serde_json::to_value(PaperSettings::appendix()).unwrap();
    assert_eq!(
        serde_json::from_value::<PaperSettings>(value.clone()).unwrap(),
        PaperSettings::appendix()
    );
    value["ik"]["restarts"] = 3.into();
    assert!(serde_json::from_value::<PaperSettings>(value).is_err());
}

fn of_points(points: usize) -> PaperSettings {
    let mut settings = PaperSettings::text();
    settings.spiral.points = points;
    settings
}

#[test]
fn refuses_too_much_work_before_it_begins() {
    assert_eq!(of_points(55).waypoints_at_most(4), 4 * (55 + 50));
    assert_eq!(of_points(49_950).check_waypoints(4), Ok(()));
    let message = of_points(49_951).check_waypoints(4).unwrap_err().to_string();
    assert!(
        message.contains("4 plates") && message.contains("200004 waypoints"),
        "{message}"
    );
    assert_eq!(of_points(55).check_work(218), Ok(()));
    let message = of_points(55).check_work(1000).unwrap_err().to_string();
    assert!(
        message.contains("1000 plates") && message.contains("5000000"),
        "{message}"
    );
}
