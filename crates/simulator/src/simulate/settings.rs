//! Whether settings make sense.

use super::error::SimulationError;
use crate::control::ControlError;
use platewash_workcell::simulation::{PlantSettings, SimulationSettings};

/// Checks what the law does not check by itself; a plan file may state anything.
pub(super) fn check(settings: &SimulationSettings) -> Result<(), SimulationError> {
    check_period(settings)?;
    check_plant(&settings.plant)
}

fn check_period(settings: &SimulationSettings) -> Result<(), ControlError> {
    let period = settings.period_s();
    if period.is_finite() && period > 0.0 {
        return Ok(());
    }
    let (name, found) = if settings.law.is_kinematic() {
        ("dt_s", settings.control.dt_s)
    } else {
        ("rate_hz", settings.control.rate_hz)
    };
    let expected = "finite and above 0";
    Err(ControlError::Setting { name, expected, found })
}

fn check_plant(plant: &PlantSettings) -> Result<(), SimulationError> {
    let refuse = |name, expected, found| Err(SimulationError::Setting { name, expected, found });
    if !(1..=1000).contains(&plant.substeps) {
        return refuse("substeps", "from 1 to 1000", plant.substeps as f64);
    }
    let friction = [
        ("viscous_friction_n_m_s", plant.viscous_friction_n_m_s),
        ("coulomb_friction_n_m", plant.coulomb_friction_n_m),
        ("contact_force_n", [plant.contact_force_n; 6]),
    ];
    for (name, values) in friction {
        if let Some(found) = values.into_iter().find(|v| !(v.is_finite() && *v >= 0.0)) {
            return refuse(name, "finite and not negative", found);
        }
    }
    let limits = plant.torque_limit_n_m.into_iter().flatten();
    if let Some(found) = limits.into_iter().find(|v| !(v.is_finite() && *v > 0.0)) {
        return refuse("torque_limit_n_m", "finite and above 0", found);
    }
    Ok(())
}
