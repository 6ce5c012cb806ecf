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

#[cfg(test)]
mod tests {
    use crate::scenario::Scenario;
    use platewash_workcell::job::{FixtureTerms, HolderTerms, Requirements, RingTerms};

    const WASHED: &str = "layout.region = \"appendix\"\ntool.length_m = 0.15\nwash.height_m = 0\nwash.contact = true\n";

    fn requirements(lines: &str) -> Result<Requirements, String> {
        let scenario = Scenario::parse(&format!("{WASHED}{lines}"), "case").map_err(|e| e.to_string())?;
        let job = scenario.job().map_err(|e| e.to_string())?;
        Ok(job.terms().requirements)
    }

    #[test]
    fn a_holder_is_a_fixture_or_a_ring() {
        assert_eq!(requirements("").unwrap().holder, None);
        let fixture = "[holder]\nforce_n = 25\ntorque_nm = 3\n";
        let held = HolderTerms {
            sponge_friction: 1.0,
            plate_mass_kg: None,
            fixture: Some(FixtureTerms {
                force_n: 25.0,
                torque_nm: 3.0,
            }),
            ring: None,
        };
        assert_eq!(requirements(fixture).unwrap().holder, Some(held));
        let more = requirements(&format!("{fixture}plate_mass_kg = 0.6\nsponge_friction = 0.4\n")).unwrap();
        assert_eq!(
            more.holder,
            Some(HolderTerms {
                sponge_friction: 0.4,
                plate_mass_kg: Some(0.6),
                ..held
            })
        );
        let ring = requirements("[holder]\nfriction = 0.5\nring_radius_m = 0.09\nplate_mass_kg = 0.7\n").unwrap();
        assert_eq!(
            ring.holder,
            Some(HolderTerms {
                plate_mass_kg: Some(0.7),
                fixture: None,
                ring: Some(RingTerms {
                    friction: 0.5,
                    radius_m: 0.09
                }),
                ..held
            })
        );
        // Nothing else changes.
        assert_eq!(Requirements { holder: None, ..ring }, requirements("").unwrap());
    }

    #[test]
    fn a_holder_that_says_too_little_or_too_much_is_refused_by_its_key() {
        for (lines, parts) in [
            ("force_n = 25", ["holder.force_n", "both force_n and torque_nm"]),
            ("torque_nm = 3", ["holder.torque_nm", "both force_n and torque_nm"]),
            (
                "sponge_friction = 0.3",
                ["holder.sponge_friction", "what holds the plates is missing"],
            ),
            (
                "plate_mass_kg = 1",
                ["holder.plate_mass_kg", "what holds the plates is missing"],
            ),
            ("friction = 0.5", ["holder.friction", "needs ring_radius_m"]),
            (
                "friction = 0.5\nring_radius_m = 0.1",
                ["holder.friction", "plate_mass_kg"],
            ),
            (
                "force_n = 25\ntorque_nm = 3\nfriction = 0.5\nring_radius_m = 0.1\nplate_mass_kg = 1",
                ["holder.friction", "give either"],
            ),
            (
                "force_n = 25\ntorque_nm = 3\nring_radius_m = 0.1",
                ["holder.ring_radius_m", "give friction"],
            ),
            ("force_n = -1\ntorque_nm = 3", ["holder.force_n", "from 0 to"]),
            ("force_n = nan\ntorque_nm = 3", ["holder.force_n", "from 0 to"]),
            ("force_n = 1e7\ntorque_nm = 3", ["holder.force_n", "from 0 to"]),
            (
                "friction = 11\nring_radius_m = 0.1\nplate_mass_kg = 1",
                ["holder.friction", "from 0 to 10"],
            ),
            (
                "friction = 1\nring_radius_m = 0\nplate_mass_kg = 1",
                ["holder.ring_radius_m", "above 0"],
            ),
            (
                "friction = 1\nring_radius_m = 0.1\nplate_mass_kg = 0",
                ["holder.plate_mass_kg", "above 0"],
            ),
            (
                "friction = 1\nring_radius_m = 0.5\nplate_mass_kg = 1",
                ["requirements.holder.ring.radius_m", "from"],
            ),
            ("strength = 1", ["holder.strength", ""]),
        ] {
            let refused = requirements(&format!("[holder]\n{lines}\n")).unwrap_err();
            assert!(parts.iter().all(|part| refused.contains(part)), "{lines}: {refused}");
        }
        let text = format!(
            "{}[holder]\nforce_n = 25\ntorque_nm = 3\n",
            WASHED.replace("contact = true", "contact = false")
        );
        let refused = Scenario::parse(&text, "case").unwrap_err().to_string();
        assert!(
            refused.contains("case, line 6") && refused.contains("wash.contact = true"),
            "{refused}"
        );
    }
}
