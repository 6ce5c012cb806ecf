//! Scenarios that come with the program, by name.

/// A scenario that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShippedScenario {
    /// The name under which it is found.
    pub name: &'static str,
    /// Its commented TOML text.
    pub text: &'static str,
}

/// All shipped scenarios; the first is the default.
pub const SHIPPED: &[ShippedScenario] = &[
    ShippedScenario {
        name: "paper-appendix",
        text: include_str!("../../../../scenarios/paper-appendix.toml"),
    },
    ShippedScenario {
        name: "paper-text",
        text: include_str!("../../../../scenarios/paper-text.toml"),
    },
];
