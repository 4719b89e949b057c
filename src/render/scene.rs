//! What is rendered: one scratch, its lights, a view of its lobe, and the approximations to judge.
//!
//! # The file
//!
//! A scene is a TOML file. Keys that are not listed here are refused, and so are values out of
//! range, with the file and the key in the message.
//!
//! | key | unit | meaning |
//! |---|---|---|
//! | `description` | | one line, optional |
//! | `view.kind` | | `"equirectangular"`: x is the azimuth of the view direction in [0, 2π), y its polar angle in [0, π/2], taken at pixel centres (velinov2018 figs. 8 and 9) |
//! | `view.width`, `view.height` | pixels | at most [`MAX_PIXELS`] together |
//! | `view.exposure` | | what radiance is multiplied by in PNG files and for FLIP, 1 if left out |
//! | `scratch.width_um` | µm | W, in [0.001, 1e4] |
//! | `scratch.depth_um` | µm | D, in [0, 1e4] |
//! | `scratch.coherence_radius_um` | µm | σ, in [0.1, 1e5] |
//! | `scratch.direction_deg` | degrees | azimuth of the scratch, 0 if left out |
//! | `[[light]] kind` | | `"sphere"` with `centre` and `radius`, or `"polygon"` with `vertices`: plane, simple, either orientation, seen from both sides |
//! | `light.centre`, `light.vertices` | any | relative to the scratch, z along the normal of the surface; the unit is arbitrary, since only directions matter |
//! | `light.radiance` | relative | a number, or three (R, G, B) where the spectrum is `"rgb"`; 1 if left out |
//! | `spectrum.kind` | | `"rgb"`: one wavelength per channel, in `wavelengths_nm`, as renderers do; `"spectral"`: `samples` wavelengths evenly from `from_nm` to `to_nm`, light of the colour of D65, seen by the CIE 1931 observer, in linear sRGB |
//! | `reference.method` | | `"quadrature"` (semi-analytic, f64) or `"monte_carlo"` |
//! | `monte_carlo.samples` | per pixel and light | a multiple of [`SAMPLES_PER_PASS`], at least two passes; the section may be left out unless it is the reference |
//! | `monte_carlo.seed` | | of the counter-based random numbers, 1 if left out |
//! | `[[approximation]] name` | | names its files; letters, digits, `_` and `-`, none of [`FILES`] |
//! | `approximation.sphere`, `.polygon` | | the fit whose form shades lights of that kind; `form:effect/name` for a registered form, `FILE.wgsl#function` for one in a file of the project, with the constants of their text |
//! | `[budget.NAME]` | | `relative_rms`, `flip` or both: limits for the approximation called NAME |
//!
//! Polygons are cut into triangles, which is what the forms take.

use std::collections::BTreeMap;

use super::polygon::Polygon;

/// Most pixels of a view: what 24 bits of an f32 can count.
pub const MAX_PIXELS: usize = 1 << 24;

/// Samples of Monte Carlo per pixel and light that one pass takes. The standard error comes from
/// the spread of the passes.
pub const SAMPLES_PER_PASS: u32 = 64;

/// Name of the reference's image.
pub const REFERENCE: &str = "reference";
/// Name of the Monte Carlo image.
pub const MONTE_CARLO: &str = "monte_carlo";
/// Name of the contact sheet.
pub const SHEET: &str = "sheet";
/// Name of the file of figures.
pub const FIGURES: &str = "scene";
/// Names of files that are not approximations, which no approximation may have.
pub const FILES: [&str; 4] = [REFERENCE, MONTE_CARLO, SHEET, FIGURES];

/// A scene, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// File name without its extension.
    pub name: String,
    /// One line.
    pub description: String,
    /// Where it is looked at from.
    pub view: View,
    /// What is looked at.
    pub scratch: Scratch,
    /// What it is lit by; at least one.
    pub lights: Vec<Light>,
    /// Which wavelengths stand for all.
    pub spectrum: Spectrum,
    /// What approximations are compared with.
    pub reference: ReferenceMethod,
    /// Monte Carlo integration, if asked for.
    pub monte_carlo: Option<MonteCarlo>,
    /// What is compared.
    pub approximations: Vec<ApproximationChoice>,
    /// Limits by name of approximation.
    pub budget: BTreeMap<String, Budget>,
}

/// An equirectangular map of view directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Pixels across: azimuth.
    pub width: usize,
    /// Pixels down: polar angle.
    pub height: usize,
    /// Factor on radiance for what is displayed.
    pub exposure: f64,
}

/// A straight scratch of rectangular profile through the shaded point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scratch {
    /// W, µm.
    pub width_um: f64,
    /// D, µm.
    pub depth_um: f64,
    /// σ, µm.
    pub coherence_radius_um: f64,
    /// Azimuth, degrees.
    pub direction_deg: f64,
}

/// A light.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Its shape.
    pub shape: Shape,
    /// Its radiance in R, G, B.
    pub radiance: [f64; 3],
}

/// The shape of a light, relative to the shaded point, z along the normal.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A sphere.
    Sphere {
        /// Centre.
        centre: [f64; 3],
        /// Radius, less than the distance of the centre.
        radius: f64,
    },
    /// A plane simple polygon.
    Polygon(Polygon),
}

/// The wavelengths of a picture.
#[derive(Debug, Clone, PartialEq)]
pub enum Spectrum {
    /// One wavelength for each of R, G, B, nm.
    Rgb([f64; 3]),
    /// Evenly spaced wavelengths, nm, converted with the CIE 1931 functions.
    Spectral(Vec<f64>),
}

/// How the reference image is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ReferenceMethod {
    /// Semi-analytic, f64.
    Quadrature,
    /// Monte Carlo over the lights, with its standard error.
    MonteCarlo,
}

/// Monte Carlo integration over the lights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct MonteCarlo {
    /// Samples per pixel and light, a multiple of [`SAMPLES_PER_PASS`].
    pub samples: u32,
    /// Seed.
    pub seed: u64,
}

/// An approximation by the names of its forms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ApproximationChoice {
    /// Name in tables and files.
    pub name: String,
    /// Fit for spheres.
    pub sphere: Option<String>,
    /// Fit for polygons.
    pub polygon: Option<String>,
}

/// Limits on the error of an approximation.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// Limit of the relative RMS error.
    pub relative_rms: Option<f64>,
    /// Limit of the mean FLIP error.
    pub flip: Option<f64>,
}

impl Scene {
    /// Whether a light is a sphere.
    pub fn has_spheres(&self) -> bool {
        self.lights.iter().any(|light| matches!(light.shape, Shape::Sphere { .. }))
    }

    /// Whether a light is a polygon.
    pub fn has_polygons(&self) -> bool {
        self.lights.iter().any(|light| matches!(light.shape, Shape::Polygon(_)))
    }
}
