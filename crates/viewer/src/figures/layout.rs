//! The workcell from above: plates in their order, washed areas, the paths between (the paper's Fig. 2).

use super::axes::fixed;
use super::figure_data::{FigureData, Track, per_cent};
use super::map::{Map, arm_look};
use super::outline::{self, Outline, arm_outlines, solid};
use super::page::{self, Entry, Sign, legend};
use super::svg::{
    BOLD, DASHED, DOTTED, Drawing, END, EXECUTED, GREY, GROUND, INK, LIFT, LINE, MIDDLE, PAPER, Rect, SMALL, Spot,
    TRANSIT, WASH, WORDS, outlined, stroke,
};
use crate::view::PressedRule;
use crate::view::coverage::proved_share;
use crate::view::tips::Tip;
use nalgebra::UnitQuaternion;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_motion::trajectory::SegmentKind;
use platewash_simulator::SimulationReport;
use platewash_workcell::job::Treatment;
use platewash_workcell::plate::Plate;
use platewash_workcell::surface::Surface;

/// Ways that are nearer to each other look like one \[m\].
const APART_M: f64 = 1e-3;

/// Width of the border beyond everything else in which obstacles are shown \[m\].
const AROUND_M: f64 = 0.12;

/// Sine of the angle to the vertical up to which a plate lies level.
const LEVEL: f64 = 1e-6;

/// Height of a row of the table of plates, at most \[px\].
const ROW: f64 = 32.0;

/// The colour of the bodies around the arm.
const OBSTACLE: &str = "#f1eadd";

/// Halfway along a way, the head of an arrow.
const ARROW: &str = "<defs><marker id=\"platewash-arrow\" markerWidth=\"9\" markerHeight=\"9\" refX=\"4\" refY=\"4\" orient=\"auto\">\
                     <path d=\"M0 0L8 4L0 8Z\" fill=\"#0072b2\"/></marker></defs>\n";

/// Draws it.
pub(super) fn draw(data: &FigureData<'_>) -> Drawing {
    let (mut drawing, room) = page::begin(&data.texts("Layout", caption(data)));
    let [low, high] = extent(data);
    let (map, beside) = Map::new(room, low, high);
    drawing.raw(ARROW);
    map.draw(&mut drawing, |drawing| {
        ground(drawing, &map, data);
        draw_paths(drawing, &map, data);
        numbers(drawing, &map, data);
    });
    let end = legend(&mut drawing, beside.at, beside.size[0], &entries(data)) + 22.0;
    table(
        &mut drawing,
        data,
        Rect::new(beside.at[0], end, beside.size[0], room.end()[1] - end),
    );
    drawing
}

/// Caption on the view: from above, and from behind the arm if the arm is not turned.
fn caption(data: &FigureData<'_>) -> String {
    let from = if data.mount().rotation == UnitQuaternion::identity() {
        "Seen from above, from behind the arm: x leads away from it, y to its left."
    } else {
        "Seen from above: the room's x leads up the page, its y to the left."
    };
    let table = match data.plan.order.is_empty() {
        true => ".",
        false => "; the table has them in the order of washing, along the arrows.",
    };
    format!("{from} Numbers are the plates'{table}")
}

/// Least and greatest x and y of everything that is drawn \[m\].
fn extent(data: &FigureData<'_>) -> [[f64; 2]; 2] {
    let mut all: Vec<([f64; 2], f64)> = Vec::new();
    let plates = &data.plan.job.plates;
    all.extend(plates.iter().map(|plate| (plate.centre_xy(), plate.rim_m())));
    let tracks = data.planned.iter().chain(data.followed.iter().flatten()).flatten();
    all.extend(tracks.map(|tip| ([tip.at.x, tip.at.y], 0.0)));
    if let Some(radius_m) = data.region.base_circle_m {
        all.push((data.mount().translation.vector.xy().into(), radius_m));
    }
    all.extend(arm(data).into_iter().flatten().map(|corner| (corner, 0.0)));
    all.extend(data.region.polygon_m.iter().flatten().map(|corner| (*corner, 0.0)));
    let bounds = |all: &[([f64; 2], f64)]| {
        let least = |k: usize| all.iter().map(|(at, r)| at[k] - r).fold(f64::INFINITY, f64::min);
        let most = |k: usize| all.iter().map(|(at, r)| at[k] + r).fold(f64::NEG_INFINITY, f64::max);
        [[least(0), least(1)], [most(0), most(1)]]
    };
    // Bodies around widen the view by a border at most.
    let [low, high] = bounds(&all);
    let near = |corner: [f64; 2]| [0, 1].map(|k| corner[k].clamp(low[k] - AROUND_M, high[k] + AROUND_M));
    let obstacles = outline::obstacles(&data.plan.job.workcell);
    all.extend(obstacles.into_iter().flatten().map(|corner| (near(corner), 0.0)));
    bounds(&all)
}

/// Draws the region of the plates, the circle about the base, the bodies around, the plates and the arm at its start.
fn ground(drawing: &mut Drawing, map: &Map, data: &FigureData<'_>) {
    let (job, region) = (&data.plan.job, &data.region);
    if let Some(polygon) = &region.polygon_m {
        drawing.polygon(&map.spots(polygon), &(outlined(GROUND, LINE, 1.4) + DASHED));
    }
    let base = data.mount().translation.vector;
    if let Some(radius_m) = region.base_circle_m {
        let circle = stroke(GREY, 1.6) + DOTTED;
        drawing.circle(map.spot([base.x, base.y]), map.pixels(radius_m), &circle);
    }
    let mut bodies = |outlines: Vec<Outline>, look: &str| {
        outlines
            .iter()
            .for_each(|outline| drawing.polygon(&map.spots(outline), look));
    };
    bodies(outline::obstacles(&job.workcell), &outlined(OBSTACLE, LINE, 1.2));
    let tilted = job.plates.iter().filter(|plate| !is_level(plate));
    bodies(tilted.map(tilted_plate).collect(), &outlined(PAPER, LINE, 2.0));
    for plate in job.plates.iter().filter(|plate| is_level(plate)) {
        let at = map.spot(plate.centre_xy());
        drawing.circle(at, map.pixels(plate.rim_m()), &outlined(PAPER, LINE, 2.0));
        // Where a profile bends.
        if let Surface::Profile(meridian) = &plate.surface {
            let inside = meridian.knots().iter().filter(|knot| knot.radius_m < plate.rim_m());
            inside.for_each(|knot| drawing.circle(at, map.pixels(knot.radius_m), &stroke("#dde2e8", 1.0)));
        }
    }
    map.arm(drawing, &arm(data));
}

/// The arm at the start of the motion: at home, or at the stop of a recovery.
fn arm(data: &FigureData<'_>) -> Vec<Outline> {
    let job = &data.plan.job;
    arm_outlines(data.arm, &job.workcell.tool, data.mount(), &job.home_rad[0])
}

fn is_level(plate: &Plate) -> bool {
    plate.axis().xy().norm() <= LEVEL
}

fn tilted_plate(plate: &Plate) -> Outline {
    let [below_m, above_m] = plate.extent_m();
    let body = Shape::Cylinder {
        radius_m: plate.rim_m(),
        half_length_m: 0.5 * (above_m - below_m),
    };
    solid(
        &body,
        &(plate.pose * Pose::translation(0.0, 0.0, 0.5 * (above_m + below_m))),
    )
}

fn draw_paths(drawing: &mut Drawing, map: &Map, data: &FigureData<'_>) {
    let spot = |tip: &Tip| map.spot([tip.at.x, tip.at.y]);
    let parts = |of: &[SegmentKind]| -> Vec<Vec<Spot>> {
        let all = data.plan.segments.iter().zip(&data.planned);
        let wanted = all.filter(|(segment, _)| of.contains(&segment.kind));
        wanted.map(|(_, way)| way.iter().map(spot).collect()).collect()
    };
    let between = parts(&[SegmentKind::Depart, SegmentKind::Transit, SegmentKind::Return]);
    let washes = parts(&[SegmentKind::Wash]);
    drawing.group("class=\"washes\"", |drawing| {
        washes
            .iter()
            .for_each(|wash| drawing.lines(std::slice::from_ref(wash), &stroke(WASH, 2.4)));
    });
    drawing.group("class=\"transits\"", |drawing| {
        drawing.lines(&between, &stroke(PAPER, 4.6));
        for transit in &between {
            let (before, after) = transit.split_at(transit.len() / 2);
            let arrow = stroke(TRANSIT, 2.4) + DASHED + " marker-end=\"url(#platewash-arrow)\"";
            let joined = before.last().into_iter().chain(after).copied().collect();
            drawing.lines(&[before.to_vec()], &arrow);
            drawing.lines(&[joined], &(stroke(TRANSIT, 2.4) + DASHED));
        }
    });
    drawing.lines(
        &parts(&[SegmentKind::Approach, SegmentKind::Retreat]),
        &stroke(LIFT, 3.4),
    );
    if let Some((followed, _)) = seen_apart(data) {
        let executed = followed.iter().flatten().map(spot).collect();
        drawing.lines(&[executed], &stroke(EXECUTED, 1.3));
    }
    if let Some(home) = data.planned.iter().flatten().next() {
        drawing.circle(spot(home), 7.0, &outlined(PAPER, INK, 2.6));
    }
}

/// The number of each plate.
fn numbers(drawing: &mut Drawing, map: &Map, data: &FigureData<'_>) {
    for (index, plate) in data.plan.job.plates.iter().enumerate() {
        let size = (0.4 * map.pixels(plate.rim_m())).clamp(9.0, 24.0);
        let [x, y] = map.spot(plate.centre_xy());
        let letters = format!("font-size=\"{size:.1}\" font-weight=\"bold\" fill=\"{INK}\"");
        drawing.circle([x, y], 0.78 * size, &outlined(PAPER, INK, 1.6));
        drawing.text([x, y + 0.36 * size], &format!("{}", index + 1), &[&letters, MIDDLE]);
    }
}

/// Returns the executed path, where it differs visibly from the planned one.
fn seen_apart<'s>(data: &'s FigureData<'_>) -> Option<(&'s Track, &'s SimulationReport)> {
    let both = data.followed.as_ref().zip(data.report);
    both.filter(|(_, report)| report.tracking.tip_m.max > APART_M)
}

/// The plates in their order, as many as there is room for.
fn table(drawing: &mut Drawing, data: &FigureData<'_>, room: Rect) {
    let order = &data.plan.order;
    if order.is_empty() {
        return;
    }
    let height = (room.size[1] / (order.len() + 1) as f64).clamp(26.0, ROW);
    let shown = (room.size[1] / height) as usize;
    let share = match (data.certificate, data.plan.job.treatment()) {
        (Some(_), Treatment::Washed) => "pressed ≥",
        (Some(_), Treatment::Swept) => "proved ≥",
        (Some(_), Treatment::SweptInAir) => "in the air ≥",
        (None, _) => "swept",
    };
    let mut row = |place: usize, cells: [String; 5], looks: [&str; 2]| {
        let y = room.at[1] + height * (place as f64 + 0.7);
        for (k, (cell, right)) in cells.iter().zip([0.14, 0.29, 0.48, 0.7, 1.0]).enumerate() {
            let look = looks[usize::from(k > 0)];
            drawing.text([room.at[0] + right * room.size[0], y], cell, &[look, END]);
        }
    };
    let head = ["order", "plate", "x [m]", "y [m]", share].map(str::to_owned);
    row(0, head, [SMALL; 2]);
    for (place, &index) in order.iter().enumerate().take(shown.saturating_sub(1)) {
        let Some(plate) = data.plan.job.plates.get(index) else {
            continue;
        };
        let [x, y] = plate.centre_xy().map(|metres| fixed(metres, 3));
        let share = share_of(data, plate, index).map_or_else(|| "–".to_owned(), per_cent);
        let cells = [format!("{}.", place + 1), format!("{}", index + 1), x, y, share];
        row(place + 1, cells, [BOLD, WORDS]);
    }
}

/// The share of a plate that is proved; without a certificate, the one that an arm swept.
fn share_of(data: &FigureData<'_>, plate: &Plate, index: usize) -> Option<f64> {
    let counted = PressedRule::on(plate, &data.plan.job);
    if let Some(certificate) = data.certificate {
        return proved_share(certificate, index, counted);
    }
    let outcome = data.report?.plates.iter().find(|outcome| outcome.plate == index)?;
    Some(outcome.executed.lower)
}

fn entries(data: &FigureData<'_>) -> Vec<Entry> {
    let (job, region) = (&data.plan.job, &data.region);
    let transits = stroke(TRANSIT, 2.4) + DASHED;
    let wash = Entry::new(Sign::Line, stroke(WASH, 2.4), "the tip while it washes");
    let mut all: Vec<_> = data.has(SegmentKind::Wash).then_some(wash).into_iter().collect();
    all.push(Entry::new(Sign::Line, transits, "transits, and from and to home"));
    if data.has(SegmentKind::Approach) || data.has(SegmentKind::Retreat) {
        all.push(Entry::new(Sign::Line, stroke(LIFT, 3.4), "down to a plate and up"));
    }
    if let Some(report) = data.report {
        let (law, off_mm) = (report.law.name(), 1e3 * report.tracking.tip_m.max + 0.005);
        all.push(match seen_apart(data) {
            Some(_) => Entry::new(
                Sign::Line,
                stroke(EXECUTED, 1.3),
                format!("the tip as the law “{law}” moves it"),
            ),
            None => Entry::new(
                Sign::Line,
                stroke("none", 0.0),
                format!("the law “{law}” keeps it within {off_mm:.2} mm of this"),
            ),
        });
    }
    let start = if job.is_motion_home() { "the stop" } else { "home" };
    let tip = format!("the tip at {start}");
    all.push(Entry::new(Sign::Dot, outlined(PAPER, INK, 2.6), tip));
    all.push(Entry::new(
        Sign::Field,
        arm_look(),
        format!("the arm with its tool at {start}"),
    ));
    if !outline::obstacles(&job.workcell).is_empty() {
        all.push(Entry::new(
            Sign::Field,
            outlined(OBSTACLE, LINE, 1.2),
            "what stands around",
        ));
    }
    if let Some(radius) = region.base_circle_m {
        let words = format!("base circle, radius {radius} m: no centre within it");
        all.push(Entry::new(Sign::Line, stroke(GREY, 1.6) + DOTTED, words));
    }
    if region.polygon_m.is_some() {
        let look = outlined(GROUND, LINE, 1.4) + DASHED;
        all.push(Entry::new(Sign::Field, look, "region of the plates' centres"));
    }
    all
}
