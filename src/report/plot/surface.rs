//! What plots are drawn on: plotters' SVG back end in tenths of a pixel, so that its whole
//! coordinates are fine enough for smooth curves.

use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, PathElement, Polygon, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, FontTransform, ShapeStyle, TextStyle};

use super::ink::{Ink, Marker};

/// Units of the drawing per pixel.
pub(super) const UNITS: f64 = 10.0;

/// plotters' SVG back end divides font sizes by this.
const FONT_SIZE_DIVISOR: f64 = 1.24;

/// The drawing library's refusal, in its words.
#[derive(Debug)]
pub(super) struct Refused(pub(super) String);

/// How a piece of text is set.
#[derive(Clone, Copy)]
pub(super) struct Lettering {
    /// Size in pixels.
    pub(super) size: f64,
    /// Which end of the text stands at its place.
    pub(super) anchor: HPos,
    /// Bold.
    pub(super) bold: bool,
    /// Reading upwards.
    pub(super) upwards: bool,
}

impl Lettering {
    pub(super) fn new(size: f64, anchor: HPos) -> Self {
        Self { size, anchor, bold: false, upwards: false }
    }
}

/// A drawing in progress; places and sizes are in pixels.
pub(super) struct Surface<'a> {
    root: DrawingArea<SVGBackend<'a>, Shift>,
}

impl<'a> Surface<'a> {
    pub(super) fn new(buffer: &'a mut String, width: f64, height: f64) -> Self {
        let size = (units(width).unsigned_abs(), units(height).unsigned_abs());
        Self { root: SVGBackend::with_string(buffer, size).into_drawing_area() }
    }

    /// A line through `places`.
    pub(super) fn line(&self, places: &[(f64, f64)], ink: Ink, width: f64) -> Result<(), Refused> {
        let points: Vec<_> = places.iter().map(|p| at(*p)).collect();
        let style = ShapeStyle { stroke_width: units(width).unsigned_abs(), ..fill(ink) };
        let style = ShapeStyle { filled: false, ..style };
        self.root.draw(&PathElement::new(points, style)).map_err(refused)
    }

    /// A marker of half-width `radius`.
    pub(super) fn marker(
        &self,
        shape: Marker,
        (x, y): (f64, f64),
        radius: f64,
        ink: Ink,
    ) -> Result<(), Refused> {
        let r = radius;
        let corners: &[(f64, f64)] = match shape {
            Marker::Circle => {
                let radius = units(r);
                let dot = Circle::new(at((x, y)), radius, fill(ink));
                return self.root.draw(&dot).map_err(refused);
            }
            Marker::Square => {
                let half = 0.85 * r;
                let corners = [at((x - half, y - half)), at((x + half, y + half))];
                return self.root.draw(&Rectangle::new(corners, fill(ink))).map_err(refused);
            }
            Marker::Cross => {
                let d = 0.85 * r;
                self.line(&[(x - d, y - d), (x + d, y + d)], ink, 1.8)?;
                return self.line(&[(x - d, y + d), (x + d, y - d)], ink, 1.8);
            }
            Marker::Plus => {
                self.line(&[(x - r, y), (x + r, y)], ink, 1.8)?;
                return self.line(&[(x, y - r), (x, y + r)], ink, 1.8);
            }
            Marker::Triangle => &[(0.0, -1.15), (1.05, 0.75), (-1.05, 0.75)],
            Marker::Wedge => &[(0.0, 1.15), (1.05, -0.75), (-1.05, -0.75)],
            Marker::Diamond => &[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)],
        };
        let points: Vec<_> = corners.iter().map(|(dx, dy)| at((x + dx * r, y + dy * r))).collect();
        self.root.draw(&Polygon::new(points, fill(ink))).map_err(refused)
    }

    /// Text, centred vertically on `place`.
    pub(super) fn text(
        &self,
        text: &str,
        place: (f64, f64),
        lettering: Lettering,
    ) -> Result<(), Refused> {
        let mut font: plotters::style::FontDesc<'_> =
            ("sans-serif", lettering.size * UNITS * FONT_SIZE_DIVISOR).into();
        if lettering.bold {
            font = font.style(FontStyle::Bold);
        }
        if lettering.upwards {
            font = font.transform(FontTransform::Rotate270);
        }
        let colour = Ink::Text(1.0).colour();
        let style =
            TextStyle::from(font).color(&colour).pos(Pos::new(lettering.anchor, VPos::Center));
        self.root.draw(&Text::new(printable(text), at(place), style)).map_err(refused)
    }

    /// Completes the drawing.
    pub(super) fn finish(self) -> Result<(), Refused> {
        self.root.present().map_err(refused)
    }
}

fn refused(error: impl std::fmt::Display) -> Refused {
    Refused(error.to_string())
}

fn fill(ink: Ink) -> ShapeStyle {
    ShapeStyle { color: ink.colour(), filled: true, stroke_width: 0 }
}

fn at((x, y): (f64, f64)) -> (i32, i32) {
    (units(x), units(y))
}

/// Tenths of a pixel. Everything drawn lies within a figure, so far within the range of i32.
fn units(pixels: f64) -> i32 {
    (pixels * UNITS).round().clamp(-1e6, 1e6) as i32
}

/// `text` with a space for every control character: XML allows none of them.
pub(super) fn printable(text: &str) -> String {
    text.replace(|c: char| c.is_control(), " ")
}
