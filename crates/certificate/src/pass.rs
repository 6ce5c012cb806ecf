//! What the place under the tip does on a curved face over a stretch of time: how the height over the face bends, how the normal turns.
//!
//! With ρ the place's distance from the plate's axis, v and a bounds of the tip's speed and acceleration, β the slope, K the greatest
//! curvature within the places passed, a length of the meridian κ and across it sin β / ρ:
//!
//! - ρ̈ ≤ a + v²/ρ, so that ρ leaves the values at its ends by at most h²/8 of that;
//! - the height z − f(ρ) has a second derivative of at most a / cos β + K v² / cos³ β, as the Hessian of f is no greater than K / cos³ β;
//! - on a piece of the meridian sin β = A + κ ρ, so that the normal n = (−A ρ̂ − κ (x, y), cos β) has, with |ρ̂˙| ≤ v/ρ and
//!   |ρ̂¨| ≤ a/ρ + 2 v²/ρ², |ṅ_xy| ≤ |A| v/ρ + |κ| v and |n̈_xy| ≤ |A| (a/ρ + 2 v²/ρ²) + |κ| a; with S = sin β, |Ṡ| ≤ |κ| v and
//!   |S S̈| ≤ |S κ| a + |S/ρ| |κ| v², |ṅ_z| ≤ |S Ṡ|/cos β and |n̈_z| ≤ (Ṡ² + |S S̈|)/cos β + S² Ṡ²/cos³ β;
//! - where pieces of the meridian meet within the places passed, sin β leaves the line through its values at both ends by no more than
//!   the difference of the greatest and the least κ times the width of the places, and the normal by that over cos β.
//!
//! What is said of a sum n × a of normal and axis follows: its second derivative is at most ‖n̈‖ + 2 ‖ṅ‖ ‖ȧ‖ + ‖ä‖.

use crate::face::{Face, norm};
use crate::tip::{Derivatives, Stretch};
use platewash_workcell::surface::Surface;

/// What the place under the tip does on a curved face over a stretch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pass {
    /// Least and greatest distance from the plate's axis \[m\].
    rho_m: [f64; 2],
    /// v \[m/s\].
    speed: f64,
    /// a \[m/s²\].
    acceleration: f64,
    /// The greatest |sin β|, and the least cos β.
    sine: f64,
    cosine: f64,
    /// K \[1/m\].
    greatest: f64,
    /// Least and greatest κ \[1/m\].
    kappa: [f64; 2],
    /// The greatest |A|.
    intercept: f64,
}

impl Pass {
    /// That of a stretch over a face.
    pub fn new(face: &Face<'_>, stretch: &Stretch<'_>, bounds: &Derivatives) -> Self {
        let surface = face.surface();
        let acceleration = bounds.second();
        let ends = stretch.ends.each_ref();
        let [from, to] = ends.map(|m| m.speed.norm());
        let speed = from.max(to) + stretch.sag(bounds.third()).min(0.5 * stretch.length_s() * acceleration);
        let rho = ends.map(|m| {
            let seen = face.seen(&m.position);
            norm(seen.x, seen.y)
        });
        let (near, far) = (rho[0].min(rho[1]), rho[0].max(rho[1]));
        let way_m = 0.5 * stretch.length_s() * speed;
        let least = near - way_m;
        let bulge_m = if least > 0.0 {
            way_m.min(stretch.sag(acceleration + speed * speed / least))
        } else {
            way_m
        };
        let rho_m = [(near - bulge_m).max(0.0), far + bulge_m];
        let (kappa, begins_flat) = curvatures(surface, rho_m);
        let patch = surface.patch(rho_m);
        let bent = (kappa[1] - kappa[0]) * (rho_m[1] - rho_m[0]);
        let sine = (patch.sine[0].abs().max(patch.sine[1].abs()) + bent).min(1.0);
        let steepest = kappa[0].abs().max(kappa[1].abs());
        let at = surface.at_radius(rho_m[0]);
        let intercept = match kappa[1] - kappa[0] {
            _ if begins_flat => 0.0,
            0.0 => (at.sine - at.curvature * rho_m[0]).abs(),
            _ => sine + steepest * rho_m[1],
        };
        Self {
            rho_m,
            speed,
            acceleration,
            sine,
            cosine: (1.0 - sine * sine).max(0.0).sqrt(),
            greatest: patch.greatest_curvature(),
            kappa,
            intercept,
        }
    }

    /// What the second derivative of the height over the face is not above \[m/s²\].
    pub fn bend_of_height(&self) -> f64 {
        let (c, v) = (self.cosine, self.speed);
        self.acceleration / c + self.greatest / (c * c * c) * v * v
    }

    /// By how much the sine of an axis against the normal may be above its values at the ends of a stretch, where the axis has at most
    /// a first and a second derivative \[1/s, 1/s²\].
    pub fn sag_of_sine(&self, stretch: &Stretch<'_>, [first, second]: [f64; 2]) -> f64 {
        let [turn, bend] = self.of_normal();
        let kinks = (self.kappa[1] - self.kappa[0]) * (self.rho_m[1] - self.rho_m[0]) / self.cosine;
        stretch.sag(bend + 2.0 * turn * first + second) + kinks
    }

    /// ‖ṅ‖ and ‖n̈‖ at most \[1/s, 1/s²\].
    fn of_normal(&self) -> [f64; 2] {
        let Self {
            speed: v,
            acceleration: a,
            sine: s,
            cosine: c,
            ..
        } = *self;
        let k = self.kappa[0].abs().max(self.kappa[1].abs());
        // Without an intercept the pole is no place of its own.
        let [first, second] = match self.intercept {
            0.0 => [0.0; 2],
            intercept => {
                let rho = self.rho_m[0];
                [intercept * v / rho, intercept * (a / rho + 2.0 * v * v / (rho * rho))]
            }
        };
        // |S/ρ| ≤ |A|/ρ + |κ|.
        let over_rho = match self.intercept {
            0.0 => k,
            intercept => intercept / self.rho_m[0] + k,
        };
        let slide = k * v;
        let bend_of_z = (slide * slide + s * k * a + over_rho * k * v * v) / c + s * s * slide * slide / (c * c * c);
        [first + k * v + s * slide / c, second + k * a + bend_of_z]
    }
}

/// Least and greatest curvature along the meridian between two ρ \[1/m\], and whether all of it belongs to the piece next to the pole.
fn curvatures(surface: &Surface, [least, most]: [f64; 2]) -> ([f64; 2], bool) {
    let Surface::Profile(meridian) = surface else {
        return ([0.0; 2], true);
    };
    let first = surface.at_radius(least).curvature;
    let mut bounds = [first; 2];
    for knot in meridian.knots() {
        if knot.radius_m > least && knot.radius_m <= most {
            let next = surface.at_radius(knot.radius_m).curvature;
            bounds = [bounds[0].min(next), bounds[1].max(next)];
        }
    }
    let ends_m = meridian.knots().first().map_or(0.0, |knot| knot.radius_m);
    (bounds, most < ends_m)
}
