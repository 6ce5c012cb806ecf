//! One question of the page, from its first byte to the last line of its answer.

use super::answer;
use super::body;
use super::connections::{Place, Stage};
use super::deadline::Deadline;
use super::limits::{TO_QUESTION, TO_RECEIVE, TO_WAIT};
use super::lines::Lines;
use super::question::Question;
use super::refusal::Refusal;
use super::service::{Gone, Service};
use super::watched::watched;
use super::work::{NoTurn, Work};
use platewash_workcell::cancel::CancelToken;
use std::io::Result;
use std::net::{Shutdown, TcpStream};

/// A question that has come: under which path, what its head announces, and what of it came with the head.
#[derive(Debug)]
pub struct Come<'a> {
    /// From `/` to `?`.
    pub path: &'a str,
    /// What its head announces.
    pub question: Question,
    /// What came behind its head.
    pub begun: &'a [u8],
}

/// Reads a question and answers it.
pub fn answer(stream: &TcpStream, service: &dyn Service, work: &Work, place: &Place, come: &Come) -> Result<()> {
    place.is_at(Stage::Telling);
    let out = Deadline::after(stream, TO_QUESTION);
    let body = body::read(out, come.begun, come.question.length);
    place.is_at(Stage::Answered);
    match body {
        Ok(body) => answer_body(stream, service, work, come, &body),
        Err(refused) => refuse(stream, refused),
    }
}

fn answer_body(stream: &TcpStream, service: &dyn Service, work: &Work, come: &Come, body: &[u8]) -> Result<()> {
    let (lines, gone) = (Lines::new(stream), CancelToken::new());
    let mut answered = Ok(());
    watched(stream, &lines, &gone, || {
        answered = in_turn(service, work, come, body, &lines, &gone);
        // The answer ends here, and not when the thread that watches has seen it.
        let _ = stream.shutdown(Shutdown::Write);
    })
    .or_else(|_| refuse(stream, Refusal::Full))?;
    answered
}

fn in_turn(
    service: &dyn Service,
    work: &Work,
    come: &Come,
    body: &[u8],
    lines: &Lines,
    gone: &CancelToken,
) -> Result<()> {
    let turn = come.question.asked.is_work.then(|| work.turn(TO_WAIT, gone));
    let _turn = match turn.transpose() {
        Ok(turn) => turn,
        Err(NoTurn::Busy) => return lines.refuse(Refusal::Busy),
        Err(NoTurn::Gone) => return Ok(()),
    };
    lines.begin()?;
    let mut tell = |line| match gone.is_cancelled() || lines.line(line).is_err() {
        true => {
            gone.cancel();
            Err(Gone)
        }
        false => Ok(()),
    };
    service.answer(come.path, body, &mut tell, gone);
    Ok(())
}

fn refuse(stream: &TcpStream, refused: Refusal) -> Result<()> {
    answer::refusal(&mut Deadline::after(stream, TO_RECEIVE), refused, true)
}
