//! What no certified job may be asked for, however consistently it is stated, and an order that is asked for.

use super::made::{Recipe, good, irb120, restated};
use crate::certificate::PromiseName::{self, EveryPlateOnce, Plates, ToolPath};
use crate::certificate::{Certificate, verify};
use crate::plan::Plan;
use crate::scenario::OrderRule;
use crate::tool_path::Shape;

fn judged(plan: Plan) -> Certificate {
    verify(&restated(plan), &irb120()).unwrap()
}

fn changed(change: impl FnOnce(&mut Plan)) -> Certificate {
    let mut plan = good();
    change(&mut plan);
    judged(plan)
}

fn broken(certificate: &Certificate) -> Vec<PromiseName> {
    certificate.broken().map(|p| p.name).collect()
}

#[test]
fn plates_that_reach_below_the_floor_are_named() {
    let told = changed(|p| {
        p.scenario.layout.plate_thickness_m = 1.0;
        p.plates.iter_mut().for_each(|plate| plate.thickness_m = 1.0);
    });
    assert_eq!(broken(&told), [Plates], "{told}");
    let underside = "height of the underside of plate 0 over the floor: -970.0 mm; expected none below 0";
    assert!(told.to_string().contains(underside), "{told}");
}

/// All of it stated so, and within the tolerances of the motion: no certified job may ask for it.
#[test]
fn a_tip_that_is_asked_to_keep_off_the_plates_is_named() {
    let off_m = 1e-4;
    let told = changed(|p| {
        p.scenario.wash.height_m = off_m;
        for segment in &mut p.tool_path {
            match &mut segment.shape {
                Shape::Line { foot_m, .. } => foot_m[2] += off_m,
                Shape::Stroke { centre_m, .. } => centre_m[2] += off_m,
                _ => {}
            }
        }
    });
    assert_eq!(broken(&told), [ToolPath], "{told}");
    let named: Vec<_> = told
        .promise(ToolPath)
        .unwrap()
        .discrepancies
        .iter()
        .map(|d| d.what.as_str())
        .collect();
    assert_eq!(named, ["scenario.wash.height_m"]);
}

#[test]
fn an_order_that_is_given_is_kept() {
    let mut recipe = Recipe::arc(&[-35.0, 30.0]);
    recipe.order = vec![1, 0];
    assert_eq!(broken(&judged(recipe.plan())), []);
    recipe.scenario.job.order = OrderRule::Given;
    let told = judged(recipe.plan());
    assert_eq!(broken(&told), [EveryPlateOnce], "{told}");
    recipe.order = vec![0, 1];
    assert_eq!(broken(&judged(recipe.plan())), []);
}
