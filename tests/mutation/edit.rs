//! A single edit of a plan and what is known of it beforehand, and the plans that are edited: two real jobs, planned once.

use crate::mutation::sampler::Sampler;
use platewash::certificate::{Requirement, prove};
use platewash::workcell::random::stream;
use platewash::{JobTerms, Plan, RobotModel, Scenario, plan};
use rand::RngExt;
use rand_pcg::Pcg64;
use std::sync::LazyLock;

/// Seeds of the streams that choose the plan and the details of an edit, by its name: no edit depends on the others.
const PLANS: u64 = 1;
const DETAILS: u64 = 2;

/// What is edited; a line of the summary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    KnotMoved,
    KnotSpeed,
    KnotOrder,
    KnotDropped,
    KnotAdded,
    Time,
    Detour,
    Segments,
    WashPaths,
    Plates,
    Order,
    Tool,
    Obstacles,
    Exclusions,
    LimitsAsked,
    Statements,
    Home,
    Words,
    Rounding,
}

impl Kind {
    pub const ALL: [Self; 19] = [
        Self::KnotMoved,
        Self::KnotSpeed,
        Self::KnotOrder,
        Self::KnotDropped,
        Self::KnotAdded,
        Self::Time,
        Self::Detour,
        Self::Segments,
        Self::WashPaths,
        Self::Plates,
        Self::Order,
        Self::Tool,
        Self::Obstacles,
        Self::Exclusions,
        Self::LimitsAsked,
        Self::Statements,
        Self::Home,
        Self::Words,
        Self::Rounding,
    ];

    pub fn words(self) -> &'static str {
        match self {
            Self::KnotMoved => "a knot moved",
            Self::KnotSpeed => "a knot's speed",
            Self::KnotOrder => "knots exchanged",
            Self::KnotDropped => "knots dropped",
            Self::KnotAdded => "a knot added",
            Self::Time => "time",
            Self::Detour => "a detour",
            Self::Segments => "segments",
            Self::WashPaths => "wash paths",
            Self::Plates => "plates",
            Self::Order => "order",
            Self::Tool => "tool",
            Self::Obstacles => "obstacles",
            Self::Exclusions => "exclusions",
            Self::LimitsAsked => "limits asked",
            Self::Statements => "other statements",
            Self::Home => "home",
            Self::Words => "words",
            Self::Rounding => "rounding",
        }
    }
}

/// What must come of an edited plan.
#[derive(Debug, Clone, PartialEq)]
pub enum ExpectedResult {
    /// It passes, nothing is waived, and the sampler finds nothing.
    Harmless,
    /// It passes, but for these, which the job waives.
    Waived(Vec<Requirement>),
    /// Of the requirements about statements these fail and no others; of those about numbers these, and whatever the sampler
    /// finds.
    Fails(Vec<Requirement>),
    /// No statement is wrong; the sampler says what is broken, if anything.
    Sampled,
}

/// What an edit does to a plan; what is left open is drawn at random.
type Apply = dyn Fn(&mut Plan, &mut Pcg64) + Send + Sync;

/// An edit.
pub struct Edit {
    pub kind: Kind,
    pub what: String,
    /// Which of the good plans is edited.
    pub of: usize,
    pub expected: ExpectedResult,
    apply: Box<Apply>,
}

impl Edit {
    /// The edited plan, sealed again. Random edits draw from a stream of their own.
    pub fn apply(&self, good: &Plan) -> Plan {
        let mut plan = good.clone();
        (self.apply)(&mut plan, &mut stream(DETAILS, &self.what));
        assert!(plan != *good, "{}: changes nothing", self.what);
        plan.hash = Some(plan.seal().unwrap());
        plan
    }
}

/// A growing list.
#[derive(Default)]
pub struct Edits(pub Vec<Edit>);

impl Edits {
    pub fn add(
        &mut self,
        kind: Kind,
        what: impl Into<String>,
        expected: ExpectedResult,
        apply: impl Fn(&mut Plan, &mut Pcg64) + Send + Sync + 'static,
    ) {
        let what = format!("{}, {}", kind.words(), what.into());
        assert!(self.0.iter().all(|edit| edit.what != what), "{what}: twice");
        self.0.push(Edit {
            kind,
            of: stream(PLANS, &what).random_range(0..2),
            what,
            expected,
            apply: Box::new(apply),
        });
    }

    /// An edit after which the plan still passes.
    pub fn harmless(&mut self, kind: Kind, what: &str, apply: fn(&mut Plan)) {
        self.add(kind, what, ExpectedResult::Harmless, move |p, _| apply(p));
    }

    /// An edit that leaves all statements right.
    pub fn sampled(&mut self, kind: Kind, what: &str, apply: fn(&mut Plan)) {
        self.add(kind, what, ExpectedResult::Sampled, move |p, _| apply(p));
    }

    /// An edit after which the plan passes but for what its job waives.
    pub fn waives(&mut self, kind: Kind, what: &str, names: &[Requirement], apply: fn(&mut Plan)) {
        self.add(kind, what, ExpectedResult::Waived(names.to_vec()), move |p, _| apply(p));
    }

    /// An edit that breaks requirements by name.
    pub fn fails(&mut self, kind: Kind, what: &str, names: &[Requirement], apply: fn(&mut Plan)) {
        self.add(kind, what, ExpectedResult::Fails(names.to_vec()), move |p, _| apply(p));
    }
}

/// A plan, its arm, and who measures what comes of it.
pub struct GoodPlan {
    pub plan: Plan,
    /// What its scenario states, resolved without the plan.
    pub terms: JobTerms,
    pub robot: &'static RobotModel,
    pub sampler: Sampler<'static>,
}

/// The shipped scenarios and the seeds of their layouts.
pub const JOBS: [(&str, u64); 2] = [("kitchen-spiral", 1), ("kitchen-rim", 2)];

static GOOD: LazyLock<[GoodPlan; 2]> = LazyLock::new(|| JOBS.map(planned));

/// Both plans.
pub fn good() -> &'static [GoodPlan; 2] {
    &GOOD
}

impl GoodPlan {
    /// All requirements, in the order of the certificate.
    pub fn requirements(&self) -> Vec<Requirement> {
        let certificate = prove(&self.plan, self.robot).unwrap();
        certificate.checks.iter().map(|check| check.requirement).collect()
    }
}

/// The scenario of a job.
pub fn scenario((name, seed): (&str, u64)) -> Scenario {
    Scenario {
        seed,
        ..Scenario::load(name).unwrap()
    }
}

fn planned(job: (&str, u64)) -> GoodPlan {
    let plan = plan(&scenario(job).job().unwrap()).unwrap().plan;
    let again = scenario(job).job().unwrap();
    // They live as long as the test runs.
    let robot = Box::leak(Box::new(again.arm().clone()));
    let origin = Box::leak(Box::new(plan.clone()));
    GoodPlan {
        plan,
        terms: again.terms().clone(),
        robot,
        sampler: Sampler::new(origin, robot),
    }
}
