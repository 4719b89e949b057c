//! Orders of a grating: where they should be, where a table has them, and how much they carry.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | f₀ | `frequency` | µm⁻¹ | spatial frequency of the grating, (f_x, f_y); its pitch is d = 1/|f₀| |
//! | m | `order` | 1 | order; it leaves at h = m λ f₀, sin θ = m λ/d |
//! | b | `nm` | nm | amplitude of the heights' sinusoid |
//! | a | `phase` | rad | amplitude of the phase, k w b |
//!
//! The pitch is found in the heights and the orders in the table, so that each checks the other.

use nalgebra::{Matrix3, Vector3};
use rustfft::num_complex::Complex64;

use super::DiffractionError;
use super::far_field::{FarField, FarFieldTransform};
use super::preparation::PreparedHeights;
use super::reference::sinusoid_order_power;
use super::table::at_wavelength;
use crate::effect::DomainError;
use crate::numeric::statistics;

/// Deviation from the mean below which a surface is flat, nm: rounding of a mean plane.
const FLAT_NM: f64 = 1e-6;

/// Spatial frequency that the heights have most of, refined between the cells of the transform.
///
/// `None` for heights that are constant to a millionth of a nanometre. The surface should be windowed, so that leakage does not
/// pull the maximum.
///
/// # Errors
/// As [`FarFieldTransform::new`].
pub fn fundamental(surface: &PreparedHeights) -> Result<Option<[f64; 2]>, DiffractionError> {
    let samples = || surface.height_nm.iter().zip(&surface.amplitude);
    let mean = statistics::sum(samples().map(|(h, a)| h * a))
        / statistics::sum(surface.amplitude.iter().copied());
    let screen: Vec<f64> = samples().map(|(h, a)| a * (h - mean)).collect();
    let largest = screen.iter().fold(0.0_f64, |worst, v| worst.max(v.abs()));
    if largest < FLAT_NM {
        return Ok(None);
    }
    // The first order of a screen so shallow that its phase is its height.
    let shallow = PreparedHeights {
        height_nm: surface.height_nm.iter().map(|h| (h - mean) / largest * 1e-3).collect(),
        ..surface.clone()
    };
    let field =
        FarFieldTransform::new(&shallow, 1)?.far_field(&shallow, std::f64::consts::TAU, 1.0);
    let (power, x, y) = field.strongest(|x, y| {
        let f = [field.x.centre(x), field.y.centre(y)];
        // The window's main lobe around 0 spans two cells; one of each pair ±f is enough.
        let away = (f[0] / field.x.pitch).abs() > 2.5 || (f[1] / field.y.pitch).abs() > 2.5;
        away && (f[0] > 0.0 || (f[0] == 0.0 && f[1] > 0.0))
    });
    if power <= 0.0 {
        return Ok(None);
    }
    let start = [field.x.centre(x), field.y.centre(y)];
    Ok(Some(refined(surface, &screen, start, [field.x.pitch, field.y.pitch])))
}

/// Maximum of |Σ screen e^(−2πi f·x)|² near `start`, by parabolas along x and y in turn.
fn refined(
    surface: &PreparedHeights,
    screen: &[f64],
    start: [f64; 2],
    pitch: [f64; 2],
) -> [f64; 2] {
    let phasors = |n: usize, d: f64, f: f64| -> Vec<Complex64> {
        (0..n)
            .map(|i| {
                let (sin, cos) = core_math::sincos(-std::f64::consts::TAU * f * (i as f64 * d));
                Complex64::new(cos, sin)
            })
            .collect()
    };
    let power = |f: [f64; 2]| {
        let (x, y) =
            (phasors(surface.nx, surface.dx_um, f[0]), phasors(surface.ny, surface.dy_um, f[1]));
        let rows = screen.chunks(surface.nx).zip(&y);
        let sum: Complex64 = rows
            .map(|(row, y)| y * row.iter().zip(&x).map(|(h, x)| x * h).sum::<Complex64>())
            .sum();
        sum.norm_sqr()
    };
    let mut f = start;
    for round in 0..4 {
        let step = 0.3 * 0.5_f64.powi(round);
        for axis in 0..2 {
            if (axis == 0 && surface.nx < 2) || (axis == 1 && surface.ny < 2) {
                continue;
            }
            let at = |offset: f64| {
                let mut g = f;
                g[axis] += offset * pitch[axis];
                power(g).max(f64::MIN_POSITIVE).ln()
            };
            let (low, here, high) = (at(-step), at(0.0), at(step));
            let curvature = low - 2.0 * here + high;
            if curvature < 0.0 {
                let shift = (0.5 * (low - high) / curvature).clamp(-1.0, 1.0);
                f[axis] += shift * step * pitch[axis];
            }
        }
    }
    f
}

/// Amplitude of the sinusoid in the heights, by least squares row after row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SinusoidAmplitude {
    /// Mean over the rows, nm.
    pub nm: f64,
    /// Standard deviation of a row, nm.
    pub spread_nm: f64,
    /// Standard error of the mean, nm: spread over the root of the rows' effective number.
    pub standard_error_nm: f64,
    /// Rows that tell as much as all do, given that neighbours are alike.
    pub effective_rows: f64,
    /// Share of the variance of the heights that one sinusoid per row explains.
    pub explained: f64,
}

/// Fits c + b cos(2π f x + φ) to every line of samples along the axis on which f is larger.
///
/// `None` if there is no line with more than six samples.
pub fn sinusoid_amplitude(
    surface: &PreparedHeights,
    frequency: [f64; 2],
) -> Option<SinusoidAmplitude> {
    let along_x = frequency[0].abs() >= frequency[1].abs();
    let (n, lines, d, f) = if along_x {
        (surface.nx, surface.ny, surface.dx_um, frequency[0])
    } else {
        (surface.ny, surface.nx, surface.dy_um, frequency[1])
    };
    let at = |line: usize, i: usize| {
        let index = if along_x { line * surface.nx + i } else { i * surface.nx + line };
        surface.height_nm.get(index).copied().unwrap_or(f64::NAN)
    };
    if n < 7 {
        return None;
    }
    let basis: Vec<Vector3<f64>> = (0..n)
        .map(|i| {
            let (sin, cos) = core_math::sincos(std::f64::consts::TAU * f * (i as f64 * d));
            Vector3::new(1.0, cos, sin)
        })
        .collect();
    let normal: Matrix3<f64> = basis.iter().map(|b| b * b.transpose()).sum();
    let inverse = normal.try_inverse()?;
    let (mut amplitudes, mut left, mut all) = (Vec::new(), 0.0, 0.0);
    for line in 0..lines {
        let right: Vector3<f64> = basis.iter().enumerate().map(|(i, b)| b * at(line, i)).sum();
        let fit = inverse * right;
        amplitudes.push(fit.y.hypot(fit.z));
        for (i, b) in basis.iter().enumerate() {
            left += (at(line, i) - b.dot(&fit)).powi(2);
            all += at(line, i).powi(2);
        }
    }
    let count = lines as f64;
    let nm = statistics::sum(amplitudes.iter().copied()) / count;
    let deviations: Vec<f64> = amplitudes.iter().map(|a| a - nm).collect();
    let square = deviations.iter().map(|d| d * d).sum::<f64>();
    let spread_nm = if lines > 1 { (square / (count - 1.0)).sqrt() } else { 0.0 };
    let effective_rows = effective_number(&deviations, square);
    let standard_error_nm = spread_nm / effective_rows.sqrt();
    let explained = if all > 0.0 { 1.0 - left / all } else { 0.0 };
    Some(SinusoidAmplitude { nm, spread_nm, standard_error_nm, effective_rows, explained })
}

/// n/(1 + 2 Σ ρ), the autocorrelation ρ summed up to where it first is not positive.
fn effective_number(deviations: &[f64], square: f64) -> f64 {
    let n = deviations.len();
    let mut inflation = 1.0;
    for lag in 1..n {
        let pairs = deviations.iter().zip(deviations.iter().skip(lag));
        let correlation = pairs.map(|(a, b)| a * b).sum::<f64>() / square;
        if correlation.is_nan() || correlation <= 0.0 {
            break;
        }
        inflation += 2.0 * correlation;
    }
    (n as f64 / inflation).max(1.0)
}

/// An order, as predicted and as found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Order {
    /// m.
    pub order: i32,
    /// Where m λ f₀ puts it.
    pub predicted: [f64; 2],
    /// Where the table has it.
    pub found: [f64; 2],
    /// Distance of the two, in texels of the table.
    pub texels_off: f64,
    /// Power between the halves to the neighbouring orders, as a share of all.
    pub power: f64,
}

/// Orders −`most` to `most` of the far field of a surface with a grating of `frequency`, and where a
/// table of `size` texels per side over [−extent, extent] has them.
///
/// The place is the centroid of the power within one width of the order (λ/L, at least 1.5 texels),
/// moved along until it stays. Orders outside the table are left out.
pub fn orders(
    field: &FarField,
    frequency: [f64; 2],
    widths_um: [f64; 2],
    most: i32,
    size: usize,
    extent: f64,
) -> Vec<Order> {
    let wavelength_um = 1e-3 * field.wavelength_nm;
    let (texels, [x, y]) = at_wavelength(field, [size, size], extent);
    let texel = 2.0 * extent / size as f64;
    let length = frequency[0].hypot(frequency[1]);
    // Half-extents of the patch that the centroid is taken over.
    let reach = widths_um.map(|l| (wavelength_um / l).max(1.5 * texel));
    let along = |fx: f64, fy: f64| (fx * frequency[0] + fy * frequency[1]) / (length * length);
    let mut found = Vec::new();
    for order in -most..=most {
        let predicted = frequency.map(|f| f64::from(order) * wavelength_um * f + 0.0);
        if predicted.iter().zip(reach).any(|(h, r)| h.abs() + r > extent) {
            continue;
        }
        let mut place = predicted;
        for _ in 0..20 {
            let (mut sum, mut moment) = (0.0, [0.0; 2]);
            for (iy, row) in texels.chunks(size).enumerate() {
                let wy = inside(y.centre(iy), place[1], reach[1], texel);
                if wy <= 0.0 {
                    continue;
                }
                for (ix, power) in row.iter().enumerate() {
                    let weight = wy * inside(x.centre(ix), place[0], reach[0], texel) * power;
                    sum += weight;
                    moment[0] += weight * x.centre(ix);
                    moment[1] += weight * y.centre(iy);
                }
            }
            if sum <= 0.0 {
                break;
            }
            place = moment.map(|m| m / sum);
        }
        let off = (place[0] - predicted[0]).abs().max((place[1] - predicted[1]).abs());
        found.push(Order {
            order,
            predicted,
            found: place,
            texels_off: off / texel,
            power: field.share(|fx, fy| (along(fx, fy) - f64::from(order)).abs() < 0.5),
        });
    }
    found
}

/// Share of a texel centred at `at` that lies within `reach` of `centre`.
fn inside(at: f64, centre: f64, reach: f64, texel: f64) -> f64 {
    ((reach - (at - centre).abs()) / texel + 0.5).clamp(0.0, 1.0)
}

/// Power of an order of a sinusoid with its standard uncertainty, from that of the phase's amplitude.
///
/// # Errors
/// As [`sinusoid_order_power`].
pub fn predicted_power(
    order: u32,
    phase: f64,
    phase_uncertainty: f64,
) -> Result<(f64, f64), DomainError> {
    let power = sinusoid_order_power(order, phase)?;
    // Half the change over ± one standard uncertainty: it holds at the maxima too.
    let at = |phase: f64| sinusoid_order_power(order, phase.clamp(0.0, 20.0));
    let change = at(phase + phase_uncertainty)? - at(phase - phase_uncertainty)?;
    Ok((power, 0.5 * change.abs()))
}
