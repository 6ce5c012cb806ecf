//! Requirements of a plate: those of the job, where its soil asks for no others.

use crate::job::requirements::ContactRequirements;
use crate::job::soil::Soil;
use crate::job::terms::JobTerms;
use crate::plate::Plate;

impl JobTerms {
    /// Soil of a plate, if one is stated.
    #[must_use]
    pub fn soil_of(&self, plate: &Plate) -> Option<&Soil> {
        self.soils.get(plate.terms.soil?)
    }

    /// Contact requirements of a plate: see [`ContactRequirements::of_plate`]; `None` without any.
    #[must_use]
    pub fn contact_of(&self, plate: &Plate) -> Option<ContactRequirements> {
        Some(self.requirements.contact?.of_plate(plate, &self.soils))
    }

    /// Height by which a plate may lie higher or lower than stated, for its contact \[m\]: its deviation alone where contact is not required.
    #[must_use]
    pub fn height_error_of(&self, plate: &Plate) -> f64 {
        let contact = self.contact_of(plate);
        contact.map_or(plate.deviation_m(), |contact| contact.height_error_m)
    }

    /// Greatest speed of the tip while it washes a plate \[m/s\]: that of the job, or that of the plate's soil if it is less.
    #[must_use]
    pub fn wash_speed_of(&self, plate: &Plate) -> f64 {
        let soil = self.soil_of(plate).and_then(|soil| soil.speed_m_s);
        soil.map_or(self.wash_speed_m_s(), |speed| speed.min(self.wash_speed_m_s()))
    }

    /// Least number of times that the path on a plate goes round every ring.
    #[must_use]
    pub fn passes_of(&self, plate: &Plate) -> u32 {
        self.soil_of(plate).and_then(|soil| soil.passes).unwrap_or(1)
    }
}
