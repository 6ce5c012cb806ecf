//! Checks of the settings of a simulation.

use crate::control::ControlError;
use crate::simulate::error::SimulationError;
use platewash_workcell::simulation::{FoamContact, PlantSettings, SimulationSettings};
use platewash_workcell::tool::Tool;

/// Stiffer, or damped more, is no foam \[Pa, Pa·s\].
const STIFFEST_PA: f64 = 1e9;

/// Largest excess of a stiffness over the bounds of the sponge's range, as a part of them.
const ROUNDING: f64 = 1e-12;

/// Checks the settings that the law does not check by itself; a plan file may state any value.
pub(crate) fn check(settings: &SimulationSettings, tool: &Tool) -> Result<(), SimulationError> {
    check_period(settings)?;
    check_plant(&settings.plant)?;
    match &settings.plant.contact {
        Some(contact) if !settings.law.is_kinematic() => check_contact(&settings.plant, contact, tool),
        _ => Ok(()),
    }
}

/// Checks that the foam is within the sponge's stated range, and that no other force is set.
fn check_contact(plant: &PlantSettings, contact: &FoamContact, tool: &Tool) -> Result<(), SimulationError> {
    let refuse = |name, expected, found| Err(SimulationError::Setting { name, expected, found });
    if plant.contact_force_n > 0.0 {
        let expected = "0 where foam pushes back (contact): one of both";
        return refuse("contact_force_n", expected, plant.contact_force_n);
    }
    let FoamContact {
        stiffness_pa,
        damping_pa_s,
    } = *contact;
    if !(stiffness_pa > 0.0 && stiffness_pa <= STIFFEST_PA) {
        return refuse("contact_stiffness_pa", "above 0 and at most 1e9 Pa", stiffness_pa);
    }
    if !(0.0..=STIFFEST_PA).contains(&damping_pa_s) {
        return refuse("contact_damping_pa_s", "from 0 to 1e9 Pa·s", damping_pa_s);
    }
    let height_m = tool.sponge.free_height_m();
    if !(tool.is_present() && height_m > 0.0 && tool.sponge.radius_m > 0.0) {
        return Err(SimulationError::NoSponge);
    }
    match tool.sponge.stiffness_pa {
        // The bounds themselves are within, however they were rounded on their way from a file.
        Some([least, most])
            if !(stiffness_pa >= least * (1.0 - ROUNDING) && stiffness_pa <= most * (1.0 + ROUNDING)) =>
        {
            Err(SimulationError::Stiffness {
                range_pa: [least, most],
                found_pa: stiffness_pa,
            })
        }
        _ => Ok(()),
    }
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
