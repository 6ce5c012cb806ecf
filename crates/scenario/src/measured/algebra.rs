//! Linear algebra of small systems, moments and medians.

use nalgebra::{Matrix3, Vector3};

/// Moments of weighted points.
pub(super) struct Moments {
    /// Sum of the weights.
    pub size: f64,
    /// Mean.
    pub middle: Vector3<f64>,
    /// Mean squares along the principal directions, from the least to the greatest, and the directions.
    pub spread: [(f64, Vector3<f64>); 3],
}

impl Moments {
    /// Returns the moments of points.
    pub fn from_points<I: Iterator<Item = (Vector3<f64>, f64)>>(points: impl Fn() -> I) -> Self {
        let (size, sum) = points().fold((0.0, Vector3::zeros()), |(size, sum), (p, w)| (size + w, sum + p * w));
        let middle = sum / size;
        let mut squares = Matrix3::zeros();
        points().for_each(|(p, w)| squares += (p - middle) * (p - middle).transpose() * (w / size));
        Self {
            size,
            middle,
            spread: principal(squares),
        }
    }
}

/// Eigenvalues and eigenvectors of a symmetric matrix, from the least to the greatest.
fn principal(m: Matrix3<f64>) -> [(f64, Vector3<f64>); 3] {
    let eigen = m.symmetric_eigen();
    let mut all = [0, 1, 2].map(|k| (eigen.eigenvalues[k], Vector3::from(eigen.eigenvectors.column(k))));
    all.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    all
}

/// Solves linear equations with a positive definite matrix, of which the lower half is read, by Cholesky's method in place; the right side
/// becomes the solution. Returns false if the matrix is not positive definite.
pub(super) fn cholesky(n: &mut [f64], g: &mut [f64]) -> bool {
    let size = g.len();
    for i in 0..size {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| n[size * i + k] * n[size * j + k]).sum();
            let rest = n[size * i + j] - sum;
            if i == j && (rest.is_nan() || rest <= 0.0) {
                return false;
            }
            n[size * i + j] = if i == j { rest.sqrt() } else { rest / n[size * j + j] };
        }
        let sum: f64 = (0..i).map(|k| n[size * i + k] * g[k]).sum();
        g[i] = (g[i] - sum) / n[size * i + i];
    }
    for i in (0..size).rev() {
        let sum: f64 = (i + 1..size).map(|k| n[size * k + i] * g[k]).sum();
        g[i] = (g[i] - sum) / n[size * i + i];
    }
    true
}

/// Median; 0 of nothing.
pub(super) fn median(mut all: Vec<f64>) -> f64 {
    let middle = all.len() / 2;
    match all.is_empty() {
        true => 0.0,
        false => *all.select_nth_unstable_by(middle, f64::total_cmp).1,
    }
}
