//! Diffraction tables from settings: what `striae simulate diffraction` and renderers ask for.

use super::growth::OrderGrowth;
use super::illuminant::IlluminantChoice;
use super::preparation::{Detrend, Missing, Preparation, PreparedHeights, Window, prepared};
use super::surfaces::{
    CompactDisc, Grating, HolographicPaper, Patch, PixelLattice, Profile, compact_disc, grating,
    holographic_paper, pixel_lattice,
};
use super::table::{
    Channels, DiffractionTable, PatternPlacing, TableShape, of_pattern, of_surface,
};
use super::{DiffractionError, EFFECT, simulation};
use crate::effect::simulator::{Settings, SettingsError, Simulation, SimulationError};
use crate::measured::height_map::HeightMap;
use crate::measured::pattern::{Encoding, Pattern};
use crate::measured::spectra::Spectra;
use crate::table::Grid;

/// Settings of the simulator from `key=value` texts.
///
/// # Errors
/// As [`Settings::parse`].
pub fn settings<S: AsRef<str>>(assignments: &[S]) -> Result<Settings, SettingsError> {
    let parameters = EFFECT.simulators.first().map_or(&[][..], |simulator| simulator.parameters);
    Settings::parse(parameters, assignments)
}

/// The diffraction table that the settings describe, in sr⁻¹ over h_x and h_y, and what its orders are
/// at another w.
///
/// # Errors
/// [`DiffractionError`] for settings outside their domain and files that cannot be used.
pub fn simulated_table(
    settings: &Settings,
    spectra: &Spectra,
) -> Result<(Grid, OrderGrowth), DiffractionError> {
    let DiffractionTable { grid, growth, .. } = table(settings, spectra)?.0;
    Ok((grid, growth))
}

pub(super) fn run(settings: &Settings, spectra: &Spectra) -> Result<Simulation, SimulationError> {
    let described = || -> Result<Simulation, DiffractionError> {
        let (table, source) = table(settings, spectra)?;
        simulation::described(settings, table, source)
    };
    described().map_err(|error| SimulationError(error.to_string()))
}

/// What a table is made of.
pub(super) enum Origin {
    /// Heights, as read or simulated.
    Heights(HeightMap, PreparedHeights),
    /// A pattern.
    Pattern(PatternPlacing),
}

fn table(
    settings: &Settings,
    spectra: &Spectra,
) -> Result<(DiffractionTable, Origin), DiffractionError> {
    let shape = shape(settings)?;
    if let Some((pattern, placing)) = pattern(settings)? {
        let table = of_pattern(&pattern, placing, &shape, spectra)?;
        return Ok((table, Origin::Pattern(placing)));
    }
    let heights = heights(settings)?;
    let surface = prepared(&heights, preparation(settings)?)?;
    let table = of_surface(&surface, &shape, padding(settings)?, w(settings)?, spectra)?;
    Ok((table, Origin::Heights(heights, surface)))
}

pub(super) fn padding(settings: &Settings) -> Result<usize, SettingsError> {
    settings.count("padding", 1, 8)
}

pub(super) fn w(settings: &Settings) -> Result<f64, SettingsError> {
    settings.number("w", 1e-3, 2.0)
}

/// How heights are prepared.
pub(super) fn preparation(settings: &Settings) -> Result<Preparation, SettingsError> {
    let windows = [("hann", Window::Hann), ("tukey", Window::Tukey), ("none", Window::Rectangle)];
    let trends =
        [("plane", Detrend::Plane), ("piston", Detrend::Piston), ("none", Detrend::Nothing)];
    Ok(Preparation {
        window: settings.choice("window", &windows)?,
        detrend: settings.choice("detrend", &trends)?,
        missing: settings.choice("missing", &[("fill", Missing::Fill), ("mask", Missing::Mask)])?,
    })
}

/// Extent and channels of the table.
pub(super) fn shape(settings: &Settings) -> Result<TableShape, DiffractionError> {
    let size = settings.count("size", 1, 2048)?;
    let from_file = settings.given("heightmap").or(settings.given("pattern")).is_some();
    let screen = !from_file && settings.text("surface").is_ok_and(is_screen);
    let extent = number_or(settings, "extent", 1e-3, 2.0, if screen { 0.15 } else { 1.0 })?;
    let rgb = settings.choice("channels", &[("rgb", true), ("spectral", false)])?;
    let channels = if rgb {
        Channels::Rgb(IlluminantChoice::named(settings.text("illuminant")?)?)
    } else {
        Channels::Spectral
    };
    Ok(TableShape { size: [size, size], extent, wavelengths_nm: wavelengths(settings)?, channels })
}

fn wavelengths(settings: &Settings) -> Result<Vec<f64>, SettingsError> {
    let key = "wavelengths_nm";
    let text = settings.text(key)?;
    let refused = || {
        settings
            .refused(key, "from:to:step or a list with commas, increasing, 1 to 1e5, 1000 at most")
    };
    let numbers = |separator: char| -> Option<Vec<f64>> {
        let number = |part: &str| part.trim().parse::<f64>().ok();
        text.split(separator).map(|part| number(part).filter(|v| (1.0..=1e5).contains(v))).collect()
    };
    let list = if text.contains(':') {
        match numbers(':').ok_or_else(refused)?.as_slice() {
            [from, to, step] if from <= to && (to - from) / step < 1000.0 => {
                let count = ((to - from) / step + 1e-9).floor() as usize;
                (0..=count).map(|i| from + i as f64 * step).collect()
            }
            _ => return Err(refused()),
        }
    } else {
        numbers(',').ok_or_else(refused)?
    };
    if list.len() > 1000 || !list.is_sorted_by(|a, b| a < b) {
        return Err(refused());
    }
    Ok(list)
}

/// A number, or what depends on the surface where it is not given.
fn number_or(
    settings: &Settings,
    key: &str,
    lowest: f64,
    highest: f64,
    default: f64,
) -> Result<f64, SettingsError> {
    settings.given(key).map_or(Ok(default), |_| settings.number(key, lowest, highest))
}

fn pattern(settings: &Settings) -> Result<Option<(Pattern, PatternPlacing)>, DiffractionError> {
    let Some(file) = settings.given("pattern") else { return Ok(None) };
    alone(settings, "pattern", "surface")?;
    alone(settings, "pattern", "heightmap")?;
    let encodings = [("srgb", Encoding::Srgb), ("linear", Encoding::Linear)];
    let encoding = settings.choice("pattern_encoding", &encodings)?;
    let pattern = Pattern::read(file, settings.given("pattern_channel"), encoding)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    let point = |text: &str| {
        let (x, y) = text.split_once(',')?;
        Some([number(x)?, number(y)?])
    };
    let centre = match settings.given("pattern_centre_px").map(point) {
        Some(given) => given.ok_or_else(|| settings.refused("pattern_centre_px", "x,y"))?,
        None => [0.5 * pattern.width as f64, 0.5 * pattern.height as f64],
    };
    let placing = PatternPlacing {
        wavelength_nm: settings.number("wavelength_nm", 1.0, 1e5)?,
        half_extent: settings.number("pattern_extent", 1e-3, 2.0)?,
        centre,
        exponent: settings.number("exponent", 0.0, 8.0)?,
    };
    Ok(Some((pattern, placing)))
}

fn heights(settings: &Settings) -> Result<HeightMap, DiffractionError> {
    let Some(file) = settings.given("heightmap") else { return Ok(simulated_heights(settings)?) };
    alone(settings, "heightmap", "surface")?;
    Ok(HeightMap::read(file)?)
}

/// Refuses `other` beside `key`.
fn alone(settings: &Settings, key: &str, other: &str) -> Result<(), SettingsError> {
    let fault = format!(": a table is made from a {key} or from a {other}, not from both");
    settings.given(other).map_or(Ok(()), |_| Err(SettingsError::new(key, fault)))
}

/// Surfaces that can be simulated.
const SURFACES: [&str; 7] =
    ["compact_disc", "sinusoid", "rectangle", "blazed", "display", "phone", "holographic_paper"];

/// Whether a surface is that of a screen.
fn is_screen(surface: &str) -> bool {
    matches!(surface, "display" | "phone")
}

/// Heights of the simulated surface that the settings describe.
///
/// # Errors
/// [`SettingsError`] for a setting outside its domain.
pub fn simulated_heights(settings: &Settings) -> Result<HeightMap, SettingsError> {
    let surface = settings.choice("surface", &SURFACES.map(|name| (name, name)))?;
    let screen = is_screen(surface);
    let patch = Patch {
        samples: settings.count("samples", 16, 4096)?,
        side_um: number_or(settings, "side_um", 1e-2, 1e6, if screen { 409.6 } else { 51.2 })?,
        line: false,
    };
    let length = |key: &str, default: f64| number_or(settings, key, 1e-3, 1e6, default);
    let height = |key: &str, default: f64| number_or(settings, key, 0.0, 1e6, default);
    let angle = |key: &str, default: f64| {
        number_or(settings, key, -360.0, 360.0, default).map(f64::to_radians)
    };
    let seed = settings.count("seed", 0, usize::MAX)? as u64;
    let of_grating = |profile| -> Result<HeightMap, SettingsError> {
        let period_um = length("pitch_um", 2.0)?;
        Ok(grating(Grating { period_um, angle: angle("angle_deg", 0.0)?, profile }, patch))
    };
    let of_pixels = |pixel, turn, lean| -> Result<HeightMap, SettingsError> {
        let lattice = PixelLattice {
            pixel_um: length("pitch_um", pixel)?,
            matrix_share: settings.number("matrix_share", 0.0, 0.9)?,
            depth_nm: height("depth_nm", 100.0)?,
            angle: angle("angle_deg", turn)?,
            skew: number_or(settings, "skew_deg", -60.0, 60.0, lean)?.to_radians(),
        };
        Ok(pixel_lattice(lattice, patch))
    };
    match surface {
        "compact_disc" => {
            let disc = CompactDisc {
                pitch_um: length("pitch_um", 1.6)?,
                pit_width_um: settings.number("pit_width_um", 1e-3, 1e6)?,
                depth_nm: height("depth_nm", 120.0)?,
                bit_um: settings.number("bit_um", 1e-2, 1e6)?,
                seed,
            };
            Ok(compact_disc(disc, patch))
        }
        "sinusoid" => of_grating(Profile::Sinusoid { amplitude_nm: height("amplitude_nm", 30.0)? }),
        "rectangle" => of_grating(Profile::Rectangle {
            depth_nm: height("depth_nm", 120.0)?,
            duty: settings.number("duty", 0.0, 1.0)?,
        }),
        "blazed" => of_grating(Profile::Blazed { height_nm: height("depth_nm", 200.0)? }),
        "display" => of_pixels(50.0, 20.0, 0.0),
        "phone" => of_pixels(40.0, 35.0, 12.0),
        // Holographic paper.
        _ => {
            let paper = HolographicPaper {
                cell_um: settings.number("cell_um", 0.5, 1e6)?,
                pitch_um: [length("pitch_um", 1.0)?, settings.number("pitch_max_um", 1e-3, 1e6)?],
                amplitude_nm: height("amplitude_nm", 60.0)?,
                spread: settings.number("spread_deg", 0.0, 90.0)?.to_radians(),
                seed,
            };
            Ok(holographic_paper(paper, patch))
        }
    }
}
