//! Lines of a module: ASCII, line feeds, no blanks at the end.

use crate::comment::wrapped;
use platewash_kinematics::words::fixed;

/// Lines of a module.
#[derive(Debug, Default)]
pub struct Lines {
    text: String,
}

impl Lines {
    /// A line, so many steps to the right.
    pub fn line(&mut self, steps: usize, line: &str) {
        for _ in 0..steps {
            self.text.push_str("  ");
        }
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// An empty line.
    pub fn blank(&mut self) {
        self.text.push('\n');
    }

    /// A sentence as a comment, as many lines as it needs; further lines are set off.
    pub fn comment(&mut self, steps: usize, sentence: &str) {
        let prefix = format!("{}!", "  ".repeat(steps));
        self.text.push_str(&wrapped(&prefix, [sentence]));
    }

    /// All lines.
    pub fn text(self) -> String {
        self.text
    }
}

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
    fn numbers_without_idle_zeros() {
        let told = [150.0, 0.25, -1e-9, 1e-9, 100.0, 12.3456789].map(|value| number(value, 6));
        assert_eq!(told, ["150", "0.25", "0", "0", "100", "12.345679"]);
        assert_eq!(number(100.0, 0), "100");
    }
}
