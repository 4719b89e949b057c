//! From measured heights to a phase screen: trend removed, gaps closed, edges weighted.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | h(x, y) | `height_nm` | nm | height above the mean plane |
//! | a(x, y) | `amplitude` | 1 | window times mask, with mean square 1 |
//!
//! The mean square of the amplitude is brought to 1, so that Parseval's sum is 1 whatever the window:
//! a window spreads each order, it does not dim it.

use nalgebra::{Matrix3, Vector3};

use super::DiffractionError;
use crate::measured::height_map::HeightMap;

/// Which trend is taken off the heights, by least squares over the samples that are there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detrend {
    /// None: a tilted sample moves the whole pattern.
    Nothing,
    /// The mean; it changes no power.
    Piston,
    /// The mean plane.
    Plane,
}

/// What stands in for samples that are not there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Missing {
    /// Heights that solve Laplace's equation between their neighbours: the smoothest patch.
    Fill,
    /// No reflection: amplitude 0, which diffracts as a hole.
    Mask,
}

/// Weights of the amplitude over the patch, the product of one along x and one along y.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Window {
    /// None: orders have the side lobes of a rectangle.
    Rectangle,
    /// sin²: side lobes fall as the sixth power of the distance, orders are 1.6 times as wide.
    Hann,
    /// Flat over half of the length, with sin² ends.
    Tukey,
}

/// How heights are prepared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preparation {
    /// The trend that is taken off.
    pub detrend: Detrend,
    /// What replaces missing samples.
    pub missing: Missing,
    /// The weights.
    pub window: Window,
}

/// Plane through the heights, where it was taken off.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Trend {
    /// Height at the centre of the patch, nm.
    pub piston_nm: f64,
    /// Slope along x and y, nm per µm.
    pub slope: [f64; 2],
}

/// Heights that are ready for a phase screen.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedHeights {
    /// Samples along x.
    pub nx: usize,
    /// Samples along y.
    pub ny: usize,
    /// Distance of samples along x, µm.
    pub dx_um: f64,
    /// Distance of samples along y, µm.
    pub dy_um: f64,
    /// Heights in nm, all finite, row-major.
    pub height_nm: Vec<f64>,
    /// Amplitude of reflection per sample, mean square 1.
    pub amplitude: Vec<f64>,
    /// What was taken off.
    pub removed: Trend,
    /// Samples that were missing.
    pub missing: usize,
    /// The origin of the heights.
    pub origin: String,
}

/// The usual preparation: mean plane off, gaps filled, Hann window.
pub const USUAL: Preparation =
    Preparation { detrend: Detrend::Plane, missing: Missing::Fill, window: Window::Hann };

/// Largest number of samples: what a transform in memory is asked for.
pub const MOST_SAMPLES: usize = 1 << 25;
/// Sweeps of the relaxation that fills gaps.
const MOST_SWEEPS: usize = 2000;
/// Change per sweep at which the relaxation stops, nm: 1e-4 rad of phase in the blue.
const SETTLED_NM: f64 = 1e-3;

/// Prepares a height map.
///
/// # Errors
/// [`DiffractionError::Unusable`] for a map without samples or with fewer than three that are finite,
/// a number of samples that does not fit its sides, or distances that are not positive.
pub fn prepared(
    map: &HeightMap,
    preparation: Preparation,
) -> Result<PreparedHeights, DiffractionError> {
    let HeightMap { nx, ny, dx_um, dy_um, .. } = *map;
    let unusable = |reason: String| DiffractionError::unusable(&map.origin, reason);
    let expected = nx.saturating_mul(ny);
    if expected == 0 || expected > MOST_SAMPLES || map.height_nm.len() != expected {
        let got = map.height_nm.len();
        return Err(unusable(format!(
            "{nx} × {ny} samples, at most {MOST_SAMPLES}, got {got} heights"
        )));
    }
    let positive = |v: f64| v > 0.0 && v.is_finite();
    if !positive(dx_um) || !positive(dy_um) {
        return Err(unusable(format!(
            "distances of samples {dx_um} and {dy_um} µm, expected positive"
        )));
    }
    let valid: Vec<bool> = map.height_nm.iter().map(|h| h.is_finite()).collect();
    let there = valid.iter().filter(|v| **v).count();
    if there < expected.min(3) {
        return Err(unusable(format!("{there} of {expected} samples have a height")));
    }
    let removed = trend(map, preparation.detrend);
    let plane = |i: usize| {
        let (x, y) = position(map, i);
        removed.piston_nm + removed.slope[0] * x + removed.slope[1] * y
    };
    let mut height_nm: Vec<f64> =
        map.height_nm.iter().enumerate().map(|(i, h)| h - plane(i)).collect();
    fill(&mut height_nm, &valid, map);
    let mut amplitude = windowed(preparation.window, nx, ny);
    if preparation.missing == Missing::Mask {
        for (a, valid) in amplitude.iter_mut().zip(&valid) {
            *a *= f64::from(u8::from(*valid));
        }
    }
    let square: f64 = crate::numeric::statistics::sum(amplitude.iter().map(|a| a * a));
    if square <= 0.0 {
        return Err(unusable("no sample with a height is inside the window".into()));
    }
    let scale = (expected as f64 / square).sqrt();
    amplitude.iter_mut().for_each(|a| *a *= scale);
    let origin = map.origin.clone();
    let missing = expected - there;
    Ok(PreparedHeights { nx, ny, dx_um, dy_um, height_nm, amplitude, removed, missing, origin })
}

/// Position of sample `i` from the centre of the patch, µm.
fn position(map: &HeightMap, i: usize) -> (f64, f64) {
    let from_centre = |at: usize, n: usize, d: f64| ((at as f64 + 0.5) - 0.5 * n as f64) * d;
    (from_centre(i % map.nx, map.nx, map.dx_um), from_centre(i / map.nx, map.ny, map.dy_um))
}

/// Least squares plane over the finite heights. Along an axis with one sample the slope is 0.
fn trend(map: &HeightMap, detrend: Detrend) -> Trend {
    if detrend == Detrend::Nothing {
        return Trend::default();
    }
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (i, h) in map.height_nm.iter().enumerate().filter(|(_, h)| h.is_finite()) {
        let (x, y) = position(map, i);
        let row = if detrend == Detrend::Plane {
            Vector3::new(1.0, x, y)
        } else {
            Vector3::new(1.0, 0.0, 0.0)
        };
        normal += row * row.transpose();
        right += row * *h;
    }
    // A slope that no sample tells stays 0 by the pseudo-inverse.
    let largest = normal.max();
    let solution = normal.svd(true, true).solve(&right, 1e-13 * largest).unwrap_or_default();
    Trend { piston_nm: solution.x, slope: [solution.y, solution.z] }
}

/// Replaces heights that are not `valid` by the solution of Laplace's equation between the valid
/// ones, with free edges: successive over-relaxation from values spread outwards from the rim.
fn fill(height: &mut [f64], valid: &[bool], map: &HeightMap) {
    let (nx, ny) = (map.nx, map.ny);
    let gaps: Vec<usize> = (0..height.len()).filter(|i| !valid[*i]).collect();
    if gaps.is_empty() {
        return;
    }
    let (wx, wy) = (map.dx_um.powi(-2), map.dy_um.powi(-2));
    let neighbours = |i: usize| {
        let (x, y) = (i % nx, i / nx);
        [
            (x > 0).then(|| (i - 1, wx)),
            (x + 1 < nx).then(|| (i + 1, wx)),
            (y > 0).then(|| (i - nx, wy)),
            (y + 1 < ny).then(|| (i + nx, wy)),
        ]
    };
    let mean = |height: &[f64], known: &[bool], i: usize| {
        let (mut sum, mut weight) = (0.0, 0.0);
        for (j, w) in neighbours(i).into_iter().flatten().filter(|(j, _)| known[*j]) {
            sum += w * height[j];
            weight += w;
        }
        (weight > 0.0).then(|| sum / weight)
    };
    let mut known = valid.to_vec();
    let mut open = gaps.clone();
    while !open.is_empty() {
        let found: Vec<(usize, f64)> =
            open.iter().filter_map(|&i| Some((i, mean(height, &known, i)?))).collect();
        if found.is_empty() {
            break;
        }
        for (i, value) in &found {
            height[*i] = *value;
            known[*i] = true;
        }
        open.retain(|i| !known[*i]);
    }
    for _ in 0..MOST_SWEEPS {
        let mut largest = 0.0_f64;
        for &i in &gaps {
            if let Some(value) = mean(height, &known, i) {
                let step = 1.8 * (value - height[i]);
                height[i] += step;
                largest = largest.max(step.abs());
            }
        }
        if largest < SETTLED_NM {
            break;
        }
    }
}

/// The window over all samples, not yet normalised.
fn windowed(window: Window, nx: usize, ny: usize) -> Vec<f64> {
    let (x, y) = (along(window, nx), along(window, ny));
    y.iter().flat_map(|wy| x.iter().map(move |wx| wx * wy)).collect()
}

fn along(window: Window, n: usize) -> Vec<f64> {
    let weight = |i: usize| {
        if n < 4 {
            return 1.0;
        }
        // Share of the way from the nearer end to the centre, 1 there.
        let t = 1.0 - ((2 * i + 1) as f64 / n as f64 - 1.0).abs();
        let rise = |t: f64| core_math::sin(std::f64::consts::FRAC_PI_2 * t.min(1.0)).powi(2);
        match window {
            Window::Rectangle => 1.0,
            Window::Hann => rise(t),
            Window::Tukey => rise(2.0 * t),
        }
    };
    (0..n).map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(nx: usize, ny: usize, height: impl Fn(f64, f64) -> f64) -> HeightMap {
        let mut map = HeightMap {
            nx,
            ny,
            dx_um: 0.5,
            dy_um: 0.25,
            height_nm: vec![0.0; nx * ny],
            origin: "test".into(),
        };
        for i in 0..nx * ny {
            let (x, y) = position(&map, i);
            map.height_nm[i] = height(x, y);
        }
        map
    }

    #[test]
    fn a_plane_is_taken_off_whole_even_with_gaps() {
        let mut tilted = map(40, 30, |x, y| 100.0 + 7.0 * x - 3.0 * y);
        for i in [0, 5, 6, 7, 45, 46, 47, 600] {
            tilted.height_nm[i] = f64::NAN;
        }
        let surface = prepared(&tilted, USUAL).expect("a surface");
        let largest = surface.height_nm.iter().fold(0.0_f64, |a, h| a.max(h.abs()));
        // 8e-13 measured, and what the relaxation leaves.
        assert!(largest < 1e-2, "{largest:e}");
        assert!((surface.removed.slope[0] - 7.0).abs() < 1e-9);
        assert_eq!(surface.missing, 8);
    }

    #[test]
    fn gaps_are_filled_with_a_harmonic_function() {
        // x² − y² solves Laplace's equation, also on the lattice with unequal distances.
        let mut saddle = map(32, 32, |x, y| x * x - y * y);
        let exact = saddle.height_nm.clone();
        for y in 10..20 {
            for x in 8..20 {
                saddle.height_nm[y * 32 + x] = f64::NAN;
            }
        }
        let nothing = Preparation { detrend: Detrend::Nothing, ..USUAL };
        let surface = prepared(&saddle, nothing).expect("a surface");
        let largest = surface
            .height_nm
            .iter()
            .zip(&exact)
            .fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
        // The relaxation stops at changes of 1e-3 nm.
        assert!(largest < 0.05, "{largest:e}");
    }

    #[test]
    fn the_mean_square_of_the_amplitude_is_one() {
        for window in [Window::Rectangle, Window::Hann, Window::Tukey] {
            for missing in [Missing::Fill, Missing::Mask] {
                let mut flat = map(33, 20, |_, _| 0.0);
                flat.height_nm[300] = f64::NAN;
                let preparation = Preparation { detrend: Detrend::Plane, missing, window };
                let surface = prepared(&flat, preparation).expect("a surface");
                let square: f64 = surface.amplitude.iter().map(|a| a * a).sum();
                assert!((square / 660.0 - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn maps_that_hold_nothing_are_refused() {
        let bad = [
            HeightMap { nx: 0, ..map(4, 4, |_, _| 0.0) },
            HeightMap { nx: 5, ..map(4, 4, |_, _| 0.0) },
            HeightMap { dx_um: 0.0, ..map(4, 4, |_, _| 0.0) },
            HeightMap { dy_um: f64::NAN, ..map(4, 4, |_, _| 0.0) },
            map(4, 4, |_, _| f64::NAN),
        ];
        for map in bad {
            assert!(prepared(&map, USUAL).is_err(), "{map:?}");
        }
    }
}
