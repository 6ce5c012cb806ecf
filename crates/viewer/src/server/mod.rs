//! A page on the loopback: one HTML file and, of a live run, its events.
//!
//! [`Listener::bind`] takes a port before any long work, [`Listener::serve`] answers on it until the [`Server`] is dropped. What it serves
//! lives in memory; it reads no file, whatever is asked for. Where the page has questions, a [`Service`] answers them.
//!
//! | concept | file |
//! | --- | --- |
//! | sizes, numbers and times that bound what a client can do | `limits.rs` |
//! | which addresses and origins requests may name | `names.rs` |
//! | the head of a request, read and judged | `head.rs`, `headers.rs`, `request.rs` |
//! | who answers questions of the page, and what the page shows to ask them | `service.rs`, `token.rs` |
//! | a question as its head announces it; what follows that | `question.rs`, `body.rs` |
//! | one question, from its first byte to the last line of its answer | `questions.rs` |
//! | whose turn it is; whether the client is still there; the lines of an answer | `work.rs`, `watched.rs`, `lines.rs` |
//! | why a request is refused | `refusal.rs` |
//! | what is answered | `answer.rs` |
//! | a stream with a deadline | `deadline.rs` |
//! | who is connected, and who has to go for another; who is turned away | `connections.rs`, `turned_away.rs` |
//! | what is served; one connection from request to answer | `site.rs`, `connection.rs` |
//! | the port, and the thread that accepts | `listener.rs` |
//! | a live run as those who watch it share it | `live.rs` |
//! | it as server-sent events | `events.rs` |
//! | samples of a simulation into it, in real time | `feed.rs`, `pace.rs` |

mod answer;
mod body;
mod connection;
mod connections;
mod deadline;
mod error;
mod events;
mod feed;
mod head;
mod headers;
mod limits;
mod lines;
mod listener;
mod live;
mod names;
mod pace;
mod question;
mod questions;
mod refusal;
mod request;
mod service;
mod site;
mod token;
mod turned_away;
mod watched;
mod work;

pub use error::ServerError;
pub use feed::Feed;
pub use listener::{Listener, Server};
pub use live::{Live, LiveEnd};
pub use service::{Asked, Gone, Service};
pub use site::{MakePage, Page, Site};
pub use token::token;
