//! The languages of messages.

/// Notation of keys and lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// YAML 1.1 and 1.2, with a head of comments.
    Yaml,
    /// JSON, which has no comments.
    Json,
}

impl Language {
    /// Language of a file, by its name.
    pub fn from_file_name(name: &str) -> Option<Self> {
        match name.rsplit_once('.')?.1.to_ascii_lowercase().as_str() {
            "yaml" | "yml" => Some(Self::Yaml),
            "json" => Some(Self::Json),
            _ => None,
        }
    }
}
