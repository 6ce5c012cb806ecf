//! The arm in its workcell at a moment, in projection: while it washes, and between plates (the paper's Figs. 3 and 4).

use super::bodies;
use super::error::FigureError;
use super::ink::drawing::{Drawing, Lettering, Rect, Spot};
use super::ink::legend::{self, Entry};
use super::ink::page;
use super::ink::palette::{GREY, INK, LIFT, LINE, TRANSIT, WASH};
use super::ink::style::Style;
use super::names::Figure;
use super::solid::camera::Camera;
use super::solid::light::Rgb;
use super::solid::scene::Scene;
use super::solid::shapes::turned;
use super::subject::Subject;
use super::wording::{doing, seconds};
use nalgebra::Vector3;
use platewash_kinematics::trig::{atan2, cos};
use platewash_kinematics::{JointVector, Pose};
use platewash_workcell::plate::{Foot, Plate};
use platewash_workcell::segment::{PlanSegment, SegmentKind};
use platewash_workcell::words::quoted;

/// Half an edge of the floor patch, as the paper draws it \[m\].
const FLOOR_M: f64 = 0.5;

/// Length of the axes of the tip's frame \[m\].
const AXIS_M: f64 = 0.08;

/// From which side of the tip, and from how high the arm is seen \[rad\].
const ASIDE: f64 = 1.0;
const ELEVATION: f64 = 0.5;

/// The azimuth of the eye where it stays \[rad\], and how high the arm gets about then \[m\].
const FRONT: f64 = 0.62;
const HIGH_M: f64 = 0.74;

/// How far the eye is \[m\].
const DISTANCE_M: f64 = 2.6;

const PLATE: Rgb = [1.0, 1.0, 1.0];
const AXES: [(&str, &str); 3] = [("x", "#d5400d"), ("y", "#00795a"), ("z", "#0b5fa5")];

/// The moment that a figure shows, which is that asked for or the middle of a segment \[s\].
///
/// # Errors
/// [`FigureError::NoSegment`], [`FigureError::NoMoment`], [`FigureError::Moment`].
pub(super) fn moment(subject: &Subject<'_>, figure: Figure, at_s: Option<f64>) -> Result<f64, FigureError> {
    let kind = match figure {
        Figure::Cleaning => SegmentKind::Wash,
        Figure::Transit => SegmentKind::Transit,
        _ => {
            let at_s = at_s.ok_or(FigureError::NoMoment)?;
            let duration_s = subject.motion.duration_s();
            let within = (0.0..=duration_s).contains(&at_s);
            return if within {
                Ok(at_s)
            } else {
                Err(FigureError::Moment { at_s, duration_s })
            };
        }
    };
    let of_kind = |segment: &&PlanSegment| segment.kind == kind;
    let longest = |segment: &PlanSegment| segment.t_end_s - segment.t_start_s;
    // The first of the longest ones, but for the rounding of times.
    let most = subject
        .plan
        .segments
        .iter()
        .filter(of_kind)
        .map(longest)
        .fold(0.0, f64::max);
    let chosen = subject
        .plan
        .segments
        .iter()
        .filter(of_kind)
        .find(|segment| longest(segment) >= most - 1e-6);
    let segment = chosen.ok_or(FigureError::NoSegment {
        figure: figure.name(),
        kind,
    })?;
    let share = if kind == SegmentKind::Wash { 0.62 } else { 0.5 };
    Ok(segment.t_start_s + share * longest(segment))
}

/// From where the arm is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Eye {
    /// From the side of the tip, so that neither arm nor tool hides what is washed.
    Aside,
    /// From the same place at every moment, so that moments follow one another.
    Front,
}

/// Draws the arm at a moment of the motion \[s\].
///
/// # Errors
/// [`FigureError::Moment`] for a moment that the motion does not have.
pub(super) fn draw(subject: &Subject<'_>, t_s: f64, eye: Eye) -> Result<Drawing, FigureError> {
    let state = subject.motion.at(t_s).ok_or(FigureError::Moment {
        at_s: t_s,
        duration_s: subject.motion.duration_s(),
    })?;
    let segment = segment_at(subject, t_s);
    let what = segment.map_or_else(|| "stands".to_owned(), |segment| doing(segment.kind, segment.plate));
    let caption = "Central projection of the arm's shapes at one moment of the planned motion. The grey patch is 1 m by 1 m of the floor, \
                   the plates lie at their height.";
    let mut words = subject.words("", caption);
    words.title = format!("{}: the arm {what}", quoted(&subject.plan.provenance.scenario));
    words.subtitle = format!("at {}; {}", seconds(t_s), words.subtitle);
    let (mut drawing, room) = page::begin(&words);
    let beside = 330.0;
    let view = Rect::new(room.at[0], room.at[1], room.size[0] - beside, room.size[1]);
    let moment = Moment {
        subject,
        segment,
        t_s,
        eye,
        q: state.q,
        tip: subject.tip_pose(&state.q),
    };
    moment.draw(&mut drawing, view);
    let aside = Rect::new(view.end()[0] + 24.0, room.at[1] + 6.0, beside - 24.0, room.size[1]);
    moment.legend(&mut drawing, aside, state.qd, t_s);
    Ok(drawing)
}

fn segment_at<'s>(subject: &'s Subject<'_>, t_s: f64) -> Option<&'s PlanSegment> {
    let segments = &subject.plan.segments;
    segments.get(segments.partition_point(|segment| segment.t_end_s < t_s))
}

struct Moment<'a> {
    subject: &'a Subject<'a>,
    segment: Option<&'a PlanSegment>,
    t_s: f64,
    eye: Eye,
    q: JointVector,
    tip: Pose,
}

impl Moment<'_> {
    fn draw(&self, drawing: &mut Drawing, room: Rect) {
        let scene = self.scene();
        let camera = self.camera(&scene, room);
        drawing.named("floor", |drawing| self.floor(drawing, &camera));
        drawing.named("shadows", |drawing| scene.draw_shadows(drawing, &camera));
        drawing.named("bodies", |drawing| scene.draw(drawing, &camera));
        drawing.named("frame", |drawing| self.tip_frame(drawing, &camera));
    }

    fn camera(&self, scene: &Scene, room: Rect) -> Camera {
        let base = self.subject.mount().translation.vector;
        let target = Vector3::new(base.x + 0.1, base.y, base.z + 0.25);
        let (azimuth, high): (f64, Vec<Vector3<f64>>) = match self.eye {
            Eye::Aside => (self.aside(), scene.corners().collect()),
            Eye::Front => (FRONT, vec![base + Vector3::new(0.0, 0.0, HIGH_M)]),
        };
        let plates = self.subject.plan.job.plates.iter().flat_map(corners);
        let way = self.subject.planned.points().iter().map(|point| point.at);
        let places = high.into_iter().chain(floor()).chain(plates).chain(way);
        Camera::looking_at(target, [azimuth, ELEVATION], DISTANCE_M).fitted(places, room)
    }

    /// Of the azimuths beside the tip the one that is more before the arm \[rad\].
    fn aside(&self) -> f64 {
        let out = self.tip.translation.vector - self.subject.mount().translation.vector;
        let towards = atan2(out.y, out.x);
        let sides = [towards - ASIDE, towards + ASIDE];
        if cos(sides[0]) >= cos(sides[1]) {
            sides[0]
        } else {
            sides[1]
        }
    }

    fn scene(&self) -> Scene {
        let mut scene = Scene::default();
        let subject = self.subject;
        let terms = &subject.plan.job;
        for plate in &terms.plates {
            let facets = plate_facets(plate);
            scene.add_table(&facets, &plate.pose, PLATE);
            if let Some(foot) = &plate.foot {
                scene.add_table(&foot_facets(plate, foot), &plate.pose, PLATE);
            }
        }
        let flange = subject.mount()
            * subject
                .arm
                .pose(&self.q, &terms.workcell.tool.mounting_frame(subject.arm));
        let pressed = match self.segment {
            Some(segment) if segment.kind == SegmentKind::Wash => self.pressed_m(segment.plate),
            _ => 0.0,
        };
        let placed = bodies::arm(subject.arm, subject.mount(), &self.q)
            .into_iter()
            .chain(bodies::tool(&terms.workcell.tool, &flange, pressed))
            .chain(bodies::obstacles(&terms.workcell));
        for body in placed {
            scene.add(&body.facets, &body.pose, body.colour);
        }
        self.lines(&mut scene);
        scene
    }

    /// How far the sponge is pressed in, as its tip is at the plate's face or below it.
    fn pressed_m(&self, plate: usize) -> f64 {
        let sponge = self.subject.plan.job.workcell.tool.sponge;
        let plate = self.subject.plan.job.plates.get(plate);
        let height = plate.map_or(0.0, |plate| plate.height_of(&self.tip.translation.vector));
        (-height).clamp(0.0, 0.8 * sponge.height_m)
    }

    /// Wash paths and ways of the tip: what is done, and thinner what is to come.
    fn lines(&self, scene: &mut Scene) {
        for (k, segment) in self.subject.plan.segments.iter().enumerate() {
            let (colour, pale) = match segment.kind {
                SegmentKind::Wash => (WASH, "#e8a6cd"),
                SegmentKind::Approach | SegmentKind::Retreat => (LIFT, "#bfe0f4"),
                SegmentKind::Depart | SegmentKind::Transit | SegmentKind::Return => (TRANSIT, "#8fbcd9"),
            };
            let way = self.subject.planned.way(k);
            let times = self.subject.planned.within(k);
            // The way begins with the last place of the segment before.
            let done = way.len() - times.len() + times.partition_point(|point| point.t_s <= self.t_s);
            let done = if segment.t_start_s > self.t_s { 0 } else { done };
            let (before, after) = (&way[..done], &way[done.saturating_sub(1)..]);
            scene.line(after.to_vec(), Style::line(pale, 1.5));
            scene.line(before.to_vec(), Style::line(colour, 2.4));
        }
    }

    fn floor(&self, drawing: &mut Drawing, camera: &Camera) {
        let see = |place: Vector3<f64>| camera.see(&place);
        let corners: Option<Vec<Spot>> = floor().into_iter().map(see).collect();
        if let Some(corners) = corners {
            drawing.polygon(&corners, &Style::fill("#d4d6d9").outlined("#b4b8bd", 1.2));
        }
        let at = |k: i32| f64::from(k) * 0.1;
        let lines = (-4..=4).flat_map(|k| {
            let across = [Vector3::new(at(k), -FLOOR_M, 0.0), Vector3::new(at(k), FLOOR_M, 0.0)];
            let along = [Vector3::new(-FLOOR_M, at(k), 0.0), Vector3::new(FLOOR_M, at(k), 0.0)];
            [across, along]
        });
        let seen: Vec<Vec<Spot>> = lines.map(|line| line.into_iter().filter_map(see).collect()).collect();
        drawing.polylines(&seen, &Style::line("#c6c9cd", 0.8));
    }

    /// The axes of the tip's frame, over everything.
    fn tip_frame(&self, drawing: &mut Drawing, camera: &Camera) {
        let origin = self.tip.translation.vector;
        let Some(from) = camera.see(&origin) else { return };
        for (k, (name, colour)) in AXES.into_iter().enumerate() {
            let mut axis = Vector3::zeros();
            axis[k] = AXIS_M;
            let axis = self.tip.rotation * axis;
            if let (Some(to), Some(beyond)) = (camera.see(&(origin + axis)), camera.see(&(origin + axis * 1.28))) {
                drawing.line(from, to, &Style::line("#ffffff", 5.4));
                drawing.line(from, to, &Style::line(colour, 3.0));
                let how = Lettering::new(18.0, colour).bold().centred().on_white(2.5);
                drawing.text([beyond[0], beyond[1] + how.drop()], name, &how);
            }
        }
        drawing.circle(from, 3.6, &Style::fill(INK).outlined("#ffffff", 1.0));
    }

    fn legend(&self, drawing: &mut Drawing, room: Rect, qd: JointVector, t_s: f64) {
        let mut entries = vec![
            Entry::line(Style::line(WASH, 2.4), "the tip while it washes"),
            Entry::line(Style::line("#e8a6cd", 1.5), "… from now on"),
            Entry::line(Style::line(TRANSIT, 2.2), "transits"),
        ];
        let kinds = |kind| self.subject.plan.segments.iter().any(|segment| segment.kind == kind);
        if kinds(SegmentKind::Approach) {
            entries.push(Entry::line(Style::line(LIFT, 2.4), "down to a plate and up"));
        }
        for (name, colour) in AXES {
            entries.push(Entry::line(
                Style::line(colour, 3.0),
                format!("{name} of the tip's frame, {:.0} mm", 1e3 * AXIS_M),
            ));
        }
        let mut y = legend::column(drawing, room.at, room.size[0], &entries) + 14.0;
        drawing.line([room.at[0], y], [room.end()[0], y], &Style::line(LINE, 1.0));
        y += 8.0;
        for (name, value) in self.numbers(qd, t_s) {
            y += 27.0;
            drawing.text([room.at[0], y], &name, &Lettering::new(18.0, GREY));
            drawing.text([room.end()[0], y], &value, &Lettering::new(18.0, INK).to_the_left());
        }
    }

    /// Numbers of the moment.
    fn numbers(&self, qd: JointVector, t_s: f64) -> Vec<(String, String)> {
        let at = self.tip.translation.vector;
        let speed = self.subject.tip_speed(&self.q, &qd);
        let mut all = vec![
            ("time".to_owned(), seconds(t_s)),
            ("tip, x".to_owned(), metres(at.x)),
            ("tip, y".to_owned(), metres(at.y)),
            ("tip, z".to_owned(), metres(at.z)),
            ("speed of the tip".to_owned(), format!("{speed:.3} m/s")),
        ];
        for (joint, angle) in self.q.iter().enumerate() {
            all.push((format!("joint {}", joint + 1), degrees(*angle)));
        }
        all
    }
}

fn metres(value: f64) -> String {
    super::ink::axes::minus(&format!("{value:.3}")) + " m"
}

fn degrees(angle_rad: f64) -> String {
    super::ink::axes::minus(&format!("{:.1}", angle_rad.to_degrees())) + "°"
}

/// The corners of the square around a plate's rim, as high as that.
fn corners(plate: &Plate) -> [Vector3<f64>; 4] {
    let r = plate.rim_m();
    let z = plate.surface.height_m(r);
    [[-r, -r], [r, -r], [r, r], [-r, r]].map(|[x, y]| plate.world(&Vector3::new(x, y, z)))
}

fn floor() -> [Vector3<f64>; 4] {
    let f = FLOOR_M;
    [[-f, -f], [f, -f], [f, f], [-f, f]].map(|[x, y]| Vector3::new(x, y, 0.0))
}

/// How far a face turns between two rings of it that are drawn, at most \[rad\].
const TURN_RAD: f64 = 0.12;

/// A plate from below to above, by the meridian of its face.
fn plate_facets(plate: &Plate) -> super::solid::shapes::Facets {
    let face = plate.surface.outline_m(TURN_RAD);
    let rim = plate.rim_m();
    let below = [rim, plate.surface.height_m(rim) - plate.thickness_m];
    // The pole is where it closes.
    let meridian: Vec<[f64; 2]> = std::iter::once(below).chain(face.into_iter().skip(1).rev()).collect();
    turned(&meridian)
}

/// What a plate stands on, from below to the body under the pole.
fn foot_facets(plate: &Plate, foot: &Foot) -> super::solid::shapes::Facets {
    let top = -plate.thickness_m;
    turned(&[[foot.radius_m, top - foot.height_m], [foot.radius_m, top], [0.0, top]])
}
