//! The headers of a request.

use super::refusal::Refusal;
use httparse::Header;

/// The headers of a request.
pub struct Headers<'a>(pub &'a [Header<'a>]);

impl<'a> Headers<'a> {
    /// A header that can be stated once.
    pub fn one(&self, name: &str) -> Result<Option<&'a str>, Refusal> {
        let mut stated = self.0.iter().filter(|header| header.name.eq_ignore_ascii_case(name));
        let (first, second) = (stated.next(), stated.next());
        match (first, second) {
            (None, _) => Ok(None),
            (Some(header), None) => std::str::from_utf8(header.value)
                .map(Some)
                .map_err(|_| Refusal::Garbled),
            (Some(_), Some(_)) => Err(Refusal::Garbled),
        }
    }

    /// Whether a page of another site asks, as browsers say of their own accord.
    pub fn are_of_a_foreign_page(&self) -> Result<bool, Refusal> {
        let site = self.one("sec-fetch-site")?;
        Ok(site.is_some_and(|site| !["same-origin", "none"].contains(&site)))
    }

    /// Whether a link is followed, and nothing asked for to be put into a page: who follows it sees the page, and the other site does not.
    pub fn are_of_a_link(&self) -> Result<bool, Refusal> {
        Ok(self.one("sec-fetch-mode")? == Some("navigate") && self.one("sec-fetch-dest")? == Some("document"))
    }

    /// Whether contents follow.
    pub fn announce_contents(&self) -> Result<bool, Refusal> {
        let length = self.one("content-length")?;
        Ok(self.one("transfer-encoding")?.is_some() || length.is_some_and(|length| length.trim() != "0"))
    }
}
