//! Which facets are behind which: a tree that parts space along their planes (binary space partitioning, Fuchs, Kedem and
//! Naylor 1980). Facets that go through one another are parted where they do.

use nalgebra::Vector3;

/// Nearer to a plane than this, a corner is on it \[m\].
const ON_M: f64 = 1e-7;

/// Facets that are tried as the next plane, of those that are left.
const TRIED: usize = 6;

/// Facets of more than so many are not parted, but sorted by the distance of their middles.
const MOST: usize = 5_000;

/// A flat piece, or a stretch of a line where it has two corners.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Piece {
    /// Corners, world frame \[m\].
    pub corners: Vec<Vector3<f64>>,
    /// Normal of its plane; of no meaning for a stretch of a line.
    pub normal: Vector3<f64>,
    /// What it is a piece of.
    pub of: usize,
}

impl Piece {
    fn height(&self, at: &Vector3<f64>) -> f64 {
        self.corners
            .first()
            .map_or(0.0, |corner| self.normal.dot(&(at - corner)))
    }

    fn middle(&self) -> Vector3<f64> {
        self.corners.iter().sum::<Vector3<f64>>() / self.corners.len().max(1) as f64
    }
}

/// A side of a plane, as seen from the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Near,
    Far,
    On,
    Both,
}

/// A place in space between planes.
#[derive(Debug, Default)]
struct Room {
    lines: Vec<Piece>,
    parted: Option<Parting>,
}

/// How a plane parts a room.
#[derive(Debug)]
struct Parting {
    /// The pieces in the plane; the first one states it.
    on: Vec<Piece>,
    /// Index of the room before it.
    near: usize,
    /// Index of the room behind it.
    far: usize,
}

/// All rooms, the whole space first. Bodies may make it as deep as they have facets, so that nothing here calls itself.
#[derive(Debug)]
struct Rooms(Vec<Room>);

/// All pieces from the farthest to the nearest, as seen from the eye. Every flat piece must face it.
pub(super) fn sorted(flat: Vec<Piece>, lines: Vec<Piece>, eye: &Vector3<f64>) -> Vec<Piece> {
    if flat.len() > MOST {
        return by_distance(flat, lines, eye);
    }
    let mut rooms = Rooms::of(flat);
    lines.into_iter().for_each(|line| rooms.take(line));
    rooms.told(eye)
}

fn by_distance(mut flat: Vec<Piece>, mut lines: Vec<Piece>, eye: &Vector3<f64>) -> Vec<Piece> {
    flat.append(&mut lines);
    let far = |piece: &Piece| (piece.middle() - eye).norm();
    flat.sort_by(|a, b| far(b).total_cmp(&far(a)));
    flat
}

impl Rooms {
    fn of(pieces: Vec<Piece>) -> Self {
        let mut rooms = vec![Room::default()];
        let mut left = vec![(0, pieces)];
        while let Some((room, pieces)) = left.pop() {
            let Some([near, on, far]) = part_all(pieces) else {
                continue;
            };
            let next = rooms.len();
            rooms.extend([Room::default(), Room::default()]);
            rooms[room].parted = Some(Parting {
                on,
                near: next,
                far: next + 1,
            });
            left.extend([(next, near), (next + 1, far)]);
        }
        Self(rooms)
    }

    /// Puts a stretch of a line where it belongs.
    fn take(&mut self, line: Piece) {
        let mut left = vec![(0, line)];
        while let Some((room, line)) = left.pop() {
            let room = &mut self.0[room];
            let Some(parting) = &room.parted else {
                room.lines.push(line);
                continue;
            };
            match side(&parting.on[0], &line) {
                // What is in a plane is drawn on it.
                Side::Near | Side::On => left.push((parting.near, line)),
                Side::Far => left.push((parting.far, line)),
                Side::Both => {
                    let [near, far] = part(&parting.on[0], &line);
                    left.extend(near.map(|piece| (parting.near, piece)));
                    left.extend(far.map(|piece| (parting.far, piece)));
                }
            }
        }
    }

    /// What is in them, from the farthest to the nearest.
    fn told(mut self, eye: &Vector3<f64>) -> Vec<Piece> {
        let far = |piece: &Piece| (piece.middle() - eye).norm();
        let mut all = Vec::new();
        // What is still to be told, the next one last.
        let mut left = vec![Telling::Room(0)];
        while let Some(telling) = left.pop() {
            match telling {
                Telling::Pieces(mut pieces) => all.append(&mut pieces),
                Telling::Room(room) => {
                    let Room { mut lines, parted } = std::mem::take(&mut self.0[room]);
                    lines.sort_by(|a, b| far(b).total_cmp(&far(a)));
                    all.append(&mut lines);
                    if let Some(parting) = parted {
                        // Pieces face the eye, unless rounding has it otherwise.
                        let faces = parting.on[0].height(eye) >= 0.0;
                        let sides = [parting.near, parting.far];
                        let [before, behind] = if faces { sides } else { [sides[1], sides[0]] };
                        left.push(Telling::Room(before));
                        left.push(Telling::Pieces(parting.on));
                        left.push(Telling::Room(behind));
                    }
                }
            }
        }
        all
    }
}

/// What is to be told.
enum Telling {
    Room(usize),
    Pieces(Vec<Piece>),
}

/// Pieces before, in and behind the plane of one of them, which is the first in it; `None` where there are none.
fn part_all(mut pieces: Vec<Piece>) -> Option<[Vec<Piece>; 3]> {
    if pieces.is_empty() {
        return None;
    }
    let plane = pieces.swap_remove(best_plane(&pieces));
    let (mut near, mut far, mut on) = (Vec::new(), Vec::new(), Vec::new());
    for piece in pieces {
        match side(&plane, &piece) {
            Side::Near => near.push(piece),
            Side::Far => far.push(piece),
            Side::On => on.push(piece),
            Side::Both => {
                let [a, b] = part(&plane, &piece);
                near.extend(a);
                far.extend(b);
            }
        }
    }
    on.insert(0, plane);
    Some([near, on, far])
}

/// Of some pieces the one whose plane parts the fewest of the others.
fn best_plane(pieces: &[Piece]) -> usize {
    let stride = (pieces.len() / TRIED).max(1);
    let cost = |k: usize| {
        let (mut parted, mut near, mut far) = (0_usize, 0_usize, 0_usize);
        for piece in pieces {
            match side(&pieces[k], piece) {
                Side::Near => near += 1,
                Side::Far => far += 1,
                Side::Both => parted += 1,
                Side::On => {}
            }
        }
        8 * parted + near.abs_diff(far)
    };
    let tried = (0..pieces.len()).step_by(stride);
    tried.min_by_key(|&k| cost(k)).unwrap_or(0)
}

fn side(plane: &Piece, piece: &Piece) -> Side {
    let (mut near, mut far) = (false, false);
    for corner in &piece.corners {
        let height = plane.height(corner);
        near |= height > ON_M;
        far |= height < -ON_M;
    }
    match (near, far) {
        (true, true) => Side::Both,
        (true, false) => Side::Near,
        (false, true) => Side::Far,
        (false, false) => Side::On,
    }
}

/// The parts of a piece before and behind a plane.
fn part(plane: &Piece, piece: &Piece) -> [Option<Piece>; 2] {
    [1.0, -1.0].map(|sign| {
        let mut corners = Vec::new();
        let count = piece.corners.len();
        for (k, corner) in piece.corners.iter().enumerate() {
            let next = &piece.corners[(k + 1) % count];
            let [a, b] = [corner, next].map(|at| sign * plane.height(at));
            if a >= -ON_M {
                corners.push(*corner);
            }
            // A stretch of a line goes there, and not back.
            let once = count > 2 || k == 0;
            if once && (a > ON_M && b < -ON_M || a < -ON_M && b > ON_M) {
                corners.push(corner + (next - corner) * (a / (a - b)));
            }
        }
        let least = count.min(3);
        (corners.len() >= least).then(|| Piece {
            corners,
            ..piece.clone()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(of: usize, corners: &[[f64; 3]]) -> Piece {
        let corners: Vec<_> = corners.iter().map(|c| Vector3::from(*c)).collect();
        let normal = (corners[1] - corners[0]).cross(&(corners[corners.len() - 1] - corners[0]));
        let normal = if corners.len() > 2 {
            normal.normalize()
        } else {
            Vector3::zeros()
        };
        Piece { corners, normal, of }
    }

    fn level(of: usize, z: f64, half: f64) -> Piece {
        piece(
            of,
            &[[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]],
        )
    }

    fn area(piece: &Piece) -> f64 {
        let at = |k: usize| piece.corners[k] - piece.corners[0];
        (1..piece.corners.len() - 1)
            .map(|k| 0.5 * at(k).cross(&at(k + 1)).norm())
            .sum()
    }

    #[test]
    fn the_nearer_one_is_drawn_later() {
        let eye = Vector3::new(0.3, 0.2, 9.0);
        let flat = (0..7)
            .map(|k| level(k, [0.3, -0.5, 0.9, 0.0, -0.2, 0.5, 0.1][k], 1.0))
            .collect();
        let line = piece(7, &[[-0.9, 0.0, 0.2], [0.9, 0.0, 0.2]]);
        let order: Vec<_> = sorted(flat, vec![line], &eye).iter().map(|piece| piece.of).collect();
        assert_eq!(order, [1, 4, 3, 6, 7, 0, 5, 2]);
    }

    #[test]
    fn what_goes_through_is_parted_and_keeps_its_area() {
        let eye = Vector3::new(4.0, 0.5, 5.0);
        let upright = piece(
            1,
            &[[0.0, -1.0, -1.0], [0.0, 1.0, -1.0], [0.0, 1.0, 1.0], [0.0, -1.0, 1.0]],
        );
        let line = piece(2, &[[0.5, 0.0, -0.5], [0.5, 0.0, 0.5]]);
        let all = sorted(vec![level(0, 0.0, 1.0), upright], vec![line], &eye);
        let of = |of: usize| all.iter().enumerate().filter(move |(_, piece)| piece.of == of);
        for flat in [0, 1] {
            let sum: f64 = of(flat).map(|(_, piece)| area(piece)).sum();
            assert!((sum - 4.0).abs() < 1e-9, "{sum}");
        }
        assert_eq!(of(0).count() + of(1).count(), 3);
        // The lower part of the line is under the level facet, the upper one over it.
        let lower = of(2).find(|(_, piece)| piece.middle().z < 0.0).unwrap().0;
        let upper = of(2).find(|(_, piece)| piece.middle().z > 0.0).unwrap().0;
        let before = of(0).find(|(_, piece)| piece.middle().x > -1e-9).unwrap().0;
        assert!(lower < before && before < upper, "{lower} {before} {upper}");
    }

    /// Of a convex body, all facets are behind each other's planes: the tree is as deep as it can be.
    #[test]
    fn a_body_of_as_many_facets_as_are_parted_needs_no_stack() {
        let facet = |k: usize| {
            // A spiral over the half of a sphere that faces the eye.
            let z = 1.0 - 0.9 * k as f64 / MOST as f64;
            let (s, c) = (2.4 * k as f64).sin_cos();
            let out = Vector3::new((1.0 - z * z).sqrt() * c, (1.0 - z * z).sqrt() * s, z);
            let side = out.cross(&Vector3::new(0.3, 0.2, 0.9)).normalize() * 1e-3;
            let up = out.cross(&side);
            Piece {
                corners: vec![out, out + side, out + side + up, out + up],
                normal: out,
                of: k,
            }
        };
        let sort = move || {
            sorted(
                (0..MOST).map(facet).collect(),
                Vec::new(),
                &Vector3::new(0.0, 0.0, 50.0),
            )
            .len()
        };
        let small = std::thread::Builder::new().stack_size(1 << 17).spawn(sort).unwrap();
        assert!(small.join().unwrap() >= MOST);
    }
}
