//! Descriptions whose joints turn far.

/// The description with all joints between two limits \[rad\].
pub fn between(urdf: &str, [lower, upper]: [f64; 2]) -> String {
    let mut parts = urdf.split("<limit ");
    let head = parts.next().unwrap_or_default().to_owned();
    parts.fold(head, |text, part| {
        let (tag, after) = part.split_once('>').unwrap();
        let others = tag
            .split(' ')
            .filter(|word| !word.starts_with("lower=") && !word.starts_with("upper="));
        let others: Vec<_> = others.collect();
        format!(
            "{text}<limit lower=\"{lower:?}\" upper=\"{upper:?}\" {}>{after}",
            others.join(" ")
        )
    })
}
