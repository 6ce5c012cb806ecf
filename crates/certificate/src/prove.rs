//! Judgement of a plan: all requirements, one after the other.

use crate::clearance::exclusions::Exclusions;
use crate::clearance::pairs::{self, PairBound};
use crate::error::ProveError;
use crate::judged_job::{self, JudgedJob};
use crate::motion::piece::{self, Piece};
use crate::motion::timeline::Timeline;
use crate::motion::tip::{Arm, TipPiece};
use crate::motion::tip_limits::Tips;
use crate::motion::{joints, wrist};
use crate::plan_statements::schedule::{self, Schedule};
use crate::plan_statements::{dry_run, plates, wash_paths};
use crate::report::certificate::{CERTIFICATE_FORMAT, Certificate, HashFinding, Verdict, World};
use crate::report::check::{Check, Status};
use crate::report::headline::headline;
use crate::report::requirement::Requirement;
use crate::report::verdict_basis::VerdictBasis;
use crate::washing::contact;
use crate::washing::coverage::{self, Wash};
use crate::washing::plate_contact::PlateContact;
use crate::washing::plate_coverage::PlateCoverage;
use crate::washing::{contact_speed, following, holding, reach};
use platewash_kinematics::{AXES, RobotModel};
use platewash_motion::plan::{Knots, Plan, Process};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::JobTerms;

/// Greatest joint position for which sines are accurate (see [`platewash_kinematics::trig`]) \[rad\].
const MOST_TURN_RAD: f64 = 1e4;

/// Duration of the shortest piece whose cubic can be computed \[s\]. A joint that keeps within [`MOST_TURN_RAD`] is no faster than some 10⁵
/// rad over the duration. A quotient by the cube of the duration then stays below 10¹⁰⁰, and its square is finite.
const SHORTEST_S: f64 = 1e-30;

/// Proof about a motion alone, without its purpose.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionProof {
    /// Checks of joint positions, speeds and accelerations, of the tip's speed and acceleration, and of the clearance.
    pub checks: Vec<Check>,
    /// Clearance of each pair. The sponge must keep clear of the plates, too.
    pub clearance: Vec<PairBound>,
}

/// Judges a plan for an arm.
///
/// # Errors
/// [`ProveError`] for a plan that cannot be judged. A plan that breaks requirements is no error.
pub fn prove(plan: &Plan, arm: &RobotModel) -> Result<Certificate, ProveError> {
    prove_with(plan, arm, &CancelToken::new())
}

/// Same as [`prove`], with a token that cancels the work.
///
/// # Errors
/// As [`prove`], and [`ProveError::Cancelled`].
pub fn prove_with(plan: &Plan, arm: &RobotModel, cancel: &CancelToken) -> Result<Certificate, ProveError> {
    if [plan.process, Process::from(&plan.job.planner)].contains(&Process::Paper) {
        return Err(ProveError::PaperRun);
    }
    check_sizes(plan)?;
    check_job(&plan.job)?;
    // Judged in the frame of the arm's base, told in the world.
    let judged_plan = plan.judged();
    let seen = &*judged_plan.seen_from_base();
    let mut judged = JudgedJob::new(&seen.job, arm, wash_paths::by_plate(seen));
    judged.up = plan.job.workcell.mount.rotation.inverse() * judged.up;
    let pieces = read(&seen.knots)?;
    let timeline = timeline(&pieces, seen.knots.t_s.len())?;
    let (schedule, gaps) = match Schedule::new(seen, &pieces) {
        Ok(schedule) => (Some(schedule), Vec::new()),
        Err(gaps) => (None, gaps),
    };
    let under_proof = PlanUnderProof {
        plan: seen,
        judged: &judged,
        pieces: &pieces,
        timeline: &timeline,
        schedule: schedule.as_ref(),
        cancel,
    };
    let mut proof = under_proof.proof(Check::stated(Requirement::Segments, gaps))?;
    cancel.check()?;
    let world = World::from_mount(&plan.job.workcell.mount);
    world.move_to_world(&mut proof.checks, &mut proof.clearance, &mut proof.contact);
    Ok(certificate(plan, &judged_plan.job, arm, proof))
}

/// Judges a motion alone: limits of the joints and of the tip, and the clearance of every pair at all times, including that of the sponge
/// and the plates. Only pairs that the arm and its SRDF exclude are left out; exclusions of the job are ignored.
///
/// # Errors
/// [`ProveError`] for a motion or a job that cannot be judged.
pub fn prove_motion(
    knots: &Knots,
    job: &JobTerms,
    arm: &RobotModel,
    cancel: &CancelToken,
) -> Result<MotionProof, ProveError> {
    check_job(job)?;
    let (world, job) = (World::from_mount(&job.workcell.mount), &*job.seen_from_base());
    let judged = JudgedJob::new(job, arm, Vec::new());
    let pieces = read(knots)?;
    let timeline = timeline(&pieces, knots.t_s.len())?;
    let model = Exclusions::find(&judged)?.model(&judged)?;
    let carrier = Arm::new(arm, &job.workcell.tool, cancel);
    let tips = Tips::new(&carrier, &judged, &carrier.along(&pieces), None);
    let mut clearance = pairs::judge_all(arm, judged.job.requirements.clearance_m, &model, &timeline, cancel)?;
    pairs::add_still(judged.job.requirements.clearance_m, &model, &mut clearance);
    cancel.check()?;
    let mut checks = Vec::from(joints::checks(&pieces, &judged.joints, None));
    checks.extend(tips.moving_checks(&judged, &pieces, None));
    checks.extend(pairs::checks(judged.job.requirements.clearance_m, &clearance));
    world.move_to_world(&mut checks, &mut clearance, &mut []);
    Ok(MotionProof { checks, clearance })
}

/// The plan under judgement, with its motion.
struct PlanUnderProof<'a> {
    plan: &'a Plan,
    judged: &'a JudgedJob<'a>,
    pieces: &'a [Piece],
    timeline: &'a Timeline<'a>,
    schedule: Option<&'a Schedule>,
    cancel: &'a CancelToken,
}

/// Results of the proof of a plan.
struct Proof {
    checks: Vec<Check>,
    swept: Vec<PlateCoverage>,
    contact: Vec<PlateContact>,
    clearance: Vec<PairBound>,
    exclusions: Exclusions,
}

impl PlanUnderProof<'_> {
    /// Checks every requirement, in the order of the report and by its number in `docs/certificate.md`. `segments` is the check that was
    /// made before.
    fn proof(&self, segments: Check) -> Result<Proof, ProveError> {
        let Self {
            plan,
            judged,
            pieces,
            schedule,
            ..
        } = *self;
        // Several requirements use these.
        let exclusions = Exclusions::find(judged)?;
        let model = exclusions.model(judged)?;
        let arm = Arm::new(judged.robot, &judged.job.workcell.tool, self.cancel);
        // Tip and pairs are judged apart from each other, and neither keeps all threads busy.
        let judge_tip = || {
            let along = arm.along(pieces);
            let (tips, deviations) = rayon::join(
                || Tips::new(&arm, judged, &along, schedule),
                || following::checks(&arm, judged, (pieces, &along), schedule),
            );
            let wash_paths = wash_paths::check(plan);
            // A deviation bounds the distance from the plate only where the stated path is on it.
            let path_deviation_m = deviations[0].measure.and_then(|m| m.bound);
            let path_deviation_m = path_deviation_m.filter(|_| wash_paths.status == Status::Proved);
            let washes = self.washes(&arm, &along, &tips, path_deviation_m)?;
            Ok::<_, ProveError>((along, tips, wash_paths, deviations, washes))
        };
        let waived = exclusions.waived_in(&model);
        let judge_pairs = || pairs::judge(judged, &model, &waived, self.timeline, schedule, self.cancel);
        let (tip, clearance) = rayon::join(judge_tip, judge_pairs);
        let (along, tips, wash_paths, deviations, washes) = tip?;
        let clearance = clearance?;
        let contact: Vec<_> = washes.iter().filter_map(|wash| wash.contact).collect();
        let swept: Vec<_> = washes.into_iter().map(|wash| wash.swept).collect();
        let upright_cosine = |plate| schedule.map_or(0.0, |schedule| tips.least_upright_cosine_at(schedule, plate));

        let mut checks = vec![
            plates::arm(judged),    // 1
            plates::tool(judged),   // 2
            plates::plates(judged), // 3
        ];
        checks.extend(dry_run::check(judged)?); // 4
        checks.extend([
            exclusions.check(judged, &model, &clearance),           // 5
            wash_paths,                                             // 6
            segments,                                               // 7
            plates::every_plate_once(judged, plan, upright_cosine), // 8
            schedule::home_to_home(plan),                           // 9
            schedule::rest_at_wash_ends(plan, schedule),            // 10
            plates::plates_apart(judged)?,                          // 11
        ]);
        checks.extend(joints::checks(pieces, &judged.joints, schedule)); // 12–14: position, speed, acceleration
        checks.extend(tips.checks(judged, pieces, schedule)); // 15–20: speeds, accelerations, tilt, contact height
        checks.push(contact_speed::check(&arm, judged, (pieces, &along), schedule, &tips)); // 21: contact speed
        checks.extend(deviations); // 22, 23: path, line
        checks.extend(pairs::checks(judged.job.requirements.clearance_m, &clearance)); // 24: all pairs, pairs of reduced clearance
        checks.push(reach::check(judged, &swept)); // 25
        checks.push(coverage::check(judged, &swept)); // 26
        checks.extend(contact::checks(judged, pieces, schedule, &contact)); // 27–31: pressed, contact time, contact dose, strain, contact force
        checks.extend(wrist::check(judged, pieces, schedule)); // 32
        checks.extend(holding::check(judged, &contact)); // 33: plate stays
        checks.retain(|check| judged.asks_for(check.requirement));
        if let Some(from_face) = contact_speed::from_face(judged, &along, schedule, &tips) {
            let later = |check: &Check| check.requirement > from_face.requirement;
            let place = checks.iter().position(later).unwrap_or(checks.len());
            checks.insert(place, from_face);
        }
        Ok(Proof {
            checks,
            swept,
            contact,
            clearance,
            exclusions,
        })
    }

    /// Bounds on coverage, contact and reach of each wash; none where the segments are not known.
    fn washes(
        &self,
        arm: &Arm<'_>,
        pieces: &[TipPiece<'_>],
        tips: &Tips,
        path_deviation_m: Option<f64>,
    ) -> Result<Vec<Wash>, ProveError> {
        let judged = self.judged;
        let Some(schedule) = self.schedule else {
            return Ok(Vec::new());
        };
        let mut washes = coverage::washes(arm, judged, pieces, schedule, tips, self.cancel)?;
        let inputs = reach::ReachInputs {
            arm,
            pieces,
            schedule,
            tips,
            path_deviation_m,
        };
        reach::fill_in_reach(judged, &mut washes, &inputs);
        Ok(washes)
    }
}

fn certificate(plan: &Plan, judged: &JobTerms, arm: &RobotModel, proof: Proof) -> Certificate {
    let hash = HashFinding::check(plan);
    let sound = hash.status == Status::Proved && proof.checks.iter().all(|check| check.status.is_kept());
    let waived = proof.checks.iter().filter(|check| check.status == Status::Waived);
    let mut certificate = Certificate {
        format: CERTIFICATE_FORMAT.to_owned(),
        verdict: if sound { Verdict::Pass } else { Verdict::Fail },
        headline: String::new(),
        parent_compared: false,
        waived: waived.map(|check| check.requirement).collect(),
        scenario: plan.provenance.scenario.clone(),
        duration_s: plan.duration_s(),
        hash,
        checks: proof.checks,
        swept: proof.swept,
        contact: proof.contact,
        clearance: proof.clearance,
        rests_on: VerdictBasis::new(judged, arm, proof.exclusions),
    };
    certificate.headline = headline(&certificate);
    certificate
}

/// Checks that no list in a plan is so large that judging it takes too long.
fn check_sizes(plan: &Plan) -> Result<(), ProveError> {
    let plates = plan.job.plates.len();
    // Twice as many as there should be and more, so that what is wrong with a few too many is said by name.
    let most = plates.saturating_add(2).saturating_mul(8);
    let lists = [
        ("segments", plan.segments.len()),
        ("wash paths", plan.wash_paths.len()),
        ("entries of the order", plan.order.len()),
    ];
    match lists.into_iter().find(|(_, found)| *found > most) {
        Some((what, found)) => Err(ProveError::TooMany {
            what,
            found,
            plates,
            most,
        }),
        None => Ok(()),
    }
}

/// Checks that the job can be computed with, and that its bodies are valid.
pub(crate) fn check_job(job: &JobTerms) -> Result<(), ProveError> {
    job.validate().map_err(ProveError::Job)?;
    judged_job::check(&job.workcell)
}

/// Returns the pieces of the motion.
pub(crate) fn read(knots: &Knots) -> Result<Vec<Piece>, ProveError> {
    long_enough(piece::pieces(knots)?)
}

/// Returns the pieces. Refuses a piece so short that divisions by the cube of its duration overflow.
pub(crate) fn long_enough(pieces: Vec<Piece>) -> Result<Vec<Piece>, ProveError> {
    match pieces.iter().position(|piece| piece.length_s < SHORTEST_S) {
        Some(piece) => Err(ProveError::TooShort {
            piece,
            length_s: pieces[piece].length_s,
            least_s: SHORTEST_S,
        }),
        None => Ok(pieces),
    }
}

/// Returns the timeline of a motion. Refuses joint positions too large for accurate sines.
pub(crate) fn timeline(pieces: &[Piece], knots: usize) -> Result<Timeline<'_>, ProveError> {
    let timeline = Timeline::new(pieces);
    let Some(whole) = timeline.whole_extent() else {
        return Err(ProveError::NoMotion { found: knots });
    };
    let far = whole.most.abs().sup(&whole.least.abs());
    let too_far = |joint: usize| far[joint] > MOST_TURN_RAD || !pieces.iter().all(|p| p.has_finite_squares(joint));
    match (0..AXES).find(|&joint| too_far(joint)) {
        Some(joint) => Err(ProveError::TurnsTooFar {
            joint,
            position_rad: far[joint],
            most_rad: MOST_TURN_RAD,
        }),
        None => Ok(timeline),
    }
}
