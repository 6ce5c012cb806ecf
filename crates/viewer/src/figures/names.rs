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
    /// The workcell from above with what is washed, in which order, and the ways between.
    Layout,
    /// The arm while it washes.
    Cleaning,
    /// The arm between two plates.
    Transit,
    /// The arm at a time that is asked for.
    Moment,
    /// Joints and tip over time.
    Joints,
    /// What is swept of each plate.
    Coverage,
    /// What the tip was to follow on each plate, and what it followed.
    Spiral,
    /// What is required or claimed, and what is proved or measured.
    Sheet,
    /// How the program goes on.
    Flow,
}

impl Figure {
    /// All figures.
    pub const ALL: [Self; 9] = [
        Self::Layout,
        Self::Cleaning,
        Self::Transit,
        Self::Moment,
        Self::Joints,
        Self::Coverage,
        Self::Spiral,
        Self::Sheet,
        Self::Flow,
    ];

    /// The name in commands and of files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Layout => "layout",
            Self::Cleaning => "cleaning",
            Self::Transit => "transit",
            Self::Moment => "moment",
            Self::Joints => "joints",
            Self::Coverage => "coverage",
            Self::Spiral => "spiral",
            Self::Sheet => "sheet",
            Self::Flow => "flow",
        }
    }

    /// Whether it shows what an arm made of a plan, too.
    #[must_use]
    pub const fn shows_executed(self) -> bool {
        matches!(self, Self::Layout | Self::Coverage | Self::Spiral)
    }

    /// The figure of that name.
    ///
    /// # Errors
    /// [`UnknownFigure`].
    pub fn named(name: &str) -> Result<Self, UnknownFigure> {
        let found = || UnknownFigure {
            found: name.chars().take(60).collect(),
        };
        Self::ALL
            .into_iter()
            .find(|figure| figure.name() == name)
            .ok_or_else(found)
    }

    /// All names, in a sentence.
    fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}
