//! The figures by name.

/// A name that no figure has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no figure \"{found}\"; there are {}{instead}", Figure::names())]
pub struct UnknownFigure {
    /// The name.
    found: String,
    /// Replacement of a figure that no longer exists.
    instead: String,
}

/// Names of removed figures, with their replacements.
const REMOVED: [(&str, &str); 7] = [
    ("cleaning", PAGE),
    ("transit", PAGE),
    ("moment", PAGE),
    ("tip", "it is a part of the figure \"joints\""),
    ("clearance", "it is a part of the figure \"joints\""),
    (
        "sheet",
        "`platewash verify` and report.txt say what is proved, `platewash reproduce` what was measured",
    ),
    ("flow", "it is a picture in docs/figures.md"),
];
const PAGE: &str = "the page of `platewash view` shows the arm at every moment, and its button \"Picture\" saves it";

/// A figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Figure {
    /// The workcell from above with the washed areas, their order, and the paths between.
    Layout,
    /// Joints and tip over time.
    Joints,
    /// Swept area of each plate.
    Coverage,
    /// Commanded and executed path of the tip on each plate.
    Spiral,
}

impl Figure {
    /// All figures.
    pub const ALL: [Self; 4] = [Self::Layout, Self::Joints, Self::Coverage, Self::Spiral];

    /// The name in commands and of files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Layout => "layout",
            Self::Joints => "joints",
            Self::Coverage => "coverage",
            Self::Spiral => "spiral",
        }
    }

    /// The figure of that name.
    ///
    /// # Errors
    /// [`UnknownFigure`].
    pub fn named(name: &str) -> Result<Self, UnknownFigure> {
        let found = Self::ALL.into_iter().find(|figure| figure.name() == name);
        let removed = REMOVED.iter().find(|(removed, _)| *removed == name);
        found.ok_or_else(|| UnknownFigure {
            found: name.chars().take(60).collect(),
            instead: removed.map_or_else(String::new, |(_, instead)| format!(". \"{name}\" is gone: {instead}")),
        })
    }

    /// All names, in a sentence.
    fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}
