//! Ctrl-C and a request to end (SIGTERM): the first one tells the work to give up, the second one ends the program at once.

use super::failure::INTERRUPTED;
use platewash::CancelToken;

/// A token that Ctrl-C and SIGTERM cancel from now on. For the program alone: there is one handler a process, and in a library it is the
/// caller's.
pub fn token() -> CancelToken {
    let token = CancelToken::new();
    let given_up = token.clone();
    // Where no handler can be set, the system ends the program at the first Ctrl-C; one that was started to ignore it, in the background
    // of a shell or by nohup, keeps ignoring it.
    let _ = ctrlc::try_set_handler(move || give_up(&given_up));
    #[cfg(unix)]
    heed_termination(token.clone());
    token
}

/// Cancels the token at each SIGTERM. Where that cannot be done, the system ends the program.
#[cfg(unix)]
fn heed_termination(token: CancelToken) {
    use signal_hook::consts::SIGTERM;
    use signal_hook::iterator::Signals;
    if let Ok(mut signals) = Signals::new([SIGTERM]) {
        std::thread::spawn(move || signals.forever().for_each(|_| give_up(&token)));
    }
}

fn give_up(token: &CancelToken) {
    if token.is_cancelled() {
        std::process::exit(INTERRUPTED.into());
    }
    token.cancel();
}
