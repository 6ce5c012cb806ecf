//! An editor behind the page's server.

use crate::bounds::MOST_QUESTION_BYTES;
use crate::document::Channel;
use crate::editor::Editor;
use crate::error::EditorError;
use crate::keep::Kept;
use crate::told::Told;
use platewash_viewer::bundle::Bundle;
use platewash_viewer::server::{Asked, Gone, Page, Service, Site, token};
use platewash_workcell::cancel::CancelToken;
use std::sync::Arc;

/// Longest question about the disk \[bytes\].
const MOST_SHORT_BYTES: usize = 1 << 10;

/// An editor, its page and its token.
#[derive(Debug)]
struct Served {
    editor: Editor,
    bundle: Bundle,
    token: String,
}

/// The site of an editor: its page, made anew for each who opens it, and its answers. Whoever opens the page sees the scenario; who asks a
/// question needs the token, which the page takes from its address ([`Service::token`]).
///
/// # Errors
/// [`EditorError::Token`], and [`EditorError`] for a page that cannot be made.
pub fn site(editor: Editor, bundle: Bundle) -> Result<Site, EditorError> {
    let token = token().map_err(|error| EditorError::Token(error.to_string()))?;
    let served = Arc::new(Served { editor, bundle, token });
    // Found out now, not when somebody looks at it.
    served.page()?;
    let pages = served.clone();
    let page = Page::Made(Box::new(move || pages.page().map_err(Into::into)));
    Ok(Site {
        service: Some(served),
        ..Site::of(page)
    })
}

impl Served {
    /// The page of what stands on disk; of the scenario as it was opened where nothing does, or nothing that is one.
    fn page(&self) -> Result<String, EditorError> {
        let on_disk = self.editor.kept.as_ref().and_then(Kept::scenario);
        let text = on_disk.as_deref().unwrap_or(self.editor.text());
        self.editor.page(Channel::Server, text, &self.bundle)
    }
}

impl Service for Served {
    fn knows(&self, path: &str) -> Option<Asked> {
        let asked = |is_work, most_bytes| Some(Asked { is_work, most_bytes });
        match path {
            "/cell" | "/map" | "/save" => asked(true, MOST_QUESTION_BYTES),
            "/disk" | "/hello" => asked(false, MOST_SHORT_BYTES),
            _ => None,
        }
    }

    fn answer(
        &self,
        path: &str,
        question: &[u8],
        tell: &mut dyn FnMut(String) -> Result<(), Gone>,
        gone: &CancelToken,
    ) {
        let mut tell = |line| tell(line).is_ok();
        match (path, &self.editor.kept) {
            ("/hello", Some(kept)) => kept.greet(&mut Told::new(&mut tell, gone)),
            _ => self.editor.answer(path, question, &mut tell, gone),
        }
    }

    fn token(&self) -> &str {
        &self.token
    }
}
