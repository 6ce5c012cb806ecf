//! Elements of a description that lack something that matters for neither kinematics nor clearance: they are completed, or left out.

/// Treatment of an element that lacks an attribute.
pub(crate) enum Gap {
    /// The element gets attributes without meaning. The statement names it where it should have stated them.
    Completed(&'static str, Option<String>),
    /// The element is left out, and named.
    LeftOut(String),
}

/// Attributes that elements must have, by the ends of their paths.
const ATTRIBUTES: [(&str, &[&str]); 8] = [
    ("geometry/box", &["size"]),
    ("geometry/cylinder", &["radius", "length"]),
    ("geometry/capsule", &["radius", "length"]),
    ("geometry/sphere", &["radius"]),
    ("geometry/mesh", &["filename"]),
    ("inertial/mass", &["value"]),
    ("inertial/inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]),
    ("material/color", &["rgba"]),
];

/// Elements that elements must have, by path.
const PARTS: [(&str, &[&str]); 3] = [
    ("link/visual", &["geometry"]),
    ("link/collision", &["geometry"]),
    ("link/inertial", &["mass", "inertia"]),
];

/// Attributes of a visual that are numbers, and how many.
const NUMBERS: [(&str, usize); 6] = [
    ("size", 3),
    ("radius", 1),
    ("length", 1),
    ("scale", 3),
    ("xyz", 3),
    ("rpy", 3),
];

/// Returns the treatment of an element with these attributes; `None` if it has all that it needs. Where `needs_size`, shapes of visuals must have
/// a size; elsewhere those without are found later.
pub(crate) fn in_attributes(path: &str, attributes: &[(String, String)], needs_size: bool) -> Option<Gap> {
    let stated = |key: &str| attributes.iter().find(|(name, _)| name == key).map(|(_, value)| value);
    let tag = path.rsplit('/').next().unwrap_or_default();
    let without = |key: &str| format!("<{tag}> without {key}");
    let completed = |key: &str, with| Some(Gap::Completed(with, stated(key).is_none().then(|| without(key))));
    match tag {
        "material" if stated("name").is_none() => return completed("name", " name=\"\""),
        // What it states is blanked, as it cannot matter.
        "safety_controller" => return completed("k_velocity", " k_velocity=\"0\""),
        // An axis without a speed limit is refused later, by name.
        "limit" if stated("velocity").is_none() => return Some(Gap::Completed(" velocity=\"0\"", None)),
        _ => {}
    }
    let left_out = |(key, value): &(String, String), count| Gap::LeftOut(format!("{key}=\"{value}\", not {count}"));
    let wrong = |(key, value): &&(String, String)| {
        let known = NUMBERS.iter().find(|(number, _)| number == key);
        let is_size = needs_size && path.starts_with("link/visual/geometry/") && key != "scale";
        let fits = |count| are_numbers(value, count) && !(is_size && has_no_size(value));
        path.starts_with("link/visual/") && known.is_some_and(|(_, count)| !fits(*count))
    };
    if let Some(attribute) = attributes.iter().find(wrong) {
        return Some(left_out(attribute, "as many numbers as it needs"));
    }
    let (_, needed) = ATTRIBUTES.iter().find(|(end, _)| path.ends_with(end))?;
    let is_missing = |key: &&&str| stated(key).is_none_or(|value| value.trim().is_empty());
    let is_no_colour = |(key, value): &&(String, String)| key == "rgba" && !are_numbers(value, 4);
    match needed.iter().find(is_missing) {
        Some(key) => Some(Gap::LeftOut(without(key))),
        None => Some(left_out(attributes.iter().find(is_no_colour)?, "four numbers")),
    }
}

/// True if a number is 0 or less.
fn has_no_size(text: &str) -> bool {
    text.split_whitespace()
        .filter_map(|number| number.parse().ok())
        .any(|number: f64| number <= 0.0)
}

fn are_numbers(text: &str, count: usize) -> bool {
    let mut numbers = text.split_whitespace().map(str::parse::<f64>);
    numbers.clone().count() == count && numbers.all(|number| number.is_ok_and(f64::is_finite))
}

/// Returns what an element lacks in which these elements are used and these are left out: `geometry`, or `a shape`.
pub(crate) fn in_parts(path: &str, used: &[String], left_out: &[String]) -> Option<&'static str> {
    if path.ends_with("/geometry") {
        return used.is_empty().then_some("a shape");
    }
    if path == "link/visual" && left_out.iter().any(|tag| tag == "origin") {
        return Some("origin");
    }
    let (_, needed) = PARTS.iter().find(|(known, _)| *known == path)?;
    needed.iter().copied().find(|part| !used.iter().any(|tag| tag == part))
}
