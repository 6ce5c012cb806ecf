//! Sizes, numbers and times that bound what a client can do.

use std::time::Duration;

/// Longest head of a request \[bytes\]: its first line and all headers.
pub const HEAD_BYTES: usize = 16 << 10;

/// Most headers of a request.
pub const HEADERS: usize = 64;

/// For how long a client may take to ask.
pub const TO_ASK: Duration = Duration::from_secs(5);

/// For how long a client may take to receive the page.
pub const TO_RECEIVE: Duration = Duration::from_secs(60);

/// For how long a client may take to receive events that are due.
pub const TO_RECEIVE_EVENTS: Duration = Duration::from_secs(5);

/// How much of what a client goes on sending is read before its connection is closed \[bytes\], and for how long: closed at once, the
/// system would tell the client of a reset in place of the answer.
pub const LINGER_BYTES: usize = 64 << 10;
/// See [`LINGER_BYTES`].
pub const LINGER: Duration = Duration::from_millis(500);

/// Most connections at a time.
pub const CONNECTIONS: usize = 64;

/// Most of them that follow a live run.
pub const FOLLOWERS: usize = 16;

/// Time to the next sign of life where there is nothing to tell.
pub const HEARTBEAT: Duration = Duration::from_secs(2);

/// For how long the end of the server waits for threads whose connections are closed.
pub const TO_END: Duration = Duration::from_secs(1);

/// Most rows of a live run that are kept.
pub const ROWS: usize = 60_000;

/// Rows of one event.
pub const ROWS_AN_EVENT: usize = 500;

/// For how long a client may take to send a question, behind its head.
pub const TO_QUESTION: Duration = Duration::from_secs(5);

/// Most questions that are being received at a time. One more pushes out the oldest.
pub const QUESTIONS: usize = 8;

/// For how long a client may take to receive a line of an answer.
pub const TO_RECEIVE_LINE: Duration = Duration::from_secs(5);

/// Most questions that are being worked on at a time.
pub const WORK: usize = 2;

/// Most questions that wait to be worked on.
pub const WAITING: usize = 16;

/// For how long each of them waits at most.
pub const TO_WAIT: Duration = Duration::from_secs(10);

/// Time between two looks at whether whoever waits gives up, or is gone.
pub const LOOK: Duration = Duration::from_millis(50);

/// Most clients without a place that are told so and not closed yet.
pub const TURNED_AWAY: usize = 64;
