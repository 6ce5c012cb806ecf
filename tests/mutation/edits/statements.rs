//! The arm and the homes.

use crate::mutation::edit::{Edits, Kind};
use platewash::certificate::Requirement::{Arm, HomeToHome};

pub fn add(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Statements, what, names, apply);
    fails("the arm's name", &[Arm], |p| p.job.workcell.arm.name.push(' '));
    fails("the arm's description", &[Arm], |p| {
        p.job.workcell.arm.urdf_sha256 = "0".repeat(64)
    });
    fails("the description in capitals", &[Arm], |p| {
        p.job.workcell.arm.urdf_sha256.make_ascii_uppercase()
    });
    fails("the arm's pairs", &[Arm], |p| {
        p.job.workcell.arm.srdf_sha256 = Some("f".repeat(64))
    });
    fails("the arm without its pairs", &[Arm], |p| {
        p.job.workcell.arm.srdf_sha256 = None
    });
    let mut homes = |what, apply| edits.fails(Kind::Home, what, &[HomeToHome], apply);
    homes("at the end by a hair", |p| p.job.home_rad[1][3] += 1e-6);
    homes("at the start by a hair", |p| p.job.home_rad[0][5] += 1e-7);
    homes("both", |p| p.job.home_rad.iter_mut().for_each(|q| q[5] += 0.02));
    homes("another at the end", |p| p.job.home_rad[1][0] = 0.2);
    homes("exchanged with another", |p| {
        p.job.home_rad[1][4] -= 0.1;
        p.job.home_rad.swap(0, 1);
    });
    edits.harmless(Kind::Home, "by rounding", |p| p.job.home_rad[1][3] += 1e-10);
}
