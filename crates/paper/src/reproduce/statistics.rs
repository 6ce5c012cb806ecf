//! Estimates with sampling errors.

/// Most batches that layouts are divided into.
const BATCHES: usize = 20;

/// Quantiles 0.975 of Student's t by degrees of freedom 3 … 19.
const T_975: [f64; 17] = [
    3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101,
    2.093,
];

/// A value with the half-width of its 95 % interval, where there is one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    pub value: f64,
    pub half_width_95: Option<f64>,
}

impl Estimate {
    /// A value without a sampling error.
    pub fn exact(value: f64) -> Self {
        Self {
            value,
            half_width_95: None,
        }
    }
}

/// A statistic of all samples, with its error from the spread of the same statistic over batches of samples
/// (batch means; fewer than 8 samples give no error).
pub(super) fn batch_means<T>(samples: &[T], statistic: impl Fn(&[T]) -> f64) -> Estimate {
    let batches = BATCHES.min(samples.len() / 2);
    let half_width_95 = (batches >= 4).then(|| {
        let bound = |k: usize| k * samples.len() / batches;
        let values: Vec<f64> = (0..batches)
            .map(|k| statistic(&samples[bound(k)..bound(k + 1)]))
            .collect();
        let mean = values.iter().sum::<f64>() / batches as f64;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (batches - 1) as f64;
        T_975[batches - 4] * (variance / batches as f64).sqrt()
    });
    Estimate {
        value: statistic(samples),
        half_width_95,
    }
}

/// Share of successes in percent, with the larger side of Wilson's 95 % interval (1927), which is honest at 0 and 1 too.
pub(super) fn binomial_percent(successes: usize, trials: usize) -> Estimate {
    const Z: f64 = 1.96;
    let n = trials.max(1) as f64;
    let share = successes as f64 / n;
    let centre = (share + Z * Z / (2.0 * n)) / (1.0 + Z * Z / n);
    let half = Z / (1.0 + Z * Z / n) * (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
    Estimate {
        value: 100.0 * share,
        half_width_95: (trials > 1).then_some(100.0 * ((centre - share).abs() + half)),
    }
}

/// Root mean square; 0 without values.
pub(super) fn root_mean_square(values: &[f64]) -> f64 {
    f64::sqrt(values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64)
}

/// The value below which the given share lies (linear between order statistics); 0 without values.
pub(super) fn percentile(values: &[f64], share: f64) -> f64 {
    let mut values = values.to_vec();
    values.sort_unstable_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else {
        return 0.0;
    };
    let place = share * last as f64;
    let below = (place as usize).min(last);
    let above = (below + 1).min(last);
    values[below] + (values[above] - values[below]) * (place - below as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_agree_with_hand_calculation() {
        assert_eq!(percentile(&[3.0, 1.0, 2.0], 0.5), 2.0);
        assert_eq!(percentile(&[0.0, 10.0], 0.95), 9.5);
        assert_eq!(percentile(&[], 0.5), 0.0);
    }

    #[test]
    fn batch_means_give_the_error_of_a_mean() {
        // 400 values 0 and 1 in turn, in batches of 20 each of mean 1/2: no spread. Sorted: a large one.
        let mean = |batch: &[f64]| batch.iter().sum::<f64>() / batch.len() as f64;
        let alternating: Vec<f64> = (0..400).map(|k| f64::from(k % 2)).collect();
        assert_eq!(
            batch_means(&alternating, mean),
            Estimate {
                value: 0.5,
                half_width_95: Some(0.0)
            }
        );
        let sorted: Vec<f64> = (0..400).map(|k| f64::from(k / 200)).collect();
        let expected = 2.093 * (0.25 * 20.0 / 19.0 / 20.0_f64).sqrt();
        assert!((batch_means(&sorted, mean).half_width_95.unwrap() - expected).abs() < 1e-12);
        assert_eq!(batch_means(&sorted[..6], mean).half_width_95, None);
    }

    #[test]
    fn binomial_errors_agree_with_hand_calculation() {
        let e = binomial_percent(50, 100);
        assert_eq!(e.value, 50.0);
        // Wilson's interval for 50 of 100 is 0.4038 … 0.5962.
        assert!((e.half_width_95.unwrap() - 9.617).abs() < 0.01);
        // For 0 of 100 it reaches up to 0.0370.
        assert!((binomial_percent(0, 100).half_width_95.unwrap() - 3.70).abs() < 0.01);
    }
}
