//! Kinds of soil: the washing that each needs.

use crate::job::error::TermsError;
use crate::job::ranges::within;
use crate::job::requirements::ContactRequirements;
use crate::plate::Plate;
use crate::wash_path::MOST_LAPS;
use crate::words::printable;
use platewash_kinematics::words::rounded;
use serde::{Deserialize, Serialize};

/// Significant digits of numbers in words.
const DIGITS: usize = 4;

/// Kind of soil: the washing that it needs. What it leaves out is as for the other plates of the job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Soil {
    /// Name.
    pub name: String,
    /// Source of the figures, or "assumed".
    pub source: String,
    /// Least dose ∫ p dl that removes it \[Pa·m\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dose_pa_m: Option<f64>,
    /// Least number of times that the path goes round every ring.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub passes: Option<u32>,
    /// Greatest speed of the tip while it washes \[m/s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_m_s: Option<f64>,
    /// Least and greatest force along the sponge's axis \[N\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_n: Option<[f64; 2]>,
}

impl Soil {
    /// Checks that what the soil asks for makes sense.
    ///
    /// # Errors
    /// [`TermsError::Number`]
    pub fn validate(&self) -> Result<(), TermsError> {
        if let Some(dose) = self.dose_pa_m {
            within("soils.dose_pa_m", dose, [0.0, 1e9])?;
        }
        if let Some(passes) = self.passes {
            within("soils.passes", f64::from(passes), [1.0, f64::from(MOST_LAPS)])?;
        }
        if let Some(speed) = self.speed_m_s {
            within("soils.speed_m_s", speed, [1e-6, 10.0])?;
        }
        match self.force_n {
            Some([least, most]) if !(least >= 0.0 && least < most && most <= 1e6) => Err(TermsError::Number {
                name: "soils.force_n",
                expected: "[least, greatest] with least < greatest, from 0 to 1e6 N".to_owned(),
                found: least,
            }),
            _ => Ok(()),
        }
    }

    /// Describes the soil with all that it asks for: `soil tea (assumed): dose 80 Pa·m`.
    #[must_use]
    pub fn words(&self) -> String {
        let number = |value: f64| rounded(value, DIGITS).to_string();
        let parts = [
            self.dose_pa_m.map(|dose| format!("dose {} Pa·m", number(dose))),
            self.passes
                .map(|passes| format!("{passes} {}", if passes == 1 { "pass" } else { "passes" })),
            self.speed_m_s.map(|speed| format!("at most {} m/s", number(speed))),
            self.force_n
                .map(|[least, most]| format!("{} to {} N", number(least), number(most))),
        ];
        let asked: Vec<_> = parts.into_iter().flatten().collect();
        let asked = if asked.is_empty() {
            "as the job"
        } else {
            &asked.join(", ")
        };
        format!("soil {} ({}): {asked}", printable(&self.name), printable(&self.source))
    }
}

impl ContactRequirements {
    /// Requirements of a plate: its own height error with its deviation, and what its soil asks for.
    #[must_use]
    pub fn of_plate(&self, plate: &Plate, soils: &[Soil]) -> Self {
        let soil = plate.terms.soil.and_then(|soil| soils.get(soil));
        Self {
            height_error_m: plate.terms.height_error_m.unwrap_or(self.height_error_m) + plate.deviation_m(),
            dose_pa_m: soil.and_then(|soil| soil.dose_pa_m).unwrap_or(self.dose_pa_m),
            force_n: soil.and_then(|soil| soil.force_n).unwrap_or(self.force_n),
            ..*self
        }
    }
}

impl Plate {
    /// Describes the terms of the plate that differ from those of the job; `None` where none do.
    #[must_use]
    pub fn terms_words(&self, soils: &[Soil]) -> Option<String> {
        let mm = |length_m: f64| rounded(1e3 * length_m, DIGITS);
        let terms = &self.terms;
        let parts = [
            terms
                .height_error_m
                .map(|error| format!("height error {} mm", mm(error))),
            terms
                .deviation_m
                .map(|deviation| format!("measured, off its shape by up to {} mm", mm(deviation))),
            terms.soil.and_then(|soil| soils.get(soil)).map(Soil::words),
        ];
        let told: Vec<_> = parts.into_iter().flatten().collect();
        (!told.is_empty()).then(|| told.join("; "))
    }
}
