//! Services of the machine that an editor runs on.

use platewash_kinematics::urdf::Files;
use platewash_workcell::cancel::Clock;

/// Clock and files of the machine that an editor runs on: a server, a notebook's kernel, or a worker of a browser.
///
/// Work runs on the threads of rayon's global pool, which is the calling thread alone where the machine has no threads. Nothing here
/// needs random numbers: seeds are given.
#[derive(Debug, Clone)]
pub struct Host {
    /// Clock of deadlines and of the times that answers state.
    pub clock: Clock,
    /// Source of the files that scenarios name.
    pub files: Files,
}
