//! Plates so near to the one that is washed that the sponge, running over its rim, comes over them.
//!
//! They lie level with it, and a sponge that stands upright, or leans along them, would touch them. So near such a
//! plate the tool leans away from it, which lifts the sponge's edge on that side. Of the lean `τ ρ̂` in the arm's
//! plane and the unit vectors `n_j` from the other plates' centres to the contact point, at distances `d_j`,
//!
//! `L = Π_j (1 − w_j) τ ρ̂ + Σ_j w_j σ n_j`, `w_j = 1 − S((d_j − b_j) / w)`,
//!
//! with S the quintic smoothstep, `b_j` the plate's radius and the sponge's, and σ = [`AWAY_RAD`] or half the tilt
//! allowed. L is C², its length is the tilt and its direction that of the flange.

use super::policy::smoothstep;
use crate::layout::Plate;
use nalgebra::Vector3;

/// σ: how far the tool leans away from a neighbour at most \[rad\]: 5°.
pub const AWAY_RAD: f64 = std::f64::consts::PI / 36.0;

/// w: the width over which it comes to lean away \[m\].
const WIDTH_M: f64 = 0.06;

/// A plate to lean away from.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Neighbour {
    /// Its centre \[m\]; only x and y count.
    centre: Vector3<f64>,
    /// Distance of the tip from there at which the sponge reaches its rim \[m\].
    border_m: f64,
}

/// The plates to lean away from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Neighbours {
    plates: Vec<Neighbour>,
    /// σ \[rad\].
    away_rad: f64,
}

impl Neighbours {
    /// Of `others` those that the sponge reaches from a stroke of `radius_m` around `centre` \[m\].
    pub fn reached<'a>(
        others: impl Iterator<Item = &'a Plate>,
        centre: &Vector3<f64>,
        radius_m: f64,
        sponge_radius_m: f64,
        tilt_max_rad: f64,
    ) -> Self {
        let neighbour = |plate: &Plate| Neighbour {
            centre: Vector3::new(plate.x_m, plate.y_m, 0.0),
            border_m: plate.radius_m + sponge_radius_m,
        };
        let reached = |plate: &Neighbour| level(&(centre - plate.centre)).norm() - radius_m <= plate.border_m;
        Self {
            plates: others.map(neighbour).filter(reached).collect(),
            away_rad: AWAY_RAD.min(0.5 * tilt_max_rad),
        }
    }

    /// Without any, the lean stays in the arm's plane.
    pub fn none() -> Self {
        Self {
            plates: Vec::new(),
            away_rad: 0.0,
        }
    }

    /// Whether there is nothing to lean away from.
    pub fn is_empty(&self) -> bool {
        self.plates.is_empty()
    }

    /// L \[rad\] at a contact point, where the lean in the arm's plane would be `lean` \[rad\].
    pub fn lean(&self, contact: &Vector3<f64>, lean: Vector3<f64>) -> Vector3<f64> {
        let (mut inside, mut away) = (1.0, Vector3::zeros());
        for plate in &self.plates {
            let from = level(&(contact - plate.centre));
            let distance = from.norm();
            let near = 1.0 - smoothstep(distance, [plate.border_m, plate.border_m + WIDTH_M]);
            inside *= 1.0 - near;
            if distance > 0.0 {
                away += from * (near * self.away_rad / distance);
            }
        }
        lean * inside + away
    }
}

fn level(v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, v.y, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plates() -> [Plate; 3] {
        [[0.3, 0.29], [0.59, 0.001], [0.9, 0.0]].map(|[x_m, y_m]| Plate {
            x_m,
            y_m,
            z_m: 0.03,
            radius_m: 0.145,
            thickness_m: 0.02,
        })
    }

    proptest! {
        #[test]
        fn the_lean_is_smooth_and_no_longer_than_allowed(x in 0.15..0.45f64, y in -0.15..0.15f64, tilt in 0.0..0.5f64) {
            let plates = plates();
            let centre = Vector3::new(0.3, 0.0, 0.03);
            let near = Neighbours::reached(plates.iter(), &centre, 0.124, 0.025, tilt);
            prop_assert_eq!(near.plates.len(), 2);
            let lean = |x: f64| near.lean(&Vector3::new(x, y, 0.03), Vector3::new(tilt, 0.0, 0.0));
            prop_assert!(lean(x).norm() <= tilt + 1e-12);
            let h = 1e-5;
            let second = |x: f64| (lean(x + h) - lean(x) * 2.0 + lean(x - h)) / (h * h);
            prop_assert!((second(x + h) - second(x)).norm() < 30.0, "the second derivative jumps");
        }
    }

    #[test]
    fn over_a_neighbours_rim_the_tool_leans_away_from_it() {
        let near = Neighbours::reached(plates().iter(), &Vector3::new(0.3, 0.0, 0.03), 0.124, 0.025, 0.3);
        let lean = near.lean(&Vector3::new(0.3, 0.124, 0.03), Vector3::new(0.2, 0.0, 0.0));
        assert!((lean - Vector3::new(0.0, -AWAY_RAD, 0.0)).norm() < 1e-12);
        let far = near.lean(&Vector3::new(0.2, -0.1, 0.03), Vector3::new(0.2, 0.0, 0.0));
        assert_eq!(far, Vector3::new(0.2, 0.0, 0.0));
    }
}
