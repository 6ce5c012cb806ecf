//! What holds a plate: the load on it, and whether the plate stays where it is.
//!
//! Requirement 33, formulas (33.1) to (33.5) in `docs/contact.md`.
//!
//! **Load.** Every column presses on the plate with a force p along the normal, N all together, and drags along the face with no more than
//! μ p. With β the slope of the face, across the plate's axis that is at most h(|sin β|) p: with friction straight up or down the slope
//! |sin β| + μ cos β, the greatest where μ |sin β| ≤ cos β, and √(1 + μ²) of both together elsewhere. h is concave, so that its mean over the
//! columns is at most that at the mean of |sin β|. The normals of a face of revolution meet its axis: about it turns only the friction, with
//! the distance ρ from the axis as its lever.
//!
//! **Ring.** A plate that stands on a ring of the radius R about its axis is pressed onto it with P, whose centre is c from the axis, and is
//! pushed across the axis with F and turned about c with T. How P is spread over the ring is not known. Friction of A p + B ẑ × (r − c) p,
//! p the pressure at r, has the sum A P, and about c the torque B ∫ p |r − c|² = B P (R² − |c|²): the friction that holds the plate is nowhere
//! more than (F + T/(R − |c|))/P of the pressure. That it is no more than the coefficient, with |c| < R, suffices: such friction is in
//! balance with the load, whatever the pressure. So much is needed for every N from 0 to its greatest. With the tip at d from the axis, the
//! columns within ς of it, S the greatest |sin β| under the sponge, W and G the plate's weight along its axis and across it, and z the height
//! of the plate over its ring:
//!
//! - P ≥ W + (√(1 − S²) − μ S) N, and of each column at most κ p, κ = min(1 + μ S, √(1 + μ²));
//! - F ≤ f + G, f ≤ h(S) N, and f is no more than the load above;
//! - |c| P ≤ M = min(ρ κ N, d κ N + O) + z F, with ρ the greatest distance from the axis that the sponge reaches on the plate and O the moment
//!   of what is pressed about the tip, at most ς κ N;
//! - |tip − c| P ≤ W d + O + z F, so that T P ≤ (W d + O + z F) f + M G + t P, with t the torque about the tip, at most ς h(S) N.
//!
//! Where a second bound of f, O or t holds for every N, the lesser one counts: each is a line over some intervals of N. P, F and M are lines
//! there, too, and the friction suffices where (u μ′ P − F)(R P − M) ≥ T P (u = 1, μ′ the coefficient): a parabola in N, which is not below 0
//! if it is not so at both ends and at its vertex. The least u is found by halving.

use crate::judged_job::JudgedJob;
use crate::report::check::{Check, Measure, Sense, WorstCase, tighter};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::holder_load::{HolderLoad, RingShares};
use crate::washing::instants::Instants;
use crate::washing::plate_contact::{PlateContact, are_of_all_plates};
use crate::washing::pressing::{FRICTION, Pressing};
use crate::washing::wash_inputs::ContactInputs;
use platewash_workcell::job::RingTerms;

/// Acceleration of gravity, down in the world \[m/s²\].
const GRAVITY_M_S2: f64 = 9.81;

/// Relative amount by which the bounds of a ring are enlarged: far above their rounding errors.
const ROUNDING: f64 = 1e-9;

/// Bounds the load from approach to retreat: the force across the plate's axis, formula (33.1), and the torque about it, formula (33.2). `pressing`
/// has the integrals. `None` where nothing is proved.
pub(crate) fn holder_load(inputs: &ContactInputs<'_>, pressing: &Pressing) -> Option<HolderLoad> {
    let (plate, judged) = (inputs.washing.plate, inputs.washing.judged);
    let (volumes, terms) = (&pressing.holder, judged.job.requirements.holder.as_ref());
    let stiffest = inputs.foundation.pressure_pa_m()[1];
    let [least, assumed] = FRICTION;
    let most = terms.map_or(assumed, |terms| terms.sponge_friction);
    let sponge_friction = [least.min(most), most];
    let slope = volumes.slope_m3 / volumes.normal_m3;
    let lateral_n = sponge_friction.map(|friction| stiffest * volumes.normal_m3 * across(slope, friction));
    let torque_nm = sponge_friction.map(|friction| stiffest * friction * volumes.turn_m4);
    let is_known = lateral_n.iter().chain(&torque_nm).all(|bound| bound.is_finite());
    let mass_kg = terms.and_then(|terms| terms.plate_mass_kg);
    let weight_n = mass_kg.map(|mass_kg| {
        let (axis, whole_n) = (plate.axis(), mass_kg * GRAVITY_M_S2);
        [whole_n * axis.dot(&judged.up), whole_n * axis.cross(&judged.up).norm()]
    });
    let standing = terms.and_then(|terms| terms.ring.as_ref()).zip(weight_n);
    let on_ring = |weight_n| ring_load(inputs, pressing, stiffest, most, lateral_n[1], weight_n);
    is_known.then(|| HolderLoad {
        sponge_friction,
        lateral_n,
        torque_nm,
        weight_n,
        ring: standing.map(|(ring, weight_n)| on_ring(weight_n).shares(ring)),
    })
}

/// Collects the load on a ring for formula (33.5). `stiffest` is E/H \[Pa/m\], `friction` is μ, `lateral_n` is the bound of formula (33.1),
/// `weight_n` is W and G.
fn ring_load(
    inputs: &ContactInputs<'_>,
    pressing: &Pressing,
    stiffest: f64,
    friction: f64,
    lateral_n: f64,
    weight_n: [f64; 2],
) -> RingLoad {
    let (washing, plate, foundation) = (inputs.washing, inputs.washing.plate, inputs.foundation);
    let volumes = &pressing.holder;
    // A column that is pressed ends no farther from the tip along the sponge's axis than it may be compressed.
    let c = foundation.compression_m;
    let along_m = c.max(pressing.deepest.bound - c);
    let cosine = washing.tips.least_upright_cosine_of(washing.span);
    let cosine = washing.around_cosine.min(cosine).max(0.0);
    let aside_m = along_m * (1.0 - cosine * cosine).max(0.0).sqrt();
    let reach_m = foundation.radius_m + aside_m;
    let instants = std::iter::once(inputs.instants).chain(inputs.around);
    let tip_m = instants.map(Instants::tip_within_m).fold(0.0, f64::max);
    let farthest_m = plate.rim_m().min(tip_m + reach_m);
    let [least, most] = plate.surface.patch([0.0, farthest_m]).sine;
    let aside_m4 = aside_m * volumes.normal_m3;
    let [bottom_m, top_m] = plate.extent_m();
    RingLoad {
        pressed_n: stiffest * volumes.normal_m3,
        weight_n,
        sine: most.max(-least),
        friction,
        tip_m,
        reach_m,
        farthest_m,
        height_m: top_m - bottom_m,
        lateral_n,
        lean_nm: stiffest * (volumes.lean_m4 + aside_m4),
        twist_nm: stiffest * (friction * (pressing.twist_m4 + aside_m4) + reach_m * volumes.slope_m3),
    }
}
/// Load on a ring, as upper bounds: the symbols of formula (33.5).
#[derive(Debug, Clone, Copy)]
pub(crate) struct RingLoad {
    /// Greatest force along normals, N \[N\].
    pub pressed_n: f64,
    /// Weight of the plate along its axis and across it, W and G \[N\].
    pub weight_n: [f64; 2],
    /// Greatest |sin β| under the sponge, S.
    pub sine: f64,
    /// Friction coefficient of the sponge, μ.
    pub friction: f64,
    /// Distance of the tip from the axis, d \[m\].
    pub tip_m: f64,
    /// Distance of the columns from the tip, seen along the plate's axis, ς \[m\].
    pub reach_m: f64,
    /// Distance of the columns from the axis, ρ \[m\].
    pub farthest_m: f64,
    /// Height of the plate over its ring, z \[m\].
    pub height_m: f64,
    /// Second bounds of f \[N\], O and t \[N·m\]; infinite where there is none.
    pub lateral_n: f64,
    pub lean_nm: f64,
    pub twist_nm: f64,
}

/// Greatest force across the plate's axis over what is pressed along a normal, h(x) of formula (33.1). `sine` is x = |sin β|, `friction` is μ.
fn across(sine: f64, friction: f64) -> f64 {
    let cosine = (1.0 - sine * sine).sqrt();
    if friction * sine <= cosine {
        sine + friction * cosine
    } else {
        (1.0 + friction * friction).sqrt()
    }
}

/// A line over N: its value at 0 and its slope.
type Line = [f64; 2];

fn at([start, slope]: Line, n: f64) -> f64 {
    // Infinity times 0 is no number.
    if n == 0.0 { start } else { start + slope * n }
}

fn sum<const K: usize>(terms: [(f64, Line); K]) -> Line {
    terms.iter().fold([0.0; 2], |all, (by, line)| {
        [all[0] + by * line[0], all[1] + by * line[1]]
    })
}

/// Share that a demand takes of a supply.
fn share(demand: f64, supply: f64) -> f64 {
    if demand <= 0.0 {
        0.0
    } else if supply > 0.0 {
        demand / supply
    } else {
        f64::INFINITY
    }
}

/// Bounds of formula (33.5) over an interval of N.
struct Stretch {
    ends: [f64; 2],
    /// Lower bound of P.
    pressed: Line,
    /// Upper bounds of f, F, M, |tip − c| P and t.
    across: Line,
    lateral: Line,
    moment: Line,
    arm: Line,
    twist: Line,
}

impl RingLoad {
    /// Bounds the shares of what a ring can bear, formula (33.4). `ring` has R and μ′.
    pub fn shares(&self, ring: &RingTerms) -> RingShares {
        let stretches = self.stretches();
        let greatest = |of: &dyn Fn(&Stretch, f64) -> f64| {
            let ends = stretches
                .iter()
                .flat_map(|stretch| stretch.ends.map(|n| of(stretch, n)));
            let most = ends.fold(
                0.0,
                |all: f64, next| if next.is_nan() { f64::INFINITY } else { all.max(next) },
            );
            Some(most * (1.0 + ROUNDING)).filter(|most| most.is_finite())
        };
        let (radius_m, friction) = (ring.radius_m, ring.friction);
        let tipping = greatest(&|s, n| share(at(s.moment, n), radius_m * at(s.pressed, n)));
        let sliding = greatest(&|s, n| share(at(s.lateral, n), friction * at(s.pressed, n)));
        let stands = tipping.is_some_and(|tipping| tipping < 1.0);
        let suffices = |share: f64| stretches.iter().all(|s| s.is_held(radius_m, share * friction));
        let needed = || {
            let (mut least, mut most) = (0.0, 1.0);
            while !suffices(most) {
                (least, most) = (most, 2.0 * most);
                if most > 1e6 {
                    return None;
                }
            }
            for _ in 0..40 {
                let middle = 0.5 * (least + most);
                if suffices(middle) {
                    most = middle
                } else {
                    least = middle
                }
            }
            Some(most * (1.0 + ROUNDING))
        };
        RingShares {
            tipping,
            sliding,
            friction: stands.then(needed).flatten(),
        }
    }

    /// The intervals of N in which each bound of formula (33.5) is one line.
    fn stretches(&self) -> Vec<Stretch> {
        let [down_n, across_n] = self.weight_n;
        let (sine, friction, most) = (self.sine, self.friction, self.pressed_n);
        let dragged = across(sine, friction);
        let least = (1.0 - sine * sine).max(0.0).sqrt() - friction * sine;
        let greatest = (1.0 + friction * sine).min((1.0 + friction * friction).sqrt());
        let (d, s, z) = (self.tip_m, self.reach_m, self.height_m);
        let bounds = [
            (dragged, self.lateral_n),
            (s * greatest, self.lean_nm),
            (s * dragged, self.twist_nm),
            // M has two lines, too: ρ k N, or d k N and the lesser bound of O.
            ((self.farthest_m - d) * greatest, self.lean_nm),
        ];
        let mut ends = vec![0.0, most];
        ends.extend(
            bounds
                .map(|(slope, level)| level / slope)
                .into_iter()
                .filter(|n| *n > 0.0 && *n < most),
        );
        ends.sort_by(f64::total_cmp);
        let stretch = |ends: &[f64]| {
            let [from, to] = [ends[0], ends[1]];
            let [across, lean, twist, beyond] = bounds.map(|(slope, level)| {
                if 0.5 * (from + to) * slope <= level {
                    [0.0, slope]
                } else {
                    [level, 0.0]
                }
            });
            let lateral = sum([(1.0, across), (1.0, [across_n, 0.0])]);
            Stretch {
                ends: [from, to],
                pressed: [down_n, least],
                across,
                lateral,
                moment: sum([(1.0, [0.0, d * greatest]), (1.0, beyond), (z, lateral)]),
                arm: sum([(1.0, [down_n.abs() * d, 0.0]), (1.0, lean), (z, lateral)]),
                twist,
            }
        };
        ends.windows(2).map(stretch).collect()
    }
}

impl Stretch {
    /// True if formula (33.4) holds for every N in the interval: the plate does not slide. `radius_m` is R, `friction` is the coefficient that is
    /// tried for μ′. The plate must not tip.
    fn is_held(&self, radius_m: f64, friction: f64) -> bool {
        let spare = sum([(friction, self.pressed), (-1.0, self.lateral)]);
        let inside = sum([(radius_m, self.pressed), (-1.0, self.moment)]);
        let weight_across = [self.lateral[0] - self.across[0], 0.0];
        // The coefficients of the parabola.
        let products = [
            (1.0, spare, inside),
            (-1.0, self.arm, self.across),
            (-1.0, self.moment, weight_across),
            (-1.0, self.twist, self.pressed),
        ];
        let [mut a, mut b, mut c] = [0.0; 3];
        for (sign, [p0, p1], [q0, q1]) in products {
            a += sign * p1 * q1;
            b += sign * (p0 * q1 + p1 * q0);
            c += sign * p0 * q0;
        }
        let [from, to] = self.ends;
        let vertex = (-0.5 * b / a).clamp(from, to);
        let vertex = if vertex.is_nan() { from } else { vertex };
        let is_spare = self.ends.iter().all(|n| at(spare, *n) >= 0.0 && at(inside, *n) >= 0.0);
        is_spare && [from, vertex, to].iter().all(|n| c + (b + a * n) * n >= 0.0)
    }
}

/// Checks that every plate stays where it is, where the job states what holds the plates.
pub(crate) fn check(judged: &JudgedJob<'_>, all: &[PlateContact]) -> Option<Check> {
    let requirement = Requirement::PlateStays;
    let terms = judged.job.requirements.holder?;
    judged.job.requirements.contact?;
    if !are_of_all_plates(judged, all) {
        return Some(Check::not_judged(requirement));
    }
    let side = |contact: &PlateContact, bound: Option<f64>, limit: f64, unit: Unit| {
        let measure = Measure::new(Sense::AtMost, limit, unit, [bound, None]);
        Check::measured(requirement, measure, WorstCase::on_plate(contact.plate))
    };
    let sides = all.iter().flat_map(|contact| {
        let load = contact.holder_load.as_ref();
        let fixture = terms.fixture.map(|fixture| {
            let across_n = |load: &HolderLoad| load.lateral_n[1] + load.weight_n.map_or(0.0, |[_, across_n]| across_n);
            let turned_nm = |load: &HolderLoad| load.torque_nm[1];
            tighter(
                side(contact, load.map(across_n), fixture.force_n, Unit::Newton),
                side(contact, load.map(turned_nm), fixture.torque_nm, Unit::NewtonMetre),
            )
        });
        let ring = terms.ring.map(|_| {
            let needed = load.and_then(|load| load.ring?.friction);
            side(contact, needed, 1.0, Unit::Share)
        });
        fixture.into_iter().chain(ring)
    });
    Some(sides.reduce(tighter).unwrap_or_else(|| Check::not_judged(requirement)))
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;
