//! Bounds of a sponge on a plate over a stretch of time, against sums over its face at moments of it, column by column by halving.

use nalgebra::{Rotation3, Unit, Vector3};
use platewash_bodies::contact::*;
use platewash_workcell::surface::{SHIPPED_PROFILES, Surface};
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use std::f64::consts::{PI, TAU};

const FOUNDATION: Foundation = Foundation {
    radius_m: 0.025,
    free_height_m: 0.025,
    compression_m: 0.005,
    stiffness_pa: [1.1e4, 4.4e4],
};

/// Height by which the plate may lie higher or lower \[m\].
const ERROR_M: f64 = 1e-3;

/// Rings and sectors of the sums, and the error of the sums relative to the whole face pressed as deep as its deepest column.
const RINGS: u32 = 40;

const SECTORS: u32 = 90;

const OFF: f64 = 4e-3;

fn surface(profile: usize) -> Surface {
    let name = SHIPPED_PROFILES.get(profile);
    name.map_or(Surface::Disc { radius_m: 0.145 }, |name| {
        Surface::shipped(name).unwrap()
    })
}

/// Returns a pose `over_m` above a place of a surface, given by its share of the radius and its azimuth, tilted from the axis there.
fn over(surface: &Surface, [share, azimuth]: [f64; 2], over_m: f64, [tilt, lean]: [f64; 2]) -> SpongePose {
    let rho = share * surface.rim_m();
    let (s, c) = lean.sin_cos();
    SpongePose {
        tip: surface.point(rho, azimuth).coords + Vector3::z() * over_m,
        axis: Vector3::new(tilt.sin() * c, tilt.sin() * s, -tilt.cos()),
    }
}

/// Returns the length along a line at which it meets a surface that lies `up_m` higher, and the cosine against its normal there; by
/// halving.
fn meets(surface: &Surface, start: &Vector3<f64>, axis: &Vector3<f64>, up_m: f64) -> (f64, f64, f64) {
    let place = |along: f64| start + axis * along;
    let rho = |point: &Vector3<f64>| point.xy().norm();
    let (mut near, mut far) = (-0.2, 0.2);
    for _ in 0..45 {
        let middle = 0.5 * (near + far);
        let point = place(middle);
        if point.z - up_m > surface.height_m(rho(&point)) {
            near = middle;
        } else {
            far = middle;
        }
    }
    let point = place(near);
    let at = surface.at_radius(rho(&point));
    let out = point.xy() / rho(&point).max(1e-12);
    let normal = Vector3::new(-at.sine * out.x, -at.sine * out.y, at.cosine);
    (near, -normal.dot(axis), rho(&point))
}

/// Volume, greatest compression and twist of a pose on a plate that lies `up_m` higher.
fn summed(surface: &Surface, pose: &SpongePose, up_m: f64) -> [f64; 3] {
    let s = FOUNDATION.radius_m;
    let u = pose.axis.cross(&Vector3::new(0.3, 0.9, 0.1)).normalize();
    let v = pose.axis.cross(&u);
    let [mut volume, mut deepest, mut twist] = [0.0, f64::NEG_INFINITY, 0.0];
    for ring in 0..RINGS {
        let r = s * (f64::from(ring) + 0.5) / f64::from(RINGS);
        let area = TAU * r * s / f64::from(RINGS) / f64::from(SECTORS);
        for sector in 0..SECTORS {
            let (sin, cos) = (TAU * f64::from(sector) / f64::from(SECTORS)).sin_cos();
            let start = pose.tip + (u * cos + v * sin) * r;
            let (along, cosine, rho) = meets(surface, &start, &pose.axis, up_m);
            if rho > surface.rim_m() {
                continue;
            }
            let w = FOUNDATION.compression_m - along;
            deepest = f64::max(deepest, w);
            volume += w.max(0.0) * area;
            twist += w.max(0.0) * r / cosine * area;
        }
    }
    [volume, deepest, twist]
}

/// Checks that the load at a moment is within the bounds, for plate heights within the error.
fn is_within(surface: &Surface, pose: &SpongePose, press: &Press) -> TestCaseResult {
    let area = PI * FOUNDATION.radius_m * FOUNDATION.radius_m;
    for up in [-1.0, 0.4, 1.0] {
        let [volume, deepest, twist] = summed(surface, pose, up * ERROR_M);
        let off = OFF * area * deepest.max(0.0) + 1e-12;
        let [least, most] = press.volume_m3;
        prop_assert!(volume >= least - off && volume <= most + off, "{volume} {press:?}");
        prop_assert!(deepest <= press.deepest_m + 1e-9, "{deepest} {press:?}");
        prop_assert!(
            twist <= press.twist_m4 + off * FOUNDATION.radius_m * 2.0,
            "{twist} {press:?}"
        );
    }
    Ok(())
}

/// Returns a direction across a pose's axis.
fn across(pose: &SpongePose) -> Vector3<f64> {
    pose.axis
        .cross(&Vector3::new(0.2, -0.1, 0.4))
        .cross(&pose.axis)
        .normalize()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// At a moment, on a disc and on every profile.
    #[test]
    fn the_load_at_a_moment_agrees_with_the_sum_of_columns(
        profile in 0..5usize, place in [0.0..1.0f64, 0.0..TAU], up in -3e-3..6e-3f64, lean in [0.0..0.52f64, 0.0..TAU], many: bool,
    ) {
        let surface = surface(profile);
        let bends = Bends::new(&surface);
        let columns = if many { Columns::fine(&FOUNDATION) } else { Columns::new(&FOUNDATION) };
        let pose = over(&surface, place, up, lean);
        let standing = columns.sponge_state(&bends, &pose, &across(&pose), ERROR_M);
        let (seen, press) = columns.load_at(&bends, &standing);
        is_within(&surface, &pose, &press)?;
        let [low, high] = [-1.0, 1.0].map(|up| summed(&surface, &pose, up * ERROR_M));
        let off = OFF * PI * FOUNDATION.radius_m * FOUNDATION.radius_m * high[1].max(0.0) + 1e-12;
        prop_assert!(low[0] <= seen.volume_m3[0] + off && high[0] >= seen.volume_m3[1] - off, "{low:?} {high:?} {seen:?}");
        // A column of the sums may stand as far from it as they are apart.
        prop_assert!(high[1] >= seen.deepest_m - 1.5e-3, "{high:?} {seen:?}");
    }

    /// Checks the bounds over a stretch in which the sponge moves, accelerates and turns, at any moment of it, with columns that turn with
    /// it.
    #[test]
    fn the_load_between_moments_agrees_with_the_sum_of_columns(
        profile in 0..5usize, place in [0.0..1.0f64, 0.0..TAU], up in -2e-3..3e-3f64, lean in [0.0..0.52f64, 0.0..TAU],
        speed in prop::array::uniform3(-0.2..0.2f64), acceleration in prop::array::uniform3(-2.0..2.0f64),
        turning in prop::array::uniform3(-1.5..1.5f64), length_s in 1e-3..3e-2f64, share in 0.0..1.0f64,
    ) {
        let surface = surface(profile);
        let bends = Bends::new(&surface);
        let columns = Columns::new(&FOUNDATION);
        let start = over(&surface, place, up, lean);
        let [v, a, w] = [speed, acceleration, turning].map(Vector3::from);
        let side = across(&start);
        let at = |t: f64| {
            let turn = Rotation3::from_axis_angle(&Unit::new_normalize(w), w.norm() * t);
            let pose = SpongePose { tip: start.tip + v * t + a * (0.5 * t * t), axis: turn * start.axis };
            (pose, turn * side)
        };
        let drift = Drift {
            length_s,
            tip_m_s: v.norm().max((v + a * length_s).norm()),
            tip_m_s2: a.norm(),
            turning: w.norm(),
            axis: w.cross(&start.axis).norm(),
            bending: w.norm_squared(),
        };
        let [from, to] = [0.0, length_s].map(|t| {
            let (pose, side) = at(t);
            columns.sponge_state(&bends, &pose, &side, ERROR_M)
        });
        let press = columns.bound_load(&bends, [&from, &to], &drift);
        is_within(&surface, &at(share * length_s).0, &press)?;
        // Of the parts those that touch are named.
        let touches = summed(&surface, &at(share * length_s).0, ERROR_M)[1] >= 0.0;
        let touching = columns.touching(&bends, [&from, &to], &drift);
        prop_assert!(!touches || touching.is_none_or(|parts| !parts.is_empty()));
    }

    /// Little is lost across the face: the bounds at a moment are near the values.
    #[test]
    fn bounds_at_a_moment_are_close_to_the_load(profile in 0..5usize, place in [0.05..0.75f64, 0.0..TAU], tilt in -0.1..0.1f64) {
        let surface = surface(profile);
        let bends = Bends::new(&surface);
        let [share, azimuth] = place;
        let normal = surface.normal(share * surface.rim_m(), azimuth);
        let point = surface.point(share * surface.rim_m(), azimuth).coords;
        let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), tilt);
        let pose = SpongePose { tip: point, axis: -(turn * normal.into_inner()) };
        let columns = Columns::fine(&FOUNDATION);
        let (_, press) = columns.load_at(&bends, &columns.sponge_state(&bends, &pose, &across(&pose), 0.0));
        let [volume, deepest, twist] = summed(&surface, &pose, 0.0);
        let [least, most] = press.volume_m3;
        prop_assert!(most - volume < 0.05 * volume && volume - least < 0.08 * volume, "{volume} {press:?}");
        // The deepest of the sums stands inside the rim of the sponge's face, by half a ring and half a sector.
        prop_assert!(press.deepest_m - deepest < 1e-3 + 0.1 * deepest, "{deepest} {press:?}");
        prop_assert!(press.twist_m4 < 1.15 * twist, "{twist} {press:?}");
    }
}

/// Nothing is claimed where nothing is known: for a tool that lies along the face, one that flies, and a place that is NaN.
#[test]
fn gives_no_bounds_for_columns_that_miss_the_plate() {
    let surface = surface(0);
    let (bends, columns) = (Bends::new(&surface), Columns::new(&FOUNDATION));
    let lying = over(&surface, [0.5, 0.0], 0.0, [0.5 * PI, 0.0]);
    let nowhere = SpongePose {
        tip: Vector3::repeat(f64::NAN),
        axis: -Vector3::z(),
    };
    for pose in [lying, nowhere] {
        let standing = columns.sponge_state(&bends, &pose, &Vector3::y(), ERROR_M);
        let (_, press) = columns.load_at(&bends, &standing);
        assert_eq!(press.volume_m3, [0.0, f64::INFINITY], "{press:?}");
        assert_eq!(press.deepest_m, f64::INFINITY);
    }
    let upright = over(&surface, [0.5, 0.0], 0.0, [0.0, 0.0]);
    let standing = columns.sponge_state(&bends, &upright, &Vector3::y(), ERROR_M);
    let unknown = Drift {
        tip_m_s: f64::NAN,
        length_s: 0.01,
        ..Drift::NONE
    };
    let press = columns.bound_load(&bends, [&standing; 2], &unknown);
    assert_eq!(press.volume_m3, [0.0, f64::INFINITY], "{press:?}");
}
