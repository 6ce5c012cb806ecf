//! The workcell from above: plates in their order, what is washed, the ways between (the paper's Fig. 2).

use super::bodies;
use super::ink::axes::Axes;
use super::ink::drawing::{Drawing, Lettering, Rect, Spot};
use super::ink::legend::{self, Entry};
use super::ink::page;
use super::ink::palette::{EXECUTED, GREY, GROUND, INK, LIFT, LINE, PAPER, TRANSIT, WASH};
use super::ink::style::Style;
use super::ink::table::{self, Cell, Column, Side};
use super::outline::hull;
use super::subject::Subject;
use super::track::Track;
use super::wording::per_cent;
use crate::view::Counted;
use crate::view::coverage::proved_share;
use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::JointVector;
use platewash_kinematics::trig::sin_cos;
use platewash_workcell::plate::Plate;
use platewash_workcell::segment::SegmentKind;
use platewash_workcell::surface::Surface;
use std::f64::consts::{FRAC_PI_4, TAU};

/// Width of what stands beside the map \[px\].
const BESIDE: f64 = 430.0;

/// White between the outermost thing and the frame \[m\].
const WHITE_M: f64 = 0.05;

/// Ways that are nearer to each other look like one \[m\].
const APART_M: f64 = 1e-3;

/// How far obstacles are shown beyond everything else \[m\].
const AROUND_M: f64 = 0.12;

/// The colour of what stands around.
const OBSTACLE: &str = "#d5d8df";

/// The colour of where a profile bends.
const KNOT: &str = "#dde2e8";

/// Sine of the angle to the vertical up to which a plate lies level; corners of the rim of one that does not.
const LEVEL: f64 = 1e-6;
const RIM: u32 = 96;

const TRANSIT_DASHES: &[f64] = &[9.0, 6.0];
const CIRCLE_DASHES: &[f64] = &[3.0, 5.0];
const REGION_DASHES: &[f64] = &[12.0, 5.0];

/// Draws it.
pub(super) fn draw(subject: &Subject<'_>) -> Drawing {
    let (mut drawing, room) = page::begin(&subject.words("Layout", caption(subject)));
    let [left, top] = room.at;
    let map = Rect::new(left + 62.0, top, room.size[0] - BESIDE - 92.0, room.size[1] - 58.0);
    let axes = map_axes(subject, map);
    let [across, up] = [axes.across.ticks(8), axes.up.ticks(7)];
    axes.grid(&mut drawing, &across, &up);
    drawing.within_rect(axes.frame, |drawing| {
        let map = Map { axes: &axes };
        map.ground(drawing, subject);
        map.obstacles(drawing, subject);
        map.plates(drawing, subject);
        map.ways(drawing, subject);
        map.numbers(drawing, subject);
    });
    axes.outline(&mut drawing);
    axes.numbers_below(&mut drawing, &across);
    axes.numbers_left(&mut drawing, &up);
    axes.name_below(&mut drawing, "y [m]");
    axes.name_left(&mut drawing, "x [m]", 54.0);
    let from = axes.frame.end()[0] + 34.0;
    let beside = Rect::new(from, top, room.end()[0] - from, room.size[1]);
    aside(&mut drawing, beside, subject);
    drawing
}

/// How it is looked at: where the arm is not turned, from behind it.
fn caption(subject: &Subject<'_>) -> &'static str {
    if subject.mount().rotation == UnitQuaternion::identity() {
        "Seen from above, from behind the arm: x leads away from it, y to its left. Numbers say in which order the plates are washed."
    } else {
        "Seen from above: the room's x leads up the page, its y to the left. Numbers say in which order the plates are washed."
    }
}

/// World x upwards, world y to the left, at one scale.
fn map_axes(subject: &Subject<'_>, room: Rect) -> Axes {
    let [low, high] = extent(subject);
    let need = [high[1] - low[1], high[0] - low[0]];
    let scale = (room.size[0] / need[0]).min(room.size[1] / need[1]);
    let half = room.size.map(|size| 0.5 * size / scale);
    // No wider than there is something to see.
    let half_across = half[0].min(0.5 * need[0] * 1.25);
    let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
    let width = 2.0 * half_across * scale;
    let frame = Rect::new(room.at[0], room.at[1], width, room.size[1]);
    Axes::new(
        frame,
        [middle[1] + half_across, middle[1] - half_across],
        [middle[0] - half[1], middle[0] + half[1]],
    )
}

/// Least and greatest x and y of everything that is drawn \[m\].
fn extent(subject: &Subject<'_>) -> [[f64; 2]; 2] {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    let mut hold = |[x, y]: [f64; 2], radius: f64| {
        low = [low[0].min(x - radius), low[1].min(y - radius)];
        high = [high[0].max(x + radius), high[1].max(y + radius)];
    };
    for plate in &subject.plan.job.plates {
        hold(plate.centre_xy(), plate.rim_m());
    }
    for point in subject.planned.points() {
        hold([point.at.x, point.at.y], 0.0);
    }
    if let Some(followed) = &subject.followed {
        followed
            .points()
            .iter()
            .for_each(|point| hold([point.at.x, point.at.y], 0.0));
    }
    let base = subject.mount().translation.vector;
    hold([base.x, base.y], subject.base_circle_m.unwrap_or(0.12));
    let region = subject.region_m.iter().flatten();
    region.for_each(|&corner| hold(corner, 0.0));
    // Of what stands around, what is near to all that.
    let near = [low.map(|c| c - AROUND_M), high.map(|c| c + AROUND_M)];
    for body in bodies::obstacles(&subject.plan.job.workcell) {
        for corner in seen_from_above(&body) {
            let corner = [0, 1].map(|k| corner[k].clamp(near[0][k], near[1][k]));
            low = [0, 1].map(|k| low[k].min(corner[k]));
            high = [0, 1].map(|k| high[k].max(corner[k]));
        }
    }
    [low.map(|c| c - WHITE_M), high.map(|c| c + WHITE_M)]
}

fn seen_from_above(body: &bodies::Placed) -> Vec<[f64; 2]> {
    let corners = body.facets.points.iter();
    corners.map(|at| (body.pose * at).xy().coords.into()).collect()
}

/// Both rims of a plate that does not lie level.
fn tilted(plate: &Plate) -> Vec<[f64; 2]> {
    let [below_m, above_m] = plate.extent_m();
    let rim = (0..RIM).flat_map(|k| {
        let (s, c) = sin_cos(TAU * f64::from(k) / f64::from(RIM));
        [below_m, above_m].map(|z| plate.world(&Vector3::new(plate.rim_m() * c, plate.rim_m() * s, z)))
    });
    rim.map(|at| at.xy().into()).collect()
}

struct Map<'a> {
    axes: &'a Axes,
}

impl Map<'_> {
    fn spot(&self, x: f64, y: f64) -> Spot {
        self.axes.at(y, x)
    }

    fn pixels(&self, length_m: f64) -> f64 {
        (self.axes.up.at(length_m) - self.axes.up.at(0.0)).abs()
    }

    fn line<'p>(&self, points: impl IntoIterator<Item = &'p [f64; 2]>) -> Vec<Spot> {
        points.into_iter().map(|&[x, y]| self.spot(x, y)).collect()
    }

    /// The arm at home, the circle about its base and the region of the plates.
    fn ground(&self, drawing: &mut Drawing, subject: &Subject<'_>) {
        if let Some(region) = &subject.region_m {
            let style = Style::fill(GROUND).outlined(LINE, 1.4).dashed(REGION_DASHES);
            drawing.polygon(&self.line(region), &style);
        }
        let base = subject.mount().translation.vector;
        if let Some(radius) = subject.base_circle_m {
            let style = Style::fill("none").outlined(GREY, 1.6).dashed(CIRCLE_DASHES);
            drawing.circle(self.spot(base.x, base.y), self.pixels(radius), &style);
        }
    }

    fn arm(&self, drawing: &mut Drawing, subject: &Subject<'_>) {
        let home: JointVector = subject.plan.job.home_rad[0];
        drawing.layer(0.55, |drawing| {
            for part in bodies::arm(subject.arm, subject.mount(), &home) {
                let outline = hull(&seen_from_above(&part));
                drawing.polygon(&self.line(&outline), &Style::fill("#f5a867").outlined("#f5a867", 0.8));
            }
        });
    }

    /// What stands around, as wide as it is anywhere.
    fn obstacles(&self, drawing: &mut Drawing, subject: &Subject<'_>) {
        for body in bodies::obstacles(&subject.plan.job.workcell) {
            let outline = hull(&seen_from_above(&body));
            drawing.polygon(
                &self.line(&outline),
                &Style::fill(OBSTACLE).outlined(LINE, 1.2).see_through(0.8),
            );
        }
    }

    fn plates(&self, drawing: &mut Drawing, subject: &Subject<'_>) {
        for plate in &subject.plan.job.plates {
            let [x, y] = plate.centre_xy();
            if plate.axis().xy().norm() > LEVEL {
                let outline = hull(&tilted(plate));
                drawing.polygon(
                    &self.line(&outline),
                    &Style::fill(PAPER).outlined(LINE, 2.0).see_through(0.9),
                );
                continue;
            }
            let (at, radius) = (self.spot(x, y), self.pixels(plate.rim_m()));
            drawing.circle(at, radius, &Style::fill(PAPER).outlined(LINE, 2.0).see_through(0.9));
            // Where a profile bends.
            let knots = match &plate.surface {
                Surface::Profile(meridian) => meridian.knots(),
                _ => &[],
            };
            for knot in knots.iter().filter(|knot| knot.radius_m < plate.rim_m()) {
                drawing.circle(at, self.pixels(knot.radius_m), &Style::fill("none").outlined(KNOT, 1.0));
            }
        }
        self.arm(drawing, subject);
    }

    fn ways(&self, drawing: &mut Drawing, subject: &Subject<'_>) {
        let way = |track: &Track, segment: usize| {
            let way: Vec<[f64; 2]> = track.way(segment).iter().map(|at| [at.x, at.y]).collect();
            self.line(&way)
        };
        let parts = |of: &dyn Fn(SegmentKind) -> bool| {
            let all = subject.plan.segments.iter().enumerate();
            let wanted = all.filter(|(_, segment)| of(segment.kind));
            wanted.map(|(k, _)| way(&subject.planned, k)).collect::<Vec<_>>()
        };
        let between = parts(&|kind| matches!(kind, SegmentKind::Depart | SegmentKind::Transit | SegmentKind::Return));
        let lifts = parts(&|kind| matches!(kind, SegmentKind::Approach | SegmentKind::Retreat));
        let washes = parts(&|kind| kind == SegmentKind::Wash);
        drawing.named("washes", |drawing| {
            washes
                .iter()
                .for_each(|wash| drawing.polyline(wash, &Style::line(WASH, 2.4)));
        });
        drawing.named("transits", |drawing| {
            for transit in &between {
                drawing.polyline(transit, &Style::line(PAPER, 4.6));
                drawing.polyline(transit, &Style::line(TRANSIT, 2.4).dashed(TRANSIT_DASHES));
                self.arrow(drawing, transit);
            }
        });
        drawing.polylines(&lifts, &Style::line(LIFT, 3.4));
        if let Some(followed) = seen_apart(subject) {
            let executed = (0..subject.plan.segments.len()).map(|k| way(followed, k));
            let executed: Vec<_> = executed.collect();
            drawing.named("executed", |drawing| {
                drawing.polylines(&executed, &Style::line(EXECUTED, 1.3))
            });
        }
        let home = subject.tip_pose(&subject.plan.job.home_rad[0]).translation.vector;
        let at = self.spot(home.x, home.y);
        drawing.circle(at, 7.0, &Style::fill(PAPER).outlined(INK, 2.6));
    }

    /// A tip of an arrow halfway along a line.
    fn arrow(&self, drawing: &mut Drawing, line: &[Spot]) {
        let lengths: Vec<f64> = line.windows(2).map(|two| distance(two[0], two[1])).collect();
        let all: f64 = lengths.iter().sum();
        if all < 40.0 {
            return;
        }
        let mut before = 0.0;
        for (two, length) in line.windows(2).zip(lengths) {
            before += length;
            if before >= 0.5 * all && length > 0.0 {
                let along = [(two[1][0] - two[0][0]) / length, (two[1][1] - two[0][1]) / length];
                let at = |forward: f64, aside: f64| {
                    [
                        two[1][0] + forward * along[0] - aside * along[1],
                        two[1][1] + forward * along[1] + aside * along[0],
                    ]
                };
                let tip = [at(12.0, 0.0), at(-7.0, 8.0), at(-3.0, 0.0), at(-7.0, -8.0)];
                drawing.polygon(&tip, &Style::fill(TRANSIT).outlined(PAPER, 1.2));
                return;
            }
        }
    }

    /// Of the places around a plate's centre, at a distance \[m\], the one that is farthest from transits and home.
    fn aside(&self, subject: &Subject<'_>, [x, y]: [f64; 2], distance_m: f64) -> Spot {
        let home = subject.tip_pose(&subject.plan.job.home_rad[0]).translation.vector;
        let wash = |segment: usize| {
            subject
                .plan
                .segments
                .get(segment)
                .is_some_and(|s| s.kind == SegmentKind::Wash)
        };
        let between = subject.planned.points().iter().filter(|point| !wash(point.segment));
        let taken: Vec<Spot> = between
            .map(|point| self.spot(point.at.x, point.at.y))
            .chain([self.spot(home.x, home.y)])
            .collect();
        let places = (0..12).map(|k| {
            let (s, c) = sin_cos(FRAC_PI_4 + TAU * f64::from(k) / 12.0);
            self.spot(x + distance_m * c, y + distance_m * s)
        });
        let free = |at: &Spot| {
            taken
                .iter()
                .map(|other| distance(*at, *other))
                .fold(1e3, f64::min)
                .min(90.0)
                .round()
        };
        let mut best = (f64::NEG_INFINITY, self.spot(x, y));
        for at in places {
            // Of equal ones the first.
            if free(&at) > best.0 {
                best = (free(&at), at);
            }
        }
        best.1
    }

    /// The place of each plate in the order of washing.
    fn numbers(&self, drawing: &mut Drawing, subject: &Subject<'_>) {
        for (place, &index) in subject.plan.order.iter().enumerate() {
            let Some(plate) = subject.plan.job.plates.get(index) else {
                continue;
            };
            let radius = self.pixels(plate.rim_m());
            let size = (0.5 * radius).clamp(9.0, 27.0);
            let [x, y] = plate.centre_xy();
            let at = self.aside(subject, [x, y], 0.62 * plate.rim_m());
            drawing.circle(at, 0.78 * size, &Style::fill(PAPER).outlined(INK, 1.6));
            let how = Lettering::new(size, INK).bold().centred();
            drawing.text([at[0], at[1] + how.drop()], &format!("{}", place + 1), &how);
        }
    }
}

/// The way that was followed, where it can be told from the planned one.
fn seen_apart<'s>(subject: &'s Subject<'_>) -> Option<&'s Track> {
    let (_, report) = subject.executed?;
    subject
        .followed
        .as_ref()
        .filter(|_| report.tracking.tip_m.max > APART_M)
}

fn distance(a: Spot, b: Spot) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    (dx * dx + dy * dy).sqrt()
}

/// The legend and the plates in their order.
fn aside(drawing: &mut Drawing, room: Rect, subject: &Subject<'_>) {
    let end = legend::column(drawing, room.at, room.size[0], &entries(subject));
    let top = end + 22.0;
    let left = Rect::new(room.at[0], top, room.size[0], room.end()[1] - top);
    let rows: Vec<Vec<Cell>> = subject
        .plan
        .order
        .iter()
        .enumerate()
        .filter_map(|(place, &plate)| row(subject, place, plate))
        .collect();
    let wide = room.size[0] / 430.0;
    let columns = [
        ("", 46.0, Side::Right),
        ("plate", 78.0, Side::Right),
        ("x [m]", 82.0, Side::Right),
        ("y [m]", 86.0, Side::Right),
        (
            if subject.certificate.is_some() && subject.plan.job.requirements.contact.is_some() {
                "pressed ≥"
            } else if subject.certificate.is_some() {
                "proved ≥"
            } else {
                "swept"
            },
            122.0,
            Side::Right,
        ),
    ]
    .map(|(heading, width, side)| Column {
        heading,
        width: width * wide,
        side,
    });
    table::draw(drawing, left, [26.0, 34.0], &columns, &rows);
}

fn row(subject: &Subject<'_>, place: usize, index: usize) -> Option<Vec<Cell>> {
    let plate = subject.plan.job.plates.get(index)?;
    let [x, y] = plate.centre_xy();
    let counted = Counted::on(plate, &subject.plan.job);
    let proved = subject
        .certificate
        .and_then(|certificate| proved_share(certificate, index, counted));
    let swept = subject.executed.and_then(|(_, report)| {
        let of = report.plates.iter().find(|outcome| outcome.plate == index);
        of.map(|outcome| outcome.executed.lower)
    });
    let share = if subject.certificate.is_some() { proved } else { swept };
    let number = |value: f64| super::ink::axes::minus(&format!("{value:.3}"));
    Some(vec![
        Cell::marked(format!("{}", place + 1), INK),
        Cell::new(format!("{index}")),
        Cell::new(number(x)),
        Cell::new(number(y)),
        Cell::new(share.map_or_else(|| "–".to_owned(), per_cent)),
    ])
}

fn entries(subject: &Subject<'_>) -> Vec<Entry> {
    let mut all = vec![
        Entry::line(Style::line(WASH, 2.4), "the tip while it washes"),
        Entry::line(
            Style::line(TRANSIT, 2.4).dashed(TRANSIT_DASHES),
            "transits, and from and to home",
        ),
    ];
    let has = |of: SegmentKind| subject.plan.segments.iter().any(|segment| segment.kind == of);
    if has(SegmentKind::Approach) || has(SegmentKind::Retreat) {
        all.push(Entry::line(Style::line(LIFT, 3.4), "down to a plate and up"));
    }
    if let Some((_, report)) = subject.executed {
        let law = report.law.name();
        all.push(match seen_apart(subject) {
            Some(_) => Entry::line(
                Style::line(EXECUTED, 1.3),
                format!("the tip as the law “{law}” moves it"),
            ),
            None => Entry::line(
                Style::line("none", 0.0),
                format!(
                    "the law “{law}” keeps it within {:.2} mm of this",
                    1e3 * report.tracking.tip_m.max + 0.005
                ),
            ),
        });
    }
    all.push(Entry::dot(Style::fill(PAPER).outlined(INK, 2.6), "the tip at home"));
    all.push(Entry::field(
        Style::fill("#f5a867").see_through(0.55),
        "the arm at home",
    ));
    if !bodies::obstacles(&subject.plan.job.workcell).is_empty() {
        let style = Style::fill(OBSTACLE).outlined(LINE, 1.2).see_through(0.8);
        all.push(Entry::field(style, "what stands around"));
    }
    if let Some(radius) = subject.base_circle_m {
        let style = Style::line(GREY, 1.6).dashed(CIRCLE_DASHES);
        all.push(Entry::line(
            style,
            format!("base circle, radius {radius} m: no centre within it"),
        ));
    }
    if subject.region_m.is_some() {
        let style = Style::fill(GROUND).outlined(LINE, 1.4).dashed(REGION_DASHES);
        all.push(Entry::field(style, "region of the plates' centres"));
    }
    all
}
