//! The swept share of a plate on a raster of points.

use platewash::Plate;

/// Distance between points of the raster \[m\].
const STEP_M: f64 = 2.5e-3;

/// Share of the plate's points that lie within a distance \[m\] of some point of a path.
pub fn share(plate: &Plate, path: &[[f64; 2]], within_m: f64) -> f64 {
    let side = (plate.rim_m() / STEP_M).ceil() as i32;
    let (width, centre) = ((2 * side + 1) as usize, plate.centre_xy());
    let mut nearest = vec![f64::INFINITY; width * width];
    let mut last = [f64::INFINITY; 2];
    for p in path {
        if (p[0] - last[0]).hypot(p[1] - last[1]) < 5e-4 {
            continue;
        }
        last = *p;
        let (x, y) = (p[0] - centre[0], p[1] - centre[1]);
        let range = |c: f64| {
            let index = |v: f64| (v / STEP_M).clamp(-1e6, 1e6) as i32;
            (index(c - within_m) - 1).max(-side)..=(index(c + within_m) + 1).min(side)
        };
        for i in range(x) {
            for j in range(y) {
                let (dx, dy) = (f64::from(i) * STEP_M - x, f64::from(j) * STEP_M - y);
                let cell = &mut nearest[(i + side) as usize * width + (j + side) as usize];
                *cell = cell.min(dx * dx + dy * dy);
            }
        }
    }
    let (mut inside, mut swept) = (0_u32, 0_u32);
    for i in -side..=side {
        for j in -side..=side {
            let (x, y) = (f64::from(i) * STEP_M, f64::from(j) * STEP_M);
            if x.hypot(y) > plate.rim_m() {
                continue;
            }
            inside += 1;
            let off = nearest[(i + side) as usize * width + (j + side) as usize].sqrt();
            swept += u32::from(off <= within_m);
        }
    }
    f64::from(swept) / f64::from(inside)
}
