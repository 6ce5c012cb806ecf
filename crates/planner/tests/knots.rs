//! The motions of the shipped jobs, knot by knot: to the last bit, as `tests/golden/knots.json` states them.

use platewash_bodies::job::WashJob;
use platewash_fixtures::{kitchen, kitchen_plates, kitchen_terms, workcell};
use platewash_kinematics::RobotModel;
use platewash_motion::plan::Knots;
use platewash_planner::{Watch, draw_washable_layout, plan, plan_with};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::{JobTerms, Planner};
use platewash_workcell::layout::{self, PlateGeometry, Region, SampleRequest, Spacing};
use platewash_workcell::plate::PlateTerms;
use platewash_workcell::random;
use platewash_workcell::surface::Surface;
use platewash_workcell::tool::{StraightTool, Tool};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::sync::Arc;

const GOLDEN: &str = include_str!("../../../tests/golden/knots.json");

/// Seeds that are planned of each scenario.
const SEEDS: usize = 12;

/// Plates all round the arm.
const ROOMY: Region = Region {
    x_m: [-0.45, 0.45],
    y_m: [-0.45, 0.45],
    rho_m: Some([0.28, 0.45]),
    azimuth_deg: Some([-110.0, 110.0]),
};

/// Of the bytes of t, then q, then q̇, little-endian: the first 16 digits.
fn hash(knots: &Knots) -> String {
    let joints = knots.q_rad.iter().chain(&knots.qd_rad_s).flatten();
    let mut hash = Sha256::new();
    for number in knots.t_s.iter().chain(joints) {
        hash.update(number.to_le_bytes());
    }
    hash.finalize()[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

/// What the shipped scenario asks for, and where its plates are drawn.
fn asked(scenario: &str, robot: &RobotModel) -> (JobTerms, Region) {
    let mut terms = kitchen_terms(robot, kitchen_plates());
    match scenario {
        "kitchen-rim" => {
            let tool = StraightTool {
                length_m: 0.15,
                radius_m: 0.015,
                ..StraightTool::default()
            };
            terms.workcell = workcell(robot, Tool::from(tool));
            terms.requirements.tilt_rad = 30_f64.to_radians();
            if let Planner::Wash(settings) = &mut terms.planner {
                (settings.turns, settings.path_radius_m) = (Some(4.0), Some(0.145));
            }
            (terms, Region::PAPER_APPENDIX)
        }
        "kitchen-roomy" => (terms, ROOMY),
        _ => (terms, Region::PAPER_APPENDIX),
    }
}

fn motion(robot: &Arc<RobotModel>, scenario: &str, seed: u64) -> String {
    let (mut terms, region) = asked(scenario, robot);
    terms.seed = seed;
    let request = SampleRequest {
        region,
        spacing: Spacing {
            min_distance_m: 0.30,
            base_radius_m: 0.28,
        },
        count: 4,
        geometry: PlateGeometry {
            surface: Surface::Disc { radius_m: 0.145 },
            height_m: 0.03,
            thickness_m: 0.02,
            foot: None,
            terms: PlateTerms::default(),
        },
        base: Some(layout::base_footprint(robot)),
    };
    let mut rng = random::stream(seed, "layout");
    terms.plates = layout::sample(&request, &mut rng).unwrap().plates;
    let job = WashJob::new(robot.clone(), terms).unwrap();
    hash(&plan(&job).unwrap().plan.knots)
}

#[test]
fn the_shipped_jobs_move_as_committed() {
    let robot = Arc::new(RobotModel::irb120().unwrap());
    let golden: BTreeMap<String, Vec<String>> = serde_json::from_str(GOLDEN).unwrap();
    for scenario in ["kitchen-spiral", "kitchen-rim", "kitchen-roomy"] {
        let expected = &golden[scenario][..SEEDS];
        let found: Vec<_> = (1..=SEEDS as u64).map(|seed| motion(&robot, scenario, seed)).collect();
        assert_eq!(found, expected, "{scenario}");
    }
}

/// Whoever listens changes nothing.
#[test]
fn the_kitchen_plan_has_the_committed_knots() {
    let job = kitchen();
    let planned = plan(&job).unwrap();
    assert_eq!(hash(&planned.plan.knots), "c65caafc423eac2d");
    assert!(planned.plan.is_sealed() && planned.plan.job == *job.terms());
    assert_eq!((planned.visits.len(), planned.transits.len()), (4, 5));
    let cancel = CancelToken::new();
    let tell = |_: &_| ();
    let watch = Watch {
        tell: &tell,
        cancel: &cancel,
    };
    assert_eq!(plan_with(&job, &watch).unwrap().plan, planned.plan);
}

/// The first layout is out of reach, the second is that of the kitchen.
#[test]
fn layouts_are_drawn_until_one_can_be_washed() {
    let job = kitchen();
    let kitchen_layout = || layout::Layout {
        plates: kitchen_plates(),
        source: layout::LayoutSource::Explicit,
        findings: Vec::new(),
    };
    let mut draws = 0;
    let mut draw = || {
        draws += 1;
        let mut layout = kitchen_layout();
        if draws == 1 {
            layout.plates[2] = layout.plates[2].moved_to([0.7, 0.0]);
        }
        Ok(layout)
    };
    let cancel = CancelToken::new();
    let watch = Watch::silent(&cancel);
    let found = draw_washable_layout(&job.shared_arm(), job.terms(), &mut draw, &watch).unwrap();
    assert_eq!((found, draws), (kitchen_layout(), 2));
}
