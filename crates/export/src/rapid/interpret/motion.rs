//! Motions, written down.

use super::argument::{Signature, Taken};
use super::joints;
use super::machine::{Machine, Run};
use super::share::SHARE;
use super::store::Binding;
use super::tool::{ToolFault, tool_of};
use super::value::{Value, component, part_of_record};
use crate::rapid::syntax::At;
use crate::rapid::syntax::ast::{Argument, Expression, Name};
use crate::reading::ReadPoint;
use platewash_kinematics::JointVector;

const MOVE_ABS_J: Signature = Signature {
    name: "MoveAbsJ",
    required: 4,
    options: &[
        ("conc", 0),
        ("id", 1),
        ("noeoffs", 1),
        ("v", 2),
        ("t", 2),
        ("z", 3),
        ("inpos", 3),
        ("wobj", 4),
        ("tload", 4),
    ],
};

/// Options of a motion that change when or where the arm moves, each with what it would do.
const UNMODELLED: [(&str, &str); 6] = [
    ("conc", "\\Conc lets the program run on during the motion"),
    ("id", "\\ID is for arms that move in step"),
    (
        "v",
        "\\V leaves the time of the motion to the controller; give it with \\T",
    ),
    ("z", "\\Z replaces the zone's radius; name a zone that has it"),
    ("inpos", "\\Inpos changes when a stop counts as reached"),
    ("tload", "\\TLoad replaces the tool's load; state it in the tooldata"),
];

/// How large a zone may be for turning, as a multiple of its radius at the tip: corners are judged up to twice their size.
const MOST_TURNING: f32 = 2.0;

const WAIT_TIME: Signature = Signature {
    name: "WaitTime",
    required: 1,
    options: &[("inpos", 0)],
};

impl<'a> Machine<'a> {
    /// `MoveAbsJ`.
    pub fn move_abs_j(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<()> {
        let taken = self.taken(name.at, &MOVE_ABS_J, arguments)?;
        for (option, why) in UNMODELLED {
            if let Some((at, _)) = taken.option(option) {
                return self.refuse(at, format!("{why}: it is not modelled"));
            }
        }
        let [target, speed, zone, tool] = taken.required[..] else {
            return self.refuse(name.at, "expected a target, a speed, a zone and a tool");
        };
        let q_rad = self.target(target)?;
        self.of_type(speed, "speeddata")?;
        let corner_m = self.corner(zone)?;
        self.use_tool(tool)?;
        self.check_work_object(&taken)?;
        self.check_share(name.at)?;
        let t_s = self.reached_at(name.at, &taken, zone.at, corner_m)?;
        let mut stated = (self.module(), name.at);
        if !self.motion.has_begun() {
            self.check_start(target.at, &q_rad)?;
            // It has no time, only a target: the line is the one with its digits.
            stated = self.declared(target).unwrap_or(stated);
        }
        self.arrive(stated, t_s, q_rad, corner_m);
        Ok(())
    }

    fn arrive(&mut self, (module, at): (usize, At), t_s: f64, q_rad: JointVector, corner_m: Option<f64>) {
        let Some(source) = self.sources.get(module) else {
            return;
        };
        self.motion.points.push(ReadPoint {
            place: source.place(at),
            t_s,
            q_rad,
            qd_rad_s: None,
            corner_m,
        });
    }

    fn target(&mut self, target: &'a Expression) -> Run<JointVector> {
        let value = self.of_type(target, "jointtarget")?;
        match joints::from_value(&value) {
            Ok(q_rad) => Ok(q_rad),
            Err(reason) => self.refuse(target.at, reason.to_string()),
        }
    }

    /// The radius of the corner of a zone \[m\]; `None` for a stop.
    fn corner(&mut self, zone: &'a Expression) -> Run<Option<f64>> {
        let value = self.of_type(zone, "zonedata")?;
        if part_of_record(&value, "finep") == Some(&Value::Truth(true)) {
            return Ok(None);
        }
        match component(&value, "pzone_tcp") {
            Some(mm) if mm >= 0.0 => {
                let turning = component(&value, "pzone_ori").unwrap_or(f32::NAN);
                if turning.is_nan() || turning > MOST_TURNING * mm {
                    return self.refuse(
                        zone.at,
                        format!(
                            "expected a zone for turning (pzone_ori) of at most {MOST_TURNING} times its radius at the tip, found {turning} and \
                             {mm} mm: how far from the target the corner begins is judged up to that"
                        ),
                    );
                }
                Ok(Some(f64::from(mm) / 1e3))
            }
            found => self.refuse(
                zone.at,
                format!("expected a zone's radius of 0 mm or more, found {found:?}"),
            ),
        }
    }

    fn use_tool(&mut self, tool: &'a Expression) -> Run<()> {
        let value = self.of_type(tool, "tooldata")?;
        let read = match tool_of(&value) {
            Ok(read) => read,
            Err(reason) => return self.refuse(tool.at, reason.to_string()),
        };
        match self.motion.tool {
            Some(before) if before != read => self.refuse(tool.at, ToolFault::Another.to_string()),
            _ => {
                self.motion.tool = Some(read);
                Ok(())
            }
        }
    }

    fn check_work_object(&mut self, taken: &Taken<'a>) -> Run<()> {
        let Some((at, value)) = taken.option("wobj") else {
            return Ok(());
        };
        let Some(value) = value else {
            return self.refuse(at, "expected \\WObj:= and a work object");
        };
        let found = self.of_type(value, "wobjdata")?;
        let wobj0 = super::predefined::predefined("wobj0").map(|wobj0| wobj0.value);
        if wobj0.and_then(|wobj0| found.replaced_by(wobj0).ok()).as_ref() == Some(&found) {
            return Ok(());
        }
        self.refuse(
            value.at,
            "expected the work object wobj0, found another one: MoveAbsJ needs none, and none is modelled",
        )
    }

    /// That the share of the speed is what it was before.
    fn check_share(&mut self, at: At) -> Run<()> {
        let key = SHARE.to_lowercase();
        let Some(Binding::Data(part)) = self.binding(&key) else {
            return Ok(());
        };
        self.make_ready(part.slot)?;
        let share = match self.value(&part) {
            Some(Value::Num(share)) => *share,
            _ => return self.refuse(at, format!("expected a num in {SHARE}")),
        };
        if !(share > 0.0 && share <= 1.0) {
            return self.refuse(
                at,
                format!("expected a share of the speed above 0 and at most 1 in {SHARE}, found {share}"),
            );
        }
        match self.motion.share {
            Some(before) if before != share => self.refuse(
                at,
                format!("{SHARE} was {before} and is {share} now: it must stay what it is"),
            ),
            _ => {
                self.motion.share = Some(share);
                Ok(())
            }
        }
    }

    /// When the target is reached \[s\].
    fn reached_at(&mut self, at: At, taken: &Taken<'a>, zone: At, corner_m: Option<f64>) -> Run<f64> {
        let time = match taken.option("t") {
            Some((at, None)) => return self.refuse(at, "expected \\T:= and a time in seconds"),
            Some((_, Some(value))) => Some((value.at, self.number(value)?)),
            None => None,
        };
        if let Some((at, time)) = time
            && !(time > 0.0 && time < joints::UNUSED)
        {
            return self.refuse(at, format!("expected a time above 0 s after \\T, found {time}"));
        }
        let before = self.motion.points.last().map(|point| point.t_s);
        match (before, time) {
            // From wherever the arm stands: how long that takes is not counted.
            (None, _) if corner_m.is_some() => self.refuse(
                zone,
                "the first motion leads to the start and must stop there: expected `fine`, found a zone",
            ),
            (None, _) => Ok(0.0),
            (Some(before), Some((_, time))) => Ok(before + f64::from(time)),
            (Some(_), None) => self.refuse(
                at,
                "expected \\T after the speed, found none: without it the controller decides the time of the motion",
            ),
        }
    }

    fn check_start(&self, at: At, q_rad: &JointVector) -> Run<()> {
        match self.start_rad {
            Some(start_rad) if self.start_asked && start_rad != *q_rad => self.refuse(
                at,
                "the program asks where the arm stands, and was told the target of the first MoveAbsJ in its text; it moves elsewhere first",
            ),
            _ => Ok(()),
        }
    }

    /// `WaitTime`: a rest.
    pub fn wait(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<()> {
        let taken = self.taken(name.at, &WAIT_TIME, arguments)?;
        let [time] = taken.required[..] else {
            return self.refuse(name.at, "expected a time");
        };
        let wait_s = self.number(time)?;
        if !(0.0..joints::UNUSED).contains(&wait_s) {
            return self.refuse(time.at, format!("expected a time of 0 s or more, found {wait_s}"));
        }
        let Some(last) = self.motion.points.last() else {
            return Ok(());
        };
        if last.corner_m.is_some() {
            return self.refuse(
                name.at,
                "WaitTime after a motion that does not stop runs during it: expected `fine` before it",
            );
        }
        if wait_s > 0.0 {
            let (t_s, q_rad) = (last.t_s + f64::from(wait_s), last.q_rad);
            self.arrive((self.module(), name.at), t_s, q_rad, None);
        }
        Ok(())
    }
}
