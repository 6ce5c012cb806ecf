//! What a sponge feels of a plate: force, moment and energy; and how much of a column is on the plate at its rim.

use nalgebra::Vector3;

/// What the foam feels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Felt {
    /// Force along the tool's axis, of all plates together: Σ p dA \[N\].
    pub force_n: f64,
    /// The greatest compression of a column \[m\]; 0 where nothing touches.
    pub deepest_m: f64,
}

/// Force \[N\], moment about the tip \[N·m\], and energy.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Wrench {
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
    pub felt: Felt,
    pub energy_j: f64,
}

/// The share of a column that is within a rim, by its distance from the axis squared, and its slope by ρ \[1/m\].
#[inline]
pub(super) fn share_within(rho_squared: f64, rim_m: f64, half_m: f64) -> (f64, f64) {
    let within_m = rim_within(rim_m, half_m);
    if within_m > 0.0 && rho_squared <= within_m * within_m {
        return (1.0, 0.0);
    }
    let past = (rho_squared.sqrt() - rim_m) / (2.0 * half_m) + 0.5;
    if past <= 0.0 {
        (1.0, 0.0)
    } else if past < 1.0 {
        (
            1.0 - past * past * (3.0 - 2.0 * past),
            -3.0 * past * (1.0 - past) / half_m,
        )
    } else {
        (0.0, 0.0)
    }
}

/// Columns nearer to the axis are wholly on the plate \[m\].
#[inline]
pub(super) fn rim_within(rim_m: f64, half_width_m: f64) -> f64 {
    rim_m - half_width_m
}
