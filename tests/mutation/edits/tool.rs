//! The tool: stated alone, asked alone, and both.

use crate::edit::{Edits, Expected, Kind};
use crate::good::good;
use platewash::Plan;
use platewash::planner::certificate::PromiseName::{
    Clearance, ContactHeight, Coverage, Limits, LineDeviation, StrokeDeviation, Tool,
};
use platewash::planner::plan::TipPose;
use platewash::workcell::tool;

pub fn add(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Tool, what, names, apply);
    fails("longer, stated", &[Tool], |p| p.tool.length_m += 0.01);
    fails("thicker, stated", &[Tool], |p| p.tool.radius_m += 1e-12);
    fails("a bigger sponge, stated", &[Tool], |p| p.tool.sponge_radius_m *= 2.0);
    fails("a higher sponge, stated", &[Tool], |p| p.tool.sponge_height_m *= 2.0);
    fails("another tip", &[Tool], |p| p.tip.position_m[2] += 1e-9);
    fails("a tip turned", &[Tool], |p| {
        p.tip.quaternion_wxyz = [1.0, 0.0, 0.0, 0.0]
    });
    fails("a tip on another link", &[Tool], |p| p.tip.link = "link_5".into());
    fails("thicker, asked", &[Tool], |p| p.scenario.tool.radius_m += 1e-3);
    fails("longer, asked", &[Tool, ContactHeight, StrokeDeviation], |p| {
        p.scenario.tool.length_m += 0.01
    });
    fails("longer, without its tip", &[Tool, ContactHeight], |p| {
        p.scenario.tool.length_m += 1e-3;
        p.tool = p.scenario.tool.clone();
    });
    both(edits);
}

/// The scenario asks for another tool, and the plan states it.
fn both(edits: &mut Edits) {
    type Change = fn(&mut tool::Tool);
    let off = vec![ContactHeight, StrokeDeviation];
    let far = vec![ContactHeight, StrokeDeviation, LineDeviation];
    let cases: [(&str, Expected, Change); 12] = [
        ("a hair longer", Expected::Sampled, |t| t.length_m += 1e-5),
        ("a little longer", Expected::Sampled, |t| t.length_m += 1.5e-4),
        ("longer", Expected::Fails(off), |t| t.length_m += 5e-4),
        ("much shorter", Expected::Fails(far), |t| t.length_m -= 0.02),
        ("thinner", Expected::Harmless, |t| t.radius_m -= 5e-3),
        ("a little thicker", Expected::Harmless, |t| t.radius_m += 4e-3),
        ("thicker", Expected::Fails(vec![Clearance]), |t| t.radius_m += 0.06),
        ("as thick as the sponge is high", Expected::Sampled, |t| {
            t.radius_m = t.sponge_height_m
        }),
        ("a bigger sponge", Expected::Sampled, |t| t.sponge_radius_m += 2e-3),
        ("a sponge like a plate", Expected::Fails(vec![Clearance, Limits]), |t| {
            t.sponge_radius_m = 0.12
        }),
        ("a small sponge", Expected::Fails(vec![Coverage]), |t| {
            t.sponge_radius_m = 0.012
        }),
        ("a flat sponge", Expected::Fails(vec![Clearance, Limits]), |t| {
            t.sponge_height_m = 5e-3
        }),
    ];
    for (what, expected, change) in cases {
        let what = format!("{what}, asked and stated");
        edits.add(Kind::Tool, what, expected, move |p, _| restated(p, change));
    }
}

fn restated(plan: &mut Plan, change: fn(&mut tool::Tool)) {
    change(&mut plan.scenario.tool);
    plan.tool = plan.scenario.tool.clone();
    plan.tip = TipPose::new(good()[0].robot, &plan.tool);
}
