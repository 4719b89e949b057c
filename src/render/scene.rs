//! Scenes: what is looked at, under what, how it is shaded, and what is compared.
//!
//! # The file
//!
//! A scene is a TOML file. Keys that are not listed here are refused, and so are values out of range
//! and sections that mean nothing for the material, with the file, the line and the key in the message.
//!
//! | key | unit | meaning |
//! |---|---|---|
//! | `description` | | one line, optional |
//! | `view.kind` | | `"equirectangular"`: x is the azimuth of the direction of view in [0, 2π), y its polar angle in [0, π/2], taken at pixel centres (velinov2018 figs. 8 and 9); `"camera"` |
//! | `view.width`, `view.height` | pixels | of each frame, at most [`MAX_PIXELS`] together |
//! | `view.exposure` | | what radiance is multiplied by in PNG files and for FLIP, 1 if left out |
//! | `view.position`, `view.target` | any | of a camera, and what is in the middle; +z is up |
//! | `view.field_of_view_deg` | degrees | of a camera, between the left and the right edge |
//! | `geometry.shape` | | `"point"` with `direction_deg` (azimuth of the scratch, 0 if left out), `"rectangle"` with `half_size`, `"disc"` with `radii` (hole, rim; circular tracks), `"sphere"` with `radius` (tangents run east about the second tangent) |
//! | `geometry.centre`, `.normal`, `.tangent` | any | of a shape; the tangent is made perpendicular to the normal |
//! | `material.kind` | | `"scratch"`, at a point under spheres and polygons, or `"diffraction"`, on a shape before a camera under environments |
//! | `material.width_um` | µm | W of a scratch, in [0.001, 1e4] |
//! | `material.depth_um` | µm | D, in [0, 1e4] |
//! | `material.coherence_radius_um` | µm | σ, in [0.1, 1e5] |
//! | `material.reflectance` | | F₀² of a diffractive surface, three numbers R, G, B in [0, 1], 1 if left out |
//! | `[material.table]` | | of a diffractive surface: `file = "FILE.exr"` with axes h_x, h_y and channels R, G, B, or the settings of `striae simulate diffraction`, which makes it |
//! | `[[light]] kind` | | `"sphere"` with `centre` and `radius`, `"polygon"` with `vertices`: plane, simple, either orientation, seen from both sides; `"environment"` with `map`: each lights a frame of its own |
//! | `light.centre`, `light.vertices` | any | relative to the point, z along its normal; the unit is arbitrary, since only directions matter |
//! | `light.map` | | a map of `data/measured/environments` by name, or a file `.exr` or `.hdr` |
//! | `light.turn_deg` | degrees | the shape turned about its normal under an environment |
//! | `light.radiance` | relative | a number, or three (R, G, B) where colours are; factor on the map of an environment; 1 if left out |
//! | `spectrum.kind` | | of a scratch: `"rgb"`: one wavelength per channel, in `wavelengths_nm`, as renderers do; `"spectral"`: `samples` wavelengths evenly from `from_nm` to `to_nm`, light of the colour of D65, seen by the CIE 1931 observer, in linear sRGB |
//! | `convolution.map_width` | texels | of the environments as they are convolved with a diffractive surface |
//! | `convolution.align` | | whether the table is straightened along its main directions first |
//! | `convolution.straighten` | | `"lookup"`: the map is turned into the frame of the surface and looked up there; `"back"`: it is turned back (toisoul2017 §5.2, four passes); `"none"`: two passes in the frame of the world |
//! | `reference.method` | | of a scratch `"quadrature"` (semi-analytic, f64); of a diffractive surface `"full"`: the convolution with the whole table under n = ω_o = r_v, or `"integral"`: the sum over the table at every pixel; of either `"monte_carlo"` |
//! | `monte_carlo.samples` | per pixel (and light) | a multiple of [`SAMPLES_PER_PASS`], at least two passes; the section may be left out unless it is the reference, and is refused beside `"full"`, which it does not estimate |
//! | `monte_carlo.seed` | | of the counter-based random numbers, 1 if left out |
//! | `[[approximation]] name` | | names its files; letters, digits, `_` and `-`, none of [`FILES`] |
//! | `approximation.sphere`, `.polygon` | | of a scratch: the candidate that shades lights of that kind, by any of its names: `effect/name`, `form:effect/name`, `FILE.wgsl#function` |
//! | `approximation.method` | | of a diffractive surface: `"two_pass"`, `"printed"` (alg. 1 read literally), `"sum"` (two directional blurs), `"line"` (1D along the first direction) or `"reconstructed"` (that sum with the table that the factors give) |
//! | `approximation.rank` | | of `two_pass`, `printed` and `reconstructed`, 1 if left out |
//! | `approximation.factors` | | `"svd"`, or `"convolution"`: of least error after convolution with environments |
//! | `approximation.fitted_to` | | of factors `"convolution"`: the maps, as of `light.map`; those of the lights if left out |
//! | `[budget.NAME]` | | `relative_rms`, `flip` or both: limits for the approximation called NAME |
//! | `[choice]` | | `relative_rms`, `flip` or both: the cheapest approximation within them is picked and said |
//! | `[[claim]] check` | | what a paper prints and this scene shows: one of [`super::claims::CHECKS`] |
//! | `claim.place`, `.printed` | | where and what, in place of what the check says itself |
//! | `claim.KEY` | | the approximations that the check looks at, under the keys that it names |
//!
//! Polygons are cut into triangles, which is what the forms take.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::geometry::Geometry;
use super::polygon::Polygon;
use super::view::View;

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
    /// The file, for messages.
    pub origin: String,
    /// One line.
    pub description: String,
    /// Where it is looked at from.
    pub view: View,
    /// What is looked at.
    pub geometry: Geometry,
    /// What it is made of.
    pub material: Material,
    /// What it is lit by; at least one.
    pub lights: Vec<Light>,
    /// How the reference image is made.
    pub reference: ReferenceMethod,
    /// Monte Carlo integration, if asked for.
    pub monte_carlo: Option<MonteCarlo>,
    /// What is compared.
    pub approximations: Vec<Approximation>,
    /// Limits by name of approximation.
    pub budget: BTreeMap<String, Budget>,
    /// Limits within which the cheapest approximation is picked.
    pub choice: Option<Budget>,
    /// What papers print of it.
    pub claims: Vec<SceneClaim>,
}

/// What scatters light.
#[derive(Debug, Clone, PartialEq)]
pub enum Material {
    /// A scratch, in some wavelengths.
    Scratch(Scratch, Spectrum),
    /// A surface with a diffraction table, convolved with environments.
    Diffraction(Diffraction, Convolution),
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
}

/// The wavelengths of a picture.
#[derive(Debug, Clone, PartialEq)]
pub enum Spectrum {
    /// One wavelength for each of R, G, B, nm.
    Rgb([f64; 3]),
    /// Evenly spaced wavelengths, nm, converted with the CIE 1931 functions.
    Spectral(Vec<f64>),
}

/// A surface with a diffraction table.
#[derive(Debug, Clone, PartialEq)]
pub struct Diffraction {
    /// F₀² of R, G, B.
    pub reflectance: [f64; 3],
    /// Where the table comes from.
    pub table: TableSource,
}

/// Where a diffraction table comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum TableSource {
    /// An EXR file with its axes.
    File(PathBuf),
    /// Settings of the simulator, `key=value` each.
    Simulated(Vec<String>),
}

/// How environments are convolved with a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convolution {
    /// Texels around.
    pub map_width: usize,
    /// Whether the table is straightened first.
    pub align: bool,
    /// In which frame.
    pub straighten: Straighten,
}

/// The frame in which a map is convolved (toisoul2017 §5.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Straighten {
    /// Turned into the frame of the surface, looked up there: three passes.
    Lookup,
    /// Turned back after the convolution: four passes, as printed.
    Back,
    /// In the frame of the world: two passes, bent about the poles.
    None,
}

/// A light.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// What shines.
    pub shape: LightShape,
    /// Its radiance in R, G, B; of an environment the factor on its map.
    pub radiance: [f64; 3],
}

/// What shines.
#[derive(Debug, Clone, PartialEq)]
pub enum LightShape {
    /// A sphere, relative to the shaded point, z along the normal.
    Sphere {
        /// Centre.
        centre: [f64; 3],
        /// Radius, less than the distance of the centre.
        radius: f64,
    },
    /// A plane simple polygon, relative to the shaded point.
    Polygon(Polygon),
    /// A map around a shape, which lights a frame of its own.
    Environment {
        /// Name of a map of the project, or a file.
        map: String,
        /// Turn of the shape about its normal, rad.
        turn_rad: f64,
    },
}

/// How the reference image is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ReferenceMethod {
    /// Semi-analytic, f64.
    Quadrature,
    /// The convolution with the whole table.
    Full,
    /// Eq. 3 of toisoul2017 at every pixel, f64.
    Integral,
    /// Monte Carlo, with its standard error.
    MonteCarlo,
}

/// Monte Carlo integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct MonteCarlo {
    /// Samples per pixel (and light), a multiple of [`SAMPLES_PER_PASS`].
    pub samples: u32,
    /// Seed.
    pub seed: u64,
}

/// An approximation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Approximation {
    /// Name in tables and files.
    pub name: String,
    /// How it shades.
    pub method: Method,
}

/// How an approximation shades.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Forms, by the names of their candidates.
    Forms {
        /// For spheres.
        sphere: Option<String>,
        /// For polygons.
        polygon: Option<String>,
    },
    /// A horizontal and a vertical pass over a map per term.
    TwoPass {
        /// Terms.
        rank: usize,
        /// Of which factorisation.
        factors: Factors,
    },
    /// The sums over terms taken in each pass, as alg. 1 of toisoul2017 is printed.
    Printed {
        /// Terms.
        rank: usize,
    },
    /// Two directional blurs, added.
    Sum,
    /// One blur along the first direction of each point.
    Line,
    /// Eq. 3 with the product of the factors in place of the table.
    Reconstructed {
        /// Terms.
        rank: usize,
    },
}

/// Which factors of a table.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Factors {
    /// Of the singular value decomposition.
    Svd,
    /// Of least error after convolution with these environments; with those that light the scene, if there
    /// are none.
    Convolution(Vec<String>),
}

/// Limits on the error of an approximation.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct Budget {
    /// Limit of the relative RMS error.
    pub relative_rms: Option<f64>,
    /// Limit of the mean FLIP error.
    pub flip: Option<f64>,
}

/// A claim of a paper that a scene shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SceneClaim {
    /// Name of the check.
    pub check: &'static str,
    /// Where it is printed, if the check does not say it.
    pub place: Option<String>,
    /// As printed, if the check does not say it.
    pub printed: Option<String>,
    /// Approximations by the key of the check.
    pub of: BTreeMap<String, Vec<String>>,
}

impl Method {
    /// In words.
    pub fn words(&self) -> String {
        match self {
            Self::Forms { .. } => self.candidates().join(", "),
            Self::TwoPass { rank, factors: Factors::Svd } => format!("two passes, rank {rank}"),
            Self::TwoPass { rank, factors: Factors::Convolution(maps) } if maps.is_empty() => {
                format!("two passes, rank {rank}, fitted to the maps that it is judged under")
            }
            Self::TwoPass { rank, factors: Factors::Convolution(maps) } => {
                format!("two passes, rank {rank}, fitted to {}", maps.join(", "))
            }
            Self::Printed { rank } => format!("alg. 1 as printed, rank {rank}"),
            Self::Sum => "sum of two directional blurs".into(),
            Self::Line => "1D along the tangents".into(),
            Self::Reconstructed { rank } => format!("the sum over a table of rank {rank}"),
        }
    }

    /// Names of the candidates that it shades with, if any.
    pub fn candidates(&self) -> Vec<String> {
        match self {
            Self::Forms { sphere, polygon } => {
                [sphere, polygon].into_iter().flatten().cloned().collect()
            }
            _ => Vec::new(),
        }
    }

    /// Terms of the factors, where it has any.
    pub fn rank(&self) -> Option<usize> {
        match self {
            Self::TwoPass { rank, .. } | Self::Printed { rank } | Self::Reconstructed { rank } => {
                Some(*rank)
            }
            Self::Forms { .. } | Self::Sum | Self::Line => None,
        }
    }
}

impl ReferenceMethod {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Quadrature => "quadrature (semi-analytic, f64)",
            Self::Full => "the convolution with the whole table under n = ω_o = r_v, f64",
            Self::Integral => "the sum over the table at every pixel, f64",
            Self::MonteCarlo => "Monte Carlo",
        }
    }
}

impl Budget {
    /// What of it a picture called `name` with these errors exceeds, in words. A NaN exceeds every limit.
    pub fn exceeded(&self, name: &str, relative_rms: f64, flip: f64) -> Vec<String> {
        let limits = [("relative RMS", relative_rms, self.relative_rms), ("FLIP", flip, self.flip)];
        let over = limits.into_iter().filter_map(|(what, got, limit)| {
            let limit = limit.filter(|limit| got.is_nan() || got > *limit)?;
            Some(format!("{name}: {what} {got:.4e} is over its budget of {limit:e}"))
        });
        over.collect()
    }
}
