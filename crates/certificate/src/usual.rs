//! What is usually required of a washing. A job that requires less is named in the first line.

use crate::amounts::number;
use platewash_workcell::job::{ContactRequirements, Requirements};

/// Share of each plate that must be swept.
const SWEPT: f64 = 0.995;

/// Least clearance \[m\].
const CLEARANCE_M: f64 = 0.01;

/// Greatest angle of the tool from the plate's normal \[deg\].
const TILT_DEG: f64 = 30.0;

/// Greatest speed of the tip while it washes \[m/s\].
const WASH_SPEED_M_S: f64 = 0.25;

/// Greatest acceleration of the tip while it washes \[m/s²\].
const WASH_ACCELERATION_M_S2: f64 = 4.0;

/// Greatest speed with which the sponge lands on a plate and lifts off, where contact is required \[m/s\].
const CONTACT_SPEED_M_S: f64 = 0.05;

/// Least angle of joint 5 from 0 at a plate, where contact is required \[deg\].
const WRIST_DEG: f64 = 3.0;

/// What the contact must keep.
const CONTACT: ContactRequirements = ContactRequirements {
    compression_m: 0.001,
    height_error_m: 0.001,
    share: 0.995,
    strain: 0.6,
    force_n: [1.0, 40.0],
    time_s: 0.05,
    time_share: 0.98,
    dose_pa_m: 25.0,
    dose_share: 0.98,
};

/// A requirement with the value that is usual.
struct Row {
    name: &'static str,
    required: f64,
    usual: f64,
    unit: &'static str,
    /// Whether a greater value requires more.
    more_is_stricter: bool,
}

impl Row {
    fn at_least(name: &'static str, required: f64, usual: f64, unit: &'static str) -> Self {
        let more_is_stricter = true;
        Self {
            name,
            required,
            usual,
            unit,
            more_is_stricter,
        }
    }

    fn at_most(name: &'static str, required: f64, usual: f64, unit: &'static str) -> Self {
        Self {
            more_is_stricter: false,
            ..Self::at_least(name, required, usual, unit)
        }
    }

    /// Whether less is required than usual. Nine digits are compared: degrees are stated, radians are stored.
    fn is_laxer(&self) -> bool {
        let slack = 1e-9 * self.usual.abs();
        if self.more_is_stricter {
            self.required < self.usual - slack
        } else {
            self.required > self.usual + slack
        }
    }

    fn words(&self) -> String {
        let side = if self.more_is_stricter { "" } else { "up to " };
        let Self { name, unit, .. } = self;
        format!(
            "{name} {side}{}{unit} (usual {}{unit})",
            number(self.required),
            number(self.usual)
        )
    }
}

/// The requirements of a job that are laxer than usual.
pub(crate) fn laxer(wanted: &Requirements) -> Vec<String> {
    let mut rows = vec![
        Row::at_least("swept", 100.0 * wanted.coverage, 100.0 * SWEPT, " %"),
        Row::at_least("clearance", 1e3 * wanted.clearance_m, 1e3 * CLEARANCE_M, " mm"),
        Row::at_most("tilt", wanted.tilt_rad.to_degrees(), TILT_DEG, "°"),
        Row::at_most("wash speed", wanted.wash_speed_m_s, WASH_SPEED_M_S, " m/s"),
        Row::at_most(
            "wash acceleration",
            wanted.wash_acceleration_m_s2,
            WASH_ACCELERATION_M_S2,
            " m/s²",
        ),
    ];
    if let Some(contact) = &wanted.contact {
        let speed = |stated: Option<f64>| stated.unwrap_or(wanted.wash_speed_m_s);
        let [least_n, most_n] = contact.force_n;
        rows.extend([
            Row::at_least("pressed", 100.0 * contact.share, 100.0 * CONTACT.share, " %"),
            Row::at_least(
                "compression",
                1e3 * contact.compression_m,
                1e3 * CONTACT.compression_m,
                " mm",
            ),
            Row::at_least(
                "error of height",
                1e3 * contact.height_error_m,
                1e3 * CONTACT.height_error_m,
                " mm",
            ),
            Row::at_least("contact time", contact.time_s, CONTACT.time_s, " s"),
            Row::at_least(
                "contact time on",
                100.0 * contact.time_share,
                100.0 * CONTACT.time_share,
                " %",
            ),
            Row::at_least("contact dose", contact.dose_pa_m, CONTACT.dose_pa_m, " Pa·m"),
            Row::at_least(
                "contact dose on",
                100.0 * contact.dose_share,
                100.0 * CONTACT.dose_share,
                " %",
            ),
            Row::at_most("strain", 100.0 * contact.strain, 100.0 * CONTACT.strain, " %"),
            Row::at_least("contact force", least_n, CONTACT.force_n[0], " N"),
            Row::at_most("contact force", most_n, CONTACT.force_n[1], " N"),
            Row::at_most("landing speed", speed(wanted.landing_m_s), CONTACT_SPEED_M_S, " m/s"),
            Row::at_most("lifting speed", speed(wanted.lifting_m_s), CONTACT_SPEED_M_S, " m/s"),
            Row::at_least(
                "joint 5 from 0",
                wanted.wrist_rad.unwrap_or(0.0).to_degrees(),
                WRIST_DEG,
                "°",
            ),
        ]);
    }
    rows.iter().filter(|row| row.is_laxer()).map(Row::words).collect()
}
