//! The plant of a simulation: its section, and the foam that is on by default.

use platewash_scenario::PlantSection;
use platewash_workcell::simulation::{FoamContact, PlantSettings};
use platewash_workcell::tool::{Sponge, StraightTool, Tool};

fn sponge(stiffness: Option<[f64; 2]>) -> Sponge {
    let straight = StraightTool {
        length_m: 0.15,
        sponge_stiffness_pa: stiffness,
        ..StraightTool::default()
    };
    Tool::from(straight).sponge
}

#[test]
fn the_foam_is_on_by_default_where_its_stiffness_is_known() {
    let section = PlantSection::default();
    let known = sponge(Some([11e3, 44e3]));
    let contact = section.settings(Some(&known)).contact.unwrap();
    assert!((contact.stiffness_pa - 22e3).abs() < 1e-6 && contact.damping_pa_s == 0.0);
    assert_eq!(section.settings(Some(&sponge(None))).contact, None);
    assert_eq!(section.settings(None), PlantSettings::default());
    let damped = PlantSection {
        contact_damping_pa_s: Some(50.0),
        ..section.clone()
    };
    assert_eq!(damped.settings(Some(&known)).contact.unwrap().damping_pa_s, 50.0);
    let constant = PlantSection {
        contact_force_n: Some(0.0),
        ..section
    };
    assert_eq!(constant.settings(Some(&known)).contact, None, "the way to turn it off");
}

#[test]
fn a_plant_survives_writing_and_reading_its_section() {
    for contact in [
        None,
        Some(FoamContact {
            stiffness_pa: 12_345.678,
            damping_pa_s: 3.0,
        }),
    ] {
        let plant = PlantSettings {
            contact,
            ..PlantSettings::default()
        };
        assert_eq!(PlantSection::from(&plant).settings(None), plant);
    }
}
