//! Functions: those of the program, and the few of the controller that programs of motion need.

use super::argument::Signature;
use super::joints;
use super::machine::{Machine, Run};
use super::store::{Binding, Part};
use super::value::Value;
use crate::rapid::syntax::ast::{Argument, Expression, ExpressionKind, Name};
use platewash_kinematics::trig;
use std::rc::Rc;

/// Most decimals of a number in a string, and in rounding.
const MOST_DECIMALS: f32 = 15.0;

const fn one(name: &'static str) -> Signature {
    Signature {
        name,
        required: 1,
        options: &[],
    }
}
const ROUND: Signature = Signature {
    name: "rounding",
    required: 1,
    options: &[("dec", 1)],
};
const TWO: Signature = Signature {
    name: "a function of two numbers",
    required: 2,
    options: &[],
};
const C_JOINT_T: Signature = Signature {
    name: "CJointT",
    required: 0,
    options: &[],
};

impl<'a> Machine<'a> {
    /// The result of a function.
    pub fn function(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<Value> {
        if let Some((module, routine)) = self.routine(self.module(), &name.key) {
            return match self.call(name, module, routine, arguments)? {
                Some(value) => Ok(value),
                None => self.refuse(name.at, format!("{} ends without a value", name.text)),
            };
        }
        let result = match &*name.key {
            "abs" => self.of_number(name, arguments, f32::abs)?,
            "sqrt" => self.of_number(name, arguments, f32::sqrt)?,
            "sin" => self.of_number(name, arguments, |x| trig::sin(f64::from(x).to_radians()) as f32)?,
            "cos" => self.of_number(name, arguments, |x| trig::cos(f64::from(x).to_radians()) as f32)?,
            "tan" => self.of_number(name, arguments, |x| {
                let (sin, cos) = trig::sin_cos(f64::from(x).to_radians());
                (sin / cos) as f32
            })?,
            "round" => self.rounded(name, arguments, f64::round)?,
            "trunc" => self.rounded(name, arguments, f64::trunc)?,
            "atan2" => self.arc_tangent(name, arguments)?,
            "numtostr" => return self.number_as_text(name, arguments),
            "valtostr" => return self.value_as_text(name, arguments),
            "strlen" => self.text_length(name, arguments)?,
            "dim" => self.dimension(name, arguments)?,
            "present" => return self.present(name, arguments),
            "cjointt" => return self.where_it_stands(name, arguments),
            _ => return self.refuse(name.at, format!("the function {} is not modelled", name.text)),
        };
        if result.is_finite() {
            return Ok(Value::Num(result));
        }
        self.refuse(name.at, format!("{} has no value there", name.text))
    }

    fn of_number(&mut self, name: &'a Name, arguments: &'a [Argument], function: fn(f32) -> f32) -> Run<f32> {
        let taken = self.taken(name.at, &one("a function of a number"), arguments)?;
        match taken.required[..] {
            [x] => Ok(function(self.number(x)?)),
            _ => self.refuse(name.at, "expected one number"),
        }
    }

    fn rounded(&mut self, name: &'a Name, arguments: &'a [Argument], to: fn(f64) -> f64) -> Run<f32> {
        let taken = self.taken(name.at, &ROUND, arguments)?;
        let decimals = match taken.option("dec") {
            Some((_, Some(value))) => self.decimals(value)?,
            _ => 0,
        };
        let scale = 10_f64.powi(i32::try_from(decimals).unwrap_or(0));
        match taken.required[..] {
            [x] => Ok((to(f64::from(self.number(x)?) * scale) / scale) as f32),
            _ => self.refuse(name.at, "expected one number"),
        }
    }

    fn decimals(&mut self, expression: &'a Expression) -> Run<usize> {
        let decimals = self.number(expression)?;
        if decimals.fract() != 0.0 || !(0.0..=MOST_DECIMALS).contains(&decimals) {
            return self.refuse(
                expression.at,
                format!("expected from 0 to {MOST_DECIMALS} decimals, found {decimals}"),
            );
        }
        Ok(decimals as usize)
    }

    fn arc_tangent(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<f32> {
        let taken = self.taken(name.at, &TWO, arguments)?;
        match taken.required[..] {
            [y, x] => {
                let (y, x) = (self.number(y)?, self.number(x)?);
                Ok(trig::atan2(f64::from(y), f64::from(x)).to_degrees() as f32)
            }
            _ => self.refuse(name.at, "expected two numbers"),
        }
    }

    fn number_as_text(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<Value> {
        let taken = self.taken(name.at, &TWO, arguments)?;
        match taken.required[..] {
            [x, decimals] => {
                let (x, decimals) = (self.number(x)?, self.decimals(decimals)?);
                Ok(Value::Text(Rc::from(format!("{x:.decimals$}"))))
            }
            _ => self.refuse(name.at, "expected a number and its decimals"),
        }
    }

    fn value_as_text(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<Value> {
        let taken = self.taken(name.at, &one("ValToStr"), arguments)?;
        let value = match taken.required[..] {
            [x] => self.evaluate(x)?,
            _ => return self.refuse(name.at, "expected one value"),
        };
        let text = match value {
            Value::Num(x) => x.to_string(),
            Value::Truth(truth) => truth.to_string().to_uppercase(),
            Value::Text(text) => format!("\"{text}\""),
            other => return self.refuse(name.at, format!("{} as text is not modelled", other.kind())),
        };
        Ok(Value::Text(Rc::from(text)))
    }

    fn text_length(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<f32> {
        let taken = self.taken(name.at, &one("StrLen"), arguments)?;
        match taken.required[..] {
            // Strings are at most 80 characters long.
            [text] => Ok(self.text(text)?.chars().count() as f32),
            _ => self.refuse(name.at, "expected one string"),
        }
    }

    fn dimension(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<f32> {
        let taken = self.taken(name.at, &TWO, arguments)?;
        let [array, which] = taken.required[..] else {
            return self.refuse(name.at, "expected an array and a dimension");
        };
        let which = self.number(which)?;
        let found = match &array.kind {
            ExpressionKind::Read(designator) => self.part_of(designator)?,
            _ => None,
        };
        let mut value = found.as_ref().and_then(|part| self.value(part));
        let mut left = which;
        while let Some(Value::Array(elements)) = value {
            if left == 1.0 {
                // Arrays are smaller than 2²⁴.
                return Ok(elements.len() as f32);
            }
            left -= 1.0;
            value = elements.first();
        }
        self.refuse(array.at, format!("expected an array with a dimension {which}"))
    }

    fn present(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<Value> {
        let taken = self.taken(name.at, &one("Present"), arguments)?;
        let parameter = match taken.required[..] {
            [
                Expression {
                    kind: ExpressionKind::Read(designator),
                    ..
                },
            ] => self.binding(&designator.name.key),
            _ => None,
        };
        match parameter {
            Some(Binding::Absent) => Ok(Value::Truth(false)),
            Some(Binding::Given | Binding::Data(Part { .. })) => Ok(Value::Truth(true)),
            None => self.refuse(name.at, "expected the name of an optional parameter"),
        }
    }

    /// Where the arm stands: known only before the first motion, where it is assumed to stand at the start.
    fn where_it_stands(&mut self, name: &'a Name, arguments: &'a [Argument]) -> Run<Value> {
        self.taken(name.at, &C_JOINT_T, arguments)?;
        if self.motion.has_begun() {
            return self.refuse(name.at, "CJointT is modelled before the first motion only");
        }
        let Some(start_rad) = self.start_rad else {
            return self.refuse(
                name.at,
                "CJointT needs a start: a first MoveAbsJ in main whose target is made of constants",
            );
        };
        self.start_asked = true;
        let Some(default) = self.types.default_of("jointtarget").cloned() else {
            return self.refuse(name.at, "data of the type jointtarget are not modelled");
        };
        self.fitted(name.at, &default, joints::as_value(&(start_rad + self.away_rad)))
    }
}
