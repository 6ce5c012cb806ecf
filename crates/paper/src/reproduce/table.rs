//! The reproduction as a person reads it.

use super::result::{Reproduction, Row};
use std::fmt::{self, Display, Formatter};

impl Display for Reproduction {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let s = &self.settings;
        writeln!(
            f,
            "The paper's program, measured: {} layouts a region, {} layouts begun a dead-end rate, seed {}",
            s.layouts, s.draws, s.seed
        )?;
        writeln!(
            f,
            "(\"paper\": what its text takes for granted; ±: half-width of the 95 % interval)"
        )?;
        let mut group = "";
        for row in &self.rows {
            if row.group != group {
                group = row.group;
                writeln!(
                    f,
                    "\n{group}\n  {:<62} {:>9} {:>10} {:>8}",
                    "", "paper", "measured", "±"
                )?;
            }
            writeln!(f, "{row}")?;
        }
        Ok(())
    }
}

impl Display for Row {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let digits = if self.unit.is_empty() { 3 } else { 1 };
        let paper = self.paper.map_or_else(|| "–".to_owned(), |v| format!("{v:.digits$}"));
        let error = self
            .half_width_95
            .map_or_else(|| "–".to_owned(), |v| format!("{v:.0$}", digits + 1));
        let measured = self.measured;
        let quantity = if self.unit.is_empty() {
            self.quantity.clone()
        } else {
            format!("{} [{}]", self.quantity, self.unit)
        };
        write!(f, "  {quantity:<62} {paper:>9} {measured:>10.digits$} {error:>8}")
    }
}
