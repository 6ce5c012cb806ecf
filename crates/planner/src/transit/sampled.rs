//! Bidirectional random trees for transits without a simple solution (RRT-Connect: Kuffner & LaValle 2000), shortened and
//! smoothed.

use crate::placed_arm::Stretch;
use crate::transit::rules::{FreePath, STEP_RAD, TransitRules};
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::cancel::Cancelled;
use rand::RngExt;
use rand_pcg::Pcg64;

/// Most configurations of both trees.
const MOST_NODES: usize = 4000;
/// Growth of a tree at a time \[rad of the fastest joint\].
const GROWTH_RAD: f64 = 0.15;
/// Tries to shorten a path.
const SHORTCUTS: usize = 150;
/// Length of the parameter per radian of the fastest joint \[m/rad\].
const LENGTH_M_RAD: f64 = 0.3;
/// Distances of the samples through which a smooth path is laid \[rad of the fastest joint\], those to be tried first first: the closer
/// they lie, the less it leaves the straight lines that were found to be free, and the more it slows down at their corners.
pub(crate) const SPACINGS_RAD: [f64; 3] = [0.12, 0.06, 0.03];

/// Straight lines of the joints that are free, one after the other.
#[derive(Debug)]
pub(crate) struct FreeLines {
    /// Corners between the lines, with both ends \[rad\].
    corners: Vec<JointVector>,
    /// Configurations that were sampled for them.
    pub nodes: usize,
}

struct Node {
    q: JointVector,
    parent: usize,
}

/// Free lines from `from` to `to` \[rad\]; otherwise the number of configurations that were sampled.
///
/// # Errors
/// [`Cancelled`].
pub(crate) fn lines(
    rules: &TransitRules<'_>,
    from: &JointVector,
    to: &JointVector,
    rng: &mut Pcg64,
) -> Result<Result<FreeLines, usize>, Cancelled> {
    let root = |q: &JointVector| vec![Node { q: *q, parent: 0 }];
    let mut trees = [root(from), root(to)];
    let limits = rules.placed.robot.limits();
    let ranges = std::array::from_fn(|joint| limits.sampling_range_around(joint, [from[joint], to[joint]]));
    // Which of the trees grows towards the sample; the other one then tries to meet it.
    let mut growing = 0;
    while trees[0].len() + trees[1].len() < MOST_NODES {
        rules.placed.check_cancelled()?;
        let aim = random(&ranges, rng);
        let near = nearest(&trees[growing], &aim);
        if let Some(q) = grown(rules, &trees[growing][near].q, &aim) {
            trees[growing].push(Node { q, parent: near });
            if meet(rules, &mut trees[1 - growing], &q) {
                let nodes = trees.iter().map(Vec::len).sum();
                let mut corners = joined(&trees);
                shorten(rules, &mut corners, rng)?;
                return Ok(Ok(FreeLines { corners, nodes }));
            }
        } else {
            // Counts as sampled, so that the search ends in a closed pocket too.
            let node = Node {
                q: trees[growing][near].q,
                parent: near,
            };
            trees[growing].push(node);
        }
        growing = 1 - growing;
    }
    Ok(Err(MOST_NODES))
}

/// Grows a tree towards `aim` as far as it goes; whether it gets there.
fn meet(rules: &TransitRules<'_>, tree: &mut Vec<Node>, aim: &JointVector) -> bool {
    let mut near = nearest(tree, aim);
    while let Some(q) = grown(rules, &tree[near].q, aim) {
        tree.push(Node { q, parent: near });
        near = tree.len() - 1;
        if q == *aim {
            return true;
        }
        if tree.len() >= MOST_NODES {
            return false;
        }
    }
    false
}

/// One step from `q` towards `aim`, if the line there is free and the step is none of length zero.
fn grown(rules: &TransitRules<'_>, q: &JointVector, aim: &JointVector) -> Option<JointVector> {
    let distance = (aim - q).amax();
    if distance == 0.0 {
        return None;
    }
    let next = if distance <= GROWTH_RAD {
        *aim
    } else {
        q + (aim - q) * (GROWTH_RAD / distance)
    };
    is_line_free(rules, q, &next).then_some(next)
}

fn is_line_free(rules: &TransitRules<'_>, a: &JointVector, b: &JointVector) -> bool {
    let count = ((b - a).amax() / STEP_RAD).ceil().max(1.0);
    (1..=count as usize).all(|k| rules.is_clear(&(a + (b - a) * (k as f64 / count)), Stretch::Free))
}

fn nearest(tree: &[Node], aim: &JointVector) -> usize {
    let squared = |node: &Node| (node.q - aim).norm_squared();
    let by_distance = |a: &usize, b: &usize| squared(&tree[*a]).total_cmp(&squared(&tree[*b]));
    (0..tree.len()).min_by(by_distance).unwrap_or(0)
}

fn random(ranges: &[[f64; 2]; AXES], rng: &mut Pcg64) -> JointVector {
    JointVector::from(ranges.map(|[lower, upper]| lower + (upper - lower) * rng.random::<f64>()))
}

/// Path from the first tree's root to the second one's, over the configuration at which both end.
fn joined(trees: &[Vec<Node>; 2]) -> Vec<JointVector> {
    let to_root = |tree: &[Node]| {
        let mut at = tree.len() - 1;
        let mut path = vec![tree[at].q];
        while at != 0 {
            at = tree[at].parent;
            path.push(tree[at].q);
        }
        path
    };
    let mut path = to_root(&trees[0]);
    path.reverse();
    path.extend(to_root(&trees[1]).into_iter().skip(1));
    path
}

/// Replaces stretches between two random places by straight lines where those are free.
fn shorten(rules: &TransitRules<'_>, corners: &mut Vec<JointVector>, rng: &mut Pcg64) -> Result<(), Cancelled> {
    for _ in 0..SHORTCUTS {
        if corners.len() < 3 {
            break;
        }
        rules.placed.check_cancelled()?;
        let mut ends = [0; 2].map(|_| rng.random_range(0..corners.len()));
        ends.sort_unstable();
        let [a, b] = ends;
        if b > a + 1 && is_line_free(rules, &corners[a], &corners[b]) {
            corners.drain(a + 1..b);
        }
    }
    Ok(())
}

impl FreeLines {
    /// Samples along them, both ends left out, no farther apart than `spacing_rad` of the fastest joint.
    pub(crate) fn dense(&self, spacing_rad: f64) -> FreePath {
        let (mut u, mut q, mut length) = (Vec::new(), Vec::new(), 0.0);
        for ends in self.corners.windows(2) {
            let (a, b) = (ends[0], ends[1]);
            let distance = (b - a).amax();
            let count = (distance / spacing_rad).ceil().max(1.0);
            for k in 1..=count as usize {
                u.push(length + distance * LENGTH_M_RAD * (k as f64 / count));
                q.push(a + (b - a) * (k as f64 / count));
            }
            length += distance * LENGTH_M_RAD;
        }
        u.pop();
        q.pop();
        FreePath { u, q, length }
    }
}
