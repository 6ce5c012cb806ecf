//! Square fields of equal size in a room, with words under each, and faces of plates in them.

use super::svg::{Drawing, Rect};

/// White between fields \[px\].
const GAP: f64 = 34.0;

/// Fields of equal size, row by row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fields {
    room: Rect,
    columns: usize,
    edge: f64,
    under: f64,
}

impl Fields {
    /// Fields as large as `count` of them with `under` pixels for words below each can be; in the given number of columns, if
    /// any.
    pub(super) fn new(room: Rect, count: usize, columns: Option<usize>, under: f64) -> Self {
        let edge = |columns: usize| {
            let rows = count.div_ceil(columns) as f64;
            let across = (room.size[0] - GAP * (columns as f64 - 1.0)) / columns as f64;
            let down = (room.size[1] - rows * under - GAP * 0.3 * (rows - 1.0)) / rows;
            across.min(down).max(20.0)
        };
        let best = (1..=count.max(1)).max_by(|&a, &b| edge(a).total_cmp(&edge(b)));
        let columns = columns.or(best).unwrap_or(1).max(1);
        Self {
            room,
            columns,
            edge: edge(columns),
            under,
        }
    }

    /// The field at a place, counted from 0.
    pub(super) fn cell(&self, place: usize) -> Rect {
        let (row, column) = ((place / self.columns) as f64, (place % self.columns) as f64);
        let width = self.columns as f64 * (self.edge + GAP) - GAP;
        let left = self.room.at[0] + 0.5 * (self.room.size[0] - width).max(0.0);
        let y = self.room.at[1] + row * (self.edge + self.under + GAP * 0.3);
        Rect::new(left + column * (self.edge + GAP), y, self.edge, self.edge)
    }
}

/// Colours the cells of a square face, row by row, y and x ascending, those of one colour as one shape.
pub(super) fn colour_cells<T>(
    drawing: &mut Drawing,
    face: Rect,
    cells: &[T],
    along: usize,
    colour: impl Fn(&T) -> Option<&'static str>,
) {
    let mut of_colour: Vec<(&str, Vec<Rect>)> = Vec::new();
    for (y, row) in cells.chunks(along).enumerate() {
        let mut from = 0;
        for run in row.chunk_by(|a, b| colour(a) == colour(b)) {
            let rect = Rect::new(from as f64, (along - 1 - y) as f64, run.len() as f64, 1.0);
            from += run.len();
            let Some(colour) = run.first().and_then(&colour) else {
                continue;
            };
            match of_colour.iter_mut().find(|(other, _)| *other == colour) {
                Some((_, rects)) => rects.push(rect),
                None => of_colour.push((colour, vec![rect])),
            }
        }
    }
    let ([x, y], edge) = (face.at, face.size[0] / along as f64);
    let to_face = format!("transform=\"translate({x:.1} {y:.1}) scale({edge:.4})\"");
    drawing.group(&to_face, |drawing| {
        for (colour, rects) in of_colour {
            drawing.cells(&rects, colour);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figure_fields_stay_in_their_area_and_apart() {
        let room = Rect::new(50.0, 160.0, 1500.0, 740.0);
        let holds = |rect: &Rect| (0..2).all(|k| rect.at[k] >= room.at[k] && rect.end()[k] <= room.end()[k]);
        let meets = |a: &Rect, b: &Rect| (0..2).all(|k| a.at[k] < b.end()[k] && b.at[k] < a.end()[k]);
        for count in 1..=24 {
            let fields = Fields::new(room, count, None, 78.0);
            let with_words = |place| {
                let cell = fields.cell(place);
                Rect::new(cell.at[0], cell.at[1], cell.size[0], cell.size[1] + 78.0)
            };
            let cells: Vec<Rect> = (0..count).map(with_words).collect();
            for (k, cell) in cells.iter().enumerate() {
                assert!(holds(cell), "{count}: {cell:?}");
                assert!(cells[..k].iter().all(|other| !meets(other, cell)), "{count}");
            }
        }
    }
}
