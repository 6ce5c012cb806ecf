//! Why a request is refused.

/// Why a request is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// It is no HTTP, or says something twice that can be said once.
    Garbled,
    /// It names a host that is not this server: a page elsewhere may have had its name changed to this machine's address.
    ForeignHost,
    /// A page of another origin asks.
    ForeignOrigin,
    /// Nothing is here.
    NotFound,
    /// Neither GET nor HEAD.
    Method,
    /// Something else than POST, where questions are answered.
    QuestionMethod,
    /// It carries contents.
    Contents,
    /// A question in another form than JSON.
    Form,
    /// A question that does not say how long it is, or comes in pieces.
    NoLength,
    /// A question that is too long.
    LongQuestion,
    /// A question without the token of this server: its page was loaded from another one.
    ForeignToken,
    /// It did not come in time.
    Late,
    /// Its first line or its headers are too long or too many.
    TooLong,
    /// Another version of HTTP than 1.0 and 1.1.
    Version,
    /// As many follow the run as can.
    Followed,
    /// As many questions are worked on, and wait for that, as can.
    Busy,
    /// As many clients are being answered as can.
    Full,
}

impl Refusal {
    /// Status code and reason.
    pub fn status(self) -> &'static str {
        match self {
            Self::Garbled => "400 Bad Request",
            Self::ForeignHost | Self::ForeignOrigin | Self::ForeignToken => "403 Forbidden",
            Self::NotFound => "404 Not Found",
            Self::Method | Self::QuestionMethod => "405 Method Not Allowed",
            Self::Late => "408 Request Timeout",
            Self::NoLength => "411 Length Required",
            Self::Contents | Self::LongQuestion => "413 Content Too Large",
            Self::Form => "415 Unsupported Media Type",
            Self::TooLong => "431 Request Header Fields Too Large",
            Self::Followed | Self::Busy | Self::Full => "503 Service Unavailable",
            Self::Version => "505 HTTP Version Not Supported",
        }
    }

    /// Headers that go with it.
    pub fn headers(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Method => &[("Allow", "GET, HEAD")],
            Self::QuestionMethod => &[("Allow", "POST")],
            // In so many seconds.
            Self::Busy | Self::Full => &[("Retry-After", "1")],
            _ => &[],
        }
    }

    /// What a person who sees it can do.
    pub fn words(self) -> &'static str {
        match self {
            Self::Garbled => "this is no request of HTTP/1.1 with one Host",
            Self::ForeignHost => {
                "this server answers to its own address and port alone: open the address that the command has printed"
            }
            Self::ForeignOrigin => {
                "pages of other origins are not answered: open the address that the command has printed"
            }
            Self::NotFound => "there is one page here: /",
            Self::Method => "GET and HEAD are answered, nothing else",
            Self::QuestionMethod => "questions of the page are answered here: POST, nothing else",
            Self::Contents => "a request has no contents here",
            Self::Form => "a question is JSON: Content-Type: application/json",
            Self::NoLength => {
                "a question states its length, once, and comes in one piece: Content-Length, and no Transfer-Encoding"
            }
            Self::LongQuestion => "the question is too long",
            Self::ForeignToken => {
                "the page does not have the token of this server: open the address that platewash edit printed"
            }
            Self::Late => "the request did not come in time",
            Self::TooLong => "the request's head is too long",
            Self::Version => "HTTP/1.0 and HTTP/1.1 are spoken, nothing else",
            Self::Followed => "as many pages follow the run as can: close one",
            Self::Busy => "as much is being worked on as can be: ask again",
            Self::Full => "as many are being answered as can be: ask again",
        }
    }
}
