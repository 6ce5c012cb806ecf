//! Bounds over a cell against dense sums at points of it, for a sponge that goes along an arc while it turns.

use crate::washing::face_shares::bounds::{CellAmounts, Passes, Scratch};
use crate::washing::face_shares::face_cell::FaceCell;
use crate::washing::face_shares::sags::Sags;
use crate::washing::face_shares::{Fineness, shares};
use nalgebra::{Rotation3, Unit, Vector3};
use platewash_bodies::contact::{Foundation, Moment, SpongePose};
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::surface::{SHIPPED_PROFILES, Surface};
use proptest::prelude::*;

const SPONGE: Foundation = Foundation {
    radius_m: 0.025,
    free_height_m: 0.03,
    compression_m: 0.006,
    stiffness_pa: [1.1e4, 4.4e4],
};

const WANTED: ContactThresholds = ContactThresholds {
    compression_m: 1e-3,
    height_error_m: 1e-3,
    time_s: 0.05,
    dose_pa_m: 25.0,
};

const SPEED_M_S: f64 = 0.25;

/// A sponge on an arc at the distance `radius_m` from a plate's axis, at an even height, its axis turning evenly.
#[derive(Debug, Clone, Copy)]
struct Pass {
    radius_m: f64,
    height_m: f64,
    axis: Vector3<f64>,
    turning: Vector3<f64>,
}

impl Pass {
    fn at(&self, t_s: f64) -> Moment {
        let rate = SPEED_M_S / self.radius_m;
        let (s, c) = (rate * t_s).sin_cos();
        Moment {
            t_s,
            pose: SpongePose {
                tip: Vector3::new(self.radius_m * c, self.radius_m * s, self.height_m),
                axis: Rotation3::from_scaled_axis(self.turning * t_s) * self.axis,
            },
            speed: Vector3::new(-s, c, 0.0) * SPEED_M_S,
            turning: self.turning,
        }
    }

    /// Moments h apart from −0.4 s to 0.4 s, and what may be lost between them, by the bounds of a rigid body.
    fn moments(&self, h: f64) -> (Vec<Moment>, Vec<Sags>) {
        let count = (0.4 / h) as i32;
        let moments: Vec<_> = (-count..=count).map(|k| self.at(f64::from(k) * h)).collect();
        let (v, w) = (SPEED_M_S, self.turning.norm());
        let (a, jerk) = (v * v / self.radius_m, v * v * v / (self.radius_m * self.radius_m));
        let r = SPONGE.radius_m.hypot(SPONGE.free_height_m) + v * h + WANTED.height_error_m;
        let slide = [v + w * r, a + w * v, jerk + w * a];
        let sag = |bend: f64| h * h / 8.0 * bend;
        let sags = Sags {
            compression_m: sag(a + 2.0 * v * w + r * w * w),
            aside_m: sag(a + 2.0 * r * w * w + 4.0 * v * w + 2.0 * r * w * w),
            slide_m: h * sag(slide[2] + 4.0 * w * slide[1] + 4.0 * w * w * slide[0]),
        };
        (moments, vec![sags; 2 * count as usize])
    }

    /// Time and dose of a point, by what it is at many moments.
    fn dense(&self, point: &Vector3<f64>, dt: f64) -> [f64; 2] {
        let mut sum = [0.0; 2];
        let count = (0.4 / dt) as i32;
        for k in -count..count {
            let Moment {
                pose, speed, turning, ..
            } = self.at((f64::from(k) + 0.5) * dt);
            let away = point - pose.tip;
            let along = away.dot(&pose.axis);
            let w = SPONGE.compression_m - along;
            if w >= WANTED.compression_m && (away - pose.axis * along).norm() <= SPONGE.radius_m {
                let slide = speed + turning.cross(&away);
                let slide = slide - pose.axis * slide.dot(&pose.axis);
                sum[0] += dt;
                sum[1] += SPONGE.stiffness_pa[0] / SPONGE.free_height_m * w * slide.norm() * dt;
            }
        }
        sum
    }
}

/// A face and a pass over it: the axis of the sponge near the normal of the face.
fn pass(which: usize, share: f64, lean: [f64; 2], turning: [f64; 3], up_m: f64) -> (Surface, Pass) {
    let surface = match which.checked_sub(1) {
        None => Surface::Disc { radius_m: 0.145 },
        Some(k) => Surface::shipped(SHIPPED_PROFILES[k]).unwrap(),
    };
    let at = surface.at_radius(share * surface.rim_m());
    let slope = 0.7 * at.sine.asin();
    let axis = Vector3::new(slope.sin() + lean[0], lean[1], -slope.cos());
    let pass = Pass {
        radius_m: at.radius_m,
        height_m: at.height_m + up_m,
        axis: Unit::new_normalize(axis).into_inner(),
        turning: Vector3::from(turning),
    };
    (surface, pass)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// No point of a cell, with the plate anywhere within its error, gets less than is said.
    #[test]
    fn no_point_of_a_cell_gets_less_than_its_bounds(
        which in 0..=SHIPPED_PROFILES.len(), share in 0.4..0.9f64, lean in [-0.12..0.12f64, -0.12..0.12f64],
        turning in [-0.4..0.4f64, -0.4..0.4f64, -0.8..0.8f64], up_m in -1e-3..1.5e-3f64, step in 2e-3..8e-3f64,
        place in [-0.03..0.03f64, -0.02..0.02f64], half in 1e-4..2.4e-3f64,
        inside in prop::collection::vec([-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64], 4),
    ) {
        let (surface, pass) = pass(which, share, lean, turning, up_m);
        let (moments, sags) = pass.moments(step);
        let passes = Passes::new(&surface, &SPONGE, (&moments, &sags), &WANTED);
        let middle = [pass.radius_m + place[0], place[1]];
        let cell = FaceCell::new(&surface, middle, half);
        let mut windows = Vec::new();
        passes.windows_near(&cell, &mut windows);
        let mut scratch = Scratch::default();
        let found = passes.bounds(&cell, (CellAmounts::default(), &windows), &mut scratch, |_| [1.0; 3]).unwrap();
        // A quarter that starts from what is known of the whole.
        let windows: Vec<_> = scratch.windows().collect();
        let quarter = [middle[0] + 0.5 * half, middle[1] - 0.5 * half];
        let quartered = FaceCell::new(&surface, quarter, 0.5 * half);
        let again = passes.bounds(&quartered, (found.amounts, &windows), &mut scratch, |_| [1.0; 3]).unwrap();
        let dt = step / 40.0;
        for [x, y, e] in inside.into_iter().chain([[1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]]) {
            for (found, middle, half) in [(&found, middle, half), (&again, quarter, 0.5 * half)] {
                let [dx, dy] = [x * half, y * half];
                let (px, py) = (middle[0] + dx, middle[1] + dy);
                let height_m = surface.height_m(px.hypot(py)) + e * WANTED.height_error_m;
                let dense = pass.dense(&Vector3::new(px, py, height_m), dt);
                let [contact, time, dose] = found.bounds.map(|b| b.value + b.slope[0] * dx + b.slope[1] * dy);
                prop_assert!(contact < 0.0 || dense[0] > 0.0 || contact < 1e-5, "{contact} {dense:?}");
                // The dense sums tell an end of a stay within half a step.
                prop_assert!(time <= dense[0] + 2.0 * dt, "{time} {dense:?}");
                prop_assert!(dose <= dense[1] * (1.0 + 1e-3) + 2.0 * dt * 1.1e4 * 0.3 * 0.25, "{dose} {dense:?}");
            }
        }
    }
}

/// On a disc, of which what is not reached has no more area than it has, small cells lose little.
#[test]
fn small_cells_of_a_disc_lose_little() {
    let (surface, pass) = pass(0, 0.7, [0.02, -0.05], [0.1, -0.2, 0.3], 0.0);
    let (moments, sags) = pass.moments(4e-3);
    let fineness = Fineness {
        cell_m: 2.5e-4,
        enough: [1.0; 3],
    };
    let found = shares(&surface, &SPONGE, (&moments, &sags), &WANTED, &fineness);
    let n = 150;
    let (mut area, mut kept) = (0.0, [0.0; 3]);
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let [x, y] = [i, j].map(|k| (2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0) * surface.rim_m());
        let rho = x.hypot(y);
        if rho > surface.rim_m() {
            continue;
        }
        let at = surface.at_radius(rho);
        let part = 1.0 / at.cosine;
        area += part;
        let way = Vector3::new(x, y, at.height_m) - pass.at(0.0).pose.tip;
        if way.norm() > 0.13 {
            continue;
        }
        let all = [-1e-3, 1e-3].map(|e| pass.dense(&Vector3::new(x, y, at.height_m + e), 1e-3));
        let least = [0, 1].map(|k: usize| all[0][k].min(all[1][k]));
        let wanted = [least[0] > 0.0, least[0] >= WANTED.time_s, least[1] >= WANTED.dose_pa_m];
        (0..3).for_each(|k| kept[k] += part * f64::from(u8::from(wanted[k])));
    }
    for (share, kept) in [found.contact, found.time, found.dose].into_iter().zip(kept) {
        let seen = kept / area;
        assert!(
            share.at_least <= seen + 2e-3 && share.at_least >= seen - 3e-3,
            "{} {seen}",
            share.at_least
        );
    }
}
