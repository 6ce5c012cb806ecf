//! Bounds of the contact, against the same model on fine squares: never above it, and little below.

use crate::foundation::{dose_times_s, raster};
use crate::maker::{Recipe, irb120};
use platewash_certificate::{PlateContact, Requirement, Status, dose_times, prove};
use platewash_fixtures::is_thorough;
use platewash_motion::plan::Plan;
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{Rings, WashCurve, WashPattern};

pub fn spiral(radius_m: f64, turns: f64) -> WashCurve {
    WashCurve {
        radius_m,
        turns,
        start_angle_rad: 0.3,
        closing_ring: true,
        trim_rad: 0.0,
        pattern: WashPattern::Spiral,
    }
}

pub fn rings() -> WashCurve {
    let rings = Rings {
        count: 3,
        inner_m: 0.0243,
        lead_rad: 2.02,
        blend_rad: 1.77,
        laps: 1,
    };
    WashCurve {
        turns: rings.turns(),
        pattern: WashPattern::Rings(rings),
        ..spiral(0.121, 2.0)
    }
}

/// Returns the recipe of a profile: height of the sponge, distance from the base, length of the path, turns.
pub fn profile(name: &str) -> Recipe {
    let surface = Surface::shipped(name).unwrap();
    let (height_m, rho, inside_m, pitch_m) = match name {
        "coupe275" => (0.025, 0.37, 0.015, 0.032),
        "rim270" => (0.03, 0.37, 0.016, 0.032),
        "deep230" => (0.035, 0.40, 0.014, 0.032),
        _ => (0.025, 0.37, 0.012, 0.032),
    };
    washed(surface, [rho, height_m], [inside_m, pitch_m])
}

/// Returns a face with a spiral that ends inside its rim: distance from the base and height of the sponge, distance inside the rim and
/// pitch \[m\].
pub fn washed(surface: Surface, place: [f64; 2], [inside_m, pitch_m]: [f64; 2]) -> Recipe {
    let radius_m = surface.arc_m() - inside_m;
    let mut recipe = Recipe::on(surface, place, spiral(radius_m, (radius_m / pitch_m).max(1.5)));
    recipe.terms.requirements.tilt_rad = 30_f64.to_radians();
    recipe
}

/// Returns a disc with a compression, a lean and a curve.
pub fn disc(compression_m: f64, lean_deg: f64, curve: WashCurve) -> Recipe {
    let mut recipe = Recipe::on(Surface::Disc { radius_m: 0.145 }, [0.37, 0.025], curve);
    recipe.terms.workcell.tool.sponge.compression_m = compression_m;
    recipe.lean = lean_deg.to_radians();
    // The rings are wide apart.
    let contact = recipe.terms.requirements.contact.as_mut().unwrap();
    (contact.time_s, contact.time_share) = (0.05, 0.98);
    (contact.dose_pa_m, contact.dose_share) = (25.0, 0.98);
    recipe
}

fn judged(plan: &Plan) -> (PlateContact, platewash_certificate::Certificate) {
    let certificate = prove(plan, &irb120()).unwrap();
    (certificate.contact[0], certificate)
}

/// Compares a plan with the raster. Shares are required in full, so that the finest cells are examined.
fn compare(name: &str, recipe: &Recipe) {
    let mut recipe = recipe.clone();
    let contact = recipe.terms.requirements.contact.as_mut().unwrap();
    (contact.share, contact.time_share, contact.dose_share) = (1.0, 1.0, 1.0);
    recipe.terms.requirements.coverage = 1.0;
    let plan = recipe.plan();
    let (found, certificate) = judged(&plan);
    let seen = raster(&plan);
    let shares = [
        ("contact", found.pressed.at_least, seen.contact),
        ("time", found.time.at_least, seen.time),
        ("dose", found.dose.at_least, seen.dose),
    ];
    for (what, proved, seen) in shares {
        assert!(proved <= seen + 1e-4, "{name}, {what}: {proved} proved, {seen} seen");
        assert!(proved >= seen - 5e-3, "{name}, {what}: {proved} proved, {seen} seen");
    }
    if !recipe.terms.plates[0].surface.is_flat() {
        let touched = certificate.swept[0].at_least;
        assert!(
            touched <= seen.touched + 1e-4 && touched >= seen.touched - 5e-3,
            "{name}: {touched} {}",
            seen.touched
        );
    }
    let bound = |of: platewash_certificate::ProvedExtreme| of.bound.unwrap();
    let (strain, least, most) = (
        bound(found.strain),
        bound(found.least_force_n),
        bound(found.greatest_force_n),
    );
    assert!(
        strain >= seen.strain - 1e-9 && strain <= 1.15 * seen.strain + 0.02,
        "{name}: {strain} {}",
        seen.strain
    );
    // The squares add up to the area of the sponge within half a percent.
    assert!(
        least <= 1.005 * seen.force_n[0] && least >= 0.4 * seen.force_n[0],
        "{name}: {least} {:?}",
        seen.force_n
    );
    assert!(
        most >= 0.995 * seen.force_n[1] && most <= 1.15 * seen.force_n[1],
        "{name}: {most} {:?}",
        seen.force_n
    );
    let [low, high] = found.friction_torque_nm.unwrap();
    assert!(
        (low - 0.3 * high).abs() < 1e-12 && high >= 0.995 * seen.torque_nm && high <= 1.5 * seen.torque_nm,
        "{name}: {high} {}",
        seen.torque_nm
    );
    let held = found.holder_load.unwrap();
    for (proved, seen) in held.lateral_n.into_iter().zip(seen.lateral_n) {
        assert!(
            proved >= 0.995 * seen && proved <= 1.3 * seen,
            "{name}: {proved} N {seen} N"
        );
    }
    let [low, high] = held.torque_nm;
    assert!(
        (low - 0.3 * high).abs() < 1e-12 && high >= 0.995 * seen.turning_nm && high <= 1.2 * seen.turning_nm,
        "{name}: {high} {}",
        seen.turning_nm
    );
    for requirement in [
        Requirement::Tilt,
        Requirement::PathDeviation,
        Requirement::ContactHeight,
    ] {
        let check = certificate.check(requirement).unwrap();
        assert_eq!(check.status, Status::Proved, "{name}: {check:?}");
    }
}

#[test]
fn bounds_of_pressed_discs_agree_with_the_model() {
    compare("disc, 5 mm, upright", &disc(0.005, 0.0, rings()));
}

#[test]
fn bounds_of_discs_under_a_tilted_sponge_agree_with_the_model() {
    let more = is_thorough().then_some((0.006, 6.0));
    for (compression_m, lean_deg) in [(0.005, 9.0)].into_iter().chain(more) {
        let name = format!("disc, {compression_m} m, {lean_deg}°");
        compare(&name, &disc(compression_m, lean_deg, rings()));
    }
}

#[test]
fn bounds_of_pressed_profiles_agree_with_the_model() {
    let more: &[_] = if is_thorough() {
        &["coupe275", "dessert190"]
    } else {
        &[]
    };
    for name in ["rim270"].iter().chain(more) {
        compare(name, &profile(name));
    }
}

#[test]
fn bounds_of_a_deep_plate_agree_with_the_model() {
    compare("deep230", &profile("deep230"));
}

/// Places on a grid of 9 mm: the proof of their dose comes after the model has it, and soon after.
#[test]
fn doses_of_places_are_proved_when_they_are_there_and_soon_after() {
    for recipe in [disc(0.006, 4.0, rings()), profile("deep230")] {
        let plan = recipe.plan();
        let certificate = prove(&plan, &irb120()).unwrap();
        let grid = |_, rim_m: f64| {
            let line = || (-20..=20).map(|k| 0.009 * f64::from(k));
            let all = line().flat_map(|x| line().map(move |y| [x, y]));
            all.filter(|[x, y]| x * x + y * y <= rim_m * rim_m).collect::<Vec<_>>()
        };
        let proved = dose_times(&plan, &irb120(), &certificate, grid).unwrap();
        let seen = dose_times_s(&plan, &grid(0, plan.job.plates[0].rim_m()));
        assert_eq!((proved.len(), proved[0].times_s.len()), (1, seen.len()));
        let (mut reached, mut soon) = (0, 0);
        for (proved_s, seen_s) in proved[0].times_s.iter().zip(&seen) {
            // The model looks every 2 ms.
            assert!(*proved_s >= seen_s - 0.01, "{proved_s} s proved, {seen_s} s seen");
            reached += usize::from(seen_s.is_finite());
            soon += usize::from(seen_s.is_finite() && *proved_s <= seen_s + 0.1);
        }
        assert!(
            reached > seen.len() / 2 && soon > 95 * reached / 100,
            "{soon} of {reached} soon"
        );
    }
}

#[test]
fn no_dose_is_proved_at_a_place_without_a_certificate_of_it() {
    let mut recipe = disc(0.006, 4.0, rings());
    let plan = recipe.plan();
    let mut certificate = prove(&plan, &irb120()).unwrap();
    certificate.contact[0].dose.at_least = 0.0;
    assert_eq!(
        dose_times(&plan, &irb120(), &certificate, |_, _| vec![[0.0; 2]]),
        Ok(Vec::new())
    );
    recipe.terms.requirements.contact = None;
    let plan = recipe.plan();
    let certificate = prove(&plan, &irb120()).unwrap();
    assert_eq!(
        dose_times(&plan, &irb120(), &certificate, |_, _| vec![[0.0; 2]]),
        Ok(Vec::new())
    );
}
