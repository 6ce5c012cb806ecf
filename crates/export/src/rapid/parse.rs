//! Modules as data and procedures.
//!
//! Values of a motion: joint targets, zones and tools.

use crate::program::{Place, ProgramFile};
use crate::rapid::names::is_taken;
use crate::reading::{self, Line, ReadTool, Token};
use nalgebra::{Quaternion, Translation3, UnitQuaternion};
use platewash_kinematics::{JointVector, Pose};
use platewash_motion_proof::ReadError;
use std::collections::HashMap;
use std::fmt;

/// Deepest nesting of brackets in a value.
const DEEPEST: usize = 8;

/// A token and its line, from 1.
#[derive(Debug, Clone)]
pub(crate) struct PlacedToken {
    pub(crate) token: Token,
    pub(crate) line: usize,
}

/// A value of literals.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    /// A number, as the controller's single.
    Number(f32),
    Truth(bool),
    Text,
    List(Vec<Value>),
}

/// Declared data.
#[derive(Debug)]
pub(crate) struct Data {
    pub(crate) place: Place,
    /// Type of the declaration, in lower case.
    pub(crate) type_name: String,
    pub(crate) is_constant: bool,
    /// `None` where none is stated.
    pub(crate) value: Option<Value>,
}

/// A procedure.
#[derive(Debug)]
pub(crate) struct Procedure {
    pub(crate) place: Place,
    /// Name of the procedure, as it is spelled.
    pub(crate) name: String,
    /// Tokens between the brackets behind its name.
    pub(crate) parameters: Vec<PlacedToken>,
    /// Tokens before `ENDPROC`.
    pub(crate) body: Vec<PlacedToken>,
}

/// The modules of a program; names in small letters.
#[derive(Debug, Default)]
pub(crate) struct Modules {
    pub(crate) data: HashMap<String, Data>,
    pub(crate) procedures: HashMap<String, Procedure>,
    names: HashMap<String, Place>,
}

/// Reads all modules.
///
/// # Errors
/// [`ReadError`] with the line that is not read.
pub(crate) fn modules(files: &[ProgramFile]) -> Result<Modules, ReadError> {
    let mut modules = Modules::default();
    for file in files {
        let tokens = tokens_of(file)?;
        let mut cursor = Cursor::new(&file.name, &tokens);
        while cursor.peek().is_some() {
            modules.module(&mut cursor)?;
        }
    }
    Ok(modules)
}

/// The tokens of a file, but for the header of files that a controller has saved.
fn tokens_of(file: &ProgramFile) -> Result<Vec<PlacedToken>, ReadError> {
    let mut marks = 0;
    let is_header = |text: &str, is_first: bool| {
        let is_mark = is_first && marks < 2 && text.trim() == "%%%";
        marks += usize::from(is_mark);
        let has_key = |key| text.trim_start().starts_with(key);
        is_mark || (marks == 1 && ["VERSION:", "LANGUAGE:"].into_iter().any(has_key))
    };
    let placed = |Line { number: line, tokens }| tokens.into_iter().map(move |token| PlacedToken { token, line });
    Ok(reading::lines(file, '!', is_header)?
        .into_iter()
        .flat_map(placed)
        .collect())
}

impl Modules {
    /// Data of a type, by name.
    pub(crate) fn of_type(&self, name: &str, type_name: &str) -> Option<&Data> {
        let data = self.data.get(&name.to_ascii_lowercase());
        data.filter(|data| data.type_name == type_name)
    }

    fn module(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        cursor.keyword("MODULE")?;
        self.declare(cursor)?;
        if cursor.take_sign("(") {
            while !cursor.take_sign(")") {
                cursor.next("`)`")?;
            }
        }
        while !cursor.take_word("ENDMODULE") {
            let is_task = cursor.take_word("TASK");
            if cursor.take_word("PROC") {
                self.procedure(cursor)?;
            } else if let Some(storage) = ["CONST", "PERS", "VAR"].into_iter().find(|word| cursor.take_word(word)) {
                self.data(cursor, storage == "CONST")?;
            } else {
                let expected = if is_task {
                    "data"
                } else {
                    "CONST, PERS, VAR, PROC without LOCAL, or ENDMODULE"
                };
                return Err(cursor.expected(expected));
            }
        }
        Ok(())
    }

    /// A name that is declared once, and its place.
    fn declare(&mut self, cursor: &mut Cursor<'_>) -> Result<(String, Place), ReadError> {
        let place = cursor.place();
        let name = cursor.word("a name")?;
        if is_taken(&name) {
            return Err(place.refused(format!("the name {name} is the controller's own")));
        }
        if let Some(other) = self.names.insert(name.to_ascii_lowercase(), place.clone()) {
            return Err(place.refused(format!("{name} is declared twice; see {other}")));
        }
        Ok((name, place))
    }

    fn data(&mut self, cursor: &mut Cursor<'_>, is_constant: bool) -> Result<(), ReadError> {
        let type_name = cursor.word("a type")?.to_ascii_lowercase();
        let (name, place) = self.declare(cursor)?;
        let value = cursor.take_sign(":=").then(|| cursor.value(0)).transpose()?;
        cursor.sign(";")?;
        let data = Data {
            place,
            type_name,
            is_constant,
            value,
        };
        self.data.insert(name.to_ascii_lowercase(), data);
        Ok(())
    }

    fn procedure(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let (name, place) = self.declare(cursor)?;
        cursor.sign("(")?;
        let parameters = cursor.up_to(|token| token.is(")"), "`)`")?;
        let body = cursor.up_to(|token| token.is_same(&Token::Word("ENDPROC".to_owned())), "ENDPROC")?;
        let key = name.to_ascii_lowercase();
        self.procedures.insert(
            key,
            Procedure {
                place,
                name,
                parameters,
                body,
            },
        );
        Ok(())
    }
}

/// Tokens one by one.
#[derive(Debug, Clone)]
pub(crate) struct Cursor<'a> {
    file: &'a str,
    tokens: &'a [PlacedToken],
    at: usize,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(file: &'a str, tokens: &'a [PlacedToken]) -> Self {
        Self { file, tokens, at: 0 }
    }

    pub(crate) fn peek(&self) -> Option<&'a Token> {
        self.tokens.get(self.at).map(|placed| &placed.token)
    }

    /// The place of the next token; at the end that of the last one.
    pub(crate) fn place(&self) -> Place {
        let placed = self.tokens.get(self.at).or(self.tokens.last());
        Place::new(self.file, placed.map_or(1, |placed| placed.line))
    }

    pub(crate) fn refused(&self, reason: impl Into<String>) -> ReadError {
        self.place().refused(reason)
    }

    pub(crate) fn expected(&self, what: &str) -> ReadError {
        let found = self.peek().map_or_else(|| "the end".to_owned(), ToString::to_string);
        self.refused(format!("expected {what}, found {found}"))
    }

    pub(crate) fn next(&mut self, expected: &str) -> Result<&'a Token, ReadError> {
        let token = self.peek().ok_or_else(|| self.expected(expected))?;
        self.at += 1;
        Ok(token)
    }

    pub(crate) fn word(&mut self, expected: &str) -> Result<String, ReadError> {
        match self.peek() {
            Some(Token::Word(word)) => {
                self.at += 1;
                Ok(word.clone())
            }
            _ => Err(self.expected(expected)),
        }
    }

    /// Takes the next token if it is that word; returns true if so.
    pub(crate) fn take_word(&mut self, word: &str) -> bool {
        let is_it = matches!(self.peek(), Some(Token::Word(found)) if found.eq_ignore_ascii_case(word));
        self.at += usize::from(is_it);
        is_it
    }

    pub(crate) fn keyword(&mut self, word: &str) -> Result<(), ReadError> {
        match self.take_word(word) {
            true => Ok(()),
            false => Err(self.expected(&format!("`{word}`"))),
        }
    }

    pub(crate) fn take_sign(&mut self, sign: &str) -> bool {
        let is_it = self.peek().is_some_and(|token| token.is(sign));
        self.at += usize::from(is_it);
        is_it
    }

    pub(crate) fn sign(&mut self, sign: &str) -> Result<(), ReadError> {
        match self.take_sign(sign) {
            true => Ok(()),
            false => Err(self.expected(&format!("`{sign}`"))),
        }
    }

    /// The tokens before the first one that ends them, which is taken, too.
    pub(crate) fn up_to(
        &mut self,
        ends: impl Fn(&Token) -> bool,
        expected: &str,
    ) -> Result<Vec<PlacedToken>, ReadError> {
        let from = self.at;
        while !ends(self.next(expected)?) {}
        Ok(self.tokens[from..self.at - 1].to_vec())
    }

    /// A value of literals.
    pub(crate) fn value(&mut self, depth: usize) -> Result<Value, ReadError> {
        if depth > DEEPEST {
            return Err(self.refused(format!("brackets nested deeper than {DEEPEST}")));
        }
        if self.take_sign("[") {
            let mut values = vec![self.value(depth + 1)?];
            while self.take_sign(",") {
                values.push(self.value(depth + 1)?);
            }
            self.sign("]")?;
            return Ok(Value::List(values));
        }
        if self.take_word("TRUE") {
            return Ok(Value::Truth(true));
        }
        if self.take_word("FALSE") {
            return Ok(Value::Truth(false));
        }
        if let Some(Token::Text(_)) = self.peek() {
            self.at += 1;
            return Ok(Value::Text);
        }
        self.number().map(Value::Number)
    }

    /// A literal number, as the controller's single.
    pub(crate) fn number(&mut self) -> Result<f32, ReadError> {
        let sign = match self.take_sign("-") {
            true => -1.0,
            false => {
                self.take_sign("+");
                1.0
            }
        };
        match self.peek() {
            Some(Token::Number(number)) if *number <= f64::from(f32::MAX) => {
                self.at += 1;
                Ok((sign * number) as f32)
            }
            _ => Err(self.expected("a number")),
        }
    }
}

/// Value that stands for an axis that is not used \[°\].
pub(crate) const UNUSED: f32 = 9e9;

/// Least mass that a controller takes \[kg\].
pub(crate) const LEAST_KG: f64 = 0.001;

/// Largest deviation from 1 of the length of a quaternion of four singles.
const UNIT: f64 = 1e-4;

/// Largest zone for turning, as a multiple of its radius at the tip: corners are judged up to twice their size.
const MOST_TURNING: f32 = 2.0;

impl Value {
    fn list<const N: usize>(&self) -> Option<[&Self; N]> {
        match self {
            Self::List(values) => values.iter().collect::<Vec<_>>().try_into().ok(),
            _ => None,
        }
    }

    fn number(&self) -> Option<f32> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    fn numbers<const N: usize>(&self) -> Option<[f32; N]> {
        let numbers: Option<Vec<_>> = self.list::<N>()?.into_iter().map(Self::number).collect();
        numbers?.try_into().ok()
    }
}

impl fmt::Display for Value {
    /// Writes it as RAPID has it, a text as `"…"`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Truth(true) => f.write_str("TRUE"),
            Self::Truth(false) => f.write_str("FALSE"),
            Self::Text => f.write_str("\"…\""),
            Self::List(values) => {
                let values: Vec<_> = values.iter().map(Self::to_string).collect();
                write!(f, "[{}]", values.join(","))
            }
        }
    }
}

/// A value that a text states.
pub(crate) fn value_of(text: &str) -> Result<Value, ReadError> {
    let (name, text) = ("value".to_owned(), text.to_owned());
    let tokens = tokens_of(&ProgramFile { name, text })?;
    Cursor::new("value", &tokens).value(0)
}

/// Joint positions of a joint target \[rad\].
pub(crate) fn target(value: &Value) -> Result<JointVector, String> {
    let parts = value
        .list()
        .and_then(|[robot, external]| Some((robot.numbers::<6>()?, external.numbers::<6>()?)));
    let (robot, external) = parts.ok_or("expected a joint target [[6 angles],[6 external axes]]")?;
    if let Some(joint) = robot.iter().position(|deg| deg.abs() >= UNUSED) {
        return Err(format!(
            "expected an angle in degrees for joint {}, found {:E}",
            joint + 1,
            robot[joint]
        ));
    }
    if external != [UNUSED; 6] {
        return Err("expected 9E9 for every external axis: external axes are not read".to_owned());
    }
    Ok(JointVector::from(robot.map(|deg| f64::from(deg).to_radians())))
}

/// The radius of the corner of a zone \[m\]; `None` for a stop.
pub(crate) fn corner(value: &Value) -> Result<Option<f64>, String> {
    let shape = || "expected zone data [FALSE,5,8,8,0.8,8,0.8]".to_owned();
    let [is_stop, rest @ ..] = value.list::<7>().ok_or_else(shape)?;
    let numbers: Option<Vec<_>> = rest.into_iter().map(Value::number).collect();
    match (is_stop, numbers.as_deref()) {
        (Value::Truth(true), Some(_)) => Ok(None),
        (Value::Truth(false), Some([tip, turning, ..])) if *tip >= 0.0 => match *turning <= MOST_TURNING * tip {
            true => Ok(Some(f64::from(*tip) / 1e3)),
            false => Err(format!(
                "expected a zone for turning (pzone_ori) of at most {MOST_TURNING} times its radius at the tip, found {turning} and {tip} \
                 mm: how far from the target the corner begins is judged up to that"
            )),
        },
        _ => Err(shape()),
    }
}

/// Checks that a value is speed data: four numbers.
pub(crate) fn is_speed(value: &Value) -> bool {
    value.numbers::<4>().is_some()
}

/// A tool, in SI units.
pub(crate) fn tool(value: &Value) -> Result<ReadTool, String> {
    let shape = || "expected tool data [TRUE,[[x,y,z],[q1,q2,q3,q4]],[kg,[x,y,z],[q1,q2,q3,q4],ix,iy,iz]]".to_owned();
    let parts = value.list().and_then(|[held, frame, load]: [&Value; 3]| {
        let [trans, rot] = frame.list()?;
        let [mass, cog, aom, ix, iy, iz] = load.list()?;
        let moments = [ix.number()?, iy.number()?, iz.number()?];
        let lengths = [trans.numbers::<3>()?, cog.numbers::<3>()?];
        Some((
            held,
            lengths,
            [rot.numbers::<4>()?, aom.numbers::<4>()?],
            mass.number()?,
            moments,
        ))
    });
    let (held, lengths, rotations, mass, moments) = parts.ok_or_else(shape)?;
    if *held != Value::Truth(true) {
        return Err("expected a tool that the arm holds (robhold TRUE), found one that stands still".to_owned());
    }
    // The least mass as a single is a little off.
    if f64::from(mass) < LEAST_KG * (1.0 - 1e-6) {
        return Err(format!(
            "expected a tool's mass of at least {LEAST_KG} kg, found {mass}: the controller refuses it"
        ));
    }
    let [tip_m, com_m] = lengths.map(|mm| mm.map(|mm| f64::from(mm) / 1e3));
    if com_m == [0.0; 3] {
        return Err(
            "expected a centre of mass away from the flange, found [0, 0, 0]: the controller refuses it".to_owned(),
        );
    }
    if let Some(moment) = moments.into_iter().find(|moment| *moment < 0.0) {
        return Err(format!(
            "expected moments of inertia of 0 kg·m² or more, found {moment}"
        ));
    }
    let [tip, axes] = rotations.map(rotation);
    Ok(ReadTool {
        tip: Some(Pose::from_parts(Translation3::from(tip_m), tip?)),
        mass_kg: f64::from(mass),
        com_m,
        inertia: Some((moments.map(f64::from), axes?)),
    })
}

fn rotation(parts: [f32; 4]) -> Result<UnitQuaternion<f64>, String> {
    let [w, x, y, z] = parts.map(f64::from);
    let quaternion = Quaternion::new(w, x, y, z);
    let length = quaternion.norm();
    match (length - 1.0).abs() <= UNIT {
        true => Ok(UnitQuaternion::from_quaternion(quaternion)),
        false => Err(format!(
            "expected a quaternion of length 1 in the tool, found length {length}"
        )),
    }
}
