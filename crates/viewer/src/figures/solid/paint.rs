//! Shapes of one look that follow one another, drawn as one.

use super::super::ink::drawing::{Drawing, Spot};
use super::super::ink::style::Style;

/// Whether shapes are lines or fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Line,
    Field,
}

/// Draws shape after shape on a drawing.
pub(super) struct Painter<'d> {
    drawing: &'d mut Drawing,
    open: Option<(Kind, Style, Vec<Vec<Spot>>)>,
}

impl<'d> Painter<'d> {
    pub fn new(drawing: &'d mut Drawing) -> Self {
        let open = None;
        Self { drawing, open }
    }

    /// A stretch of a line: where it goes on from the last one, they are one line.
    pub fn line(&mut self, through: Vec<Spot>, style: &Style) {
        if let Some(lines) = self.open(Kind::Line, style) {
            match lines.last_mut().filter(|line| line.last() == through.first()) {
                Some(line) => line.extend(through.into_iter().skip(1)),
                None => lines.push(through),
            }
        }
    }

    /// A field.
    pub fn field(&mut self, corners: Vec<Spot>, style: &Style) {
        if let Some(fields) = self.open(Kind::Field, style) {
            fields.push(corners);
        }
    }

    /// What is to be drawn on all shapes so far.
    pub fn over(&mut self, draw: impl FnOnce(&mut Drawing)) {
        self.close();
        draw(self.drawing);
    }

    /// The shapes of a kind and a look that are in the making.
    fn open(&mut self, kind: Kind, style: &Style) -> Option<&mut Vec<Vec<Spot>>> {
        if !matches!(&self.open, Some((k, s, _)) if *k == kind && s == style) {
            self.close();
            self.open = Some((kind, style.clone(), Vec::new()));
        }
        self.open.as_mut().map(|(_, _, shapes)| shapes)
    }

    /// Draws what is in the making.
    pub fn close(&mut self) {
        match self.open.take() {
            Some((Kind::Line, style, lines)) => self.drawing.polylines(&lines, &style),
            Some((Kind::Field, style, fields)) => self.drawing.polygons(&fields, &style),
            None => {}
        }
    }
}
