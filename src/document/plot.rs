//! What a plot shows, as data; a report draws it.

use super::thin;
use serde::{Deserialize, Serialize, Serializer};

/// A plot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plot {
    /// Shown above it.
    pub title: String,
    /// Horizontal axis.
    pub x: PlotAxis,
    /// Vertical axis.
    pub y: PlotAxis,
    /// What is drawn; the order decides colours, and later series lie on top.
    pub series: Vec<Series>,
    /// Labels at points, moved aside so that they do not overlap.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub annotations: Vec<Annotation>,
    /// Whether to draw the frontier through the marked points that no other beats in both x and y
    /// (lower is better).
    pub frontier: bool,
}

impl Plot {
    /// An empty plot.
    pub fn new(title: impl Into<String>, x: PlotAxis, y: PlotAxis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            series: Vec::new(),
            annotations: Vec::new(),
            frontier: false,
        }
    }

    /// The plot with one more series.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// The plot with a marker and its label at every point, and the frontier of them drawn.
    #[must_use]
    pub fn with_labelled(mut self, name: &str, points: &[(&str, f64, f64)]) -> Self {
        self.series.push(Series::markers(name, points.iter().map(|(_, x, y)| (*x, *y))));
        for (text, x, y) in points {
            self = self.annotate(*x, *y, *text);
        }
        self.with_frontier()
    }

    /// The plot with one more label, at a point in the units of the axes.
    #[must_use]
    pub fn annotate(mut self, x: f64, y: f64, text: impl Into<String>) -> Self {
        self.annotations.push(Annotation { x, y, text: text.into() });
        self
    }

    /// The plot with the frontier of its marked points drawn.
    #[must_use]
    pub fn with_frontier(mut self) -> Self {
        self.frontier = true;
        self
    }
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotAxis {
    /// Quantity.
    pub label: String,
    /// Unit, `1` for a pure number.
    pub unit: String,
    /// How values are spaced.
    #[serde(default)]
    pub scale: Scale,
    /// First and last value; absent means as the data asks. One that cannot be drawn (reversed,
    /// not finite, not positive on a logarithmic axis) is ignored and the caption says so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
}

impl PlotAxis {
    fn with_scale(label: impl Into<String>, unit: impl Into<String>, scale: Scale) -> Self {
        Self { label: label.into(), unit: unit.into(), scale, range: None }
    }

    /// Evenly spaced values.
    pub fn linear(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self::with_scale(label, unit, Scale::Linear)
    }

    /// Evenly spaced ratios; what is not positive is left out and counted in the caption.
    pub fn log(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self::with_scale(label, unit, Scale::Log)
    }

    /// Both signs: linear below `linear_below` in magnitude, logarithmic above.
    pub fn symlog(label: impl Into<String>, unit: impl Into<String>, linear_below: f64) -> Self {
        Self::with_scale(label, unit, Scale::SymLog { linear_below })
    }

    /// The axis from `first` to `last`.
    #[must_use]
    pub fn range(mut self, first: f64, last: f64) -> Self {
        self.range = Some([first, last]);
        self
    }

    /// Label and unit, as in `error [1]`.
    #[must_use]
    pub fn heading(&self) -> String {
        format!("{} [{}]", self.label, self.unit)
    }
}

/// How the values of an axis are spaced.
#[derive(Debug, Default, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// By ratio.
    Log,
    /// By ratio above a magnitude, evenly below it: sign(v) log10(1 + |v| / linear_below).
    SymLog {
        /// The magnitude, positive and finite; otherwise nothing on this axis can be drawn.
        linear_below: f64,
    },
}

/// A named set of points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Series {
    /// Name, in the legend; series of the same name share their looks and their legend entry.
    /// An empty name has no legend entry.
    pub name: String,
    /// How it is drawn.
    pub style: SeriesStyle,
    /// How much it stands out.
    pub emphasis: Emphasis,
    /// x and y, in the units of the axes. A point that is not finite breaks a line. The JSON holds
    /// at most 256 of them, ends and extrema kept, and their `count`.
    #[serde(flatten, serialize_with = "thinned")]
    pub points: Vec<(f64, f64)>,
}

impl Series {
    fn with_style(
        name: impl Into<String>,
        style: SeriesStyle,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        Self {
            name: name.into(),
            style,
            emphasis: Emphasis::Normal,
            points: points.into_iter().collect(),
        }
    }

    /// A line through the points in their order, with the dashes of its place in the legend.
    pub fn line(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::with_style(name, SeriesStyle::Line, points)
    }

    /// A line that is dashed wherever it stands in the legend.
    pub fn dashed(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::with_style(name, SeriesStyle::Dashed, points)
    }

    /// Markers alone.
    pub fn markers(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::with_style(name, SeriesStyle::Markers, points)
    }

    /// The series, standing out.
    #[must_use]
    pub fn strong(mut self) -> Self {
        self.emphasis = Emphasis::Strong;
        self
    }
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SeriesStyle {
    /// A line.
    Line,
    /// A dashed line.
    Dashed,
    /// Markers.
    Markers,
}

/// How much a series stands out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Emphasis {
    /// As the others.
    Normal,
    /// More: the one that the figure is about.
    Strong,
}

/// A label at a point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Annotation {
    /// Where, in the unit of the x axis.
    pub x: f64,
    /// Where, in the unit of the y axis.
    pub y: f64,
    /// The label.
    pub text: String,
}

/// Points kept per series in the JSON.
const POINTS_IN_JSON: usize = 256;

fn thinned<S: Serializer>(points: &[(f64, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Columns {
        count: usize,
        x: Vec<Option<f64>>,
        y: Vec<Option<f64>>,
    }
    let finite = |v: f64| v.is_finite().then_some(v);
    let kept = thin::by_index(points, POINTS_IN_JSON);
    Columns {
        count: points.len(),
        x: kept.iter().map(|p| finite(p.0)).collect(),
        y: kept.iter().map(|p| finite(p.1)).collect(),
    }
    .serialize(serializer)
}
