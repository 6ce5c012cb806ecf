//! Scenarios that come with platewash, as commented TOML texts.

/// A scenario that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShippedScenario {
    /// The name under which it is found.
    pub name: &'static str,
    /// Its commented TOML text.
    pub text: &'static str,
}

impl ShippedScenario {
    /// The first sentence of the comment at its head.
    #[must_use]
    pub fn about(&self) -> String {
        let lines = self.text.lines().map_while(|line| line.strip_prefix('#'));
        let words = lines.map(str::trim).collect::<Vec<_>>().join(" ");
        let sentence = words.split(". ").next().unwrap_or_default();
        sentence.trim_end_matches('.').replace('`', "")
    }
}

/// Lists scenarios, each with the text of its file here.
macro_rules! shipped {
    ($($name:literal),+ $(,)?) => {
        &[$(ShippedScenario { name: $name, text: include_str!(concat!($name, ".toml")) }),+]
    };
}

/// All shipped scenarios; the first is the default.
pub static SHIPPED: &[ShippedScenario] = shipped![
    "kitchen",
    "kitchen-spiral",
    "kitchen-roomy",
    "kitchen-rim",
    "coupe",
    "rim",
    "deep",
    "dessert",
    "angled-tool",
    "bracket-tool",
    "sink",
    "pedestal",
    "ceiling",
    "wall",
    "rack",
    "sizes",
    "paper-appendix",
    "paper-text",
];
