//! The languages of messages.

/// How keys and lists are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Language {
    /// YAML 1.1 and 1.2, with a head of comments.
    Yaml,
    /// JSON, which has no comments.
    Json,
}

impl Language {
    /// That of a file, by its name.
    pub(super) fn of(name: &str) -> Option<Self> {
        match name.rsplit_once('.')?.1 {
            "yaml" | "yml" => Some(Self::Yaml),
            "json" => Some(Self::Json),
            _ => None,
        }
    }
}
