//! Turns of long work: so many at a time, the others in order behind them.

use super::limits::{LOOK, WAITING, WORK};
use platewash_workcell::cancel::CancelToken;
use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// All work of a server.
#[derive(Debug, Default)]
pub struct Work {
    line: Mutex<Line>,
    moved: Condvar,
}

#[derive(Debug, Default)]
struct Line {
    running: usize,
    /// Numbers of those who wait, the next one first.
    waiting: VecDeque<u64>,
    next: u64,
}

/// A turn, until it is dropped.
#[derive(Debug)]
pub struct Turn<'a>(&'a Work);

/// Why there is no turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoTurn {
    /// Too many wait already, or it did not come in time.
    Busy,
    /// Whoever waited for it is gone.
    Gone,
}

impl Work {
    /// Waits for a turn, for so long at most and no longer than `gone` allows.
    pub fn turn(&self, patience: Duration, gone: &CancelToken) -> Result<Turn<'_>, NoTurn> {
        let begin = Instant::now();
        let mut line = self.lock();
        if line.waiting.len() >= WAITING {
            return Err(NoTurn::Busy);
        }
        let number = line.next;
        line.next += 1;
        line.waiting.push_back(number);
        loop {
            let outcome = if line.running < WORK && line.waiting.front() == Some(&number) {
                line.running += 1;
                Ok(Turn(self))
            } else if gone.is_cancelled() {
                Err(NoTurn::Gone)
            } else if begin.elapsed() >= patience {
                Err(NoTurn::Busy)
            } else {
                let woken = self.moved.wait_timeout(line, LOOK);
                line = woken.unwrap_or_else(PoisonError::into_inner).0;
                continue;
            };
            line.waiting.retain(|&other| other != number);
            drop(line);
            self.moved.notify_all();
            return outcome;
        }
    }

    fn lock(&self) -> MutexGuard<'_, Line> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        self.0.lock().running -= 1;
        self.0.moved.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;
    use std::thread::{scope, sleep};

    const LONG: Duration = Duration::from_secs(60);

    /// Waits until so many wait.
    fn until_waiting(work: &Work, n: usize) {
        let begin = Instant::now();
        while work.lock().waiting.len() != n {
            assert!(begin.elapsed() < LONG, "{work:?}");
            sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn turns_come_in_order_and_so_many_at_a_time() {
        let (work, gone) = (Work::default(), CancelToken::new());
        let mut turns: Vec<_> = (0..WORK).map(|_| work.turn(LONG, &gone).unwrap()).collect();
        let (order, orders) = mpsc::channel();
        scope(|scope| {
            for n in 0..WAITING {
                let (work, gone, order) = (&work, &gone, order.clone());
                scope.spawn(move || {
                    let turn = work.turn(LONG, gone).unwrap();
                    assert!(work.lock().running <= WORK);
                    order.send(n).unwrap();
                    drop(turn);
                });
                until_waiting(work, n + 1);
            }
            assert_eq!(
                work.turn(LONG, &gone).unwrap_err(),
                NoTurn::Busy,
                "nobody waits behind the last"
            );
            // One place, so that they come one after the other.
            turns.pop();
            let came: Vec<_> = orders.iter().take(WAITING).collect();
            assert_eq!(came, (0..WAITING).collect::<Vec<_>>());
        });
        drop(turns);
        assert_eq!(work.lock().running, 0);
    }

    #[test]
    fn who_is_gone_or_has_waited_long_enough_makes_room() {
        let (work, gone, other) = (Work::default(), CancelToken::new(), CancelToken::new());
        let turns: Vec<_> = (0..WORK).map(|_| work.turn(LONG, &gone).unwrap()).collect();
        let short = Duration::from_millis(20);
        assert_eq!(work.turn(short, &gone).unwrap_err(), NoTurn::Busy);
        scope(|scope| {
            let first = scope.spawn(|| work.turn(LONG, &gone).map(drop));
            until_waiting(&work, 1);
            let second = scope.spawn(|| work.turn(LONG, &other).map(drop));
            until_waiting(&work, 2);
            gone.cancel();
            assert_eq!(first.join().unwrap(), Err(NoTurn::Gone));
            assert_eq!(work.lock().waiting.len(), 1);
            drop(turns);
            assert_eq!(second.join().unwrap(), Ok(()));
        });
    }

    #[test]
    fn a_turn_ends_with_a_panic_in_it() {
        let (work, gone) = (Work::default(), CancelToken::new());
        for _ in 0..2 * WORK {
            let panics = scope(|scope| {
                scope
                    .spawn(|| {
                        let _turn = work.turn(LONG, &gone).unwrap();
                        std::panic::resume_unwind(Box::new("on purpose"));
                    })
                    .join()
            });
            assert!(panics.is_err());
        }
        assert_eq!(work.lock().running, 0);
    }
}
