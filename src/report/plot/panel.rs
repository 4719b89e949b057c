//! One plot of a figure: its axes, its series, its labels.

use super::canvas::{Canvas, Ink, Lettering};
use super::frame::{Frame, Rect};
use super::labels::{self, Obstacles, Placed};
use super::lettering;
use super::scale::Span;
use super::series::{FRONTIER, Fineness, Look, Traced, frontier_line};
use crate::document::plot::{Plot, Series, SeriesStyle};

/// Size of tick labels, in pixels.
const TICK: f64 = 11.0;
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

/// The axes of a plot, x and y, for a plot area of about `width` by `height` pixels.
pub(super) fn axes(plot: &Plot, width: f64, height: f64) -> [Span; 2] {
    let marked =
        plot.frontier || plot.series.iter().any(|series| series.style == SeriesStyle::Markers);
    let x = |wanted| {
        let points = plot.series.iter().flat_map(|s| s.points.iter().map(|p| p.0));
        let labels = plot.annotations.iter().map(|a| a.x);
        // Labels beside the outermost points want room.
        let margin = match (plot.annotations.is_empty(), marked) {
            (false, _) => 0.12,
            (true, true) => 0.06,
            (true, false) => 0.015,
        };
        Span::new(&plot.x, points.chain(labels), margin, wanted)
    };
    // Fewer ticks until their labels stand apart.
    let apart = |span: &Span| {
        let widths = span.ticks.iter().map(|t| lettering::width(&t.label, TICK) + 10.0);
        widths.sum::<f64>() <= width
    };
    let fewer = (2..=steps(width, 80.0)).rev();
    let across = fewer.map(x).find(apart).unwrap_or_else(|| x(2));
    let points = plot.series.iter().flat_map(|s| s.points.iter().map(|p| p.1));
    let values = points.chain(plot.annotations.iter().map(|a| a.y));
    let margin = if marked { 0.08 } else { 0.05 };
    let wanted = steps(height, if height < 250.0 { 32.0 } else { 44.0 });
    [across, Span::new(&plot.y, values, margin, wanted)]
}

/// Room for ticks at one per `pixels`, 2 or more.
fn steps(length: f64, pixels: f64) -> usize {
    (2_u32..=12).take_while(|n| f64::from(*n) * pixels <= length).last().unwrap_or(2) as usize
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
        [x, y]: [Span; 2],
        area: Rect,
        shown: Shown,
        look: impl Fn(&Series) -> Look,
    ) -> Self {
        let frame = Frame { area, x, y };
        let traced: Vec<_> = plot.series.iter().map(|s| Traced::new(s, look(s), &frame)).collect();
        let frontier = if plot.frontier {
            let marked = plot.series.iter().filter(|s| s.style == SeriesStyle::Markers);
            let points: Vec<_> = marked.flat_map(|s| s.points.iter().copied()).collect();
            frontier_line(&points, &frame)
        } else {
            Vec::new()
        };
        let lines = traced.iter().flat_map(|t| &t.lines).chain([&frontier]);
        let obstacles = Obstacles {
            places: traced.iter().flat_map(|t| t.markers(1.0)).collect(),
            segments: lines.flat_map(|line| line.windows(2).map(|w| (w[0], w[1]))).collect(),
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

    pub(super) fn draw(&self, on: &mut Canvas, fineness: Fineness) {
        self.draw_grid(on);
        if self.frontier.len() > 1 {
            on.line(&self.frontier, FRONTIER, 1.3);
        }
        for series in &self.traced {
            series.draw(on, fineness);
        }
        labels::draw(&self.labels, on);
        self.draw_lettering(on);
    }

    fn draw_grid(&self, on: &mut Canvas) {
        let (area, frame) = (&self.frame.area, &self.frame);
        let vertical = |x: f64| [(x, area.top), (x, area.bottom())];
        let horizontal = |y: f64| [(area.left, y), (area.right(), y)];
        if self.shown.minor_grid {
            for x in frame.x.minor.iter().filter_map(|v| frame.x_at(*v)) {
                on.line(&vertical(x), Ink::Text(0.06), 0.6);
            }
            for y in frame.y.minor.iter().filter_map(|v| frame.y_at(*v)) {
                on.line(&horizontal(y), Ink::Text(0.06), 0.6);
            }
        }
        for (x, label) in ticks(&frame.x, |v| frame.x_at(v)) {
            on.line(&vertical(x), Ink::Text(0.14), 0.8);
            on.line(&[(x, area.bottom()), (x, area.bottom() + 4.0)], Ink::Text(0.8), 1.0);
            on.text(label, (x, area.bottom() + 13.0), Lettering::new(TICK, "middle"));
        }
        for (y, label) in ticks(&frame.y, |v| frame.y_at(v)) {
            on.line(&horizontal(y), Ink::Text(0.14), 0.8);
            on.line(&[(area.left - 4.0, y), (area.left, y)], Ink::Text(0.8), 1.0);
            on.text(label, (area.left - 7.0, y), Lettering::new(TICK, "end"));
        }
        let corner = (area.left, area.bottom());
        let axes = [(area.left, area.top), corner, (area.right(), area.bottom())];
        on.line(&axes, Ink::Text(0.8), 1.0);
    }

    fn draw_lettering(&self, on: &mut Canvas) {
        let area = &self.frame.area;
        let (plot, middle) = (self.plot, area.left + area.width / 2.0);
        if !plot.title.is_empty() {
            let title = lettering::fitted(&plot.title, TITLE * 1.06, area.width);
            let style = Lettering { bold: true, ..Lettering::new(TITLE, "start") };
            on.text(&title, (area.left, area.top - 15.0), style);
        }
        let style = Lettering::new(LABEL, "middle");
        if self.shown.x_label {
            let text = lettering::fitted(&plot.x.heading(), LABEL, area.width);
            on.text(&text, (middle, area.bottom() + 32.0), style);
        }
        if self.shown.y_label {
            let text = lettering::fitted(&plot.y.heading(), LABEL, area.height + 24.0);
            let x = area.left - 18.0 - label_width(&self.frame.y);
            let place = (x, area.top + area.height / 2.0);
            on.text(&text, place, Lettering { upwards: true, ..style });
        }
    }
}

/// Width of the widest label of an axis.
pub(super) fn label_width(axis: &Span) -> f64 {
    axis.ticks.iter().map(|t| lettering::width(&t.label, TICK)).fold(0.0, f64::max)
}

/// Places and labels of the ticks of an axis.
fn ticks(span: &Span, at: impl Fn(f64) -> Option<f64>) -> impl Iterator<Item = (f64, &str)> {
    span.ticks.iter().filter_map(move |t| Some((at(t.value)?, t.label.as_str())))
}
