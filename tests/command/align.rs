//! `platewash align`.

use super::{folder, platewash};
use platewash::Scenario;
use platewash::kinematics::irb120::IRB120_URDF;
use std::fmt::Write;
use std::path::Path;

const HEADER: &str = "name,x_m,y_m,z_m,touched_x_mm,touched_y_mm,touched_z_mm\n";

/// Corners and a stud of a table \[m\].
const TABLE: [[f64; 3]; 4] = [[0.2, -0.3, 0.0], [0.7, -0.3, 0.0], [0.7, 0.4, 0.0], [0.45, 0.1, 0.05]];

/// The base stands at (0.1, 0.2, −0.03) m in the drawing, turned by 30° about z; rows with `off_mm` added to the last touch.
fn rows(count: usize, off_mm: f64) -> String {
    let (s, c) = (0.5, 0.75_f64.sqrt());
    let mut text = HEADER.to_owned();
    for (k, [x, y, z]) in TABLE[..count].iter().enumerate() {
        let (dx, dy) = (x - 0.1, y - 0.2);
        let mm = [c * dx + s * dy, -s * dx + c * dy, z + 0.03].map(|m| 1e3 * m);
        let off = if k + 1 == count { off_mm } else { 0.0 };
        writeln!(text, "p{k},{x},{y},{z},{},{},{}", mm[0] + off, mm[1], mm[2]).unwrap();
    }
    text
}

fn write(dir: &Path, text: &str) {
    std::fs::write(dir.join("touched.csv"), text).unwrap();
}

#[test]
fn the_mount_is_found_and_points_are_carried_over() {
    let folder = folder();
    let dir = folder.path();
    write(dir, &rows(4, 0.0));
    std::fs::write(dir.join("plates.csv"), "name,x_m,y_m,z_m\nfirst,0.7,-0.3,0.0\n").unwrap();
    let ran = platewash(
        dir,
        &[
            "align",
            "touched.csv",
            "--point",
            "0.1",
            "0.2",
            "-0.03",
            "--points",
            "plates.csv",
        ],
    )
    .done();
    assert!(
        ran.stdout.starts_with("ALIGNED: 4 points, off by 0.000 mm rms"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout
            .contains("position, m        0.100000, 0.200000, -0.030000\n"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout.contains("roll pitch yaw, °  0.00000, 0.00000, 30.00000\n"),
        "{}",
        ran.stdout
    );
    for keys in ["mount_m = [0.1, 0.2, -0.03]\n", "mount_rpy_deg = [0.0, 0.0, 30.0]\n"] {
        assert!(ran.stdout.contains(keys), "{keys}: {}", ran.stdout);
    }
    assert!(
        ran.stdout
            .contains("0.000000, 0.000000, 0.000000; 0.000, 0.000, 0.000\n"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stdout
            .contains("a scenario with the keys above states plates by their places in the drawing"),
        "{}",
        ran.stdout
    );
    let answer = platewash(dir, &["align", "touched.csv", "--points", "plates.csv", "--json"])
        .done()
        .json();
    assert_eq!(answer["fits"], true);
    assert_eq!(answer["points"][0]["name"], "first");
    let number = |v: &serde_json::Value| v.as_f64().unwrap();
    let expected = [0.26961524, -0.73301270, 0.03];
    for (found, expected) in answer["points"][0]["base_m"].as_array().unwrap().iter().zip(expected) {
        assert!((number(found) - expected).abs() < 1e-8, "{found}");
    }
    let q: Vec<f64> = answer["mount"]["quaternion_wxyz"]
        .as_array()
        .unwrap()
        .iter()
        .map(number)
        .collect();
    assert!((q[0] - 15_f64.to_radians().cos()).abs() < 1e-12 && (q[3] - 15_f64.to_radians().sin()).abs() < 1e-12);
    assert!(number(&answer["tilt_rad"]) < 1e-7);
}

/// The table of the page on robot programs is one that can be typed in.
#[test]
fn the_example_of_the_documentation_aligns() {
    let folder = folder();
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/robot-programs.md")).unwrap();
    let table = text.split("```csv\n").nth(1).unwrap().split("```").next().unwrap();
    write(folder.path(), table);
    let ran = platewash(folder.path(), &["align", "touched.csv", "--tolerance", "0.000002"]).done();
    assert!(
        ran.stdout.contains("position, m        0.100000, 0.200000, -0.030000"),
        "{}",
        ran.stdout
    );
    assert!(ran.stdout.contains("left front"), "{}", ran.stdout);
}

#[test]
fn residuals_beyond_the_tolerance_are_exit_code_4() {
    let folder = folder();
    let dir = folder.path();
    write(dir, &rows(4, 6.0));
    let ran = platewash(dir, &["align", "touched.csv"]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    assert!(ran.stdout.starts_with("NOT ALIGNED: 4 points"), "{}", ran.stdout);
    assert!(ran.stdout.contains("note: the point of line 5"), "{}", ran.stdout);
    platewash(dir, &["align", "touched.csv", "--tolerance", "0.01"]).done();
    // 1 is meant in millimetres: everything would fit.
    platewash(dir, &["align", "touched.csv", "--tolerance", "1"]).refused(2, &["--tolerance", "at most 0.05 m"]);
    for bad in ["0", "-1", "nan"] {
        platewash(dir, &["align", "touched.csv", "--tolerance", bad]).refused(2, &["--tolerance"]);
    }
    // Three points say what they cannot show.
    write(dir, &rows(3, 0.0));
    let ran = platewash(dir, &["align", "touched.csv"]).done();
    assert!(ran.stdout.contains("touch a fourth one"), "{}", ran.stdout);
}

#[test]
fn implausible_points_are_refused_with_a_remedy() {
    let folder = folder();
    let dir = folder.path();
    let refused = |text: &str, words: &[&str]| {
        write(dir, text);
        platewash(dir, &["align", "touched.csv"]).refused(2, &[&["touched.csv"], words].concat());
    };
    refused("", &["line 1", "it is empty"]);
    refused(HEADER, &["no rows"]);
    refused(&rows(2, 0.0), &["2 points", "at least 3"]);
    refused(
        &format!("{}p,1,2,3,4,5\n", rows(3, 0.0)),
        &["line 5", "found 6 columns; expected 7"],
    );
    refused(
        &format!("{}p,1,2,3,4,5,inf\n", rows(3, 0.0)),
        &["line 5", "touched_z_mm", "\"inf\""],
    );
    let line = "a,0,0,0,0,0,0\nb,0.1,0,0,100,0,0\nc,0.4,0,0,400,0,0\n";
    refused(&format!("{HEADER}{line}"), &["within 0.0 mm of one line"]);
    refused(
        &format!("{HEADER}{line}d,0.4,0,0,400,0,0\n"),
        &["points 2 and 3 are 0.0 mm apart"],
    );
    // Metres where millimetres are asked for, and the other way round.
    refused(
        &format!("{HEADER}a,0,0,0,0,0,0\nb,0.5,0,0,0.5,0,0\nc,0,0.5,0,0,0.5,0\n"),
        &["touched coordinates seem to be in metres; expected millimetres"],
    );
    refused(
        &format!("{HEADER}a,0,0,0,0,0,0\nb,500,0,0,500,0,0\nc,0,500,0,0,500,0\n"),
        &["drawn coordinates seem to be in millimetres; expected metres"],
    );
    // Clockwise in the drawing, the other way round at the table: the order is found out.
    refused(
        &format!("{HEADER}a,0,0,0,0,0,0\nb,0.5,0,0,0,300,0\nc,0,0.3,0,500,0,0\n"),
        &["upside down", "fit the drawn ones in another order, such as 0, 2, 1"],
    );
    platewash(dir, &["align", "none.csv"]).refused(2, &["none.csv: cannot be read"]);
    platewash(dir, &["align", "touched.csv", "--seed", "1"]).refused(2, &["--seed"]);
    platewash(dir, &["align", "touched.csv", "--point", "0", "nan", "0"])
        .refused(2, &["--point", "from -36000 to 36000"]);
}

/// Rows that were touched where they are drawn, but for the factor and the order of the touches \[m\].
fn touched_as(drawn: &[[f64; 3]], order: &[usize], factor: f64) -> String {
    let row = |(k, at): (&[f64; 3], &usize)| {
        let ([x, y, z], [u, v, w]) = (*k, drawn[*at].map(|m| 1e3 * factor * m));
        format!("p,{x},{y},{z},{u},{v},{w}\n")
    };
    HEADER.to_owned() + &drawn.iter().zip(order).map(row).collect::<String>()
}

#[test]
fn reports_an_ambiguous_fit() {
    let folder = folder();
    let dir = folder.path();
    let notes = |text: &str, code: i32| -> String {
        write(dir, text);
        let ran = platewash(dir, &["align", "touched.csv"]);
        assert_eq!(ran.code, code, "{}{}", ran.stdout, ran.stderr);
        ran.stdout
    };
    // A rectangle fits half a turn on as well, and the residuals are 0 both times.
    let rectangle = [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.3, 0.0], [0.0, 0.3, 0.0]];
    for order in [[0, 1, 2, 3], [2, 3, 0, 1]] {
        let said = notes(&touched_as(&rectangle, &order, 1.0), 0);
        assert!(
            said.contains("the marks look alike") && said.contains("such as 2, 3, 0, 1"),
            "{said}"
        );
    }
    // A stud at another height tells them apart.
    let mut table = rectangle.to_vec();
    table.push([0.1, 0.1, 0.05]);
    let said = notes(&touched_as(&table, &[0, 1, 2, 3, 4], 1.0), 0);
    assert!(!said.contains("look alike"), "{said}");
    // Nearly in line: what the tolerance hides is told.
    let narrow = [[0.0, 0.0, 0.0], [0.4, 0.04, 0.0], [0.9, 0.0, 0.0], [0.6, 0.0, 0.0]];
    let said = notes(&touched_as(&narrow, &[0, 1, 2, 3], 1.0), 0);
    assert!(said.contains("of one line: 1.0 mm of error beside it turns"), "{said}");
    // In centimetres no point is at fault, but the unit.
    let said = notes(&touched_as(&table, &[0, 1, 2, 3, 4], 0.1), 4);
    assert!(
        said.contains("90.00 % shorter than as drawn") && !said.contains("touch it again"),
        "{said}"
    );
}

#[test]
fn states_the_angle_of_an_upright_table_in_degrees() {
    let folder = folder();
    let dir = folder.path();
    // Drawn in x and y, touched in y and z.
    let rows: String = TABLE
        .iter()
        .map(|[x, y, z]| format!("p,{x},{y},{z},{},{},{}\n", 1e3 * z, 1e3 * x, 1e3 * y))
        .collect();
    write(dir, &(HEADER.to_owned() + &rows));
    let ran = platewash(dir, &["align", "touched.csv"]);
    assert_eq!(ran.code, 4);
    assert!(ran.stdout.starts_with("ALIGNED, OUT OF LEVEL: "), "{}", ran.stdout);
    assert!(ran.stdout.contains("out of level by 90.0°"), "{}", ran.stdout);
}

#[test]
fn rejects_foreign_tables_by_their_difference() {
    let folder = folder();
    let dir = folder.path();
    let good = rows(4, 0.0);
    for (text, words) in [
        (good.replace(',', ";"), ["line 1", "';'", "expected commas"]),
        (
            good.replace('.', ",").replace(',', ";"),
            ["line 1", "';'", "a point for decimals"],
        ),
        (good.replace(',', "\t"), ["line 1", "'\\t'", "expected commas"]),
        (
            good.replacen("0.2", "0,2", 1),
            ["line 2", "found 8 columns; expected 7", "decimals take a point"],
        ),
    ] {
        assert_ne!(text, good);
        write(dir, &text);
        platewash(dir, &["align", "touched.csv"]).refused(2, &words);
    }
    // Line ends and the mark of a spreadsheet are none of it.
    write(dir, &format!("\u{feff}{}", good.replace('\n', "\r\n")));
    platewash(dir, &["align", "touched.csv"]).done();
}

/// The IRB 120 with its link `base` elsewhere, in a file.
fn arm(dir: &Path, origin: &str) {
    let old = "<child link=\"base\"/>\n    <origin xyz=\"0 0 0\"/>";
    let text = IRB120_URDF.replace(old, &format!("<child link=\"base\"/>\n    <origin {origin}/>"));
    assert_ne!(text, IRB120_URDF);
    std::fs::write(dir.join("arm.urdf"), text).unwrap();
}

/// By hand: `base_link` stands at the origin of the drawing, and the pendant counts from 0.45 m above it.
const RAISED: &str =
    "a,0.6,-0.4,0,600,-400,-450\nb,0.9,-0.3,0,900,-300,-450\nc,0.8,0.5,0,800,500,-450\nd,0.5,0.2,0.08,500,200,-370\n";

#[test]
fn the_mount_of_the_root_link_is_found_where_the_pendant_counts_from_another_link() {
    let folder = folder();
    let dir = folder.path();
    arm(dir, "xyz=\"0 0 0.45\"");
    write(dir, &format!("{HEADER}{RAISED}"));
    let arguments = [
        "align",
        "touched.csv",
        "--urdf",
        "arm.urdf",
        "--point",
        "0.6",
        "-0.4",
        "0",
    ];
    let said = platewash(dir, &arguments).done().stdout;
    for words in [
        "T_world_base, where link 'base_link' stands in the drawing",
        "mount_m = [0.0, 0.0, 0.0]\n",
        "mount_link = \"root\"\n",
        "controller's base  link 'base', 450.0 mm above link 'base_link'; it stands at 0.000000, 0.000000, 0.450000 m\n",
        "0.600000, -0.400000, 0.000000; 600.000, -400.000, -450.000\n",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let answer = platewash(dir, &[&arguments[..], &["--json"]].concat()).done().json();
    assert_eq!(answer["robot"]["mount_link"], "root");
    assert!(answer["mount"]["position_m"][2].as_f64().unwrap().abs() < 1e-9);
    assert!((answer["controller_base"]["position_m"][2].as_f64().unwrap() - 0.45).abs() < 1e-9);
}

/// Without a description the mount is the pendant's, and the printed keys say so: the scenario with them has the arm where it stands.
#[test]
fn a_mount_without_a_description_says_that_it_is_the_pendants() {
    let folder = folder();
    let dir = folder.path();
    arm(dir, "xyz=\"0 0 0.45\"");
    write(dir, &format!("{HEADER}{RAISED}"));
    let said = platewash(dir, &["align", "touched.csv"]).done().stdout;
    let (_, keys) = said.split_once("in a scenario      ").unwrap();
    let (keys, rest) = keys.split_once("  tilt of the table").unwrap();
    assert!(
        keys.contains("mount_m = [0.0, 0.0, 0.45]") && keys.contains("mount_link = \"base\""),
        "{said}"
    );
    assert!(
        rest.contains("note: the mount is that of the base from which the pendant counts") && rest.contains("--urdf"),
        "{said}"
    );
    let text = format!(
        "{keys}urdf = \"arm.urdf\"\n[tool]\nlength_m = 0.15\n[layout]\npositions_m = [[0.3, 0.2]]\n[wash]\nheight_m = 0\n"
    );
    std::fs::write(dir.join("cell.toml"), text.replace("                     ", "")).unwrap();
    let scenario = Scenario::load(&dir.join("cell.toml").to_string_lossy()).unwrap();
    let mount = scenario.robot.mount(&scenario.arm().unwrap());
    assert!(mount.translation.vector.norm() < 1e-12, "{mount}");
}

/// By hand: `base_link` stands at (0.1, 0.2, 0) m, not turned; `base` is turned by half a turn, as on a UR.
#[test]
fn a_turned_base_turns_the_mount() {
    let folder = folder();
    let dir = folder.path();
    arm(dir, "rpy=\"0 0 3.141592653589793\"");
    let mut text = HEADER.to_owned();
    for (k, [x, y, z]) in TABLE.iter().enumerate() {
        writeln!(
            text,
            "p{k},{x},{y},{z},{},{},{}",
            -1e3 * (x - 0.1),
            -1e3 * (y - 0.2),
            1e3 * z
        )
        .unwrap();
    }
    write(dir, &text);
    std::fs::write(
        dir.join("cell.toml"),
        "[robot]\nurdf = \"arm.urdf\"\n[layout]\npositions_m = [[0.4, 0]]\n",
    )
    .unwrap();
    for arm in [["--urdf", "arm.urdf"], ["--scenario", "cell.toml"]] {
        let said = platewash(dir, &[&["align", "touched.csv"], &arm[..]].concat())
            .done()
            .stdout;
        assert!(said.contains("mount_m = [0.1, 0.2, 0.0]\n"), "{said}");
        assert!(
            said.contains("mount_rpy_deg = [0.0, 0.0, 0.0]\n") || said.contains("mount_rpy_deg = [0.0, 0.0, -0.0]\n"),
            "{said}"
        );
    }
    let robot = platewash(dir, &["robot", "--urdf", "arm.urdf"]).done().stdout;
    let words = "controller's base: link 'base', at the place of link 'base_link', turned by roll, pitch, yaw = (0, 0, 180.0)°\n";
    assert!(robot.contains(words), "{robot}");
}

/// Plates at (0.3, ±0.85) m, touched with a pendant that counts from a turned base.
#[test]
fn touched_plates_of_a_turned_base_are_refused_or_lie_where_they_were_touched() {
    let folder = folder();
    let dir = folder.path();
    arm(dir, "rpy=\"0 0 3.141592653589793\"");
    std::fs::write(
        dir.join("plates.csv"),
        "name,touched_x_mm,touched_y_mm,touched_z_mm\none,-300,-850,30\ntwo,-300,850,30\n",
    )
    .unwrap();
    let cell = |key: &str| {
        let text = format!(
            "[robot]\nurdf = \"arm.urdf\"\n[tool]\nlength_m = 0.15\n[layout]\nplate_file = \"plates.csv\"\n{key}[wash]\nheight_m = 0\n"
        );
        std::fs::write(dir.join("cell.toml"), text).unwrap();
        platewash(dir, &["layout", "--scenario", "cell.toml", "--json"])
    };
    cell("").refused(
        2,
        &[
            "(-0.3000, -0.8500, 0.0300) m",
            "(0.3000, 0.8500, 0.0300) m",
            "layout.touched_from",
        ],
    );
    let placed = cell("touched_from = \"base\"\n").done().json();
    for (k, expected) in [[0.3, 0.85], [0.3, -0.85]].iter().enumerate() {
        let at = &placed["plates"][k]["pose"]["position_m"];
        let off = |axis: usize| (at[axis].as_f64().unwrap() - expected[axis]).abs();
        assert!(off(0) < 1e-9 && off(1) < 1e-9, "{at}");
    }
}
