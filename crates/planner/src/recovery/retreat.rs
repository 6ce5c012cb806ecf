//! Way from where the arm stands to the nearest place that is clear of everything.
//!
//! The tip moves along a straight line with the tool held as it is: along the normal of the plate that the sponge is at, else up, away from
//! the nearest body, or along the normal of the nearest plate; or the joints go back to where the plan has them. Pairs that are too near
//! at the start come no nearer.

use crate::error::PlanError;
use crate::joint_path::{Ends, JointPath};
use crate::pipeline::shared::Pipeline;
use crate::placed_arm::{PlacedArm, Stretch};
use crate::timing::{self, SlowStretch, TimedPath};
use nalgebra::Vector3;
use platewash_bodies::clearance::{ClearanceModel, PairClearance};
use platewash_kinematics::{JointVector, Pose};
use platewash_workcell::is_pair;
use platewash_workcell::job::{LINE_TOLERANCE_M, NEARER_M};
use platewash_workcell::words::plate_name;

/// Longest way along a line \[m\].
const LONGEST_M: f64 = 0.15;

/// Step along a line \[m\].
const STEP_M: f64 = 2e-3;

/// Largest step of a joint along a line \[rad\].
const JOINT_STEP_RAD: f64 = 0.1;

/// Steps of the way back to a configuration of the plan.
const STEPS_BACK: u32 = 12;

/// Height by which the sponge is farther over a face than need be for its retreat from it \[m\].
const ROOM_M: f64 = 1e-3;

/// Share of the speed limit that a retreat uses.
const PACE: f64 = 0.9;

/// Clear places further along a line than the first that are tried, too \[m\].
const FURTHER_M: [f64; 4] = [0.0, 0.02, 0.05, 0.1];

/// The arm where it stands.
pub(crate) struct Start<'a> {
    pub pipeline: &'a Pipeline<'a>,
    pub placed: &'a PlacedArm<'a>,
    pub at: JointVector,
    /// Plate that the sponge is at.
    pub plate: Option<usize>,
    /// The other pairs that are nearer than a free motion allows.
    pub near: Vec<PairClearance>,
    /// Configurations of the plan at and about the moment of the stop \[rad\].
    pub on_plan: Vec<JointVector>,
}

/// Clearance that a free motion keeps \[m\].
fn free_m(pipeline: &Pipeline<'_>) -> f64 {
    pipeline.clearance_m() + Stretch::Free.reserve_m()
}

/// A way out.
pub(crate) struct Way {
    /// Configurations from the start to a place that is clear \[rad\].
    pub q: Vec<JointVector>,
    /// Way of the tip at each, from 0 \[m\].
    pub length_m: Vec<f64>,
}

impl Way {
    pub fn top(&self) -> JointVector {
        self.q[self.q.len() - 1]
    }

    pub fn whole_m(&self) -> f64 {
        self.length_m[self.length_m.len() - 1]
    }

    /// The way in time, slowly, from rest to rest.
    pub fn timed(&self, start: &Start<'_>) -> Result<TimedPath, PlanError> {
        let (pipeline, placed) = (start.pipeline, start.placed);
        let path = JointPath::through(self.length_m.clone(), self.q.clone(), Ends::NotAKnot)?;
        let slow = SlowStretch {
            u: [0.0, self.whole_m()],
            most: PACE * start.pipeline.terms.retreat_speed_m_s(),
        };
        let (tip, limits) = (&placed.tip, &pipeline.transit);
        Ok(timing::time_optimal_slowed(&path, placed.robot, tip, limits, &[slow])?)
    }
}

impl<'a> Start<'a> {
    /// The arm at a configuration \[rad\]. Of two plates that the sponge touches it is at the one under way.
    pub fn new(
        pipeline: &'a Pipeline<'a>,
        placed: &'a PlacedArm<'a>,
        at: &JointVector,
        under_way: Option<usize>,
        on_plan: Vec<JointVector>,
    ) -> Self {
        let mut near = pipeline.clearance.too_near(at, &[], free_m(pipeline));
        let under_sponge =
            |pair: &PairClearance, plate| is_pair(&["sponge".to_owned(), plate_name(plate)], (&pair.a, &pair.b));
        let under = |pair: &PairClearance| {
            let plate = (0..pipeline.plates.len()).find(|plate| under_sponge(pair, *plate))?;
            Some((plate, pair.distance_m))
        };
        let nearer = |a: &(usize, f64), b: &(usize, f64)| {
            let other = |plate| Some(plate) != under_way;
            a.1.total_cmp(&b.1).then(other(a.0).cmp(&other(b.0)))
        };
        // Elsewhere, as behind a plate, no way along its normal leads away from it.
        let tip = placed.robot.fk(at).rigid(&placed.tip);
        let tool = &pipeline.terms.workcell.tool;
        let is_over = |(plate, _): &(usize, f64)| {
            let plate = &pipeline.plates[*plate];
            let height_m = plate.height_of(&tip.translation) - LINE_TOLERANCE_M;
            tool.is_over_face(height_m - ROOM_M, -tip.rotation.column(2).dot(&plate.axis()))
        };
        let under = near.iter().filter_map(under).filter(is_over);
        let plate = under.min_by(nearer).map(|(plate, _)| plate);
        near.retain(|pair| !plate.is_some_and(|plate| under_sponge(pair, plate)));
        Self {
            pipeline,
            placed,
            at: *at,
            plate,
            near,
            on_plan,
        }
    }

    /// The pairs that are nearer than the job asks.
    pub fn too_near(&self) -> Vec<PairClearance> {
        let clearance_m = self.pipeline.clearance_m();
        self.near
            .iter()
            .filter(|pair| !pair.is_clear(clearance_m))
            .cloned()
            .collect()
    }

    fn model(&self) -> &ClearanceModel {
        &self.pipeline.clearance
    }

    fn working_on(&self) -> &[usize] {
        self.plate.as_slice()
    }

    /// True if every pair keeps the clearance of a free motion.
    fn is_free(&self, q: &JointVector) -> bool {
        self.model().too_near(q, &[], free_m(self.pipeline)).is_empty()
    }

    /// True if no pair is too near but those at the start, and those are no nearer.
    fn may_pass(&self, q: &JointVector) -> bool {
        let required_m = self.pipeline.clearance_m() + Stretch::AtPlate(0).reserve_m();
        let was = |pair: &PairClearance| self.near.iter().find(|near| near.a == pair.a && near.b == pair.b);
        let no_nearer =
            |pair: PairClearance| was(&pair).is_some_and(|near| pair.distance_m >= near.distance_m - 0.5 * NEARER_M);
        let within = self.placed.robot.limits().contain(q);
        within
            && self
                .model()
                .too_near(q, self.working_on(), required_m)
                .into_iter()
                .all(no_nearer)
    }

    /// Ways to clear places, one after the other: each ends where a free motion may begin.
    pub fn ways(&self) -> impl Iterator<Item = Way> {
        let alone = self.plate.is_some();
        let lines = self.directions().into_iter().flat_map(|along| self.along(&along));
        let back = (!alone).then(|| self.back_to_plan()).into_iter().flatten();
        lines.chain(back)
    }

    /// Directions of the lines to try, in the frame of the base.
    fn directions(&self) -> Vec<Vector3<f64>> {
        let plates = &self.pipeline.plates;
        let tip = self.placed.robot.fk(&self.at).rigid(&self.placed.tip).translation;
        if let Some(plate) = self.plate.and_then(|plate| plates.get(plate)) {
            return vec![plate.normal_at(&tip)];
        }
        let up = self.pipeline.mount.rotation.inverse() * Vector3::z();
        let nearest = self.model().nearest(&self.at, &[]);
        let away = nearest.and_then(|nearest| {
            let [a, b] = nearest.points_m.map(Vector3::from);
            (a - b).try_normalize(1e-9)
        });
        let far = |plate: &&platewash_workcell::plate::Plate| (plate.centre() - tip).norm();
        let over = plates.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        let over = over.map(|plate| plate.normal_at(&tip));
        let away = away
            .into_iter()
            .flat_map(|away| [away, -away, (away + up), (up - away)]);
        let all = over.into_iter().chain([up]).chain(away);
        all.filter_map(|along| along.try_normalize(1e-6)).collect()
    }

    /// Ways along a straight line of the tip: up to the first clear place, and some further ones.
    fn along(&self, along: &Vector3<f64>) -> Vec<Way> {
        let from = self.placed.robot.fk(&self.at).rigid(&self.placed.tip);
        let start = Pose::from(&from);
        let raised = |h: f64| {
            let mut pose = start;
            pose.translation.vector += along * h;
            pose
        };
        let (mut q, mut heights) = (vec![self.at], vec![0.0]);
        let (mut ways, mut wanted): (Vec<Way>, _) = (Vec::new(), FURTHER_M.iter().copied().peekable());
        let mut first_m = None;
        while heights[heights.len() - 1] < LONGEST_M {
            let (h, before) = (heights[heights.len() - 1] + STEP_M, q[q.len() - 1]);
            let Ok(found) = self.placed.solver.solve(&raised(h), &before) else {
                break;
            };
            if (found.q - before).amax() > JOINT_STEP_RAD || !self.may_pass(&found.q) {
                break;
            }
            q.push(found.q);
            heights.push(h);
            let due = wanted
                .peek()
                .is_some_and(|more| first_m.is_none_or(|first: f64| h >= first + more));
            // A spline needs some samples.
            if due && q.len() >= 4 && self.is_free(&found.q) {
                first_m.get_or_insert(h);
                wanted.next();
                ways.push(Way {
                    q: q.clone(),
                    length_m: heights.clone(),
                });
            }
        }
        ways
    }

    /// The way straight in the joints to where the plan has the arm, at and about the moment of the stop.
    fn back_to_plan(&self) -> Vec<Way> {
        let tip = |q: &JointVector| self.placed.robot.fk(q).rigid(&self.placed.tip).translation;
        let way = |to: &JointVector| {
            let share = |k: u32| f64::from(k) / f64::from(STEPS_BACK);
            let q: Vec<_> = (0..=STEPS_BACK).map(|k| self.at + (to - self.at) * share(k)).collect();
            let mut length_m = vec![0.0];
            for pair in q.windows(2) {
                // Turned on the spot, too, it takes its time.
                let step_m = (tip(&pair[1]) - tip(&pair[0])).norm() + 0.1 * (pair[1] - pair[0]).amax();
                length_m.push(length_m[length_m.len() - 1] + step_m);
            }
            Way { q, length_m }
        };
        let is_way =
            |way: &Way| way.whole_m() > 0.0 && self.is_free(&way.top()) && way.q[1..].iter().all(|q| self.may_pass(q));
        self.on_plan.iter().map(way).filter(is_way).collect()
    }
}
