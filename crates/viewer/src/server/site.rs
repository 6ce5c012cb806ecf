//! What is served.

use super::live::{EVENTS, Live};
use super::refusal::Refusal;
use super::request::Request;
use std::sync::Arc;

/// Where the page is.
const PAGE: &str = "/";
/// What browsers ask for beside every page.
const ICON: &str = "/favicon.ico";

/// What is served.
#[derive(Debug)]
pub struct Site {
    /// The page, as HTML.
    pub page: String,
    /// The run whose events it shows; `None` where it shows what is done.
    pub live: Option<Arc<Live>>,
}

/// What a request gets.
pub enum Found<'a> {
    /// The page.
    Page(&'a str),
    /// Events as they come.
    Events(&'a Arc<Live>),
    /// That there is nothing.
    Nothing,
}

impl Site {
    /// What a request gets.
    pub fn find(&self, request: &Request) -> Result<Found<'_>, Refusal> {
        match (request.path.as_str(), &self.live) {
            (PAGE, _) => Ok(Found::Page(&self.page)),
            (ICON, _) => Ok(Found::Nothing),
            (EVENTS, Some(live)) if request.query.as_deref().is_none_or(|query| live.is_asked_for(query)) => {
                Ok(Found::Events(live))
            }
            // A page of another plan that was open before on this port: it is not to show this one's motion.
            (EVENTS, Some(_)) => Ok(Found::Nothing),
            _ => Err(Refusal::NotFound),
        }
    }
}
