//! What an effect shows beyond its fits.

use crate::document::plot::{Axis, Plot, Series};
use crate::document::{Cell, Column, Figure, Section, Table};
use crate::effect::exhibit::{
    Exhibit, ExhibitAxis, ExhibitCell, ExhibitPlot, ExhibitSeries, ExhibitTable, Stroke,
};

pub(super) fn section(exhibit: &Exhibit) -> Section {
    let mut section = Section::new(exhibit.title.as_str());
    for paragraph in &exhibit.text {
        section = section.paragraph(paragraph.as_str());
    }
    for plot in &exhibit.plots {
        section = section.block(figure(plot));
    }
    exhibit.tables.iter().fold(section, |section, shown| section.block(table(shown)))
}

fn figure(shown: &ExhibitPlot) -> Figure {
    let plot = Plot::new(shown.title.as_str(), axis(shown.x), axis(shown.y));
    let plot = shown.series.iter().fold(plot, |plot, curve| plot.series(series(curve)));
    Figure::new(shown.stem, shown.caption.as_str(), plot)
}

fn axis(axis: ExhibitAxis) -> Axis {
    match axis.log {
        true => Axis::log(axis.label, axis.unit),
        false => Axis::linear(axis.label, axis.unit),
    }
}

fn series(curve: &ExhibitSeries) -> Series {
    let points = curve.points.iter().copied();
    let name = curve.name.as_str();
    match curve.stroke {
        Stroke::Line => Series::line(name, points),
        Stroke::Strong => Series::line(name, points).strong(),
        Stroke::Dashed => Series::dashed(name, points),
        Stroke::Markers => Series::markers(name, points),
    }
}

fn table(shown: &ExhibitTable) -> Table {
    let columns = shown.columns.iter().map(|(title, unit)| match *unit {
        "" => Column::text(title.as_str()),
        unit => Column::number(title.as_str(), unit),
    });
    let mut table = Table::new(shown.caption.as_str(), columns.collect());
    for row in &shown.rows {
        let cell = |cell: &ExhibitCell| match cell {
            ExhibitCell::Text(words) => Cell::text(words.as_str()),
            ExhibitCell::Number(value) => Cell::number(*value, 3),
        };
        table.push(row.iter().map(cell).collect());
    }
    table
}
