//! Plans whose world is edited: the plate, the sponge and its foam, and what counts as contact. How much of an edit a plan bears is looked
//! for; a tenth less is proved, a tenth more is refused by the requirement that the edit concerns and by no other.
//!
//! One requirement about contact is asked at a time, so that an edit cannot be refused by a neighbour first. What no job can leave out
//! (the tip on the face, along its path) is broken by a face that is another one before contact is.

use crate::contact::{disc, rings, washed};
use crate::maker::{Recipe, irb120, tool};
use platewash_certificate::Requirement::{
    self, ContactDose, ContactForce, ContactHeight, ContactTime, PathDeviation, Pressed, Strain,
};
use platewash_certificate::{Certificate, prove};
use platewash_motion::plan::Plan;
use platewash_workcell::job::ContactRequirements;
use platewash_workcell::surface::{Knot, Surface};
use platewash_workcell::tool::Sponge;
use platewash_workcell::wash_path::WashCurve;
use rayon::prelude::*;

/// A kind of edit.
struct Kind {
    what: &'static str,
    /// About how much of it each plan bears, where the search for that begins; none where it is not tried, as it costs too much.
    about: [Option<f64>; 3],
    /// Refused by the first of these, and by none but these.
    by: &'static [Requirement],
    /// The one that is asked about contact, with limits a little beyond what is proved.
    asks: fn(&mut ContactRequirements, &ProvedBounds),
    /// An edit of a size: of 0 none, of 1 far more than any plan bears.
    edit: fn(&mut Plan, f64),
}

/// Bounds proved for a plan's plate: the greatest strain, the least and the greatest force \[N\].
struct ProvedBounds {
    strain: f64,
    force_n: [f64; 2],
}

/// Nothing asked about contact.
const NOTHING: ContactRequirements = ContactRequirements {
    compression_m: 1e-3,
    height_error_m: 1e-3,
    share: 0.0,
    strain: 1.0,
    force_n: [0.0, 1e3],
    time_s: 0.05,
    time_share: 0.0,
    dose_pa_m: 25.0,
    dose_share: 0.0,
};

const CONTACT: fn(&mut ContactRequirements, &ProvedBounds) = |asked, _| asked.share = 0.95;
const TIME: fn(&mut ContactRequirements, &ProvedBounds) = |asked, _| asked.time_share = 0.9;
const DOSE: fn(&mut ContactRequirements, &ProvedBounds) = |asked, _| asked.dose_share = 0.9;
const STRAIN: fn(&mut ContactRequirements, &ProvedBounds) = |asked, proved| asked.strain = 1.1 * proved.strain;
const LEAST_FORCE: fn(&mut ContactRequirements, &ProvedBounds) =
    |asked, proved| asked.force_n[0] = 0.8 * proved.force_n[0];
const GREATEST_FORCE: fn(&mut ContactRequirements, &ProvedBounds) =
    |asked, proved| asked.force_n[1] = 1.1 * proved.force_n[1];

static KINDS: [Kind; 18] = [
    Kind {
        what: "a steeper slope",
        about: [Some(0.61), Some(0.93), Some(0.48)],
        by: &[ContactHeight, PathDeviation],
        asks: |_, _| (),
        edit: steeper,
    },
    Kind {
        what: "more compression that counts, for contact",
        about: [Some(0.46), Some(0.4), Some(0.39)],
        by: &[Pressed],
        asks: CONTACT,
        edit: higher_least_compression,
    },
    Kind {
        what: "more compression that counts, for its time",
        about: [Some(0.46), None, None],
        by: &[ContactTime],
        asks: TIME,
        edit: higher_least_compression,
    },
    Kind {
        what: "more compression that counts, for the dose",
        about: [Some(0.46), None, None],
        by: &[ContactDose],
        asks: DOSE,
        edit: higher_least_compression,
    },
    Kind {
        what: "a plate that may lie lower, for contact",
        about: [Some(0.46), None, None],
        by: &[Pressed],
        asks: CONTACT,
        edit: |plan, size| asked(plan).height_error_m += 8e-3 * size,
    },
    Kind {
        what: "a plate that may lie higher, for strain",
        about: [Some(0.22), Some(0.4), Some(0.37)],
        by: &[Strain],
        asks: STRAIN,
        edit: |plan, size| asked(plan).height_error_m += 4e-3 * size,
    },
    Kind {
        what: "a longer time",
        about: [Some(0.067), Some(0.17), None],
        by: &[ContactTime],
        asks: TIME,
        edit: |plan, size| asked(plan).time_s += size,
    },
    Kind {
        what: "a greater dose",
        about: [None, None, Some(0.12)],
        by: &[ContactDose],
        asks: DOSE,
        edit: |plan, size| asked(plan).dose_pa_m += 300.0 * size,
    },
    Kind {
        what: "a smaller sponge, for contact",
        about: [Some(0.2), Some(0.73), Some(0.67)],
        by: &[Pressed],
        asks: CONTACT,
        edit: smaller,
    },
    Kind {
        what: "a smaller sponge, for the dose",
        about: [Some(0.19), None, None],
        by: &[ContactDose],
        asks: DOSE,
        edit: smaller,
    },
    Kind {
        what: "a smaller sponge, for the least force",
        about: [Some(0.18), Some(0.26), Some(0.33)],
        by: &[ContactForce],
        asks: LEAST_FORCE,
        edit: smaller,
    },
    Kind {
        what: "a shorter sponge, for strain",
        about: [Some(0.29), Some(0.28), Some(0.26)],
        by: &[Strain],
        asks: STRAIN,
        edit: shorter,
    },
    Kind {
        what: "a shorter sponge, for the greatest force",
        about: [Some(0.29), Some(0.29), Some(0.26)],
        by: &[ContactForce],
        asks: GREATEST_FORCE,
        edit: shorter,
    },
    Kind {
        what: "less compression, for contact",
        about: [Some(0.61), Some(0.64), Some(0.61)],
        by: &[Pressed],
        asks: CONTACT,
        edit: less_compressed,
    },
    Kind {
        what: "less compression, for the dose",
        about: [Some(0.38), None, None],
        by: &[ContactDose],
        asks: DOSE,
        edit: less_compressed,
    },
    Kind {
        what: "less compression, for the least force",
        about: [Some(0.2), Some(0.22), Some(0.17)],
        by: &[ContactForce],
        asks: LEAST_FORCE,
        edit: less_compressed,
    },
    Kind {
        what: "softer foam, for the dose",
        about: [Some(0.42), None, None],
        by: &[ContactDose],
        asks: DOSE,
        edit: softer,
    },
    Kind {
        what: "softer foam, for the least force",
        about: [Some(0.2), Some(0.2), Some(0.2)],
        by: &[ContactForce],
        asks: LEAST_FORCE,
        edit: softer,
    },
];

fn asked(plan: &mut Plan) -> &mut ContactRequirements {
    plan.job.requirements.contact.as_mut().unwrap()
}

fn sponge(plan: &mut Plan) -> &mut Sponge {
    &mut plan.job.workcell.tool.sponge
}

fn higher_least_compression(plan: &mut Plan, size: f64) {
    asked(plan).compression_m += 8e-3 * size;
}

/// A disc that rises towards its rim, a profile that rises more.
fn steeper(plan: &mut Plan, size: f64) {
    let surface = &mut plan.job.plates[0].surface;
    let knots: Vec<Knot> = match *surface {
        Surface::Profile(meridian) => {
            let steeper = |knot: &Knot| Knot {
                slope_rad: knot.slope_rad * (1.0 + 0.05 * size),
                ..*knot
            };
            meridian.knots().iter().map(steeper).collect()
        }
        flat => vec![Knot {
            radius_m: flat.rim_m(),
            slope_rad: 0.02 * size,
        }],
    };
    *surface = Surface::profile(&knots).unwrap();
}

fn smaller(plan: &mut Plan, size: f64) {
    sponge(plan).radius_m *= 1.0 - 0.6 * size;
}

/// The handle ends nearer to the plate, the tip stays where it is.
fn shorter(plan: &mut Plan, size: f64) {
    let was = *sponge(plan);
    plan.job.workcell.tool = tool(|tool| {
        tool.sponge_radius_m = was.radius_m;
        tool.sponge_height_m = was.height_m * (1.0 - 0.4 * size);
        tool.sponge_compression_m = was.compression_m;
        tool.sponge_stiffness_pa = was.stiffness_pa;
    });
}

fn less_compressed(plan: &mut Plan, size: f64) {
    sponge(plan).compression_m *= 1.0 - size;
}

fn softer(plan: &mut Plan, size: f64) {
    sponge(plan).stiffness_pa.as_mut().unwrap()[0] *= 1.0 - 0.99 * size;
}

/// A shipped profile, smaller as a whole.
fn scaled(name: &str, factor: f64) -> Surface {
    let Some(Surface::Profile(meridian)) = Surface::shipped(name) else {
        panic!("{name}")
    };
    let knot = |knot: &Knot| Knot {
        radius_m: factor * knot.radius_m,
        ..*knot
    };
    Surface::profile(&meridian.knots().iter().map(knot).collect::<Vec<_>>()).unwrap()
}

/// Small plates, each with its plan: what is proved of them costs less.
fn plans() -> [(&'static str, Plan); 3] {
    let plan = |mut recipe: Recipe| {
        let wanted = &mut recipe.terms.requirements;
        wanted.landing_m_s = Some(1.0);
        wanted.lifting_m_s = Some(1.0);
        wanted.coverage = 0.0;
        wanted.contact = Some(NOTHING);
        // The limits of the arm do not matter here.
        recipe.terms.limits.joint_acceleration_rad_s2 = [300.0; 6];
        recipe.plan()
    };
    let curve = WashCurve {
        radius_m: 0.05,
        ..rings()
    };
    let mut flat = disc(0.006, 2.0, curve);
    flat.terms.plates[0].surface = Surface::Disc { radius_m: 0.074 };
    let coupe = washed(scaled("coupe275", 0.5), [0.42, 0.025], [0.015, 0.03]);
    let rim = washed(scaled("rim270", 0.75), [0.42, 0.03], [0.016, 0.03]);
    [("flat", plan(flat)), ("coupe", plan(coupe)), ("rim", plan(rim))]
}

fn judged(plan: &Plan) -> Certificate {
    prove(plan, &irb120()).unwrap()
}

fn refused(plan: &Plan) -> Vec<Requirement> {
    judged(plan).broken().map(|check| check.requirement).collect()
}

/// A plan with what an edit needs to be asked, and what is proved of it.
fn asking(plan: &Plan, kind: &Kind, proved: &ProvedBounds) -> Plan {
    let mut plan = plan.clone();
    (kind.asks)(asked(&mut plan), proved);
    plan
}

fn edited(plan: &Plan, kind: &Kind, size: f64) -> Plan {
    let mut plan = plan.clone();
    (kind.edit)(&mut plan, size);
    assert_eq!(plan.job.validate().err(), None, "{}: {size}", kind.what);
    plan
}

/// Tries an edit a tenth smaller and a tenth larger than `about`, the size that the plan should just bear. Returns the error if that size
/// is not between them.
fn complaint(plan: &Plan, kind: &Kind, about: f64) -> Option<String> {
    let [mut kept, mut broken] = [0.0, 1.0];
    let mut size = about;
    for _ in 0..12 {
        let within = refused(&edited(plan, kind, 0.9 * size));
        if !within.is_empty() {
            broken = 0.9 * size;
            size = f64::max(0.85 * size, 0.5 * (kept + broken));
            continue;
        }
        let beyond = refused(&edited(plan, kind, 1.1 * size));
        if beyond.is_empty() {
            kept = 1.1 * size;
            size = f64::min(1.15 * size, 0.5 * (kept + broken));
            continue;
        }
        let is_right = beyond.contains(&kind.by[0]) && beyond.iter().all(|name| kind.by.contains(name));
        return (!is_right).then(|| format!("{} at {size}: refused by {beyond:?}", kind.what));
    }
    Some(format!("{}: proved at {kept}, refused at {broken}", kind.what))
}

#[test]
fn proves_deviations_that_a_plan_tolerates_and_refuses_larger_ones() {
    let plans = plans();
    let proved = plans.each_ref().map(|(name, plan)| {
        let certificate = judged(plan);
        assert_eq!(certificate.broken().count(), 0, "{name}: {certificate}");
        let contact = &certificate.contact[0];
        ProvedBounds {
            strain: contact.strain.bound.unwrap(),
            force_n: [contact.least_force_n, contact.greatest_force_n].map(|force| force.bound.unwrap()),
        }
    });
    let of_kind = |kind: &'static Kind| (0..plans.len()).filter_map(move |i| Some((i, kind, kind.about[i]?)));
    let tries: Vec<_> = KINDS.iter().flat_map(of_kind).collect();
    let complaints: Vec<String> = tries
        .par_iter()
        .filter_map(|(i, kind, about)| {
            let (name, plan) = &plans[*i];
            let found = complaint(&asking(plan, kind, &proved[*i]), kind, *about);
            found.map(|found| format!("{name}, {found}"))
        })
        .collect();
    assert!(complaints.is_empty(), "{complaints:#?}");
    // Each is tried twice.
    assert!(2 * tries.len() >= 76, "{}", tries.len());
}
