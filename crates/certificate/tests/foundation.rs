//! The elastic foundation once more, on squares of 0.25 mm and dense moments: its own formulas, from knots, positions and nothing else.

use crate::maker::irb120;
use nalgebra::Vector3;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::surface::Surface;
use rayon::prelude::*;

/// Edge of a square \[m\].
const CELL_M: f64 = 2.5e-4;

/// Between two moments \[s\].
const STEP_S: f64 = 2e-3;

/// Results of a raster of the model, the smaller ones of both extremes of the plate's height.
#[derive(Debug)]
pub struct RasterResult {
    /// Shares of the area.
    pub contact: f64,
    pub time: f64,
    pub dose: f64,
    pub touched: f64,
    /// The greatest strain and force, and the least force.
    pub strain: f64,
    pub force_n: [f64; 2],
    /// The greatest torque of a friction of 1.
    pub torque_nm: f64,
    /// Force across the plate's axis, with a friction of 0.3 and of 1 that drags outwards.
    pub lateral_n: [f64; 2],
    /// Torque about the plate's axis, with a friction of 1 that drags about it.
    pub turning_nm: f64,
}

/// A moment: where the tip is, its axis, and both a step later.
struct Moment {
    tip: Vector3<f64>,
    axis: Vector3<f64>,
    speed: Vector3<f64>,
    turning: Vector3<f64>,
}

/// Heights and slopes of a meridian, by adding up thin slices.
pub struct Meridian {
    step: f64,
    /// z and tan β.
    at: Vec<[f64; 2]>,
    rim: f64,
}

impl Meridian {
    pub fn new(surface: &Surface) -> Self {
        let rim = surface.rim_m();
        let knots: Vec<[f64; 2]> = match surface {
            Surface::Profile(meridian) => meridian
                .knots()
                .iter()
                .map(|k| [k.radius_m, k.slope_rad.sin()])
                .collect(),
            _ => vec![[rim, 0.0]],
        };
        let tangent = |r: f64| {
            let mut before = [0.0, 0.0];
            for knot in &knots {
                if r <= knot[0] {
                    let s = before[1] + (knot[1] - before[1]) * (r - before[0]) / (knot[0] - before[0]);
                    return s / (1.0 - s * s).sqrt();
                }
                before = *knot;
            }
            before[1] / (1.0 - before[1] * before[1]).sqrt()
        };
        let step = 1e-5;
        let mut at = vec![[0.0, tangent(0.0)]];
        while (at.len() as f64 - 1.0) * step < rim + 0.01 {
            let r = (at.len() - 1) as f64 * step;
            let z = at[at.len() - 1][0];
            at.push([z + step * tangent(r + 0.5 * step), tangent(r + step)]);
        }
        Self { step, at, rim }
    }

    /// z and tan β at ρ.
    pub fn at(&self, rho: f64) -> [f64; 2] {
        let k = ((rho / self.step) as usize).min(self.at.len() - 2);
        let u = rho / self.step - k as f64;
        [0, 1].map(|i| self.at[k][i] * (1.0 - u) + self.at[k + 1][i] * u)
    }
}

/// The wash of the first plate of a plan.
fn moments(plan: &Plan) -> Vec<Moment> {
    let robot = irb120();
    let (motion, frame) = (plan.knots.motion().unwrap(), plan.job.workcell.tool.tip_frame(&robot));
    let wash = plan.segments.iter().find(|s| s.kind == SegmentKind::Wash).unwrap();
    let plate = &plan.job.plates[0];
    let steps = ((wash.t_end_s - wash.t_start_s) / STEP_S).ceil() as usize;
    let h = 1e-5;
    let pose = |t: f64| {
        let pose = plate.pose.inverse() * robot.pose(&motion.at(t).unwrap().q, &frame);
        (pose.translation.vector, pose.rotation)
    };
    let one = |k: usize| {
        let t = wash.t_start_s + STEP_S * (k as f64 + 0.5);
        let ((p, r), (q, s)) = (pose(t - h), pose(t + h));
        Moment {
            tip: pose(t).0,
            axis: pose(t).1 * Vector3::z(),
            speed: (q - p) / (2.0 * h),
            turning: (s * r.inverse()).scaled_axis() / (2.0 * h),
        }
    };
    (0..steps).into_par_iter().map(one).collect()
}

/// Everything that the model says of the wash of a plan's first plate.
pub fn raster(plan: &Plan) -> RasterResult {
    let moments = moments(plan);
    let (plate, sponge) = (&plan.job.plates[0], &plan.job.workcell.tool.sponge);
    let wanted = plan.job.requirements.contact.unwrap();
    let meridian = Meridian::new(&plate.surface);
    let stiffness = sponge.stiffness_pa.unwrap();
    let (s, c, high) = (
        sponge.radius_m,
        sponge.compression_m,
        sponge.height_m + sponge.compression_m,
    );
    let half = (meridian.rim / CELL_M).ceil() as i32 + 1;
    let size = (2 * half) as usize;
    // For the plate at its lowest and its highest: compression, time, dose; and touched where it is stated to be.
    let rows = 16;
    let bands: Vec<_> = (0..size.div_ceil(rows)).collect();
    let band = |band: &usize| {
        let first = band * rows;
        let count = rows.min(size - first);
        let mut cells = vec![[0.0_f64; 7]; count * size];
        let mut loads = vec![[0.0_f64; 7]; moments.len()];
        let points: Vec<_> = (0..count * size)
            .map(|i| {
                let (row, column) = (first + i / size, i % size);
                let [x, y] = [column, row].map(|k| (k as f64 - f64::from(half) + 0.5) * CELL_M);
                let rho = (x * x + y * y).sqrt();
                let [z, slope] = meridian.at(rho);
                (x, y, z, slope, rho <= meridian.rim, rho)
            })
            .collect();
        for (m, moment) in moments.iter().enumerate() {
            let a = moment.axis;
            let reach = s + 0.4 * s;
            let column = |v: f64| ((v / CELL_M + f64::from(half)).clamp(0.0, size as f64)) as usize;
            let (from, to) = (column(moment.tip.x - reach), column(moment.tip.x + reach));
            for row in 0..count {
                let y = points[row * size].1;
                if (y - moment.tip.y).abs() > reach {
                    continue;
                }
                for i in row * size + from..(row * size + to).min((row + 1) * size) {
                    let (x, y, z, slope, on, rho) = points[i];
                    if !on {
                        continue;
                    }
                    let d = Vector3::new(x, y, z) - moment.tip;
                    let along = d.dot(&a);
                    if d.norm_squared() - along * along > (s + 1e-3) * (s + 1e-3) {
                        continue;
                    }
                    for (k, error) in [-wanted.height_error_m, wanted.height_error_m, 0.0]
                        .into_iter()
                        .enumerate()
                    {
                        let d = Vector3::new(x, y, z + error) - moment.tip;
                        let along = d.dot(&a);
                        let w = c - along;
                        if w < 0.0 || d.norm_squared() - along * along > s * s {
                            continue;
                        }
                        if k == 2 {
                            cells[i][6] = 1.0;
                            continue;
                        }
                        if w >= wanted.compression_m {
                            let v = moment.speed + moment.turning.cross(&d);
                            let slide = (v - a * v.dot(&a)).norm();
                            cells[i][3 * k] = cells[i][3 * k].max(w);
                            cells[i][3 * k + 1] += STEP_S;
                            cells[i][3 * k + 2] += stiffness[0] * w / high * slide * STEP_S;
                        }
                        // dA across the axis: of the normal (−tan β ρ̂, 1) dx dy.
                        let (nx, ny) = if rho > 0.0 {
                            (-slope * x / rho, -slope * y / rho)
                        } else {
                            (0.0, 0.0)
                        };
                        let part = -(a.x * nx + a.y * ny + a.z) * CELL_M * CELL_M;
                        loads[m][k] += w * part;
                        if k == 1 {
                            let r = (d.norm_squared() - along * along).max(0.0).sqrt();
                            loads[m][2] = loads[m][2].max(w);
                            // Along the normal it presses with w on the area of the face.
                            let long = (1.0 + slope * slope).sqrt();
                            let pressed = w * CELL_M * CELL_M * long;
                            loads[m][3] += pressed * r;
                            // Outwards where the tip is, with friction that way along the face.
                            let out = moment.tip.xy().normalize();
                            let along = (nx * out.x + ny * out.y) / long;
                            for (k, friction) in [(4, 0.3), (5, 1.0)] {
                                loads[m][k] += pressed * (friction * (1.0 - along * along).sqrt() - along);
                            }
                            loads[m][6] += pressed * rho;
                        }
                    }
                }
            }
        }
        let mut sums = [0.0; 5];
        for (cell, (.., slope, on, _)) in cells.iter().zip(&points) {
            if *on {
                let area = (1.0 + slope * slope).sqrt();
                let least = |i: usize| cell[i].min(cell[3 + i]);
                sums[0] += area;
                sums[1] += area * f64::from(u8::from(least(0) > 0.0));
                sums[2] += area * f64::from(u8::from(least(1) >= wanted.time_s));
                sums[3] += area * f64::from(u8::from(least(2) >= wanted.dose_pa_m));
                sums[4] += area * cell[6];
            }
        }
        (sums, loads)
    };
    let found: Vec<_> = bands.par_iter().map(band).collect();
    let mut sums = [0.0; 5];
    let mut loads = vec![[0.0_f64; 7]; moments.len()];
    for (part, load) in found {
        (0..5).for_each(|i| sums[i] += part[i]);
        for (all, one) in loads.iter_mut().zip(load) {
            (0..7).for_each(|i| all[i] = if i == 2 { all[i].max(one[i]) } else { all[i] + one[i] });
        }
    }
    let most = |i: usize| loads.iter().map(|l| l[i]).fold(0.0, f64::max);
    let least = loads.iter().map(|l| l[0]).fold(f64::INFINITY, f64::min);
    RasterResult {
        contact: sums[1] / sums[0],
        time: sums[2] / sums[0],
        dose: sums[3] / sums[0],
        touched: sums[4] / sums[0],
        strain: most(2) / high,
        force_n: [stiffness[0] / high * least, stiffness[1] / high * most(1)],
        torque_nm: stiffness[1] / high * most(3),
        lateral_n: [4, 5].map(|i| stiffness[1] / high * most(i)),
        turning_nm: stiffness[1] / high * most(6),
    }
}

/// Time at which each place of the first plate has the wanted dose, at both extremes of the plate's height; infinite where it never has \[s\].
pub fn dose_times_s(plan: &Plan, places: &[[f64; 2]]) -> Vec<f64> {
    let moments = moments(plan);
    let (plate, sponge) = (&plan.job.plates[0], &plan.job.workcell.tool.sponge);
    let wanted = plan.job.requirements.contact.unwrap();
    let meridian = Meridian::new(&plate.surface);
    let (s, c) = (sponge.radius_m, sponge.compression_m);
    let softness = sponge.stiffness_pa.unwrap()[0] / (sponge.height_m + c);
    let wash = plan.segments.iter().find(|s| s.kind == SegmentKind::Wash).unwrap();
    let one = |&[x, y]: &[f64; 2]| {
        let [z, _] = meridian.at((x * x + y * y).sqrt());
        let mut doses = [0.0; 2];
        for (k, moment) in moments.iter().enumerate() {
            for (dose, error) in doses.iter_mut().zip([-wanted.height_error_m, wanted.height_error_m]) {
                let d = Vector3::new(x, y, z + error) - moment.tip;
                let along = d.dot(&moment.axis);
                let w = c - along;
                if w >= wanted.compression_m && d.norm_squared() - along * along <= s * s {
                    let v = moment.speed + moment.turning.cross(&d);
                    *dose += softness * w * (v - moment.axis * v.dot(&moment.axis)).norm() * STEP_S;
                }
            }
            if doses.iter().all(|dose| *dose >= wanted.dose_pa_m) {
                return wash.t_start_s + STEP_S * (k as f64 + 1.0);
            }
        }
        f64::INFINITY
    };
    places.par_iter().map(one).collect()
}
