//! Dry runs: the same paths in the air, proved, never a washing, and refused wherever they are not what they say.

use crate::shipped;
use platewash::bodies::assembly;
use platewash::certificate::{Status, Verdict, differences};
use platewash::motion::dry_run::{DryRunError, dry_run_terms, least_height_m};
use platewash::planner::{PlannedJob, Watch, plan_in_order};
use platewash::simulator::simulate::PlateVerdict;
use platewash::workcell::dry_run::DryRun;
use platewash::workcell::job::TermsError;
use platewash::workcell::{Exclusion, ExclusionReason, ObstacleShape};
use platewash::{
    CancelToken, Certificate, ClearanceModel, Plan, ProveError, Requirement, Scenario, SimulationReport,
    SimulationVerdict, WashJob, WashReport, plan, prove, simulate,
};
use std::sync::LazyLock;

/// The kitchen's job and its plan.
static PARENT: LazyLock<&(WashJob, Plan)> = LazyLock::new(|| shipped::planned("kitchen"));

fn parent(seed: u64) -> (WashJob, Plan) {
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.seed = seed;
    planned(&scenario)
}

fn planned(scenario: &Scenario) -> (WashJob, Plan) {
    let job = scenario.job().unwrap();
    let plan = plan(&job).unwrap().plan;
    (job, plan)
}

fn dry_run_of((job, parent): &(WashJob, Plan), height_m: f64, speed_m_s: f64) -> PlannedJob {
    let terms = dry_run_terms(parent, job.arm(), height_m, speed_m_s).unwrap();
    let raised = WashJob::new(job.shared_arm(), terms).unwrap();
    plan_in_order(
        &raised,
        &parent.order,
        &parent.wash_paths,
        &Watch::silent(&CancelToken::new()),
    )
    .unwrap()
}

/// Its dry run at 50 mm.
static DRY_RUN: LazyLock<Plan> = LazyLock::new(|| dry_run_of(&PARENT, 0.05, 0.1).plan);

fn dry_run() -> Plan {
    DRY_RUN.clone()
}

fn judged(plan: &Plan) -> Certificate {
    prove(plan, PARENT.0.arm()).unwrap()
}

/// Plates that lean are raised along their own axes, so that the next one lies in another direction: the paths are the parent's all the same.
#[test]
fn wash_paths_on_tilted_plates_equal_the_parents() {
    let rack = shipped::planned("rack");
    let raised = dry_run_of(rack, 0.024, 0.1).plan;
    assert_eq!(raised.wash_paths, rack.1.wash_paths);
    assert_eq!(prove(&raised, rack.0.arm()).unwrap().verdict, Verdict::Pass);
}

/// A change, sealed again, so that the hash does not give it away.
fn changed(change: impl FnOnce(&mut Plan)) -> Plan {
    let mut plan = dry_run();
    let before = plan.clone();
    change(&mut plan);
    assert_ne!(plan, before, "the edit took no effect");
    plan.hash = plan.seal().ok();
    plan
}

#[test]
fn a_dry_run_is_proved_and_never_reads_as_a_washing() {
    let plan = dry_run();
    let certificate = judged(&plan);
    assert_eq!(certificate.verdict, Verdict::Pass, "{certificate}");
    let hash = PARENT.1.hash.as_ref().unwrap();
    let expected = format!(
        "DRY RUN of {}: 50 mm above the plates, nothing is washed; PROVED: ",
        &hash[..12]
    );
    assert!(certificate.headline.starts_with(&expected), "{}", certificate.headline);
    let mut compared = certificate.clone();
    compared.set_parent_compared();
    let not_compared = format!(
        "{}; not checked: whether it follows the plan that it names",
        compared.headline
    );
    assert_eq!(certificate.headline, not_compared);
    assert_eq!(certificate.plates_washed(), 0);
    assert_eq!(certificate.check(Requirement::DryRun).unwrap().status, Status::Proved);
    let table = format!("{certificate:#}");
    assert!(
        table.contains("would be swept, at least") && table.contains(hash.as_str()),
        "{table}"
    );
    assert!(!table.contains("\nswept, at least"), "{table}");
    let report = WashReport::new(&dry_run_of(&PARENT, 0.05, 0.1), &[], certificate);
    assert_eq!(report.verdict, platewash::Verdict::DryRun);
    assert!(report.headline.starts_with(&expected[..60]), "{}", report.headline);
    assert!(
        report
            .headline
            .contains(", each swept in the air over at least 99.5 % (99.5 % required), "),
        "{}",
        report.headline
    );
    // The plan file carries it through, and is sealed with it.
    let read = Plan::from_json(&plan.to_json().unwrap()).unwrap();
    assert!(read == plan && read.is_sealed());
}

/// The motion of the washing, on plates that it says are raised: the real ones would lie inside the floor.
#[test]
fn a_washing_that_calls_itself_a_dry_run_is_refused() {
    let (job, mut plan) = PARENT.clone();
    let dry_run = DryRun {
        parent: plan.hash.clone().unwrap(),
        height_m: 0.05,
    };
    let real = plan.job.plates.iter().enumerate();
    let standing = real.map(|(i, plate)| DryRun::plate_as_obstacle(i, &dry_run.lowered(plate)));
    plan.job.workcell.obstacles.extend(standing.collect::<Vec<_>>());
    plan.job.workcell.exclusions = assembly::own_exclusions(&plan.job.workcell, job.arm()).unwrap();
    plan.job.dry_run = Some(dry_run);
    plan.hash = plan.seal().ok();
    let certificate = judged(&plan);
    assert_eq!(certificate.verdict, Verdict::Fail, "{certificate}");
    let check = certificate.check(Requirement::DryRun).unwrap();
    assert_eq!(check.status, Status::Violated);
    let told: Vec<_> = check.discrepancies.iter().map(|wrong| wrong.what.as_str()).collect();
    assert!(
        told.iter()
            .all(|what| what.starts_with("real plates: ") && what.contains("over the floor")),
        "{told:?}"
    );
    assert_eq!(told.len(), plan.job.plates.len());
}

#[test]
fn a_dry_run_repeats_its_parent_slower_and_higher() {
    let (plan, parent) = (dry_run(), &PARENT.1);
    assert_eq!((&plan.order, &plan.wash_paths), (&parent.order, &parent.wash_paths));
    assert_eq!(plan.job.home_rad, parent.job.home_rad);
    for (raised, real) in plan.job.plates.iter().zip(&parent.job.plates) {
        assert_eq!(raised.centre_xy(), real.centre_xy());
        assert!((raised.centre().z - real.centre().z - 0.05).abs() < 1e-15);
    }
    let fastest = judged(&plan).check(Requirement::TipSpeed).unwrap().measure.unwrap();
    assert!(
        fastest.bound.unwrap() <= 0.1 * (1.0 + 1e-9) && fastest.limit == 0.1,
        "{fastest:?}"
    );
    assert!(plan.duration_s() > 2.0 * parent.duration_s());
    // The same input gives the same bytes.
    let again = dry_run_of(&PARENT, 0.05, 0.1).plan;
    assert_eq!(plan.to_json().unwrap(), again.to_json().unwrap());
}

/// Independently of the certificate: sampled, nothing ever comes nearer to a real plate than the clearance, the sponge included.
#[test]
fn a_dry_run_keeps_clear_of_the_real_plates() {
    let (plan, (job, parent)) = (dry_run(), &*PARENT);
    let model = ClearanceModel::new(job.arm(), &parent.job.workcell, &parent.job.plates).unwrap();
    let names: Vec<_> = model.pair_names();
    let of_plates: Vec<usize> = (0..names.len()).filter(|k| names[*k].1.starts_with("plate ")).collect();
    assert!(of_plates.iter().any(|k| names[*k].0 == "sponge"), "{names:?}");
    let motion = plan.knots.motion().unwrap();
    let mut least = f64::INFINITY;
    for k in 0..=1500 {
        let q = motion.at(motion.duration_s() * f64::from(k) / 1500.0).unwrap().q;
        let all = model.all(&q);
        least = of_plates.iter().map(|k| all[*k].distance_m).fold(least, f64::min);
    }
    // At 50 mm, less what a tilt of 15° takes off a sponge of 25 mm.
    assert!((0.04..0.05).contains(&least), "{least}");
}

#[test]
fn other_seeds_heights_and_speeds_are_proved_too() {
    for (seed, height_m, speed_m_s) in [(2, 0.02, 0.25), (3, 0.1, 0.05), (4, 0.05, 1.0)] {
        let parent = parent(seed);
        let planned = dry_run_of(&parent, height_m, speed_m_s);
        let certificate = prove(&planned.plan, parent.0.arm()).unwrap();
        assert!(certificate.passes(), "seed {seed}: {certificate}");
        assert_eq!(planned.plan.order, parent.1.order);
        assert_eq!(planned.plan.wash_paths, parent.1.wash_paths);
    }
}

#[test]
fn a_dry_run_with_false_real_plates_fails() {
    let fails = |name: &str, plan: &Plan| {
        let certificate = judged(plan);
        let check = certificate.check(Requirement::DryRun).unwrap();
        assert_eq!(check.status, Status::Violated, "{name}: {certificate}");
        assert!(
            !certificate.passes() && certificate.headline.contains("NOT PROVED"),
            "{name}"
        );
        assert!(
            certificate.headline.starts_with("DRY RUN of "),
            "{name}: {}",
            certificate.headline
        );
    };
    let real = |plan: &mut Plan, k: usize| {
        let name = DryRun::real_name(k);
        let obstacles = &mut plan.job.workcell.obstacles;
        obstacles.iter().position(|obstacle| obstacle.name == name).unwrap()
    };
    fails(
        "one left out",
        &changed(|plan| {
            let at = real(plan, 2);
            plan.job.workcell.obstacles.remove(at);
            let name = DryRun::real_name(2);
            plan.job.workcell.exclusions.retain(|pair| !pair.pair.contains(&name));
        }),
    );
    fails(
        "one lower than it is",
        &changed(|plan| {
            let at = real(plan, 1);
            plan.job.workcell.obstacles[at].pose.translation.z -= 0.005;
        }),
    );
    fails(
        "one elsewhere",
        &changed(|plan| {
            let at = real(plan, 0);
            plan.job.workcell.obstacles[at].pose.translation.x += 1e-6;
        }),
    );
    fails(
        "one smaller",
        &changed(|plan| {
            let at = real(plan, 3);
            let ObstacleShape::Convex(platewash::kinematics::geometry::Shape::Cylinder { radius_m, .. }) =
                &mut plan.job.workcell.obstacles[at].shape
            else {
                panic!("a plate is a cylinder");
            };
            *radius_m -= 1e-6;
        }),
    );
    fails(
        "a height that is not so",
        &changed(|plan| plan.job.dry_run.as_mut().unwrap().height_m = 0.06),
    );
    fails(
        "two that change places",
        &changed(|plan| {
            let (a, b) = (real(plan, 0), real(plan, 1));
            let obstacles = &mut plan.job.workcell.obstacles;
            let pose = obstacles[a].pose;
            obstacles[a].pose = obstacles[b].pose;
            obstacles[b].pose = pose;
        }),
    );
}

/// The motion of a washing over a real plate is refused for what it does, not for its words.
#[test]
fn a_motion_that_goes_down_to_the_real_plates_breaks_the_clearance() {
    let raised = dry_run();
    let parent = &PARENT.1;
    let down = changed(|plan| {
        plan.knots.clone_from(&parent.knots);
        plan.segments.clone_from(&parent.segments);
    });
    assert_eq!(down.job, raised.job);
    let certificate = judged(&down);
    let broken: Vec<_> = certificate.broken().map(|check| check.requirement).collect();
    for requirement in [
        Requirement::Clearance,
        Requirement::TipSpeed,
        Requirement::ContactHeight,
    ] {
        assert!(broken.contains(&requirement), "{certificate}");
    }
}

#[test]
fn rejects_an_invalid_parent_of_a_dry_run() {
    let error = |parent: &str, height_m: f64| {
        let mut plan = dry_run();
        *plan.job.dry_run.as_mut().unwrap() = DryRun {
            parent: parent.to_owned(),
            height_m,
        };
        prove(&plan, PARENT.0.arm()).unwrap_err()
    };
    let hash = PARENT.1.hash.as_ref().unwrap();
    for bad in ["", "abc", &hash.to_uppercase(), &format!("{hash}0"), "\u{1b}[31m"] {
        let said = error(bad, 0.05);
        assert!(matches!(said, ProveError::Job(TermsError::Parent)), "{said}");
    }
    for bad in [0.0, -0.05, f64::NAN, f64::INFINITY, 1e9] {
        assert!(
            matches!(error(hash, bad), ProveError::Job(TermsError::Number { .. })),
            "{bad}"
        );
    }
}

#[test]
fn refuses_impossible_dry_runs() {
    let (job, parent) = &*PARENT;
    let refused = |parent: &Plan, height_m: f64, speed_m_s: f64| {
        dry_run_terms(parent, job.arm(), height_m, speed_m_s).unwrap_err()
    };
    for bad in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e4] {
        assert!(matches!(refused(parent, bad, 0.1), DryRunError::Height { .. }), "{bad}");
    }
    let least = least_height_m(&parent.job);
    assert!(matches!(refused(parent, least - 1e-6, 0.1), DryRunError::TooLow { .. }));
    assert!(dry_run_terms(parent, job.arm(), least, 0.1).is_ok());
    for bad in [0.0, -0.1, f64::NAN, f64::INFINITY, 1.0 + 1e-9] {
        assert!(matches!(refused(parent, 0.05, bad), DryRunError::Speed { .. }), "{bad}");
    }
    assert!(matches!(refused(&dry_run(), 0.05, 0.1), DryRunError::OfDryRun { .. }));
    let mut edited = parent.clone();
    edited.job.requirements.clearance_m = 0.009;
    assert_eq!(refused(&edited, 0.05, 0.1), DryRunError::NotSealed);
    edited.hash = None;
    assert_eq!(refused(&edited, 0.05, 0.1), DryRunError::NotSealed);
    let mut named = parent.clone();
    named.job.workcell.tool.bodies[0].name = DryRun::real_name(0);
    named.hash = named.seal().ok();
    assert!(matches!(refused(&named, 0.05, 0.1), DryRunError::NameTaken { .. }));
    let paper = Scenario::load("paper-appendix").unwrap().paper_job().unwrap();
    let paper = platewash::paper::run(&paper).unwrap().plan().unwrap();
    assert_eq!(refused(&paper, 0.05, 0.1), DryRunError::PaperRun);
}

#[test]
fn rejects_an_invalid_order() {
    let job = &PARENT.0;
    for bad in [&[][..], &[0, 1, 2], &[0, 1, 2, 2], &[0, 1, 2, 4], &[0, 1, 2, 3, 3]] {
        let error = plan_in_order(job, bad, &[], &Watch::silent(&CancelToken::new())).unwrap_err();
        assert!(error.to_string().contains("4 plates"), "{bad:?}: {error}");
    }
}

/// A pair that the parent's job alone leaves out is left out by its dry run, too: judged, and waived at most.
#[test]
fn a_pair_that_the_parent_waives_is_waived() {
    let (job, mut parent) = (&PARENT.0, PARENT.1.clone());
    let own = Exclusion {
        pair: ["link_3".to_owned(), "sponge".to_owned()],
        reason: ExclusionReason::Srdf,
    };
    parent.job.workcell.exclusions.push(own.clone());
    parent.hash = parent.seal().ok();
    let terms = dry_run_terms(&parent, job.arm(), 0.05, 0.1).unwrap();
    assert_eq!(terms.workcell.exclusions.last(), Some(&own));
    let without = dry_run().job.workcell.exclusions;
    assert_eq!(terms.workcell.exclusions[..without.len()], without);
}

#[test]
fn the_terms_of_a_dry_run_are_recomputed_to_the_bit() {
    let (job, parent) = &*PARENT;
    let again = dry_run_terms(parent, job.arm(), 0.05, 0.1).unwrap();
    assert_eq!(differences(&dry_run().job, &again), []);
    let other = dry_run_terms(parent, job.arm(), 0.06, 0.1).unwrap();
    assert!(differences(&dry_run().job, &other).len() > 4);
}

#[test]
fn a_simulated_dry_run_washes_nothing() {
    let (plan, job) = (dry_run(), &PARENT.0);
    let execution = simulate(&plan, job.arm(), &plan.job.simulation).unwrap();
    let report = SimulationReport::new(&plan, job.arm(), &plan.job.simulation, &execution).unwrap();
    assert_eq!(report.verdict, SimulationVerdict::DryRun);
    assert!(
        report
            .plates
            .iter()
            .all(|plate| plate.verdict == PlateVerdict::SweptInAir)
    );
    let words = report.to_string();
    assert!(
        words.starts_with("FOLLOWED: DRY RUN of ") && words.contains("nothing is washed; 4 of 4 plates swept"),
        "{words}"
    );
    assert!(!words.contains("WASHED") && !words.contains(" washed under"), "{words}");
}

/// A forger seals again. What the file says of itself must still be so.
#[test]
fn false_statements_of_a_dry_run_are_found() {
    let (job, parent) = &*PARENT;
    let sealed = |mut plan: Plan| {
        plan.hash = plan.seal().ok();
        prove(&plan, job.arm()).unwrap()
    };
    let broken = |certificate: &Certificate| -> Vec<Requirement> {
        certificate.broken().map(|check| check.requirement).collect()
    };
    // A washing that says that it is one: its plates have no real ones below; with them stated where they are, it runs into them.
    let mut washing = parent.clone();
    washing.job.dry_run = dry_run().job.dry_run;
    assert_eq!(broken(&sealed(washing.clone())), [Requirement::DryRun]);
    washing.job.workcell = dry_run().job.workcell;
    assert_eq!(
        broken(&sealed(washing)),
        [Requirement::DryRun, Requirement::Clearance],
        "the sponge goes down to what is said to be an obstacle"
    );
    // A pair with a real plate that is left out is judged all the same, whatever the reason that is given.
    for reason in [
        ExclusionReason::Srdf,
        ExclusionReason::NeitherMoves,
        ExclusionReason::CarriesTool,
        ExclusionReason::KeepsItsHeight,
    ] {
        let mut near = dry_run();
        let pair = ["sponge".to_owned(), DryRun::real_name(0)];
        near.job.workcell.exclusions.push(Exclusion { pair, reason });
        let above = sealed(near.clone());
        assert!(above.passes() && above.waived.is_empty(), "{above}");
        near.knots.clone_from(&parent.knots);
        near.segments.clone_from(&parent.segments);
        let certificate = sealed(near);
        assert!(
            !certificate.passes() && certificate.headline.contains("; violated: "),
            "{certificate}"
        );
        // Waived at most, and then by name.
        assert!(
            broken(&certificate).contains(&Requirement::Clearance)
                || certificate.headline.contains(&DryRun::real_name(0)),
            "{reason:?}: {certificate}"
        );
    }
    // Two bodies of one name, of which the first stands as it should.
    let mut twice = dry_run();
    let mut other = twice.job.workcell.obstacles.last().unwrap().clone();
    other.pose.translation.z -= 0.01;
    twice.job.workcell.obstacles.push(other);
    assert!(broken(&sealed(twice)).contains(&Requirement::Exclusions));
}
