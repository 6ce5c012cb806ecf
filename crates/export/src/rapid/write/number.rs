//! A number as a module states it.

use platewash_kinematics::words::fixed;

/// A number with at most that many decimals, without zeros at its end.
pub fn number(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn writes_numbers_without_trailing_zeros() {
        let told = [150.0, 0.25, -1e-9, 1e-9, 100.0, 12.3456789].map(|value| number(value, 6));
        assert_eq!(told, ["150", "0.25", "0", "0", "100", "12.345679"]);
        assert_eq!(number(100.0, 0), "100");
    }
}
