//! Which rows are done: a bit each.

/// Which rows of a study are done.
#[derive(Debug, Clone)]
pub(crate) struct Done {
    bits: Vec<u64>,
    count: u64,
}

impl Done {
    /// None of so many.
    pub fn none_of(rows: u64) -> Self {
        Self {
            bits: vec![0; rows.div_ceil(64) as usize],
            count: 0,
        }
    }

    /// All of so many.
    pub fn all_of(rows: u64) -> Self {
        let mut all = Self::none_of(rows);
        for index in 0..rows {
            all.add(index);
        }
        all
    }

    /// How many there are.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Whether a row is among them.
    pub fn has(&self, index: u64) -> bool {
        let word = self.bits.get((index / 64) as usize);
        word.is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    /// Whether it was not there before, and could be.
    pub fn add(&mut self, index: u64) -> bool {
        let is_new = !self.has(index);
        match self.bits.get_mut((index / 64) as usize) {
            Some(word) if is_new => {
                *word |= 1 << (index % 64);
                self.count += 1;
                true
            }
            _ => false,
        }
    }
}
