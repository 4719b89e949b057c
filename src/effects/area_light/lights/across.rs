//! The integral across the lobe: adaptive Gauss–Kronrod over slices ξ₁ = const of a light.
//!
//! Every slice is integrated exactly along ξ₂ by the band integral. What is left,
//! ∫ exp(−ks² ξ₁²) B(ξ₁) dξ₁, is smooth between the places where the light begins or ends, where one of
//! its vertices lies or where its boundary crosses ξ₂ = 0; at the limbs of a sphere and where an edge
//! is tangent to the slice B behaves like a square root. Each piece between such places is
//! integrated over θ with s = centre + half sin θ, which turns both ends into even functions of θ,
//! by Gauss–Kronrod panels that are halved, the worst first, until the sum of the estimated errors
//! is below [`TOLERANCE`] of the value. Where halving ends without that, at [`MOST_PANELS`] or
//! where the bands themselves are rounding, a sum estimated to be further off than [`PROMISED`], and than
//! [`FLOOR`] of the most that the lobe can hold, is an error and no value.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

// Not the platform's, which sets the rounding mode at each call.
use libm::sincos;

use crate::effect::DomainError;
use crate::effects::area_light::band::sinc_squared_band;

/// Estimated relative error at which halving stops.
const TOLERANCE: f64 = 1e-10;
/// Estimated relative error above which there is no value.
const PROMISED: f64 = 1e-9;
/// Estimated error, over √π/ks · 2π/(kw + π), up to which there is a value nonetheless: next to nothing is
/// seen of a sliver, and its width is rounding.
const FLOOR: f64 = 1e-12;
/// Error that is none where values leave the range of normal numbers.
const SMALLEST: f64 = 1e-300;
/// Panels past which halving stops once what is promised is reached.
const MANY_PANELS: usize = 1000;
/// Panels past which halving stops.
const MOST_PANELS: usize = 4000;
/// exp(−t²) is left out where it is below e⁻³⁰ = 1e-13 of its largest value on the light.
const REACH_SQUARED: f64 = 30.0;

/// A slice ξ₁ = const of a light.
#[derive(Debug, Default)]
pub(super) struct Slice {
    /// ξ₁ of the slice.
    pub xi_1: f64,
    /// dξ₁/ds.
    pub slope: f64,
    /// Length of (ω_y, ω_z) on the slice.
    pub radius: f64,
    /// Intervals of the azimuth φ in [0, π] that the light covers, ω_y = radius cos φ: in φ, and not in
    /// ω_y, nothing cancels where the slice meets the horizon.
    pub covered: Vec<[f64; 2]>,
}

/// A light that can be cut into slices, over a variable s of its own.
pub(super) trait Sliced {
    /// Range of s.
    fn range(&self) -> [f64; 2];
    /// Range of ξ₁.
    fn xi_1_range(&self) -> [f64; 2];
    /// The s of a given ξ₁ inside the range.
    fn at_xi_1(&self, xi_1: f64) -> f64;
    /// Where slices are not smooth functions of s, in any order, outside the range too.
    fn kinks(&self) -> Vec<f64>;
    /// Writes the slice at s.
    fn slice(&self, s: f64, slice: &mut Slice);
}

/// Parameters of the lobe: kW, kσ and what ω_y is added to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lobe {
    pub kw: f64,
    pub ks: f64,
    pub view_y: f64,
}

impl Lobe {
    /// ∫∫ exp(−ks² ξ₁²) sinc²(kw ξ₂/2) dξ₁dξ₂ over the light.
    ///
    /// # Errors
    /// [`DomainError`] for a light without a range of ξ₁ and where the sum is not known to converge.
    pub(super) fn integral(self, light: &impl Sliced) -> Result<f64, DomainError> {
        let [low, high] = light.xi_1_range();
        let known = !low.is_nan() && !high.is_nan();
        let extent = "extent of the light along the scratch";
        DomainError::unless(known, extent, f64::NAN, "a range of numbers")?;
        if low >= high {
            return Ok(0.0);
        }
        // Squared magnitude of the exponent where it is smallest on the light.
        let nearest = if low > 0.0 { low } else { high.min(0.0) } * self.ks;
        let reach = (nearest * nearest + REACH_SQUARED).sqrt() / self.ks;
        let [mut from, mut to] = light.range();
        if low < -reach {
            from = light.at_xi_1(-reach);
        }
        if high > reach {
            to = light.at_xi_1(reach);
        }
        let mut edges = light.kinks();
        let inner = [-2.5, 0.0, 2.5].map(|t| t / self.ks);
        edges.extend(inner.iter().filter(|&&x| low < x && x < high).map(|&x| light.at_xi_1(x)));
        edges.retain(|edge| from < *edge && *edge < to);
        edges.extend([from, to]);
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        let pieces: Vec<[f64; 2]> = edges.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        self.over_pieces(light, &pieces)
    }

    fn over_pieces(self, light: &impl Sliced, pieces: &[[f64; 2]]) -> Result<f64, DomainError> {
        let mut slice = Slice::default();
        let mut panel = |piece: [f64; 2], from: f64, to: f64| {
            let (centre, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
            let value = |theta: f64| {
                let (sine, cosine) = sincos(theta);
                light.slice(centre + half * sine, &mut slice);
                let exponent = self.ks * slice.xi_1;
                let weight = half * cosine * slice.slope * (-exponent * exponent).exp();
                weight * self.band(&slice)
            };
            let (integral, error) = gauss_kronrod(value, from, to);
            Panel { piece, from, to, integral, error }
        };
        let mut panels: Vec<Panel> =
            pieces.iter().map(|piece| panel(*piece, -FRAC_PI_2, FRAC_PI_2)).collect();
        while panels.len() < MOST_PANELS {
            let many = panels.len() >= MANY_PANELS;
            if estimated_error(&panels) <= TOLERANCE || (many && self.is_promised(&panels)) {
                break;
            }
            let worst =
                (0..panels.len()).max_by(|a, b| panels[*a].error.total_cmp(&panels[*b].error));
            let Some(index) = worst else { break };
            let Panel { piece, from, to, .. } = panels[index];
            let middle = 0.5 * (from + to);
            if middle <= from || middle >= to {
                break;
            }
            panels[index] = panel(piece, from, middle);
            panels.push(panel(piece, middle, to));
        }
        let error = "estimated relative error of the integral across the scratch";
        let promised = self.is_promised(&panels);
        DomainError::unless(promised, error, estimated_error(&panels), "[0, 1e-9]")?;
        panels.sort_by(|a, b| a.piece[0].total_cmp(&b.piece[0]).then(a.from.total_cmp(&b.from)));
        Ok(panels.iter().map(|panel| panel.integral).sum())
    }

    /// Whether the estimated error is at most [`PROMISED`] or [`FLOOR`]; not for a NaN.
    fn is_promised(self, panels: &[Panel]) -> bool {
        let error: f64 = panels.iter().map(|panel| panel.error).sum();
        let most = PI.sqrt() / self.ks * TAU / (self.kw + PI);
        estimated_error(panels) <= PROMISED || error <= FLOOR * most
    }

    /// ∫ sinc²(kw ξ₂/2) dξ₂ over the covered intervals.
    fn band(self, slice: &Slice) -> f64 {
        let interval = |&[from, to]: &[f64; 2]| {
            let (turn, half_turn) = (0.5 * (from + to), 0.5 * (to - from));
            let ((sin, cos), (half_sin, half_cos)) = (sincos(turn), sincos(half_turn));
            let centre = self.kw * (slice.radius * cos * half_cos + self.view_y);
            let half = self.kw * slice.radius * sin * half_sin;
            if half <= MOST_PERIODS * PI {
                band_in_panels(centre, half)
            } else {
                sinc_squared_band(centre - half, centre + half)
            }
        };
        slice.covered.iter().map(interval).sum::<f64>() / self.kw
    }
}

/// ∫ sinc²(t/2) dt over |t − centre| ≤ half by Gauss and Legendre's twelve points per period, which
/// integrate it to rounding: within an integral digits of a band between two zeros need not be kept, as
/// [`sinc_squared_band`] keeps them, and the sines of all panels follow from those of one.
fn band_in_panels(centre: f64, half: f64) -> f64 {
    let panels = (half / PI).ceil().max(1.0);
    let part = half / panels;
    let nodes = GAUSS.map(|[x, weight]| (x * part, sincos(0.5 * x * part), weight));
    let panel = |index: usize| {
        let middle = centre + part * (2.0 * index as f64 + 1.0 - panels);
        let (sin, cos) = sincos(0.5 * middle);
        let both = |&(offset, (sin_offset, cos_offset), weight): &(f64, (f64, f64), f64)| {
            let (even, odd) = (sin * cos_offset, cos * sin_offset);
            weight
                * (sinc_squared(middle + offset, even + odd)
                    + sinc_squared(middle - offset, even - odd))
        };
        nodes.iter().map(both).sum::<f64>()
    };
    part * (0..panels as usize).map(panel).sum::<f64>()
}

/// sinc²(t/2) with sin(t/2) given.
fn sinc_squared(t: f64, sin_half: f64) -> f64 {
    let square = t * t;
    if square < 1e-2 {
        // The next term is 6e-15 at most.
        1.0 - square / 12.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0))
    } else {
        4.0 * sin_half * sin_half / square
    }
}

/// Periods of sinc² up to which a band is integrated in panels.
const MOST_PERIODS: f64 = 8.0;
/// Abscissae x > 0 and weights of Gauss and Legendre's twelve points, A&S table 25.4.
const GAUSS: [[f64; 2]; 6] = [
    [0.125_233_408_511_468_9, 0.249_147_045_813_402_77],
    [0.367_831_498_998_180_2, 0.233_492_536_538_354_8],
    [0.587_317_954_286_617_4, 0.203_167_426_723_065_92],
    [0.769_902_674_194_304_7, 0.160_078_328_543_346_23],
    [0.904_117_256_370_474_9, 0.106_939_325_995_318_43],
    [0.981_560_634_246_719_3, 0.047_175_336_386_511_83],
];

/// A part of a piece, over θ.
struct Panel {
    piece: [f64; 2],
    from: f64,
    to: f64,
    integral: f64,
    error: f64,
}

/// Estimated error of the sum of the panels over the sum, 0 where both are below [`SMALLEST`]; NaN if a
/// panel has no value.
fn estimated_error(panels: &[Panel]) -> f64 {
    let total: f64 = panels.iter().map(|panel| panel.integral).sum();
    let error: f64 = panels.iter().map(|panel| panel.error).sum();
    if error <= SMALLEST { 0.0 } else { error / total.abs() }
}

/// Abscissae, weights of Kronrod's 15 points and of Gauss's 7 (0 where it has none), x ≥ 0.
/// Piessens et al., QUADPACK, 1983.
const GAUSS_KRONROD: [[f64; 3]; 8] = [
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0],
    [0.949_107_912_342_758_5, 0.063_092_092_629_978_56, 0.129_484_966_168_869_7],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0],
    [0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0],
    [0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0],
    [0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4],
];

/// Integral over [from, to] by Kronrod's rule, with the error estimate of QUADPACK.
fn gauss_kronrod(mut f: impl FnMut(f64) -> f64, from: f64, to: f64) -> (f64, f64) {
    let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut kronrod, mut gauss) = (0.0, 0.0);
    let mut values = [(0.0, 0.0); 8];
    for ([x, weight, coarse], pair) in GAUSS_KRONROD.iter().zip(&mut values) {
        let right = f(centre + half * x);
        let left = if *x == 0.0 { 0.0 } else { f(centre - half * x) };
        *pair = (left, right);
        kronrod += weight * (left + right);
        gauss += coarse * (left + right);
    }
    let mean = 0.5 * kronrod;
    let spread: f64 = GAUSS_KRONROD
        .iter()
        .zip(&values)
        .map(|([x, weight, _], (left, right))| {
            let other = if *x == 0.0 { 0.0 } else { (left - mean).abs() };
            weight * (other + (right - mean).abs())
        })
        .sum();
    let difference = (kronrod - gauss).abs();
    // No min(1.0), which would drop a NaN.
    let ratio = (200.0 * difference / spread).powf(1.5);
    let error = match spread > 0.0 {
        true if ratio > 1.0 => spread,
        true => spread * ratio,
        false => difference,
    };
    (half * kronrod, half * error)
}
