//! Kinds of plans: each statement that a kind may not make, or needs, decides the proof.

use crate::shipped;
use platewash::certificate::Requirement;
use platewash::motion::dry_run::dry_run_terms;
use platewash::motion::trajectory::SegmentKind;
use platewash::planner::{Watch, plan_in_order, recover};
use platewash::workcell::dry_run::DryRun;
use platewash::workcell::job::{FixtureTerms, HolderTerms, PlanKind, Statement, StatementRule};
use platewash::workcell::{Exclusion, ExclusionReason, ReducedClearance};
use platewash::{CancelToken, JobTerms, Plan, WashJob, prove};

/// The kitchen's plan, and one of another kind that follows from it.
struct Kinds {
    job: &'static WashJob,
    wash: &'static Plan,
}

impl Kinds {
    fn new() -> Self {
        let (job, wash) = shipped::planned("kitchen");
        Self { job, wash }
    }

    fn plan(&self, kind: PlanKind) -> Plan {
        let watch = CancelToken::new();
        let watch = Watch::silent(&watch);
        let wash = self.wash;
        if kind == PlanKind::Wash {
            return wash.clone();
        }
        if kind == PlanKind::DryRun {
            let terms = dry_run_terms(wash, self.job.arm(), 0.05, 0.1).unwrap();
            let raised = WashJob::new(self.job.shared_arm(), terms).unwrap();
            return plan_in_order(&raised, &wash.order, &wash.wash_paths, &watch)
                .unwrap()
                .plan;
        }
        let mut washes = wash.segments.iter().filter(|segment| segment.kind == SegmentKind::Wash);
        let second = washes.nth(1).unwrap();
        let stopped_s = 0.5 * (second.t_start_s + second.t_end_s);
        let stands = wash.knots.motion().unwrap().at(stopped_s).unwrap().q;
        let recovered = recover(wash, &self.job.shared_arm(), &stands, Some(stopped_s), &watch).unwrap();
        match kind {
            PlanKind::MotionHome => recovered.home,
            _ => recovered.rest.unwrap(),
        }
    }

    fn is_proved(&self, plan: &Plan) -> bool {
        prove(plan, self.job.arm()).is_ok_and(|certificate| certificate.passes())
    }

    /// A plan with a statement that is true of it, if it is true of anything.
    fn with(&self, plan: &mut Plan, statement: Statement) {
        let (wash, wanted) = (self.wash, &mut plan.job.requirements);
        match statement {
            Statement::Order => plan.order = vec![0],
            Statement::WashPaths => plan.wash_paths = wash.wash_paths.clone(),
            Statement::DryRun => {
                plan.job.dry_run = Some(DryRun {
                    parent: wash.hash.clone().unwrap(),
                    height_m: 0.05,
                });
            }
            Statement::NearAtStop => plan.job.workcell.reduced_clearances.push(ReducedClearance {
                pair: ["handle", "floor"].map(str::to_owned),
                by_m: 0.001,
                at_stop: true,
            }),
            Statement::Contact => wanted.contact = wash.job.requirements.contact,
            Statement::Holder => {
                wanted.holder = Some(holder(1e3));
            }
            Statement::LandingSpeed => wanted.landing_m_s = Some(0.05),
            Statement::LiftingSpeed => wanted.lifting_m_s = Some(0.05),
            Statement::Wrist => wanted.wrist_rad = Some(0.02),
        }
    }

    fn without(plan: &mut Plan, statement: Statement) {
        let wanted = &mut plan.job.requirements;
        match statement {
            Statement::Order => plan.order.clear(),
            Statement::WashPaths => plan.wash_paths.clear(),
            Statement::DryRun => plan.job.dry_run = None,
            Statement::NearAtStop => plan.job.workcell.reduced_clearances.retain(|pair| !pair.at_stop),
            Statement::Contact => (wanted.contact, wanted.holder) = (None, None),
            Statement::Holder => wanted.holder = None,
            Statement::LandingSpeed => wanted.landing_m_s = None,
            Statement::LiftingSpeed => wanted.lifting_m_s = None,
            Statement::Wrist => wanted.wrist_rad = None,
        }
    }

    /// A plan with a statement that no motion keeps; `None` for statements that are no requirements.
    fn unkept(&self, plan: &mut Plan, statement: Statement) -> Option<()> {
        self.with(plan, statement);
        let wanted = &mut plan.job.requirements;
        match statement {
            Statement::Contact => wanted.contact.as_mut()?.dose_pa_m = 1e8,
            Statement::Holder => {
                self.with(plan, Statement::Contact);
                plan.job.requirements.holder = Some(holder(1e-6));
            }
            Statement::LandingSpeed => wanted.landing_m_s = Some(1e-6),
            Statement::LiftingSpeed => wanted.lifting_m_s = Some(1e-6),
            Statement::Wrist => wanted.wrist_rad = Some(1.5),
            Statement::Order | Statement::WashPaths | Statement::DryRun | Statement::NearAtStop => return None,
        }
        Some(())
    }
}

fn holder(force_n: f64) -> HolderTerms {
    HolderTerms {
        sponge_friction: 0.5,
        plate_mass_kg: None,
        fixture: Some(FixtureTerms {
            force_n,
            torque_nm: force_n,
        }),
        ring: None,
    }
}

#[test]
fn each_kind_of_plan_is_proved_with_its_own_statements_alone() {
    let kinds = Kinds::new();
    for kind in PlanKind::ALL {
        let plan = kinds.plan(kind);
        assert_eq!(plan.job.kind(), kind);
        assert!(kinds.is_proved(&plan), "{kind}");
        for statement in Statement::ALL {
            let changed = |change: &dyn Fn(&mut Plan)| {
                let mut changed = plan.clone();
                change(&mut changed);
                changed.hash = changed.seal().ok();
                changed
            };
            let (rule, case) = (kind.rule(statement), format!("{kind}, {}", statement.path()));
            let with = changed(&|plan| kinds.with(plan, statement));
            let without = changed(&|plan| Kinds::without(plan, statement));
            // A plan without the statement that makes its kind is one of another kind.
            let is_of_kind = without.job.kind() == kind;
            match rule {
                StatementRule::Needed => assert!(!is_of_kind || !kinds.is_proved(&without), "{case}: without"),
                StatementRule::Judged | StatementRule::Planned => {
                    assert!(kinds.is_proved(&without), "{case}: without");
                }
                StatementRule::Refused => {
                    assert_ne!(with, plan, "{case}");
                    assert!(!kinds.is_proved(&with), "{case}: with");
                    assert!(kinds.is_proved(&without), "{case}: without");
                }
            }
            let mut unkept = plan.clone();
            if rule != StatementRule::Refused && kinds.unkept(&mut unkept, statement).is_some() {
                unkept.hash = unkept.seal().ok();
                assert_eq!(
                    kinds.is_proved(&unkept),
                    rule == StatementRule::Planned,
                    "{case}: unkept"
                );
            }
        }
    }
}

/// The first line names each limit that is looser than usual for the kind, and shows a small limit with enough decimals.
#[test]
fn looser_limits_are_named_in_the_first_line_of_every_kind() {
    let kinds = Kinds::new();
    for kind in PlanKind::ALL {
        let plan = kinds.plan(kind);
        let headline = |change: &dyn Fn(&mut JobTerms)| {
            let mut changed = plan.clone();
            change(&mut changed.job);
            changed.hash = changed.seal().ok();
            prove(&changed, kinds.job.arm()).unwrap().headline
        };
        let usual = headline(&|_| ());
        assert!(!usual.contains("less than usual"), "{kind}: {usual}");
        let usual_m_s = if kind == PlanKind::DryRun { "0.1" } else { "1" };
        for (change, words) in [
            (
                &(|job: &mut JobTerms| job.limits.tip_speed_m_s = 1.5) as &dyn Fn(&mut JobTerms),
                format!("tip speed up to 1.5 m/s (usual {usual_m_s} m/s)"),
            ),
            (
                &|job| job.limits.tip_acceleration_m_s2 = 9.0,
                "tip acceleration up to 9 m/s² (usual 8 m/s²)".to_owned(),
            ),
            (
                &|job| job.requirements.clearance_m = 0.002,
                "clearance 2 mm (usual 10 mm)".to_owned(),
            ),
            (
                &|job| job.requirements.lifting_m_s = Some(0.25),
                match kind {
                    PlanKind::MotionHome => "lifting speed up to 0.25 m/s (usual 0.02 m/s)".to_owned(),
                    PlanKind::DryRun => String::new(),
                    _ => "lifting speed up to 0.25 m/s (usual 0.05 m/s)".to_owned(),
                },
            ),
        ] {
            let line = headline(change);
            assert!(line.contains(&words), "{kind}: {line}");
            assert_eq!(
                line.contains("; requires less than usual: "),
                !words.is_empty(),
                "{line}"
            );
        }
    }
    let mut home = kinds.plan(PlanKind::MotionHome);
    home.job.requirements.lifting_m_s = Some(0.004);
    home.hash = home.seal().ok();
    let line = prove(&home, kinds.job.arm()).unwrap().headline;
    assert!(line.contains("(at most 0.004 m/s required)"), "{line}");
}

/// A pair that the job leaves out counts for the clearance of the first line where it keeps clear.
#[test]
fn a_waived_pair_that_keeps_clear_counts_for_the_clearance() {
    let kinds = Kinds::new();
    for kind in PlanKind::ALL {
        let plan = kinds.plan(kind);
        let proved = prove(&plan, kinds.job.arm()).unwrap();
        let clearance = proved.check(Requirement::Clearance).unwrap();
        let mut waived = plan.clone();
        waived.job.workcell.exclusions.push(Exclusion {
            pair: clearance.worst.pair.clone().unwrap(),
            reason: ExclusionReason::Srdf,
        });
        waived.hash = waived.seal().ok();
        let certificate = prove(&waived, kinds.job.arm()).unwrap();
        assert_eq!(
            certificate.check(Requirement::Clearance).unwrap().measure,
            clearance.measure,
            "{kind}"
        );
    }
}
