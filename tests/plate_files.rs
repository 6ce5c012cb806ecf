//! Plates and soils out of files: planned, proved, and no longer proved where a plan is edited.

use platewash::certificate::{Requirement, Verdict};
use platewash::motion::plan::Plan;
use platewash::{Certificate, Scenario, plan, prove};
use std::path::Path;

const TWO: &str = "name,x_m,y_m,z_m,kind,height_error_mm,soil\n\
    a,0.36,0.13,0.03,dessert190,0.8,dried sauce\n\
    b,0.36,-0.13,0.03,coaster,0.5,crumbs\n";

fn judged(plan: &Plan) -> Certificate {
    let arm = platewash::RobotModel::irb120().unwrap();
    prove(plan, &arm).unwrap()
}

fn is_kept(certificate: &Certificate, requirement: Requirement) -> bool {
    certificate.check(requirement).unwrap().status.is_kept()
}

#[test]
fn a_soil_gets_its_passes_dose_speed_and_force() {
    let folder = tempfile::tempdir().unwrap();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/plates");
    for name in ["twelve.toml", "soil.toml"] {
        std::fs::copy(examples.join(name), folder.path().join(name)).unwrap();
    }
    std::fs::write(folder.path().join("plates.csv"), TWO).unwrap();
    let file = folder.path().join("twelve.toml");
    let job = Scenario::load(&file.to_string_lossy()).unwrap().job().unwrap();
    let planned = plan(&job).unwrap().plan;
    let certificate = judged(&planned);
    assert_eq!(certificate.verdict, Verdict::Pass, "{certificate}");
    let path = |plate: usize| planned.wash_paths.iter().find(|path| path.plate == plate).unwrap();
    assert_eq!([path(0), path(1)].map(|path| path.curve.laps()), [2, 1]);
    let dose = |plate: usize| {
        certificate
            .contact
            .iter()
            .find(|contact| contact.plate == plate)
            .unwrap()
            .dose
    };
    assert_eq!([dose(0).threshold, dose(1).threshold], [150.0, 40.0]);

    type Edit = (Requirement, fn(&mut Plan));
    let edits: [Edit; 6] = [
        (Requirement::WashPaths, |p| p.job.soils[2].passes = Some(3)),
        (Requirement::WashSpeed, |p| p.job.soils[2].speed_m_s = Some(0.15)),
        (Requirement::ContactDose, |p| p.job.soils[2].dose_pa_m = Some(600.0)),
        (Requirement::ContactForce, |p| p.job.soils[2].force_n = Some([1.0, 8.0])),
        (Requirement::Pressed, |p| {
            p.job.plates[0].terms.height_error_m = Some(0.006)
        }),
        (Requirement::Pressed, |p| {
            p.job.plates[1].terms.deviation_m = Some(0.006)
        }),
    ];
    for (requirement, edit) in edits {
        let mut edited = planned.clone();
        edit(&mut edited);
        edited.hash = Some(edited.seal().unwrap());
        let found = judged(&edited);
        assert!(!is_kept(&found, requirement), "{requirement:?}: {found}");
    }
    let mut lost = planned.clone();
    lost.job.plates[0].terms.soil = Some(3);
    lost.hash = Some(lost.seal().unwrap());
    assert!(prove(&lost, job.arm()).is_err());
}
