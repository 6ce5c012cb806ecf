//! A washing whose plates push back.

use crate::two_plates::{judged, planned};
use platewash_fixtures::kitchen_contact;
use platewash_motion::csv::RecordedMotion;
use platewash_motion::plan::Plan;
use platewash_simulator::simulate::{Cause, Pressing, table};
use platewash_simulator::{ControlError, SimulationError, SimulationReport, simulate};
use platewash_workcell::simulation::{ControlLawName, FoamContact, Integrator, SimulationSettings};

fn foam(stiffness_pa: f64) -> Option<FoamContact> {
    Some(FoamContact {
        stiffness_pa,
        damping_pa_s: 0.0,
    })
}

fn under(law: ControlLawName, frequency: f64, contact: Option<FoamContact>) -> SimulationSettings {
    let mut settings = crate::two_plates::under(law, frequency);
    settings.plant.contact = contact;
    settings
}

fn pressings(report: &SimulationReport) -> Vec<&Pressing> {
    report
        .plates
        .iter()
        .map(|plate| plate.pressing.as_ref().unwrap())
        .collect()
}

/// By hand, upright on a disc: E/H A = 20 kPa / 30 mm · 19.6 cm² = 1.309 N/mm, 6.54 N at the plan's 5 mm. The sponge goes 4 mm beyond the
/// rim nowhere: path radius and sponge radius are 149 mm.
#[test]
fn the_planned_force_is_that_of_the_foundation_at_every_height() {
    let (_, report) = judged(&under(ControlLawName::ComputedTorque, 100.0, foam(2e4)));
    for pressing in pressings(&report) {
        for (at, millimetres) in pressing.planned.iter().zip([3.0, 4.0, 5.0, 6.0, 7.0]) {
            let whole = 1.309 * millimetres;
            assert!((at.force.most_n - whole).abs() < 0.01, "{at:?} {whole}");
            assert!(
                at.force.least_n > 0.95 * whole && at.force.mean_n <= at.force.most_n + 1e-9,
                "{at:?}"
            );
        }
        assert!(pressing.contact.is_none(), "this job asks for none");
    }
    let text = format!("{report:#}");
    assert!(
        text.contains("planned N, plate higher")
            && text.contains("20 kPa")
            && text.contains("assumed: plates push back"),
        "{text}"
    );
}

#[test]
fn a_stiff_arm_presses_as_planned_and_a_soft_one_less() {
    let force = |frequency| {
        let (execution, report) = judged(&under(ControlLawName::ComputedTorque, frequency, foam(2e4)));
        assert!(
            execution
                .samples
                .iter()
                .all(|sample| sample.load.is_some_and(|felt| felt.force_n.is_finite()))
        );
        let means: Vec<_> = pressings(&report)
            .iter()
            .map(|pressing| pressing.force.mean_n)
            .collect();
        println!("{frequency} rad/s: {means:.2?} N, {}", report.headline);
        means
    };
    let (soft, stiff) = (force(30.0), force(200.0));
    for (soft, stiff) in soft.into_iter().zip(stiff) {
        assert!((6.2..6.6).contains(&stiff), "{stiff}");
        assert!(soft > 1.0 && soft < stiff, "{soft}");
    }
}

#[test]
fn an_arm_that_sinks_presses_too_hard_and_does_not_pass_through() {
    let (_, through) = judged(&under(ControlLawName::Pd, 15.0, None));
    let (_, held) = judged(&under(ControlLawName::Pd, 15.0, foam(2e4)));
    let sinks = |report: &SimulationReport| -> f64 {
        let depth = |cause: &Cause| match cause {
            Cause::Sunk { most_m, .. } => Some(*most_m),
            _ => None,
        };
        report
            .plates
            .iter()
            .flat_map(|plate| plate.causes.iter().filter_map(depth))
            .fold(0.0, f64::max)
    };
    println!(
        "{:.1} mm without, {:.1} mm with",
        1e3 * sinks(&through),
        1e3 * sinks(&held)
    );
    assert!(
        sinks(&through) > 0.05 && sinks(&held) < 0.027,
        "the plate holds it: its holder is hardly lower than the face"
    );
    assert!(through.plates.iter().all(|plate| plate.pressing.is_none()));
    let (robot, plan) = planned();
    // Where its wrist is stiff enough to stay upright it presses with a multiple of what is planned.
    let (execution, held) = judged(&under(ControlLawName::Pd, 30.0, foam(2e4)));
    for pressing in pressings(&held) {
        println!("{:.1} N at most, strain {:.2}", pressing.force.most_n, pressing.strain);
        assert!(
            pressing.force.most_n > 1.8 * 6.54 && pressing.strain > 0.3,
            "{pressing:?}"
        );
    }
    let csv = table(&execution, plan, robot, 0.01).unwrap().to_string();
    let read = RecordedMotion::from_csv(&csv).unwrap();
    let most = read
        .samples
        .iter()
        .filter_map(|sample| sample.force_n)
        .fold(0.0, f64::max);
    assert!(most > 1.8 * 6.54 && csv.lines().next().unwrap().ends_with(",tau6_n_m,force_n"));
}

#[test]
fn every_law_is_stable_at_a_kilohertz_over_the_whole_range() {
    for integrator in [Integrator::SemiImplicitEuler, Integrator::Rk4] {
        for law in [
            ControlLawName::Pd,
            ControlLawName::PdGravity,
            ControlLawName::ComputedTorque,
        ] {
            for pa in [11e3, 44e3, 200e3] {
                let mut settings = under(law, 30.0, foam(pa));
                settings.plant.integrator = integrator;
                let (execution, report) = judged(&settings);
                // Nothing chatters: from one sample to the next the force changes by less than a newton or a fifth of the greatest.
                let forces: Vec<_> = execution
                    .samples
                    .iter()
                    .map(|sample| sample.load.unwrap().force_n)
                    .collect();
                let most = forces.iter().copied().fold(0.0, f64::max);
                let jump = forces
                    .windows(2)
                    .map(|pair| (pair[1] - pair[0]).abs())
                    .fold(0.0, f64::max);
                println!(
                    "{} {pa} Pa: most {most:.1} N, jump {jump:.2} N; {}",
                    law.name(),
                    report.headline
                );
                assert!(jump < f64::max(1.0, 0.2 * most), "{jump} of {most}");
            }
        }
    }
}

#[test]
fn too_stiff_foam_is_refused_with_a_remedy() {
    let (robot, plan) = planned();
    let mut settings = under(ControlLawName::ComputedTorque, 30.0, foam(5e8));
    let refused = simulate(plan, robot, &settings).unwrap_err();
    let SimulationError::StiffContact { least_substeps, .. } = refused else {
        panic!("{refused}")
    };
    let message = refused.to_string();
    assert!(
        message.contains("500000000 Pa") && message.contains(&format!("{least_substeps} steps")),
        "{message}"
    );
    assert!((2..=1000).contains(&least_substeps), "{message}");
    settings.plant.substeps = least_substeps - 1;
    assert!(matches!(
        simulate(plan, robot, &settings),
        Err(SimulationError::StiffContact { .. })
    ));
    settings.plant.substeps = least_substeps;
    let allowed = !matches!(
        simulate(plan, robot, &settings),
        Err(SimulationError::StiffContact { .. })
    );
    assert!(allowed, "what is suggested does");
}

#[test]
fn rejects_invalid_contact_by_name() {
    let (robot, plan) = planned();
    let refused = |edit: &dyn Fn(&mut SimulationSettings)| {
        let mut settings = under(ControlLawName::ComputedTorque, 30.0, foam(2e4));
        edit(&mut settings);
        simulate(plan, robot, &settings).unwrap_err().to_string()
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 2e9] {
        assert!(
            refused(&|s| s.plant.contact = foam(bad)).contains("contact_stiffness_pa"),
            "{bad}"
        );
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let damped = |s: &mut SimulationSettings| s.plant.contact.as_mut().unwrap().damping_pa_s = bad;
        assert!(refused(&damped).contains("contact_damping_pa_s"), "{bad}");
    }
    assert!(refused(&|s| s.plant.contact_force_n = 1.0).contains("contact_force_n"));
    let mut ranged = plan.clone();
    ranged.job.workcell.tool.sponge.stiffness_pa = Some([11e3, 44e3]);
    for (pa, within) in [
        (10.9e3, false),
        (11e3, true),
        (44e3, true),
        (44.1e3, false),
        (f64::NAN, false),
    ] {
        let settings = under(ControlLawName::ComputedTorque, 30.0, foam(pa));
        let refused = simulate(&ranged, robot, &settings).is_err();
        assert_eq!(refused, !within, "{pa}");
    }
    let mut bare = plan.clone();
    bare.job.workcell.tool.bodies.clear();
    let settings = under(ControlLawName::ComputedTorque, 30.0, foam(2e4));
    assert_eq!(
        simulate(&bare, robot, &settings).unwrap_err(),
        SimulationError::NoSponge
    );
    // Too much damping for the steps is refused, too: by the steps, or by the loop.
    let mut damped = settings.clone();
    damped.plant.contact.as_mut().unwrap().damping_pa_s = 1e7;
    let refused = simulate(plan, robot, &damped).unwrap_err();
    let named = matches!(
        refused,
        SimulationError::StiffContact { .. }
            | SimulationError::Control(ControlError::Unstable { in_contact: true, .. })
    );
    assert!(named, "{refused}");
}

#[test]
fn laws_without_a_plant_have_no_force() {
    let (execution, report) = judged(&under(ControlLawName::Exact, 30.0, foam(2e4)));
    assert!(execution.samples.iter().all(|sample| sample.load.is_none()));
    assert!(report.plates.iter().all(|plate| plate.pressing.is_none()));
    assert!(format!("{report:#}").contains("force on plates: not simulated"));
}

/// A plate that lies 4 mm lower than the arm thinks is hardly touched; what was in contact is measured by what the job asks for.
#[test]
fn a_low_plate_is_hardly_touched() {
    let (robot, plan) = planned();
    let mut low = plan.clone();
    low.job.requirements.contact = Some(kitchen_contact());
    low.job.workcell.tool.sponge.stiffness_pa = Some([11e3, 44e3]);
    let whole = low.clone();
    low.job.plates[0].pose.translation.z -= 0.0045;
    let settings = under(ControlLawName::ComputedTorque, 100.0, foam(2e4));
    let report = |plan: &Plan| {
        let execution = simulate(plan, robot, &settings).unwrap();
        SimulationReport::new(plan, robot, &settings, &execution).unwrap()
    };
    let (right, wrong) = (report(&whole), report(&low));
    let contact = |report: &SimulationReport, plate: usize| pressings(report)[plate].contact.unwrap();
    println!("{:?}\n{:?}", contact(&right, 0), contact(&wrong, 0));
    assert!(contact(&right, 0).contact > 0.995 && contact(&right, 1).contact > 0.995);
    assert!(contact(&wrong, 0).contact < 1e-9, "half a millimetre is no contact");
    assert_eq!(contact(&right, 1), contact(&wrong, 1));
    low.job.plates[0].pose.translation.z -= 0.003;
    let lost = report(&low);
    let pressing = pressings(&lost)[0];
    let gone = pressing.lost.unwrap();
    assert!(
        pressing.force.least_n == 0.0 && gone.share > 0.5 && gone.time_s > 1.0 && gone.first_t_s > 3.0,
        "{gone:?}"
    );
    assert!(
        lost.plates[0]
            .causes
            .iter()
            .any(|cause| matches!(cause, Cause::Lifted { .. }))
    );
    assert!(lost.to_string().contains("contact is lost for"));
}
