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
    /// It carries contents.
    Contents,
    /// It did not come in time.
    Late,
    /// Its first line or its headers are too long or too many.
    TooLong,
    /// Another version of HTTP than 1.0 and 1.1.
    Version,
    /// As many follow the run as can.
    Busy,
}

impl Refusal {
    /// Status code and reason.
    pub fn status(self) -> &'static str {
        match self {
            Self::Garbled => "400 Bad Request",
            Self::ForeignHost | Self::ForeignOrigin => "403 Forbidden",
            Self::NotFound => "404 Not Found",
            Self::Method => "405 Method Not Allowed",
            Self::Late => "408 Request Timeout",
            Self::Contents => "413 Content Too Large",
            Self::TooLong => "431 Request Header Fields Too Large",
            Self::Busy => "503 Service Unavailable",
            Self::Version => "505 HTTP Version Not Supported",
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
            Self::Contents => "a request has no contents here",
            Self::Late => "the request did not come in time",
            Self::TooLong => "the request's head is too long",
            Self::Version => "HTTP/1.0 and HTTP/1.1 are spoken, nothing else",
            Self::Busy => "as many pages follow the run as can: close one",
        }
    }
}
