//! Facets and lines that are to be drawn, and their drawing.

use super::super::ink::drawing::{Drawing, Rect, Spot};
use super::super::ink::style::Style;
use super::super::outline::hull;
use super::camera::Camera;
use super::light::{Light, Rgb, written};
use super::order::{Piece, sorted};
use super::paint::Painter;
use super::shapes::Facets;
use nalgebra::{Point3, Vector3};
use platewash_kinematics::Pose;
use std::collections::BTreeMap;

/// Cosine of the angle between facets from which their edge is drawn: 35°.
const CREASE: f64 = 0.82;

/// By how much lines are nearer to the eye than what they are drawn on \[m\].
const LIFT_M: f64 = 6e-4;

/// How dark a shadow is: 0 for not at all.
const SHADOW: f64 = 0.13;

/// What a piece is a piece of.
#[derive(Debug, Clone)]
enum Part {
    /// A facet of a body with that colour; shadows fall on it where it says so.
    Facet { colour: Rgb, lit: Option<usize> },
    /// A line.
    Line(Style),
}

/// Bodies and lines in the world.
#[derive(Debug, Default)]
pub struct Scene {
    bodies: Vec<Body>,
    lines: Vec<(Vec<Vector3<f64>>, Style)>,
}

#[derive(Debug)]
struct Body {
    points: Vec<Vector3<f64>>,
    faces: Vec<Vec<usize>>,
    colour: Rgb,
    /// Whether shadows of others are drawn on its level upper side.
    takes_shadows: bool,
}

impl Scene {
    /// Adds a body of a colour at `T_world_body`.
    pub fn add(&mut self, facets: &Facets, pose: &Pose, colour: Rgb) {
        let place = |point: &Point3<f64>| (pose * point).coords;
        self.bodies.push(Body {
            points: facets.points.iter().map(place).collect(),
            faces: facets.faces.clone(),
            colour,
            takes_shadows: false,
        });
    }

    /// Adds a body on which the shadows of the others are drawn.
    pub fn add_table(&mut self, facets: &Facets, pose: &Pose, colour: Rgb) {
        self.add(facets, pose, colour);
        if let Some(body) = self.bodies.last_mut() {
            body.takes_shadows = true;
        }
    }

    /// Adds a line through places, world frame \[m\].
    pub fn line(&mut self, through: Vec<Vector3<f64>>, style: Style) {
        self.lines.push((through, style));
    }

    /// All corners of bodies.
    pub fn corners(&self) -> impl Iterator<Item = Vector3<f64>> + '_ {
        self.bodies.iter().flat_map(|body| body.points.iter().copied())
    }

    /// Draws the shadows that fall on the plane z = 0.
    pub fn draw_shadows(&self, drawing: &mut Drawing, camera: &Camera) {
        let light = Light::of(camera);
        let shadows = self.shadows_on(camera, &light, (&Vector3::zeros(), &Vector3::z()), usize::MAX);
        drawing.layer(SHADOW, |drawing| draw_all(drawing, &shadows));
    }

    /// The shadows of all bodies but one on a plane, each as a polygon on the sheet.
    fn shadows_on(
        &self,
        camera: &Camera,
        light: &Light,
        plane: (&Vector3<f64>, &Vector3<f64>),
        but: usize,
    ) -> Vec<Vec<Spot>> {
        let mut all = Vec::new();
        for (k, body) in self.bodies.iter().enumerate() {
            // What is below a plane throws no shadow on it.
            let above = body
                .points
                .iter()
                .filter(|point| plane.1.dot(&(*point - plane.0)) > -1e-6);
            let seen: Vec<Spot> = above
                .filter_map(|point| camera.see(&light.shadow(point, plane)))
                .collect();
            if k != but && seen.len() > 2 {
                all.push(hull(&seen));
            }
        }
        all
    }

    /// Draws bodies and lines, what is behind first.
    pub fn draw(&self, drawing: &mut Drawing, camera: &Camera) {
        let light = Light::of(camera);
        let (mut parts, mut flat, mut lines) = (Vec::new(), Vec::new(), Vec::new());
        for (index, body) in self.bodies.iter().enumerate() {
            body.pieces(index, camera, (&mut parts, &mut flat, &mut lines));
        }
        for (through, style) in &self.lines {
            let of = parts.len();
            parts.push(Part::Line(style.clone()));
            lines.extend(through.windows(2).map(|two| stretch(two[0], two[1], camera, of)));
        }
        let mut painter = Painter::new(drawing);
        for piece in sorted(flat, lines, &camera.eye) {
            let seen: Option<Vec<Spot>> = piece.corners.iter().map(|corner| camera.see(corner)).collect();
            let Some(seen) = seen else { continue };
            match &parts[piece.of] {
                Part::Line(style) => painter.line(seen, style),
                Part::Facet { colour, lit } => {
                    let shade = written(light.on(*colour, &piece.normal));
                    let shadows = lit.map(|body| self.shadows_in(camera, &light, &piece, body));
                    // The outline hides the seam to the next facet.
                    painter.field(seen.clone(), &Style::fill(shade.clone()).outlined(shade, 0.6));
                    if let Some(shadows) = shadows.filter(|shadows| !shadows.is_empty()) {
                        painter.over(|drawing| {
                            drawing.within_polygon(&seen, |drawing| {
                                drawing.layer(SHADOW, |drawing| draw_all(drawing, &shadows));
                            });
                        });
                    }
                }
            }
        }
        painter.close();
    }

    /// The shadows of all bodies but one that fall on a facet.
    fn shadows_in(&self, camera: &Camera, light: &Light, facet: &Piece, but: usize) -> Vec<Vec<Spot>> {
        let seen: Vec<Spot> = facet.corners.iter().filter_map(|corner| camera.see(corner)).collect();
        let mut shadows = self.shadows_on(camera, light, (&facet.corners[0], &facet.normal), but);
        shadows.retain(|shadow| bounds(shadow).meets(&bounds(&seen)));
        shadows
    }
}

/// The least rectangle about a polygon.
fn bounds(polygon: &[Spot]) -> Rect {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for spot in polygon {
        low = [0, 1].map(|k| low[k].min(spot[k]));
        high = [0, 1].map(|k| high[k].max(spot[k]));
    }
    Rect {
        at: low,
        size: [0, 1].map(|k| high[k] - low[k]),
    }
}

fn draw_all(drawing: &mut Drawing, polygons: &[Vec<Spot>]) {
    drawing.polygons(polygons, &Style::fill("#000000"));
}

/// A stretch of a line, a little nearer to the eye.
fn stretch(from: Vector3<f64>, to: Vector3<f64>, camera: &Camera, of: usize) -> Piece {
    let lifted = |at: Vector3<f64>| at + (camera.eye - at).normalize() * LIFT_M;
    Piece {
        corners: vec![lifted(from), lifted(to)],
        normal: Vector3::zeros(),
        of,
    }
}

impl Body {
    /// The facets that face the eye, and the edges that are drawn.
    fn pieces(
        &self,
        index: usize,
        camera: &Camera,
        (parts, flat, lines): (&mut Vec<Part>, &mut Vec<Piece>, &mut Vec<Piece>),
    ) {
        let facet = parts.len();
        let colour = self.colour;
        parts.push(Part::Facet { colour, lit: None });
        parts.push(Part::Facet {
            colour,
            lit: Some(index),
        });
        parts.push(Part::Line(Style::line(
            written(self.colour.map(|part| 0.42 * part)),
            0.9,
        )));
        let mut beside: BTreeMap<[usize; 2], Vec<(Vector3<f64>, bool)>> = BTreeMap::new();
        for face in &self.faces {
            let corners: Vec<Vector3<f64>> = face.iter().map(|&k| self.points[k]).collect();
            let Some(normal) = normal(&corners) else { continue };
            let faces_eye = normal.dot(&(camera.eye - corners[0])) > 1e-9;
            for (k, &a) in face.iter().enumerate() {
                let b = face[(k + 1) % face.len()];
                beside
                    .entry([a.min(b), a.max(b)])
                    .or_default()
                    .push((normal, faces_eye));
            }
            if faces_eye {
                let lit = self.takes_shadows && normal.z > 0.999;
                flat.push(Piece {
                    corners,
                    normal,
                    of: facet + usize::from(lit),
                });
            }
        }
        for ([a, b], faces) in beside {
            let seen = faces.iter().any(|(_, faces_eye)| *faces_eye);
            let drawn = match faces[..] {
                [(n, front), (m, other)] => front != other || n.dot(&m) < CREASE,
                _ => true,
            };
            if seen && drawn {
                lines.push(stretch(self.points[a], self.points[b], camera, facet + 2));
            }
        }
    }
}

/// Unit normal of a flat polygon (Newell's sum); `None` where it has no area.
fn normal(corners: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let mut sum = Vector3::zeros();
    for (k, corner) in corners.iter().enumerate() {
        sum += corner.cross(&corners[(k + 1) % corners.len()]);
    }
    let length = sum.norm();
    (length > 1e-14).then(|| sum / length)
}
