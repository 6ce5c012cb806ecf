//! Contents that are served.

use crate::answer::Refusal;
use crate::live::{EVENTS, LiveRun};
use crate::request::Request;
use crate::service::Service;
use std::borrow::Cow;
use std::error::Error;
use std::fmt;
use std::sync::Arc;

/// Path of the page.
const PAGE: &str = "/";
/// Path that browsers ask for beside every page.
const ICON: &str = "/favicon.ico";

/// Contents that are served.
#[derive(Debug)]
pub struct Site {
    /// The page.
    pub page: Page,
    /// The run whose events it shows; `None` for a page of a finished result.
    pub live: Option<Arc<LiveRun>>,
    /// Service that answers its questions; `None` where it has none, and nothing but reading is allowed.
    pub service: Option<Arc<dyn Service>>,
}

/// A page, as HTML.
pub enum Page {
    /// A fixed text, the same for every request.
    Fixed(String),
    /// Made anew each time; or why it cannot be, which is shown as text.
    Made(Box<PageMaker>),
}

/// Makes a page.
pub type PageMaker = dyn Fn() -> Result<String, Box<dyn Error + Send + Sync>> + Send + Sync;

/// Answer to a request.
pub enum SiteAnswer<'a> {
    /// The page.
    Page(Cow<'a, str>),
    /// Reason that there is no page.
    NoPage(String),
    /// Events as they come.
    Events(&'a Arc<LiveRun>),
    /// Empty answer.
    Nothing,
}

impl Site {
    /// A page alone.
    #[must_use]
    pub fn from_page(page: Page) -> Self {
        let (live, service) = (None, None);
        Self { page, live, service }
    }

    /// Finds the answer to a request.
    pub fn find(&self, request: &Request) -> Result<SiteAnswer<'_>, Refusal> {
        match (request.path.as_str(), &self.live) {
            (PAGE, _) => Ok(self.page.found()),
            (ICON, _) => Ok(SiteAnswer::Nothing),
            (EVENTS, Some(live)) if request.query.as_deref().is_none_or(|query| live.is_asked_for(query)) => {
                Ok(SiteAnswer::Events(live))
            }
            // A page of another plan that was open before on this port: it is not to show this one's motion.
            (EVENTS, Some(_)) => Ok(SiteAnswer::Nothing),
            _ => Err(Refusal::NotFound),
        }
    }
}

impl Page {
    fn found(&self) -> SiteAnswer<'_> {
        match self {
            Self::Fixed(page) => SiteAnswer::Page(Cow::Borrowed(page)),
            Self::Made(make) => match make() {
                Ok(page) => SiteAnswer::Page(Cow::Owned(page)),
                Err(error) => SiteAnswer::NoPage(error.to_string()),
            },
        }
    }
}

impl fmt::Debug for Page {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fixed(_) => "Fixed(..)",
            Self::Made(_) => "Made(..)",
        })
    }
}
