//! Arms with joints that are not of the chain: grippers and rails that are held still, and what follows an axis.

use super::other_arms::{UR5, UR5_START, cell};
use super::*;

/// A description with more elements, in a file.
fn with(dir: &Path, urdf: &str, more: &str) -> String {
    let path = dir.join("arm.urdf");
    std::fs::write(&path, urdf.replace("</robot>", &format!("{more}</robot>"))).unwrap();
    path.to_str().unwrap().to_owned()
}

/// A link with a box on a joint that slides.
fn slide(name: &str, parent: &str, child: &str, rest: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"prismatic\"><parent link=\"{parent}\"/><child link=\"{child}\"/><origin xyz=\"0.04 0 0\"/>\
         <axis xyz=\"0 1 0\"/><limit lower=\"-0.5\" upper=\"0.5\" velocity=\"1\"/>{rest}</joint>"
    )
}

const BOX: &str = "<collision><geometry><box size=\"0.02 0.02 0.02\"/></geometry></collision>";

/// Two fingers on the flange of the built-in arm, the second one as far on the other side.
fn gripper() -> String {
    let follows = "<mimic joint=\"finger\" multiplier=\"-1\"/>";
    let links = format!("<link name=\"left\">{BOX}</link><link name=\"right\">{BOX}</link>");
    links + &slide("finger", "flange", "left", "") + &slide("other", "flange", "right", follows)
}

/// A link on a joint that follows joint 2.
fn balancer() -> String {
    let follows = "<mimic joint=\"joint_2\" multiplier=\"-0.25\"/>";
    format!("<link name=\"cylinder\">{BOX}</link>") + &slide("balancer", "link_1", "cylinder", follows)
}

const IRB120: &str = platewash::kinematics::irb120::IRB120_URDF;

fn one_plate(dir: &Path) -> String {
    let old = ("count = 4", "count = 1");
    kitchen(dir, &[old]).to_str().unwrap().to_owned()
}

#[test]
fn a_gripper_is_held_still_from_the_plan_to_the_program() {
    let folder = folder();
    let dir = folder.path();
    let (arm, cell) = (
        with(
            dir,
            &IRB120.replacen("name=\"irb120\"", "name=\"abb_irb120\"", 1),
            &gripper(),
        ),
        one_plate(dir),
    );
    let of_arm = ["--scenario", &cell, "--urdf", &arm];
    let said = |verb: &[&str], more: &[&str]| platewash(dir, &[verb, more].concat());
    said(&["plan"], &of_arm).refused(
        2,
        &[
            "arm.urdf",
            "joint 'finger' is prismatic",
            "--fix finger=VALUE, robot.fixed",
        ],
    );
    let held = [&of_arm[..], &["--fix", "finger=0.03"]].concat();
    said(&["plan", "-q"], &held).done();
    let plan = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    let arm_of = |plan: &str| serde_json::from_str::<Value>(plan).unwrap()["job"]["workcell"]["arm"].clone();
    assert_eq!(
        arm_of(&plan)["fixed"],
        serde_json::json!({"finger": 0.03, "other": -0.03})
    );

    let verified = said(&["verify", "out/plan.json", "--details", "--urdf", &arm], &[]).done();
    assert!(verified.stdout.starts_with("PROVED"), "{}", verified.stdout);
    assert!(
        verified
            .stdout
            .contains("held still: \"finger\" at 0.03, \"other\" at -0.03"),
        "{}",
        verified.stdout
    );
    let with_fix = |fix: &str| said(&["verify", "out/plan.json", "--urdf", &arm, "--fix", fix], &[]);
    with_fix("finger=0.03").done();
    with_fix("finger=0.02").refused(2, &["out/plan.json", "--fix", "\"finger\" at 0.03", "leave it out"]);
    let against = said(&["verify", "out/plan.json", "--against", &cell, "--urdf", &arm], &[]);
    assert!(against.done().stdout.contains("no field differs"));

    // The same in the file of the scenario, to the byte.
    let stated = std::fs::read_to_string(&cell).unwrap();
    let stated = stated.replacen(
        "[robot]\n",
        &format!("[robot]\nurdf = {arm:?}\nfixed = {{ finger = 0.03 }}\n"),
        1,
    );
    std::fs::write(dir.join("stated.toml"), stated).unwrap();
    platewash(dir, &["plan", "-q", "--scenario", "stated.toml", "--out", "same"]).done();
    assert!(plan == std::fs::read_to_string(dir.join("same/plan.json")).unwrap());

    for target in ["rapid", "ros2"] {
        let out = dir.join(target);
        let out = out.to_str().unwrap();
        said(
            &[
                "export",
                "out/plan.json",
                "--to",
                target,
                "--urdf",
                &arm,
                "-q",
                "--out",
                out,
            ],
            &[],
        )
        .done();
        let mut programs = names(&dir.join(target)).into_iter();
        let states = |name: String| {
            let text = std::fs::read_to_string(dir.join(target).join(name)).unwrap();
            text.replace('\n', " ").contains("held still: \"finger\" at 0.03")
        };
        assert!(programs.any(states), "{:?}", names(&dir.join(target)));
    }
}

/// Another position of a plan that is held makes it one of another arm.
#[test]
fn a_plan_with_another_position_is_not_of_the_arm() {
    let folder = folder();
    let dir = folder.path();
    let (arm, cell) = (with(dir, IRB120, &gripper()), one_plate(dir));
    platewash(
        dir,
        &[
            "plan",
            "-q",
            "--scenario",
            &cell,
            "--urdf",
            &arm,
            "--fix",
            "finger=0.03",
        ],
    )
    .done();
    let plan = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    for (from, to, words) in [
        (
            "\"finger\":0.03,\"other\":-0.03",
            "\"finger\":0.02,\"other\":-0.02",
            "the plan is for the arm",
        ),
        (
            "\"finger\":0.03,\"other\":-0.03",
            "\"finger\":0.03,\"joint_1\":0",
            "joint 'joint_1' cannot be held still",
        ),
        (
            "\"fixed\":{\"finger\":0.03,\"other\":-0.03},",
            "",
            "joint 'finger' is prismatic",
        ),
        ("\"finger\":0.03,", "\"fin\\u202Eger\":0.03,", "job.workcell.arm.fixed"),
    ] {
        assert!(plan.contains(from));
        std::fs::write(dir.join("other.json"), plan.replace(from, to)).unwrap();
        platewash(dir, &["verify", "other.json", "--urdf", &arm]).refused(2, &["other.json", words]);
    }
}

/// A rail carries the arm; the fixture stands where it is held, and all poses with it.
#[test]
fn a_rail_is_held_still() {
    let folder = folder();
    let dir = folder.path();
    let ur5 = std::fs::read_to_string(UR5).unwrap();
    let root = platewash::RobotModel::from_urdf(&ur5, &platewash::kinematics::urdf::MeshSource::none()).unwrap();
    let base = root.links()[0].name.clone();
    let rail = format!(
        "<link name=\"rail\"/>{}",
        slide("rail_joint", "rail", &base, "").replace("0.04 0 0", "0 0 0")
    );
    let arm = with(dir, &ur5, &rail);
    let pose = |more: &[&str]| {
        let fk = ["fk", "--deg", "0", "-90", "90", "-90", "-90", "0", "--json"];
        let told = platewash(dir, &[&fk[..], more].concat()).done().json();
        told["frames"].to_string() + &told.to_string()
    };
    let at = |position: &str| pose(&["--urdf", &arm, "--fix", position]);
    assert_ne!(at("rail_joint=0.25"), at("rail_joint=-0.25"));
    let cell = cell(dir, UR5_START, "[[0.45, 0.4]]", 0.1);
    let cell = cell.to_str().unwrap();
    let run = |rail: &str| {
        let all = [
            "run",
            "--scenario",
            cell,
            "--urdf",
            &arm,
            "--fix",
            rail,
            "--out",
            "o",
            "--json",
        ];
        platewash(dir, &all).done().json()
    };
    assert_eq!(run("rail_joint=0.25")["verdict"], "swept");
    let verified = platewash(dir, &["verify", "o/plan.json", "--urdf", &arm]).done();
    assert!(verified.stdout.starts_with("PROVED"), "{}", verified.stdout);
    platewash(
        dir,
        &[
            "fk",
            "--deg",
            "0",
            "0",
            "0",
            "0",
            "0",
            "0",
            "--urdf",
            &arm,
            "--fix",
            "rail_joint=0.75",
        ],
    )
    .refused(2, &["'rail_joint' is fixed at 0.75, beyond its limits -0.5 … 0.5"]);
}

#[test]
fn joints_that_cannot_be_held_are_refused_by_name() {
    let folder = folder();
    let dir = folder.path();
    let arm = with(dir, IRB120, &(gripper() + &balancer()));
    let robot = |more: &[&str]| platewash(dir, &[&["robot", "--urdf", &arm][..], more].concat());
    let finger = ["--fix", "finger=0.01"];
    for (fix, words) in [
        (
            "joint_3=0.1",
            "joint 'joint_3' cannot be held still (--fix, robot.fixed): it is one of the six axes",
        ),
        (
            "thumb=0",
            "joint 'thumb' cannot be held still (--fix, robot.fixed): the description has no joint",
        ),
        (
            "balancer=0",
            "joint 'balancer' cannot be held still (--fix, robot.fixed): it follows 'joint_2'",
        ),
        ("other=0.01", "joint 'other' is fixed elsewhere than at -0.01"),
        ("finger=0.02", "joint 'finger' is stated twice"),
        ("finger", "finger_joint=0.02"),
        ("tilt=inf", "finger_joint=0.02"),
    ] {
        robot(&[&finger[..], &["--fix", fix]].concat()).refused(2, &[words]);
    }
    let told = robot(&finger).done();
    assert!(
        told.stdout.contains("held still: finger at 0.01, other at -0.01"),
        "{}",
        told.stdout
    );
    assert!(
        told.stdout.contains(
            "links left out, as joints carry them that follow an axis: 'cylinder' (joint 'balancer' follows 'joint_2')"
        ),
        "{}",
        told.stdout
    );
    platewash(dir, &["edit", "--fix", "finger=0.01"]).refused(2, &["--fix", "robot.fixed"]);
    platewash(dir, &["robot", "--fix", "finger=0.01"]).refused(2, &["robot.fixed needs a robot.urdf"]);
    platewash(dir, &["study", "run", "x.toml", "--fix", "finger=0.01"]).refused(2, &["--fix", "the study file states"]);
}

/// What follows an axis is left out by name, where the verdict is read.
#[test]
fn what_follows_an_axis_is_named_in_the_verdict() {
    let folder = folder();
    let dir = folder.path();
    let (arm, cell) = (with(dir, IRB120, &balancer()), one_plate(dir));
    let report = platewash(dir, &["run", "--scenario", &cell, "--urdf", &arm, "--json"])
        .done()
        .json();
    let clause = "; links that are not judged, as joints carry them that follow an axis: 'cylinder'";
    assert!(
        report["headline"].as_str().unwrap().contains(clause),
        "{}",
        report["headline"]
    );
    let verified = platewash(dir, &["verify", "out/plan.json", "--urdf", &arm, "--details"])
        .done()
        .stdout;
    assert!(verified.lines().next().unwrap().contains(clause), "{verified}");
    assert!(
        verified.contains("'cylinder' (joint 'balancer' follows 'joint_2')"),
        "{verified}"
    );
    let still = dir.join("still.csv");
    std::fs::write(
        &still,
        "t_s,joint_1,joint_2,joint_3,joint_4,joint_5,joint_6\n0,0,0,0,0,0,0\n1,0.1,0,0,0,0,0\n",
    )
    .unwrap();
    let proved = platewash(dir, &["prove-motion", "still.csv", "--urdf", &arm])
        .done()
        .stdout;
    assert!(proved.lines().next().unwrap().contains(clause), "{proved}");
}

/// Positions of joints can be an axis of a study, or a key of its rows.
#[test]
fn a_study_varies_positions_that_are_held() {
    let folder = folder();
    let dir = folder.path();
    let arm = with(dir, IRB120, &gripper());
    let cell = std::fs::read_to_string(one_plate(dir)).unwrap();
    let cell = cell.replacen("[robot]\n", &format!("[robot]\nurdf = {arm:?}\n"), 1);
    std::fs::write(dir.join("cell.toml"), cell).unwrap();
    let head = "format = \"platewash-study/1\"\nname = \"s\"\nscenario = \"cell.toml\"\nplans = \"all\"\n";
    let axis = "[[axis]]\nkey = \"robot.fixed\"\nvalues = [{ finger = 0.02 }, { finger = 0.03 }, { thumb = 0.03 }]\n";
    let listed = "[[rows]]\nrobot.fixed.finger = 0.02\n[[rows]]\nrobot.fixed = { finger = 0.03 }\n[[rows]]\n[rows.robot.fixed]\nthumb = 0.03\n";
    for (name, rows) in [("axis", axis), ("listed", listed)] {
        std::fs::write(dir.join("study.toml"), format!("{head}{rows}")).unwrap();
        platewash(dir, &["study", "run", "study.toml", "--out", name, "-q"]);
        let rows = std::fs::read_to_string(dir.join(name).join("rows.jsonl")).unwrap();
        let mut rows: Vec<Value> = rows.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        rows.sort_by_key(|row| row["index"].as_u64());
        let outcomes: Vec<_> = rows.iter().map(|row| row["outcome"].as_str().unwrap()).collect();
        assert_eq!(outcomes, ["proved", "proved", "error"], "{name}: {rows:?}");
        let held: Vec<_> = rows.iter().map(|row| row["axes"]["robot.fixed"].to_string()).collect();
        assert_eq!(
            held,
            [r#"{"finger":0.02}"#, r#"{"finger":0.03}"#, r#"{"thumb":0.03}"#],
            "{name}"
        );
        let row = platewash(dir, &["study", "scenario", name, "--row", "1"]).done().stdout;
        assert!(row.contains("fixed = { finger = 0.03 }"), "{row}");
    }
    let wrong = format!("{head}[[axis]]\nkey = \"robot.fixed\"\nvalues = [{{ finger = \"far\" }}]\n");
    std::fs::write(dir.join("study.toml"), wrong).unwrap();
    platewash(dir, &["study", "run", "study.toml", "--out", "wrong"]).refused(2, &["robot.fixed", "tables of numbers"]);
}
