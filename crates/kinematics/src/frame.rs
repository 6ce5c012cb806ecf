//! Frames fixed to the arm's bodies.

use crate::rotation::Rigid;

/// A frame fixed to one of the arm's bodies: body 0 is the base, body i is what joint i moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    pub(crate) body: usize,
    /// `T_body_frame`, from the folded joint frame of the body.
    pub(crate) offset: Rigid,
}

impl Frame {
    pub(crate) fn new(body: usize, offset: Rigid) -> Self {
        Self { body, offset }
    }

    /// The base frame.
    #[must_use]
    pub fn base() -> Self {
        Self::new(0, Rigid::identity())
    }

    /// The body that carries the frame: 0 for the base, 1–6 for what joint 1–6 moves.
    #[must_use]
    pub fn body(&self) -> usize {
        self.body
    }

    /// `T_body_frame`: where it is on the folded joint frame of its body.
    #[must_use]
    pub fn on_body(&self) -> &Rigid {
        &self.offset
    }

    /// A frame fixed to this one, at `T_this_new`.
    #[must_use]
    pub fn offset(&self, relative: &Rigid) -> Self {
        Self::new(self.body, self.offset.then(relative))
    }
}
