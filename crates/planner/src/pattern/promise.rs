//! What a wash must bring about on a face.

use crate::scene::Scene;
use crate::trig::sin_cos;
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_workcell::contact::{Columns, Foundation, Looks, Moment, SpongePose, Wanted};
use platewash_workcell::job::{JobTerms, PATH_TOLERANCE_M};
use platewash_workcell::plate::Plate;
use platewash_workcell::surface::Surface;
use platewash_workcell::tool::Sponge;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Places of a face that are looked at.
const PLACES: u32 = 2000;

/// Places that are looked at first: where this much of a share lacks there, the others are not.
const FIRST: u32 = 250;
const LACKING: f64 = 8e-3;

/// The angle between neighbours of a sunflower's seeds \[rad\].
const GOLDEN_RAD: f64 = 2.399_963_229_728_653;

/// A compression that every place has \[m\].
const ANY_M: f64 = -1e3;

/// By how much more than is promised must be seen, as what is looked at is no bound.
#[derive(Debug, Clone, Copy)]
pub(super) struct Margin {
    /// Of time and dose, as a factor.
    more: f64,
    /// Of shares, as a part of what may lack it.
    part: f64,
}

impl Margin {
    /// Before the arm's own tilts are known.
    pub const BARE_FACE: Self = Self { more: 1.1, part: 0.2 };

    /// With the arm.
    const ARM: Self = Self { more: 1.04, part: 0.2 };
}

/// What a wash must bring about: of how much of a face it is wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Promise {
    /// The sponge; of unknown stiffness 1 Pa.
    pub foundation: Foundation,
    /// What is wanted of a place.
    pub wanted: Wanted,
    /// Shares that must be in contact, long enough, and with enough of a dose.
    pub shares: [f64; 3],
    /// Greatest strain; infinite where nothing is asked.
    pub strain: f64,
}

impl Promise {
    /// What a job asks for on a surface. Without a promise about contact the sponge sweeps flat faces with its whole face, and touches
    /// others.
    #[must_use]
    pub fn of(terms: &JobTerms, surface: &Surface) -> Self {
        let (requirements, sponge) = (&terms.requirements, &terms.workcell.tool.sponge);
        let foundation = foundation(sponge);
        let Some(contact) = &requirements.contact else {
            return Self {
                foundation,
                wanted: Wanted {
                    compression_m: if surface.is_flat() { ANY_M } else { 0.0 },
                    height_error_m: 0.0,
                    time_s: 0.0,
                    dose_pa_m: f64::NEG_INFINITY,
                },
                shares: [requirements.coverage, 0.0, 0.0],
                strain: f64::INFINITY,
            };
        };
        Self {
            foundation,
            wanted: Wanted {
                compression_m: contact.compression_m,
                height_error_m: contact.height_error_m,
                time_s: contact.time_s,
                dose_pa_m: contact.dose_pa_m,
            },
            shares: [
                contact.share.max(requirements.coverage),
                contact.time_share,
                contact.dose_share,
            ],
            strain: contact.strain,
        }
    }
}

impl Promise {
    /// The same of a face that is to be swept alone, where nothing tells which way the tool leans: of the sponge's face counts what is over the
    /// disc whose radius is that of the sponge times the cosine of the cone, less what the tip may be off its path, as in the certificate.
    /// `None` of all others.
    pub(super) fn swept_within(&self, surface: &Surface, cone_rad: f64) -> Option<Self> {
        let (_, cosine) = sin_cos(cone_rad);
        let is_swept = surface.is_flat() && self.wanted.compression_m == ANY_M;
        is_swept.then(|| Self {
            foundation: Foundation {
                radius_m: (self.foundation.radius_m * cosine - PATH_TOLERANCE_M).max(0.0),
                ..self.foundation
            },
            ..*self
        })
    }

    /// Whether it is kept by an arm in some configurations along a wash, at a constant speed: looked at there, not between.
    #[must_use]
    pub fn is_kept(&self, scene: &Scene<'_>, plate: &Plate, (along, speed_m_s): (&[JointVector], f64)) -> bool {
        let moments = moments(scene, plate, along, speed_m_s);
        let columns = Columns::new(&self.foundation);
        let strain = |moment: &Moment| {
            let load = columns.load(&plate.surface, &moment.pose, self.wanted.height_error_m);
            load.deepest_m / self.foundation.free_height_m
        };
        if self.strain.is_finite() && moments.iter().any(|moment| strain(moment) > self.strain) {
            return false;
        }
        self.seems_kept(&plate.surface, &moments, &Margin::ARM)
    }

    /// Whether places of a face, looked at one by one through some moments, have what is promised with a margin.
    pub(super) fn seems_kept(&self, surface: &Surface, moments: &[Moment], margin: &Margin) -> bool {
        let wanted = &Wanted {
            time_s: margin.more * self.wanted.time_s,
            dose_pa_m: margin.more * self.wanted.dose_pa_m,
            ..self.wanted
        };
        let looks = Looks::new(&self.foundation, moments, wanted);
        let at = |k: u32| {
            let dwell = looks.at(&place(surface, k));
            let kept = [
                dwell.compression_m >= wanted.compression_m,
                dwell.time_s >= wanted.time_s,
                dwell.dose_pa_m >= wanted.dose_pa_m,
            ];
            kept.map(u32::from)
        };
        let add = |a: [u32; 3], b: [u32; 3]| std::array::from_fn(|i| a[i] + b[i]);
        let enough = |kept: [u32; 3], of: u32, lacking: f64| {
            let mut each = kept.iter().zip(self.shares);
            each.all(|(kept, share)| f64::from(*kept) / f64::from(of) >= share + margin.part * (1.0 - share) - lacking)
        };
        // Every eighth seed is spread as evenly.
        let stride = PLACES / FIRST;
        let first = (0..FIRST)
            .into_par_iter()
            .map(|k| at(k * stride))
            .reduce(|| [0; 3], add);
        let all = || (0..PLACES).into_par_iter().map(at).reduce(|| [0; 3], add);
        enough(first, FIRST, LACKING) && enough(all(), PLACES, 0.0)
    }
}

/// The sponge in some configurations along a wash.
fn moments(scene: &Scene<'_>, plate: &Plate, along: &[JointVector], speed_m_s: f64) -> Vec<Moment> {
    let mut moments: Vec<Moment> = Vec::with_capacity(along.len());
    let mut t_s = 0.0;
    for q in along {
        let pose = SpongePose::on(plate, &scene.robot.fk(q).rigid(&scene.tip));
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
    let (s, c) = sin_cos((GOLDEN_RAD * f64::from(k)) % TAU);
    Vector3::new(rho * c, rho * s, surface.height_m(rho))
}
