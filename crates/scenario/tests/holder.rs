//! What holds the plates: a fixture or a ring, and what is refused.

use platewash_scenario::Scenario;
use platewash_workcell::job::{FixtureTerms, HolderTerms, Requirements, RingTerms};

const WASHED: &str = "layout.region = \"appendix\"\ntool.length_m = 0.15\nwash.height_m = 0\nwash.contact = true\n";

fn requirements(lines: &str) -> Result<Requirements, String> {
    let scenario = Scenario::parse(&format!("{WASHED}{lines}"), "case").map_err(|e| e.to_string())?;
    let job = scenario.job().map_err(|e| e.to_string())?;
    Ok(job.terms().requirements)
}

#[test]
fn a_holder_is_a_fixture_or_a_ring() {
    assert_eq!(requirements("").unwrap().holder, None);
    let fixture = "[holder]\nforce_n = 25\ntorque_nm = 3\n";
    let held = HolderTerms {
        sponge_friction: 1.0,
        plate_mass_kg: None,
        fixture: Some(FixtureTerms {
            force_n: 25.0,
            torque_nm: 3.0,
        }),
        ring: None,
    };
    assert_eq!(requirements(fixture).unwrap().holder, Some(held));
    let more = requirements(&format!("{fixture}plate_mass_kg = 0.6\nsponge_friction = 0.4\n")).unwrap();
    assert_eq!(
        more.holder,
        Some(HolderTerms {
            sponge_friction: 0.4,
            plate_mass_kg: Some(0.6),
            ..held
        })
    );
    let ring = requirements("[holder]\nfriction = 0.5\nring_radius_m = 0.09\nplate_mass_kg = 0.7\n").unwrap();
    assert_eq!(
        ring.holder,
        Some(HolderTerms {
            plate_mass_kg: Some(0.7),
            fixture: None,
            ring: Some(RingTerms {
                friction: 0.5,
                radius_m: 0.09
            }),
            ..held
        })
    );
    // Nothing else changes.
    assert_eq!(Requirements { holder: None, ..ring }, requirements("").unwrap());
}

#[test]
fn a_holder_that_says_too_little_or_too_much_is_refused_by_its_key() {
    for (lines, parts) in [
        ("force_n = 25", ["holder.force_n", "both force_n and torque_nm"]),
        ("torque_nm = 3", ["holder.torque_nm", "both force_n and torque_nm"]),
        (
            "sponge_friction = 0.3",
            ["holder.sponge_friction", "what holds the plates is missing"],
        ),
        (
            "plate_mass_kg = 1",
            ["holder.plate_mass_kg", "what holds the plates is missing"],
        ),
        ("friction = 0.5", ["holder.friction", "needs ring_radius_m"]),
        (
            "friction = 0.5\nring_radius_m = 0.1",
            ["holder.friction", "plate_mass_kg"],
        ),
        (
            "force_n = 25\ntorque_nm = 3\nfriction = 0.5\nring_radius_m = 0.1\nplate_mass_kg = 1",
            ["holder.friction", "give either"],
        ),
        (
            "force_n = 25\ntorque_nm = 3\nring_radius_m = 0.1",
            ["holder.ring_radius_m", "give friction"],
        ),
        ("force_n = -1\ntorque_nm = 3", ["holder.force_n", "from 0 to"]),
        ("force_n = nan\ntorque_nm = 3", ["holder.force_n", "from 0 to"]),
        ("force_n = 1e7\ntorque_nm = 3", ["holder.force_n", "from 0 to"]),
        (
            "friction = 11\nring_radius_m = 0.1\nplate_mass_kg = 1",
            ["holder.friction", "from 0 to 10"],
        ),
        (
            "friction = 1\nring_radius_m = 0\nplate_mass_kg = 1",
            ["holder.ring_radius_m", "above 0"],
        ),
        (
            "friction = 1\nring_radius_m = 0.1\nplate_mass_kg = 0",
            ["holder.plate_mass_kg", "above 0"],
        ),
        (
            "friction = 1\nring_radius_m = 0.5\nplate_mass_kg = 1",
            ["requirements.holder.ring.radius_m", "from"],
        ),
        ("strength = 1", ["holder.strength", ""]),
    ] {
        let refused = requirements(&format!("[holder]\n{lines}\n")).unwrap_err();
        assert!(parts.iter().all(|part| refused.contains(part)), "{lines}: {refused}");
    }
    let text = format!(
        "{}[holder]\nforce_n = 25\ntorque_nm = 3\n",
        WASHED.replace("contact = true", "contact = false")
    );
    let refused = Scenario::parse(&text, "case").unwrap_err().to_string();
    assert!(
        refused.contains("case, line 6") && refused.contains("wash.contact = true"),
        "{refused}"
    );
}

/// A plate that stands on a ring has one face to wash.
#[test]
fn a_ring_under_both_faces_is_refused() {
    let washed = WASHED.replace("layout.region = \"appendix\"\n", "");
    let ring = "[holder]\nfriction = 0.5\nring_radius_m = 0.09\nplate_mass_kg = 0.7\n";
    let fixture = "[holder]\nforce_n = 25\ntorque_nm = 3\n";
    let both = "[[plate]]\nat_m = [0.4, 0, 0.3]\nrpy_deg = [0, 90, 0]\nfaces = \"both\"\n";
    // The same two faces, given one by one.
    let listed = "[[plate]]\nat_m = [0.4, 0, 0.3]\nrpy_deg = [0, 90, 0]\nthickness_m = 0.01\n\
                  [[plate]]\nat_m = [0.38, 0, 0.3]\nrpy_deg = [0, -90, 0]\nthickness_m = 0.01\n";
    let made = |plates: &str, holder: &str| {
        let scenario = Scenario::parse(&format!("{washed}{holder}{plates}"), "case").map_err(|e| e.to_string())?;
        scenario.job().map(|_| ()).map_err(|e| e.to_string())
    };
    for plates in [both, listed] {
        assert_eq!(made(plates, fixture), Ok(()), "{plates}");
    }
    let refused = made(both, ring).unwrap_err();
    assert!(
        refused.contains("plate[0].faces") && refused.contains("holder.friction"),
        "{refused}"
    );
    let refused = made(listed, ring).unwrap_err();
    assert!(refused.contains("both faces of a plate are washed"), "{refused}");
}
