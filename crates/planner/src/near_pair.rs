//! Two bodies that are too near at configurations that were tried.

/// Two bodies that are too near in some of the configurations that were tried for a home.
#[derive(Debug, Clone, PartialEq)]
pub struct NearPair {
    /// Names of the bodies.
    pub pair: [String; 2],
    /// Number of configurations in which they are too near.
    pub count: usize,
    /// Number of configurations that were tried.
    pub tried: usize,
    /// Greatest distance in all of them \[m\].
    pub most_m: f64,
    /// True if both are of the arm or its tool.
    pub is_of_arm: bool,
}

impl NearPair {
    /// True if the bodies are of the arm or its tool, and too near in all of the configurations without touching in all of them.
    #[must_use]
    pub fn is_by_design(&self) -> bool {
        self.is_of_arm && self.count == self.tried && self.most_m > 0.0
    }
}
