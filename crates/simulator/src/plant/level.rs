//! A sponge on a flat face: the sums of [`super::sponge`] over columns, without a column to be met one by one.
//!
//! On a level face the compression is linear across the sponge: of a column at (x, y) on the unit disc, w = w₀ − s·(x, y), with
//! w₀ = c − z/cos τ and s = r (u_z, v_z)/cos τ. As long as every column is compressed, within the limit of the foam, undamped and on the
//! plate, the sums over columns have a closed form: Σ share = 1, Σ share x = Σ share y = Σ share x y = 0 and Σ share x² = Σ share y² = m, as
//! each ring of columns is a regular polygon of six corners or more. Then Σ share w = w₀ and Σ share w² = w₀² + m |s|².

use crate::plant::foam::{DENSE_STRAIN, Foam, FoamLoad, Wrench, rim_within, share_within};
use nalgebra::Vector3;
use platewash_bodies::contact::{Columns, SpongePose};
use std::f64::consts::PI;

/// The columns of a sponge, for flat faces.
#[derive(Debug, Clone)]
pub(crate) struct LevelColumns {
    /// Place on the unit disc, and area \[m²\]; ring by ring, the outermost last.
    parts: Vec<([f64; 2], f64)>,
    /// Columns of the outermost ring: the most compressed one is among them.
    outermost: usize,
    /// m.
    second_moment: f64,
    area_m2: f64,
    radius_m: f64,
    compression_m: f64,
    half_width_m: f64,
}

impl LevelColumns {
    pub fn new(columns: &Columns) -> Self {
        let foundation = columns.foundation();
        let area_m2 = PI * foundation.radius_m * foundation.radius_m;
        let parts = || columns.on_unit_disc();
        Self {
            outermost: 6 * columns.rings(),
            second_moment: parts().map(|([x, y], share)| 0.5 * share * (x * x + y * y)).sum(),
            parts: parts().map(|(at, share)| (at, share * area_m2)).collect(),
            area_m2,
            radius_m: foundation.radius_m,
            compression_m: foundation.compression_m,
            half_width_m: columns.half_width_m(),
        }
    }

    /// Wrench of a flat face with a rim, in its plate's frame: the force is along z, and at the rim off it. The tool is not level:
    /// cos τ > 0.
    pub fn pressed(
        &self,
        foam: &Foam,
        rim_m: f64,
        (pose, [u, v]): (&SpongePose, &[Vector3<f64>; 2]),
        twist: Option<&[Vector3<f64>; 2]>,
    ) -> Wrench {
        let over_cosine = -1.0 / pose.axis.z;
        let slope = [u.z, v.z].map(|z| self.radius_m * z * over_cosine);
        let face = Face {
            rim_m,
            pose,
            across: [u * self.radius_m, v * self.radius_m],
            over_cosine,
            middle_m: self.compression_m - pose.tip.z * over_cosine,
            slope,
            steep_m: (slope[0] * slope[0] + slope[1] * slope[1]).sqrt(),
        };
        if face.middle_m + face.steep_m <= 0.0 {
            return Wrench::default();
        }
        if twist.is_none() && self.is_whole(foam, &face) {
            self.closed_form(foam, &face)
        } else {
            self.in_part(foam, &face, twist)
        }
    }

    /// Checks that every column is compressed within the limit of the foam, and on the plate.
    fn is_whole(&self, foam: &Foam, face: &Face<'_>) -> bool {
        let (least_m, most_m) = (face.middle_m - face.steep_m, face.middle_m + face.steep_m);
        if least_m < 0.0 || most_m > DENSE_STRAIN * foam.free_height_m {
            return false;
        }
        // A column stands no more than r from the tip as seen from above; the rest of its length leads aside by sin τ.
        let along_m = (self.compression_m - face.middle_m).abs() + face.steep_m;
        let reach_m = self.radius_m + along_m * face.pose.axis.xy().norm();
        let within_m = rim_within(face.rim_m, self.half_width_m) - reach_m;
        within_m >= 0.0 && face.pose.tip.xy().norm_squared() <= within_m * within_m
    }

    /// Closed form of the sums.
    fn closed_form(&self, foam: &Foam, face: &Face<'_>) -> Wrench {
        let stiffness = foam.stiffness_pa / foam.free_height_m * self.area_m2;
        let (w, [s, t]) = (face.middle_m, face.slope);
        let squares = w * w + self.second_moment * (face.steep_m * face.steep_m);
        let push = stiffness * face.over_cosine;
        let force = push * w;
        // Σ f x, Σ f y and Σ f (c − w).
        let [x, y] = [s, t].map(|slope| -push * self.second_moment * slope);
        let along = self.compression_m * force - push * squares;
        let lever = face.across[0] * x + face.across[1] * y + face.pose.axis * along;
        let outermost = self.parts.iter().rev().take(self.outermost);
        Wrench {
            force: Vector3::new(0.0, 0.0, force),
            moment: Vector3::new(lever.y, -lever.x, 0.0),
            load: FoamLoad {
                force_n: stiffness * w,
                deepest_m: outermost.map(|(at, _)| face.compression_m(at)).fold(0.0, f64::max),
            },
            energy_j: 0.5 * stiffness * squares,
        }
    }

    /// Column by column.
    fn in_part(&self, foam: &Foam, face: &Face<'_>, twist: Option<&[Vector3<f64>; 2]>) -> Wrench {
        let mut wrench = Wrench::default();
        let (mut push, mut lever) = (0.0, [0.0; 2]);
        let (axis, tip, [u, v]) = (&face.pose.axis, &face.pose.tip, &face.across);
        for (at @ [x, y], area_m2) in &self.parts {
            let w = face.compression_m(at);
            if !foam.is_pressed(w) {
                continue;
            }
            let along_m = self.compression_m - w;
            let away = [0, 1].map(|k| u[k] * x + v[k] * y + axis[k] * along_m);
            let [px, py] = [tip.x + away[0], tip.y + away[1]];
            let rho_squared = px * px + py * py;
            let (share, slope) = share_within(rho_squared, face.rim_m, self.half_width_m);
            if share == 0.0 {
                continue;
            }
            let (energy, mut pressure) = foam.energy_and_pressure(w);
            if let Some([speed, turning]) = twist {
                let rising = speed.z + turning.x * away[1] - turning.y * away[0];
                pressure = foam.damped(w, pressure, -rising * face.over_cosine);
            }
            let pressed = share * pressure * area_m2;
            push += pressed;
            lever[0] += pressed * away[0];
            lever[1] += pressed * away[1];
            wrench.energy_j += share * energy * area_m2;
            wrench.load.deepest_m = wrench.load.deepest_m.max(w);
            if slope != 0.0 {
                let rho = rho_squared.sqrt();
                let out = Vector3::new(px / rho, py / rho, 0.0);
                let off = out + Vector3::z() * (out.dot(axis) * face.over_cosine);
                let force = -off * (energy * area_m2 * slope);
                wrench.force += force;
                // The column's foot is on the face: as high as the tip is low.
                wrench.moment += Vector3::new(away[0], away[1], -tip.z).cross(&force);
            }
        }
        wrench.load.force_n = push;
        let [along_x, along_y] = lever.map(|sum| sum * face.over_cosine);
        wrench.force.z += push * face.over_cosine;
        wrench.moment += Vector3::new(along_y, -along_x, 0.0);
        wrench
    }
}

/// A flat face under a sponge.
struct Face<'a> {
    rim_m: f64,
    pose: &'a SpongePose,
    /// The two directions across the sponge, as long as its radius \[m\].
    across: [Vector3<f64>; 2],
    /// 1 / cos τ.
    over_cosine: f64,
    /// w₀ \[m\].
    middle_m: f64,
    /// s \[m\].
    slope: [f64; 2],
    /// |s| \[m\].
    steep_m: f64,
}

impl Face<'_> {
    #[inline]
    fn compression_m(&self, [x, y]: &[f64; 2]) -> f64 {
        self.middle_m - self.slope[0] * x - self.slope[1] * y
    }
}
