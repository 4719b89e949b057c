//! The layout of a figure: its plots in rows, its legend under them.

use std::fmt::Write as _;

use super::frame::Rect;
use super::ink::{dark_rules, resolve};
use super::legend::{Legend, Swatch};
use super::panel::{Axes, Margins, Panel, Shown};
use super::series::{Fineness, Look, Traced};
use super::surface::{Refused, Surface, UNITS, printable};
use crate::document::Figure;
use crate::document::plot::{Plot, Series};

/// Width of a figure, in pixels.
const WIDTH: f64 = 780.0;
/// Space between panels, and between the plots and the legend.
const GUTTER: f64 = 10.0;
/// Points of lines in one figure, so that its file stays below 150 kB.
const LINE_POINTS: usize = 5000;
/// Markers in one figure.
const MARKERS: usize = 400;

/// A figure, drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// An `svg` element to stand inside a page: it takes the colour of the text around it, and
    /// wants [`dark_rules`] from the page. Its identifiers begin with the figure's file stem.
    pub svg: String,
    /// What the caption must add: points that could not be drawn, and why.
    pub notes: Vec<String>,
    /// The plot areas, in pixels of the figure.
    pub plot_areas: Vec<Rect>,
    /// What the legend covers; absent if nothing has a name.
    pub legend: Option<Rect>,
    /// What the labels at points cover, plot by plot.
    pub labels: Vec<Vec<Rect>>,
}

impl Drawing {
    /// The drawing as a file of its own, with a ground and colours for light and dark.
    #[must_use]
    pub fn standalone(&self) -> String {
        let style = format!(
            "<style>svg{{background:#fff;color:#1b1f24}}\
             @media (prefers-color-scheme:dark){{svg{{background:#14171c;color:#e4e7eb}}\
             {}}}</style>\n",
            dark_rules()
        );
        match self.svg.split_once('\n') {
            Some((root, rest)) => format!("{root}\n{style}{rest}"),
            None => self.svg.clone(),
        }
    }
}

/// Draws a figure; what the drawing library refuses stands in the notes.
#[must_use]
pub fn draw(figure: &Figure) -> Drawing {
    let names = names(&figure.plots);
    let panels = panels(figure, &names);
    let bottom = panels.iter().map(|p| p.frame.area.bottom()).fold(0.0, f64::max);
    let below = if figure.plots.iter().all(|p| p.x.label.is_empty()) { 26.0 } else { 46.0 };
    let left = panels.first().map_or(0.0, |p| p.frame.area.left);
    let legend = Legend::new(entries(&figure.plots, &names), WIDTH - left - GUTTER);
    let top = bottom + below;
    let legend_area = legend.area(left, top);
    let height = legend_area.map_or(top, |area| area.bottom()) + GUTTER;

    let mut drawn = String::new();
    let mut notes: Vec<String> = Vec::new();
    for note in panels.iter().flat_map(Panel::notes) {
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
    let all = || panels.iter().flat_map(|p| &p.traced);
    let column = smallest(1.0, 1.4, |w| total(all(), |t| t.line_points(w)) <= LINE_POINTS);
    let cell = smallest(0.01, 1.4, |c| total(all(), |t| t.markers(c).len()) <= MARKERS);
    if cell > 0.5 {
        notes.push(format!("Of markers within {cell:.0} pixels of each other one is drawn."));
    }
    let marker = if figure.per_row > 2 { 0.7 } else { 1.0 };
    let fineness = Fineness { column, cell, marker };
    let painted = paint(&mut drawn, (WIDTH, height), &panels, &legend, (left, top), fineness);
    if let Err(Refused(reason)) = painted {
        notes.push(format!("Not drawn in full: {reason}."));
    }
    let area = |panel: &Panel<'_>| panel.labels.iter().map(|l| l.area).collect();
    Drawing {
        svg: wrapped(figure, &resolve(&drawn), height),
        notes,
        plot_areas: panels.iter().map(|p| p.frame.area).collect(),
        legend: legend_area,
        labels: panels.iter().map(area).collect(),
    }
}

fn total<'a>(series: impl Iterator<Item = &'a Traced>, count: impl Fn(&Traced) -> usize) -> usize {
    series.map(count).sum()
}

/// The smallest of a rising sequence of sizes that is large enough.
fn smallest(first: f64, factor: f64, enough: impl Fn(f64) -> bool) -> f64 {
    let mut size = first;
    while size < WIDTH && !enough(size) {
        size *= factor;
    }
    size
}

fn paint(
    buffer: &mut String,
    (width, height): (f64, f64),
    panels: &[Panel<'_>],
    legend: &Legend,
    (left, top): (f64, f64),
    fineness: Fineness,
) -> Result<(), Refused> {
    let surface = Surface::new(buffer, width, height);
    for panel in panels {
        panel.draw(&surface, fineness)?;
    }
    legend.draw(&surface, left, top)?;
    surface.finish()
}

/// The names of the series of a figure, in the order in which they appear.
fn names(plots: &[Plot]) -> Vec<&str> {
    let mut names = Vec::new();
    for series in plots.iter().flat_map(|p| &p.series) {
        if !names.contains(&series.name.as_str()) {
            names.push(series.name.as_str());
        }
    }
    names
}

fn look(series: &Series, names: &[&str]) -> Look {
    let index = names.iter().position(|n| *n == series.name).unwrap_or(0);
    Look { index, style: series.style, emphasis: series.emphasis }
}

/// The entries of the legend: every name once, as it looks where it first appears.
fn entries(plots: &[Plot], names: &[&str]) -> Vec<(Swatch, String)> {
    let mut entries: Vec<(Swatch, String)> = Vec::new();
    let mut add = |swatch, name: &str| {
        if !name.is_empty() && !entries.iter().any(|(_, n)| n == name) {
            entries.push((swatch, name.to_owned()));
        }
    };
    for series in plots.iter().flat_map(|p| &p.series) {
        add(Swatch::Series(look(series, names)), &series.name);
    }
    if plots.iter().any(|p| p.frontier) {
        add(Swatch::Frontier, "frontier: no point is lower in both");
    }
    entries
}

/// The plots in their places, row by row, their areas aligned.
fn panels<'a>(figure: &'a Figure, names: &[&str]) -> Vec<Panel<'a>> {
    let plots = &figure.plots;
    let columns = figure.per_row.clamp(1, 4).min(plots.len().max(1));
    let rows = plots.len().div_ceil(columns);
    let same = |of: fn(&Plot) -> String| {
        let first = plots.first().map(of);
        plots.iter().all(|p| Some(of(p)) == first)
    };
    let (same_x, same_y) = (same(|p| p.x.heading()), same(|p| p.y.heading()));
    let shown = |index: usize| Shown {
        // The last panel of every column has the label for all above it.
        x_label: !same_x || index + columns >= plots.len(),
        y_label: !same_y || index.is_multiple_of(columns),
        minor_grid: columns == 1,
    };
    let cell_width = (WIDTH - GUTTER) / as_f64(columns);
    let area_height = [330.0, 220.0, 170.0, 140.0].get(columns - 1).copied().unwrap_or(140.0);
    let rough = (cell_width - 90.0).max(60.0);
    let axes: Vec<_> = plots.iter().map(|p| Axes::new(p, rough, area_height)).collect();
    let widest = axes.iter().map(Axes::y_label_width).fold(0.0, f64::max);
    let titled = plots.iter().any(|p| !p.title.is_empty());
    let row_height = |row: usize| {
        let last = (row * columns..plots.len()).take(columns).any(|i| shown(i).x_label);
        let margins = Margins::new(widest, titled, Shown { x_label: last, ..shown(0) });
        margins.top + area_height + margins.bottom
    };
    let tops: Vec<f64> = (0..rows).map(|row| (0..row).map(row_height).sum()).collect();
    let place = |(index, (plot, axes)): (usize, (&'a Plot, Axes))| {
        // Every column keeps room for the label of the first, so that all areas are equally wide.
        let margins = Margins::new(widest, titled, Shown { y_label: !same_y, ..shown(index) });
        let lead = if same_y { 20.0 } else { 0.0 };
        let width = (WIDTH - GUTTER - lead) / as_f64(columns);
        let area = Rect {
            left: lead + as_f64(index % columns) * width + margins.left,
            top: tops.get(index / columns).copied().unwrap_or(0.0) + margins.top,
            width: width - margins.left - margins.right,
            height: area_height,
        };
        Panel::new(plot, axes, area, shown(index), |series| look(series, names))
    };
    plots.iter().zip(axes).enumerate().map(place).collect()
}

/// The root element: size, title and description, text defaults.
fn wrapped(figure: &Figure, body: &str, height: f64) -> String {
    let stem = &figure.file_stem;
    let titles: Vec<_> =
        figure.plots.iter().map(|p| p.title.as_str()).filter(|t| !t.is_empty()).collect();
    let title = if titles.is_empty() { stem.clone() } else { titles.join("; ") };
    let mut svg = String::with_capacity(body.len() + 600);
    // Writing to a String cannot fail.
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" width=\"{WIDTH:.0}\" \
         height=\"{height:.0}\" viewBox=\"0 0 {:.0} {:.0}\" role=\"img\" \
         aria-labelledby=\"{stem}-title {stem}-desc\" \
         font-family=\"Helvetica,Arial,sans-serif\" stroke-linejoin=\"round\">",
        WIDTH * UNITS,
        height * UNITS,
    );
    let _ = writeln!(svg, "<title id=\"{stem}-title\">{}</title>", escaped(&title));
    let caption = escaped(&figure.caption.to_plain());
    let _ = writeln!(svg, "<desc id=\"{stem}-desc\">{caption}</desc>");
    svg.push_str(body);
    svg.push_str("</svg>\n");
    svg
}

fn escaped(text: &str) -> String {
    printable(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn as_f64(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::from(u32::MAX), f64::from)
}
