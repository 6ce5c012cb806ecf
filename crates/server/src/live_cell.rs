//! The site of a live cell.

use crate::error::ServerError;
use crate::service::{NoListener, QuestionLimits, Service};
use crate::site::{Page, Site};
use crate::token::token;
use platewash_editor::{Editor, MOST_QUESTION_BYTES};
use platewash_viewer::bundle::Bundle;
use platewash_workcell::cancel::CancelToken;
use std::sync::Arc;

/// Longest question about the disk \[bytes\].
const MOST_SHORT_BYTES: usize = 1 << 10;

/// An editor and its token.
#[derive(Debug)]
struct CellService {
    editor: Arc<Editor>,
    token: String,
}

/// The site of a live cell: its page, made anew for each visitor, and its answers. Every visitor of the page sees the scenario; a
/// question needs the token, which the page takes from its address ([`Service::token`]).
///
/// # Errors
/// [`ServerError::Randomness`], and [`ServerError::Cell`] for a page that cannot be made.
pub fn cell_site(editor: Editor, bundle: Bundle) -> Result<Site, ServerError> {
    let (token, editor) = (token()?, Arc::new(editor));
    // An error shows now, not at the first visit.
    editor.served_page(&bundle)?;
    let pages = editor.clone();
    let page = Page::Made(Box::new(move || pages.served_page(&bundle).map_err(Into::into)));
    Ok(Site {
        service: Some(Arc::new(CellService { editor, token })),
        ..Site::from_page(page)
    })
}

impl Service for CellService {
    fn knows(&self, path: &str) -> Option<QuestionLimits> {
        let asked = |is_work, most_bytes| Some(QuestionLimits { is_work, most_bytes });
        match path {
            "/cell" | "/map" | "/recover" | "/save" => asked(true, MOST_QUESTION_BYTES),
            "/disk" | "/hello" => asked(false, MOST_SHORT_BYTES),
            _ => None,
        }
    }

    fn answer(
        &self,
        path: &str,
        question: &[u8],
        tell: &mut dyn FnMut(String) -> Result<(), NoListener>,
        gone: &CancelToken,
    ) {
        self.editor.answer(path, question, &mut |line| tell(line).is_ok(), gone);
    }

    fn token(&self) -> &str {
        &self.token
    }
}
