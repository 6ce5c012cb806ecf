//! The certificate of a plan: what it promises, judged from the plan file and the arm's description alone.
//!
//! Nothing here knows how a plan came about: the tool path is evaluated from its definition, the motion from its knots. With
//! the planner it shares definitions: forward kinematics, bodies, pairs and distances, limits, the stroke, the raster of coverage.
//! Every bound holds for the whole motion, not for samples; `docs/certificate.md` says how and on what assumptions.
//!
//! | what | file |
//! | --- | --- |
//! | promises and their outcome; as a table | `promise.rs`, `table.rs` |
//! | what the plan states | `statements.rs`, `schedule.rs`, `home.rs`, `apart.rs`, `summary.rs` |
//! | the motion: cubics, groups of them | `piece.rs`, `timeline.rs` |
//! | joints | `joints.rs` |
//! | the tip: derivatives, halving, speed, tilt, height | `tip.rs`, `watch.rs`, `tips.rs` |
//! | the sponge's rim where it comes down and leaves | `contact.rs` |
//! | the declared curves, following them, sweeping the plate | `curve.rs`, `following.rs`, `sweep.rs` |
//! | beyond the rim: what may be touched there, how far it is | `neighbours.rs`, `reach.rs` |
//! | clearance: one pair, all pairs | `clear.rs`, `clearances.rs` |

mod apart;
mod clear;
mod clearances;
mod contact;
mod curve;
mod error;
mod following;
pub(crate) mod headline;
mod home;
mod joints;
mod neighbours;
mod piece;
mod promise;
mod reach;
mod schedule;
mod statements;
mod summary;
mod sweep;
mod table;
#[cfg(test)]
mod tests;
mod timeline;
mod tip;
mod tips;
mod watch;

pub use clearances::{PairBound, PairRule};
pub use error::VerifyError;
pub use neighbours::Touched;
pub use promise::{Discrepancy, Measure, Promise, PromiseName, Sense, Status, Unit, Worst, reaches};
pub use summary::summary;
pub use sweep::PlateCoverage;
pub use table::{CertificateTable, PairsShown};

use crate::plan::{LINE_TOLERANCE_M, PATH_TOLERANCE_M, Plan, PlanLimits};
use crate::robot;
use crate::scenario::RobotSection;
use crate::tool_path::SegmentKind;
use curve::Curve;
use piece::Piece;
use platewash_kinematics::{AXES, RobotModel};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::layout::{MAX_PLATES, Plate};
use schedule::Schedule;
use serde::{Deserialize, Serialize};
use sweep::Wash;
use timeline::Timeline;
use tip::Arm;
use tips::Tips;
use watch::Watch;

/// How far joints may turn for their sines to be right (see [`platewash_kinematics::trig`]) \[rad\].
const MOST_TURN_RAD: f64 = 1e4;

/// The shortest piece whose cubic can be computed \[s\]. A joint that keeps within [`MOST_TURN_RAD`] is no faster than some 10⁵ rad over
/// the piece's length, and what is divided by its cube stays below 10¹⁰⁰, whose squares are numbers.
const SHORTEST_S: f64 = 1e-30;

/// How far a bound of a deviation may be above the worst one found, as a part of the tolerance.
const DEVIATION_RESOLUTION: f64 = 0.02;

/// What came of the whole plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CertificateVerdict {
    /// Every promise holds, and the plan is as it was sealed. [`Certificate::exempt`] names those that hold only because the scenario
    /// waives them.
    Pass,
    /// A promise is broken or not proved, or the hash is not that of the contents.
    Fail,
}

/// What the hash says. It is no promise about the motion: whoever changes a plan can seal it again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HashFinding {
    /// The hash in the file.
    pub stated: Option<String>,
    /// The hash that belongs to the contents; none for contents that JSON cannot say.
    pub computed: Option<String>,
    /// Whether they are the same.
    pub status: Status,
}

/// What is proved about a plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Pass, or fail.
    pub verdict: CertificateVerdict,
    /// The first line in words: the verdict, what it waives, and what is not kept.
    pub headline: String,
    /// The promises that do not hold and that the scenario waives: [`Status::Exempt`].
    pub exempt: Vec<PromiseName>,
    /// Name of the scenario.
    pub scenario: String,
    /// Duration of the motion \[s\].
    pub duration_s: f64,
    /// The hash.
    pub hash: HashFinding,
    /// The promises.
    pub promises: Vec<Promise>,
    /// Coverage, plate by plate in the order of washing.
    pub coverage: Vec<PlateCoverage>,
    /// Clearance, pair by pair and rule by rule.
    pub clearance: Vec<PairBound>,
}

impl Certificate {
    /// A promise by its name.
    #[must_use]
    pub fn promise(&self, name: PromiseName) -> Option<&Promise> {
        self.promises.iter().find(|p| p.name == name)
    }

    /// The promises that are broken or not proved.
    pub fn broken(&self) -> impl Iterator<Item = &Promise> {
        self.promises.iter().filter(|p| !p.status.is_kept())
    }
}

/// The arm that a plan is about: the built-in one, or that of a description that the caller gives. A plan knows the name of its
/// description alone, not where it lies.
///
/// # Errors
/// [`VerifyError::NoDescription`], [`VerifyError::Robot`].
pub fn arm(plan: &Plan, description: Option<&RobotSection>) -> Result<RobotModel, VerifyError> {
    match (description, &plan.scenario.robot.urdf) {
        (None, Some(urdf)) => Err(VerifyError::NoDescription {
            file: urdf.display().to_string(),
        }),
        (given, _) => Ok(robot::load(given.unwrap_or(&plan.scenario.robot))?),
    }
}

/// Judges a plan for an arm.
///
/// # Errors
/// [`VerifyError`] for a plan that says nothing that could be judged. A plan that breaks promises is no error.
pub fn verify(plan: &Plan, robot: &RobotModel) -> Result<Certificate, VerifyError> {
    check_sizes(plan)?;
    plan.scenario.validate()?;
    let pieces = piece::pieces(&plan.knots)?;
    check_lengths(&pieces)?;
    let timeline = Timeline::new(&pieces);
    check_turns(&pieces, &timeline, plan.knots.t_s.len())?;
    let scenario = &plan.scenario;
    let model = ClearanceModel::new(robot, &scenario.tool, &plan.plates)?;
    // What follows from the scenario and the arm counts, not what the plan states.
    let limits = PlanLimits::new(scenario, robot);
    let (schedule, gaps) = match Schedule::new(plan, &pieces) {
        Ok(schedule) => (Some(schedule), Vec::new()),
        Err(gaps) => (None, gaps),
    };
    let schedule = schedule.as_ref();
    let arm = Arm::new(robot, &scenario.tool);
    let tips = Tips::new(&arm, plan, &limits, &pieces, schedule);
    let mut washes = schedule.map_or(Ok(Vec::new()), |s| sweeps(&arm, plan, &limits, (&pieces, s), &tips))?;
    let clearance = clearances::judge(plan, robot, &model, &timeline, schedule);

    let mut promises = statements::promises(plan, robot, &model);
    promises.push(Promise::stated(PromiseName::Segments, gaps));
    promises.push(home::home_to_home(plan));
    promises.push(match schedule {
        Some(schedule) => home::rest_at_wash_ends(plan, schedule),
        None => Promise::not_judged(PromiseName::RestAtWashEnds),
    });
    promises.push(apart::promise(plan, robot));
    promises.extend(joints::promises(&pieces, &limits, schedule));
    promises.extend(tips.promises(&limits, &pieces, schedule));
    promises.push(contact::promise(&arm, plan, &limits, (&pieces, schedule), &tips));
    let deviations = deviations(&arm, plan, &pieces, schedule);
    let follows = |p: &Promise| p.name == PromiseName::ToolPath && p.status == Status::Pass;
    if let Some(schedule) = schedule {
        // A deviation is one from the declared stroke: it tells of the plate where that is the stroke asked for.
        let follows = promises.iter().any(follows);
        let proved = reach::Proved {
            arm: &arm,
            pieces: &pieces,
            schedule,
            tips: &tips,
            stroke_deviation_m: deviations[0].measure.and_then(|m| m.bound).filter(|_| follows),
        };
        reach::settle(plan, &mut washes, &proved);
    }
    let coverage: Vec<_> = washes.into_iter().map(|wash| wash.swept).collect();
    promises.extend(deviations);
    promises.push(clearances::promise(limits.clearance_m, &clearance));
    promises.push(reach::promise(&coverage));
    promises.push(coverage_promise(&coverage, plan, &limits, schedule));
    let proved = reach::washed(&coverage, &limits, &promises);
    promises.push(summary::promise(plan, robot, proved));
    let hash = hash(plan);
    let sound = hash.status == Status::Pass && promises.iter().all(|p| p.status.is_kept());
    let exempt = promises.iter().filter(|p| p.status == Status::Exempt);
    let mut certificate = Certificate {
        verdict: if sound {
            CertificateVerdict::Pass
        } else {
            CertificateVerdict::Fail
        },
        headline: String::new(),
        exempt: exempt.map(|p| p.name).collect(),
        scenario: scenario.name.clone(),
        duration_s: plan.knots.t_s.last().copied().unwrap_or(0.0),
        hash,
        promises,
        coverage,
        clearance,
    };
    certificate.headline = headline::headline(&certificate);
    Ok(certificate)
}

fn hash(plan: &Plan) -> HashFinding {
    let computed = plan.seal().ok();
    let same = computed.is_some() && plan.hash == computed;
    HashFinding {
        stated: plan.hash.clone(),
        computed,
        status: if same { Status::Pass } else { Status::Fail },
    }
}

/// Nothing in a plan may be so large that judging it takes for ever.
fn check_sizes(plan: &Plan) -> Result<(), VerifyError> {
    let plates = plan.plates.len();
    if plates > MAX_PLATES || plan.order.len() > MAX_PLATES {
        let found = plates.max(plan.order.len());
        return Err(VerifyError::TooManyPlates {
            found,
            most: MAX_PLATES,
        });
    }
    // Twice as many as there should be and more, so that what is wrong with a few too many is said by name.
    let most = 8 * (plates + 2);
    let found = plan.segments.len().max(plan.tool_path.len());
    if found > most {
        return Err(VerifyError::TooManySegments { found, plates, most });
    }
    let fits = |p: &Plate| {
        let finite = [p.x_m, p.y_m, p.z_m].into_iter().all(|v| v.abs() <= 1e3);
        finite && [p.radius_m, p.thickness_m].into_iter().all(|v| v > 1e-6 && v <= 1e3)
    };
    match plan.plates.iter().position(|p| !fits(p)) {
        Some(plate) => Err(VerifyError::NoPlate { plate }),
        None => Ok(()),
    }
}

/// Time divides, squared and cubed.
fn check_lengths(pieces: &[Piece]) -> Result<(), VerifyError> {
    match pieces.iter().position(|piece| piece.length_s < SHORTEST_S) {
        Some(piece) => Err(VerifyError::TooShort {
            piece,
            length_s: pieces[piece].length_s,
            least_s: SHORTEST_S,
        }),
        None => Ok(()),
    }
}

/// Sines must be right all along the motion.
fn check_turns(pieces: &[Piece], timeline: &Timeline<'_>, knots: usize) -> Result<(), VerifyError> {
    let Some(whole) = timeline.whole() else {
        return Err(VerifyError::NoMotion { found: knots });
    };
    let far = whole.most.abs().sup(&whole.least.abs());
    let too_far = |joint: usize| far[joint] > MOST_TURN_RAD || !pieces.iter().all(|p| p.is_sane(joint));
    match (0..AXES).find(|&joint| too_far(joint)) {
        Some(joint) => Err(VerifyError::TurnsTooFar {
            joint,
            position_rad: far[joint],
            most_rad: MOST_TURN_RAD,
        }),
        None => Ok(()),
    }
}

/// Stroke and line deviation.
fn deviations(arm: &Arm<'_>, plan: &Plan, pieces: &[Piece], schedule: Option<&Schedule>) -> [Promise; 2] {
    let names = [PromiseName::StrokeDeviation, PromiseName::LineDeviation];
    let Some(schedule) = schedule else {
        return names.map(Promise::not_judged);
    };
    let limits = [PATH_TOLERANCE_M, LINE_TOLERANCE_M];
    let mut watches = limits.map(|limit| Watch::new(limit, DEVIATION_RESOLUTION * limit));
    let mut no_curve = [false; 2];
    let at_plates = schedule.stages.iter().zip(&plan.tool_path);
    for (stage, segment) in at_plates.filter(|(stage, _)| schedule::is_at_plate(stage.kind)) {
        let which = usize::from(stage.kind != SegmentKind::Wash);
        match Curve::new(segment) {
            Some(curve) => following::follow(arm, &pieces[stage.pieces.clone()], &curve, &mut watches[which]),
            None => no_curve[which] = true,
        }
    }
    std::array::from_fn(|i| {
        if no_curve[i] {
            return Promise::not_judged(names[i]);
        }
        let worst = tips::worst(&watches[i], pieces, Some(schedule));
        tips::promise(names[i], &watches[i], (limits[i], Unit::Metre), worst)
    })
}

/// Coverage of every plate that is washed.
fn sweeps(
    arm: &Arm<'_>,
    plan: &Plan,
    limits: &PlanLimits,
    (pieces, schedule): (&[Piece], &Schedule),
    tips: &Tips,
) -> Result<Vec<Wash>, VerifyError> {
    let mut all = Vec::new();
    for (i, stage) in schedule.stages.iter().enumerate() {
        let (SegmentKind::Wash, Some(plate)) = (stage.kind, plan.plates.get(stage.plate)) else {
            continue;
        };
        let sponge = (plan.scenario.tool.sponge_radius_m, tips.least_cosine_of(i));
        let pieces = &pieces[stage.pieces.clone()];
        let within_m = plan.scenario.wash.path_radius_m + PATH_TOLERANCE_M;
        let (swept, [tip_m, seen_m]) =
            sweep::sweep(arm, pieces, (plate, stage.plate), sponge, limits.coverage, within_m)?;
        all.push(Wash {
            stage: i,
            tip_m,
            seen_m,
            swept,
        });
    }
    Ok(all)
}

/// The swept share of a plate against what is required.
fn coverage_measure(swept: &PlateCoverage, limits: &PlanLimits) -> Measure {
    Measure {
        bound: Some(swept.at_least),
        seen: swept.at_most,
        limit: limits.coverage,
        sense: Sense::AtLeast,
        unit: Unit::Share,
    }
}

fn coverage_promise(
    coverage: &[PlateCoverage],
    plan: &Plan,
    limits: &PlanLimits,
    schedule: Option<&Schedule>,
) -> Promise {
    let worst = coverage.iter().min_by(|a, b| a.at_least.total_cmp(&b.at_least));
    let (Some(worst), Some(_)) = (worst, schedule) else {
        return Promise::not_judged(PromiseName::Coverage);
    };
    let all_washed = (0..plan.plates.len()).all(|i| coverage.iter().any(|c| c.plate == i));
    let mut measure = coverage_measure(worst, limits);
    if !all_washed {
        measure.bound = Some(0.0);
    }
    let place = Worst {
        plate: Some(worst.plate),
        ..Worst::default()
    };
    Promise::measured(PromiseName::Coverage, measure, place)
}
