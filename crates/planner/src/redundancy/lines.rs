//! The lines over the ends of a wash path: on them the wrist is held as on the path, and bodies keep off each other.

use crate::placed_arm::{Contact, Hindrance, Start, Stretch};
use crate::redundancy::task::{Stop, Task};
use platewash_kinematics::JointVector;
use std::sync::atomic::Ordering;

/// Number of places on a line that are checked.
const PLACES: u32 = 8;

impl Task<'_> {
    /// Refuses a wash of which the line over an end cannot be followed ([`Task::check_line`]).
    pub(crate) fn check_lines(&self, tilts: &[f64], all: &[JointVector], start: &Start) -> Result<(), Stop> {
        let Some(last) = all.len().checked_sub(1) else {
            return Ok(());
        };
        for sample in [0, last] {
            let (contact, from) = (&self.samples.contact[sample], self.started(all[sample], start));
            self.check_line(contact, tilts[sample], from)
                .map_err(|hindrance| Stop { sample, hindrance })?;
        }
        Ok(())
    }

    /// Checks that the arm can follow the line over a contact point at which a wash begins or ends.
    pub(crate) fn has_line(&self, contact: &Contact, tilt: f64, q: &JointVector, start: &Start) -> bool {
        self.check_line(contact, tilt, self.started(*q, start)).is_ok()
    }

    fn started(&self, q: JointVector, start: &Start) -> Start {
        Start { q, ..*start }
    }

    /// Refuses a line on which the wrist comes too near to 0, or to its other side, or bodies come too near each other, with the
    /// tool turned as at its foot. A line that the arm cannot follow at all is left to the caller that plans it.
    fn check_line(&self, contact: &Contact, tilt: f64, mut from: Start) -> Result<(), Hindrance> {
        self.check_apart(&from.q, self.stretch())?;
        for k in 1..=PLACES {
            let height_m = self.path.lift_m * f64::from(k) / f64::from(PLACES);
            let target = self.placed.tip_rigid(&contact.raised(height_m), tilt);
            let Ok(q) = self.placed.inverse.continuing(&target, &from) else {
                break;
            };
            self.check_wrist(&q)?;
            self.check_side(&from.q, &q)?;
            let stretch = if k < PLACES { self.stretch() } else { Stretch::Free };
            self.check_apart(&q, stretch)?;
            from.q = q;
        }
        Ok(())
    }

    /// Refuses bodies too near to each other, where that counts.
    fn check_apart(&self, q: &JointVector, stretch: Stretch) -> Result<(), Hindrance> {
        let Some(is_blocked) = &self.blocked_line else {
            return Ok(());
        };
        let clear = self.check_clear_in(q, stretch);
        clear.inspect_err(|_| is_blocked.store(true, Ordering::Relaxed))
    }
}
