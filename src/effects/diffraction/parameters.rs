//! The settings of the simulator.

use crate::effect::simulator::Setting;

const fn parameter(
    name: &'static str,
    unit: &'static str,
    default: &'static str,
    description: &'static str,
) -> Setting {
    Setting { name, unit, default, description }
}

/// Everything that may be set. Where a default is empty it depends on the surface.
pub(super) const PARAMETERS: &[Setting] = &[
    parameter(
        "surface",
        "",
        "compact_disc",
        "simulated surface: compact_disc, sinusoid, rectangle, blazed, display, phone, \
         holographic_paper",
    ),
    parameter(
        "heightmap",
        "",
        "",
        "measured heights, instead of a surface: FILE.f32 with FILE.json, or FILE.exr with its axes",
    ),
    parameter(
        "pattern",
        "",
        "",
        "picture of a pattern at one wavelength, instead of a surface: PNG, EXR or PFM",
    ),
    parameter("size", "1", "257", "texels per side of the table; odd puts h = 0 into one texel"),
    parameter(
        "extent",
        "1",
        "",
        "the table spans [-extent, extent] in h; 0.15 for screens, else 1",
    ),
    parameter("channels", "", "rgb", "rgb, or spectral: one channel per wavelength"),
    parameter(
        "illuminant",
        "",
        "d65",
        "light of an RGB table: d65, a, e or a CSV of wavelength, power",
    ),
    parameter("wavelengths_nm", "nm", "380:780:10", "from:to:step, or a list with commas"),
    parameter("window", "", "hann", "weights over the patch: hann, tukey, none"),
    parameter("detrend", "", "plane", "taken off the heights: plane, piston, none"),
    parameter("missing", "", "fill", "missing samples: fill (Laplace) or mask (no reflection)"),
    parameter("padding", "1", "2", "samples of the transform over those of the surface, 1 to 8"),
    parameter("w", "1", "2", "cosine of incidence plus that of exitance, in (0, 2]"),
    parameter("report_nm", "nm", "550", "wavelength at which orders and energies are reported"),
    parameter("samples", "1", "512", "samples per side of a simulated surface, 16 to 4096"),
    parameter("side_um", "um", "", "side of a simulated surface; 409.6 for screens, else 51.2"),
    parameter("seed", "1", "1", "seed of a simulated surface"),
    parameter("pitch_um", "um", "", "tracks 1.6, gratings 2, paper 1 (smallest), pixels 50 and 40"),
    parameter("pitch_max_um", "um", "2", "largest pitch of the gratings of paper"),
    parameter("depth_nm", "nm", "", "pits 120, rectangle 120, blaze 200, pixels 100"),
    parameter("amplitude_nm", "nm", "", "sinusoid 30, paper 60"),
    parameter("duty", "1", "0.5", "share of the period of a rectangle at the top, in [0, 1]"),
    parameter("pit_width_um", "um", "0.5", "width of pits"),
    parameter("bit_um", "um", "0.278", "length of a channel bit along a track"),
    parameter("angle_deg", "deg", "", "direction of gratings 0, display 20, phone 35"),
    parameter("skew_deg", "deg", "", "lean of columns of pixels: display 0, phone 12"),
    parameter("matrix_share", "1", "0.3", "black matrix over a sub-pixel's cell, in [0, 0.9]"),
    parameter("cell_um", "um", "8", "side of the patches of paper"),
    parameter("spread_deg", "deg", "12", "largest angle of paper's gratings from x or y"),
    parameter("wavelength_nm", "nm", "", "wavelength of a pattern"),
    parameter("pattern_channel", "", "", "channel of a pattern; needed where several differ"),
    parameter("pattern_encoding", "", "srgb", "what a PNG of a pattern holds: srgb or linear"),
    parameter("pattern_extent", "1", "", "|h| at the left and right edge of a pattern"),
    parameter(
        "pattern_centre_px",
        "px",
        "",
        "x,y of the mirror direction in a pattern; its middle",
    ),
    parameter("exponent", "1", "2", "a pattern scales as (lambda_0/lambda)^exponent; 4 if shallow"),
];
