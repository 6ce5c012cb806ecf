//! The `[holder]` section: what holds the plates while they are washed.

use crate::error::{Problem, conflict};
use platewash_keys::Section;
use platewash_workcell::job::{FixtureTerms, HolderTerms, RingTerms};
use serde::{Deserialize, Serialize};

/// Greatest friction coefficient of the sponge on a plate where none is stated.
const SPONGE_FRICTION: f64 = 1.0;

/// `[holder]`: either a fixture of stated strength, or a ring on which a plate stands by friction alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("holder")]
#[serde(default, deny_unknown_fields)]
pub struct HolderSection {
    /// Greatest friction coefficient of the sponge on a plate: an assumption. Without it, 1.
    #[key(domain = Number(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sponge_friction: Option<f64>,
    /// Force that what holds a plate takes, in any direction across the plate's axis; together with torque_nm. It needs wash.contact = true, as
    /// all keys of the section do: that the plate stays is then proved.
    #[key(unit = "N", domain = Number(0.0, 1e6))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Torque about the plate's axis that it takes at the same time.
    #[key(unit = "N·m", domain = Number(0.0, 1e6))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_nm: Option<f64>,
    /// Least friction coefficient of a plate on what it stands on, where nothing else holds it; together with ring_radius_m and plate_mass_kg.
    #[key(domain = Number(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Radius of the ring about its axis on which a plate stands: at most that of its foot, or of its rim.
    #[key(unit = "m", domain = NumberAbove(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ring_radius_m: Option<f64>,
    /// Mass of each plate. With force_n, the share of its weight across the axis of an inclined plate adds to the force.
    #[key(unit = "kg", domain = NumberAbove(0.0, 1000.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_mass_kg: Option<f64>,
}

impl HolderSection {
    /// Refuses keys that contradict each other or lack another one. `has_contact` says whether contact is required.
    pub(crate) fn check(&self, has_contact: bool) -> Result<(), Problem> {
        let Self { force_n, friction, .. } = self;
        let stated = [
            ("force_n", self.force_n),
            ("torque_nm", self.torque_nm),
            ("friction", self.friction),
            ("ring_radius_m", self.ring_radius_m),
            ("plate_mass_kg", self.plate_mass_kg),
            ("sponge_friction", self.sponge_friction),
        ];
        let Some((key, _)) = stated.into_iter().find(|(_, stated)| stated.is_some()) else {
            return Ok(());
        };
        let refuse = |key: &str, detail: &str| conflict(format!("holder.{key}"), detail);
        if !has_contact {
            return refuse(
                key,
                "that plates stay follows from the force on them: it needs wash.contact = true",
            );
        }
        if force_n.is_some() != self.torque_nm.is_some() {
            return refuse(key, "give both force_n and torque_nm, or neither");
        }
        let of_ring = [self.ring_radius_m, self.plate_mass_kg].map(|stated| stated.is_some());
        match (force_n, friction) {
            (Some(_), Some(_)) => refuse(
                "friction",
                "a plate is held by force_n and torque_nm or by its friction alone: give either",
            ),
            (None, None) => refuse(
                key,
                "what holds the plates is missing: give force_n and torque_nm, or friction",
            ),
            (Some(_), None) if of_ring[0] => {
                refuse("ring_radius_m", "is for plates held by friction alone: give friction")
            }
            (None, Some(_)) if of_ring != [true; 2] => refuse(
                "friction",
                "needs ring_radius_m, on which a plate stands, and plate_mass_kg, which presses it down",
            ),
            _ => Ok(()),
        }
    }

    /// Terms of the holder; `None` where the section states none.
    pub(crate) fn terms(&self) -> Option<HolderTerms> {
        let fixture = self.force_n.zip(self.torque_nm);
        let ring = self.friction.zip(self.ring_radius_m);
        (fixture.is_some() || ring.is_some()).then(|| HolderTerms {
            sponge_friction: self.sponge_friction.unwrap_or(SPONGE_FRICTION),
            plate_mass_kg: self.plate_mass_kg,
            fixture: fixture.map(|(force_n, torque_nm)| FixtureTerms { force_n, torque_nm }),
            ring: ring.map(|(friction, radius_m)| RingTerms { friction, radius_m }),
        })
    }
}
