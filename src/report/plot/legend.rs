//! The legend of a figure: rows of entries under every plot, so that it never covers data.

use plotters::style::text_anchor::HPos;

use super::frame::Rect;
use super::ink::{Ink, Marker};
use super::lettering;
use super::series::Look;
use super::surface::{Lettering, Refused, Surface};

const SIZE: f64 = 12.0;
const ROW: f64 = 20.0;
const SWATCH: f64 = 34.0;
const GAP: f64 = 22.0;

/// What an entry shows beside its name.
#[derive(Debug, Clone, Copy)]
pub(super) enum Swatch {
    Series(Look),
    Frontier,
}

/// The legend, laid out.
#[derive(Debug, Default)]
pub(super) struct Legend {
    entries: Vec<(Swatch, String, (f64, f64))>,
    height: f64,
    width: f64,
}

impl Legend {
    /// Entries in rows within `room` pixels.
    pub(super) fn new(entries: Vec<(Swatch, String)>, room: f64) -> Self {
        let mut legend = Self::default();
        let (mut x, mut row) = (0.0, 0.0);
        for (swatch, name) in entries {
            let name = lettering::fitted(&name, SIZE, room - SWATCH);
            let width = SWATCH + lettering::width(&name, SIZE);
            if x > 0.0 && x + width > room {
                (x, row) = (0.0, row + 1.0);
            }
            legend.entries.push((swatch, name, (x, row * ROW + ROW / 2.0)));
            legend.width = legend.width.max(x + width);
            legend.height = (row + 1.0) * ROW;
            x += width + GAP;
        }
        legend
    }

    /// What it covers with its upper left corner at `left`, `top`; none if there are no entries.
    pub(super) fn area(&self, left: f64, top: f64) -> Option<Rect> {
        let (width, height) = (self.width, self.height);
        (!self.entries.is_empty()).then_some(Rect { left, top, width, height })
    }

    /// Draws it there.
    pub(super) fn draw(&self, on: &Surface<'_>, left: f64, top: f64) -> Result<(), Refused> {
        for (swatch, name, (x, y)) in &self.entries {
            let (x, y) = (left + x, top + y);
            let line = [(x, y), (x + SWATCH - 8.0, y)];
            match swatch {
                Swatch::Series(look) => {
                    if look.has_line() {
                        on.line(&line, look.ink(), look.width())?;
                    }
                    if look.has_markers() {
                        let middle = (x + (SWATCH - 8.0) / 2.0, y);
                        let shape = Marker::of(look.index);
                        let ink = Ink::Solid(look.index);
                        on.marker(shape, middle, look.radius(), ink)?;
                    }
                }
                Swatch::Frontier => on.line(&line, Ink::Text(0.55), 1.3)?,
            }
            on.text(name, (x + SWATCH, y), Lettering::new(SIZE, HPos::Left))?;
        }
        Ok(())
    }
}
