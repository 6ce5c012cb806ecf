//! Results of a proof besides its requirements: a certified value, a motion alone, the basis of the verdict.

use crate::maker::{good, irb120, resealed};
use platewash_bodies::clearance::exclusions;
use platewash_certificate::Requirement::{Clearance, JointSpeed, TipSpeed};
use platewash_certificate::{CertifyError, PairRule, ProveError, Status, certify, prove, prove_motion};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_motion::plan::Process;
use platewash_workcell::cancel::{CancelToken, Cancelled};
use platewash_workcell::tool::ToolBody;
use std::collections::BTreeSet;

#[test]
fn only_a_plan_whose_certificate_holds_is_certified() {
    let certified = certify(good(), &irb120()).unwrap();
    assert_eq!(certified.plan(), &good());
    assert_eq!(certified.certificate(), &prove(&good(), &irb120()).unwrap());
    let (plan, certificate) = certified.into_parts();
    assert!(plan.is_sealed() && certificate.passes());
    let mut changed = good();
    changed.knots.q_rad[77][2] += 0.01;
    let certificate = prove(&changed, &irb120()).unwrap();
    assert_eq!(
        certify(changed.clone(), &irb120()),
        Err(CertifyError::Fails(Box::new(certificate)))
    );
    changed.process = Process::Paper;
    assert_eq!(
        certify(changed, &irb120()),
        Err(CertifyError::Prove(ProveError::PaperRun))
    );
    // A seal that is broken is enough.
    let mut renamed = good();
    renamed.provenance.scenario = "another".to_owned();
    let refused = certify(renamed, &irb120()).unwrap_err().to_string();
    assert!(
        refused.ends_with("; the plan was changed after it was written: its hash does not match the contents"),
        "{refused}"
    );
}

#[test]
fn requirements_are_listed_once_in_order() {
    let checks = prove(&good(), &irb120()).unwrap().checks;
    assert!(checks.is_sorted_by(|a, b| a.requirement < b.requirement));
    assert_eq!(checks.len(), 25);
}

/// Without a word about washing, the sponge on the plates is in the way, and the tip is never faster.
#[test]
fn a_motion_without_washing_keeps_clear_at_all_times() {
    let (plan, token) = (good(), CancelToken::new());
    let whole = prove(&plan, &irb120()).unwrap();
    let proof = prove_motion(&plan.knots, &plan.job, &irb120(), &token).unwrap();
    let of = |name| proof.checks.iter().find(|c| c.requirement == name).unwrap();
    assert_eq!(of(JointSpeed).status, whole.check(JointSpeed).unwrap().status);
    assert_eq!(of(TipSpeed).measure, whole.check(TipSpeed).unwrap().measure);
    assert_eq!((proof.checks.len(), of(Clearance).status), (6, Status::Violated));
    assert!(proof.clearance.iter().all(|line| line.rule == PairRule::Clearance));
    let worst = of(Clearance).worst.pair.clone().unwrap();
    assert!(worst[0] == "sponge" && worst[1].starts_with("plate "), "{worst:?}");
    // The way there alone, which ends over the plate.
    let mut there = plan.knots.clone();
    let end = plan
        .knots
        .t_s
        .iter()
        .position(|t| *t == plan.segments[0].t_end_s)
        .unwrap();
    there.t_s.truncate(end + 1);
    there.q_rad.truncate(end + 1);
    there.qd_rad_s.truncate(end + 1);
    let proof = prove_motion(&there, &plan.job, &irb120(), &token).unwrap();
    assert!(
        proof.checks.iter().all(|c| c.status == Status::Proved),
        "{:?}",
        proof.checks
    );
    let pairs: BTreeSet<_> = whole.clearance.iter().map(|line| &line.pair).collect();
    assert_eq!(
        proof.clearance.iter().map(|line| &line.pair).collect::<BTreeSet<_>>(),
        pairs
    );
    assert_eq!(proof.clearance.len(), pairs.len());
    token.cancel();
    let given_up = prove_motion(&there, &plan.job, &irb120(), &token);
    assert_eq!(given_up, Err(ProveError::Cancelled(Cancelled)));
}

#[test]
fn reports_the_basis_of_the_verdict() {
    let mut plan = good();
    let mut post = crate::maker::post("post");
    post.pose.translation.x = -0.9;
    plan.job.workcell.obstacles.push(post);
    plan.job.home_rad[1][5] = 0.5;
    let certificate = prove(&resealed(plan), &irb120()).unwrap();
    let table = format!("{certificate:#}");
    let told = table.split("\nthe proof rests on\n").nth(1).unwrap().lines();
    let told: Vec<_> = told.take_while(|line| !line.is_empty()).collect();
    let expected = [
        "  arm           \"irb120\", description ",
        "  tool          \"handle\", a cylinder of radius 20 and length 125 mm at (0, 0, 62.5) mm of the flange; tip at (0, 0, 150) mm of the flange",
        "  tool mount    on tool0 along its z",
        "  sponge        radius 25 and height 25 mm, compressed by 5 mm (assumed), at (0, 0, 137.5) mm of the flange",
        "  plates        2 of radius 145 mm, 20 mm thick, faces 30 mm above 0: 1 at (0.303086256, -0.212223281), 2 at (0.320429399, 0.185) m",
        "  obstacles     \"floor\", all below 0; \"post\", a cylinder of radius 20 and length 600 mm at (-0.9, 0, 0.3) m",
        "  home          0, 0, 10, 0, 70, 0 ° at the start, 0, 0, 10, 0, 70, 28.6478898 ° at the end",
        "  limits        joint positions and speeds from the description; joint accelerations 8, 8, 8, 8, 8, 8 rad/s² (assumed); tip speed 1 m/s, tip acceleration 8 m/s² (assumed)",
        "  requirements  swept 99.5 %, clearance 10 mm, tilt 15 °, wash speed 0.25 m/s, wash acceleration 4 m/s², no overlapping plates, in any order",
        "  contact       not required: a point counts as swept where the sponge's face touches it, pressed or not",
        "  assumed       the arm matches its description and follows the planned motion exactly",
        "                the joints and the tip reach the stated accelerations; no published values are known",
    ];
    for (line, expected) in told.iter().zip(expected) {
        assert!(line.starts_with(expected), "{line}\n{expected}");
    }
    assert_eq!(told.len(), 17, "{table}");
    assert!(
        told[15].starts_with("  not checked   disabled by the SRDF: ")
            && told[15].ends_with("; stands on the ground: \"base_link\" – \"floor\""),
        "{table}"
    );
    assert_eq!(
        told[16],
        "  checked once  neither moves: \"base_link\" – \"post\"; stays at its height: \"link_1\" – \"floor\""
    );
    let robot = irb120();
    let hash = &robot.sha256()[..12];
    assert!(
        told[0].contains(hash) && told[0].ends_with("; mounted at the origin"),
        "{table}"
    );
    // The same in JSON, and nothing shortened.
    let data = serde_json::to_value(&certificate).unwrap();
    assert_eq!(data["rests_on"]["workcell"]["arm"]["urdf_sha256"], irb120().sha256());
    assert_eq!(data["rests_on"]["workcell"]["obstacles"][1]["name"], "post");
    assert_eq!(data["rests_on"]["plates"].as_array().unwrap().len(), 2);
    assert_eq!(data["rests_on"]["assumptions"].as_array().unwrap().len(), 5);
}

/// The proof does not depend on the planner: of this project, the crate uses only the arm, the world, its bodies and motions as data.
#[test]
fn the_certificate_does_not_depend_on_the_planner() {
    let manifest: toml::Table = include_str!("../Cargo.toml").parse().unwrap();
    for section in ["dependencies", "dev-dependencies"] {
        let ours = manifest[section]
            .as_table()
            .unwrap()
            .keys()
            .filter(|name| name.starts_with("platewash"));
        let ours: Vec<_> = ours.map(String::as_str).collect();
        let allowed: &[&str] = match section {
            "dependencies" => &[
                "platewash-bodies",
                "platewash-kinematics",
                "platewash-motion",
                "platewash-workcell",
            ],
            _ => &["platewash-fixtures"],
        };
        assert_eq!(ours, allowed, "{section}");
    }
    assert!(!manifest.contains_key("build-dependencies") && !manifest.contains_key("target"));
}

/// Joint 6 turns a round body of the tool on the spot beside link 5, so that no moment need be judged; but the pair is.
#[test]
fn a_round_tool_in_the_link_behind_the_flange_is_in_the_way() {
    let mut plan = good();
    let world = &mut plan.job.workcell;
    world.tool.bodies.push(ToolBody {
        name: "ring".to_owned(),
        shape: Shape::Cylinder {
            radius_m: 0.03,
            half_length_m: 0.02,
        },
        pose: Pose::translation(0.0, 0.0, 0.0),
    });
    world.exclusions = exclusions(&irb120(), &world.tool, &world.obstacles).unwrap();
    let pair = ["link_5".to_owned(), "ring".to_owned()];
    assert!(world.exclusions.iter().any(|left_out| left_out.pair == pair));
    let certificate = prove(&resealed(plan), &irb120()).unwrap();
    let check = certificate.check(Clearance).unwrap();
    assert_eq!(check.status, Status::Violated);
    assert_eq!(check.worst.pair.as_ref(), Some(&pair), "{check:?}");
    // In front of the flange it is not, and has no line.
    let whole = prove(&good(), &irb120()).unwrap();
    assert!(whole.clearance.iter().all(|line| line.pair != ["link_5", "handle"]));
}
