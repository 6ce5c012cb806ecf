//! The plant of a simulation: its section, and the foam that is on by default.

use platewash_kinematics::JointFriction;
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
    let (section, no_friction) = (PlantSection::default(), JointFriction::default());
    let known = sponge(Some([11e3, 44e3]));
    let contact = section.settings(Some(&known), &no_friction).contact.unwrap();
    assert!((contact.stiffness_pa - 22e3).abs() < 1e-6 && contact.damping_pa_s == 0.0);
    assert_eq!(section.settings(Some(&sponge(None)), &no_friction).contact, None);
    assert_eq!(section.settings(None, &no_friction), PlantSettings::default());
    let damped = PlantSection {
        contact_damping_pa_s: Some(50.0),
        ..section.clone()
    };
    assert_eq!(
        damped
            .settings(Some(&known), &no_friction)
            .contact
            .unwrap()
            .damping_pa_s,
        50.0
    );
    let constant = PlantSection {
        contact_force_n: Some(0.0),
        ..section
    };
    assert_eq!(
        constant.settings(Some(&known), &no_friction).contact,
        None,
        "the way to turn it off"
    );
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
        assert_eq!(
            PlantSection::from(&plant).settings(None, &JointFriction::default()),
            plant
        );
    }
}

#[test]
fn the_friction_of_a_description_counts_where_the_section_states_none() {
    let described = JointFriction {
        viscous: [40.0; 6],
        coulomb: [15.0; 6],
    };
    let stated = PlantSection {
        viscous_friction_n_m_s: Some([40.0; 6]),
        coulomb_friction_n_m: Some([15.0; 6]),
        ..PlantSection::default()
    };
    let alike = stated.settings(None, &JointFriction::default());
    assert_eq!(PlantSection::default().settings(None, &described), alike);
    let free = PlantSection {
        viscous_friction_n_m_s: Some([0.0; 6]),
        ..PlantSection::default()
    };
    let found = free.settings(None, &described);
    assert_eq!(
        (found.viscous_friction_n_m_s, found.coulomb_friction_n_m),
        ([0.0; 6], [15.0; 6])
    );
}
