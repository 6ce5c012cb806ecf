//! A question of the page as its head announces it.

use super::headers::Headers;
use super::refusal::Refusal;
use super::service::Asked;
use super::token::is_token;

/// The header that the token stands in. A page of another origin cannot send it without asking first, which is refused.
const TOKEN: &str = "x-platewash-token";

/// A question that may be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Question {
    /// What is to be known of it.
    pub asked: Asked,
    /// How long it is \[bytes\].
    pub length: usize,
}

impl Question {
    /// Judges the headers of a question that came to a host, one of this server's names.
    pub fn judge(headers: &Headers, host: &str, asked: Asked, token: &str) -> Result<Self, Refusal> {
        // Only a page that was loaded from here under the very name that it asks: browsers state the origin of each POST.
        let origin = headers.one("origin")?.and_then(|origin| origin.strip_prefix("http://"));
        let is_own = origin.is_some_and(|origin| origin.eq_ignore_ascii_case(host));
        if !is_own || headers.are_of_a_foreign_page()? {
            return Err(Refusal::ForeignOrigin);
        }
        // What a form of any page can send is none of these types.
        if !headers.one("content-type")?.is_some_and(is_json) {
            return Err(Refusal::Form);
        }
        if !headers.one(TOKEN)?.is_some_and(|sent| is_token(sent, token)) {
            return Err(Refusal::ForeignToken);
        }
        if headers.one("transfer-encoding")?.is_some() {
            return Err(Refusal::NoLength);
        }
        let length = length(headers.one("content-length")?.ok_or(Refusal::NoLength)?)?;
        match length <= asked.most_bytes {
            true => Ok(Self { asked, length }),
            false => Err(Refusal::LongQuestion),
        }
    }
}

fn is_json(media_type: &str) -> bool {
    let kind = media_type.split(';').next().unwrap_or_default();
    kind.trim().eq_ignore_ascii_case("application/json")
}

/// A length in digits; one too long for a number is too long.
fn length(stated: &str) -> Result<usize, Refusal> {
    match !stated.is_empty() && stated.bytes().all(|b| b.is_ascii_digit()) {
        true => stated.parse().map_err(|_| Refusal::LongQuestion),
        false => Err(Refusal::Garbled),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use httparse::Header;

    const HOST: &str = "localhost:8080";
    const ASKED: Asked = Asked {
        is_work: false,
        most_bytes: 100,
    };
    const GOOD: [(&str, &str); 4] = [
        ("Origin", "http://localhost:8080"),
        ("Content-Type", "application/json"),
        ("X-Platewash-Token", "secret"),
        ("Content-Length", "100"),
    ];

    fn judged(headers: &[(&str, &str)], asked: Asked) -> Result<Question, Refusal> {
        let header = |&(name, value): &(&'static str, &'static str)| Header {
            name,
            value: value.as_bytes(),
        };
        // The tests' headers are constants; those of requests live as long as their head.
        let leaked: Vec<(&'static str, &'static str)> = headers
            .iter()
            .map(|(name, value)| (&*name.to_string().leak(), &*value.to_string().leak()))
            .collect();
        let headers: Vec<_> = leaked.iter().map(header).collect();
        Question::judge(&Headers(&headers), HOST, asked, "secret")
    }

    /// The good headers with one of them stated so, or not at all.
    fn with(name: &str, value: Option<&str>) -> Result<Question, Refusal> {
        let mut headers: Vec<_> = GOOD.iter().copied().filter(|header| header.0 != name).collect();
        headers.extend(value.map(|value| (name, value)));
        judged(&headers, ASKED)
    }

    #[test]
    fn a_question_of_the_page_may_be_read() {
        let (asked, length) = (ASKED, 100);
        assert_eq!(judged(&GOOD, ASKED), Ok(Question { asked, length }));
        for kind in [
            "Application/JSON",
            "application/json; charset=utf-8",
            "application/json ;x",
        ] {
            assert!(with("Content-Type", Some(kind)).is_ok(), "{kind}");
        }
        for site in ["same-origin", "none"] {
            assert!(with("Sec-Fetch-Site", Some(site)).is_ok(), "{site}");
        }
        assert_eq!(with("Content-Length", Some("0")).unwrap().length, 0);
        assert!(with("Origin", Some("http://LOCALHOST:8080")).is_ok());
    }

    #[test]
    fn each_header_is_needed_as_it_should_be() {
        let long = "9".repeat(40);
        let cases = [
            ("Origin", None, Refusal::ForeignOrigin),
            ("Origin", Some("null"), Refusal::ForeignOrigin),
            ("Origin", Some("https://localhost:8080"), Refusal::ForeignOrigin),
            // Another name of this server is another origin.
            ("Origin", Some("http://127.0.0.1:8080"), Refusal::ForeignOrigin),
            ("Origin", Some("http://localhost:8080/"), Refusal::ForeignOrigin),
            ("Sec-Fetch-Site", Some("cross-site"), Refusal::ForeignOrigin),
            ("Sec-Fetch-Site", Some("same-site"), Refusal::ForeignOrigin),
            ("Content-Type", None, Refusal::Form),
            ("Content-Type", Some("text/plain"), Refusal::Form),
            ("Content-Type", Some("text/plain;application/json"), Refusal::Form),
            ("Content-Type", Some("application/jsonp"), Refusal::Form),
            ("X-Platewash-Token", None, Refusal::ForeignToken),
            ("X-Platewash-Token", Some(""), Refusal::ForeignToken),
            ("X-Platewash-Token", Some("secre"), Refusal::ForeignToken),
            ("X-Platewash-Token", Some("secrex"), Refusal::ForeignToken),
            ("Content-Length", None, Refusal::NoLength),
            ("Transfer-Encoding", Some("chunked"), Refusal::NoLength),
            ("Content-Length", Some("101"), Refusal::LongQuestion),
            ("Content-Length", Some(&long), Refusal::LongQuestion),
            ("Content-Length", Some(""), Refusal::Garbled),
            ("Content-Length", Some("-1"), Refusal::Garbled),
            ("Content-Length", Some("+1"), Refusal::Garbled),
            ("Content-Length", Some("1, 1"), Refusal::Garbled),
            ("Content-Length", Some("0x10"), Refusal::Garbled),
        ];
        for (name, value, expected) in cases {
            assert_eq!(with(name, value), Err(expected), "{name}: {value:?}");
        }
        for header in GOOD {
            let twice: Vec<_> = GOOD.into_iter().chain([header]).collect();
            assert_eq!(judged(&twice, ASKED), Err(Refusal::Garbled), "{header:?}");
        }
    }

    #[test]
    fn a_link_to_a_question_is_foreign_too() {
        let navigation = [
            ("Sec-Fetch-Site", "cross-site"),
            ("Sec-Fetch-Mode", "navigate"),
            ("Sec-Fetch-Dest", "document"),
        ];
        let headers: Vec<_> = GOOD.into_iter().chain(navigation).collect();
        assert_eq!(judged(&headers, ASKED), Err(Refusal::ForeignOrigin));
    }

    #[test]
    fn every_question_needs_the_token() {
        let without: Vec<_> = GOOD
            .into_iter()
            .filter(|header| header.0 != "X-Platewash-Token")
            .collect();
        assert_eq!(judged(&without, ASKED), Err(Refusal::ForeignToken));
    }
}
