//! Moments of a wash, close enough to each other that contact between them is bounded.
//!
//! Formula (28.1) in `docs/contact.md`, where Λ stands for R.
//!
//! With p the tip, a the tool's axis, x a point in contact, d = x − p, R what ‖d‖ is not above, ω how fast the tool turns and
//! P = I − a aᵀ; V, A, J bound ‖ṗ‖, ‖p̈‖, ‖p⃛‖, a₁ and a₂ bound ‖ȧ‖ and ‖ä‖, W, W₁ and W₂ bound ω and its derivatives:
//!
//! - the compression c − d·a has a second derivative of at most A + 2 V a₁ + R a₂;
//! - the way P d from the axis: P p̈ + 2 ä (d·a) + 2 ȧ (ḋ·a + d·ȧ) + a (2 ḋ·ȧ) …, at most A + 2 R a₂ + 4 V a₁ + 2 R a₁²;
//! - the sliding velocity P u, u = ṗ + ω × d: ‖u‖ ≤ V + W R, ‖u̇‖ ≤ A + W₁ R + W V, ‖ü‖ ≤ J + W₂ R + 2 W₁ V + W A, and with
//!   ‖Ṗ‖ ≤ 2 a₁, ‖P̈‖ ≤ 2 a₂ + 2 a₁² its second derivative is at most ‖ü‖ + 4 a₁ ‖u̇‖ + (2 a₂ + 2 a₁²) ‖u‖.
//!
//! A point in contact is within s of the axis and compressed by no more than the free height H, so that ‖d‖² ≤ s² + H² then, and within a
//! stretch of length h it is no farther than V h more; the plate's error of height adds to it.

use crate::motion::tip::{self, Arm, Derivatives, Stretch, TipPiece};
use crate::motion::tip_limits;
use crate::washing::face_shares::sags::Sags;
use platewash_bodies::contact::{Drift, Foundation, Moment, SpongePose};
use platewash_workcell::plate::Plate;

/// Greatest distance of the tip between neighbouring moments on a disc, and below on other faces \[m\].
const STEP_M: f64 = 2.5e-3;
const STEP_ON_BENDS_M: f64 = 8e-4;

/// Loss of compression, distance or sliding way between moments above which a stretch is halved, on a disc, and below on other faces \[m\].
const SAG_M: f64 = 3e-5;
const SAG_ON_BENDS_M: f64 = 1e-5;

/// Greatest depth of halving of a piece.
const MOST_HALVINGS: u32 = 6;

/// The moments of a wash on a plate, in the plate's frame.
#[derive(Debug, Default)]
pub(crate) struct Instants {
    /// Moments in order of time.
    pub moments: Vec<Moment>,
    /// State of the tip at each moment, base frame.
    pub tips: Vec<tip::Moment>,
    /// Sags between each moment and the next.
    pub sags: Vec<Sags>,
    /// Motion of the sponge between each moment and the next.
    pub drifts: Vec<Drift>,
    /// Bounds on third derivatives between each moment and the next.
    pub jerks: Vec<Jerk>,
}

/// Upper bounds on third derivatives over a stretch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jerk {
    /// Bound for the tip \[m/s³\].
    pub tip_m_s3: f64,
    /// Bound for the tool's axis \[1/s³\].
    pub axis: f64,
}

/// Data needed to bound a stretch.
struct StretchInputs<'a> {
    arm: &'a Arm<'a>,
    plate: &'a Plate,
    foundation: &'a Foundation,
    error_m: f64,
}

impl Instants {
    /// Returns the moments of the pieces, for a sponge on a plate that may lie higher or lower by `error_m`.
    pub fn new(
        arm: &Arm<'_>,
        pieces: &[TipPiece<'_>],
        plate: &Plate,
        (foundation, error_m): (&Foundation, f64),
    ) -> Self {
        let inputs = StretchInputs {
            arm,
            plate,
            foundation,
            error_m,
        };
        let mut all = Self::default();
        for piece in pieces {
            let stretch = piece.stretch();
            if all.moments.is_empty() {
                all.see(plate, &stretch, 0);
            }
            all.add(&inputs, &stretch, 0);
        }
        all
    }

    /// Adds a stretch whose first end has been added already.
    fn add(&mut self, inputs: &StretchInputs<'_>, stretch: &Stretch<'_>, depth: u32) {
        let bounds = inputs.arm.derivatives(stretch);
        let drift = drift(stretch, bounds);
        let sags = inputs.sags(stretch, bounds, &drift);
        let [from, to] = stretch.ends;
        let [step_m, sag_m] = if inputs.plate.surface.is_flat() {
            [STEP_M, SAG_M]
        } else {
            [STEP_ON_BENDS_M, SAG_ON_BENDS_M]
        };
        let far = (to.position - from.position).norm() > step_m
            || [sags.compression_m, sags.aside_m, sags.slide_m]
                .iter()
                .any(|lost_m| *lost_m > sag_m || lost_m.is_nan());
        let halves = (far && depth < MOST_HALVINGS)
            .then(|| inputs.arm.halves(stretch))
            .flatten();
        if let Some(halves) = halves {
            return halves.both().iter().for_each(|half| self.add(inputs, half, depth + 1));
        }
        self.sags.push(sags);
        self.drifts.push(drift);
        self.jerks.push(Jerk {
            tip_m_s3: bounds.third(),
            axis: bounds.third_of_axis(),
        });
        self.see(inputs.plate, stretch, 1);
    }

    /// Upper bound on the distance of the tip from the plate's axis \[m\]: the chord bound, formula (0.1) in `docs/certificate.md`, between
    /// moments; infinite where it is not known.
    pub fn tip_within_m(&self) -> f64 {
        let distances = self.moments.iter().map(|moment| moment.pose.tip.xy().norm());
        let sags = self.drifts.iter().map(|d| 0.125 * d.length_s * d.length_s * d.tip_m_s2);
        let greatest = |all: f64, next: f64| if next.is_nan() { f64::INFINITY } else { all.max(next) };
        distances.fold(0.0, greatest) + sags.fold(0.0, greatest)
    }

    fn see(&mut self, plate: &Plate, stretch: &Stretch<'_>, end: usize) {
        let there = stretch.ends[end];
        let local = |v| plate.pose.inverse_transform_vector(v);
        self.moments.push(Moment {
            t_s: stretch.times()[end],
            pose: pose(plate, there),
            speed: local(&there.speed),
            turning: local(&there.turning),
        });
        self.tips.push(*there);
    }
}

/// Returns the pose of the sponge in the frame of a plate.
pub(crate) fn pose(plate: &Plate, there: &tip::Moment) -> SpongePose {
    SpongePose {
        tip: plate.local(&there.position),
        axis: plate.pose.inverse_transform_vector(&there.axis),
    }
}

/// Bounds the motion of a sponge over a stretch: V, A, W, a₁ and a₂ of the head of this file. `bounds` has the suprema of formulas (0.3) and (0.4).
pub(crate) fn drift(stretch: &Stretch<'_>, bounds: &Derivatives) -> Drift {
    let half_s = 0.5 * stretch.length_s();
    let greatest = |of: fn(&tip::Moment) -> f64| {
        let [from, to] = stretch.ends.map(of);
        from.max(to)
    };
    // From the nearer end, or through both.
    let second = bounds.second_of_axis();
    let tip_m_s2 = (greatest(|m| m.acceleration.norm()) + half_s * bounds.third()).min(bounds.second());
    Drift {
        length_s: stretch.length_s(),
        tip_m_s: greatest(|m| m.speed.norm()) + stretch.sag(bounds.third()).min(half_s * tip_m_s2),
        tip_m_s2,
        turning: greatest(|m| m.turning.norm()) + half_s * bounds.first_of_turning(),
        axis: tip_limits::turning(stretch, second),
        bending: second,
    }
}

impl StretchInputs<'_> {
    /// Bounds the sags over a stretch, formula (28.1), and that of the sliding way: see the head of this file. `drift` has V, A, W, a₁ and a₂,
    /// `bounds` has W₁, W₂ and J.
    fn sags(&self, stretch: &Stretch<'_>, bounds: &Derivatives, drift: &Drift) -> Sags {
        let h = stretch.length_s();
        let (s, height_m) = (self.foundation.radius_m, self.foundation.free_height_m);
        let Drift {
            tip_m_s: v,
            tip_m_s2: a,
            turning: w,
            axis: a1,
            bending: a2,
            ..
        } = *drift;
        let r = (s * s + height_m * height_m).sqrt() + v * h + self.error_m;
        let (w1, w2, jerk) = (bounds.first_of_turning(), bounds.second_of_turning(), bounds.third());
        let slide = [v + w * r, a + w1 * r + w * v, jerk + w2 * r + 2.0 * w1 * v + w * a];
        let bend_of_slide = slide[2] + 4.0 * a1 * slide[1] + 2.0 * (a2 + a1 * a1) * slide[0];
        Sags {
            compression_m: stretch.sag(a + 2.0 * v * a1 + r * a2),
            aside_m: stretch.sag(a + 2.0 * r * a2 + 4.0 * v * a1 + 2.0 * r * a1 * a1),
            slide_m: h * stretch.sag(bend_of_slide),
        }
    }
}
