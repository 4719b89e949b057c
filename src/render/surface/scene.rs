//! What is rendered: one surface with a diffraction table, under environments, and the
//! approximations to judge.
//!
//! # The file
//!
//! A scene with `view.kind = "camera"`. Keys that are not listed here are refused, and so are values
//! out of range, with the file and the key in the message.
//!
//! | key | unit | meaning |
//! |---|---|---|
//! | `description` | | one line, optional |
//! | `view.width`, `view.height` | pixels | of each frame |
//! | `view.position`, `view.target` | any | of the camera, and what is in the middle; +z is up |
//! | `view.field_of_view_deg` | degrees | between the left and the right edge |
//! | `view.exposure` | | what radiance is multiplied by in PNG files and for FLIP, 1 if left out |
//! | `surface.shape` | | `"rectangle"` with `half_size`, `"disc"` with `radii` (hole, rim; circular tracks), `"sphere"` with `radius` (tangents run east about the second tangent) |
//! | `surface.centre`, `.normal`, `.tangent` | any | the tangent is made perpendicular to the normal |
//! | `surface.reflectance` | | F₀², three numbers R, G, B in [0, 1] |
//! | `[diffraction]` | | `table = "FILE.exr"` with axes h_x, h_y and channels R, G, B, or the settings of `striae simulate diffraction`, which makes it |
//! | `[[frame]] environment` | | a map of `data/measured/environments` by name, or a file `.exr` or `.hdr` |
//! | `frame.turn_deg`, `.scale` | degrees, 1 | the surface turned about its normal; factor on radiance |
//! | `convolution.map_width` | texels | of the maps that are convolved |
//! | `convolution.align` | | whether the table is straightened along its main directions first |
//! | `convolution.straighten` | | `"lookup"`: the map is turned into the frame of the surface and looked up there; `"back"`: it is turned back (toisoul2017 §5.2, four passes); `"none"`: two passes in the frame of the world |
//! | `reference.method` | | `"full"`: the convolution with the whole table under n = ω_o = r_v; `"integral"`: eq. 3 at every pixel |
//! | `[[approximation]] name` | | names its files |
//! | `approximation.method` | | `"two_pass"`, `"printed"` (alg. 1 read literally), `"sum"` (two directional blurs), `"line"` (1D along the first direction) or `"reconstructed"` (eq. 3 with the table that the factors give) |
//! | `approximation.rank` | | of `two_pass`, `printed` and `reconstructed`, 1 if left out |
//! | `approximation.factors` | | `"svd"`, or `"convolution"`: of least error after convolution with the environments of the frames |
//! | `[budget.NAME]` | | `relative_rms`, `flip` or both: limits for the approximation called NAME |
//! | `[choice]` | | `relative_rms`, `flip` or both: the cheapest approximation within them is picked and said |

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::camera::Camera;
use super::shape::Shape;
use crate::render::scene::Budget;

/// A surface scene, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceScene {
    /// File name without its extension.
    pub name: String,
    /// One line.
    pub description: String,
    /// The camera of every frame.
    pub camera: Camera,
    /// Factor on radiance for what is displayed.
    pub exposure: f64,
    /// The surface, not turned.
    pub shape: Shape,
    /// F₀² of R, G, B.
    pub reflectance: [f64; 3],
    /// Where the table comes from.
    pub table: TableSource,
    /// What it is seen under; at least one.
    pub frames: Vec<Frame>,
    /// How maps are convolved.
    pub convolution: Convolution,
    /// What approximations are compared with.
    pub reference: ReferenceMethod,
    /// What is compared; at least one.
    pub approximations: Vec<Approximation>,
    /// Limits by name of approximation.
    pub budget: BTreeMap<String, Budget>,
    /// Limits within which the cheapest is picked.
    pub choice: Option<Budget>,
}

/// Where a diffraction table comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum TableSource {
    /// An EXR file with its axes.
    File(PathBuf),
    /// Settings of the simulator, `key=value` each.
    Simulated(Vec<String>),
}

/// One picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Name of a map of the project, or a file.
    pub environment: String,
    /// Turn of the surface about its normal, rad.
    pub turn_rad: f64,
    /// Factor on the radiance of the environment.
    pub scale: f64,
}

/// How maps are convolved.
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

/// How the reference image is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ReferenceMethod {
    /// The convolution with the whole table.
    Full,
    /// Eq. 3 at every pixel, f64.
    Integral,
}

/// An approximation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Approximation {
    /// Name in tables and files.
    pub name: String,
    /// How it is made.
    pub method: Method,
}

/// How an approximation is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// A horizontal and a vertical pass per term.
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

/// Which factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Factors {
    /// Of the singular value decomposition.
    Svd,
    /// Of least error after convolution with the environments of the frames.
    Convolution,
}

impl Method {
    /// In words.
    pub fn words(self) -> String {
        match self {
            Self::TwoPass { rank, factors: Factors::Svd } => format!("two passes, rank {rank}"),
            Self::TwoPass { rank, factors: Factors::Convolution } => {
                format!("two passes, rank {rank}, fitted after convolution")
            }
            Self::Printed { rank } => format!("alg. 1 as printed, rank {rank}"),
            Self::Sum => "sum of two directional blurs".into(),
            Self::Line => "1D along the tangents".into(),
            Self::Reconstructed { rank } => format!("eq. 3 with a table of rank {rank}"),
        }
    }
}
