//! The order of the plates.

use platewash_paper::order::{PaperOrder, order};
use platewash_workcell::plate::Plate;

fn plate(x_m: f64, y_m: f64) -> Plate {
    Plate::level_disc([x_m, y_m, 0.03], 0.145, 0.02)
}

#[test]
fn the_tip_leaves_a_plate_where_its_spiral_ends() {
    // From plate 1 (first) the centre of plate 2 is nearer, but the exit at +0.145 m in x favours plate 3.
    let plates = [plate(0.0, 0.1), plate(-0.2, 0.1), plate(0.3, 0.1)];
    let exit = |p: &Plate| [p.centre_xy()[0] + 0.145, p.centre_xy()[1]];
    assert_eq!(order(&plates, PaperOrder::Nearest, [0.0, 0.0], exit), [0, 2, 1]);
    assert_eq!(
        order(&plates, PaperOrder::Nearest, [0.0, 0.0], Plate::centre_xy),
        [0, 1, 2]
    );
    assert_eq!(order(&plates, PaperOrder::Given, [9.0, 9.0], exit), [0, 1, 2]);
}

#[test]
fn every_plate_comes_once_and_ties_go_to_the_lower_index() {
    let plates = [plate(0.3, 0.0), plate(-0.3, 0.0), plate(0.0, 0.3)];
    assert_eq!(
        order(&plates, PaperOrder::Nearest, [0.0, 0.0], |_| [0.0, 0.0]),
        [0, 1, 2]
    );
    assert!(order(&[], PaperOrder::Nearest, [0.0, 0.0], |_| [0.0, 0.0]).is_empty());
}
