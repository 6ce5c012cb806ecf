//! Words that messages share.

/// A number of things: `1 plate`, `4 plates`.
#[must_use]
pub fn counted(count: usize, noun: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{ending}")
}

/// A part of some things: `0 of 1 plate`, `1 of 4 plates`.
#[must_use]
pub fn part_of(part: usize, count: usize, noun: &str) -> String {
    format!("{part} of {}", counted(count, noun))
}

/// A length in millimetres, to a tenth: `-90.0 mm`.
#[must_use]
pub fn millimetres(length_m: f64) -> String {
    format!("{:.1} mm", 1e3 * length_m)
}

/// Text out of a file with control characters written out, so that no terminal obeys them and no line is added to a message.
#[must_use]
pub fn printable(text: &str) -> String {
    let written = |c: char| {
        if c.is_control() {
            c.escape_default().to_string()
        } else {
            c.to_string()
        }
    };
    text.chars().map(written).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular_and_any_other_number_plural() {
        assert_eq!(
            [0, 1, 2].map(|n| counted(n, "plate")),
            ["0 plates", "1 plate", "2 plates"]
        );
        assert_eq!(part_of(1, 1, "plate"), "1 of 1 plate");
        assert_eq!(part_of(1, 4, "plate"), "1 of 4 plates");
    }

    #[test]
    fn lengths_are_said_in_millimetres() {
        assert_eq!(millimetres(-0.09), "-90.0 mm");
    }
}
