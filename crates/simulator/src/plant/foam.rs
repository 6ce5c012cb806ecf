//! Foam between a sponge's holder and a plate: pressure and energy of a column by how far it is compressed.
//!
//! With w the compression, H the free height and ε = w / H:
//!
//! | strain | pressure |
//! | --- | --- |
//! | 0 to 0.6 | E ε: the elastic foundation of [`platewash_workcell::contact`], on which the certificate rests |
//! | 0.6 to 1 | E (0.6 + 20 (ε − 0.6)): the foam bottoms out. That it is 20 times as stiff there is an assumption |
//! | 1 to 2 | what is left of the energy is let go of smoothly: the holder would be in the plate, which nothing real is |
//!
//! Pressure is the derivative of the energy everywhere, so that no motion gains any.

use platewash_workcell::simulation::FoamContact;

/// Strain from which foam bottoms out; no plan that is proved goes beyond.
pub const DENSE_STRAIN: f64 = 0.6;

/// How many times as stiff it is there: an assumption.
pub const DENSE_FACTOR: f64 = 20.0;

/// Strain from which there is no foam any more.
const GONE_STRAIN: f64 = 2.0;

/// The foam of a sponge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foam {
    /// E \[Pa\].
    pub stiffness_pa: f64,
    /// η \[Pa·s\].
    pub damping_pa_s: f64,
    /// H \[m\].
    pub free_height_m: f64,
}

impl Foam {
    /// That of settings, in a sponge of that free height \[m\].
    #[must_use]
    pub fn new(settings: &FoamContact, free_height_m: f64) -> Self {
        Self {
            stiffness_pa: settings.stiffness_pa,
            damping_pa_s: settings.damping_pa_s,
            free_height_m,
        }
    }

    /// Whether a column compressed so far \[m\] acts at all.
    #[inline]
    #[must_use]
    pub fn acts(&self, compression_m: f64) -> bool {
        compression_m > 0.0 && compression_m < GONE_STRAIN * self.free_height_m
    }

    /// Energy \[J/m²\] and pressure \[Pa\], its derivative, of a column compressed so far \[m\].
    #[inline]
    #[must_use]
    pub fn of(&self, compression_m: f64) -> (f64, f64) {
        if !self.acts(compression_m) {
            return (0.0, 0.0);
        }
        let strain = compression_m / self.free_height_m;
        let beyond = (strain - DENSE_STRAIN).max(0.0);
        let stiffer = (DENSE_FACTOR - 1.0) * beyond;
        let energy = 0.5 * (strain * strain + stiffer * beyond);
        let pressure = strain + stiffer;
        let (energy, pressure) = if strain > 1.0 {
            let past = (strain - 1.0) / (GONE_STRAIN - 1.0);
            let left = 1.0 - past * past * (3.0 - 2.0 * past);
            let falling = -6.0 * past * (1.0 - past) / (GONE_STRAIN - 1.0);
            (energy * left, pressure * left + energy * falling)
        } else {
            (energy, pressure)
        };
        (
            self.stiffness_pa * self.free_height_m * energy,
            self.stiffness_pa * pressure,
        )
    }

    /// Pressure with what the damping adds at a speed of compression \[m/s\]: the foam never pulls.
    #[inline]
    #[must_use]
    pub fn damped(&self, compression_m: f64, pressure_pa: f64, speed_m_s: f64) -> f64 {
        if self.damping_pa_s == 0.0 || compression_m > self.free_height_m {
            return pressure_pa;
        }
        (pressure_pa + self.damping_pa_s * speed_m_s / self.free_height_m).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FOAM: Foam = Foam {
        stiffness_pa: 2e4,
        damping_pa_s: 100.0,
        free_height_m: 0.025,
    };

    #[test]
    fn within_the_limit_it_is_the_foundation() {
        for w in [1e-6, 0.005, 0.0149] {
            let (energy, pressure) = FOAM.of(w);
            assert!((pressure - 2e4 * w / 0.025).abs() < 1e-9);
            assert!((energy - 0.5 * 2e4 / 0.025 * w * w).abs() < 1e-12);
        }
        assert_eq!(FOAM.of(0.0), (0.0, 0.0));
        assert_eq!(FOAM.of(0.05), (0.0, 0.0));
        assert_eq!(FOAM.of(f64::NAN), (0.0, 0.0));
        assert_eq!(FOAM.of(f64::INFINITY), (0.0, 0.0));
        assert_eq!(FOAM.damped(0.005, 10.0, -1.0), 0.0, "it does not pull");
        assert!((FOAM.damped(0.005, 10.0, 0.1) - 410.0).abs() < 1e-9);
    }

    proptest! {
        #[test]
        fn pressure_is_the_slope_of_the_energy(w in -0.01..0.06_f64) {
            let h = 1e-7;
            let slope = (FOAM.of(w + h).0 - FOAM.of(w - h).0) / (2.0 * h);
            prop_assert!((FOAM.of(w).1 - slope).abs() < 2.0, "{} {}", FOAM.of(w).1, slope);
        }
    }
}
