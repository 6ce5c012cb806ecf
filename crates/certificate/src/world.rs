//! Places that are told in the world: what is proved is proved in the frame of the arm's base.

use crate::check::Check;
use crate::clearances::PairBound;
use crate::plate_contact::PlateContact;
use nalgebra::Point3;
use platewash_kinematics::Pose;

/// The world, by the arm's mount in it; `None` where it is the base's own frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct World(Option<Pose>);

impl World {
    /// The world in which an arm is mounted at `T_world_base`.
    pub fn of(mount: &Pose) -> Self {
        Self((*mount != Pose::identity()).then_some(*mount))
    }

    /// The worst places of checks.
    pub fn tell_checks(&self, checks: &mut [Check]) {
        for check in checks {
            self.tell(check.worst.place_m.as_mut());
        }
    }

    /// Where pairs come nearest.
    pub fn tell_pairs(&self, pairs: &mut [PairBound]) {
        for pair in pairs {
            self.tell(pair.place_m.as_mut());
        }
    }

    /// Where plates are pressed most and least.
    pub fn tell_contact(&self, plates: &mut [PlateContact]) {
        for plate in plates {
            for place in plate.places_mut() {
                self.tell(Some(place));
            }
        }
    }

    /// Takes a place from the base frame to the world \[m\].
    fn tell(&self, place: Option<&mut [f64; 3]>) {
        if let (Some(mount), Some(place)) = (&self.0, place) {
            *place = (mount * Point3::from(*place)).into();
        }
    }
}
