//! Zones and speeds that every controller has by name.

/// Zones: radius at the tip \[mm\].
const ZONES: [(&str, f32); 14] = [
    ("z0", 0.3),
    ("z1", 1.0),
    ("z5", 5.0),
    ("z10", 10.0),
    ("z15", 15.0),
    ("z20", 20.0),
    ("z30", 30.0),
    ("z40", 40.0),
    ("z50", 50.0),
    ("z60", 60.0),
    ("z80", 80.0),
    ("z100", 100.0),
    ("z150", 150.0),
    ("z200", 200.0),
];

/// Speeds of the tip \[mm/s\]: `v5` and so on.
const SPEEDS: [u16; 25] = [
    5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500, 2000, 2500, 3000, 4000, 5000,
    6000, 7000,
];

/// The zone with a radius at the tip \[m\], if there is one by name.
pub(super) fn zone_named(radius_m: f64) -> Option<&'static str> {
    let is_it = |mm: f32| (f64::from(mm) - radius_m * 1e3).abs() < 1e-6;
    ZONES.iter().find(|(_, mm)| is_it(*mm)).map(|(name, _)| *name)
}

/// The radius of a zone \[mm\], by its name in small letters.
pub(super) fn zone_mm(name: &str) -> Option<f32> {
    ZONES.iter().find(|(zone, _)| *zone == name).map(|(_, mm)| *mm)
}

/// Whether a name, in small letters, is that of a speed.
pub(super) fn is_speed(name: &str) -> bool {
    let number = name.strip_prefix('v').and_then(|number| number.parse().ok());
    name == "vmax" || number.is_some_and(|number| SPEEDS.contains(&number) && name == format!("v{number}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zones_and_speeds_by_name() {
        let zones = [0.005, 0.000_3, 0.004, f64::NAN].map(zone_named);
        assert_eq!(zones, [Some("z5"), Some("z0"), None, None]);
        assert_eq!((zone_mm("z5"), zone_mm("z3")), (Some(5.0), None));
        let speeds = ["v100", "vmax", "v7000", "v05", "v7", "v"].map(is_speed);
        assert_eq!(speeds, [true, true, true, false, false, false]);
    }
}
