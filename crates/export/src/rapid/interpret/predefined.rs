//! Data that every controller has.

use super::value::Value;
use std::rc::Rc;

/// Zones by name: radius at the tip \[mm\]; at the tip with turning, and for external axes \[mm\]; turning \[°\].
pub const ZONES: [(&str, f32, f32, f32); 14] = [
    ("z0", 0.3, 0.3, 0.03),
    ("z1", 1.0, 1.0, 0.1),
    ("z5", 5.0, 8.0, 0.8),
    ("z10", 10.0, 15.0, 1.5),
    ("z15", 15.0, 23.0, 2.3),
    ("z20", 20.0, 30.0, 3.0),
    ("z30", 30.0, 45.0, 4.5),
    ("z40", 40.0, 60.0, 6.0),
    ("z50", 50.0, 75.0, 7.5),
    ("z60", 60.0, 90.0, 9.0),
    ("z80", 80.0, 120.0, 12.0),
    ("z100", 100.0, 150.0, 15.0),
    ("z150", 150.0, 225.0, 23.0),
    ("z200", 200.0, 300.0, 30.0),
];

/// Speeds by name: the tip's \[mm/s\] is the number in it.
const SPEEDS: [u16; 24] = [
    5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500, 2000, 2500, 3000, 4000, 5000,
    6000,
];
/// The greatest of them \[mm/s\]; also stands for `vmax`, which is the arm's own.
const FASTEST: u16 = 7000;

/// Data that every controller has.
#[derive(Debug, Clone, PartialEq)]
pub struct Predefined {
    /// The name of their type.
    pub type_name: &'static str,
    /// Their value, as an aggregate.
    pub value: Value,
}

/// The zone of a radius at the tip \[m\], if there is one by name.
#[must_use]
pub fn zone_named(radius_m: f64) -> Option<&'static str> {
    let is_it = |mm: f32| (f64::from(mm) - radius_m * 1e3).abs() < 1e-6;
    ZONES.iter().find(|(_, mm, ..)| is_it(*mm)).map(|(name, ..)| *name)
}

/// The data of a name, in small letters.
#[must_use]
pub fn predefined(key: &str) -> Option<Predefined> {
    let (type_name, value) = match key {
        "pi" => ("num", Value::Num(std::f32::consts::PI)),
        "stempty" => ("string", Value::Text(Rc::from(""))),
        "tool0" => ("tooldata", list([Value::Truth(true), frame(), load0()])),
        "load0" => ("loaddata", load0()),
        "wobj0" => ("wobjdata", wobj0()),
        "fine" => ("zonedata", zone(true, 0.0, 0.0, 0.0)),
        "vmax" => ("speeddata", speed(FASTEST)),
        _ => return zone_of(key).or_else(|| speed_of(key)),
    };
    Some(Predefined { type_name, value })
}

fn zone_of(key: &str) -> Option<Predefined> {
    let (_, tip, turning, angle) = ZONES.iter().find(|(name, ..)| *name == key)?;
    let (type_name, value) = ("zonedata", zone(false, *tip, *turning, *angle));
    Some(Predefined { type_name, value })
}

fn speed_of(key: &str) -> Option<Predefined> {
    let number: u16 = key.strip_prefix('v')?.parse().ok()?;
    let known = SPEEDS.contains(&number) || number == FASTEST;
    let (type_name, value) = ("speeddata", speed(number));
    // Not `v05`: the name is that of the number.
    (known && *key == format!("v{number}")).then_some(Predefined { type_name, value })
}

fn list<const N: usize>(values: [Value; N]) -> Value {
    Value::List(values.into())
}

fn numbers<const N: usize>(values: [f32; N]) -> Value {
    list(values.map(Value::Num))
}

fn zone(is_stop: bool, tip: f32, turning: f32, angle: f32) -> Value {
    let mut values = vec![Value::Truth(is_stop)];
    values.extend([tip, turning, turning, angle, turning, angle].map(Value::Num));
    Value::List(values)
}

fn speed(tip_mm_s: u16) -> Value {
    numbers([f32::from(tip_mm_s), 500.0, 5000.0, 1000.0])
}

fn frame() -> Value {
    list([numbers([0.0; 3]), numbers([1.0, 0.0, 0.0, 0.0])])
}

fn load0() -> Value {
    let [zero, mass] = [0.0, 0.001].map(Value::Num);
    let com = numbers([0.0, 0.0, 0.001]);
    list([
        mass,
        com,
        numbers([1.0, 0.0, 0.0, 0.0]),
        zero.clone(),
        zero.clone(),
        zero,
    ])
}

fn wobj0() -> Value {
    let (robot, fixed) = (Value::Truth(false), Value::Truth(true));
    list([robot, fixed, Value::Text(Rc::from("")), frame(), frame()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zones_and_speeds_by_name() {
        assert_eq!(zone_named(0.005), Some("z5"));
        assert_eq!(zone_named(0.000_3), Some("z0"));
        assert_eq!(zone_named(0.004), None);
        assert_eq!(zone_named(f64::NAN), None);
        let kinds = ["z5", "v100", "vmax", "v7000", "fine"].map(|key| predefined(key).map(|found| found.type_name));
        assert_eq!(
            kinds,
            ["zonedata", "speeddata", "speeddata", "speeddata", "zonedata"].map(Some)
        );
        for unknown in ["v05", "v7", "z3", "v", "z", "tool1"] {
            assert_eq!(predefined(unknown), None, "{unknown}");
        }
    }
}
