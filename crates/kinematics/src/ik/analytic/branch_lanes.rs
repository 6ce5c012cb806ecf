//! Branches side by side in the lanes of vectors. What is rare is left to the search branch by branch: joints that are free, joints that only
//! the second, wider tolerance of the limits admits, and rounded arms with a spherical wrist.

use crate::ik::analytic::branch::Degeneracies;
use crate::ik::analytic::links::{ELBOWS_MEET, Goal, Links};
use crate::ik::analytic::tolerances::{
    FREE_SHOULDER_M, FREE_WRIST_RAD, LIMIT_NEAR_RAD, LIMIT_ROUNDING_RAD, REACH_ROUNDING_M,
};
use crate::ik::analytic::window::Window;
use crate::lanes::{LANES, Vector};
use crate::trig::atan2_vector;
use nalgebra::{Complex, Matrix3};
use std::f64::consts::TAU;

/// Case that the lanes do not treat.
pub(crate) struct Rare;

/// Complex numbers lane by lane.
pub(crate) type Complexes<V> = [V; 2];

/// Joint 1 and the turned plane: lanes 0 and 1 in front, 2 and 3 at the back.
pub(crate) struct Swings<V> {
    /// `e^{iq₁}`, not of unit length: sine, then cosine.
    pub swing: (V, V),
    /// The same of unit length.
    pub unit: (V, V),
    /// Wrist centre in the turned plane, from axis 2.
    pub wrist: Complexes<V>,
    /// Front and back meet.
    pub meets: bool,
}

impl<V: Vector> Swings<V> {
    /// As [`Links::swing`].
    #[inline(always)]
    pub fn new(links: &Links, goal: &Goal) -> Result<Self, Rare> {
        let (w, b) = (&goal.wrist, links.lateral_offset);
        let r = (w.x * w.x + w.y * w.y).sqrt();
        let free = b == 0.0 && r <= FREE_SHOULDER_M;
        if free || r < b.abs() - REACH_ROUNDING_M {
            return Err(Rare);
        }
        let out = ((r - b.abs()) * (r + b.abs())).max(0.0).sqrt();
        let x = V::from_array([out, out, -out, -out]);
        let s = x * V::splat(w.y) - V::splat(b * w.x);
        let c = x * V::splat(w.x) + V::splat(b * w.y);
        let scale = V::splat(1.0) / (s * s + c * c).sqrt();
        Ok(Self {
            swing: (s, c),
            unit: (s * scale, c * scale),
            wrist: [V::splat(w.z), x - V::splat(links.shoulder_offset)],
            meets: out <= ELBOWS_MEET * r,
        })
    }
}

/// Triangles of axis 2, axis 3 and the end of the forearm.
#[derive(Clone, Copy)]
pub(crate) struct Triangles<V> {
    end: Complexes<V>,
    /// Distance of the end from axis 2 \[m\].
    pub distance: V,
    /// `e^{iψ}` with ψ in [0, π].
    pub cosine: V,
    pub sine: V,
    /// Lanes within reach.
    pub reached: V,
}

impl<V: Vector> Triangles<V> {
    /// As [`Links::triangle`].
    #[inline(always)]
    pub fn new(links: &Links, end: Complexes<V>) -> Result<Self, Rare> {
        let ([upper, fore], [longest, shortest]) = (links.lengths, links.reach());
        let distance = squared_norm(end).sqrt();
        if distance.at_most(V::splat(FREE_SHOULDER_M)).sign_bits() != 0 {
            return Err(Rare);
        }
        let near = distance.at_most(V::splat(longest + REACH_ROUNDING_M));
        let reached = near.and(V::splat(shortest - REACH_ROUNDING_M).at_most(distance));
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let share = |product: V| {
            let share = product / V::splat(4.0 * upper * fore);
            let above = zero.if_above(share, zero, share);
            above.if_above(one, one, above)
        };
        let sine_squared = share((V::splat(longest) - distance) * (V::splat(longest) + distance));
        let cosine_squared = share((distance - V::splat(shortest)) * (distance + V::splat(shortest)));
        Ok(Self {
            end,
            distance,
            cosine: cosine_squared - sine_squared,
            sine: V::splat(2.0) * (sine_squared * cosine_squared).sqrt(),
            reached,
        })
    }

    /// Returns the turn of the upper arm from q₂ = 0, not of unit length, as [`Links::bend`].
    #[inline(always)]
    pub fn upper(&self, links: &Links, bent: Complexes<V>) -> Complexes<V> {
        let [upper, fore] = links.lengths;
        let reach = [bent[0] * V::splat(fore) + V::splat(upper), bent[1] * V::splat(fore)];
        product(
            product(self.end, conjugate(reach)),
            conjugate(splat(links.upper_at_zero)),
        )
    }

    /// Returns joints 2 and 3 \[rad\].
    #[inline(always)]
    pub fn joints(&self, links: &Links, turn: Complexes<V>, psi: V) -> [V; 2] {
        let [sign_2, sign_3] = [V::splat(links.signs[0]), V::splat(links.signs[1])];
        [
            sign_2 * atan2_vector(turn[1], turn[0]),
            sign_3 * (psi - V::splat(links.bend_at_zero)),
        ]
    }
}

/// Turns of z–y–z form, as [`Turn::split`](crate::ik::analytic::wrist::Turn::split): sines and cosines, not of unit length.
pub(crate) struct Turns<V> {
    pub first: (V, V),
    /// The first of unit length.
    pub unit: (V, V),
    /// Sine of the second.
    pub sine: V,
    pub second: (V, V),
    pub third: (V, V),
}

impl<V: Vector> Turns<V> {
    /// Splits rotations given by rows. Of the third row only the last entry is used.
    #[inline(always)]
    pub fn new(rotation: &[[V; 3]; 3], reached: V) -> Result<Self, Rare> {
        let [e11, e12, e13] = rotation[0];
        let [e21, e22, e23] = rotation[1];
        let e33 = rotation[2][2];
        let sine = (e13 * e13 + e23 * e23).sqrt();
        if sine.at_most(V::splat(FREE_WRIST_RAD)).and(reached).sign_bits() != 0 {
            return Err(Rare);
        }
        let (s, c) = (e23 / sine, e13 / sine);
        Ok(Self {
            first: (e23, e13),
            unit: (s, c),
            sine,
            second: (c * e13 + s * e23, e33),
            third: (c * e21 - s * e11, c * e22 - s * e12),
        })
    }
}

/// Lanes whose joints are within the limits so far.
#[derive(Clone, Copy)]
pub(crate) struct Within<V> {
    /// Up to [`LIMIT_ROUNDING_RAD`].
    exactly: V,
    /// Up to [`LIMIT_NEAR_RAD`].
    nearly: V,
}

impl<V: Vector> Within<V> {
    #[inline(always)]
    pub fn all() -> Self {
        Self {
            exactly: all_lanes(),
            nearly: all_lanes(),
        }
    }

    /// Returns [`Window::value`] of the angles and takes out the lanes that have none.
    #[inline(always)]
    pub fn value(&mut self, window: &Window<'_>, joint: usize, angle: V) -> V {
        let turns = (V::splat(window.anchor[joint]) - angle) * V::splat(1.0 / TAU);
        let half = turns.and(V::splat(-0.0)).xor(V::splat(0.5));
        let turn = V::splat(TAU);
        let q = angle + turn * (turns + half).truncated();
        let (lower, upper) = (window.limits.lower[joint], window.limits.upper[joint]);
        let (lowest, highest) = (V::splat(lower - LIMIT_NEAR_RAD), V::splat(upper + LIMIT_NEAR_RAD));
        let q = q.if_above(highest, q - turn, lowest.if_above(q, q + turn, q));
        self.nearly = self.nearly.and(lowest.at_most(q)).and(q.at_most(highest));
        let (lowest, highest) = (
            V::splat(lower - LIMIT_ROUNDING_RAD),
            V::splat(upper + LIMIT_ROUNDING_RAD),
        );
        self.exactly = self.exactly.and(lowest.at_most(q)).and(q.at_most(highest));
        q
    }

    /// Returns the lanes that are left, as bits, of those that reach the target.
    #[inline(always)]
    pub fn admitted(&self, reached: V) -> Result<u8, Rare> {
        let [exactly, nearly] = [
            self.exactly.and(reached).sign_bits(),
            self.nearly.and(reached).sign_bits(),
        ];
        if exactly == nearly { Ok(exactly) } else { Err(Rare) }
    }
}

#[inline(always)]
pub(crate) fn splat<V: Vector>(z: Complex<f64>) -> Complexes<V> {
    [V::splat(z.re), V::splat(z.im)]
}

#[inline(always)]
pub(crate) fn conjugate<V: Vector>([re, im]: Complexes<V>) -> Complexes<V> {
    [re, im.xor(V::splat(-0.0))]
}

#[inline(always)]
pub(crate) fn product<V: Vector>(a: Complexes<V>, b: Complexes<V>) -> Complexes<V> {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

#[inline(always)]
pub(crate) fn squared_norm<V: Vector>([re, im]: Complexes<V>) -> V {
    re * re + im * im
}

/// Returns all bits in every lane.
#[inline(always)]
pub(crate) fn all_lanes<V: Vector>() -> V {
    V::splat(0.0).at_most(V::splat(0.0))
}

/// Returns the angles of two pairs of sine and cosine. Front and back have two lanes each, which are the same.
#[inline(always)]
pub(crate) fn angles_of_both<V: Vector>(a: (V, V), b: (V, V)) -> [V; 2] {
    let [s, c] = [of_both(a.0, b.0), of_both(a.1, b.1)];
    let [front, back, front_2, back_2] = atan2_vector(s, c).to_array();
    [
        V::from_array([front, front, back, back]),
        V::from_array([front_2, front_2, back_2, back_2]),
    ]
}

/// Returns lanes 0 and 2 of two vectors, those of the first first.
#[inline(always)]
fn of_both<V: Vector>(a: V, b: V) -> V {
    let ([front, _, back, _], [front_2, _, back_2, _]) = (a.to_array(), b.to_array());
    V::from_array([front, back, front_2, back_2])
}

/// Returns the columns of `Rot_z(−q) R` with the sine and cosine of q.
#[inline(always)]
pub(crate) fn turned<V: Vector>(r: &Matrix3<f64>, swing: (V, V)) -> [[V; 3]; 3] {
    [
        turned_column(r, 0, swing),
        turned_column(r, 1, swing),
        turned_column(r, 2, swing),
    ]
}

#[inline(always)]
fn turned_column<V: Vector>(r: &Matrix3<f64>, column: usize, (s, c): (V, V)) -> [V; 3] {
    let [x, y, z] = [
        V::splat(r[(0, column)]),
        V::splat(r[(1, column)]),
        V::splat(r[(2, column)]),
    ];
    [x * c + y * s, y * c - x * s, z]
}

/// Returns the rows of `K A` for a matrix A given by its columns.
#[inline(always)]
pub(crate) fn times<V: Vector>(k: &Matrix3<f64>, columns: [[V; 3]; 3]) -> [[V; 3]; 3] {
    [
        row_times(k, 0, columns),
        row_times(k, 1, columns),
        row_times(k, 2, columns),
    ]
}

#[inline(always)]
fn row_times<V: Vector>(k: &Matrix3<f64>, row: usize, [first, second, third]: [[V; 3]; 3]) -> [V; 3] {
    let [a, b, d] = [V::splat(k[(row, 0)]), V::splat(k[(row, 1)]), V::splat(k[(row, 2)])];
    [
        a * first[0] + b * first[1] + d * first[2],
        a * second[0] + b * second[1] + d * second[2],
        a * third[0] + b * third[1] + d * third[2],
    ]
}

/// Returns the degeneracies of a lane, given whether front and back meet and the sines of the elbows.
#[inline(always)]
pub(crate) fn degeneracies((shoulder, elbow): (bool, [f64; LANES]), lane: usize) -> Degeneracies {
    Degeneracies {
        shoulder,
        elbow: elbow[lane] <= ELBOWS_MEET,
        wrist: false,
    }
}
