use super::{GREEN_NM, TEXTS, line};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::{ClaimError, Exhibit};
use crate::effects::diffraction::DiffractionError;
use crate::effects::diffraction::illuminant::IlluminantChoice;
use crate::effects::diffraction::surfaces::Profile;
use crate::effects::diffraction::table::{
    Channels, NORMAL, PatternPlacing, TableShape, of_pattern, of_surface,
};
use crate::measured::pattern::Pattern;
use crate::measured::spectra::Spectra;
use crate::numeric::statistics::relative_l2;
use crate::table::Grid;

/// Period of the grating: that of a disc.
const PERIOD_UM: f64 = 1.6;
/// Texels of a section.
const SIZE: usize = 201;
/// |h| up to which the pattern at one wavelength is known: 1 at the shortest wavelength.
const KNOWN: f64 = 1.5;
/// Below, the mirror direction, which no rule changes in place: half of the first order in the violet.
const MIRROR: f64 = 0.12;

/// Relative L2 errors in R, G and B, away from the mirror direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::effects::diffraction) struct Rules {
    /// S_λ = (λ₀/λ)² S_λ₀(h λ₀/λ), as printed.
    pub(in crate::effects::diffraction) square: [f64; 3],
    /// (λ₀/λ)⁴.
    pub(in crate::effects::diffraction) fourth: [f64; 3],
}

/// What a table made from one wavelength, 550 nm, errs by for a rectangular grating of `depth_nm`.
pub(in crate::effects::diffraction) fn rule_errors(
    depth_nm: f64,
    spectra: &Spectra,
) -> Result<Rules, DiffractionError> {
    let surface = line(PERIOD_UM, Profile::Rectangle { depth_nm, duty: 0.5 })?;
    let wavelengths_nm: Vec<f64> = (0..=40).map(|i| 380.0 + 10.0 * f64::from(i)).collect();
    let shape = TableShape {
        size: [SIZE, 1],
        extent: 1.0,
        wavelengths_nm,
        channels: Channels::Rgb(IlluminantChoice::D65),
    };
    let exact = of_surface(&surface, &shape, 1, NORMAL, spectra)?.grid;
    let known = TableShape::at(GREEN_NM, [4001, 1], KNOWN);
    let known = of_surface(&surface, &known, 1, NORMAL, spectra)?;
    let inside = known.shares.first().map_or(f64::NAN, |share| share.inside);
    let intensity: Vec<f64> =
        known.grid.channels.iter().flat_map(|c| c.values.iter().map(|v| f64::from(*v))).collect();
    let pattern = Pattern { width: 4001, height: 1, intensity, origin: surface.origin.clone() };
    let errors = |exponent: f64| -> Result<[f64; 3], DiffractionError> {
        let placing = PatternPlacing {
            wavelength_nm: GREEN_NM,
            half_extent: KNOWN,
            centre: [0.5 * 4001.0, 0.5],
            exponent,
        };
        let made = of_pattern(&pattern, placing, &shape, spectra)?.grid;
        Ok(["R", "G", "B"].map(|channel| {
            // A pattern counts its total as all power.
            let (made, exact) = (away(&made, channel), away(&exact, channel));
            relative_l2(made.map(|v| inside * v).zip(exact))
        }))
    };
    Ok(Rules { square: errors(2.0)?, fourth: errors(4.0)? })
}

/// Values of a channel away from the mirror direction.
fn away<'a>(grid: &'a Grid, channel: &str) -> impl Iterator<Item = f64> + 'a {
    let values = grid.channel(channel).map_or(&[][..], |c| c.values.as_slice());
    let texels = values.iter().enumerate().filter(|(i, _)| grid.x().centre(*i).abs() > MIRROR);
    texels.map(|(_, v)| f64::from(*v))
}

pub(super) fn exhibit() -> Result<Section, ClaimError> {
    let spectra = Spectra::built_in()?;
    let depths: Vec<f64> = (1..=17).map(|i| 10.0 * f64::from(i)).collect();
    let rules: Vec<Rules> =
        depths.iter().map(|d| rule_errors(*d, &spectra)).collect::<Result<_, _>>()?;
    let mut curves = Vec::new();
    for (name, channel) in [("R", 0), ("G", 1), ("B", 2)] {
        let over = |of: fn(&Rules) -> [f64; 3]| {
            depths.iter().zip(&rules).map(move |(depth, rules)| (*depth, of(rules)[channel]))
        };
        curves.push(Series::line(format!("λ⁻², {name}"), over(|rules| rules.square)));
        curves.push(Series::dashed(format!("λ⁻⁴, {name}"), over(|rules| rules.fourth)));
    }
    let shown = depths.iter().zip(&rules).filter(|(d, _)| [20.0, 60.0, 120.0, 150.0].contains(d));
    let rows = shown.map(|(depth, rules)| {
        let errors = rules.square.into_iter().chain(rules.fourth);
        [*depth].into_iter().chain(errors).map(Cell::from).collect()
    });
    Ok(Exhibit::of(TEXTS, "wavelengths", &[]).figure(curves).table(rows).section())
}
