//! Intervals of time, from the whole motion down to parts of a piece, each with bounds on the joints.

use crate::motion::piece::{Extent, Piece};
use platewash_kinematics::JointVector;
use std::ops::Range;

/// Pieces of a motion with bounds for groups of them, a binary tree in preorder: the left half of a group of n pieces follows it, and the
/// right half comes after the 2m − 1 groups of the left one, of m pieces.
#[derive(Debug)]
pub(crate) struct Timeline<'a> {
    pieces: &'a [Piece],
    groups: Vec<Extent>,
}

/// Interval of time.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Interval {
    /// Range of pieces, a group of the tree.
    Pieces { group: usize, first: usize, end: usize },
    /// Part of a piece: start and end within it \[s\], and its place in the tree of halvings: 1 for the whole piece, 2n and 2n + 1 for the
    /// halves of n; 0 for a part so small that it has no number.
    Within { piece: usize, u: [f64; 2], node: u64 },
}

impl<'a> Timeline<'a> {
    pub fn new(pieces: &'a [Piece]) -> Self {
        let mut timeline = Self {
            pieces,
            groups: Vec::with_capacity(2 * pieces.len()),
        };
        if !pieces.is_empty() {
            timeline.group(0, pieces.len());
        }
        timeline
    }

    fn group(&mut self, first: usize, end: usize) -> Extent {
        let here = self.groups.len();
        if end - first == 1 {
            let piece = &self.pieces[first];
            self.groups.push(piece.extent([0.0, piece.length_s]));
        } else {
            // Its place comes before those of its halves.
            self.groups.push(Extent::default());
            let middle = middle(first, end);
            let mut extent = self.group(first, middle).and(&self.group(middle, end));
            extent.jumps += self.pieces[middle - 1].jump_to(&self.pieces[middle]);
            self.groups[here] = extent;
        }
        self.groups[here]
    }

    /// Number of pieces.
    pub fn count(&self) -> usize {
        self.pieces.len()
    }

    /// Bounds over the whole motion.
    pub fn whole_extent(&self) -> Option<&Extent> {
        self.groups.first()
    }

    /// Returns intervals that together make up the given pieces.
    pub fn cover(&self, pieces: &Range<usize>) -> Vec<Interval> {
        let mut all = Vec::new();
        if !self.pieces.is_empty() {
            self.descend((0, 0, self.pieces.len()), pieces, &mut all);
        }
        all
    }

    fn descend(&self, (group, first, end): (usize, usize, usize), wanted: &Range<usize>, all: &mut Vec<Interval>) {
        if wanted.start <= first && end <= wanted.end {
            all.push(Interval::Pieces { group, first, end });
        } else if wanted.start < end && first < wanted.end {
            for half in halves(group, first, end) {
                self.descend(half, wanted, all);
            }
        }
    }

    /// Returns both halves; `None` if the time cannot be halved any more.
    pub fn halves(&self, interval: &Interval) -> Option<[Interval; 2]> {
        match *interval {
            Interval::Pieces { group, first, end } if end - first > 1 => {
                Some(halves(group, first, end).map(|(group, first, end)| Interval::Pieces { group, first, end }))
            }
            Interval::Pieces { first, .. } => {
                let u = [0.0, self.pieces[first].length_s];
                self.halves(&Interval::Within {
                    piece: first,
                    u,
                    node: 1,
                })
            }
            Interval::Within {
                piece,
                u: [from, to],
                node,
            } => {
                let middle = 0.5 * (from + to);
                let has_number = (1..1 << 62).contains(&node);
                let half = |u, second: u64| Interval::Within {
                    piece,
                    u,
                    node: if has_number { 2 * node + second } else { 0 },
                };
                (middle > from && middle < to).then(|| [half([from, middle], 0), half([middle, to], 1)])
            }
        }
    }

    /// Returns the bounds over an interval.
    pub fn extent(&self, interval: &Interval) -> Extent {
        match *interval {
            Interval::Pieces { group, .. } => self.groups[group],
            Interval::Within { piece, u, .. } => self.pieces[piece].extent(u),
        }
    }

    /// Length \[s\]. It is computed without a difference of large times, so it does not round to less however late the interval begins.
    pub fn length_s(&self, interval: &Interval) -> f64 {
        match *interval {
            Interval::Pieces { first, end, .. } => {
                let sum: f64 = self.pieces[first..end].iter().map(|piece| piece.length_s).sum();
                sum * (1.0 + (end - first) as f64 * f64::EPSILON)
            }
            Interval::Within { u: [from, to], .. } => to - from,
        }
    }

    /// Start and end times \[s\].
    pub fn times(&self, interval: &Interval) -> [f64; 2] {
        match *interval {
            Interval::Pieces { first, end, .. } => {
                let last = &self.pieces[end - 1];
                [self.pieces[first].start_s, last.start_s + last.length_s]
            }
            Interval::Within { piece, u, .. } => u.map(|u| self.pieces[piece].start_s + u),
        }
    }

    /// Joint positions at the start and at the end \[rad\].
    pub fn ends(&self, interval: &Interval) -> [JointVector; 2] {
        match *interval {
            Interval::Pieces { first, end, .. } => {
                let last = &self.pieces[end - 1];
                [self.pieces[first].position(0.0), last.position(last.length_s)]
            }
            Interval::Within { piece, u, .. } => u.map(|u| self.pieces[piece].position(u)),
        }
    }

    /// A moment in the middle: its time \[s\] and the joint positions \[rad\].
    pub fn middle(&self, interval: &Interval) -> (f64, JointVector) {
        let (piece, u) = match *interval {
            Interval::Pieces { first, end, .. } if end - first > 1 => (middle(first, end), 0.0),
            Interval::Pieces { first, .. } => (first, 0.5 * self.pieces[first].length_s),
            Interval::Within {
                piece, u: [from, to], ..
            } => (piece, 0.5 * (from + to)),
        };
        let piece = &self.pieces[piece];
        (piece.start_s + u, piece.position(u))
    }
}

fn middle(first: usize, end: usize) -> usize {
    first + (end - first) / 2
}

fn halves(group: usize, first: usize, end: usize) -> [(usize, usize, usize); 2] {
    let middle = middle(first, end);
    [(group + 1, first, middle), (group + 2 * (middle - first), middle, end)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_group_bounds_its_pieces_and_covers_are_exact() {
        let q = |k: usize| JointVector::repeat((k * k % 7) as f64);
        let pieces: Vec<_> = (0..13)
            .map(|k| Piece::new([k as f64, k as f64 + 1.0], [q(k), q(k + 1)], [JointVector::zeros(); 2]))
            .collect();
        let timeline = Timeline::new(&pieces);
        assert_eq!(timeline.groups.len(), 25);
        for from in 0..13 {
            for to in from + 1..=13 {
                let cover = timeline.cover(&(from..to));
                let mut next = from;
                for interval in cover {
                    let Interval::Pieces { first, end, .. } = interval else {
                        panic!()
                    };
                    assert_eq!(first, next);
                    next = end;
                    let extent = timeline.extent(&interval);
                    let expected = pieces[first..end]
                        .iter()
                        .map(|p| p.extent([0.0, 1.0]))
                        .reduce(|a, b| a.and(&b))
                        .unwrap();
                    assert_eq!((extent.least, extent.most), (expected.least, expected.most));
                    assert_eq!(timeline.times(&interval), [first as f64, end as f64]);
                }
                assert_eq!(next, to);
            }
        }
        assert!(timeline.cover(&(4..4)).is_empty());
        assert!(Timeline::new(&[]).cover(&(0..1)).is_empty());
    }
}
