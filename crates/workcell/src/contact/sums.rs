//! The dose of any place over any run of moments, by sums.
//!
//! Between two moments h apart the compression at a point x is at least a line in time less its sag, and the way that the sponge slides is
//! at least that in one direction d, another line less its sag: w(x) = (c + p·a) − a·x and v(x) = d·P(ṗ + ω × (x − p)), both affine in x.
//! Where w is not below 0 their product is not above that of what they stand for, whatever the sign of v, and its integral
//!
//! h ((w₀ + w₁)(v₀ + v₁)/4 + (w₁ − w₀)(v₁ − v₀)/12)
//!
//! is a polynomial of the second degree in x. So one sum from the first moment on tells the dose of every place that is in contact all
//! along a run, as the difference of two.

use super::Foundation;
use super::moment::{Moment, Sags};
use nalgebra::{Matrix3, Vector3};
use std::ops::{Add, AddAssign, Sub};

/// A polynomial of the second degree in the place: k + l·x + xᵀ Q x \[Pa·m\].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Polynomial {
    constant: f64,
    linear: Vector3<f64>,
    square: Matrix3<f64>,
}

/// Affine in the place: k + l·x.
#[derive(Clone, Copy)]
struct Affine {
    constant: f64,
    linear: Vector3<f64>,
}

/// The sums of doses from the first moment on.
#[derive(Debug)]
pub(super) struct Sums {
    sums: Vec<Polynomial>,
    /// What rounding may have made of any difference of two of them, over the plate \[Pa·m\].
    rounding: f64,
}

impl Sums {
    /// Those of some moments, the places no farther than `far_m` from the origin.
    pub fn new(foundation: &Foundation, (moments, sags): (&[Moment], &[Sags]), far_m: f64) -> Self {
        let mut sums = vec![Polynomial::default()];
        let (mut sum, mut size) = (Polynomial::default(), 0.0);
        for (pair, sags) in moments.windows(2).zip(sags) {
            let part = Polynomial::of_pair(foundation, [&pair[0], &pair[1]], sags);
            // What is not known belongs to pairs that are in no run.
            if part.size(far_m).is_finite() {
                sum += part;
                size += part.size(far_m);
            }
            sums.push(sum);
        }
        // Each of n sums of some ten products is off by no more than some 10 n units of its last place.
        let rounding = 1e-15 * (10.0 + sums.len() as f64) * size;
        Self { sums, rounding }
    }

    /// The dose between two moments, `from` not after `to`.
    pub fn between(&self, from: u32, to: u32) -> Polynomial {
        match (self.sums.get(from as usize), self.sums.get(to as usize)) {
            (Some(from), Some(to)) => *to - *from,
            _ => Polynomial::default(),
        }
    }

    /// What rounding may have made of it \[Pa·m\].
    pub const fn rounding(&self) -> f64 {
        self.rounding
    }
}

impl Polynomial {
    fn of_pair(foundation: &Foundation, ends: [&Moment; 2], sags: &Sags) -> Self {
        let whole_s = ends[1].t_s - ends[0].t_s;
        let slides = ends.map(|end| across(&end.speed, &end.pose.axis));
        let direction = (slides[0] + slides[1])
            .try_normalize(0.0)
            .unwrap_or_else(Vector3::zeros);
        let [w0, w1] = ends.map(|end| Affine {
            constant: foundation.compression_m + end.pose.tip.dot(&end.pose.axis) - sags.compression_m,
            linear: -end.pose.axis,
        });
        let [v0, v1] = ends.map(|end| {
            let direction = across(&direction, &end.pose.axis);
            // d·(ω × x) = (d × ω)·x.
            let linear = direction.cross(&end.turning);
            let constant = direction.dot(&end.speed) - linear.dot(&end.pose.tip) - sags.slide_m / whole_s;
            Affine { constant, linear }
        });
        let pressure = foundation.stiffness_pa[0] / foundation.free_height_m;
        let [even, odd] = [w0 + w1, w1 + w0.times(-1.0)];
        let [v_even, v_odd] = [v0 + v1, v1 + v0.times(-1.0)];
        even.times(0.25 * pressure * whole_s).product(&v_even) + odd.times(pressure * whole_s / 12.0).product(&v_odd)
    }

    /// Its value at a place, and its gradient there.
    pub fn at(&self, place: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let turned = self.square * place;
        (
            self.constant + self.linear.dot(place) + place.dot(&turned),
            self.linear + turned + self.square.transpose() * place,
        )
    }

    /// By how much it may be off the line through a place, `away_m` from it.
    pub fn bend(&self, away_m: f64) -> f64 {
        self.square.norm() * away_m * away_m
    }

    fn size(&self, far_m: f64) -> f64 {
        self.constant.abs() + self.linear.norm() * far_m + self.bend(far_m)
    }
}

/// What of a vector is across an axis.
fn across(v: &Vector3<f64>, axis: &Vector3<f64>) -> Vector3<f64> {
    v - axis * v.dot(axis)
}

impl Affine {
    fn times(self, scale: f64) -> Self {
        Self {
            constant: self.constant * scale,
            linear: self.linear * scale,
        }
    }

    fn product(&self, other: &Self) -> Polynomial {
        Polynomial {
            constant: self.constant * other.constant,
            linear: self.linear * other.constant + other.linear * self.constant,
            square: self.linear * other.linear.transpose(),
        }
    }
}

impl Add for Affine {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            constant: self.constant + other.constant,
            linear: self.linear + other.linear,
        }
    }
}

impl Add for Polynomial {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            constant: self.constant + other.constant,
            linear: self.linear + other.linear,
            square: self.square + other.square,
        }
    }
}

impl Sub for Polynomial {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            constant: self.constant - other.constant,
            linear: self.linear - other.linear,
            square: self.square - other.square,
        }
    }
}

impl AddAssign for Polynomial {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
