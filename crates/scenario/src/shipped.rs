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
        name: "kitchen",
        text: include_str!("../../../scenarios/kitchen.toml"),
    },
    ShippedScenario {
        name: "kitchen-spiral",
        text: include_str!("../../../scenarios/kitchen-spiral.toml"),
    },
    ShippedScenario {
        name: "kitchen-roomy",
        text: include_str!("../../../scenarios/kitchen-roomy.toml"),
    },
    ShippedScenario {
        name: "kitchen-rim",
        text: include_str!("../../../scenarios/kitchen-rim.toml"),
    },
    ShippedScenario {
        name: "coupe",
        text: include_str!("../../../scenarios/coupe.toml"),
    },
    ShippedScenario {
        name: "rim",
        text: include_str!("../../../scenarios/rim.toml"),
    },
    ShippedScenario {
        name: "deep",
        text: include_str!("../../../scenarios/deep.toml"),
    },
    ShippedScenario {
        name: "dessert",
        text: include_str!("../../../scenarios/dessert.toml"),
    },
    ShippedScenario {
        name: "angled-tool",
        text: include_str!("../../../scenarios/angled-tool.toml"),
    },
    ShippedScenario {
        name: "bracket-tool",
        text: include_str!("../../../scenarios/bracket-tool.toml"),
    },
    ShippedScenario {
        name: "sink",
        text: include_str!("../../../scenarios/sink.toml"),
    },
    ShippedScenario {
        name: "pedestal",
        text: include_str!("../../../scenarios/pedestal.toml"),
    },
    ShippedScenario {
        name: "ceiling",
        text: include_str!("../../../scenarios/ceiling.toml"),
    },
    ShippedScenario {
        name: "wall",
        text: include_str!("../../../scenarios/wall.toml"),
    },
    ShippedScenario {
        name: "rack",
        text: include_str!("../../../scenarios/rack.toml"),
    },
    ShippedScenario {
        name: "sizes",
        text: include_str!("../../../scenarios/sizes.toml"),
    },
    ShippedScenario {
        name: "paper-appendix",
        text: include_str!("../../../scenarios/paper-appendix.toml"),
    },
    ShippedScenario {
        name: "paper-text",
        text: include_str!("../../../scenarios/paper-text.toml"),
    },
];
