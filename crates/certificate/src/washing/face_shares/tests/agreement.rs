//! One point measured and cells bounded say the same: what a cell is proved to get, each of its points is measured to get, and where cells
//! are small and nothing is lost between moments, not much more.
//!
//! A face that is smaller than the smallest cell is one cell, and where more is wanted than there is, what it is proved to get is told: so
//! little faces stand for single cells, the motion moved over them.

use crate::washing::face_shares::sags::Sags;
use crate::washing::face_shares::{Fineness, shares};
use nalgebra::Vector3;
use platewash_bodies::contact::{ContactSampler, Dwell, Foundation, Moment, SpongePose};
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::random::stream;
use platewash_workcell::surface::{Knot, SHARPEST_M, Surface};
use rand::RngExt;
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// More than any place gets.
const NEVER: f64 = 1e9;

/// The least compression that counts \[m\].
const CONTACT_M: f64 = 1e-3;

fn any(random: &mut Pcg64, [least, most]: [f64; 2]) -> f64 {
    least + (most - least) * random.random::<f64>()
}

fn foundation(random: &mut Pcg64) -> Foundation {
    let compression_m = any(random, [4e-3, 8e-3]);
    Foundation {
        radius_m: any(random, [0.015, 0.03]),
        free_height_m: 0.02 + compression_m,
        compression_m,
        stiffness_pa: [any(random, [5e3, 2e4]), 4e4],
    }
}

/// A sponge that winds over the place about the origin and wobbles: positions, axes and what they change by, all of one motion.
fn motion(random: &mut Pcg64, count: u32) -> Vec<Moment> {
    let (reach_m, lean, wobble) = (
        any(random, [0.0, 0.03]),
        any(random, [0.0, 0.15]),
        any(random, [1.0, 4.0]),
    );
    let (pace, offset) = (any(random, [2.0, 8.0]), any(random, [0.0, TAU]));
    let height_m = any(random, [-5e-4, 5e-4]);
    let pose = |t: f64| {
        let (angle, turn) = (pace * t + offset, wobble * t);
        let far = reach_m + 5e-3 * t;
        SpongePose {
            tip: Vector3::new(far * angle.cos(), far * angle.sin(), height_m + 3e-4 * turn.sin()),
            axis: Vector3::new(lean * turn.cos(), lean * turn.sin(), -1.0).normalize(),
        }
    };
    let moment = |k: u32| {
        let (t, h) = (4.0 * f64::from(k) / f64::from(count), 1e-6);
        let (before, here, after) = (pose(t - h), pose(t), pose(t + h));
        Moment {
            t_s: t,
            pose: here,
            speed: (after.tip - before.tip) / (2.0 * h),
            turning: here.axis.cross(&((after.axis - before.axis) / (2.0 * h))),
        }
    };
    (0..=count).map(moment).collect()
}

/// A little face: level, or as steep as a wall at its rim.
fn little(random: &mut Pcg64, radius_m: f64) -> Surface {
    if random.random() {
        return Surface::Disc { radius_m };
    }
    // No arc is sharper than any that a meridian may have.
    let slope_rad = any(random, [0.0, (0.9 * radius_m / SHARPEST_M).min(0.5)]);
    Surface::profile(&[Knot { radius_m, slope_rad }]).unwrap()
}

/// Returns the amounts proved for a single cell that covers the whole face.
fn proved(
    surface: &Surface,
    foundation: &Foundation,
    (moments, sags): (&[Moment], &[Sags]),
    thresholds: &ContactThresholds,
) -> Dwell {
    let fineness = Fineness {
        cell_m: 2.0 * surface.rim_m(),
        enough: [1.0; 3],
    };
    let worst = |thresholds: &ContactThresholds| {
        let found = shares(surface, foundation, (moments, sags), thresholds, &fineness);
        [found.contact, found.time, found.dose].map(|share| share.worst)
    };
    let [_, time_s, dose_pa_m] = worst(thresholds);
    let [compression_m, ..] = worst(&ContactThresholds {
        compression_m: NEVER,
        ..*thresholds
    });
    Dwell {
        compression_m: compression_m.unwrap(),
        time_s: time_s.unwrap(),
        dose_pa_m: dose_pa_m.unwrap(),
    }
}

fn wanted(random: &mut Pcg64) -> ContactThresholds {
    ContactThresholds {
        compression_m: CONTACT_M,
        height_error_m: any(random, [0.0, 1e-3]),
        time_s: NEVER,
        dose_pa_m: NEVER,
    }
}

/// A point of a face, anywhere on it.
fn place(random: &mut Pcg64, surface: &Surface) -> Vector3<f64> {
    let (rho, phi) = (
        surface.rim_m() * any(random, [0.0, 1.0]).sqrt(),
        any(random, [0.0, TAU]),
    );
    Vector3::new(rho * phi.cos(), rho * phi.sin(), surface.height_m(rho))
}

#[test]
fn measured_points_get_at_least_the_bounds_of_their_cell() {
    let (mut pressed, mut partly) = (0, 0);
    for seed in 1..=400 {
        let random = &mut stream(seed, "agreement");
        let (foundation, wanted) = (foundation(random), wanted(random));
        let moments = motion(random, 400);
        let rim_m = any(random, [1e-4, 4e-3]);
        let surface = little(random, rim_m);
        // Nothing is lost, or something.
        let lost = any(random, [0.0, 1e-4]) * f64::from(u8::from(random.random::<bool>()));
        let sags = Sags {
            compression_m: lost,
            aside_m: lost,
            slide_m: 1e-2 * lost,
        };
        let least = proved(&surface, &foundation, (&moments, &vec![sags; 400]), &wanted);
        let looks = ContactSampler::new(foundation, moments.clone(), wanted);
        for _ in 0..20 {
            let point = place(random, &surface);
            let got = looks.at(&point);
            // The measured dose uses means of pressure and speed between moments, so it is off by the product of their changes.
            let keeps = [
                (got.compression_m.max(0.0), least.compression_m, 1.0),
                (got.time_s, least.time_s, 1.0),
                (got.dose_pa_m, least.dose_pa_m, 0.98),
            ];
            for (got, least, part) in keeps {
                assert!(
                    got >= part * least - 1e-9,
                    "seed {seed}, {point:?}: {got} measured, {least} proved"
                );
            }
        }
        pressed += u32::from(least.time_s > 0.0 && least.dose_pa_m > 0.0);
        partly += u32::from(least.time_s > 0.0 && least.time_s < 3.9);
    }
    assert!(pressed >= 200 && partly >= 100, "{pressed} {partly}");
}

#[test]
fn bounds_of_small_cells_are_close_to_measured_points() {
    let (mut compared, mut complaints) = (0, Vec::new());
    for seed in 1..=200 {
        let random = &mut stream(seed, "agreement, small cells");
        let (foundation, wanted) = (foundation(random), wanted(random));
        let moments = motion(random, 2000);
        let surface = little(random, 1e-5);
        let least = proved(&surface, &foundation, (&moments, &vec![Sags::default(); 2000]), &wanted);
        let got = ContactSampler::new(foundation, moments.clone(), wanted).at(&Vector3::zeros());
        let most = |of: fn(&Moment) -> f64| moments.iter().map(of).fold(0.0, f64::max);
        let [fastest, turning] = [most(|moment| moment.speed.norm()), most(|moment| moment.turning.norm())];
        let greatest_pa = foundation.stiffness_pa[0] / foundation.free_height_m * got.compression_m.max(0.0);
        // A place that is at the edge of contact for long gets in and out of it with little; a plate that lies higher or lower is slid over
        // at another speed by the turning, which a measured point is not.
        let edge_s = 0.03;
        let dose_pa_m = greatest_pa * (fastest * edge_s + turning * wanted.height_error_m * got.time_s);
        let near = [
            (got.compression_m.max(0.0), 0.97, least.compression_m, 1e-4),
            (got.time_s, 0.97, least.time_s, edge_s),
            (got.dose_pa_m, 0.95, least.dose_pa_m, dose_pa_m),
        ];
        for (got, part, least, apart) in near {
            if least < part * got - apart {
                complaints.push(format!("seed {seed}: {got} measured, {least} proved"));
            }
        }
        compared += u32::from(least.time_s > 0.0);
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
    assert!(compared >= 100, "{compared}");
}
