//! Where a plate could be washed, told as it is found.

use crate::draft::changed;
use crate::end::End;
use crate::placed::placed;
use crate::protocol::{MapLine, MapQuestion, Refusal};
use crate::refusal::plain;
use crate::stopwatch::Stopwatch;
use crate::subject::Subject;
use crate::told::Told;
use platewash_planner::{MapArea, MapPatch, Watch, washable_map};
use platewash_workcell::cancel::{CancelToken, Deadline};

/// What a map means.
const MEANING: &str = "Where a plate of this size could lie, the others as they are: at the middle of each square it has room, and \
                       configurations were found for all of its wash path. Not planned, not proved.";

/// Answers the question.
pub fn answer(subject: &Subject, question: &MapQuestion, told: &mut Told<'_>, gone: &CancelToken, deadline: &Deadline) {
    let mut watch = Stopwatch::start();
    let answered = told_map(subject, question, told, gone);
    watch.step("map");
    match answered {
        Ok(()) => told.line(&MapLine::MapDone {
            words: MEANING,
            ms: watch.all(),
        }),
        Err(End::Refused(refusal)) => {
            let ms = watch.all();
            told.line(&MapLine::Refused(&Refusal { ms, ..refusal }));
        }
        Err(End::GivenUp) if deadline.is_missed() => told.line(&MapLine::Failed {
            words: "the map was not finished within two minutes: what is drawn is what was looked at",
        }),
        Err(End::GivenUp) => told.line(&MapLine::Superseded),
        Err(End::Failed(words)) => told.line(&MapLine::Failed { words: &words }),
    }
}

fn told_map(subject: &Subject, question: &MapQuestion, told: &mut Told<'_>, gone: &CancelToken) -> Result<(), End> {
    let scenario = changed(subject, &question.text, &[], gone)?.scenario?;
    let placed = placed(subject, scenario, gone)?;
    let (plate, count) = (question.plate, placed.layout.plates.len());
    if plate >= count {
        return Err(plain(format!(
            "there is no plate {plate}: the cell has {count}, counted from 0"
        ))
        .into());
    }
    let mut tell = |patch: MapPatch| {
        told.line(&MapLine::Map {
            step_m: patch.step_m,
            washable_m: &patch.washable_m,
            unwashable_m: &patch.unwashable_m,
            done: patch.done,
            of: patch.of,
        });
    };
    let area = MapArea::within_reach(&placed.job, plate)?;
    washable_map(&placed.job, plate, &area, &mut tell, &Watch::silent(gone))?;
    Ok(())
}
