//! The pressure of an upright sponge, stays over a place, and level presses against sums over the face.

use nalgebra::Vector3;
use platewash_bodies::contact::*;
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::surface::Surface;
use proptest::prelude::*;
use std::f64::consts::PI;

fn foundation() -> Foundation {
    Foundation {
        radius_m: 0.025,
        free_height_m: 0.025,
        compression_m: 0.005,
        stiffness_pa: [2e4; 2],
    }
}

fn upright([x, y]: [f64; 2]) -> SpongePose {
    SpongePose {
        tip: Vector3::new(x, y, 0.0),
        axis: -Vector3::z(),
    }
}

/// By hand: 20 kPa, 5 mm of 25 mm, a radius of 25 mm: 4 kPa, 7.85 N.
#[test]
fn an_upright_sponge_presses_with_its_whole_face() {
    let (foundation, disc) = (foundation(), Surface::Disc { radius_m: 0.145 });
    let load = Columns::new(&foundation).load(&disc, &upright([0.05, 0.02]), 0.0);
    for volume in load.volume_m3 {
        let [force, _] = foundation.forces_n(volume);
        assert!((force - 4000.0 * PI * 0.025 * 0.025).abs() < 1e-9, "{force}");
    }
    assert!((load.deepest_m - 0.005).abs() < 1e-12 && (load.shallowest_m - 0.005).abs() < 1e-12);
}

/// A sponge that goes along x over a place twice, once each way, at 0.1 m/s, tilted a little.
fn twice_along_x() -> Vec<Moment> {
    let axis = Vector3::new(0.05, 0.0, -1.0).normalize();
    let place = |k: i32| {
        if k <= 40 {
            0.005 * f64::from(k)
        } else {
            0.005 * f64::from(80 - k)
        }
    };
    (0..=80)
        .map(|k| Moment {
            t_s: 0.05 * f64::from(k),
            pose: SpongePose {
                tip: Vector3::new(place(k), 0.0, 0.0),
                axis,
            },
            speed: Vector3::x() * if k < 40 { 0.1 } else { -0.1 },
            turning: Vector3::zeros(),
        })
        .collect()
}

/// Stays add up to the time in contact, follow one another, and begin and end where the rim of the sponge gets over the place.
#[test]
fn the_contact_intervals_of_a_point_add_up_to_its_contact_time() {
    let (foundation, moments) = (foundation(), twice_along_x());
    let wanted = ContactThresholds {
        compression_m: 0.001,
        height_error_m: 0.001,
        time_s: 0.0,
        dose_pa_m: 0.0,
    };
    let looks = ContactSampler::new(foundation, moments, wanted);
    for (x, count) in [(0.1, 2), (0.03, 2), (0.199, 1), (0.3, 0)] {
        let point = Vector3::new(x, 0.01, 0.0);
        let stays = looks.contact_intervals(&point);
        assert_eq!(stays.len(), count, "{stays:?}");
        let all: f64 = stays.iter().map(|[from, to]| to - from).sum();
        assert!((all - looks.at(&point).time_s).abs() < 1e-12, "{stays:?}");
        let times: Vec<f64> = stays.into_iter().flatten().collect();
        assert!(
            times.is_sorted() && times.iter().all(|t| (0.0..=4.0).contains(t)),
            "{times:?}"
        );
    }
    // Half a chord 10 mm off the middle of a sponge of 25 mm, less what the height error moves it aside.
    let [from, _] = looks.contact_intervals(&Vector3::new(0.1, 0.01, 0.0))[0];
    let chord_m = (0.025f64.powi(2) - 0.01f64.powi(2)).sqrt();
    assert!((from - (0.1 - chord_m) / 0.1).abs() < 2e-2, "{from}");
    let none = ContactSampler::new(foundation, Vec::new(), wanted);
    assert!(
        none.contact_intervals(&Vector3::new(f64::NAN, 0.0, 0.0)).is_empty()
            && looks.contact_intervals(&Vector3::repeat(f64::NAN)).is_empty()
    );
}

proptest! {
    /// Dense sums over the sponge's face, at every height and tilt within the bounds, stay within the computed bounds.
    #[test]
    fn loads_of_poses_stay_within_the_bounds(
        height in [-2e-3..2e-3f64, -2e-3..2e-3f64], tilt in 0.0..0.3f64, share in [0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64], far in 0.05..0.15f64,
    ) {
        let foundation = Foundation { radius_m: 0.025, free_height_m: 0.03, compression_m: 0.005, stiffness_pa: [1.1e4, 4.4e4] };
        let height_m = [height[0].min(height[1]), height[0].max(height[1])];
        let level = Level { height_m, cosine: tilt.cos(), distance_m: far };
        let press = foundation.level_press(&level, 0.145);
        let (z, t, d) = (height_m[0] + (height_m[1] - height_m[0]) * share[0], tilt * share[1], far * share[2]);
        let n = 200;
        let (mut volume, mut twist, mut turn, mut deepest) = (0.0, 0.0, 0.0, f64::NEG_INFINITY);
        let ds = 2.0 * 0.025 / f64::from(n);
        for i in 0..n {
            for j in 0..n {
                let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) * ds - 0.025);
                if x * x + y * y > 0.025 * 0.025 { continue; }
                // The column through (x, y) across the axis (sin t, 0, −cos t) meets the face where its height is 0.
                let along = (z + x * t.sin()) / t.cos();
                let meets = [d + x * t.cos() + along * t.sin(), y];
                if meets[0] * meets[0] + meets[1] * meets[1] > 0.145 * 0.145 { continue; }
                let w = 0.005 - along;
                deepest = f64::max(deepest, w);
                volume += w.max(0.0) * ds * ds;
                twist += w.max(0.0) * (x * x + y * y).sqrt() * ds * ds / t.cos();
                turn += w.max(0.0) * (meets[0] * meets[0] + meets[1] * meets[1]).sqrt() * ds * ds / t.cos();
            }
        }
        let [least, most] = press.volume_m3;
        prop_assert!(volume >= least * (1.0 - 2e-3) - 1e-9 && volume <= most * (1.0 + 2e-3) + 1e-9, "{volume} {press:?}");
        prop_assert!(deepest <= press.deepest_m[1] + 1e-12);
        prop_assert!(twist <= press.twist_m4 * (1.0 + 3e-3) + 1e-12);
        prop_assert!(turn <= press.holder.turn_m4 * (1.0 + 3e-3) + 1e-12);
        prop_assert!(volume / t.cos() <= press.holder.normal_m3 * (1.0 + 2e-3) + 1e-9);
    }
}
