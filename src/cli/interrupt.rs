//! Ctrl-C: the first one tells the work to give up, the second one ends the program at once.

use super::failure::INTERRUPTED;
use platewash::CancelToken;

/// A token that Ctrl-C cancels from now on. For the program alone: there is one handler a process, and in a library it is the caller's.
pub fn token() -> CancelToken {
    let token = CancelToken::new();
    let given_up = token.clone();
    // Where no handler can be set, the system ends the program at the first Ctrl-C; one that was started to ignore it, in the background
    // of a shell or by nohup, keeps ignoring it.
    let _ = ctrlc::try_set_handler(move || {
        if given_up.is_cancelled() {
            std::process::exit(INTERRUPTED.into());
        }
        given_up.cancel();
    });
    token
}
