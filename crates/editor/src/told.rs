//! Lines on their way to the page.

use platewash_workcell::cancel::CancelToken;
use serde::Serialize;

/// Takes lines as long as somebody listens.
pub struct Told<'a> {
    tell: &'a mut dyn FnMut(String) -> bool,
    /// Cancelled once nobody does.
    gone: CancelToken,
}

impl<'a> Told<'a> {
    /// Lines go to `tell`, which says whether anybody listens.
    pub fn new(tell: &'a mut dyn FnMut(String) -> bool, gone: &CancelToken) -> Self {
        Self {
            tell,
            gone: gone.clone(),
        }
    }

    /// Tells a line.
    pub fn line(&mut self, line: &impl Serialize) {
        // Lines are made of numbers and text, which JSON can say.
        let Ok(text) = serde_json::to_string(line) else { return };
        if !(self.tell)(text) {
            self.gone.cancel();
        }
    }
}
