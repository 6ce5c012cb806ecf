//! Tables of plates and kinds of soil out of files: what they become, and what is refused, by key, file, line and column.

use nalgebra::Vector3;
use platewash_scenario::Scenario;
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use platewash_workcell::surface::Surface;
use std::path::Path;
use tempfile::TempDir;

const HEAD: &str = "[job]\nprogram = \"certified\"\n[robot]\nstart_deg = [0, 0, 0, 0, 90, 0]\n[tool]\nlength_m = 0.15\n[wash]\ncontact = true\nheight_m = 0\ntilt_max_deg = 30\n";

const PLATES: &str = "name,x_m,y_m,z_m,tilt_deg,tilt_azimuth_deg,kind,height_error_mm,soil\n\
    # the near ones\n\
    a,0.35,0.2,0.03,0,0,dessert190,0.5,\n\
    b,0.35,-0.2,0.04,10,90,small,,dried\n";

const SOILS: &str = "[[soil]]\nname = \"dried\"\nsource = \"assumed\"\ndose_pa_m = 120\npasses = 2\nspeed_m_s = 0.2\nforce_n = [2, 30]\n\
    [[soil]]\nname = \"fresh\"\nsource = \"assumed\"\n";

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).unwrap();
}

/// A folder with a scenario of two plates out of a table, and its files.
fn folder(more: &str, plates: &str, soils: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        "{HEAD}soil_file = \"soil.toml\"\n[layout]\nplate_file = \"plates.csv\"\n[[plate]]\nkind = \"small\"\nradius_m = 0.08\nthickness_m = 0.01\n{more}"
    );
    write(folder.path(), "mine.toml", &text);
    write(folder.path(), "plates.csv", plates);
    write(folder.path(), "soil.toml", soils);
    folder
}

fn load(folder: &Path) -> Scenario {
    Scenario::load(&folder.join("mine.toml").to_string_lossy()).unwrap()
}

fn terms(folder: &Path) -> JobTerms {
    let scenario = load(folder).plates_read().unwrap().into_owned();
    let arm = scenario.arm().unwrap();
    let layout = scenario.layout(&arm).unwrap();
    scenario.terms(&arm, &layout).unwrap()
}

fn refused(plates: &str, soils: &str) -> String {
    let folder = folder("", plates, soils);
    match load(folder.path()).plates_read() {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn each_row_becomes_a_plate_with_its_own_terms() {
    let folder = folder("", PLATES, SOILS);
    let terms = terms(folder.path());
    let [a, b] = &terms.plates[..] else {
        panic!("two plates")
    };
    assert!(!a.surface.is_flat() && a.terms.soil.is_none() && a.terms.height_error_m == Some(0.0005));
    assert_eq!((b.rim_m(), b.thickness_m), (0.08, 0.01));
    assert!((b.centre() - Vector3::new(0.35, -0.2, 0.04)).norm() < 1e-15);
    // By hand: the axis leans by 10° from the vertical towards +y.
    let (sine, cosine) = 10_f64.to_radians().sin_cos();
    assert!((b.axis() - Vector3::new(0.0, sine, cosine)).norm() < 1e-12);
    let [of_a, of_b] = [a, b].map(|plate| terms.contact_of(plate).unwrap());
    assert_eq!(
        (of_a.height_error_m, of_a.dose_pa_m, of_a.force_n),
        (0.0005, 50.0, [1.0, 40.0])
    );
    assert_eq!(
        (of_b.height_error_m, of_b.dose_pa_m, of_b.force_n),
        (0.001, 120.0, [2.0, 30.0])
    );
    assert_eq!([a, b].map(|plate| terms.wash_speed_of(plate)), [0.25, 0.2]);
    assert_eq!([a, b].map(|plate| terms.passes_of(plate)), [1, 2]);
    let named: Vec<_> = load(folder.path()).files().map(Path::to_owned).collect();
    assert_eq!(named, ["plates.csv", "soil.toml"].map(|name| folder.path().join(name)));
}

/// By hand: the base stands at (0, 0, 0.1) turned by 90° about z, so that the point (−200, −350, −60) mm of it is (0.35, −0.2, 0.04).
#[test]
fn touched_places_are_in_the_frame_of_the_base() {
    let touched = "name,touched_x_mm,touched_y_mm,touched_z_mm,kind\nb,-200,-350,-60,small\n";
    let folder = folder("[robot.none]\n", touched, SOILS);
    let text = std::fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    let text = text.replace("[robot.none]\n", "");
    let mounted = text.replace(
        "[robot]\n",
        "[robot]\nmount_m = [0, 0, 0.1]\nmount_rpy_deg = [0, 0, 90]\n",
    );
    write(folder.path(), "mine.toml", &mounted);
    let read = load(folder.path()).plates_read().unwrap().into_owned();
    let at = Vector3::from(read.plate[0].at_m.unwrap());
    assert!((at - Vector3::new(0.35, -0.2, 0.04)).norm() < 1e-12, "{at}");
}

#[test]
fn a_table_is_refused_with_its_line_and_column() {
    let head = "name,x_m,y_m,z_m,kind\n";
    for (plates, words) in [
        (
            format!("{head}a,0.3,0.2,0.03,soup\n"),
            &["line 2", "column 5 (kind)", "no kind \"soup\"", "small, flat, coupe275"][..],
        ),
        (
            format!("{head}a,0.3,0.2,0.03,small\na,0.3,-0.2,0.03,small\n"),
            &["line 3", "column 1 (name)", "there twice"],
        ),
        (
            format!("{head},0.3,0.2,0.03,small\n"),
            &["line 2", "column 1 (name)", "is empty"],
        ),
        (
            format!("{head}a,0.3,nan,0.03,small\n"),
            &["line 2", "column 3 (y_m)", "expected a number"],
        ),
        (
            format!("{head}a,300,200,30,small\n"),
            &["line 2", "column 2 (x_m)", "±10 m"],
        ),
        (head.to_owned(), &["a header and no rows"]),
        (String::new(), &["it is empty"]),
        ("name,x_m,y_m\na,1,2\n".to_owned(), &["\"z_m\" is missing"]),
        (
            "name,kind\na,small\n".to_owned(),
            &["expected the columns x_m,y_m,z_m or touched_x_mm"],
        ),
        (
            "name,x_m,y_m,z_m,height_error_mm\na,0.3,0.2,0.03,-1\n".to_owned(),
            &["line 2", "height_error_mm", "0 to 1000 mm"],
        ),
        (
            "name,x_m,y_m,z_m,soil\na,0.3,0.2,0.03,jam\n".to_owned(),
            &["no soil \"jam\"", "dried, fresh"],
        ),
    ] {
        let said = refused(&plates, SOILS);
        assert!(words.iter().all(|word| said.contains(word)), "{words:?}: {said}");
    }
}

#[test]
fn a_file_of_soils_is_refused_with_the_soil() {
    for (soils, words) in [
        ("[[soil]]\nname = \"a\"\n", &["soil.toml", "source"][..]),
        (
            "[[soil]]\nname = \"a\"\nsource = \"\"\n",
            &["soil \"a\"", "name and source"],
        ),
        (
            "[[soil]]\nname = \"a\"\nsource = \"b\"\npasses = 0\n",
            &["passes must be from 1 to 20"],
        ),
        (
            "[[soil]]\nname = \"a\"\nsource = \"b\"\nforce_n = [3, 2]\n",
            &["least < greatest"],
        ),
        (
            "[[soil]]\nname = \"a\"\nsource = \"b\"\ndose_pa_m = nan\n",
            &["dose_pa_m"],
        ),
        (
            "[[soil]]\nname = \"a\"\nsource = \"b\"\nspeed_m_s = inf\n",
            &["speed_m_s"],
        ),
        (
            "[[soil]]\nname = \"a\"\nsource = \"b\"\nspeed = 1\n",
            &["unknown field", "speed"],
        ),
        ("[[soil]\n", &["soil.toml"]),
    ] {
        let said = refused(PLATES, soils);
        assert!(words.iter().all(|word| said.contains(word)), "{words:?}: {said}");
    }
}

#[test]
fn keys_that_contradict_each_other_are_refused() {
    let spiral = folder("", PLATES, SOILS);
    let text = std::fs::read_to_string(spiral.path().join("mine.toml")).unwrap();
    for (from, to, words) in [
        (
            "height_m = 0",
            "height_m = 0\npattern = \"spiral\"",
            &["plate[1].soil, wash.pattern", "2 passes"][..],
        ),
        (
            "contact = true",
            "contact = false",
            &["wash.soil_file", "wash.contact = true"],
        ),
        ("plates.csv", "none.csv", &["layout.plate_file", "none.csv"]),
        (
            "soil_file = \"soil.toml\"\n",
            "",
            &["plate[1].soil, wash.soil_file", "no file"],
        ),
        (
            "kind = \"small\"",
            "profile = \"flat\"",
            &["plate[0].kind", "is missing"],
        ),
        (
            "kind = \"small\"",
            "kind = \"small\"\nat_m = [0.3, 0, 0.03]",
            &["plate[0].kind", "no place"],
        ),
        (
            "plate_file",
            "positions_m = [[0.3, 0.2]]\nplate_file",
            &["layout.positions_m"],
        ),
        ("program = \"certified\"", "program = \"paper\"", &["paper's program"]),
        (
            "plate_file = \"plates.csv\"\n",
            "rho_m = [0.28, 0.38]\n",
            &["plate[0].kind", "there is none"],
        ),
    ] {
        let changed = text.replace(from, to);
        assert_ne!(text, changed);
        write(spiral.path(), "mine.toml", &changed);
        let loaded = Scenario::load(&spiral.path().join("mine.toml").to_string_lossy());
        let said = match loaded.map(|scenario| scenario.plates_read().map(|_| ())) {
            Err(error) | Ok(Err(error)) => error.to_string(),
            Ok(Ok(())) => panic!("accepted: {changed}"),
        };
        assert!(words.iter().all(|word| said.contains(word)), "{words:?}: {said}");
    }
}

/// Points of a dessert plate, ring by ring from the middle of the face over the rim to the middle below [mm].
fn rings(around: usize) -> Vec<Vec<[f64; 3]>> {
    let surface = Surface::shipped("dessert190").unwrap();
    let face = |k: usize| surface.at_arc(surface.arc_m() * k as f64 / 40.0);
    let top = (1..=40).map(|k| [face(k).radius_m, face(k).height_m]);
    let below = (1..=40).rev().map(|k| [face(k).radius_m, face(k).height_m - 0.004]);
    let ring = |[rho, z]: [f64; 2]| {
        let at = |k: usize| {
            let (sine, cosine) = (std::f64::consts::TAU * k as f64 / around as f64).sin_cos();
            [1e3 * rho * cosine + 300.0, 1e3 * rho * sine, 1e3 * z]
        };
        (0..around).map(at).collect()
    };
    top.chain(below).map(ring).collect()
}

/// The plate as an OBJ file, and points on its face as a table.
fn mesh_and_points() -> [String; 2] {
    let (around, all) = (96, rings(96));
    let mut obj = String::from("v 300 0 0\nv 300 0 -4\n");
    for [x, y, z] in all.iter().flatten() {
        obj += &format!("v {x} {y} {z}\n");
    }
    let at = |ring: usize, k: usize| 3 + ring * around + k % around;
    for k in 0..around {
        obj += &format!(
            "f 1 {} {}\nf 2 {} {}\n",
            at(0, k),
            at(0, k + 1),
            at(79, k + 1),
            at(79, k)
        );
        for ring in 0..79 {
            let [a, b, c, d] = [at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1)];
            obj += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
    }
    let rows = (3..40).step_by(4).flat_map(|ring| all[ring].iter().step_by(12));
    let rows: String = rows.map(|[x, y, z]| format!("{x},{y},{z}\n")).collect();
    [obj, format!("x_mm,y_mm,z_mm\n{rows}")]
}

#[test]
fn a_measured_shape_reaches_every_plate_that_takes_it() {
    let folder = tempfile::tempdir().unwrap();
    let [mesh, points] = mesh_and_points();
    write(folder.path(), "a.obj", &mesh);
    write(folder.path(), "a.csv", &points);
    let text = format!(
        "{HEAD}[layout]\nplate_mesh = \"a.obj\"\nplate_thickness_m = 0.001\n\
         [[plate]]\nat_m = [0.35, 0.2, 0.03]\n[[plate]]\nat_m = [0.35, -0.2, 0.03]\npoints = \"a.csv\"\nthickness_m = 0.006\n\
         [[plate]]\nat_m = [-0.35, 0.2, 0.03]\nprofile = \"dessert190\"\n"
    );
    write(folder.path(), "mine.toml", &text);
    let terms = terms(folder.path());
    let [meshed, probed, named] = &terms.plates[..] else {
        panic!("three plates")
    };
    assert_eq!(
        [meshed, probed, named].map(|plate| plate.terms.measured),
        [Some(0), Some(1), None]
    );
    assert_eq!(
        [&terms.measured[0], &terms.measured[1]].map(|shape| shape.is_probed),
        [false, true]
    );
    assert_eq!(
        [meshed, probed].map(|plate| plate.terms.deviation_m),
        [0, 1].map(|k| Some(terms.measured[k].deviation_m))
    );
    assert!(
        terms
            .measured
            .iter()
            .all(|shape| shape.deviation_m < 5e-4 && shape.unit.starts_with("mm"))
    );
    let truth = Surface::shipped("dessert190").unwrap();
    for rho_m in [0.0, 0.03, 0.06, 0.075, 0.09] {
        let off_m = |plate: &Plate| (plate.surface.height_m(rho_m) - truth.height_m(rho_m)).abs();
        assert!(
            off_m(meshed) < 2e-4 && off_m(probed) < 5e-4,
            "{rho_m}: {} {}",
            off_m(meshed),
            off_m(probed)
        );
    }
    // The body of a mesh is that of the mesh, whatever the text says; that of points is what the text says.
    assert!((meshed.thickness_m - 0.004).abs() < 5e-4 && probed.thickness_m == 0.006 && named.thickness_m > 0.003);
    let contact = terms.contact_of(meshed).unwrap();
    assert_eq!(contact.height_error_m, 0.001 + terms.measured[0].deviation_m);
}

/// A unit in the names of the columns, and another one in the key; a ball without points.
#[test]
fn statements_about_a_measurement_that_do_not_fit_it_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [mesh, points] = mesh_and_points();
    write(folder.path(), "a.obj", &mesh);
    write(folder.path(), "a.csv", &points);
    let said = |shape: &str| {
        write(
            folder.path(),
            "mine.toml",
            &format!("{HEAD}[layout]\n[[plate]]\nat_m = [0.35, 0.2, 0.03]\n{shape}\n"),
        );
        let path = folder.path().join("mine.toml");
        let scenario = Scenario::load(&path.to_string_lossy()).map_err(|error| error.to_string())?;
        scenario.job().map(|_| ()).map_err(|failure| failure.to_string())
    };
    assert_eq!(said("points = \"a.csv\"\nunit = \"mm\""), Ok(()));
    for (shape, words) in [
        ("points = \"a.csv\"\nunit = \"m\"", "plate[0].unit: "),
        (
            "mesh = \"a.obj\"\nball_radius_m = 0.002",
            "plate[0].ball_radius_m: is the ball with which points were touched",
        ),
        (
            "ball_radius_m = 0.002",
            "plate[0].ball_radius_m: is the ball_radius_m of a mesh or of points",
        ),
        (
            "points = \"a.csv\"\nball_radius_m = 0",
            "plate[0].ball_radius_m must be",
        ),
    ] {
        let found = said(shape).unwrap_err();
        assert!(found.contains(words), "{found}");
    }
    let height_m = |shape: &str| {
        said(shape).unwrap();
        let job = load(folder.path()).job().unwrap();
        let surface = job.terms().plates[0].surface;
        surface.height_m(surface.rim_m())
    };
    let apart = height_m("points = \"a.csv\"") - height_m("points = \"a.csv\"\nball_radius_m = 0.005");
    assert!(apart.abs() > 1e-4, "{apart}");
}
