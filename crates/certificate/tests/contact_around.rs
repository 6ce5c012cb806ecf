//! A tip that goes deeper before or after its wash than in it: strain, force and torque are those of the deepest place, the least force is
//! that of the wash.

use crate::contact::{disc, rings, washed};
use crate::maker::{Recipe, irb120};
use platewash_certificate::{Certificate, PlateContact, Requirement, prove};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::surface::{Knot, Surface};
use platewash_workcell::wash_path::WashCurve;

/// Depth below the face \[m\]: less than the millimetre that the line over a path allows.
const DIP_M: f64 = 9e-4;

fn judged(recipe: &Recipe, dips_m: [f64; 2]) -> (Plan, Certificate) {
    let mut recipe = recipe.clone();
    recipe.dips_m = dips_m;
    let plan = recipe.plan();
    let certificate = prove(&plan, &irb120()).unwrap();
    (plan, certificate)
}

/// The greatest strain, the greatest force \[N\], the greatest torque \[N·m\].
fn most(contact: &PlateContact) -> [f64; 3] {
    let [strain, force] = [contact.strain, contact.greatest_force_n].map(|extreme| extreme.bound.unwrap());
    [strain, force, contact.friction_torque_nm.unwrap()[1]]
}

/// Small plates: a disc, and a hollow face.
fn recipes() -> [(&'static str, Recipe); 2] {
    let easy = |mut recipe: Recipe| {
        let wanted = &mut recipe.terms.requirements;
        (wanted.landing_m_s, wanted.lifting_m_s, wanted.coverage) = (None, None, 0.0);
        let contact = wanted.contact.as_mut().unwrap();
        (contact.share, contact.time_share, contact.dose_share) = (0.0, 0.0, 0.0);
        recipe.terms.limits.joint_acceleration_rad_s2 = [300.0; 6];
        recipe
    };
    let curve = WashCurve {
        radius_m: 0.045,
        ..rings()
    };
    let mut flat = disc(0.006, 2.0, curve);
    flat.terms.plates[0].surface = Surface::Disc { radius_m: 0.074 };
    let hollow = [(0.04, 2.0), (0.075, 3.5)].map(|(radius_m, slope_deg): (f64, f64)| Knot {
        radius_m,
        slope_rad: slope_deg.to_radians(),
    });
    let hollow = washed(Surface::profile(&hollow).unwrap(), [0.42, 0.025], [0.015, 0.03]);
    [("flat", easy(flat)), ("hollow", easy(hollow))]
}

#[test]
fn strain_counts_the_deepest_point_from_approach_to_retreat() {
    for (name, recipe) in recipes() {
        let (_, plain) = judged(&recipe, [0.0; 2]);
        assert_eq!(plain.broken().count(), 0, "{name}: {plain}");
        for (dips_m, kind) in [
            ([DIP_M, 0.0], SegmentKind::Approach),
            ([0.0, DIP_M], SegmentKind::Retreat),
        ] {
            // Where it leaves the hollow it is flatter: no deeper with the dip than elsewhere in the wash.
            if name == "hollow" && kind == SegmentKind::Retreat {
                continue;
            }
            let (mut plan, deeper) = judged(&recipe, dips_m);
            assert_eq!(deeper.broken().count(), 0, "{name}, {kind:?}: {deeper}");
            let [was, is] = [&plain, &deeper].map(|certificate| certificate.contact[0]);
            // On a disc the mean of the compression is c + δ in the wash, and so much more in the dip; the plans differ a little in the wash.
            let foundation = &plan.job.workcell.tool.sponge;
            let more = 1.0 + DIP_M / (foundation.compression_m + 1e-3);
            for (was, is) in most(&was).into_iter().zip(most(&is)) {
                assert!(
                    is > 1.01 * was && is < 1.02 * more * was,
                    "{name}, {kind:?}: {is} {was}"
                );
            }
            if name == "flat" {
                let force = is.greatest_force_n.bound.unwrap() / was.greatest_force_n.bound.unwrap();
                assert!((force / more - 1.0).abs() < 5e-3, "{force} {more}");
            }
            let least = [was, is].map(|contact| contact.least_force_n.bound.unwrap());
            assert!((least[0] / least[1] - 1.0).abs() < 1e-2, "{name}, {kind:?}: {least:?}");
            // Limits that the wash alone keeps are broken, and where is said.
            let between = |i: usize| 0.5 * (most(&was)[i] + most(&is)[i]);
            let asked = plan.job.requirements.contact.as_mut().unwrap();
            (asked.strain, asked.force_n[1]) = (between(0), between(1));
            let refused = prove(&plan, &irb120()).unwrap();
            let broken: Vec<_> = refused.broken().map(|check| check.requirement).collect();
            assert_eq!(
                broken,
                [Requirement::Strain, Requirement::ContactForce],
                "{name}: {refused}"
            );
            for check in refused.broken() {
                let segment = check.worst.segment.unwrap();
                assert_eq!(segment.1, kind, "{name}: {check:?}");
            }
        }
    }
}
