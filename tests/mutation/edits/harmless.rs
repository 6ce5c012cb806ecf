//! What is never judged, and what is too small to break anything.

use crate::mutation::edit::{Edits, Kind};
use crate::mutation::edits::retime;
use platewash::Plan;
use platewash::workcell::job::{OrderRule, Planner, PlannerSettings};
use platewash::workcell::simulation::ControlLawName;

pub fn add(edits: &mut Edits) {
    let mut words = |what, apply| edits.harmless(Kind::Words, what, apply);
    words("name of the scenario", |p| p.provenance.scenario = "renamed".into());
    words("version", |p| p.provenance.version = "99.0.0".into());
    words("seed", |p| p.job.seed += 1);
    words("radius that was planned for", |p| {
        settings(p).path_radius_m = Some(0.01)
    });
    words("turns that were planned for", |p| settings(p).turns = Some(9.0));
    words("lift that was planned for", |p| settings(p).lift_m *= 2.0);
    words("the rule of the order", |p| settings(p).order = OrderRule::Nearest);
    words("the arc round the base", |p| settings(p).arc.height_m = 0.5);
    words("where the upright tool leans", |p| settings(p).reach.far_m = 0.4);
    words("law of the simulation", |p| p.job.simulation.law = ControlLawName::Pd);
    words("gains", |p| p.job.simulation.control.kp *= 2.0);
    words("payload", |p| p.job.simulation.payload_kg = Some(0.1));
    let mut rounding = |what, apply| edits.harmless(Kind::Rounding, what, apply);
    rounding("positions", |p| {
        p.knots.q_rad.iter_mut().for_each(|q| q.apply(|v| *v = rounded(*v)))
    });
    rounding("speeds", |p| {
        p.knots.qd_rad_s.iter_mut().for_each(|v| v.apply(|v| *v = rounded(*v)))
    });
    rounding("times", |p| retime(p, |_, t| rounded(t)));
    rounding("places of plates", |p| {
        let plates = p.job.plates.iter_mut();
        plates.for_each(|plate| *plate = plate.moved_to(plate.centre_xy().map(rounded)));
    });
    rounding("wash paths", |p| {
        p.wash_paths
            .iter_mut()
            .for_each(|path| path.curve.start_angle_rad = rounded(path.curve.start_angle_rad))
    });
}

fn settings(plan: &mut Plan) -> &mut PlannerSettings {
    match &mut plan.job.planner {
        Planner::Wash(settings) => settings,
        Planner::Paper(_) => panic!("the plan is one of a washing"),
    }
}

/// To 13 decimals.
fn rounded(value: f64) -> f64 {
    (value * 1e13).round() / 1e13
}
