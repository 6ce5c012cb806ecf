//! The figures by name.

/// A name that no figure has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no figure \"{found}\"; there are {}", Figure::names())]
pub struct UnknownFigure {
    /// The name.
    found: String,
}

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
        found.ok_or_else(|| UnknownFigure {
            found: name.chars().take(60).collect(),
        })
    }

    /// All names, in a sentence.
    fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}
