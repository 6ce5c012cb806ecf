//! Assumed action of the controller at each instruction.
//!
//! The arm goes evenly in the joints to where a `servoj` sends it, and is there when its time is over. `movej` has a path in time of its
//! own: it may bring the arm to the start, before the program's time begins, and to where it stands already.

use crate::controller_settings::SettingList;
use crate::program::Place;
use crate::reading::{ReadPoint, ReadTool, Reading, SegmentShape};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::{JointVector, Pose};

/// Longest time of a `servoj` \[s\]: it hastens to where it is sent, which is even motion in short steps alone.
const LONGEST_S: f64 = 0.02;

/// Look-ahead times that a controller takes \[s\].
const LOOKAHEAD_S: [f64; 2] = [0.03, 0.2];

/// Gains that a controller takes.
const GAIN: [f64; 2] = [100.0, 2000.0];

/// Look-ahead time \[s\] and gain where a `servoj` states none.
const USUAL_SERVO: [f64; 2] = [0.1, 300.0];

/// Acceleration \[rad/s²\] and speed \[rad/s\] where a `movej` states none.
const USUAL_MOVE: [f64; 2] = [1.4, 1.05];

/// Largest motion of a `movej` where no motion is meant \[rad\].
const NOWHERE_RAD: f64 = 1e-6;

/// Joint positions beyond which no arm of the maker goes \[rad\]: two turns.
const FARTHEST_RAD: f64 = 4.0 * std::f64::consts::PI;

/// Instructions, each with its parameters in order.
const INSTRUCTIONS: [(&str, &[&str]); 12] = [
    ("set_tcp", &["pose"]),
    ("set_payload", &["m", "cog"]),
    ("movej", &["q", "a", "v", "t", "r"]),
    ("servoj", &["q", "a", "v", "t", "lookahead_time", "gain"]),
    ("stopj", &["a"]),
    ("popup", &["s", "title", "warning", "error", "blocking"]),
    ("textmsg", &["s1", "s2"]),
    ("set_digital_out", &["n", "b"]),
    ("set_standard_digital_out", &["n", "b"]),
    ("set_configurable_digital_out", &["n", "b"]),
    ("set_tool_digital_out", &["n", "b"]),
    ("set_standard_analog_out", &["n", "f"]),
];

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    Number(f64),
    Bool,
    Text,
    List(Vec<f64>),
    /// Position \[m\] and rotation vector \[rad\].
    Pose([f64; 6]),
}

impl Value {
    fn description(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Bool => "True or False",
            Self::Text => "a text",
            Self::List(_) => "a list",
            Self::Pose(_) => "a pose",
        }
    }

    fn number(&self) -> Result<f64, String> {
        match self {
            Self::Number(number) => Ok(*number),
            other => Err(format!("expected a number, found {}", other.description())),
        }
    }

    /// Reads a list of `COUNT` numbers.
    pub(crate) fn list<const COUNT: usize>(&self) -> Result<[f64; COUNT], String> {
        let found = match self {
            Self::List(list) => match list.as_slice().try_into() {
                Ok(numbers) => return Ok(numbers),
                Err(_) => format!("one of {}", list.len()),
            },
            other => other.description().to_owned(),
        };
        Err(format!("expected a list of {COUNT} numbers, found {found}"))
    }
}

/// Stage of the program so far.
#[derive(Debug, Default)]
enum Stage {
    /// No motion yet: the position of the arm is not known.
    #[default]
    Before,
    /// The arm stands at its start, or moves.
    Moving,
    /// The arm has been stopped for good.
    Stopped,
}

/// A controller, so far.
#[derive(Debug, Default)]
pub(crate) struct Controller {
    stage: Stage,
    t_s: f64,
    points: Vec<ReadPoint>,
    tip: Option<Pose>,
    load: Option<(f64, [f64; 3])>,
    settings: SettingList,
}

/// Values of an instruction's parameters, in their order; `None` where not given.
type ParameterValues = Vec<Option<Value>>;

impl Controller {
    /// The parameters of an instruction that is read.
    pub(crate) fn parameters(name: &str) -> Option<&'static [&'static str]> {
        INSTRUCTIONS
            .iter()
            .find(|(instruction, _)| *instruction == name)
            .map(|(_, parameters)| *parameters)
    }

    /// The points so far.
    pub(crate) fn points(&self) -> &[ReadPoint] {
        &self.points
    }

    /// Returns true once it moves beyond its start.
    fn moves(&self) -> bool {
        self.points.len() > 1
    }

    /// One of [`INSTRUCTIONS`].
    pub(crate) fn instruction(&mut self, name: &str, values: &ParameterValues, place: Place) -> Result<(), String> {
        match name {
            "set_tcp" => {
                let tip = pose(required(values, 0, "pose")?)?;
                self.check_first("the tip", self.tip.is_some_and(|before| before != tip))?;
                self.tip = Some(tip);
            }
            "set_payload" => {
                let load = load(values)?;
                self.check_first("the payload", self.load.is_some_and(|before| before != load))?;
                self.load = Some(load);
            }
            "movej" => return self.movej(values, place),
            "servoj" => return self.servoj(values, place),
            "stopj" => {
                let a = positive(values, 0, "a")?;
                self.settings.note("a of stopj", &a.to_string(), &place);
                if matches!(self.stage, Stage::Before) {
                    return Err("stopj before any motion".to_owned());
                }
                self.stage = Stage::Stopped;
            }
            "popup" if self.moves() && !matches!(self.stage, Stage::Stopped) => {
                return Err(
                    "a popup in the midst of the motion: how the arm moves while it waits is not modelled".to_owned(),
                );
            }
            _ => {
                required(values, 0, "text")?;
            }
        }
        Ok(())
    }

    /// Checks that a tool is set before any motion, and not to something else than before.
    fn check_first(&self, what: &str, is_other: bool) -> Result<(), String> {
        match (self.points.is_empty(), is_other) {
            (true, false) => Ok(()),
            (true, true) => Err(format!("{what} is set to something else than before; expected one")),
            (false, _) => Err(format!("{what} is set behind a motion; expected before the first")),
        }
    }

    fn movej(&mut self, values: &ParameterValues, place: Place) -> Result<(), String> {
        let q_rad = joints(values)?;
        for (k, name, setting) in [(1, "a", "a of movej"), (2, "v", "v of movej")] {
            let stated = match values.get(k).is_some_and(Option::is_some) {
                true => positive(values, k, name)?,
                false => USUAL_MOVE[k - 1],
            };
            self.settings.note(setting, &stated.to_string(), &place);
        }
        for (k, name) in [(3, "t"), (4, "r")] {
            let found = values.get(k).and_then(Option::as_ref).map_or(Ok(0.0), Value::number)?;
            if found != 0.0 {
                let reason = format!(
                    "movej with {name}: its ramps and blends are the controller's; expected servoj for what is timed"
                );
                return Err(reason);
            }
        }
        let Some(last) = self.points.last() else {
            self.stage = Stage::Moving;
            self.points.push(ReadPoint::new(place, 0.0, q_rad, None));
            return Ok(());
        };
        let away = (last.q_rad - q_rad).amax();
        if away > NOWHERE_RAD {
            return Err(format!(
                "movej to a place {away:.6} rad away in the midst of the motion: its path in time is the controller's; expected servoj"
            ));
        }
        match (self.moves(), &self.stage) {
            (true, Stage::Moving) => Err(
                "movej while the arm moves: how it stops and goes on is the controller's; expected it behind stopj"
                    .to_owned(),
            ),
            (true, _) => {
                self.settings.note("end", "movej behind stopj", &place);
                Ok(())
            }
            (false, _) => Ok(()),
        }
    }

    fn servoj(&mut self, values: &ParameterValues, place: Place) -> Result<(), String> {
        match self.stage {
            Stage::Before => {
                return Err("servoj before the arm is at its start; expected movej to the start first".to_owned());
            }
            Stage::Stopped => return Err("servoj behind stopj, which takes a time of its own".to_owned()),
            Stage::Moving => {}
        }
        let q_rad = joints(values)?;
        let t_s = positive(values, 3, "t")?;
        if t_s > LONGEST_S {
            return Err(format!(
                "servoj with t = {t_s} s: it hastens to its target, which is even motion up to {LONGEST_S} s alone"
            ));
        }
        for (k, name, range) in [(4, "lookahead_time", LOOKAHEAD_S), (5, "gain", GAIN)] {
            let stated = within(values, k, name, range)?;
            let stated = stated.unwrap_or(USUAL_SERVO[k - 4]);
            self.settings.note(name, &stated.to_string(), &place);
        }
        self.t_s += t_s;
        self.points.push(ReadPoint::new(place, self.t_s, q_rad, Some(0.0)));
        Ok(())
    }

    /// Returns the motion of the program that was run.
    pub(crate) fn reading(mut self, speed_share: Option<f64>) -> Result<Reading, String> {
        // Where it stays for a step, and at both ends, it rests.
        let stays: Vec<bool> = self
            .points
            .windows(2)
            .map(|pair| matches!(pair, [a, b] if a.q_rad == b.q_rad))
            .collect();
        let last = self.points.len().saturating_sub(1);
        for (k, point) in self.points.iter_mut().enumerate() {
            let rests = |k: usize| stays.get(k).copied().unwrap_or(true);
            if k == 0 || k == last || rests(k - 1) || rests(k) {
                point.corner_m = None;
            }
        }
        let tool = match (self.tip, self.load) {
            (tip, Some((mass_kg, com_m))) => Some(ReadTool {
                tip,
                mass_kg,
                com_m,
                inertia: None,
            }),
            (None, None) => None,
            (Some(_), None) => {
                return Err("the program sets a tip and no payload; expected set_payload".to_owned());
            }
        };
        Ok(Reading {
            speed_share,
            tool,
            settings: self.settings.into_vec(),
            ..Reading::from_points(self.points, SegmentShape::Lines)
        })
    }
}

fn required<'a>(values: &'a ParameterValues, k: usize, name: &str) -> Result<&'a Value, String> {
    match values.get(k) {
        Some(Some(value)) => Ok(value),
        _ => Err(format!("expected an argument \"{name}\"")),
    }
}

fn positive(values: &ParameterValues, k: usize, name: &str) -> Result<f64, String> {
    let found = required(values, k, name)?.number()?;
    match found > 0.0 {
        true => Ok(found),
        false => Err(format!("expected {name} above 0, found {found}")),
    }
}

/// The value of a parameter, if it is given, within its range.
fn within(values: &ParameterValues, k: usize, name: &str, [least, most]: [f64; 2]) -> Result<Option<f64>, String> {
    let Some(Some(value)) = values.get(k) else {
        return Ok(None);
    };
    let found = value.number()?;
    match (least..=most).contains(&found) {
        true => Ok(Some(found)),
        false => Err(format!("expected {name} from {least} to {most}, found {found}")),
    }
}

fn joints(values: &ParameterValues) -> Result<JointVector, String> {
    let value = required(values, 0, "q")?;
    if let Value::Pose(_) = value {
        return Err("expected joint positions, found a pose: which branch it means is the controller's".to_owned());
    }
    let q_rad = JointVector::from(value.list::<6>()?);
    match q_rad.iter().position(|q| q.abs() > FARTHEST_RAD) {
        None => Ok(q_rad),
        Some(k) => Err(format!(
            "joint {} at {} rad: expected within two turns, {FARTHEST_RAD:.3} rad; are these degrees?",
            k + 1,
            q_rad[k]
        )),
    }
}

fn load(values: &ParameterValues) -> Result<(f64, [f64; 3]), String> {
    let mass_kg = positive(values, 0, "m")?;
    let com_m = match values.get(1) {
        Some(Some(cog)) => cog.list::<3>()?,
        _ => [0.0; 3],
    };
    Ok((mass_kg, com_m))
}

/// A pose of its position and rotation vector.
fn pose(value: &Value) -> Result<Pose, String> {
    let Value::Pose([x, y, z, rx, ry, rz]) = *value else {
        return Err(format!(
            "expected a pose p[x, y, z, rx, ry, rz], found {}",
            value.description()
        ));
    };
    let turn = Vector3::new(rx, ry, rz);
    let angle = turn.norm();
    let rotation = match angle > 0.0 {
        true => {
            let (s, c) = sin_cos(0.5 * angle);
            let axis = turn / angle * s;
            UnitQuaternion::from_quaternion(Quaternion::new(c, axis.x, axis.y, axis.z))
        }
        false => UnitQuaternion::identity(),
    };
    Ok(Pose::from_parts(Vector3::new(x, y, z).into(), rotation))
}
