//! The bound on the number of plates, against arrangements that exist.

use platewash_workcell::layout::{Region, packing_bound};

fn square(side: f64) -> Region {
    Region {
        x_m: [0.0, side],
        y_m: [0.0, side],
        rho_m: None,
        azimuth_deg: None,
    }
}

#[test]
fn the_bound_of_a_box_is_olers_formula() {
    // 2/√3 · 0.224/0.0784 + 2.04/0.56 + 1 = 7.94; 2/√3 · 0.228/0.0784 + 2.12/0.56 + 1 = 8.14.
    assert_eq!(packing_bound(&Region::PAPER_TEXT, 0.28), Some(7));
    assert_eq!(packing_bound(&Region::PAPER_APPENDIX, 0.28), Some(8));
    assert_eq!(packing_bound(&square(1.0), 0.0), None);
}

#[test]
fn arrangements_that_exist_stay_below_the_bound() {
    for n in 1..40_usize {
        // A square grid of (n + 1)² points and a triangular lattice of rows √3/2 apart.
        let bound = packing_bound(&square(n as f64), 1.0).unwrap();
        let rows = (n as f64 / (0.5 * 3.0_f64.sqrt())).floor() as usize + 1;
        let lattice: usize = (0..rows).map(|row| if row % 2 == 0 { n + 1 } else { n }).sum();
        assert!(bound >= (n + 1) * (n + 1) && bound >= lattice, "n = {n}: {bound}");
    }
}
