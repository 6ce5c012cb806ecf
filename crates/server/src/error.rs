//! Why nothing can be served.

use platewash_editor::EditorError;
use std::net::SocketAddr;

/// Reason that nothing can be served.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServerError {
    /// The address is taken, is none of this machine, or may not be used.
    #[error("cannot listen on {address}")]
    Bind {
        /// Address asked for.
        address: SocketAddr,
        /// Error of the system.
        source: std::io::Error,
    },
    /// The system gives no thread.
    #[error("cannot serve: no thread can be started")]
    Thread(#[source] std::io::Error),
    /// The system gives no random numbers, without which no token can be made that nobody guesses.
    #[error("cannot make a token: the system gives no random numbers")]
    Randomness(#[source] std::io::Error),
    /// The page of a live cell cannot be made.
    #[error(transparent)]
    Cell(#[from] EditorError),
}
