//! The whole motion: visits and the transits between them as one trajectory, and the plan's segments in time. The tool's largest tilt is
//! checked between the points that were solved, too.

use crate::error::PlanError;
use crate::pipeline::shared::Pipeline;
use crate::pipeline::visit::Visit;
use crate::placed_arm::{PlacedArm, TILT_RESERVE_RAD};
use crate::timing::TimedPath;
use crate::transit::{self, BaseArc, LiftLine, Transit, TransitRules};
use crate::watch::Activity;
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_kinematics::trig::{asin, sin};
use platewash_motion::trajectory::{KnotError, PlanSegment, SegmentKind, Trajectory};
use platewash_workcell::random;
use platewash_workcell::wash_path::WashPath;

/// The whole motion in time.
#[derive(Debug)]
pub(crate) struct WholeMotion {
    pub motion: Trajectory,
    pub segments: Vec<PlanSegment>,
}

#[derive(Default)]
struct Assembly {
    t_s: Vec<f64>,
    q: Vec<JointVector>,
    qd: Vec<JointVector>,
    segments: Vec<PlanSegment>,
}

/// Joins `visits` by `transits`, one more than visits: from home, between, home.
pub(crate) fn assemble(visits: &[Visit], transits: &[Transit]) -> Result<WholeMotion, PlanError> {
    let mut assembly = Assembly::default();
    for (k, transit) in transits.iter().enumerate() {
        let plate = |visit: &Visit| visit.path.plate;
        let (before, after) = (k.checked_sub(1).map(|k| &visits[k]), visits.get(k));
        assembly.transit(before.map(plate), transit, after.map(plate));
        if let Some(visit) = after {
            assembly.declare(SegmentKind::Wash, plate(visit), &visit.wash, f64::INFINITY);
            assembly.append(&visit.wash);
        }
    }
    Ok(assembly.whole()?)
}

/// Joins motions of the given kinds, at a plate or leading to it, into one. Neighbours of a kind are one segment.
pub(crate) fn one_after_the_other<'a>(
    parts: impl Iterator<Item = (SegmentKind, &'a TimedPath)>,
    plate: usize,
) -> Result<WholeMotion, KnotError> {
    let mut assembly = Assembly::default();
    for (kind, timed) in parts {
        let before = assembly.segments.pop_if(|last| last.kind == kind);
        assembly.declare(kind, plate, timed, f64::INFINITY);
        if let (Some(before), Some(last)) = (before, assembly.segments.last_mut()) {
            last.t_start_s = before.t_start_s;
        }
        assembly.append(timed);
    }
    assembly.whole()
}

impl Assembly {
    fn whole(self) -> Result<WholeMotion, KnotError> {
        Ok(WholeMotion {
            motion: Trajectory::from_knots(self.t_s, self.q, self.qd)?,
            segments: self.segments,
        })
    }

    /// Retreat from a plate, free motion and approach to a plate of one transit.
    fn transit(&mut self, before: Option<usize>, transit: &Transit, after: Option<usize>) {
        let [leaves, enters] = transit.free;
        let kind = match (before, after) {
            (None, _) => SegmentKind::Depart,
            (_, None) => SegmentKind::Return,
            _ => SegmentKind::Transit,
        };
        let plate = after.or(before).unwrap_or(0);
        if let Some(before) = before {
            self.declare(SegmentKind::Retreat, before, &transit.timed, leaves);
        }
        self.declare(kind, plate, &transit.timed, enters);
        if let Some(after) = after {
            self.declare(SegmentKind::Approach, after, &transit.timed, f64::INFINITY);
        }
        self.append(&transit.timed);
    }

    /// Declares a segment up to the knot at `parameter` of a motion that is appended later, or up to its end.
    fn declare(&mut self, kind: SegmentKind, plate: usize, timed: &TimedPath, parameter: f64) {
        let start = self.t_s.last().copied().unwrap_or(0.0);
        let last = timed.parameters.len() - 1;
        // The knot there, whichever way its parameter was rounded.
        let after = timed.parameters.partition_point(|u| *u < parameter).clamp(1, last);
        let off = |knot: usize| (timed.parameters[knot] - parameter).abs();
        let knot = if off(after - 1) < off(after) { after - 1 } else { after };
        let t_start_s = self.segments.last().map_or(0.0, |s| s.t_end_s);
        self.segments.push(PlanSegment {
            kind,
            plate,
            t_start_s,
            t_end_s: start + timed.motion.times()[knot],
        });
    }

    /// Appends the knots of a motion; its first one is the last one so far.
    fn append(&mut self, timed: &TimedPath) {
        let start = self.t_s.last().copied().unwrap_or(0.0);
        let from = usize::from(!self.t_s.is_empty());
        let motion = &timed.motion;
        self.t_s.extend(motion.times()[from..].iter().map(|t| start + t));
        self.q.extend(&motion.positions()[from..]);
        self.qd.extend(&motion.speeds()[from..]);
    }
}

impl Pipeline<'_> {
    /// Rules of the transits of a placed arm.
    pub fn transit_rules<'a>(&'a self, placed: &'a PlacedArm<'a>) -> TransitRules<'a> {
        TransitRules {
            placed,
            limits: &self.transit,
            clearance_m: self.clearance_m(),
            arc: Some(BaseArc {
                arc: self.settings.arc,
                policy: self.policy(),
            }),
        }
    }

    /// Transits between neighbours of the lines over the plates, and from and to home; those that `wanted` names by their index.
    /// Each draws from a stream of its own.
    pub fn transits(
        &self,
        placed: &PlacedArm<'_>,
        lines: &[[&LiftLine; 2]],
        wanted: impl Fn(usize) -> bool,
    ) -> Result<Vec<Transit>, PlanError> {
        let [start, end] = self.terms.home_rad.map(LiftLine::home);
        let leaving = std::iter::once(&start).chain(lines.iter().map(|[_, exit]| *exit));
        let entering = lines.iter().map(|[entry, _]| *entry).chain(std::iter::once(&end));
        let rules = self.transit_rules(placed);
        let pairs = leaving.zip(entering).enumerate().filter(|(k, _)| wanted(*k));
        let of = lines.len() + 1;
        pairs
            .map(|(k, (from, to))| {
                (self.watch.tell)(&Activity::Transit { turn: k + 1, of });
                let mut rng = random::stream(self.terms.seed, &format!("crossing {k}"));
                Ok(transit::plan(&rules, from, to, &mut rng)?)
            })
            .collect()
    }
}

/// Looks into a piece of the motion, and into one that is far from the limit.
const LOOKS: u32 = 16;
const FEW_LOOKS: u32 = 2;

/// Largest tilt that counts as zero within rounding \[rad\].
const ROUNDING_RAD: f64 = 1e-8;

/// Part of the usual reserve that is left for the certificate, which bounds the tilt between the points checked here.
const LEFT: f64 = 0.1;

impl Pipeline<'_> {
    /// Refuses a motion on which the tool, at a plate, tilts by more than the terms allow.
    ///
    /// # Errors
    /// [`PlanError::Tilt`], with the worst place.
    pub fn check_tilt(&self, placed: &PlacedArm<'_>, whole: &WholeMotion, paths: &[WashPath]) -> Result<(), PlanError> {
        let most_rad = self.terms.tilt_max_rad();
        let left_rad = LEFT * TILT_RESERVE_RAD.min(0.5 * most_rad);
        let most = sin(most_rad + ROUNDING_RAD - left_rad);
        let times = whole.motion.times();
        let mut worst: Option<(f64, SegmentKind, usize)> = None;
        for segment in &whole.segments {
            placed.check_cancelled()?;
            let Some(face) = self.face(segment, paths) else {
                continue;
            };
            let from = times.partition_point(|t| *t < segment.t_start_s);
            let to = times.partition_point(|t| *t < segment.t_end_s);
            let sine = |at: f64| {
                let tip = placed.robot.fk(&whole.motion.at(at)?.q).rigid(&placed.tip);
                Some(tip.rotation.column(2).cross(&face(&tip.translation)).norm())
            };
            for ends in times[from..=to.min(times.len() - 1)].windows(2) {
                // The least and the greatest sine at some looks.
                let range = |looks: u32| {
                    let at = |k: u32| ends[0] + (ends[1] - ends[0]) * (f64::from(k) / f64::from(looks));
                    let sines = (0..=looks).filter_map(|k| sine(at(k)));
                    sines.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], sine| {
                        [least.min(sine), most.max(sine)]
                    })
                };
                let [low, high] = range(FEW_LOOKS);
                if high + (high - low) <= most {
                    continue;
                }
                let [_, high] = range(LOOKS);
                if high > worst.map_or(most, |(sine, ..)| sine) {
                    worst = Some((high, segment.kind, segment.plate));
                }
            }
        }
        match worst {
            None => Ok(()),
            Some((sine, kind, plate)) => Err(PlanError::Tilt {
                plate,
                kind,
                tilt_rad: asin(sine.min(1.0)),
                most_rad,
            }),
        }
    }

    /// The normal from which the tilt counts at a place of the tip \[m\] in a segment at a plate: that of the line, or of the face.
    fn face(&self, segment: &PlanSegment, paths: &[WashPath]) -> Option<impl Fn(&Vector3<f64>) -> Vector3<f64> + '_> {
        let plate = self.plates.get(segment.plate)?;
        let [start, end] = paths.iter().find(|path| path.plate == segment.plate)?.feet(plate);
        let foot = match segment.kind {
            SegmentKind::Approach => Some(start),
            SegmentKind::Wash => None,
            SegmentKind::Retreat => Some(end),
            _ => return None,
        };
        Some(move |tip: &Vector3<f64>| plate.normal_at(&foot.unwrap_or(*tip)))
    }
}
