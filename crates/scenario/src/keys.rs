//! The one table of scenario keys: unit, range, meaning. The rows of `[wash]` are in `wash_keys.rs`, those of
//! `[floor]` and `[table]` in `room.rs`.

use crate::control::TIME_STEPS_S;
use crate::key::key;
pub use crate::key::{Domain, Key};
use crate::room::ROOM_KEYS;
use crate::wash_keys::WASH_KEYS;
use platewash_workcell::job::MAX_SEED;
use platewash_workcell::simulation::ControlLawName;

use Domain::{
    Bool, Integer, Joints, JointsAbove, Knots, Number, NumberAbove, PairAbove, Path, Paths, Points, Range, Text,
    Triple, Word,
};

/// Every key, in the order of the reference.
pub const KEYS: &[Key] = &joined::<{ BEFORE_WASH.len() + WASH_KEYS.len() + ROOM_KEYS.len() + BEHIND_WASH.len() }, 4>([
    BEFORE_WASH,
    WASH_KEYS,
    ROOM_KEYS,
    BEHIND_WASH,
]);

/// Parts of the table as one.
const fn joined<const N: usize, const PARTS: usize>(parts: [&[Key]; PARTS]) -> [Key; N] {
    let (mut all, mut part, mut at) = ([parts[0][0]; N], 0, 0);
    while part < parts.len() {
        let mut k = 0;
        while k < parts[part].len() {
            all[at] = parts[part][k];
            (k, at) = (k + 1, at + 1);
        }
        part += 1;
    }
    all
}

/// Those of the sections before `[wash]`.
const BEFORE_WASH: &[Key] = &[
    key("name", "", Text, "Name, for reports."),
    key(
        "seed",
        "",
        Integer(0, MAX_SEED as i64),
        "Seed of every random stream; the same seed gives the same bytes. Larger ones are no JSON numbers of their own.",
    ),
    key(
        "job.program",
        "",
        Word(&["paper", "certified"]),
        "Waypoint after waypoint as the paper's program, or planned as a whole, from home to home, with a certificate. Each uses \
         the keys that it needs.",
    ),
    key(
        "job.on_failure",
        "",
        Word(&["report", "fail"]),
        "A job that does not wash: report it (exit code 0), or also end with exit code 3 (infeasible) or 4 (verification failed).",
    ),
    key(
        "job.order",
        "",
        Word(&["nearest", "given", "fastest"]),
        "Order of the plates: always the nearest unvisited centre, as listed, or the least travel time in all (certified only).",
    ),
    key(
        "job.required_coverage",
        "",
        Number(0.0, 1.0),
        "Share of a plate's disc that the executed sponge must sweep for the plate to count as washed.",
    ),
    key("robot.model", "", Word(&["irb120"]), "Built-in arm."),
    key(
        "robot.urdf",
        "",
        Path,
        "Expanded URDF of another six-axis arm, in place of the built-in one; relative to the scenario's folder.",
    ),
    key(
        "robot.srdf",
        "",
        Path,
        "SRDF whose `disable_collisions` elements name the link pairs that need no check. Without it: adjacent pairs and pairs that always touch.",
    ),
    key(
        "robot.package_path",
        "",
        Paths,
        "Folders in which `package://` mesh names are looked up.",
    ),
    key(
        "robot.tool_frame",
        "",
        Word(&["flange", "tool0", "matlab_tool0"]),
        "Frame in which tool poses are stated and returned; nothing else changes.",
    ),
    key(
        "robot.start_deg",
        "deg",
        Joints(-36000.0, 36000.0),
        "Joint positions at the start, within the arm's limits; without it, a clear home that is looked for (certified), or 0 (paper).",
    ),
    key(
        "robot.home_deg",
        "deg",
        Joints(-36000.0, 36000.0),
        "Joint positions at the end, within the arm's limits; without it, those at the start (certified).",
    ),
    key(
        "robot.mount_m",
        "m",
        Triple(-10.0, 10.0),
        "Where the arm's base is in the world, whose z = 0 is the floor and whose z points up: 0.4 above it on a pedestal of that height.",
    ),
    key(
        "robot.mount_rpy_deg",
        "deg",
        Triple(-360.0, 360.0),
        "How the base is turned there: roll, pitch and yaw about the fixed axes x, y, z of the world; [180, 0, 0] hangs from a ceiling.",
    ),
    key(
        "robot.payload_kg",
        "kg",
        NumberAbove(0.0, 1e6),
        "Rated payload, against which the tool's mass is checked; without it, 3 kg for the built-in arm, unknown for others.",
    ),
    key(
        "tool.length_m",
        "m",
        Number(0.0, 2.0),
        "From the flange, along its normal, to the sponge's far face as it is pressed while it washes: the free sponge is longer by \
         sponge_compression_m. 0 means no tool body; above 0 in a certified job. From mount_m on where the tool is mounted elsewhere.",
    ),
    key("tool.radius_m", "m", NumberAbove(0.0, 1.0), "Radius of the handle."),
    key(
        "tool.handle",
        "",
        Word(&["round", "none"]),
        "What is between flange and sponge: a round handle, or nothing but the bodies of [[tool_body]].",
    ),
    key(
        "tool.mounted_on",
        "",
        Text,
        "Link behind joint 6 that carries the tool; the tool leaves it along the link's z axis, turned by mount_rpy_deg. Without it, \
         `tool0`; a description without a link of that name is refused.",
    ),
    key(
        "tool.mount_m",
        "m",
        Triple(-1.0, 1.0),
        "Where the tool begins, in the mounting frame of the flange: handle, sponge, tip, centre of mass and inertia follow it.",
    ),
    key(
        "tool.mount_rpy_deg",
        "deg",
        Triple(-360.0, 360.0),
        "How the tool is turned there: roll, pitch and yaw about the fixed axes x, y, z of the mounting frame. Unturned, it leaves the flange \
         along its normal.",
    ),
    key(
        "tool.sponge_radius_m",
        "m",
        NumberAbove(0.0, 1.0),
        "Radius of the sponge; decides coverage, also where there is no tool body.",
    ),
    key(
        "tool.sponge_height_m",
        "m",
        NumberAbove(0.0, 1.0),
        "Height of the sponge while it washes: the handle ends so far above the contact. With a tool body, below its length.",
    ),
    key(
        "tool.sponge_compression_m",
        "m",
        Number(0.0, 1.0),
        "How far the sponge is pressed in while it washes, and how much higher it is while nothing presses it: the tip may lift as \
         far and still touch. An assumption.",
    ),
    key(
        "tool.sponge_stiffness_kpa",
        "kPa",
        Range(1e-3, 1e6),
        "Least and greatest stiffness of the sponge, pressure over strain: an assumption. Without it, [11, 44] where wash.contact is \
         true, otherwise unknown.",
    ),
    key(
        "tool.mass_kg",
        "kg",
        Number(0.0, 1e4),
        "Mass of the tool, all its bodies together (none where length_m is 0): an assumption.",
    ),
    key(
        "tool.com_m",
        "m",
        Number(-10.0, 10.0),
        "Distance of the tool's centre of mass from where it begins, along its axis; without it, half its length, or what its bodies come to.",
    ),
    key(
        "tool.inertia_kg_m2",
        "kg·m²",
        Joints(-1e4, 1e4),
        "Inertia of the tool about its centre of mass: ixx, ixy, ixz, iyy, iyz, izz, z along the tool; without it, that of a \
         uniform cylinder, or of its bodies.",
    ),
    key(
        "layout.count",
        "",
        Integer(1, 1000),
        "Plates to sample; not used with `positions_m`.",
    ),
    key(
        "layout.plate_radius_m",
        "m",
        NumberAbove(0.0, 10.0),
        "Radius of a flat plate, 0.145 without it; above 0.000001 in a certified job. The other profiles have their own.",
    ),
    key(
        "layout.plate_profile",
        "",
        Word(&["flat", "coupe275", "rim270", "deep230", "dessert190"]),
        "Shape of the washing surface: a flat disc, or a profile that comes along. `coupe275` is fitted to a scan of a real plate; the \
         shapes of the others are assumptions.",
    ),
    key(
        "layout.plate_knots",
        "m, deg",
        Knots(10.0, 60.0),
        "Shape of the washing surface by knots of its meridian, from the pole on, in place of `plate_profile`: radius and slope, above 0 \
         where it rises outwards. Between knots the sine of the slope is linear in the radius: arcs and lines without a bend. At the pole \
         the slope is 0, so that the first piece is an arc: [[0.105, 10]] has its rim 9.2 mm over the pole.",
    ),
    key(
        "layout.plate_foot_m",
        "m",
        PairAbove(0.0, 1.0),
        "Radius and height of the ring that a plate stands on, below its body; its radius is at most that of the rim.",
    ),
    key(
        "layout.plate_height_m",
        "m",
        Number(-10.0, 10.0),
        "z of the pole of the washing surface: of a flat one all of it, of a profile the middle of its well.",
    ),
    key(
        "layout.plate_thickness_m",
        "m",
        NumberAbove(0.0, 1.0),
        "Thickness of a plate, downwards from its washing surface, along its axis; above 0.000001 in a certified job.",
    ),
    key(
        "layout.region",
        "",
        Word(&["text", "appendix"]),
        "Region of plate centres by name: as the paper's text, or as its appendix code.",
    ),
    key("layout.x_m", "m", Range(-10.0, 10.0), "Range of x of plate centres."),
    key("layout.y_m", "m", Range(-10.0, 10.0), "Range of y of plate centres."),
    key(
        "layout.rho_m",
        "m",
        Range(0.0, 10.0),
        "Range of the distance of plate centres from the base axis.",
    ),
    key(
        "layout.azimuth_deg",
        "deg",
        Range(-720.0, 720.0),
        "Range of the azimuth of plate centres, counter-clockwise from x, at most a turn wide.",
    ),
    key(
        "layout.min_distance_m",
        "m",
        Number(0.0, 10.0),
        "Plate centres are farther apart than this.",
    ),
    key(
        "layout.base_radius_m",
        "m",
        Number(0.0, 10.0),
        "Plate centres are farther from the base axis than this.",
    ),
    key(
        "layout.overlap",
        "",
        Word(&["report", "fail"]),
        "Plates that overlap each other or the base: a finding only, or refused before planning.",
    ),
    key(
        "layout.only_washable",
        "",
        Bool,
        "Whether sampled layouts are drawn anew until every plate can be washed whole (certified).",
    ),
    key(
        "layout.positions_m",
        "m",
        Points(-10.0, 10.0),
        "Plate centres, in place of sampling: as many plates as are listed.",
    ),
];

/// Those of the sections behind it.
const BEHIND_WASH: &[Key] = &[
    key(
        "ik.method",
        "",
        Word(&["numeric", "analytic"]),
        "Solver of the paper's program: damped least squares with a QP fallback, alone or also from the closed form's nearest branch.",
    ),
    key(
        "ik.seed",
        "",
        Word(&["executed", "previous"]),
        "Each waypoint is solved from the configuration that the arm really has (the paper), or from the previous answer.",
    ),
    key(
        "ik.position_tolerance_m",
        "m",
        Number(1e-12, 1e-2),
        "Largest accepted position error.",
    ),
    key(
        "ik.orientation_tolerance_rad",
        "rad",
        Number(1e-12, 1e-2),
        "Largest accepted orientation error.",
    ),
    key(
        "transition.interpolation",
        "",
        Word(&["zero_velocity", "c2_spline"]),
        "Curve between plates: cubics at rest at every waypoint (the paper), or one spline with continuous acceleration.",
    ),
    key(
        "transition.samples",
        "",
        Integer(2, 100_000),
        "Samples along the curve, both ends included.",
    ),
    key(
        "transition.mid_points",
        "",
        Integer(2, 1000),
        "Waypoints of the arc round the base, both ends included.",
    ),
    key(
        "transition.mid_radius_m",
        "m",
        NumberAbove(0.0, 10.0),
        "Radius of the arc; without it, max(layout.base_radius_m + 0.1, 0.3).",
    ),
    key("transition.mid_height_m", "m", Number(-10.0, 10.0), "z of the arc."),
    key(
        "limits.joint_acceleration_rad_s2",
        "rad/s²",
        JointsAbove(0.0, 1e6),
        "Joint acceleration limits, at least 0.001 in a certified job: an assumption, as the manufacturer publishes none.",
    ),
    key(
        "limits.tip_speed_m_s",
        "m/s",
        NumberAbove(0.0, 100.0),
        "Largest speed of the tip anywhere (certified), at least 0.000001: an assumption.",
    ),
    key(
        "limits.tip_acceleration_m_s2",
        "m/s²",
        NumberAbove(0.0, 1e4),
        "Largest acceleration of the tip anywhere (certified), at least 0.000001: an assumption.",
    ),
    key(
        "control.law",
        "",
        Word(&ControlLawName::NAMES),
        "How the arm follows: the paper's law or exactly, without a plant; or a law that gives torques (certified). Without it, \
         \"paper\" for the paper's program, \"computed_torque\" for a certified job.",
    ),
    key(
        "control.kp",
        "1/s",
        Number(0.0, 1e6),
        "Proportional gain of the paper's law.",
    ),
    key(
        "control.kd",
        "",
        Number(0.0, 1e6),
        "Derivative gain of the paper's law.",
    ),
    key(
        "control.dt_s",
        "s",
        Number(TIME_STEPS_S[0], TIME_STEPS_S[1]),
        "Time between waypoints.",
    ),
    key(
        "control.rate_hz",
        "Hz",
        Number(1.0, 1e5),
        "Samples of a torque law; its torque is held between them.",
    ),
    key(
        "control.frequency_rad_s",
        "rad/s",
        NumberAbove(0.0, 1e5),
        "Natural frequency ω of a torque law: kp = M ω², M each joint's largest inertia, or 1 for computed torque.",
    ),
    key(
        "control.damping_ratio",
        "",
        Number(0.0, 100.0),
        "Damping ratio ζ of a torque law: kd = 2 ζ ω M.",
    ),
    key(
        "control.joint_kp",
        "N·m/rad",
        Joints(0.0, 1e9),
        "Proportional gains of a torque law in place of those; in 1/s² for computed torque.",
    ),
    key(
        "control.joint_kd",
        "N·m·s/rad",
        Joints(0.0, 1e9),
        "Derivative gains of a torque law in place of those; in 1/s for computed torque.",
    ),
    key(
        "control.feed_forward",
        "",
        Word(&["none", "velocity"]),
        "What a torque law takes from the commanded motion besides positions; computed torque takes accelerations with speeds.",
    ),
    key(
        "plant.integrator",
        "",
        Word(&["semi_implicit_euler", "rk4"]),
        "How the motion is integrated: speeds then positions, or the classical fourth-order scheme.",
    ),
    key(
        "plant.substeps",
        "",
        Integer(1, 1000),
        "Steps of integration to a sample of the law.",
    ),
    key(
        "plant.viscous_friction_n_m_s",
        "N·m·s/rad",
        Joints(0.0, 1e6),
        "Friction torque per joint speed: off by default, as none is published.",
    ),
    key(
        "plant.coulomb_friction_n_m",
        "N·m",
        Joints(0.0, 1e6),
        "Friction torque against any motion: off by default, as none is published.",
    ),
    key(
        "plant.torque_limit_n_m",
        "N·m",
        JointsAbove(0.0, 1e6),
        "Largest joint torques; without it, those of the arm's description, where an effort of 0 means unknown, not a limit.",
    ),
    key(
        "plant.contact_stiffness_pa",
        "Pa",
        NumberAbove(0.0, 1e9),
        "Stiffness with which plates push the sponge's foam back, wherever it touches: an assumption, within tool.sponge_stiffness_kpa. Without \
         it, the geometric mean of that range; where neither is stated, and no force, plates do not push back.",
    ),
    key(
        "plant.contact_damping_pa_s",
        "Pa·s",
        Number(0.0, 1e9),
        "Damping of that foam, pressure over the speed of strain: off by default, as none is published.",
    ),
    key(
        "plant.contact_force_n",
        "N",
        Number(0.0, 1e4),
        "A constant force of a plate on the sponge while it washes, along the plate's normal, in place of the foam; 0 where plates shall not \
         push back.",
    ),
];
