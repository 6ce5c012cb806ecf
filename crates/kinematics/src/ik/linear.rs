//! The 6 × 6 symmetric positive definite system of every damped step, by LDLᵀ without square roots.

use nalgebra::{Matrix6, Vector6};

const N: usize = 6;

/// Solves `A x = b` for symmetric positive definite `A` (its lower triangle is read); `None` when a pivot is not positive
/// (an indefinite matrix, or NaN).
///
/// `A = L D Lᵀ` column by column, then two triangular solves (Golub & Van Loan, *Matrix Computations*, §4.1.2). One
/// division per pivot; the bounds are constants, so that the compiler unrolls everything.
#[inline]
pub(super) fn solve_spd(a: &Matrix6<f64>, b: &Vector6<f64>) -> Option<Vector6<f64>> {
    let mut l = *a;
    let mut inverse = [0.0; N];
    for j in 0..N {
        let pivot = l[(j, j)];
        // Written so that NaN fails too.
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        inverse[j] = 1.0 / pivot;
        for i in j + 1..N {
            let scaled = l[(i, j)] * inverse[j];
            for k in j + 1..=i {
                l[(i, k)] -= scaled * l[(k, j)];
            }
        }
    }
    // Column j of `l` below the diagonal now holds L times the pivot.
    let mut x = *b;
    for j in 0..N {
        let y = x[j] * inverse[j];
        for i in j + 1..N {
            x[i] -= l[(i, j)] * y;
        }
    }
    for j in (0..N).rev() {
        let mut sum = x[j];
        for i in j + 1..N {
            sum -= l[(i, j)] * x[i];
        }
        x[j] = sum * inverse[j];
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn agrees_with_a_general_solver(entries in prop::collection::vec(-1.0..1.0f64, 36), b in prop::collection::vec(-1.0..1.0f64, 6)) {
            let m = Matrix6::from_row_slice(&entries);
            let a = m.tr_mul(&m) + Matrix6::from_diagonal_element(1e-3);
            let b = Vector6::from_row_slice(&b);
            let expected = a.lu().solve(&b).ok_or_else(|| TestCaseError::fail("singular"))?;
            let x = solve_spd(&a, &b).ok_or_else(|| TestCaseError::fail("not positive"))?;
            prop_assert!((x - expected).amax() < 1e-9 * (1.0 + expected.amax()));
        }
    }

    #[test]
    fn refuses_what_is_not_positive_definite() {
        let mut a = Matrix6::identity();
        a[(3, 3)] = -1.0;
        assert_eq!(solve_spd(&a, &Vector6::zeros()), None);
        a[(3, 3)] = f64::NAN;
        assert_eq!(solve_spd(&a, &Vector6::zeros()), None);
    }
}
