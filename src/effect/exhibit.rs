//! What an effect shows beyond its fits: tables and curves of its own, as plain data that a report
//! lays out. Every number is measured when the exhibit is made.

use serde::Serialize;

/// A study of an effect that is no error of one fit: a figure of a paper, energies, errors against a
/// parameter of the scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Exhibit {
    /// Heading.
    pub title: String,
    /// Paragraphs: what is shown, how it was measured, and what it says.
    pub text: Vec<String>,
    /// Curves.
    pub plots: Vec<ExhibitPlot>,
    /// Tables.
    pub tables: Vec<ExhibitTable>,
}

/// Curves over one pair of axes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExhibitPlot {
    /// Stem of the file, unique in the report: `footprint-response`.
    pub stem: &'static str,
    /// Title above the curves.
    pub title: String,
    /// Caption: what the curves are.
    pub caption: String,
    /// The horizontal axis.
    pub x: ExhibitAxis,
    /// The vertical axis.
    pub y: ExhibitAxis,
    /// The curves.
    pub series: Vec<ExhibitSeries>,
}

/// An axis with its unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ExhibitAxis {
    /// What is drawn along it.
    pub label: &'static str,
    /// Its unit; `1` for a pure number.
    pub unit: &'static str,
    /// Logarithmic.
    pub log: bool,
}

/// A curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExhibitSeries {
    /// Name in the legend.
    pub name: String,
    /// Points in increasing order of x.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub stroke: Stroke,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stroke {
    /// A line.
    Line,
    /// A heavier line: what the others are held against.
    Strong,
    /// A dashed line.
    Dashed,
    /// Points without a line.
    Markers,
}

/// A table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExhibitTable {
    /// Caption: what the rows are.
    pub caption: String,
    /// Title and unit per column; an empty unit marks a column of words.
    pub columns: Vec<(String, &'static str)>,
    /// The rows.
    pub rows: Vec<Vec<ExhibitCell>>,
}

/// An entry of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ExhibitCell {
    /// Words; code between backticks.
    Text(String),
    /// A number, shown with three significant digits.
    Number(f64),
}

/// Why an exhibit could not be made.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ExhibitError(pub String);
