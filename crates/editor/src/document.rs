//! What the page is given to begin with: the block `platewash-edit`.

use crate::keep::{Kept, Standing};
use crate::protocol::FORMAT;
use platewash_scenario::{FormKey, form};
use serde::Serialize;

/// Where the page's questions go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Channel {
    /// To the page's own address.
    Server,
    /// To the window around it, by messages.
    Frame,
}

/// The block.
#[derive(Debug, Serialize)]
pub struct EditDocument<'a> {
    format: &'static str,
    channel: Channel,
    file: Option<String>,
    disk: Option<String>,
    saved: Option<String>,
    text: &'a str,
    keys: Vec<FormKey>,
}

impl<'a> EditDocument<'a> {
    /// Of a scenario, and the file that it is saved in.
    pub fn new(channel: Channel, text: &'a str, kept: Option<&Kept>) -> Self {
        let standing = kept.and_then(|kept| kept.standing().ok());
        Self {
            format: FORMAT,
            channel,
            file: kept.map(Kept::file),
            disk: standing.as_ref().and_then(Standing::hash),
            saved: standing.and_then(Standing::into_text),
            text,
            keys: form(),
        }
    }
}
