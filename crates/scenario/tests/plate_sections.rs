//! Plates one by one, each with its own shape: the sections that state them.

use platewash_kinematics::RobotModel;
use platewash_scenario::Scenario;
use platewash_workcell::plate::Plate;

fn refused(text: &str) -> String {
    Scenario::parse(text, "case").unwrap_err().to_string()
}

#[test]
fn sections_that_state_no_plates_are_named() {
    let row = "[[plate]]\nat_m = [0.3, 0, 0.03]\n";
    let sampled = "layout.rho_m = [0.28, 0.38]\n[[plate]]\ncount = 2\n";
    for (text, words) in [
        (
            format!("{row}[[plate]]\nat_n = 1\n"),
            "line 4: unknown key 'plate[1].at_n'; did you mean 'plate[1].at_m'?",
        ),
        (
            format!("{row}[[plate]]\nat_m = [0.3, 0]\n"),
            "plate[1].at_m must be three numbers",
        ),
        (
            format!("{row}[[plate]]\nat_m = [0.3, nan, 0]\n"),
            "plate[1].at_m must be three numbers",
        ),
        (format!("{row}[[plate]]\n"), "plate[1].at_m: is missing"),
        (
            format!("{row}count = 2\n"),
            "plate[0].count: is for plates that are sampled",
        ),
        (
            format!("{row}[[plate]]\ncount = 2\n"),
            "plate[1].at_m: either every [[plate]] has its place",
        ),
        (
            format!("{sampled}rpy_deg = [0, 0, 0]\n"),
            "plate[0].rpy_deg: plates that are sampled lie level",
        ),
        (
            format!("layout.positions_m = [[0.3, 0]]\n{row}"),
            "plate, layout.positions_m: give [[plate]]",
        ),
        (
            format!("{row}radius_m = 0.1\nprofile = \"rim270\"\n"),
            "plate[0].profile, plate[0].radius_m: the profile has its own",
        ),
        (
            format!("{row}radius_m = 0.1\nfoot_m = [0.2, 0.01]\n"),
            "plate[0].foot_m, plate[0].radius_m: the foot's radius",
        ),
        (
            format!("{row}faces = \"both\"\nprofile = \"rim270\"\n"),
            "plate[0].faces: both faces are those of a flat plate",
        ),
        (
            format!("{row}thickness_m = 0\n"),
            "plate[0].thickness_m must be a number above 0",
        ),
        (format!("{row}radius_m = 1e-7\n"), "plate[0].radius_m must be"),
        (
            "layout.rho_m = [0.28, 0.38]\n[[plate]]\ncount = 600\n[[plate]]\ncount = 600\n".to_owned(),
            "at most 1000 plates in all; found 1200",
        ),
        (
            format!("job.program = \"paper\"\n{row}"),
            "plate: the paper's program washes plates of one kind",
        ),
        ("[[plate]]\ncount = 2\n".to_owned(), "no region to sample from"),
    ] {
        let said = refused(&text);
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn each_plate_has_its_own_shape_and_place() {
    let text = "layout.plate_radius_m = 0.1\n[[plate]]\nat_m = [0.3, 0, 0.2]\nrpy_deg = [0, -90, 0]\n[[plate]]\nat_m = [0, 0.4, 0.03]\n\
            profile = \"dessert190\"\nthickness_m = 0.005\n";
    let scenario = Scenario::parse(text, "case").unwrap();
    assert_eq!(scenario.validate(), Ok(()));
    assert!(scenario.lists_plates() && scenario.plates() == 2);
    let plates = scenario.layout(&RobotModel::irb120().unwrap()).unwrap().plates;
    assert!((plates[0].rim_m() - 0.1).abs() < 1e-15 && plates[0].thickness_m == 0.02);
    // Face up turned by −90° about y: it looks along −x.
    assert!((plates[0].axis() + nalgebra::Vector3::x()).norm() < 1e-15);
    assert!(!plates[1].surface.is_flat() && plates[1].thickness_m == 0.005 && plates[1].centre().y == 0.4);
}

#[test]
fn kinds_are_sampled_in_order_by_the_rules_of_the_layout() {
    let text = "layout = { rho_m = [0.3, 0.4], min_distance_m = 0.25 }\n[[plate]]\ncount = 2\nradius_m = 0.12\n[[plate]]\ncount = 1\nradius_m = 0.08\n";
    let scenario = Scenario::parse(text, "case").unwrap();
    assert!(!scenario.lists_plates());
    let plates = scenario.layout(&RobotModel::irb120().unwrap()).unwrap().plates;
    let rims: Vec<_> = plates.iter().map(Plate::rim_m).collect();
    assert_eq!(rims, [0.12, 0.12, 0.08]);
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        assert!(plates[a].aside_m(&plates[b]) > 0.25);
    }
}
