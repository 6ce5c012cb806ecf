//! Promise of a wash: the contact that it must bring about on a face.

use crate::pattern::shortfall::ContactPromise;
use crate::pattern::shortfall::Shortfall;
use crate::placed_arm::PlacedArm;
use nalgebra::Vector3;
use platewash_bodies::contact::{Columns, ContactSampler, Dwell, Foundation, Level, Moment, SpongePose};
use platewash_kinematics::JointVector;
use platewash_kinematics::trig::{acos, sin_cos};
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::job::{JobTerms, PATH_TOLERANCE_M};
use platewash_workcell::plate::Plate;
use platewash_workcell::surface::Surface;
use platewash_workcell::tool::Sponge;
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Number of places of a face that are checked.
const PLACES: u32 = 2000;

/// Number of places that are checked first: where they lack this much of a share, the others are skipped.
const FIRST: u32 = 250;
const LACKING: f64 = 8e-3;

/// Number of places that are checked at once where a candidate is likely to fail.
const BATCH: usize = 100;

/// Number of places at which other candidates lacked that are checked first.
const MOST_SUSPECTS: usize = 120;

/// Stride from one of the first places to the next.
const STRIDE: u32 = PLACES / FIRST;

/// Number of places that are checked before those, and the stride from one to the next, which spreads them over the face.
const FEW: u32 = 50;
const SPREAD: u32 = 97;

/// The angle between neighbours of a sunflower's seeds, in turns.
const GOLDEN: f64 = 0.381_966_011_250_105;

/// Stride of the moments at which the load on a bent face is computed, where there is a margin.
const LOADED: usize = 3;

/// Every force is within \[N\].
const ANY_FORCE_N: [f64; 2] = [0.0, f64::INFINITY];

/// Distance of the tip from a flat face that is tolerated for strain and force \[m\].
const OFF_FACE_M: f64 = 1e-5;

/// A compression that every place has \[m\].
const ANY_M: f64 = -1e3;

/// Margins by which an estimate must exceed the promise: it samples some places and moments only, and is no bound.
#[derive(Debug, Clone, Copy)]
pub struct Margin {
    /// Factor on time, and on dose.
    more: [f64; 2],
    /// Part of the share that may lack it, kept as a reserve.
    part: f64,
    /// Factor on strain and force.
    load: f64,
    /// Reserve of the tool's tilt on a flat face \[rad\].
    tilt_rad: f64,
}

impl Margin {
    /// Margin before the arm's own tilts are known.
    pub const BARE_FACE: Self = Self {
        more: [1.05; 2],
        ..Self::ARM
    };

    /// Margin on the bare face where an arm pressed less than [`BARE_FACE`](Self::BARE_FACE) allows for.
    pub const STEADY: Self = Self {
        more: [1.12; 2],
        part: 0.35,
        ..Self::ARM
    };

    /// Margin with the arm's own configurations.
    pub const ARM: Self = Self {
        more: [1.04; 2],
        part: 0.2,
        load: 1.02,
        tilt_rad: 5e-4,
    };

    /// Margin on the bare face where an arm pressed less than [`STEADY`](Self::STEADY) allows for; no factor on time and dose is larger.
    pub const WEAK_ARM: Self = Self {
        more: [1.3; 2],
        part: 0.5,
        ..Self::ARM
    };

    /// Margin with the arm where a larger one would cost time: for the part of a share that a check of single places may miss.
    pub const CLOSE: Self = Self {
        more: [1.005; 2],
        part: 0.05,
        load: 1.005,
        tilt_rad: 1e-4,
    };

    /// No margin: a shortfall that remains is certain to fail the proof.
    pub const NONE: Self = Self {
        more: [1.0; 2],
        part: 0.0,
        load: 1.0,
        tilt_rad: 0.0,
    };

    /// Margin with a share of the time alone.
    fn slowed(mut self, share: f64) -> Self {
        self.more[0] *= share;
        self
    }

    /// The share that must be seen of one that is required.
    fn required(&self, share: f64) -> f64 {
        share + self.part * (1.0 - share)
    }
}

/// Result that a wash must bring about, and the share of a face on which it is required.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Promise {
    /// The sponge; of unknown stiffness 1 Pa.
    pub foundation: Foundation,
    /// Requirement at a single place of the face.
    pub thresholds: ContactThresholds,
    /// Shares that must be in contact, long enough, and with enough of a dose.
    pub shares: [f64; 3],
    /// Greatest strain; infinite without a limit.
    pub strain: f64,
    /// Least and greatest force \[N\]; 0 and infinite without limits.
    pub force_n: [f64; 2],
}

impl Promise {
    /// Promise of a job on a surface. Without a promise about contact the sponge sweeps flat faces with its whole face, and
    /// touches others.
    #[must_use]
    pub fn new(terms: &JobTerms, plate: &Plate) -> Self {
        let surface = &plate.surface;
        let (requirements, sponge) = (&terms.requirements, &terms.workcell.tool.sponge);
        let foundation = foundation(sponge);
        let Some(contact) = terms.contact_of(plate) else {
            return Self {
                foundation,
                thresholds: ContactThresholds {
                    compression_m: if surface.is_flat() { ANY_M } else { 0.0 },
                    height_error_m: 0.0,
                    time_s: 0.0,
                    dose_pa_m: f64::NEG_INFINITY,
                },
                shares: [requirements.coverage, 0.0, 0.0],
                strain: f64::INFINITY,
                force_n: ANY_FORCE_N,
            };
        };
        Self {
            foundation,
            thresholds: contact.thresholds(),
            shares: [
                contact.share.max(requirements.coverage),
                contact.time_share,
                contact.dose_share,
            ],
            strain: contact.strain,
            force_n: sponge.stiffness_pa.map_or(ANY_FORCE_N, |_| contact.force_n),
        }
    }
}

impl Promise {
    /// The same promise for a face that only has to be swept, where the lean of the tool has an unknown direction. The counted
    /// part of the sponge's face is the part over a disc. The radius of the disc is that of the sponge times the cosine of the
    /// cone, less the tip's deviation from its path, as in the certificate. `None` for all other promises.
    pub(crate) fn swept_within(&self, surface: &Surface, cone_rad: f64) -> Option<Self> {
        let (_, cosine) = sin_cos(cone_rad);
        let is_swept = surface.is_flat() && self.thresholds.compression_m == ANY_M;
        is_swept.then(|| Self {
            foundation: Foundation {
                radius_m: (self.foundation.radius_m * cosine - PATH_TOLERANCE_M).max(0.0),
                ..self.foundation
            },
            ..*self
        })
    }

    /// An arm in some configurations along a wash at a constant speed. It is sampled in these configurations, not between them.
    #[must_use]
    pub fn sampled(&self, placed: &PlacedArm<'_>, plate: &Plate, along: &[JointVector], speed_m_s: f64) -> SampledWash {
        SampledWash::new(*self, plate.surface, moments(placed, plate, along, speed_m_s))
    }

    /// The strain or force of the sponge that exceeds the promise.
    fn overload(&self, surface: &Surface, moments: &[Moment], margin: &Margin) -> Option<Shortfall> {
        let [least_n, most_n] = self.force_n;
        if self.strain.is_infinite() && self.force_n == ANY_FORCE_N {
            return None;
        }
        let (volume_m3, deepest_m) = if surface.is_flat() {
            self.pressed_level(surface.rim_m(), moments, margin)
        } else {
            self.pressed_bent(surface, moments, margin)
        };
        let ([soft_n, _], [_, stiff_n]) = (
            self.foundation.forces_n(volume_m3[0]),
            self.foundation.forces_n(volume_m3[1]),
        );
        let strain = deepest_m / self.foundation.free_height_m;
        let short = |promised, found, required| Shortfall {
            promised,
            found,
            required,
        };
        if strain * margin.load > self.strain {
            Some(short(ContactPromise::Strain, strain, self.strain))
        } else if stiff_n * margin.load > most_n {
            Some(short(ContactPromise::GreatestForce, stiff_n, most_n))
        } else if soft_n < least_n * margin.load {
            Some(short(ContactPromise::LeastForce, soft_n, least_n))
        } else {
            None
        }
    }

    /// Least and greatest volume of compressed foam \[m³\] and greatest compression \[m\] on a flat face, over all moments. They
    /// are bounded as in the certificate, from the greatest tilt and the place farthest out.
    fn pressed_level(&self, rim_m: f64, moments: &[Moment], margin: &Margin) -> ([f64; 2], f64) {
        let (mut least_cosine, mut distance_m): (f64, f64) = (1.0, 0.0);
        for moment in moments {
            least_cosine = least_cosine.min(-moment.pose.axis.z);
            distance_m = distance_m.max(moment.pose.tip.xy().norm());
        }
        let (_, cosine) = sin_cos(acos(least_cosine) + margin.tilt_rad);
        let off_m = OFF_FACE_M + self.thresholds.height_error_m;
        let level = Level {
            height_m: [-off_m, off_m],
            cosine,
            distance_m,
        };
        let press = self.foundation.level_press(&level, rim_m);
        (press.volume_m3, press.deepest_m[1])
    }

    /// Bounds of the same on other faces, at the moments: close ones where there is no margin.
    fn pressed_bent(&self, surface: &Surface, moments: &[Moment], margin: &Margin) -> ([f64; 2], f64) {
        let columns = if margin.load > 1.0 {
            Columns::new(&self.foundation)
        } else {
            Columns::fine(&self.foundation)
        };
        let error_m = self.thresholds.height_error_m;
        let every = if margin.load > 1.0 { LOADED } else { 1 };
        let loads = moments.par_iter().step_by(every).map(|moment| {
            let [low, high] = [-error_m, error_m].map(|more_m| columns.load(surface, &moment.pose, more_m));
            ([low.volume_m3[0], high.volume_m3[1]], high.deepest_m)
        });
        loads.reduce(
            || ([f64::INFINITY, 0.0], f64::NEG_INFINITY),
            |(a, deep), (b, deeper)| ([a[0].min(b[0]), a[1].max(b[1])], deep.max(deeper)),
        )
    }

    /// Checks that a place is pressed deep enough, long enough, and with enough of a dose, with a margin.
    fn keeps(&self, dwell: &Dwell, margin: &Margin) -> [bool; 3] {
        let (wanted, [time, dose]) = (&self.thresholds, margin.more);
        [
            dwell.compression_m >= wanted.compression_m,
            dwell.time_s >= time * wanted.time_s,
            dwell.dose_pa_m >= dose * wanted.dose_pa_m,
        ]
    }

    /// Returns the first promised share that is not kept: `kept` of `of` sampled points keep each promise, and a share of `lacking` may
    /// be missing.
    fn short(&self, kept: [u32; 3], of: u32, margin: &Margin, lacking: f64) -> Option<Shortfall> {
        let promised = [
            ContactPromise::Pressed,
            ContactPromise::ContactTime,
            ContactPromise::ContactDose,
        ];
        let mut each = kept.into_iter().zip(self.shares).zip(promised);
        each.find_map(|((kept, required), promised)| {
            let found = f64::from(kept) / f64::from(of);
            let is_enough = found >= margin.required(required) - lacking;
            (!is_enough).then_some(Shortfall {
                promised,
                found,
                required,
            })
        })
    }
}

/// Speed at which the places of a face keep a promise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kept {
    /// They keep it at full speed.
    AtFullSpeed,
    /// They may keep it at about this share of the speed.
    Slower(f64),
    /// They keep it at none of the speeds allowed.
    Never,
}

/// A wash as moments, and the amounts that places of the face get from it, which are computed when they are first asked for.
#[derive(Debug)]
pub struct SampledWash {
    promise: Promise,
    surface: Surface,
    sampler: ContactSampler,
    /// Amounts at the first places, and at all of them.
    first: OnceLock<Vec<Dwell>>,
    all: OnceLock<Vec<Dwell>>,
}

impl SampledWash {
    /// A wash of a face that is to keep a promise.
    pub(crate) fn new(promise: Promise, surface: Surface, moments: Vec<Moment>) -> Self {
        Self {
            promise,
            surface,
            sampler: ContactSampler::new(promise.foundation, moments, promise.thresholds),
            first: OnceLock::new(),
            all: OnceLock::new(),
        }
    }

    /// Returns the shortfall of the wash against its promise with a margin.
    #[must_use]
    pub fn shortfall(&self, margin: &Margin) -> Option<Shortfall> {
        let overload = self.promise.overload(&self.surface, self.sampler.moments(), margin);
        overload.or_else(|| self.missing(margin))
    }

    /// Checks that the places of the face keep the promise with a margin at full speed, or at a share of it, at least `least`. A few
    /// places come first, then those at which other washes lacked, which are in `suspects` with the latest first, and then the others from
    /// the rim inwards: most washes are refused by these few.
    pub(crate) fn keeps_shares(&self, margin: &Margin, least: f64, suspects: &mut Vec<u32>) -> Kept {
        let margins = [*margin, margin.slowed(least)];
        let mut dwells: Vec<Option<Dwell>> = vec![None; PLACES as usize];
        let mut lacking = [[0; 3]; 2];
        let few = (0..FEW).map(|k| (k * SPREAD % FIRST) * STRIDE).collect();
        let known = std::mem::take(suspects);
        let inwards: Vec<u32> = (0..PLACES).rev().collect();
        let batches = [few, known.clone()]
            .into_iter()
            .chain(inwards.chunks(BATCH).map(<[u32]>::to_vec));
        let (mut verdict, mut share) = (None, 1.0);
        for (batch, mut places) in batches.enumerate() {
            places.retain(|k| dwells[*k as usize].is_none());
            let found: Vec<Dwell> = places.par_iter().map(|k| self.dwell(*k)).collect();
            for (lacking, margin) in lacking.iter_mut().zip(&margins) {
                for (lacking, kept) in lacking.iter_mut().zip(self.kept(&found, margin)) {
                    *lacking += found.len() as u32 - kept;
                }
            }
            for (k, dwell) in places.into_iter().zip(found) {
                dwells[k as usize] = Some(dwell);
            }
            // The few places may be more unlike the face than all of them.
            let (of, slack) = if batch == 0 { (FIRST, LACKING) } else { (PLACES, 0.0) };
            let is_short = |lacking: &[u32; 3]| {
                self.promise
                    .short(lacking.map(|lacking| of - lacking), of, margin, slack)
                    .is_some()
            };
            if batch == 0 {
                let times_s = dwells.iter().flatten().map(|dwell| dwell.time_s).collect();
                share = self.share(margin, times_s, 1.0 / f64::from(FEW));
            }
            if is_short(&lacking[1]) {
                verdict = Some(Kept::Never);
            } else if is_short(&lacking[0]) && batch > 0 {
                verdict = Some(Kept::Slower(share.max(least)));
            }
            if verdict.is_some() {
                break;
            }
        }
        let lacks = |k: &u32| {
            let dwell = dwells[*k as usize].as_ref();
            dwell.is_some_and(|dwell| self.promise.keeps(dwell, &margins[1]) != [true; 3])
        };
        suspects.extend((0..PLACES).rev().filter(lacks).take(MOST_SUSPECTS));
        suspects.extend(known.into_iter().filter(|k| !lacks(k)));
        suspects.truncate(MOST_SUSPECTS);
        verdict.unwrap_or_else(|| {
            self.all.get_or_init(|| dwells.into_iter().flatten().collect());
            Kept::AtFullSpeed
        })
    }

    /// The share of the face that is too small, checked place by place.
    fn missing(&self, margin: &Margin) -> Option<Shortfall> {
        let short = self
            .promise
            .short(self.kept(self.first(), margin), FIRST, margin, LACKING);
        short.or_else(|| self.promise.short(self.kept(self.all(), margin), PLACES, margin, 0.0))
    }

    /// Number of places that keep each promise with a margin.
    fn kept(&self, dwells: &[Dwell], margin: &Margin) -> [u32; 3] {
        dwells.iter().fold([0; 3], |kept: [u32; 3], dwell| {
            let keeps = self.promise.keeps(dwell, margin);
            std::array::from_fn(|i| kept[i] + u32::from(keeps[i]))
        })
    }

    /// Greatest share of the speed, from `least` to 1, at which the places of the face keep the promise with a margin. A lower
    /// speed makes the contact longer; depth and dose stay the same.
    pub(crate) fn speed_share(&self, margin: &Margin, least: f64, suspects: &mut Vec<u32>) -> Option<f64> {
        if self.keeps_shares(&margin.slowed(least), 1.0, suspects) != Kept::AtFullSpeed {
            return None;
        }
        let times_s = self.all().iter().map(|dwell| dwell.time_s).collect();
        Some(self.share(margin, times_s, 0.0).max(least))
    }

    /// Share of the speed, up to 1, at which enough of some places, but for a part `slack` of them, are in contact long enough with a margin;
    /// their times of contact at full speed are `times_s` \[s\].
    fn share(&self, margin: &Margin, mut times_s: Vec<f64>, slack: f64) -> f64 {
        times_s.sort_unstable_by(|a, b| b.total_cmp(a));
        let [_, share, _] = self.promise.shares;
        let needed = times_s.len() as f64 * (margin.required(share) - slack);
        let longest_s = times_s.get((needed.ceil() as usize).saturating_sub(1)).copied();
        (longest_s.unwrap_or(0.0) / (margin.more[0] * self.promise.thresholds.time_s)).min(1.0)
    }

    /// Amounts at every eighth place: these seeds of a sunflower are spread as evenly as all.
    fn first(&self) -> &[Dwell] {
        self.first.get_or_init(|| {
            let places = (0..FIRST).into_par_iter();
            places.map(|k| self.dwell(k * STRIDE)).collect()
        })
    }

    /// Amounts at all places.
    fn all(&self) -> &[Dwell] {
        self.all.get_or_init(|| {
            let first = self.first();
            let at = |k: u32| match k % STRIDE {
                0 => first[(k / STRIDE) as usize],
                _ => self.dwell(k),
            };
            (0..PLACES).into_par_iter().map(at).collect()
        })
    }

    /// Amounts at the k-th place, up to the moment from which any margin is kept.
    fn dwell(&self, k: u32) -> Dwell {
        self.sampler.until(&place(&self.surface, k), |dwell| {
            self.promise.keeps(dwell, &Margin::WEAK_ARM) == [true; 3]
        })
    }
}

/// The sponge in some configurations along a wash.
fn moments(placed: &PlacedArm<'_>, plate: &Plate, along: &[JointVector], speed_m_s: f64) -> Vec<Moment> {
    let mut moments: Vec<Moment> = Vec::with_capacity(along.len());
    let mut t_s = 0.0;
    for q in along {
        let pose = SpongePose::on(plate, &placed.robot.fk(q).rigid(&placed.tip));
        let way = moments
            .last()
            .map_or_else(Vector3::zeros, |last| pose.tip - last.pose.tip);
        t_s += way.norm() / speed_m_s;
        moments.push(Moment {
            t_s,
            pose,
            speed: way.try_normalize(0.0).unwrap_or_default() * speed_m_s,
            turning: Vector3::zeros(),
        });
    }
    moments
}

/// The foundation of a sponge.
pub(crate) fn foundation(sponge: &Sponge) -> Foundation {
    Foundation::stiff(sponge, sponge.stiffness_pa.unwrap_or([1.0; 2]))
}

/// The k-th place: spread like the seeds of a sunflower, evenly by the area seen from above.
fn place(surface: &Surface, k: u32) -> Vector3<f64> {
    let rho = surface.rim_m() * ((f64::from(k) + 0.5) / f64::from(PLACES)).sqrt();
    let (s, c) = sin_cos(TAU * (GOLDEN * f64::from(k)).fract());
    Vector3::new(rho * c, rho * s, surface.height_m(rho))
}
