use super::{GREEN_NM, PAPER, TEXTS, disc, level};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::{ClaimError, Exhibit};
use crate::effects::diffraction::illuminant::IlluminantChoice;
use crate::effects::diffraction::preparation::{PreparedHeights, prepared};
use crate::effects::diffraction::surfaces::{Grating, Patch, Profile, grating, holographic_paper};
use crate::effects::diffraction::table::{Channels, NORMAL, PowerShares, TableShape, of_surface};
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
    let green = TableShape::at(GREEN_NM, [SIZE, SIZE], 1.0);
    let rgb = TableShape {
        wavelengths_nm: wavelengths,
        channels: Channels::Rgb(IlluminantChoice::D65),
        ..green.clone()
    };
    let coloured = of_surface(&surfaces[0].1, &rgb, 1, NORMAL, &spectra)?;
    let of_disc = ["R", "G", "B"].map(|name| Series::line(name, section(&coloured.grid, name)));
    let mut of_three = Vec::new();
    let mut rows = Vec::new();
    for (name, surface) in &surfaces {
        let table = of_surface(surface, &green, 2, NORMAL, &spectra)?;
        of_three.push(Series::line(*name, section(&table.grid, "S_550")));
        let of_share = |share: &PowerShares| [share.total, share.inside, share.evanescent];
        let mut row = vec![Cell::text(*name)];
        row.extend(table.shares.first().map_or([f64::NAN; 3], of_share).map(Cell::from));
        rows.push(row);
    }
    let exhibit = Exhibit::of(TEXTS, "sections", &[]).figure(of_disc).figure(of_three);
    Ok(exhibit.table(rows).section())
}
