//! Foam between a sponge's holder and a plate: pressure and energy of a column by how far it is compressed.
//!
//! With w the compression, H the free height and ε = w / H:
//!
//! | strain | pressure |
//! | --- | --- |
//! | 0 to 0.6 | E ε: the elastic foundation of [`platewash_bodies::contact`], on which the certificate rests |
//! | 0.6 to 1 | E (0.6 + 20 (ε − 0.6)): the foam bottoms out. The factor of 20 on the stiffness there is an assumption |
//! | 1 to 2 | the rest of the energy fades smoothly: the holder would be in the plate, which no real one is |
//!
//! Pressure is the derivative of the energy everywhere, so that no motion gains any.
//!
//! Load on a sponge from a plate: force, moment and energy; and the share of a column that is on the plate at its rim.

use nalgebra::Vector3;
use platewash_workcell::simulation::FoamContact;

/// Strain from which foam bottoms out; no plan that is proved goes beyond.
pub const DENSE_STRAIN: f64 = 0.6;

/// Factor by which it is stiffer there: an assumption.
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
    /// Foam of the settings, in a sponge of that free height \[m\].
    #[must_use]
    pub fn new(settings: &FoamContact, free_height_m: f64) -> Self {
        Self {
            stiffness_pa: settings.stiffness_pa,
            damping_pa_s: settings.damping_pa_s,
            free_height_m,
        }
    }

    /// Checks that a column compressed so far \[m\] acts at all.
    #[inline]
    #[must_use]
    pub fn is_pressed(&self, compression_m: f64) -> bool {
        compression_m > 0.0 && compression_m < GONE_STRAIN * self.free_height_m
    }

    /// Energy \[J/m²\] and pressure \[Pa\], its derivative, of a column compressed so far \[m\].
    #[inline]
    #[must_use]
    pub fn energy_and_pressure(&self, compression_m: f64) -> (f64, f64) {
        if !self.is_pressed(compression_m) {
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

    /// Pressure with the part that the damping adds at a speed of compression \[m/s\]: the foam never pulls.
    #[inline]
    #[must_use]
    pub fn damped(&self, compression_m: f64, pressure_pa: f64, speed_m_s: f64) -> f64 {
        if self.damping_pa_s == 0.0 || compression_m > self.free_height_m {
            return pressure_pa;
        }
        (pressure_pa + self.damping_pa_s * speed_m_s / self.free_height_m).max(0.0)
    }
}

/// Load on the foam.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FoamLoad {
    /// Force along the tool's axis, of all plates together: Σ p dA \[N\].
    pub force_n: f64,
    /// The greatest compression of a column \[m\]; 0 where nothing touches.
    pub deepest_m: f64,
}

/// Force \[N\], moment about the tip \[N·m\], and energy.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Wrench {
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
    pub load: FoamLoad,
    pub energy_j: f64,
}

/// The share of a column that is within a rim, by its distance from the axis squared, and its slope by ρ \[1/m\].
#[inline]
pub(crate) fn share_within(rho_squared: f64, rim_m: f64, half_m: f64) -> (f64, f64) {
    let within_m = rim_within(rim_m, half_m);
    if within_m > 0.0 && rho_squared <= within_m * within_m {
        return (1.0, 0.0);
    }
    falling((rho_squared.sqrt() - rim_m) / (2.0 * half_m) + 0.5, 2.0 * half_m)
}

/// Smooth fall from 1 to 0 within a width, at that share of the way past its beginning; and its slope.
#[inline]
pub(crate) fn falling(past: f64, width: f64) -> (f64, f64) {
    if past <= 0.0 {
        (1.0, 0.0)
    } else if past < 1.0 {
        (
            1.0 - past * past * (3.0 - 2.0 * past),
            -6.0 * past * (1.0 - past) / width,
        )
    } else {
        (0.0, 0.0)
    }
}

/// Columns nearer to the axis are wholly on the plate \[m\].
#[inline]
pub(crate) fn rim_within(rim_m: f64, half_width_m: f64) -> f64 {
    rim_m - half_width_m
}
