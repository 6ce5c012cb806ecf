//! Motion of a program: its procedures from `main` on, and each motion as a point in time.
//!
//! It reads the programs that [`super::write`] makes, and usual additions by hand: motions with `MoveAbsJ`, waits, speeds, zones,
//! messages, outputs and comments. The checks before the first motion are read as they are written, token by token. Everything
//! else is refused with its line: loops, conditions, jumps, assignments, functions, and motions that the controller times or
//! plans by itself.
//!
//! Numbers are IEEE singles, as on the controller. Joints are the maker's in the text, and the description's in the reading.

use crate::controller_settings::{Accepted, SettingList};
use crate::dialect::start_within::START_WITHIN_DEG;
use crate::joint_3::Joint3;
use crate::program::{Place, ProgramFile};
use crate::rapid::names;
use crate::rapid::parse::{self, Cursor, Data, Modules, PlacedToken, Procedure, Value, modules};
use crate::rapid::write::checks;
use crate::rapid::write::names::{MOST, RUNNING, SHARE};
use crate::reading::{MOST_LINES, ReadPoint, ReadTool, Reading, SegmentShape, Token};
use platewash_kinematics::JointVector;
use platewash_motion_proof::ReadError;
use std::collections::HashMap;

/// The checks before the first motion, in small letters.
const CHECK_SHARE: &str = "pwcheckshare";
const CHECK_START: &str = "pwcheckstart";
const CHECK_JOINT: &str = "pwcheckjoint";

/// Shares of accelerations and of their ramps \[%\] where no `AccSet` is carried out.
const USUAL_ACC_SET: [f32; 2] = [100.0, 100.0];

/// Share of the speed \[%\] and greatest speed of the tip \[mm/s\] where no `VelSet` is carried out.
const USUAL_VEL_SET: [f32; 2] = [100.0, 5000.0];

/// The tool of an arm that holds none.
const TOOL0: &str = "[TRUE,[[0,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]";

/// Options of `MoveAbsJ` that are refused, and why.
const REFUSED: [(&str, &str); 6] = [
    ("Conc", "lets the program run on during the motion"),
    ("ID", "is for arms that move in step"),
    ("V", "leaves the time of the motion to the controller; give it with \\T"),
    ("Z", "replaces the zone's radius; name a zone that has it"),
    ("Inpos", "changes when a stop counts as reached"),
    ("TLoad", "replaces the tool's load; state it in the tooldata"),
];

/// A statement of a procedure.
#[derive(Debug)]
enum Statement {
    Move(Box<Motion>),
    /// \[s\]
    Wait(Time),
    /// Call of a procedure, by its name in small letters.
    Call(String),
    Exit,
    /// A message, an output, or a setting that changes no motion.
    Nothing,
}

/// A `MoveAbsJ`.
#[derive(Debug)]
struct Motion {
    q_rad: JointVector,
    /// Place at which the target is declared.
    declared: Option<Place>,
    /// Speed data, as a name or a value.
    speed: String,
    time: Option<Time>,
    corner_m: Option<f64>,
    /// Zone, as a name or a value.
    zone: String,
    tool: ReadTool,
}

/// A time as it is written \[s\].
#[derive(Debug, Clone, Copy)]
struct Time {
    written_s: f32,
    /// True where it is divided by the share of the run.
    is_divided: bool,
}

/// Interprets a program.
///
/// # Errors
/// [`ReadError`] with the line that is not read.
pub(crate) fn reading(files: &[ProgramFile], joint_3: Joint3) -> Result<Reading, ReadError> {
    let modules = modules(files)?;
    let within_deg = check_blocks(&modules, joint_3)?;
    let mut procedures: Vec<_> = modules.procedures.iter().filter(|(key, _)| !is_block(key)).collect();
    procedures.sort_by_key(|(_, procedure)| &procedure.place);
    let statements = procedures.into_iter().map(|(key, procedure)| {
        let statements = modules.statements(procedure)?;
        Ok((key.as_str(), statements))
    });
    let statements: HashMap<_, _> = statements.collect::<Result<_, ReadError>>()?;
    let nowhere = Place::new(files.first().map_or("(no file)", |file| &file.name), 1);
    let mut run = Run::new(&modules, &statements);
    run.call("main", &nowhere)?;
    let main = modules
        .procedures
        .get("main")
        .map_or(nowhere, |main| main.place.clone());
    let mut reading = run.reading(main, within_deg)?;
    for point in &mut reading.points {
        point.q_rad = joint_3.convert_back(&point.q_rad);
    }
    Ok(reading)
}

fn is_block(key: &str) -> bool {
    [CHECK_SHARE, CHECK_START, CHECK_JOINT].contains(&key)
}

/// Checks that the procedures with the checks before the motion are as they were exported, and returns the largest distance from the start
/// that they allow \[°\].
fn check_blocks(found: &Modules, joint_3: Joint3) -> Result<f64, ReadError> {
    let states = |within_deg: &f64| {
        let check = found.procedures.get(CHECK_JOINT);
        check.is_some_and(|check| {
            check
                .body
                .iter()
                .any(|placed| placed.token == Token::Number(*within_deg))
        })
    };
    let [at_home, _] = START_WITHIN_DEG;
    let within_deg = START_WITHIN_DEG.into_iter().find(states).unwrap_or(at_home);
    let written = modules(&[ProgramFile {
        name: "checks".to_owned(),
        text: checks(within_deg, joint_3),
    }])?;
    for (key, expected) in &written.procedures {
        let Some(procedure) = found.procedures.get(key) else {
            continue;
        };
        let [found, expected] = [procedure, expected].map(|procedure| {
            let tokens = procedure.parameters.iter().chain(&procedure.body);
            tokens.collect::<Vec<_>>()
        });
        let same = |(a, b): &(&&PlacedToken, &&PlacedToken)| a.token.is_same(&b.token);
        let same = found.iter().zip(&expected).take_while(same).count();
        if same < found.len().max(expected.len()) {
            let line = found
                .get(same)
                .or(found.last())
                .map_or(procedure.place.line, |placed| placed.line);
            let reason = format!("{} is read only as it is exported; this line differs", procedure.name);
            return Err(ReadError::at(&procedure.place.file, line, reason));
        }
    }
    Ok(within_deg)
}

impl Modules {
    /// The statements of a procedure.
    fn statements(&self, procedure: &Procedure) -> Result<Vec<(Place, Statement)>, ReadError> {
        if !procedure.parameters.is_empty() {
            let reason = format!(
                "{} has parameters, which are not read: write out what moves",
                procedure.name
            );
            return Err(procedure.place.refused(reason));
        }
        let mut cursor = Cursor::new(&procedure.place.file, &procedure.body);
        let mut all = Vec::new();
        while cursor.peek().is_some() {
            let place = cursor.place();
            all.push((place, self.statement(&mut cursor)?));
            cursor.sign(";")?;
        }
        Ok(all)
    }

    fn statement(&self, cursor: &mut Cursor<'_>) -> Result<Statement, ReadError> {
        let begin = cursor.clone();
        let name = cursor.word("an instruction")?;
        let key = name.to_ascii_lowercase();
        match &*key {
            "moveabsj" => self.motion(cursor),
            "waittime" => {
                if cursor.take_sign("\\") {
                    cursor.keyword("InPos")?;
                    cursor.sign(",")?;
                }
                time(cursor).map(Statement::Wait)
            }
            "exit" => Ok(Statement::Exit),
            "accset" | "velset" => {
                let usual = if key == "accset" { USUAL_ACC_SET } else { USUAL_VEL_SET };
                let share = cursor.number()?;
                cursor.sign(",")?;
                let found = [share, cursor.number()?];
                match found == usual {
                    true => Ok(Statement::Nothing),
                    false => Err(begin.refused(format!(
                        "{name} changes how motions are timed: expected {},{}, as where it is not set; found {},{}",
                        usual[0], usual[1], found[0], found[1]
                    ))),
                }
            }
            "confj" | "confl" | "singarea" | "tperase" | "tpwrite" | "errwrite" | "set" | "reset" | "setdo"
            | "setgo" | "setao" | "pulsedo" | "invertdo" => {
                let mut before_is_operand = false;
                while let Some(token) = cursor.peek().filter(|token| !token.is(";")) {
                    let is_operand = !matches!(token, Token::Sign(_));
                    // Two of them are two statements, of which the first has no end.
                    if is_operand && before_is_operand {
                        return Err(cursor.expected("`,` or `;`"));
                    }
                    before_is_operand = is_operand;
                    cursor.next("`;`")?;
                }
                Ok(Statement::Nothing)
            }
            _ if self.procedures.contains_key(&key) => Ok(Statement::Call(key)),
            _ => Err(begin.refused(refusal_reason(&name, cursor.peek()))),
        }
    }

    fn motion(&self, cursor: &mut Cursor<'_>) -> Result<Statement, ReadError> {
        options(cursor, |cursor, _| Err(cursor.expected("a target")))?;
        let at = cursor.clone();
        let (target, declared) = self.named(cursor, "jointtarget")?;
        let q_rad = parse::target(&target).map_err(|reason| at.refused(reason))?;
        options(cursor, |cursor, option| match option {
            "noeoffs" => Ok(()),
            _ => Err(cursor.expected("\\NoEOffs or `,` after the target")),
        })?;
        cursor.sign(",")?;
        let speed = self.speed(cursor)?;
        let mut times = Vec::new();
        options(cursor, |cursor, option| match option {
            "t" => {
                cursor.sign(":=")?;
                times.push(time(cursor)?);
                Ok(())
            }
            _ => Err(cursor.expected("\\T or `,` after the speed")),
        })?;
        cursor.sign(",")?;
        let (corner_m, zone) = self.corner(cursor)?;
        options(cursor, |cursor, _| Err(cursor.expected("`,` after the zone")))?;
        cursor.sign(",")?;
        let at = cursor.clone();
        let tool = self.tool(cursor)?;
        let tool = parse::tool(&tool).map_err(|reason| at.refused(reason))?;
        options(cursor, |cursor, option| match option {
            "wobj" => {
                cursor.sign(":=")?;
                match cursor.take_word("wobj0") {
                    true => Ok(()),
                    false => Err(cursor.expected("the work object `wobj0`: MoveAbsJ needs no other")),
                }
            }
            _ => Err(cursor.expected("\\WObj or `;` after the tool")),
        })?;
        let time = match times[..] {
            [] => None,
            [time] => Some(time),
            _ => return Err(at.refused("\\T is given twice")),
        };
        Ok(Statement::Move(Box::new(Motion {
            q_rad,
            declared,
            speed,
            time,
            corner_m,
            zone,
            tool,
        })))
    }

    /// Declared data of a type by their name, or a literal; and where it is declared.
    fn named(&self, cursor: &mut Cursor<'_>, type_name: &str) -> Result<(Value, Option<Place>), ReadError> {
        let Some(Token::Word(name)) = cursor.peek() else {
            return Ok((cursor.value(0)?, None));
        };
        let value = self
            .of_type(name, type_name)
            .and_then(|data| Some((data.value.clone()?, Some(data.place.clone()))));
        let value = value.ok_or_else(|| cursor.expected(&format!("a {type_name} with a value")))?;
        cursor.next("a name")?;
        Ok(value)
    }

    /// Speed data, in words.
    fn speed(&self, cursor: &mut Cursor<'_>) -> Result<String, ReadError> {
        if let Some(Token::Word(name)) = cursor.peek()
            && names::is_speed(&name.to_ascii_lowercase())
        {
            cursor.next("a speed")?;
            return Ok(name.to_ascii_lowercase());
        }
        let at = cursor.clone();
        let value = self.named(cursor, "speeddata")?.0;
        match parse::is_speed(&value) {
            true => Ok(value.to_string()),
            false => Err(at.expected("speed data of four numbers")),
        }
    }

    /// The radius of the corner of a zone \[m\], `None` for a stop; and the zone in words.
    fn corner(&self, cursor: &mut Cursor<'_>) -> Result<(Option<f64>, String), ReadError> {
        if cursor.take_word("fine") {
            return Ok((None, "fine".to_owned()));
        }
        if let Some(Token::Word(name)) = cursor.peek()
            && let Some(mm) = names::zone_mm(&name.to_ascii_lowercase())
        {
            cursor.next("a zone")?;
            return Ok((Some(f64::from(mm) / 1e3), name.to_ascii_lowercase()));
        }
        let at = cursor.clone();
        let value = self.named(cursor, "zonedata")?.0;
        let corner_m = parse::corner(&value).map_err(|reason| at.refused(reason))?;
        let word = if corner_m.is_some() {
            value.to_string()
        } else {
            "fine".to_owned()
        };
        Ok((corner_m, word))
    }

    fn tool(&self, cursor: &mut Cursor<'_>) -> Result<Value, ReadError> {
        if cursor.take_word("tool0") {
            return parse::value_of(TOOL0);
        }
        Ok(self.named(cursor, "tooldata")?.0)
    }

    /// A number that is declared.
    fn number(&self, name: &str) -> Option<(f32, &Data)> {
        let data = self.of_type(name, "num")?;
        match data.value {
            Some(Value::Number(number)) => Some((number, data)),
            _ => None,
        }
    }
}

/// Options `\NAME` as far as they go, each handed to `read`.
fn options<'a>(
    cursor: &mut Cursor<'a>,
    mut read: impl FnMut(&mut Cursor<'a>, &str) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    while cursor.take_sign("\\") {
        let name = cursor.word("an option")?;
        if let Some((option, why)) = REFUSED.iter().find(|(option, _)| option.eq_ignore_ascii_case(&name)) {
            return Err(cursor.refused(format!("\\{option} {why}: it is not read")));
        }
        read(cursor, &name.to_ascii_lowercase())?;
    }
    Ok(())
}

/// A time: a number, which may be divided by the share of the run.
fn time(cursor: &mut Cursor<'_>) -> Result<Time, ReadError> {
    let at = cursor.clone();
    let written_s = cursor.number()?;
    if !(0.0..parse::UNUSED).contains(&written_s) {
        return Err(at.refused(format!("expected a time of 0 s or more, found {written_s}")));
    }
    let is_divided = cursor.take_sign("/");
    if is_divided && !cursor.take_word(RUNNING) {
        return Err(cursor.expected(&format!("`{}`", RUNNING)));
    }
    Ok(Time { written_s, is_divided })
}

/// Explains why a statement is refused.
fn refusal_reason(name: &str, next: Option<&Token>) -> String {
    const FLOW: &str = "IF FOR WHILE TEST GOTO RETURN RAISE RETRY TRYNEXT CONNECT";
    const HANDLERS: &str = "ERROR UNDO BACKWARD";
    let is_in = |words: &str| words.split(' ').any(|word| word.eq_ignore_ascii_case(name));
    let starts = |words: &[&str]| words.iter().any(|word| name.to_ascii_lowercase().starts_with(word));
    let why = if is_in(FLOW) || next.is_some_and(|token| token.is(":")) {
        "loops, conditions and jumps are not read: write out what moves"
    } else if is_in(HANDLERS) {
        "handlers are not read: they may run at any time"
    } else if is_in("VAR CONST PERS") {
        "data in a procedure are not read: declare them in the module"
    } else if next.is_some_and(|token| [":=", ".", "{"].iter().any(|sign| token.is(sign))) {
        "assignments are not read: write out what moves"
    } else if starts(&["move", "trigg", "search", "egm", "ind"]) {
        "the controller plans or times this motion; only MoveAbsJ with \\T is read"
    } else if starts(&["wait", "stop", "break", "tpread", "ui"]) {
        "it waits for an unknown time"
    } else {
        "it is neither a procedure of the program nor an instruction that is read"
    };
    format!("{name}: {why}")
}

/// A program that is carried out.
struct Run<'a> {
    modules: &'a Modules,
    statements: &'a HashMap<&'a str, Vec<(Place, Statement)>>,
    /// Procedures that run, the innermost last.
    calls: Vec<String>,
    points: Vec<ReadPoint>,
    tool: Option<ReadTool>,
    settings: SettingList,
    /// The share of the run, once it was checked, and the greatest that the check lets through.
    running: Option<f32>,
    most_share: Option<f64>,
    /// Configuration in which the arm was found to stand, once it was checked \[rad\].
    start_rad: Option<JointVector>,
    is_over: bool,
    steps: usize,
}

impl<'a> Run<'a> {
    fn new(modules: &'a Modules, statements: &'a HashMap<&'a str, Vec<(Place, Statement)>>) -> Self {
        Self {
            modules,
            statements,
            calls: Vec::new(),
            points: Vec::new(),
            tool: None,
            settings: SettingList::default(),
            running: None,
            most_share: None,
            start_rad: None,
            is_over: false,
            steps: 0,
        }
    }

    fn call(&mut self, key: &str, from: &Place) -> Result<(), ReadError> {
        let refused = |reason: String| from.refused(reason);
        if is_block(key) {
            return self.check(key).map_err(refused);
        }
        let Some(statements) = self.statements.get(key) else {
            return Err(refused(format!(
                "expected a procedure `{key}`, found none in these modules"
            )));
        };
        if self.calls.iter().any(|running| running == key) {
            return Err(refused(format!("{key} runs itself, which never ends")));
        }
        self.calls.push(key.to_owned());
        for (place, statement) in statements {
            self.steps += 1;
            if self.steps > MOST_LINES {
                return Err(refused(format!(
                    "more than {MOST_LINES} steps, the most that are carried out"
                )));
            }
            self.statement(place, statement)?;
            if self.is_over {
                break;
            }
        }
        self.calls.pop();
        Ok(())
    }

    fn statement(&mut self, place: &Place, statement: &Statement) -> Result<(), ReadError> {
        match statement {
            Statement::Move(motion) => self.motion(place, motion).map_err(|reason| place.refused(reason)),
            Statement::Wait(time) => self.wait(place, *time).map_err(|reason| place.refused(reason)),
            Statement::Call(key) => self.call(key, place),
            Statement::Exit => {
                self.is_over = true;
                Ok(())
            }
            Statement::Nothing => Ok(()),
        }
    }

    /// A check before the first motion, of an arm that stands at the start.
    fn check(&mut self, key: &str) -> Result<(), String> {
        if !self.points.is_empty() {
            return Err("this check must stand before the first motion".to_owned());
        }
        let declared = |name: &str| {
            let number = self.modules.number(name);
            number.ok_or_else(|| format!("expected `{name}` to be declared as a num with a value"))
        };
        match key {
            CHECK_SHARE => {
                let ((share, _), (most, Data { place, .. })) = (declared(SHARE)?, declared(MOST)?);
                if self.modules.of_type(RUNNING, "num").is_none_or(|data| data.is_constant) {
                    return Err(format!("expected `{RUNNING}` to be declared as VAR num"));
                }
                if !(share > 0.0 && share <= most) {
                    return Err(format!(
                        "the program ends before any motion: {SHARE} is {share}. It must be above 0 and at most {most}."
                    ));
                }
                self.running = Some(share);
                self.most_share = most.to_string().parse().ok();
                let accepted = Accepted::AtMost(f64::from(most));
                self.settings.note_with(MOST, &most.to_string(), place, accepted);
            }
            CHECK_START if self.modules.procedures.contains_key(CHECK_JOINT) => {
                let start = self
                    .modules
                    .of_type("pwstart", "jointtarget")
                    .and_then(|data| data.value.as_ref());
                self.start_rad = Some(parse::target(
                    start.ok_or("expected `pwStart` to be declared as a jointtarget")?,
                )?);
            }
            _ => return Err("expected pwCheckStart, and with it pwCheckJoint, as they are exported".to_owned()),
        }
        Ok(())
    }

    /// A time of this run \[s\].
    fn lasts(&self, time: Time) -> Result<f32, String> {
        match (time.is_divided, self.running) {
            (false, _) => Ok(time.written_s),
            (true, Some(share)) => Ok(time.written_s / share),
            (true, None) => Err(format!("expected pwCheckShare before the first use of `{}`", RUNNING)),
        }
    }

    fn motion(&mut self, place: &Place, motion: &Motion) -> Result<(), String> {
        if self.tool.is_some_and(|before| before != motion.tool) {
            return Err("expected the tool of the motions before, found another one".to_owned());
        }
        self.tool = Some(motion.tool);
        match (self.points.is_empty(), motion.time) {
            (true, Some(time)) => {
                let written = time.written_s.to_string();
                self.settings.note("\\T of the motion to the start", &written, place);
            }
            (true, None) => self
                .settings
                .note("speed data of the motion to the start", &motion.speed, place),
            (false, _) => self.settings.note("speed data", &motion.speed, place),
        }
        if let (false, Some(time)) = (self.points.is_empty(), motion.time) {
            let value = if time.is_divided { "yes" } else { "no" };
            self.settings.note("\\T divided by pwRunning", value, place);
        }
        self.settings.note("zone", &motion.zone, place);
        let (t_s, place) = match (self.points.last(), motion.time) {
            // The start of this motion is unknown: its duration is not counted.
            (None, _) if motion.corner_m.is_some() => {
                return Err(
                    "the first motion leads to the start and must stop there: expected `fine`, found a zone".to_owned(),
                );
            }
            (None, _) if self.start_rad.is_some_and(|start| start != motion.q_rad) => {
                return Err("pwCheckStart compares with pwStart: expected the first motion to lead there".to_owned());
            }
            // It has no time, only a target: the line is the one with its digits.
            (None, _) => (0.0, motion.declared.clone().unwrap_or_else(|| place.clone())),
            (Some(before), Some(time)) => match self.lasts(time)? {
                lasts_s if lasts_s > 0.0 => (before.t_s + f64::from(lasts_s), place.clone()),
                lasts_s => return Err(format!("expected a time above 0 s after \\T, found {lasts_s}")),
            },
            (Some(_), None) => {
                return Err(
                    "expected \\T after the speed: without it the controller decides the time of the motion".to_owned(),
                );
            }
        };
        let point = ReadPoint::new(place, t_s, motion.q_rad, motion.corner_m);
        self.points.push(point);
        Ok(())
    }

    fn wait(&mut self, place: &Place, time: Time) -> Result<(), String> {
        let wait_s = self.lasts(time)?;
        match self.points.last() {
            Some(last) if last.corner_m.is_some() => {
                Err("WaitTime after a motion that does not stop runs during it: expected `fine` before it".to_owned())
            }
            Some(last) if wait_s > 0.0 => {
                let t_s = last.t_s + f64::from(wait_s);
                self.points.push(ReadPoint::new(place.clone(), t_s, last.q_rad, None));
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Returns the motion of the program that was run.
    fn reading(self, main: Place, within_deg: f64) -> Result<Reading, ReadError> {
        let Some(last) = self.points.last() else {
            return Err(main.refused("the program ends before any motion"));
        };
        if !self.is_over {
            let reason = "main ends without EXIT: in continuous mode the program begins again, which is not judged";
            return Err(main.refused(reason));
        }
        if last.corner_m.is_some() {
            let reason = "the last motion must stop: expected `fine`, found a zone";
            return Err(last.place.refused(reason));
        }
        let speed_share = match self.modules.number(SHARE) {
            None => None,
            // The decimal that the program states, not the single next to it.
            Some((share, _)) if share > 0.0 && share <= 1.0 => share.to_string().parse().ok(),
            Some((_, data)) => {
                let reason = "expected a share of the speed above 0 and at most 1";
                return Err(data.place.refused(reason));
            }
        };
        Ok(Reading {
            speed_share,
            tool: self.tool,
            start_within_deg: self.start_rad.map(|_| within_deg),
            most_share: self.most_share,
            settings: self.settings.into_vec(),
            ..Reading::from_points(self.points, SegmentShape::RoundedLines)
        })
    }
}
