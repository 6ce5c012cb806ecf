//! Knots of a measured profile, by least squares over mean heights at radii.
//!
//! Both the slopes and the radii of the knots are unknowns. With u = sin β, linear between knots, dz = u/cos β dρ and ∂z/∂u = ∫ 1/cos³β
//! times the share of the knot in u. Knots are put in one by one, each at the place where it makes the sum of squares least, and all are moved
//! then; as many stay as the Bayesian information criterion asks for.

use crate::measured::algebra::cholesky;
use crate::measured::bounds::NOISE_M;
use platewash_kinematics::trig::{asin, ln};
use platewash_workcell::surface::{Knot, MOST_KNOTS, Meridian, Surface};

/// Number of rings in which heights are averaged.
pub(super) const RINGS: usize = 256;

/// Share of the rim's radius within which rings count less: they hold few points.
const MIDDLE: f64 = 0.05;

/// Greatest sine of a slope: a little below that of 60°.
const STEEPEST: f64 = 0.866_025;

/// Least distance between knots, as a share of the rim's radius.
const GAP: f64 = 0.012;

/// Number of steps of the sum over the meridian.
const STEPS: f64 = 512.0;

/// Number of knots in a row that may fail to help before the search ends.
const PATIENCE: usize = 5;

/// Mean height at a radius.
#[derive(Clone, Copy)]
pub(super) struct Ring {
    /// Mean distance from the axis \[m\].
    pub rho_m: f64,
    /// Mean height \[m\].
    pub height_m: f64,
    weight: f64,
}

/// Returns the mean heights of points, stated by ρ, z and weight, from the axis outwards.
pub(super) fn rings(points: &[([f64; 2], f64)], rim_m: f64) -> Vec<Ring> {
    let mut sums = vec![[0.0; 3]; RINGS];
    for ([rho, z], weight) in points {
        let ring = ((rho / rim_m * RINGS as f64) as usize).min(RINGS - 1);
        let sum = &mut sums[ring];
        *sum = [sum[0] + weight, sum[1] + weight * rho, sum[2] + weight * z];
    }
    let ring = |[weight, rho, z]: [f64; 3]| Ring {
        rho_m: rho / weight,
        height_m: z / weight,
        weight: weight / (rho / weight).max(MIDDLE * rim_m),
    };
    sums.into_iter().filter(|sum| sum[0] > 0.0).map(ring).collect()
}

/// Profile of a face, with the height of its pole.
#[derive(Clone)]
pub(super) struct Profile {
    /// Radius and sine of the slope of each knot; of one that is level all over, one.
    knots: Vec<[f64; 2]>,
    level_m: f64,
    meridian: Option<Meridian>,
    /// Mean square of the residuals \[m²\].
    square_m2: f64,
}

impl Profile {
    /// Returns a level profile with knots at equal distances.
    pub fn level(rim_m: f64, count: usize) -> Self {
        let knot = |k: usize| [rim_m * (k + 1) as f64 / count as f64, 0.0];
        Self::new((0..count).map(knot).collect(), 0.0)
    }

    fn new(knots: Vec<[f64; 2]>, level_m: f64) -> Self {
        let meridian = Meridian::new(&listed(&knots)).ok();
        let square_m2 = f64::INFINITY;
        Self {
            knots,
            level_m,
            meridian,
            square_m2,
        }
    }

    /// Radius of the rim \[m\].
    pub fn rim_m(&self) -> f64 {
        self.knots.last().map_or(0.0, |knot| knot[0])
    }

    /// Surface of the profile.
    pub fn surface(&self) -> Option<Surface> {
        Surface::profile(&listed(&self.knots)).ok()
    }

    /// Height of the pole \[m\].
    pub fn level_m(&self) -> f64 {
        self.level_m
    }

    /// Height at ρ \[m\].
    pub fn height_m(&self, rho_m: f64) -> f64 {
        self.at(rho_m).0
    }

    /// Height at ρ \[m\], and tangent of the slope.
    pub fn at(&self, rho_m: f64) -> (f64, f64) {
        self.meridian.as_ref().map_or((self.level_m, 0.0), |meridian| {
            let at = meridian.at_radius(rho_m);
            (self.level_m + at.height_m, at.sine / at.cosine)
        })
    }

    /// Root mean square of the slopes' tangents over radii.
    pub fn steepness(&self) -> f64 {
        let squares = (0..RINGS).map(|k| self.at(self.rim_m() * (k as f64 + 0.5) / RINGS as f64).1);
        (squares.map(|tan| tan * tan).sum::<f64>() / RINGS as f64).sqrt()
    }

    fn judged(mut self, rings: &[Ring]) -> Self {
        let (mut sum, mut total) = (0.0, 0.0);
        for ring in rings {
            let off = ring.height_m - self.height_m(ring.rho_m);
            sum += ring.weight * off * off;
            total += ring.weight;
        }
        self.square_m2 = if self.meridian.is_some() {
            sum / total
        } else {
            f64::INFINITY
        };
        self
    }

    /// Returns the profile after some rounds of least squares over the slopes, and if it `moves` over the radii of the knots, too.
    pub fn fitted(&self, rings: &[Ring], moves: bool, rounds: usize) -> Self {
        let mut best = self.clone().judged(rings);
        let mut damping = 1e-6;
        for _ in 0..rounds {
            let Some(next) = best.stepped(rings, moves, damping) else {
                break;
            };
            let next = next.judged(rings);
            let gain = best.square_m2 - next.square_m2;
            if gain > 0.0 {
                let done = gain < 1e-6 * next.square_m2;
                best = next;
                damping = (0.1 * damping).max(1e-9);
                if done {
                    break;
                }
            } else if damping > 1.0 {
                break;
            } else {
                damping *= 30.0;
            }
        }
        best
    }

    /// Returns the profile one step of least squares on; unknowns are the level, the slopes, and the radii of all knots but the last.
    fn stepped(&self, rings: &[Ring], moves: bool, damping: f64) -> Option<Self> {
        let count = self.knots.len();
        let unknowns = 1 + count + if moves { count - 1 } else { 0 };
        let (mut n, mut g) = (vec![0.0; unknowns * unknowns], vec![0.0; unknowns]);
        let mut change = vec![0.0; 2 * count + 1];
        change[0] = 1.0;
        let (mut at_m, mut piece) = (0.0, 0);
        for ring in rings {
            while at_m < ring.rho_m {
                let end_m = self.knots.get(piece).map_or(f64::INFINITY, |knot| knot[0]);
                let next_m = ring.rho_m.min(end_m).min(at_m + self.rim_m() / STEPS);
                self.add_change(&mut change, piece, 0.5 * (at_m + next_m), next_m - at_m);
                at_m = next_m;
                piece += usize::from(at_m >= end_m);
            }
            let off = ring.height_m - self.height_m(ring.rho_m);
            for i in 0..unknowns {
                let weighted = ring.weight * change[i];
                g[i] += weighted * off;
                (0..=i).for_each(|j| n[unknowns * i + j] += weighted * change[j]);
            }
        }
        for k in 0..unknowns {
            n[unknowns * k + k] = n[unknowns * k + k] * (1.0 + damping) + f64::MIN_POSITIVE;
        }
        cholesky(&mut n, &mut g).then(|| self.changed(&g))
    }

    /// Adds the change of height along a part of a piece: first by the level, then by the slopes, then by the radii of the knots.
    fn add_change(&self, change: &mut [f64], piece: usize, middle_m: f64, along_m: f64) {
        let count = self.knots.len();
        let from = piece.checked_sub(1).map_or([0.0; 2], |k| self.knots[k]);
        let Some(to) = self.knots.get(piece) else {
            change[count] += along_m / cosine_cubed(from[1]);
            return;
        };
        let share = (middle_m - from[0]) / (to[0] - from[0]);
        let sine = from[1] + (to[1] - from[1]) * share;
        let rate = along_m / cosine_cubed(sine);
        let bend = (to[1] - from[1]) / (to[0] - from[0]);
        for (knot, part) in [(Some(piece), share), (piece.checked_sub(1), 1.0 - share)] {
            if let Some(knot) = knot {
                change[1 + knot] += rate * part;
                change[1 + count + knot] -= rate * part * bend;
            }
        }
    }

    /// Returns the profile with changed unknowns, within the limits of a meridian.
    fn changed(&self, by: &[f64]) -> Self {
        let (count, gap_m) = (self.knots.len(), GAP * self.rim_m());
        let mut knots = self.knots.clone();
        let mut least_m = gap_m;
        for (k, [rho, sine]) in knots.iter_mut().enumerate() {
            *sine = (*sine + by[1 + k]).clamp(-STEEPEST, STEEPEST);
            if k + 1 < count {
                let most_m = self.rim_m() - (count - 1 - k) as f64 * gap_m;
                let step = by.get(1 + count + k).copied().unwrap_or_default();
                let reach_m = 0.05 * self.rim_m();
                *rho = (*rho + step.clamp(-reach_m, reach_m)).clamp(least_m.min(most_m), most_m);
                least_m = *rho + gap_m;
            }
        }
        Self::new(knots, self.level_m + by[0])
    }

    /// Returns the profile with a knot more, where it helps most; `None` where there is no room for one.
    fn with_knot(&self, rings: &[Ring]) -> Option<Self> {
        let mut best: Option<Self> = None;
        for k in 0..self.knots.len() {
            let from = k.checked_sub(1).map_or([0.0; 2], |k| self.knots[k]);
            let to = self.knots[k];
            let held = rings
                .iter()
                .filter(|ring| (from[0]..to[0]).contains(&ring.rho_m))
                .count();
            if to[0] - from[0] < 2.5 * GAP * self.rim_m() || held < 3 {
                continue;
            }
            let mut knots = self.knots.clone();
            knots.insert(k, [0, 1].map(|i| 0.5 * (from[i] + to[i])));
            let trial = Self::new(knots, self.level_m).fitted(rings, false, 4);
            if best.as_ref().is_none_or(|best| trial.square_m2 < best.square_m2) {
                best = Some(trial);
            }
        }
        best.map(|best| best.fitted(rings, true, 30))
    }

    /// Returns the profile with as many knots as the rings ask for; level, if they do.
    pub fn sparing(rings: &[Ring], rim_m: f64) -> Self {
        let n = rings.len() as f64;
        let score = |profile: &Self, unknowns: f64| n * ln(profile.square_m2 + NOISE_M * NOISE_M) + unknowns * ln(n);
        let level = Self::level(rim_m, 1);
        let [total, sum] = rings.iter().fold([0.0; 2], |[total, sum], ring| {
            [total + ring.weight, sum + ring.weight * ring.height_m]
        });
        let level = Self::new(level.knots, sum / total).judged(rings);
        let mut least = score(&level, 0.0);
        let mut profile = level.fitted(rings, true, 30);
        let (mut best, mut failed) = (level, 0);
        loop {
            let count = profile.knots.len();
            let found = score(&profile, (2 * count - 1) as f64);
            failed += 1;
            if found < least {
                (best, least, failed) = (profile.clone(), found, 0);
            }
            let is_last = count == MOST_KNOTS || 2 * count + 3 > rings.len() || failed == PATIENCE;
            match profile.with_knot(rings).filter(|_| !is_last) {
                Some(next) => profile = next,
                None => return best,
            }
        }
    }
}

/// Knots as a surface has them.
fn listed(knots: &[[f64; 2]]) -> Vec<Knot> {
    let knot = |&[radius_m, sine]: &[f64; 2]| Knot {
        radius_m,
        slope_rad: asin(sine),
    };
    knots.iter().map(knot).collect()
}

fn cosine_cubed(sine: f64) -> f64 {
    let square = 1.0 - sine * sine;
    square * square.sqrt()
}
