//! Square fields of equal size in a room, with words under each.

use super::ink::drawing::Rect;

/// White between fields \[px\].
const GAP: f64 = 34.0;

/// Fields of equal size, row by row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    room: Rect,
    columns: usize,
    edge: f64,
    under: f64,
    shift: f64,
}

impl Grid {
    /// As large as `count` fields with `under` pixels for words below each can be.
    pub(super) fn new(room: Rect, count: usize, under: f64) -> Self {
        let edge = |columns: usize| {
            let rows = count.div_ceil(columns) as f64;
            let across = (room.size[0] - GAP * (columns as f64 - 1.0)) / columns as f64;
            let down = (room.size[1] - rows * under - GAP * 0.3 * (rows - 1.0)) / rows;
            across.min(down)
        };
        let count = count.max(1);
        let columns = (1..=count).max_by(|&a, &b| edge(a).total_cmp(&edge(b))).unwrap_or(1);
        Self::of_columns(room, columns, edge(columns), under)
    }

    /// As large as `count` fields beside one another can be.
    pub(super) fn row(room: Rect, count: usize, under: f64) -> Self {
        let count = count.max(1);
        let across = (room.size[0] - GAP * (count as f64 - 1.0)) / count as f64;
        Self::of_columns(room, count, across.min(room.size[1] - under), under)
    }

    fn of_columns(room: Rect, columns: usize, edge: f64, under: f64) -> Self {
        let edge = edge.max(20.0);
        let width = columns as f64 * edge + GAP * (columns as f64 - 1.0);
        Self {
            room,
            columns,
            edge,
            under,
            shift: 0.5 * (room.size[0] - width).max(0.0),
        }
    }

    /// The field at a place, counted from 0.
    pub(super) fn cell(&self, place: usize) -> Rect {
        let (row, column) = (place / self.columns, place % self.columns);
        let x = self.room.at[0] + self.shift + column as f64 * (self.edge + GAP);
        let y = self.room.at[1] + row as f64 * (self.edge + self.under + GAP * 0.3);
        Rect::new(x, y, self.edge, self.edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_keep_within_the_room_and_apart() {
        let room = Rect::new(50.0, 160.0, 1500.0, 740.0);
        for count in 1..=24 {
            let grid = Grid::new(room, count, 78.0);
            let cells: Vec<Rect> = (0..count).map(|place| grid.cell(place)).collect();
            for (k, cell) in cells.iter().enumerate() {
                let with_words = Rect::new(cell.at[0], cell.at[1], cell.size[0], cell.size[1] + 78.0);
                assert!(room.holds(&with_words), "{count}: {with_words:?}");
                assert!(cells[..k].iter().all(|other| !other.meets(&with_words)), "{count}");
            }
        }
    }
}
