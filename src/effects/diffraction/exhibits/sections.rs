use super::GREEN_NM;
use super::grating::{PAPER, disc, level};
use crate::document::plot::{Plot, PlotAxis, Series};
use crate::document::{Cell, Figure, PrintedTable, Section};
use crate::effect::ClaimError;
use crate::effects::diffraction::illuminant::IlluminantChoice;
use crate::effects::diffraction::preparation::{PreparedHeights, prepared};
use crate::effects::diffraction::surfaces::{Grating, Patch, Profile, grating, holographic_paper};
use crate::effects::diffraction::table::{Channels, NORMAL, TableShape, of_surface};
use crate::measured::spectra::Spectra;
use crate::table::Grid;

const SIZE: usize = 257;

/// Values of a channel along h_y = 0 that a logarithm shows: above a millionth of the largest.
fn section(grid: &Grid, channel: &str) -> Vec<(f64, f64)> {
    let middle = grid.y().count / 2;
    let values = (0..grid.x().count)
        .filter_map(|ix| Some((ix, f64::from(grid.at(channel, &[ix, middle])?))));
    let values: Vec<(usize, f64)> = values.collect();
    let largest = values.iter().fold(0.0_f64, |most, (_, v)| most.max(*v));
    let shown = values.into_iter().filter(|(_, v)| *v > 1e-6 * largest);
    shown.map(|(ix, v)| (grid.x().centre(ix), v)).collect()
}

fn shape(channels: Channels, wavelengths_nm: Vec<f64>) -> TableShape {
    TableShape { size: [SIZE, SIZE], extent: 1.0, wavelengths_nm, channels }
}

pub(super) fn exhibit() -> Result<Section, ClaimError> {
    let spectra = Spectra::built_in()?;
    let patch = Patch { samples: 256, side_um: 51.2, line: false };
    let blazed =
        Grating { period_um: 2.0, angle: 0.0, profile: Profile::Blazed { height_nm: 200.0 } };
    let surfaces: [(&str, PreparedHeights); 3] = [
        ("disc", disc()?),
        ("blazed", prepared(&grating(blazed, patch), level())?),
        ("holographic paper", prepared(&holographic_paper(PAPER, patch), level())?),
    ];
    let wavelengths: Vec<f64> = (0..=20).map(|i| 380.0 + 20.0 * f64::from(i)).collect();
    let rgb = shape(Channels::Rgb(IlluminantChoice::D65), wavelengths);
    let coloured = of_surface(&surfaces[0].1, &rgb, 1, NORMAL, &spectra)?;
    let axes = || (PlotAxis::linear("h along x", "1"), PlotAxis::log("S_d", "sr⁻¹"));
    let (x, y) = axes();
    let mut of_disc = Plot::new("Compact disc, h_y = 0", x, y);
    for channel in ["R", "G", "B"] {
        of_disc = of_disc.series(Series::line(channel, section(&coloured.grid, channel)));
    }
    let (x, y) = axes();
    let mut of_three = Plot::new("Three surfaces at 550 nm, h_y = 0", x, y);
    let mut rows = Vec::new();
    for (name, surface) in &surfaces {
        let green = shape(Channels::Spectral, vec![GREEN_NM]);
        let table = of_surface(surface, &green, 2, NORMAL, &spectra)?;
        of_three = of_three.series(Series::line(*name, section(&table.grid, "S_550")));
        let shares = [&table.total, &table.inside, &table.evanescent];
        let mut row = vec![Cell::text(*name)];
        row.extend(shares.map(|s| Cell::from(s.first().copied().unwrap_or(f64::NAN))));
        rows.push(row);
    }
    Ok(Section::new("Sections of tables")
        .paragraph(
            "Tables of simulated surfaces, 51.2 µm in 256² samples under a Hann window, 257² texels \
             over ±1. The disc's tracks lie along y, so its orders lie along x and its pits spread \
             them along y; the blazed grating sends most of the light to one side, h = −w slope.",
        )
        .block(Figure::new(
            "diffraction-section-disc",
            "Channels of linear sRGB under D65; where one is negative, outside the gamut, it is not \
             drawn.",
            of_disc,
        ))
        .block(Figure::new(
            "diffraction-section-surfaces",
            "One wavelength: orders where m λ/d puts them.",
            of_three,
        ))
        .block(PrintedTable::of_rows(
            "Shares of the reflected power at 550 nm",
            [
                ("surface", ""),
                ("sum over all frequencies", "1"),
                ("inside the table", "1"),
                ("beyond |h| = 1", "1"),
            ],
            rows,
        )))
}
