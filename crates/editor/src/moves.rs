//! Things that a user can move on the page, and the keys that state their positions.

use crate::protocol::{BodyMove, Moves, PlateMoves};
use platewash_scenario::{BodyShape, HeldPlates, Scenario};

/// Lists the keys that move the things of a cell.
pub fn moves(scenario: &Scenario) -> Moves {
    Moves {
        plates: plates(scenario),
        bodies: bodies(scenario),
    }
}

fn plates(scenario: &Scenario) -> PlateMoves {
    if scenario.plate.is_empty() {
        return PlateMoves::Positions;
    }
    if scenario.plate_files.have_places() {
        return PlateMoves::Nothing {
            words: "These plates are those of layout.plate_file: change their places in that file.",
        };
    }
    let at_m: Option<Vec<_>> = scenario.plate.iter().map(|row| row.at_m).collect();
    match (scenario.plate_sections(), at_m) {
        (Some(sections), Some(at_m)) => PlateMoves::Sections { sections, at_m },
        _ => PlateMoves::Nothing {
            words: "These plates are drawn from a region, as many of each [[plate]] section as its count says: give each section its at_m in place of it, and \
                    they can be moved.",
        },
    }
}

/// Lists the bodies around the arm in their order: floor, table, obstacles.
fn bodies(scenario: &Scenario) -> Vec<BodyMove> {
    let fixed = |words: &str| BodyMove {
        key: None,
        at_m: Vec::new(),
        words: Some(words.to_owned()),
        holds: Some(Vec::new()),
    };
    let floor = scenario.floor.present.then(|| fixed("The floor is at floor.height_m."));
    let table = scenario.table.size_m.map(|_| BodyMove {
        key: Some("table.at_m".to_owned()),
        at_m: scenario.table.at_m.unwrap_or_default().to_vec(),
        words: None,
        holds: Some(Vec::new()),
    });
    let obstacles = scenario.obstacle.iter().enumerate().map(|(index, section)| {
        let key = format!("obstacle[{index}].at_m");
        if section.body.shape == Some(BodyShape::HalfSpace) {
            return fixed(&format!(
                "A half-space has no end to take hold of: {key} in the text moves it."
            ));
        }
        BodyMove {
            key: Some(key),
            at_m: section.at_m.unwrap_or_default().to_vec(),
            words: None,
            holds: match &section.holds_plates {
                Some(HeldPlates::Every(_)) => None,
                Some(HeldPlates::These(plates)) => Some(plates.clone()),
                None => Some(Vec::new()),
            },
        }
    });
    floor.into_iter().chain(table).chain(obstacles).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn movable_bodies_name_their_key_and_fixed_ones_the_reason() {
        let of = |text: &str| moves(&Scenario::parse(text, "case").unwrap());
        assert_eq!(of("layout.positions_m = [[0.3, 0]]").plates, PlateMoves::Positions);
        assert_eq!(of("layout.region = \"text\"").plates, PlateMoves::Positions);
        let listed = of(
            "[[plate]]\nat_m = [0.3, 0, 0.4]\nrpy_deg = [0, 90, 0]\nfaces = \"both\"\n[[plate]]\nat_m = [0, 0.3, 0.03]\n",
        );
        let (sections, at_m) = (vec![0, 0, 1], vec![[0.3, 0.0, 0.4], [0.0, 0.3, 0.03]]);
        assert_eq!(listed.plates, PlateMoves::Sections { sections, at_m });
        let sampled = of("layout.region = \"text\"\n[[plate]]\ncount = 2\n");
        assert!(matches!(sampled.plates, PlateMoves::Nothing { .. }));
    }

    #[test]
    fn bodies_name_the_plates_that_they_hold() {
        let held = |name: &str| {
            let bodies = moves(&Scenario::load(name).unwrap()).bodies;
            bodies.into_iter().map(|body| body.holds).collect::<Vec<_>>()
        };
        assert!(held("rack").ends_with(&[Some(vec![0]), Some(vec![1]), Some(vec![2])]));
        assert!(
            held("sink")
                .iter()
                .all(|holds| holds.as_ref().is_some_and(Vec::is_empty))
        );
    }

    #[test]
    fn bodies_keep_their_displayed_order() {
        for name in ["sink", "rack", "pedestal", "ceiling", "kitchen"] {
            let scenario = Scenario::load(name).unwrap();
            let shown = scenario.job().unwrap().terms().workcell.obstacles.clone();
            let moved = moves(&scenario).bodies;
            assert_eq!(shown.len(), moved.len(), "{name}");
            for (body, obstacle) in moved.iter().zip(&shown) {
                assert!(body.key.is_some() != body.words.is_some());
                let at = obstacle.pose.translation;
                assert!(
                    body.key.is_none() || body.at_m[..2] == [at.x, at.y],
                    "{name}: {}",
                    obstacle.name
                );
            }
        }
    }
}
