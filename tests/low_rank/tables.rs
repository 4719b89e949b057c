//! Tables and environments made by formula, in the likeness of what is measured.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use striae::measured::environment::Environment;
use striae::table::{Axis, Grid, GridChannel};

/// A square table over [−half, half]² with channels R, G, B; `value` gives them at h.
pub(crate) fn table(n: usize, half: f64, value: impl Fn(f64, f64) -> [f64; 3]) -> Grid {
    let axis =
        |name: &str| Axis { name: name.into(), unit: "1".into(), from: -half, to: half, count: n };
    let (x, y) = (axis("h_x"), axis("h_y"));
    let (xs, ys) = (x.centres(), y.centres());
    let texels: Vec<[f64; 3]> =
        ys.iter().flat_map(|hy| xs.iter().map(|hx| value(*hx, *hy)).collect::<Vec<_>>()).collect();
    let channel = |(k, name): (usize, &str)| GridChannel {
        name: name.into(),
        unit: "1".into(),
        values: texels.iter().map(|t| t[k] as f32).collect(),
    };
    let channels = ["R", "G", "B"].into_iter().enumerate().map(channel).collect();
    Grid { axes: vec![x, y], channels, origin: "made by formula".into() }
}

/// One channel, from its rows.
pub(crate) fn rows(rows: &[&[f32]]) -> Grid {
    let mut grid = table(1, 0.5, |_, _| [0.0; 3]);
    grid.axes[0].count = rows[0].len();
    grid.axes[1].count = rows.len();
    grid.channels = vec![GridChannel { name: "Y".into(), unit: "1".into(), values: rows.concat() }];
    grid
}

/// Wavelengths that stand for R, G and B, in nm.
const WAVELENGTHS_NM: [f64; 3] = [610.0, 540.0, 460.0];

fn gaussian(x: f64, sigma: f64) -> f64 {
    (-0.5 * (x / sigma).powi(2)).exp()
}

/// A display: orders on a lattice with directions at `angles` (rad), under two envelopes along the
/// lattice, so that it is of rank 1 per wavelength in its own coordinates.
pub(crate) fn display(n: usize, angles: [f64; 2], pitch_um: f64) -> Grid {
    let half = 0.35;
    let sigma = 1.2 * half / n as f64 * 2.0;
    let ([cx, sx], [cy, sy]) =
        ([angles[0].cos(), angles[0].sin()], [angles[1].cos(), angles[1].sin()]);
    let determinant = cx * sy - sx * cy;
    table(n, half, |hx, hy| {
        let along = [(sy * hx - cy * hy) / determinant, (cx * hy - sx * hx) / determinant];
        WAVELENGTHS_NM.map(|lambda| {
            let spacing = lambda * 1e-3 / pitch_um;
            let comb = |a: f64| {
                (-12..=12)
                    .map(|k| {
                        let order = f64::from(k);
                        gaussian(a - order * spacing, sigma) / (1.0 + order * order).powf(0.8)
                    })
                    .sum::<f64>()
            };
            comb(along[0]) * comb(along[1])
        })
    })
}

/// A cross: orders along two lines only, of rank 2 when straight.
pub(crate) fn cross(n: usize, angles: [f64; 2]) -> Grid {
    let half = 0.35;
    let texel = 2.0 * half / n as f64;
    table(n, half, |hx, hy| {
        WAVELENGTHS_NM.map(|lambda| {
            let spacing = lambda / 540.0 * half / 7.3;
            let centre = 4.0 * gaussian(hx.hypot(hy), 2.0 * texel);
            let line = |angle: f64| {
                let (s, c) = (angle.sin(), angle.cos());
                let (along, across) = (hx * c + hy * s, hy * c - hx * s);
                (1..=8)
                    .flat_map(|k| [f64::from(k), -f64::from(k)])
                    .map(|k| gaussian(along - k * spacing, 1.5 * texel) / k.abs())
                    .sum::<f64>()
                    * gaussian(across, 1.5 * texel)
            };
            centre + line(angles[0]) + line(angles[1])
        })
    })
}

/// A disc: a line of coloured orders at `angle`, with the light that pits spread around them.
pub(crate) fn disc(n: usize, angle: f64) -> Grid {
    let half = 0.9;
    let texel = 2.0 * half / n as f64;
    let (s, c) = (angle.sin(), angle.cos());
    table(n, half, |hx, hy| {
        let (along, across) = (hx * c + hy * s, hy * c - hx * s);
        WAVELENGTHS_NM.map(|lambda| {
            let spacing = lambda * 1e-3 / 1.6;
            (-2i32..=2)
                .map(|k| {
                    let k = f64::from(k);
                    let order = gaussian(along - k * spacing, 1.5 * texel);
                    let pits = gaussian(along - k * spacing, 3.0 * texel) * 0.3
                        / (1.0 + (across / (0.08 + 0.1 * k.abs())).powi(2));
                    (order * gaussian(across, 1.5 * texel) + pits) / (1.0 + k * k)
                })
                .sum()
        })
    })
}

/// A holographic paper: blobs about rings of orders in directions that repeat at no angle.
pub(crate) fn holographic(n: usize, seed: u64) -> Grid {
    let half = 0.7;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut draw = || random.random::<f64>();
    let blobs: Vec<[f64; 4]> = (0..14)
        .map(|_| [draw() * std::f64::consts::PI, 0.25 + 0.4 * draw(), 0.02 + 0.05 * draw(), draw()])
        .collect();
    table(n, half, |hx, hy| {
        WAVELENGTHS_NM.map(|lambda| {
            let centre = 3.0 * gaussian(hx.hypot(hy), 0.025);
            let sum: f64 = blobs
                .iter()
                .map(|[angle, distance, size, weight]| {
                    let r = distance * lambda / 540.0;
                    let (x, y) = (r * angle.cos(), r * angle.sin());
                    let one = |x: f64, y: f64| gaussian((hx - x).hypot(hy - y), *size);
                    weight * (one(x, y) + one(-x, -y))
                })
                .sum();
            centre + sum
        })
    })
}

/// Noise of a given part of the largest value, not negative.
pub(crate) fn noisy(mut table: Grid, part: f64, seed: u64) -> Grid {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for channel in &mut table.channels {
        let most = channel.values.iter().copied().fold(0.0, f32::max);
        for value in &mut channel.values {
            *value += (part * random.random::<f64>()) as f32 * most;
        }
    }
    table
}

/// A map of `height` rows from what each direction sends.
fn environment(height: usize, origin: &str, radiance: impl Fn([f64; 3]) -> f64) -> Environment {
    let width = 2 * height;
    let texel = |i: usize, j: usize| {
        let phi = std::f64::consts::TAU * (i as f64 + 0.5) / width as f64;
        let theta = std::f64::consts::PI * (j as f64 + 0.5) / height as f64;
        let value =
            radiance([theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]) as f32;
        [value, 0.9 * value, 0.8 * value]
    };
    let radiance =
        (0..height).flat_map(|j| (0..width).map(|i| texel(i, j)).collect::<Vec<_>>()).collect();
    Environment { width, height, radiance, origin: origin.into() }
}

/// Unit vectors spread evenly, the same for one seed.
fn directions(count: usize, seed: u64) -> Vec<[f64; 3]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..count)
        .map(|_| {
            let z: f64 = random.random::<f64>() * 2.0 - 1.0;
            let phi = std::f64::consts::TAU * random.random::<f64>();
            let r = (1.0 - z * z).sqrt();
            [r * phi.cos(), r * phi.sin(), z]
        })
        .collect()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Windows of some ten degrees with soft edges in a dim room.
pub(crate) fn windows(seed: u64) -> Environment {
    let centres = directions(12, seed);
    environment(128, &format!("windows {seed}"), |d| {
        let window =
            |c: &[f64; 3]| 1.0 / (1.0 + ((dot(*c, d).clamp(-1.0, 1.0).acos() - 0.12) / 0.02).exp());
        0.02 + centres.iter().map(window).sum::<f64>()
    })
}

/// A few small lamps in the dark.
pub(crate) fn lamps(seed: u64) -> Environment {
    let centres = directions(40, seed);
    environment(512, &format!("lamps {seed}"), |d| {
        centres.iter().map(|c| gaussian(dot(*c, d).clamp(-1.0, 1.0).acos(), 0.004)).sum::<f64>()
    })
}
