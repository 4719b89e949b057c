//! The series of a panel in pixels: clipped, thinned, with what cannot be drawn counted.

use super::frame::Frame;
use super::frontier::{frontier, staircase};
use super::ink::{Ink, Marker};
use super::surface::{Refused, Surface};
use crate::document::plot::{Emphasis, Series, SeriesStyle};
use crate::document::thin;

/// How a series looks, in plots and in the legend.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    /// Its place among the names of the figure.
    pub(super) index: usize,
    pub(super) style: SeriesStyle,
    pub(super) emphasis: Emphasis,
}

impl Look {
    pub(super) fn ink(self) -> Ink {
        match self.style {
            SeriesStyle::Line => Ink::Patterned(self.index),
            SeriesStyle::Dashed => Ink::Dashed(self.index),
            SeriesStyle::Markers => Ink::Solid(self.index),
        }
    }

    pub(super) fn width(self) -> f64 {
        if self.emphasis == Emphasis::Strong { 2.6 } else { 1.7 }
    }

    pub(super) fn radius(self) -> f64 {
        if self.emphasis == Emphasis::Strong { 5.2 } else { 4.0 }
    }

    pub(super) fn has_line(self) -> bool {
        self.style != SeriesStyle::Markers
    }

    pub(super) fn has_markers(self) -> bool {
        self.style == SeriesStyle::Markers
    }
}

/// How finely a figure is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fineness {
    /// Lines are thinned to columns of this width, in pixels.
    pub(super) column: f64,
    /// Of the markers in a cell of this size, in pixels, one is drawn.
    pub(super) cell: f64,
    /// Size of markers, relative to that in a figure of one plot.
    pub(super) marker: f64,
}

/// Points that are not drawn, by reason.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Hidden {
    pub(super) not_finite: usize,
    pub(super) not_on_axis: usize,
    pub(super) outside: usize,
}

impl Hidden {
    /// In words; none if nothing is hidden.
    pub(super) fn note(self, name: &str) -> Option<String> {
        let reasons = [
            (self.not_finite, "not finite"),
            (self.not_on_axis, "not positive on a logarithmic axis"),
            (self.outside, "outside the axes"),
        ];
        let parts: Vec<_> = reasons
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, reason)| format!("{count} {reason}"))
            .collect();
        let whose = if name.is_empty() { String::new() } else { format!(" of “{name}”") };
        (!parts.is_empty()).then(|| format!("Points{whose} not drawn: {}.", parts.join(", ")))
    }
}

/// A series in pixels.
#[derive(Debug, Clone)]
pub(super) struct Traced {
    pub(super) name: String,
    pub(super) look: Look,
    /// Unbroken lines.
    pub(super) lines: Vec<Vec<(f64, f64)>>,
    /// Places of points within the plot area, whether or not markers are drawn there.
    pub(super) places: Vec<(f64, f64)>,
    pub(super) hidden: Hidden,
}

impl Traced {
    pub(super) fn new(series: &Series, look: Look, frame: &Frame) -> Self {
        let mut hidden = Hidden::default();
        let mut places = Vec::new();
        let mut runs = vec![Vec::new()];
        for &point in &series.points {
            let place = frame.at(point);
            match place {
                Some(place) if frame.shows(place) => places.push(place),
                Some(_) => hidden.outside += 1,
                None if point.0.is_finite() && point.1.is_finite() => hidden.not_on_axis += 1,
                None => hidden.not_finite += 1,
            }
            match (place, runs.last_mut()) {
                (Some(place), Some(run)) => run.push(place),
                _ => runs.push(Vec::new()),
            }
        }
        let lines = match series.style {
            SeriesStyle::Markers => Vec::new(),
            _ => runs.iter().flat_map(|run| clipped(run, frame)).collect(),
        };
        Self { name: series.name.clone(), look, lines, places, hidden }
    }

    /// Number of points of its lines when thinned to columns of `width` pixels.
    pub(super) fn line_points(&self, width: f64) -> usize {
        self.lines.iter().map(|line| thin::by_column(line, width).len()).sum()
    }

    /// Places of its markers when those that share a cell of `cell` pixels are drawn once.
    pub(super) fn markers(&self, cell: f64) -> Vec<(f64, f64)> {
        if !self.look.has_markers() {
            return Vec::new();
        }
        let mut taken = std::collections::BTreeSet::new();
        let key = |v: f64| (v / cell).floor().to_bits();
        self.places.iter().filter(|p| taken.insert((key(p.0), key(p.1)))).copied().collect()
    }

    /// Draws it.
    pub(super) fn draw(
        &self,
        on: &Surface<'_>,
        Fineness { column, cell, marker }: Fineness,
    ) -> Result<(), Refused> {
        let look = self.look;
        for line in &self.lines {
            match thin::by_column(line, column).as_slice() {
                [] => {}
                // A point between two gaps would not show as a line.
                [place] if !look.has_markers() => {
                    on.marker(Marker::Circle, *place, 1.3, Ink::Solid(look.index))?;
                }
                places => on.line(places, look.ink(), look.width())?,
            }
        }
        for place in self.markers(cell) {
            let ink = Ink::Solid(look.index);
            on.marker(Marker::of(look.index), place, marker * look.radius(), ink)?;
        }
        Ok(())
    }
}

/// The staircase of the frontier of `points`, in pixels.
pub(super) fn frontier_line(points: &[(f64, f64)], frame: &Frame) -> Vec<(f64, f64)> {
    let places: Vec<_> = frontier(points)
        .into_iter()
        .filter_map(|p| frame.at(p))
        .filter(|p| frame.shows(*p))
        .collect();
    staircase(&places, frame.area.top, frame.area.right())
}

/// The parts of a line within the plot area.
fn clipped(run: &[(f64, f64)], frame: &Frame) -> Vec<Vec<(f64, f64)>> {
    if let [place] = run {
        return if frame.shows(*place) { vec![vec![*place]] } else { Vec::new() };
    }
    let mut lines: Vec<Vec<(f64, f64)>> = Vec::new();
    for pair in run.windows(2) {
        let [a, b] = pair else { continue };
        let Some((from, to)) = frame.area.clip(*a, *b) else { continue };
        match lines.last_mut() {
            Some(line) if line.last() == Some(&from) => line.push(to),
            _ => lines.push(vec![from, to]),
        }
    }
    lines
}
