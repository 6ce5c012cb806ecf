//! Frames fixed to the arm's bodies.

use crate::rotation::Rigid;
use crate::trig::atan2;
use nalgebra::{Matrix3, Vector3};

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

    /// Angle between its z axis and the axis of the joint that moves its body \[rad\].
    #[must_use]
    pub fn tilt_rad(&self) -> f64 {
        let z = self.offset.rotation.column(2);
        atan2(z.xy().norm(), z.z)
    }

    /// A frame that is nowhere: its coordinates are NaN, so that nothing can be proved of it.
    #[must_use]
    pub fn nowhere() -> Self {
        let rotation = Matrix3::repeat(f64::NAN);
        let translation = Vector3::repeat(f64::NAN);
        Self::new(0, Rigid { rotation, translation })
    }

    /// A frame fixed to this one, at `T_this_new`.
    #[must_use]
    pub fn offset(&self, relative: &Rigid) -> Self {
        Self::new(self.body, self.offset.then(relative))
    }
}
