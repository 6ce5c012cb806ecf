//! Forward kinematics of four configurations at once, and the columns of their Jacobians.

use crate::batch::chain::{Bend, Chain, Link};
use crate::joints::{AXES, JointVector};
use crate::lanes::{LANES, Vector};
use crate::trig::sin_cos_vector;

/// Frames: columns of the rotation, and the origin \[m\].
#[derive(Clone, Copy)]
pub(crate) struct Tips<V> {
    pub x: [V; 3],
    pub y: [V; 3],
    pub z: [V; 3],
    pub p: [V; 3],
}

/// Axis of a joint, and a point on it \[m\].
#[derive(Clone, Copy)]
pub(crate) struct Line<V> {
    pub axis: [V; 3],
    pub point: [V; 3],
}

/// Returns the lines of joints beyond the frame: zero, so that their columns are zero.
#[inline(always)]
pub(crate) fn no_lines<V: Vector>() -> [Line<V>; AXES] {
    let zero = [V::splat(0.0); 3];
    [Line {
        axis: zero,
        point: zero,
    }; AXES]
}

/// Gathers at most four configurations side by side; unused lanes repeat the last one.
#[inline(always)]
pub(crate) fn gather<V: Vector>(configurations: &[JointVector]) -> [V; AXES] {
    let last = configurations.len() - 1;
    let (mut first, mut rest) = ([V::splat(0.0); LANES], [V::splat(0.0); LANES]);
    for l in 0..LANES {
        let q = configurations[l.min(last)];
        first[l] = V::from_array([q[0], q[1], q[2], q[3]]);
        rest[l] = V::from_array([q[2], q[3], q[4], q[5]]);
    }
    let ([a, b, c, d], [_, _, e, f]) = (V::transposed(first), V::transposed(rest));
    [a, b, c, d, e, f]
}

/// Converts arrays of lanes to vectors.
#[inline(always)]
pub(crate) fn vectors<V: Vector, const N: usize>(rows: &[[f64; LANES]; N]) -> [V; N] {
    let mut out = [V::splat(0.0); N];
    for i in 0..N {
        out[i] = V::from_array(rows[i]);
    }
    out
}

/// Computes the poses of the chain's frame at `q` \[rad\]. A lane with NaN or ∞ in a joint of the chain becomes NaN throughout.
#[inline(always)]
pub(crate) fn frames<V: Vector>(chain: &Chain, q: &[V; AXES]) -> Tips<V> {
    let turns = sines_and_cosines(chain, q);
    let mut tips = start(chain);
    for (link, &(sin, cos)) in chain.links.iter().zip(&turns) {
        tips = advance(tips, sin, cos, link);
    }
    finish(tips, chain)
}

/// Same as [`frames`], with the lines of the chain's joints.
#[inline(always)]
pub(crate) fn frames_and_lines<V: Vector>(chain: &Chain, q: &[V; AXES], lines: &mut [Line<V>; AXES]) -> Tips<V> {
    let turns = sines_and_cosines(chain, q);
    let mut tips = start(chain);
    for ((link, &(sin, cos)), line) in chain.links.iter().zip(&turns).zip(lines) {
        *line = Line {
            axis: tips.z,
            point: tips.p,
        };
        tips = advance(tips, sin, cos, link);
    }
    finish(tips, chain)
}

/// Linear part of a Jacobian's column, `z_i × (p − p_i)`.
#[inline(always)]
pub(crate) fn moment<V: Vector>(line: &Line<V>, p: &[V; 3]) -> [V; 3] {
    let arm = [p[0] - line.point[0], p[1] - line.point[1], p[2] - line.point[2]];
    cross(&line.axis, &arm)
}

/// `a × b`.
#[inline(always)]
pub(crate) fn cross<V: Vector>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    [
        a[1].mul_sub(b[2], a[2] * b[1]),
        a[2].mul_sub(b[0], a[0] * b[2]),
        a[0].mul_sub(b[1], a[1] * b[0]),
    ]
}

/// `a · b`.
#[inline(always)]
pub(crate) fn dot<V: Vector>(a: &[V; 3], b: &[V; 3]) -> V {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

#[inline(always)]
fn start<V: Vector>(chain: &Chain) -> Tips<V> {
    let (r, t) = (&chain.start.rotation, &chain.start.translation);
    Tips {
        x: [V::splat(r.m11), V::splat(r.m21), V::splat(r.m31)],
        y: [V::splat(r.m12), V::splat(r.m22), V::splat(r.m32)],
        z: [V::splat(r.m13), V::splat(r.m23), V::splat(r.m33)],
        p: [V::splat(t.x), V::splat(t.y), V::splat(t.z)],
    }
}

/// Sines and cosines of all joint angles `q + o`.
#[inline(always)]
fn sines_and_cosines<V: Vector>(chain: &Chain, q: &[V; AXES]) -> [(V, V); AXES] {
    let mut turns = [(V::splat(0.0), V::splat(0.0)); AXES];
    for i in 0..AXES {
        turns[i] = sin_cos_vector(q[i] + V::splat(chain.offsets[i]));
    }
    turns
}

/// Applies one joint and the transform after it: `Rz(θ) · Trans(t) · Rx(α)`.
#[inline(always)]
fn advance<V: Vector>(mut tips: Tips<V>, sin: V, cos: V, link: &Link) -> Tips<V> {
    let t = &link.translation;
    let (tx, ty, tz) = (V::splat(t[0]), V::splat(t[1]), V::splat(t[2]));
    match link.bend {
        Bend::Parallel => {
            (tips.x, tips.y) = turned(&tips.x, &tips.y, sin, cos);
            tips.p = moved(&tips.p, &tips.x, tx);
        }
        Bend::Perpendicular => {
            // The new z axis is minus the turned y axis, the new y axis the old z axis.
            let (z, x) = turned(&tips.x, &tips.y, V::splat(0.0) - cos, sin);
            tips.p = moved(&moved(&tips.p, &tips.z, tz), &x, tx);
            (tips.x, tips.y, tips.z) = (x, tips.z, z);
        }
        Bend::General {
            sin: bend_sin,
            cos: bend_cos,
        } => {
            (tips.x, tips.y) = turned(&tips.x, &tips.y, sin, cos);
            tips.p = moved(&moved(&moved(&tips.p, &tips.x, tx), &tips.y, ty), &tips.z, tz);
            (tips.y, tips.z) = turned(&tips.y, &tips.z, V::splat(bend_sin), V::splat(bend_cos));
        }
    }
    tips
}

/// Returns (u cos + v sin, v cos − u sin).
#[inline(always)]
fn turned<V: Vector>(u: &[V; 3], v: &[V; 3], sin: V, cos: V) -> ([V; 3], [V; 3]) {
    let [(u0, v0), (u1, v1), (u2, v2)] = [
        turned_row(u[0], v[0], sin, cos),
        turned_row(u[1], v[1], sin, cos),
        turned_row(u[2], v[2], sin, cos),
    ];
    ([u0, u1, u2], [v0, v1, v2])
}

#[inline(always)]
fn turned_row<V: Vector>(u: V, v: V, sin: V, cos: V) -> (V, V) {
    (u.mul_add(cos, v * sin), v.mul_sub(cos, u * sin))
}

/// a + b.
#[inline(always)]
fn sum<V: Vector>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// p + d · by.
#[inline(always)]
fn moved<V: Vector>(p: &[V; 3], d: &[V; 3], by: V) -> [V; 3] {
    [d[0].mul_add(by, p[0]), d[1].mul_add(by, p[1]), d[2].mul_add(by, p[2])]
}

/// Applies the last constant turn, and sets NaN where a joint position is not finite.
#[inline(always)]
fn finish<V: Vector>(mut tips: Tips<V>, chain: &Chain) -> Tips<V> {
    if let Some((sin, cos)) = chain.end {
        (tips.x, tips.y) = turned(&tips.x, &tips.y, V::splat(sin), V::splat(cos));
    }
    // Once NaN, the x axis stays NaN: every turn mixes it into itself. x · 0 is 0 or NaN.
    let nothing = tips.x[0] * V::splat(0.0);
    let (Tips { x, y, z, p }, one) = (tips, [nothing; 3]);
    Tips {
        x: sum(&x, &one),
        y: sum(&y, &one),
        z: sum(&z, &one),
        p: sum(&p, &one),
    }
}
