//! Trajectories as ROS messages in YAML or JSON, of ROS 1 and ROS 2: `trajectory_msgs/JointTrajectory`, in the messages of planners, action
//! clients and recorders.
//!
//! Joints are matched by name. A stamp that is not zero becomes a note. Frame and number of a header, tolerances and efforts change nothing of
//! the positions that are asked of the joints, and are not read.

use crate::file::fixed_joints::{check_fixed, check_fixed_names};
use crate::file::wrapper::{self, FoundTrajectory, RobotState, number};
use crate::message::{
    Fault, Fields, Kind, NS_PER_S, Node, ParsedNumber, again, documents, list, parse_number, text,
    with_indented_brackets,
};
use crate::place::ReadError;
use crate::points::JointPoints;
use crate::time::ExactTime;
use platewash_kinematics::urdf::FixedJoints;
use platewash_kinematics::words::rounded;
use platewash_kinematics::{Joint, JointVector, RobotModel};
use platewash_workcell::words::quoted;

/// Greatest difference at which the state from which a trajectory was planned is its first point, or a joint is where it is judged \[rad, m\].
const SAME_START: f64 = 1e-4;

/// Reads the trajectories of a file: the points of each, and the line of each point.
pub(super) fn read_all(
    name: &str,
    text: &str,
    arm: &RobotModel,
    fixed: &FixedJoints,
) -> Result<Vec<(JointPoints, Vec<usize>)>, ReadError> {
    let other = "expected a trajectory .csv, .yaml, .yml or .json; found another name";
    let joints = Joints { arm, fixed };
    let read = || {
        let mut all = Vec::new();
        let indented;
        let roots = match documents(name, text, other) {
            // What YAML 1.1 alone reads, as ROS does; a text that neither reads is refused for what was found first.
            Err(fault) => {
                indented = with_indented_brackets(text);
                documents(name, &indented, other).map_err(|_| fault)?
            }
            roots => roots?,
        };
        for root in roots {
            for found in wrapper::find(&root)? {
                all.push(joints.read(found)?);
            }
        }
        match all.is_empty() {
            true => Fault::err(1, "expected a message; found nothing"),
            false => Ok(all),
        }
    };
    read().map_err(|fault| fault.in_file(name))
}

/// Joints that a message may have.
struct Joints<'a> {
    arm: &'a RobotModel,
    fixed: &'a FixedJoints,
}

/// Joints of a message, in its order.
struct Columns<'a> {
    names: Vec<String>,
    joints: &'a Joints<'a>,
    /// Place of each axis of the arm; `None` where it is fixed and left out.
    places: Vec<Option<usize>>,
}

fn trajectory(root: &Node<'_>, joints: &Joints<'_>) -> Result<(JointPoints, Vec<usize>), Fault> {
    let fields = Fields::new(root, "a JointTrajectory", &["header", "joint_names", "points"])?;
    let columns = joints.columns(fields.needed("joint_names")?)?;
    let stamp = fields.get("header").map(stamp).transpose()?.unwrap_or_default();
    let nodes = list(fields.needed("points")?)?;
    let (mut points, mut lines) = (JointPoints::default(), Vec::new());
    let (mut times, mut speeds, mut accelerations) = (Vec::new(), Vec::new(), Vec::new());
    let mut rates = Vec::new();
    let has_times = nodes.iter().any(|node| node.get("time_from_start").is_some());
    for node in nodes {
        let known = ["positions", "velocities", "accelerations", "effort", "time_from_start"];
        let point = Fields::new(node, "a JointTrajectoryPoint", &known)?;
        let row = |name| columns.row(&point, name);
        let Some(positions) = row("positions")? else {
            let count = columns.names.len();
            return node.refused(format!("expected {count} positions; found none"));
        };
        points.q_rad.push(positions);
        let [qd, qdd] = [row("velocities")?, row("accelerations")?];
        if qd.is_none() && qdd.is_some() {
            return node.refused("expected velocities beside the accelerations; found none");
        }
        rates.push(usize::from(qd.is_some()) + usize::from(qdd.is_some()));
        speeds.push(qd.unwrap_or_default());
        accelerations.push(qdd.unwrap_or_default());
        // A time that is left out is 0, as in messages.
        if has_times {
            let time = point.get("time_from_start").map(duration).transpose()?;
            times.push(time.unwrap_or_default());
        }
        if let [.., before, found] = times[..]
            && found <= before
        {
            let reason = format!("expected a time after {before} s, that of the point before; found {found} s");
            return point.get("time_from_start").unwrap_or(node).refused(reason);
        }
        lines.push(node.line);
    }
    if stamp != ExactTime::default() {
        points.notes.push(format!(
            "its header.stamp is {stamp} s: a controller that takes it later than that enters in its midst, which is not judged"
        ));
    }
    points.start = times.first().copied().unwrap_or_default();
    let after = |time: &ExactTime| time.since(points.start);
    points.t_s = (!times.is_empty()).then(|| times.iter().map(after).collect());
    let most = rates.iter().copied().max().unwrap_or(0);
    points.qd_rad_s = (most > 0).then_some(speeds);
    points.qdd_rad_s2 = (most > 1).then_some(accelerations);
    points.rates = rates.iter().any(|rate| *rate < most).then_some(rates);
    Ok((points, lines))
}

/// Reads the stamp of a header.
fn stamp(header: &Node<'_>) -> Result<ExactTime, Fault> {
    let fields = Fields::new(header, "a Header", &["stamp", "frame_id", "seq"])?;
    fields.get("stamp").map_or(Ok(ExactTime::default()), duration)
}

impl Joints<'_> {
    /// Reads a trajectory with what is stated around it.
    fn read(&self, found: FoundTrajectory<'_, '_>) -> Result<(JointPoints, Vec<usize>), Fault> {
        let (mut points, lines) = trajectory(found.node, self)?;
        points.notes.extend(found.notes);
        if let (Some(state), Some(first)) = (found.start, points.q_rad.first()) {
            let state = RobotState::read(state)?;
            points.notes.extend(self.start_notes(&state, first));
            points.notes.extend(state.notes);
        }
        Ok((points, lines))
    }

    /// Differences between the state from which a trajectory was planned, and its first point \[rad\].
    fn start_notes(&self, state: &RobotState, first: &JointVector) -> Vec<String> {
        let mut notes = Vec::new();
        let mut strangers = Vec::new();
        for (name, at) in &state.positions {
            let axis = self.arm.joints().iter().position(|joint| joint.name == *name);
            let judged = axis.map(|axis| first[axis]).or_else(|| self.fixed.get(name).copied());
            match judged {
                Some(judged) if (judged - at).abs() > SAME_START => {
                    let (name, [at, judged]) = (quoted(name), [*at, judged].map(|q| rounded(q, 6)));
                    notes.push(match axis {
                        Some(_) => format!(
                            "its trajectory_start has joint {name} at {at}, its first point at {judged}, and the way there is not judged"
                        ),
                        None => format!("its trajectory_start has joint {name} at {at}, which is judged at {judged}"),
                    });
                }
                Some(_) => {}
                None => strangers.push(quoted(name)),
            }
        }
        if !strangers.is_empty() {
            notes.push(format!(
                "its trajectory_start also has joints that the arm does not have: {}",
                strangers.join(", ")
            ));
        }
        notes
    }

    /// Reads the names of a message's joints.
    fn columns(&self, node: &Node<'_>) -> Result<Columns<'_>, Fault> {
        let known = self.arm.joints().each_ref().map(|joint| joint.name.as_str());
        let all = known.join(", ");
        let mut names: Vec<String> = Vec::new();
        for stated in list(node)? {
            let name = text(stated)?;
            if names.contains(&name) {
                return stated.refused(again(&name));
            }
            if !known.contains(&name.as_str()) && !self.fixed.contains_key(&name) {
                return stated.refused(format!(
                    "expected the arm's joints {all}; found {}, which is none of them (one that does not move can be fixed: --fix)",
                    quoted(&name)
                ));
            }
            names.push(name);
        }
        let place = |joint: &str| {
            let found = names.iter().position(|name| name == joint);
            match found {
                None if !self.fixed.contains_key(joint) => node.refused(format!(
                    "expected the arm's joints {all}; {} is missing (one that does not move can be fixed: --fix)",
                    quoted(joint)
                )),
                found => Ok(found),
            }
        };
        let places = known.into_iter().map(place).collect::<Result<_, _>>()?;
        let of_file = |name: &str| names.iter().any(|other| other == name);
        check_fixed_names(self.arm, self.fixed, of_file).or_else(|reason| node.refused(reason))?;
        let joints = self;
        Ok(Columns { names, joints, places })
    }
}

impl Columns<'_> {
    /// Numbers of a point, in the order of the arm's axes; `None` for a row that is left out or empty. Joints that are fixed are at rest.
    fn row(&self, point: &Fields<'_, '_>, name: &str) -> Result<Option<JointVector>, Fault> {
        let Some(node) = point.get(name) else { return Ok(None) };
        let row: Vec<_> = list(node)?.iter().map(number).collect::<Result<_, _>>()?;
        let expected = self.names.len();
        match row.len() {
            0 => return Ok(None),
            found if found != expected => {
                return node.refused(format!("expected {expected} {name}; found {found}"));
            }
            _ => {}
        }
        let at_rest = |at: f64| if name == "positions" { at } else { 0.0 };
        for (joint, found) in self.names.iter().zip(&row) {
            if let Some(at) = self.joints.fixed.get(joint) {
                check_fixed(joint, at_rest(*at), *found).or_else(|reason| node.refused(reason))?;
            }
        }
        let axes = self.joints.arm.joints().iter().zip(&self.places);
        let number = |(joint, place): (&Joint, &Option<usize>)| match place {
            Some(place) => row[*place],
            None => self.joints.fixed.get(&joint.name).copied().map_or(f64::NAN, at_rest),
        };
        Ok(Some(JointVector::from_iterator(axes.map(number))))
    }
}

/// A duration of ROS 2 (`sec`, `nanosec`) or ROS 1 (`secs`, `nsecs`, or both in a list, as its command line takes them).
fn duration(node: &Node<'_>) -> Result<ExactTime, Fault> {
    if let Kind::List(parts) = &node.kind {
        let whole = |part: &Node<'_>| number(part).ok().filter(|found| *found >= 0.0 && found.fract() == 0.0);
        let parts: Vec<_> = parts.iter().map(whole).collect();
        let [Some(s), Some(ns)] = parts[..] else {
            return node
                .refused("expected a Duration [secs, nsecs] of two whole numbers from 0 on; found another list");
        };
        return of_nanoseconds(node, s as i128 * i128::from(NS_PER_S) + ns as i128);
    }
    let fields = Fields::new(node, "a Duration", &["sec", "nanosec", "secs", "nsecs"])?;
    if matches!(&node.kind, Kind::Table(entries) if entries.is_empty()) {
        return node.refused("expected a Duration with sec; it is missing");
    }
    let has = |keys: [&str; 2]| keys.into_iter().any(|key| fields.get(key).is_some());
    if has(["sec", "nanosec"]) && has(["secs", "nsecs"]) {
        let reason =
            "expected a Duration of ROS 2 with sec and nanosec, or of ROS 1 with secs and nsecs; found keys of both";
        return node.refused(reason);
    }
    // What is left out is 0, as in messages.
    let whole = |keys: [&str; 2]| {
        let Some(node) = keys.into_iter().find_map(|key| fields.get(key)) else {
            return Ok(0);
        };
        match parse_number(node) {
            ParsedNumber::Whole(found) if found >= 0 => Ok(i128::from(found)),
            _ => node.unexpected("a whole number from 0 on"),
        }
    };
    let ns = whole(["sec", "secs"])? * i128::from(NS_PER_S) + whole(["nanosec", "nsecs"])?;
    of_nanoseconds(node, ns)
}

fn of_nanoseconds(node: &Node<'_>, ns: i128) -> Result<ExactTime, Fault> {
    let refused = || node.refused("expected a time of at most 1e15 s; found more");
    ExactTime::of_nanoseconds(ns).map_or_else(refused, Ok)
}
