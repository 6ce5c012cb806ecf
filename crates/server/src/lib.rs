//! Serves pages, live runs and live cells to browsers on this machine: one HTML file and its events or answers.
//!
//! [`Listener::bind`] takes a port before any long work, [`Listener::serve`] answers on it until the [`Server`] is dropped. What it serves
//! lives in memory; it reads no file for any request, except the scenario of a live cell. Where the page has questions, a [`Service`]
//! answers them.
//!
//! | concept | file |
//! | --- | --- |
//! | a request: its head, the origins that may ask, and the question that may follow it | `request.rs` |
//! | the addresses and origins that requests may name; the token of the page | `names.rs`, `token.rs` |
//! | the service that answers questions of the page | `service.rs` |
//! | answers, and the reasons that a request is refused | `answer.rs` |
//! | the contents served; one connection from request to answer | `site.rs`, `connection.rs` |
//! | a stream with a deadline | `deadline.rs` |
//! | who is connected, who has to go for another, how much is worked on at a time | `connections.rs` |
//! | the port, and the thread that accepts | `listener.rs` |
//! | the site of a live cell: its page and its answers | `live_cell.rs` |
//! | a live run as those who watch it share it; samples of a simulation into it, in real time | `live.rs`, `feed.rs` |

mod answer;
mod connection;
mod connections;
mod deadline;
mod error;
mod feed;
mod listener;
mod live;
mod live_cell;
mod names;
mod request;
mod service;
mod site;
mod token;

pub use error::ServerError;
pub use feed::Feed;
pub use listener::{Listener, Server};
pub use live::{LiveEnd, LiveRun, SamplesEvent, StateEvent};
pub use live_cell::cell_site;
pub use service::{NoListener, QuestionLimits, Service};
pub use site::{Page, PageMaker, Site};
pub use token::token;
