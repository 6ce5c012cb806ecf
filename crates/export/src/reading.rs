//! Motion of a program, read back from its text.
//!
//! Text of a program as words, numbers, texts and signs. RAPID and URScript share it.

use crate::controller_settings::ReadSetting;
use crate::program::{Place, ProgramFile};
use nalgebra::UnitQuaternion;
use platewash_kinematics::{JointVector, Pose};
use platewash_motion_proof::ReadError;
use platewash_workcell::words::shortened;

/// Motion of a program, as read from its text.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Share of the plan's speed that the program itself states; `None` where it states none.
    pub speed_share: Option<f64>,
    /// Greatest share at which it may be run without another text; `None` where that is the stated one.
    pub most_share: Option<f64>,
    /// Points in the order in which they are reached; the first is where the arm must stand.
    pub points: Vec<ReadPoint>,
    /// Motion that the arm is assumed to make from one point to the next.
    pub interpolation: SegmentShape,
    /// The tool, where the program states one.
    pub tool: Option<ReadTool>,
    /// Largest distance of a joint from the start at which the program moves at all \[°\]; `None` where it does not check, as it was
    /// exported, where the arm stands.
    pub start_within_deg: Option<f64>,
    /// Settings that change how the controller moves, in the order of the program: each value of a name once.
    pub settings: Vec<ReadSetting>,
}

impl Reading {
    /// A motion of which the program states nothing else.
    pub(crate) fn from_points(points: Vec<ReadPoint>, interpolation: SegmentShape) -> Self {
        Self {
            speed_share: None,
            most_share: None,
            points,
            interpolation,
            tool: None,
            start_within_deg: None,
            settings: Vec::new(),
        }
    }

    /// Share of the plan's speed at which the program runs: all of it where none is stated.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.speed_share.unwrap_or(1.0)
    }

    /// Returns the greatest share of the plan's speed at which the program may be run as it stands.
    #[must_use]
    pub fn greatest_share(&self) -> f64 {
        self.most_share.unwrap_or(0.0).max(self.share())
    }
}

/// A point that a program names.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadPoint {
    /// The line that names it.
    pub place: Place,
    /// Time at which it is reached, in the program's time, as the sum of the times in the lines \[s\].
    pub t_s: f64,
    /// Joint positions \[rad\].
    pub q_rad: JointVector,
    /// Joint speeds, where the program states them \[rad/s\].
    pub qd_rad_s: Option<JointVector>,
    /// Radius of the corner at it \[m\]; `None` where the arm stops.
    pub corner_m: Option<f64>,
}

impl ReadPoint {
    /// A point without stated speeds.
    pub(crate) fn new(place: Place, t_s: f64, q_rad: JointVector, corner_m: Option<f64>) -> Self {
        Self {
            place,
            t_s,
            q_rad,
            qd_rad_s: None,
            corner_m,
        }
    }
}

/// Motion of an arm between points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SegmentShape {
    /// Evenly and straight in the joints, rounded at the points by parabolas whose size is only assumed.
    RoundedLines,
    /// Evenly and straight in the joints, through every point.
    Lines,
    /// Along the cubic that has the stated positions and speeds at both ends.
    Cubics,
}

/// A tool as a program states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadTool {
    /// `T_flange_tip`, where it is stated.
    pub tip: Option<Pose>,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Centre of mass, mounting frame \[m\].
    pub com_m: [f64; 3],
    /// Moments of inertia about the principal axes \[kg·m²\] and those axes in the mounting frame, where they are stated.
    pub inertia: Option<([f64; 3], UnitQuaternion<f64>)>,
}

/// Most lines that are read, and statements that are carried out.
pub(crate) const MOST_LINES: usize = 1_000_000;

/// Longest line that is read \[bytes\].
const LONGEST: usize = 100_000;

/// Most characters of a text that a message repeats.
const MOST: usize = 40;

/// Signs of two characters.
const TWO: [&str; 6] = [":=", "<=", ">=", "<>", "==", "!="];

/// Signs of one character.
const ONE: &str = "()[]{},;:\\+-*/=<>%?.";

/// A token.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Token {
    /// A letter or `_`, then letters, digits and `_`.
    Word(String),
    /// A decimal number without a sign.
    Number(f64),
    /// Text between quotation marks; `""` in it is a quotation mark.
    Text(String),
    /// Anything else.
    Sign(&'static str),
}

impl Token {
    /// Checks that it is that sign.
    pub(crate) fn is(&self, sign: &str) -> bool {
        matches!(self, Self::Sign(found) if *found == sign)
    }

    /// Checks that it is the same token, with the case of words ignored.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Word(a), Self::Word(b)) => a.eq_ignore_ascii_case(b),
            (a, b) => a == b,
        }
    }
}

impl std::fmt::Display for Token {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Word(word) => write!(f, "`{}`", shortened(word, MOST)),
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(_) => f.write_str("a text"),
            Self::Sign(sign) => write!(f, "`{sign}`"),
        }
    }
}

/// A line that says something.
#[derive(Debug)]
pub(crate) struct Line {
    /// From 1.
    pub(crate) number: usize,
    pub(crate) tokens: Vec<Token>,
}

impl Line {
    /// Its first token, where that is a word.
    pub(crate) fn first_word(&self) -> Option<&str> {
        match self.tokens.first()? {
            Token::Word(word) => Some(word),
            _ => None,
        }
    }
}

/// Reads the lines of a file that say something. `is_skipped` names those that are none of the program, given whether all before them
/// say nothing.
///
/// # Errors
/// [`ReadError`] with the line that cannot be read.
pub(crate) fn lines(
    file: &ProgramFile,
    comment: char,
    mut is_skipped: impl FnMut(&str, bool) -> bool,
) -> Result<Vec<Line>, ReadError> {
    let mut all = Vec::new();
    for (number, text) in (1..).zip(file.text.trim_start_matches('\u{feff}').lines()) {
        let refused = |reason| ReadError::at(&file.name, number, reason);
        if number > MOST_LINES {
            return Err(refused(format!("more than {MOST_LINES} lines, the most that are read")));
        }
        if is_skipped(text, all.is_empty()) {
            continue;
        }
        let tokens = line(text, comment).map_err(refused)?;
        all.extend((!tokens.is_empty()).then_some(Line { number, tokens }));
    }
    Ok(all)
}

/// Reads the tokens of a line; `comment` begins a comment up to its end.
///
/// # Errors
/// Message that names the part that cannot be read, and its place in the line.
pub(crate) fn line(text: &str, comment: char) -> Result<Vec<Token>, String> {
    if text.len() > LONGEST {
        return Err(format!(
            "the line is longer than {LONGEST} bytes, the most that are read"
        ));
    }
    // Where a controller ends a line, so must this reader: in comments, too.
    if let Some(c) = text
        .chars()
        .find(|c| (c.is_control() && *c != '\t') || matches!(c, '\u{2028}' | '\u{2029}'))
    {
        return Err(format!(
            "found the character U+{:04X}, which may end a line elsewhere",
            u32::from(c)
        ));
    }
    let (mut all, mut rest) = (Vec::new(), text);
    let mut follows_word = false;
    while let Some(c) = rest.chars().next() {
        if c == comment {
            break;
        }
        let number = if follows_word { 0 } else { number_length(rest) };
        let (token, length) = if c == ' ' || c == '\t' {
            rest = &rest[1..];
            follows_word = false;
            continue;
        } else if c == '"' {
            quoted(rest)?
        } else if number > 0 {
            let value = rest[..number].parse().ok().filter(|value: &f64| value.is_finite());
            let goes_on = rest[number..].starts_with(|next| is_letter(next) || next == '.');
            match value.filter(|_| !goes_on) {
                Some(value) => (Token::Number(value), number),
                None => return Err(format!("expected a decimal number, found {:?}", shortened(rest, MOST))),
            }
        } else if is_letter(c) {
            let length = rest
                .find(|c| !is_letter(c) && !char::is_ascii_digit(&c))
                .unwrap_or(rest.len());
            (Token::Word(rest[..length].to_owned()), length)
        } else if let Some(sign) = TWO.into_iter().find(|sign| rest.starts_with(sign)) {
            (Token::Sign(sign), sign.len())
        } else if let Some(at) = ONE.find(c) {
            (Token::Sign(&ONE[at..=at]), 1)
        } else {
            return Err(format!("unexpected character {c:?}"));
        };
        follows_word = matches!(token, Token::Word(_));
        all.push(token);
        rest = &rest[length..];
    }
    Ok(all)
}

fn is_letter(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

/// A text with its length between and with the quotation marks \[bytes\].
fn quoted(text: &str) -> Result<(Token, usize), String> {
    let mut inside = String::new();
    let mut chars = text.char_indices().skip(1).peekable();
    while let Some((at, c)) = chars.next() {
        match (c, chars.peek()) {
            ('"', Some((_, '"'))) => {
                chars.next();
                inside.push('"');
            }
            ('"', _) => return Ok((Token::Text(inside), at + 1)),
            _ => inside.push(c),
        }
    }
    Err("a text without its closing quotation mark".to_owned())
}

/// Counts the bytes at the beginning of a text that are a decimal number without a sign.
pub(crate) fn number_length(text: &str) -> usize {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(0);
    let fraction = if text[whole..].starts_with('.') {
        digits(whole + 1)
    } else {
        0
    };
    if whole + fraction == 0 {
        return 0;
    }
    let mut length = whole;
    if text[whole..].starts_with('.') {
        length += 1 + fraction;
    }
    if text[length..].starts_with(['e', 'E']) {
        let sign = usize::from(text[length + 1..].starts_with(['+', '-']));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Result<Vec<Token>, String> {
        line(text, '!')
    }

    #[test]
    fn a_line_is_words_numbers_texts_and_signs() {
        let told: Vec<_> = all("A_1.x:=-.5E-3/[9E9,1.] \"a\"\"!\" ! a note")
            .unwrap()
            .iter()
            .map(ToString::to_string)
            .collect();
        let expected = [
            "`A_1`",
            "`.`",
            "`x`",
            "`:=`",
            "`-`",
            "0.0005",
            "`/`",
            "`[`",
            "9000000000",
            "`,`",
            "1",
            "`]`",
            "a text",
        ];
        assert_eq!(told, expected);
        assert_eq!(all("\"\"").unwrap(), [Token::Text(String::new())]);
        for wrong in ["1e", "1.2.3", "0x10", "\"a", "a\u{2028}b", "! a\rb", "é", "1e999", "&"] {
            assert!(all(wrong).is_err(), "{wrong}");
        }
    }
}
