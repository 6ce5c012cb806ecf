//! Head of a program: its kind, its plan, its proof, and the assumptions of the proof. One statement per entry.

use crate::dialect::language::Dialect;
use crate::dialect::start_within::{START_WITHIN, start_within_deg};
use crate::judgement::{Case, ProgramJudgement};
use crate::points::Source;
use crate::program::Point;
use crate::settings::ExportSettings;
use crate::{maker_joints, tool_frame};
use nalgebra::{UnitQuaternion, Vector3};
use platewash_certificate::{Certificate, Certified, Check, Requirement, Sense, Unit};
use platewash_kinematics::tool_mount::ToolMount;
use platewash_kinematics::words::{decimals_down, decimals_up, fixed, rounded as rounded_to};
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel, sha256_hex};
use platewash_motion::plan::Plan;
use platewash_workcell::job::{Requirements, Soil};
use platewash_workcell::plate::Plate;
use platewash_workcell::words::{count_with_noun, plate_name, quoted};

/// Degrees in a radian.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;

/// Significant digits of assumed values.
const DIGITS: usize = 9;

/// Greatest number of plates whose positions are listed.
const MOST_PLATES: usize = 24;

/// The header of a program, of the points that it names. Before it is judged there is no verdict in it.
pub(crate) fn lines(
    certified: &Certified<Plan>,
    source: &Source<'_>,
    dialect: &dyn Dialect,
    settings: &ExportSettings,
    (points, judged): (&[Point], Option<&ProgramJudgement>),
) -> Vec<String> {
    let plan = certified.plan();
    let mut lines = vec![
        format!("platewash {}, target {}", env!("CARGO_PKG_VERSION"), dialect.name()),
        format!("scenario: {}", quoted(&plan.provenance.scenario)),
        format!("plan sha256: {}", plan.hash.as_deref().unwrap_or("none")),
        format!("certificate sha256: {}", hash(certified.certificate())),
        format!("the plan: {}", certified.certificate().headline),
    ];
    lines.extend(workcell(source));
    lines.extend(speeds(source, settings, points));
    if let Some(judged) = judged {
        lines.extend(verdict(judged, settings));
        let promised = contact_not_judged(&source.plan.job.judged_requirements());
        lines.extend(promised.map(|all| format!("Proved for the plan, not for this program: {all}.")));
    }
    lines.push("Assumed, not verified on a controller:".to_owned());
    let within_deg = start_within_deg(&plan.job).to_string();
    let assumed = dialect.assumptions().iter();
    lines.extend(assumed.map(|words| format!("- {}", words.replace(START_WITHIN, &within_deg))));
    let joint_3 = maker_joints::assumption(dialect, source.arm, (settings.joint_3, settings.speed_share), points);
    lines.extend(joint_3.map(|words| format!("- {words}")));
    let rests_on = &certified.certificate().rests_on.assumptions;
    lines.extend(rests_on.iter().map(|words| format!("- {words}")));
    let first = match plan.job.is_motion_home() {
        true => {
            "Before it runs: look whether the arm and the plates are as stated above, and take a small share of the speed."
        }
        false => "Before the first run: the dry run of this plan (platewash dry-run), and a small share of the speed.",
    };
    lines.push(first.to_owned());
    lines.push("This program is not a safety function.".to_owned());
    lines.extend(settings.lines());
    lines
}

/// SHA-256 of a certificate's canonical JSON (RFC 8785).
fn hash(certificate: &Certificate) -> String {
    serde_json_canonicalizer::to_vec(certificate).map_or_else(|_| "none".to_owned(), |text| sha256_hex(&text))
}

/// Describes the attitude of a link: upright, or a quaternion.
fn attitude(pose: &Pose) -> String {
    if pose.rotation == UnitQuaternion::identity() {
        return "upright".to_owned();
    }
    let q = pose.rotation.quaternion();
    let parts = [q.w, q.i, q.j, q.k].map(|part| fixed(part, 6)).join(", ");
    format!("turned by the quaternion (w, x, y, z) = ({parts})")
}

/// Describes where the arm stands, and its controller's base where that is another link than the root. The controller must know a turn of
/// the mount for its dynamics, and no program states it.
fn mount(mount: &Pose, arm: &RobotModel) -> String {
    let at = |pose: &Pose| {
        format!(
            "at {} mm of the world, {}",
            place(pose.translation.vector),
            attitude(pose)
        )
    };
    let set_up = match mount.rotation == UnitQuaternion::identity() {
        true => "",
        false => ": the controller must be set up for that mount",
    };
    match arm.controller_base() {
        None => format!("mount: base {}{set_up}", at(mount)),
        Some(base) => {
            let (root, link) = (quoted(base.root), quoted(base.link));
            let of_controller = at(&(mount * base.pose));
            format!(
                "mount: link {root} {}; the controller's base, link {link}, {of_controller}{set_up}",
                at(mount)
            )
        }
    }
}

/// Lines on arm, mount, tool, and the bodies around them.
fn workcell(source: &Source<'_>) -> Vec<String> {
    let job = &source.plan.job;
    let world = &job.workcell;
    let sponge = &world.tool.sponge;
    let mut lines = vec![
        format!(
            "arm: {}, URDF sha256 {}",
            quoted(&world.arm.name),
            world.arm.urdf_sha256
        ),
        mount(&world.mount, source.arm),
        format!(
            "tool: tip at {} mm of the flange; sponge of radius {} mm, {} mm high while it washes, free {} mm higher (assumed)",
            place(world.tool.tip.translation.vector),
            mm(sponge.radius_m),
            mm(sponge.height_m),
            mm(sponge.compression_m)
        ),
    ];
    if !world.arm.fixed.is_empty() {
        lines.push(format!(
            "held still: {} (rad, or m where it slides): this program does not move them, and they must be there before it runs",
            world.arm.fixed_words()
        ));
    }
    lines.extend(world.tool.mounted_on.as_deref().map(ToolMount::from_text).map(|mount| {
        let flange = match tool_frame::check_mount(&world.tool, source.arm) {
            Ok(()) => "the controller's flange is assumed to be there, its z along that axis",
            Err(_) => "the controller's flange is not there, or looks another way",
        };
        format!(
            "tool: mounted on link {} along its {}; {flange}",
            quoted(mount.link),
            mount.axis
        )
    }));
    let frame = match source.arm.controller_base() {
        Some(base) => Some(format!("link {}, not of the controller's base", quoted(base.root))),
        None => (world.mount != Pose::identity()).then(|| "the arm's base".to_owned()),
    };
    lines.extend(
        frame.map(|frame| format!("positions: in the frame of {frame}; places of plates and obstacles in the world")),
    );
    lines.extend(sponge.stiffness_pa.map(|stiffness_pa| {
        let [softest, stiffest] = stiffness_pa.map(|pa| rounded_to(1e-3 * pa, DIGITS));
        format!("sponge: stiffness from {softest} to {stiffest} kPa (assumed)")
    }));
    lines.extend(job.requirements.contact.map(|contact| {
        let error_mm = rounded_to(1e3 * contact.height_error_m, DIGITS);
        format!("plates: up to {error_mm} mm higher or lower than stated, for the contact that is proved of the plan (assumed)")
    }));
    lines.extend(world.tool.mass.map(|mass| {
        let com = place(Vector3::from(mass.com_m));
        format!("load: {} kg, centre of mass at {com} mm of the flange", mass.mass_kg)
    }));
    lines.extend(plates(&job.plates, &job.soils));
    let names: Vec<_> = world.obstacles.iter().map(|obstacle| quoted(&obstacle.name)).collect();
    let others = if names.is_empty() { "nothing" } else { &names.join(", ") };
    lines.push(format!(
        "the world of the proof is the arm, the tool, the plates and: {others}. What else stands or moves there, cables and people, is not in it."
    ));
    lines
}

/// Place and radius of each plate, and its tilt and profile where it has any; of the first [`MOST_PLATES`].
fn plates(plates: &[Plate], soils: &[Soil]) -> Vec<String> {
    let shown = plates.iter().enumerate().take(MOST_PLATES);
    let mut lines: Vec<String> = shown
        .map(|(k, plate)| {
            let (pole, rim) = (place(plate.world(&Vector3::zeros())), mm(plate.rim_m()));
            let besides = [
                plate.surface.profile_words(),
                plate.tilt_words(),
                plate.terms_words(soils),
            ];
            let besides: String = besides
                .into_iter()
                .flatten()
                .map(|words| format!(", {words}"))
                .collect();
            format!(
                "{}: middle of its face at {pole} mm of the world, radius {rim} mm{besides}",
                plate_name(k)
            )
        })
        .collect();
    if plates.len() > MOST_PLATES {
        lines.push(format!("and {} more plates", plates.len() - MOST_PLATES));
    }
    lines
}

/// A length in millimetres.
fn mm(m: f64) -> String {
    fixed(1e3 * m, 1)
}

/// Coordinates of a point in millimetres.
fn place(at: Vector3<f64>) -> String {
    <[f64; 3]>::from(at).map(mm).join(", ")
}

/// Duration, top speeds and the shortest step.
fn speeds(source: &Source<'_>, settings: &ExportSettings, points: &[Point]) -> Vec<String> {
    let share = settings.speed_share;
    let mut most = JointVector::zeros();
    source
        .motion
        .extremes()
        .for_each(|extremes| most = most.sup(&extremes.speed));
    let joints: Vec<_> = (0..AXES)
        .map(|j| decimals_up((most[j] * share).to_degrees(), 1))
        .collect();
    let plan_s = source.motion.duration_s();
    let steps = points.windows(2).map(|both| (both[1].t_s - both[0].t_s) / share);
    vec![
        format!(
            "{}, {:.3} s at a share of {share} of the plan's speed (the plan: {plan_s:.3} s); {} points, the nearest {:.1} ms apart",
            match source.plan.job.is_motion_home() {
                true => "the motion home".to_owned(),
                false => count_with_noun(source.plan.order.len(), "plate"),
            },
            plan_s / share,
            points.len(),
            1e3 * steps.fold(f64::INFINITY, f64::min)
        ),
        format!(
            "top speeds of the plan at that share: joints {} deg/s",
            joints.join(", ")
        ),
    ]
}

/// Lines on the proof of the text itself.
fn verdict(judgement: &ProgramJudgement, settings: &ExportSettings) -> Vec<String> {
    let corners = judgement.cases.iter().any(|case| case.corner_scale.is_some());
    let how = match corners {
        true => ", without corners and with corners of 0.5, 1 and 2 times their size",
        false => "",
    };
    let held = if judgement.holds() { "HOLDS" } else { "DOES NOT HOLD" };
    let share = settings.speed_share;
    let mut lines = vec![format!("Judged: the motion of this text, interpreted{how}: {held}")];
    lines.extend(judgement.worst().iter().map(|check| measure_text(check, "limit", 1.0)));
    lines.push(format!(
        "That is at a share of {share} of the plan's speed; at a lower one the path, as assumed below, is the same and every speed lower."
    ));
    lines.push(
        "Not judged: accelerations, rest where a plate is touched, and speeds of the tip: the controller times the motion. Implied by \
         it at that share, beside what the plan keeps:"
            .to_owned(),
    );
    lines.extend(judgement.implied().iter().map(|check| {
        let is_speed = check
            .measure
            .is_some_and(|measure| measure.unit == Unit::MetrePerSecond);
        measure_text(check, "plan", if is_speed { share } else { 1.0 })
    }));
    lines.extend(judgement.cases.iter().filter_map(|case| demands_text(case, share)));
    lines
}

/// Names the requirements of a plan about contact for which its program is not judged; `None` where it has none.
#[must_use]
pub fn contact_not_judged(promised: &Requirements) -> Option<String> {
    use Requirement as R;
    let of_contact = [R::Pressed, R::ContactTime, R::ContactDose, R::Strain, R::ContactForce]
        .map(|of| (of, promised.contact.is_some()));
    let others = [
        (R::ContactSpeed, promised.landing_m_s.or(promised.lifting_m_s).is_some()),
        (R::Wrist, promised.wrist_rad.is_some()),
        (R::PlateStays, promised.holder.is_some()),
    ];
    let asked = of_contact.into_iter().chain(others).filter(|(_, is_asked)| *is_asked);
    let all: Vec<_> = asked.map(|(requirement, _)| requirement.words()).collect();
    (!all.is_empty()).then(|| all.join(", "))
}

/// A measure with its limit, both times a factor.
fn measure_text(check: &Check, beside: &str, factor: f64) -> String {
    let name = check.requirement.words();
    let Some(measure) = check.measure else {
        return format!("- {name}: {}", check.detail());
    };
    let (scale, unit) = match measure.unit {
        Unit::Radian => (DEGREES, "deg"),
        Unit::RadianPerSecond => (DEGREES, "deg/s"),
        Unit::RadianPerSecondSquared => (DEGREES, "deg/s^2"),
        Unit::MetrePerSecondSquared => (1.0, "m/s^2"),
        other => other.scale(),
    };
    let (side, rounded): (_, fn(f64, usize) -> String) = match measure.sense {
        Sense::AtMost => ("at most", decimals_up),
        Sense::AtLeast | Sense::Above => ("at least", decimals_down),
    };
    let bound = measure
        .bound
        .map_or_else(|| "unknown".to_owned(), |v| rounded(v * factor * scale, 4));
    format!(
        "- {name}: {side} {bound} {unit} ({beside} {})",
        rounded_to(measure.limit * factor * scale, 6)
    )
}

/// Describes the demands of corners of one size on the controller; `None` where the motion is as smooth as the plan.
fn demands_text(case: &Case, speed_share: f64) -> Option<String> {
    let scale = case.corner_scale?;
    let share = |v: Option<f64>| v.map(|v| decimals_up(v * speed_share * speed_share, 2));
    let step = decimals_up((case.demands.speed_step_rad_s * speed_share).to_degrees(), 1);
    let both = share(case.demands.acceleration_median).zip(share(case.demands.acceleration_most));
    Some(match both {
        Some((median, most)) => format!(
            "- corners x {scale}: {median} times the plan's joint acceleration limit in the median, {most} at most; steps of speed up to \
             {step} deg/s at stops"
        ),
        None => format!("- no corners: steps of joint speed up to {step} deg/s"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: half a turn of the root link about z takes a base 100 mm ahead of it 100 mm back.
    #[test]
    fn the_mount_names_the_controllers_base_where_it_is_another_link() {
        let old = "<child link=\"base\"/>\n    <origin xyz=\"0 0 0\"/>";
        let new = old.replace("0 0 0", "0.1 0 0.3");
        let text = platewash_kinematics::irb120::IRB120_URDF.replace(old, &new);
        let arm = RobotModel::from_urdf(&text, &platewash_kinematics::urdf::MeshSource::none()).unwrap();
        let stands = Pose::new(Vector3::new(1.0, 0.0, 0.5), Vector3::z() * std::f64::consts::PI);
        assert_eq!(
            mount(&stands, &arm),
            "mount: link \"base_link\" at 1000.0, 0.0, 500.0 mm of the world, turned by the quaternion (w, x, y, z) = (0.000000, 0.000000, \
             0.000000, 1.000000); the controller's base, link \"base\", at 900.0, 0.0, 800.0 mm of the world, turned by the quaternion (w, x, \
             y, z) = (0.000000, 0.000000, 0.000000, 1.000000): the controller must be set up for that mount"
        );
        let plain = RobotModel::irb120().unwrap();
        assert_eq!(
            mount(&Pose::identity(), &plain),
            "mount: base at 0.0, 0.0, 0.0 mm of the world, upright"
        );
    }
}
