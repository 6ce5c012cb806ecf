//! The tool: its bodies, its sponge and its tip, alone and together.

use crate::mutation::edit::{Edits, ExpectedResult, Kind};
use crate::mutation::edits::asked::narrow;
use crate::mutation::edits::exclusions::restate;
use nalgebra::{UnitQuaternion, Vector3};
use platewash::certificate::Requirement::{
    Clearance, ContactHeight, ContactSpeed, Exclusions, LineDeviation, PathDeviation, Reach, Swept, Tilt, Tool,
};
use platewash::kinematics::geometry::Shape;
use platewash::workcell::tool::{self, StraightTool, ToolBody};
use platewash::{Plan, Pose};

pub fn add(edits: &mut Edits) {
    straight(edits);
    tip(edits);
    bodies(edits);
}

/// Another straight tool, with all that follows.
fn straight(edits: &mut Edits) {
    type Change = fn(&mut StraightTool);
    let off = vec![ContactHeight, PathDeviation];
    let far = vec![ContactHeight, PathDeviation, LineDeviation];
    let cases: [(&str, ExpectedResult, Change); 15] = [
        ("a hair longer", ExpectedResult::Sampled, |t| t.length_m += 1e-5),
        ("a little longer", ExpectedResult::Sampled, |t| t.length_m += 1.5e-4),
        ("longer", ExpectedResult::Fails(off), |t| t.length_m += 5e-4),
        ("much shorter", ExpectedResult::Fails(far), |t| t.length_m -= 0.02),
        ("thinner", ExpectedResult::Harmless, |t| t.radius_m -= 5e-3),
        ("a little thicker", ExpectedResult::Harmless, |t| t.radius_m += 4e-3),
        ("thicker", ExpectedResult::Fails(vec![Clearance]), |t| {
            t.radius_m += 0.06
        }),
        ("as thick as the sponge is high", ExpectedResult::Sampled, |t| {
            t.radius_m = t.sponge_height_m
        }),
        ("a bigger sponge", ExpectedResult::Sampled, |t| {
            t.sponge_radius_m += 2e-3
        }),
        (
            "a sponge like a plate",
            ExpectedResult::Fails(vec![Clearance, Tilt]),
            |t| t.sponge_radius_m = 0.12,
        ),
        ("a small sponge", ExpectedResult::Fails(vec![Swept]), |t| {
            t.sponge_radius_m = 0.012
        }),
        ("a flat sponge", ExpectedResult::Fails(vec![Clearance]), |t| {
            t.sponge_height_m = 5e-3;
            t.sponge_compression_m = 1e-3;
        }),
        ("a heavy one", ExpectedResult::Harmless, |t| t.mass_kg = 12.0),
        ("a firmer sponge", ExpectedResult::Harmless, |t| {
            t.sponge_compression_m *= 0.5
        }),
        // Free, it is longer: by less than the planner keeps in reserve.
        ("a softer sponge", ExpectedResult::Harmless, |t| {
            t.sponge_compression_m += 4e-4
        }),
    ];
    for (what, expected, change) in cases {
        edits.add(Kind::Tool, what, expected, move |p, _| {
            let mut straight = as_straight(&p.job.workcell.tool);
            change(&mut straight);
            p.job.workcell.tool = straight.into();
            narrow(p);
        });
    }
}

/// The straight tool that a tool is.
fn as_straight(tool: &tool::Tool) -> StraightTool {
    let Shape::Cylinder { radius_m, .. } = tool.bodies[0].shape else {
        panic!("{tool:?}")
    };
    let straight = StraightTool {
        length_m: tool.tip.translation.z,
        radius_m,
        sponge_radius_m: tool.sponge.radius_m,
        sponge_height_m: tool.sponge.height_m,
        sponge_compression_m: tool.sponge.compression_m,
        sponge_stiffness_pa: tool.sponge.stiffness_pa,
        mass_kg: tool.mass.map_or(0.0, |mass| mass.mass_kg),
        com_m: None,
        inertia_kg_m2: None,
    };
    assert_eq!(tool::Tool::from(straight), *tool);
    straight
}

/// The tip is the middle of the sponge's far face.
fn tip(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply: fn(&mut tool::Tool)| {
        edits.add(Kind::Tool, what, ExpectedResult::Fails(names.to_vec()), move |p, _| {
            apply(&mut p.job.workcell.tool)
        })
    };
    fails("the tip alone, by a hair", &[Tool], |t| t.tip.translation.z += 1e-6);
    fails("the tip alone, aside", &[Tool], |t| t.tip.translation.x += 5e-5);
    fails("the tip alone", &[Tool, ContactHeight, PathDeviation], |t| {
        t.tip.translation.z += 5e-3
    });
    fails("the tip turned back", &[Tool, Tilt, ContactSpeed, Reach], |t| {
        t.tip.rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    fails("the tip askew", &[Tool], |t| {
        t.tip.rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 1e-6)
    });
    fails("the sponge alone", &[Tool], |t| t.sponge.pose.translation.z -= 1e-5);
    fails("a sponge that is higher on both ends", &[Tool], |t| {
        t.sponge.height_m += 1e-3
    });
    fails("a sponge askew", &[Tool], |t| {
        t.sponge.pose.rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 1e-3)
    });
    edits.harmless(Kind::Tool, "the tip turned about itself", |p| {
        let about = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.7);
        p.job.workcell.tool.tip.rotation *= about;
    });
}

/// The handle is as it is in the kitchen.
fn bodies(edits: &mut Edits) {
    edits.fails(Kind::Tool, "no handle at all", &[Tool, Exclusions], |p| {
        p.job.workcell.tool.bodies.clear()
    });
    edits.fails(Kind::Tool, "no handle at all, and what follows", &[Tool], |p| {
        p.job.workcell.tool.bodies.clear();
        restate(p);
    });
    edits.fails(Kind::Tool, "the handle renamed", &[Exclusions], |p| {
        p.job.workcell.tool.bodies[0].name = "pole".to_owned()
    });
    edits.harmless(Kind::Tool, "the handle renamed, and what follows", |p| {
        p.job.workcell.tool.bodies[0].name = "pole".to_owned();
        restate(p);
    });
    edits.fails(Kind::Tool, "a body that is named like a link", &[Exclusions], |p| {
        add_body(p, "link_2", 0.02, 0.05)
    });
    edits.fails(Kind::Tool, "a collar, without what follows", &[Exclusions], |p| {
        add_body(p, "collar", 0.025, 0.03)
    });
    for (size, at, expected) in [
        (0.025, 0.03, ExpectedResult::Harmless),
        (0.04, 0.02, ExpectedResult::Sampled),
        (0.06, 0.06, ExpectedResult::Sampled),
        (0.1, 0.02, ExpectedResult::Fails(vec![Clearance])),
        // It ends within the sponge.
        (0.02, 0.11, ExpectedResult::Fails(vec![Tool])),
        // It goes through the plates.
        (0.02, 0.17, ExpectedResult::Fails(vec![Clearance])),
    ] {
        let what = format!("a ball of {size} m, {at} m from the flange");
        edits.add(Kind::Tool, what, expected, move |p, _| {
            add_body(p, "ball", size, at);
            restate(p);
        });
    }
}

/// A ball about the handle's axis \[m\].
fn add_body(plan: &mut Plan, name: &str, radius_m: f64, at_m: f64) {
    plan.job.workcell.tool.bodies.push(ToolBody {
        name: name.to_owned(),
        shape: Shape::Sphere { radius_m },
        pose: Pose::translation(0.0, 0.0, at_m),
    });
}
