//! One plot of a figure: its axes, its series, its labels.

use plotters::style::text_anchor::HPos;

use super::frame::{Frame, Rect};
use super::ink::Ink;
use super::labels::{self, Obstacles, Placed};
use super::lettering;
use super::scale::Span;
use super::series::{Fineness, Look, Traced, frontier_line};
use super::surface::{Lettering, Refused, Surface};
use crate::document::plot::{Plot, Series, SeriesStyle};

/// Size of tick labels, in pixels.
pub(super) const TICK: f64 = 11.0;
/// Size of axis labels.
const LABEL: f64 = 12.0;
/// Size of titles.
const TITLE: f64 = 13.0;

/// Which outer parts of a panel are drawn; small multiples share the others.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shown {
    pub(super) x_label: bool,
    pub(super) y_label: bool,
    pub(super) minor_grid: bool,
}

/// The axes of a plot, before its place in the figure is known.
#[derive(Debug)]
pub(super) struct Axes {
    pub(super) x: Span,
    pub(super) y: Span,
}

impl Axes {
    /// Axes for a plot area of about `width` by `height` pixels.
    pub(super) fn new(plot: &Plot, width: f64, height: f64) -> Self {
        let x = |wanted| {
            let points = plot.series.iter().flat_map(|s| s.points.iter().map(|p| p.0));
            let labels = plot.annotations.iter().map(|a| a.x);
            // Labels beside the outermost points want room.
            let margin = match (plot.annotations.is_empty(), has_markers(plot)) {
                (false, _) => 0.12,
                (true, true) => 0.06,
                (true, false) => 0.015,
            };
            Span::new(&plot.x, points.chain(labels), margin, wanted)
        };
        let y = {
            let points = plot.series.iter().flat_map(|s| s.points.iter().map(|p| p.1));
            let labels = plot.annotations.iter().map(|a| a.y);
            let margin = if has_markers(plot) { 0.08 } else { 0.05 };
            let values = points.chain(labels);
            Span::new(
                &plot.y,
                values,
                margin,
                steps(height, if height < 250.0 { 32.0 } else { 44.0 }),
            )
        };
        // Fewer ticks until their labels stand apart.
        let most = steps(width, 80.0);
        let apart = |span: &Span| {
            let widths = span.ticks.iter().map(|t| lettering::width(&t.label, TICK) + 10.0);
            widths.sum::<f64>() <= width
        };
        let mut span = x(most);
        for wanted in (2..most).rev() {
            if apart(&span) {
                break;
            }
            span = x(wanted);
        }
        Self { x: span, y }
    }

    /// Width of the widest label of the y axis.
    pub(super) fn y_label_width(&self) -> f64 {
        self.y.ticks.iter().map(|t| lettering::width(&t.label, TICK)).fold(0.0, f64::max)
    }
}

/// Room for ticks at one per `pixels`, 2 or more.
fn steps(length: f64, pixels: f64) -> usize {
    (2_u32..=12).take_while(|n| f64::from(*n) * pixels <= length).last().unwrap_or(2) as usize
}

fn has_markers(plot: &Plot) -> bool {
    plot.frontier || plot.series.iter().any(|series| series.style == SeriesStyle::Markers)
}

/// Space around the plot area.
#[derive(Debug, Clone, Copy)]
pub(super) struct Margins {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

impl Margins {
    /// Margins with tick labels of the y axis `label_width` wide.
    pub(super) fn new(label_width: f64, titled: bool, shown: Shown) -> Self {
        Self {
            left: 12.0 + label_width + if shown.y_label { 20.0 } else { 0.0 },
            right: 16.0,
            top: if titled { 30.0 } else { 12.0 },
            bottom: 22.0 + if shown.x_label { 20.0 } else { 4.0 },
        }
    }
}

/// A plot in its place.
pub(super) struct Panel<'a> {
    plot: &'a Plot,
    pub(super) frame: Frame,
    pub(super) traced: Vec<Traced>,
    frontier: Vec<(f64, f64)>,
    pub(super) labels: Vec<Placed>,
    shown: Shown,
}

impl<'a> Panel<'a> {
    pub(super) fn new(
        plot: &'a Plot,
        axes: Axes,
        area: Rect,
        shown: Shown,
        look: impl Fn(&Series) -> Look,
    ) -> Self {
        let frame = Frame { area, x: axes.x, y: axes.y };
        let traced: Vec<_> = plot.series.iter().map(|s| Traced::new(s, look(s), &frame)).collect();
        let frontier = if plot.frontier {
            let marked = plot.series.iter().filter(|s| look(s).has_markers());
            let points: Vec<_> = marked.flat_map(|s| s.points.iter().copied()).collect();
            frontier_line(&points, &frame)
        } else {
            Vec::new()
        };
        let segments = |line: &[(f64, f64)]| -> Vec<_> {
            line.windows(2).filter_map(|w| Some((*w.first()?, *w.last()?))).collect()
        };
        let lines = traced.iter().flat_map(|t| &t.lines).chain([&frontier]);
        let obstacles = Obstacles {
            places: traced.iter().flat_map(|t| t.markers(1.0)).collect(),
            segments: lines.flat_map(|line| segments(line)).collect(),
        };
        let texts: Vec<_> = plot
            .annotations
            .iter()
            .filter_map(|a| Some((a.text.clone(), frame.at((a.x, a.y))?)))
            .filter(|(_, place)| frame.shows(*place))
            .collect();
        let labels = labels::place(&texts, &area, &obstacles);
        Self { plot, frame, traced, frontier, labels, shown }
    }

    /// What the caption must say about it.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes: Vec<_> = self.traced.iter().filter_map(|t| t.hidden.note(&t.name)).collect();
        for (axis, span) in [(&self.plot.x, &self.frame.x), (&self.plot.y, &self.frame.y)] {
            if span.range_ignored {
                notes.push(format!("The range asked for {} cannot be drawn.", axis.label));
            }
        }
        let missing = self.plot.annotations.len() - self.labels.len();
        if missing > 0 {
            notes.push(format!("Labels not drawn, their points being off the axes: {missing}."));
        }
        notes
    }

    /// Draws it.
    pub(super) fn draw(&self, on: &Surface<'_>, fineness: Fineness) -> Result<(), Refused> {
        self.draw_grid(on)?;
        if self.frontier.len() > 1 {
            on.line(&self.frontier, Ink::Text(0.55), 1.3)?;
        }
        for series in &self.traced {
            series.draw(on, fineness)?;
        }
        labels::draw(&self.labels, on)?;
        self.draw_lettering(on)
    }

    fn draw_grid(&self, on: &Surface<'_>) -> Result<(), Refused> {
        let area = &self.frame.area;
        let vertical = |x: f64| [(x, area.top), (x, area.bottom())];
        let horizontal = |y: f64| [(area.left, y), (area.right(), y)];
        if self.shown.minor_grid {
            for x in self.frame.x.minor.iter().filter_map(|v| self.frame.x_at(*v)) {
                on.line(&vertical(x), Ink::Text(0.06), 0.6)?;
            }
            for y in self.frame.y.minor.iter().filter_map(|v| self.frame.y_at(*v)) {
                on.line(&horizontal(y), Ink::Text(0.06), 0.6)?;
            }
        }
        let tick = Lettering::new(TICK, HPos::Center);
        for (x, label) in ticks(&self.frame.x, |v| self.frame.x_at(v)) {
            on.line(&vertical(x), Ink::Text(0.14), 0.8)?;
            on.line(&[(x, area.bottom()), (x, area.bottom() + 4.0)], Ink::Text(0.8), 1.0)?;
            on.text(label, (x, area.bottom() + 13.0), tick)?;
        }
        let tick = Lettering::new(TICK, HPos::Right);
        for (y, label) in ticks(&self.frame.y, |v| self.frame.y_at(v)) {
            on.line(&horizontal(y), Ink::Text(0.14), 0.8)?;
            on.line(&[(area.left - 4.0, y), (area.left, y)], Ink::Text(0.8), 1.0)?;
            on.text(label, (area.left - 7.0, y), tick)?;
        }
        let corner = (area.left, area.bottom());
        let axes = [(area.left, area.top), corner, (area.right(), area.bottom())];
        on.line(&axes, Ink::Text(0.8), 1.0)
    }

    fn draw_lettering(&self, on: &Surface<'_>) -> Result<(), Refused> {
        let area = &self.frame.area;
        let (plot, middle) = (self.plot, area.left + area.width / 2.0);
        if !plot.title.is_empty() {
            let title = lettering::fitted(&plot.title, TITLE * 1.06, area.width);
            let style = Lettering { bold: true, ..Lettering::new(TITLE, HPos::Left) };
            on.text(&title, (area.left, area.top - 15.0), style)?;
        }
        if self.shown.x_label {
            let text = lettering::fitted(&plot.x.heading(), LABEL, area.width);
            let style = Lettering::new(LABEL, HPos::Center);
            on.text(&text, (middle, area.bottom() + 32.0), style)?;
        }
        if self.shown.y_label {
            let text = lettering::fitted(&plot.y.heading(), LABEL, area.height + 24.0);
            let style = Lettering { upwards: true, ..Lettering::new(LABEL, HPos::Center) };
            let widest = self.frame.y.ticks.iter().map(|t| lettering::width(&t.label, TICK));
            let x = area.left - 18.0 - widest.fold(0.0, f64::max);
            on.text(&text, (x, area.top + area.height / 2.0), style)?;
        }
        Ok(())
    }
}

/// Places and labels of the ticks of an axis.
fn ticks(span: &Span, at: impl Fn(f64) -> Option<f64>) -> impl Iterator<Item = (f64, &str)> {
    span.ticks.iter().filter_map(move |t| Some((at(t.value)?, t.label.as_str())))
}
