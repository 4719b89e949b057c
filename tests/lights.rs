//! Sphere and polygon lights: the semi-analytic references against an oracle and against Monte Carlo, and
//! the forms in f32 on the hard cases against themselves in f64.

use std::f64::consts::{PI, TAU};

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;
use rayon::prelude::*;
use striae::effect::{FormEntry, Reference};
use striae::effects::area_light::lights::monte_carlo::{self, Draws, Estimate};
use striae::effects::area_light::{polygon_light, sphere_light};
use striae::gpu::{Device, required};
use striae::numeric::statistics::sum;
use striae::registry::Registry;

/// Samples per configuration.
const SAMPLES: u32 = 100_000;

/// A light of the z-test: its value and an estimate of it.
type Pair = (String, f64, Estimate);

fn direction(rng: &mut ChaCha12Rng, low: f64) -> [f64; 3] {
    let z = rng.random_range(low..1.0);
    let turn = rng.random_range(0.0..TAU);
    let reach = (1.0_f64 - z * z).sqrt();
    [reach * turn.cos(), reach * turn.sin(), z]
}

/// Scratch and view, the lobe on the light or not far from it.
fn lobe(rng: &mut ChaCha12Rng, mirror: [f64; 3], size: f64) -> (f64, f64, [f64; 2]) {
    let kw = 10_f64.powf(rng.random_range(-1.0..2.5));
    let ks = 10_f64.powf(rng.random_range(-1.0..2.0));
    let mut beside = || (size + 1.0 / ks) * rng.random_range(-1.0..1.0);
    let view = [-mirror[0] + beside(), -mirror[1] + 3.0 * beside()];
    let length = view[0].hypot(view[1]).max(1.0);
    (kw, ks, view.map(|component| component / length))
}

fn sphere_pair(stream: u64) -> Pair {
    let mut rng = ChaCha12Rng::seed_from_u64(41);
    rng.set_stream(stream);
    // Every eighth light surrounds the shaded point, every third crosses the horizon or nearly.
    let axis = direction(&mut rng, if stream.is_multiple_of(3) { -0.4 } else { 0.0 });
    let radius =
        if stream.is_multiple_of(8) { 1.5 } else { 10_f64.powf(rng.random_range(-2.5..0.0)) };
    let (kw, ks, view) = lobe(&mut rng, axis, radius);
    let value = sphere_light(kw, ks, view, axis, radius).expect("in the domain");
    let draws = Draws { count: SAMPLES, seed: 43, stream };
    let case =
        format!("sphere {stream}: kw {kw} ks {ks} view {view:?} centre {axis:?} radius {radius}");
    (case, value, monte_carlo::sphere_light(kw, ks, view, axis, radius, draws))
}

/// A star of eight points in a plane of any tilt (velinov2018 fig. 10), a triangle, or a crescent.
fn outline(rng: &mut ChaCha12Rng, kind: u64, centre: [f64; 3], size: f64) -> Vec<[f64; 3]> {
    let normal = direction(rng, -1.0);
    let other = if normal[0].abs() < 0.7 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let right = cross(normal, other);
    let length = right.iter().map(|c| c * c).sum::<f64>().sqrt();
    let right = right.map(|c| c / length);
    let up = cross(normal, right);
    let flat: Vec<[f64; 2]> = match kind {
        0 => (0..16)
            .map(|k| {
                let reach = if k % 2 == 0 { 1.0 } else { 0.4 };
                let angle = PI * f64::from(k) / 8.0;
                [reach * angle.cos(), reach * angle.sin()]
            })
            .collect(),
        1 => vec![[1.0, 0.1], [-0.7, 0.8], [-0.4, -0.9]],
        _ => vec![[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 0.8]],
    };
    flat.iter()
        .map(|point| [0, 1, 2].map(|k| centre[k] + size * (point[0] * right[k] + point[1] * up[k])))
        .collect()
}

fn polygon_pair(stream: u64) -> Pair {
    let mut rng = ChaCha12Rng::seed_from_u64(42);
    rng.set_stream(stream);
    let centre = direction(&mut rng, if stream.is_multiple_of(3) { -0.3 } else { 0.0 });
    let size = 10_f64.powf(rng.random_range(-2.0..0.3));
    let vertices = outline(&mut rng, stream % 4, centre, size);
    let (kw, ks, view) = lobe(&mut rng, centre, size);
    let value = polygon_light(kw, ks, view, &vertices).expect("in the domain");
    let draws = Draws { count: SAMPLES, seed: 44, stream };
    let case = format!("polygon {stream}: kw {kw} ks {ks} view {view:?} vertices {vertices:?}");
    (case, value, monte_carlo::polygon_light(kw, ks, view, &vertices, draws))
}

/// Largest |z| and the mean of z², over estimates from which a normal law is to be expected.
fn z_test(pairs: &[Pair]) -> (f64, String, f64, usize) {
    let (mut worst, mut case, mut squares) = (0.0, String::new(), Vec::new());
    for (name, value, estimate) in pairs {
        if estimate.standard_error == 0.0 {
            assert!(*value < 1e-6, "{name}: {value:e} against {estimate:?}");
            continue;
        }
        let spread = estimate.standard_error * f64::from(SAMPLES).sqrt();
        // Fewer than some 300 samples in the lobe: the mean is not normal.
        if spread * spread > estimate.mean * estimate.mean * f64::from(SAMPLES) / 300.0 {
            continue;
        }
        // A rounding of the value itself, where the estimate has next to no variance.
        let error = estimate.standard_error.hypot(1e-9 * value);
        let z = (estimate.mean - value) / error;
        squares.push(z * z);
        if z.is_nan() || z.abs() > worst {
            (worst, case) = (z.abs(), format!("{name}: {value:e} against {estimate:?}"));
        }
    }
    let count = squares.len();
    (worst, case, sum(squares) / count as f64, count)
}

/// The two-sided probability 1e-3 of any of n normal deviates to lie beyond, after Šidák: at n = 400
/// the level of each is 2.5e-6, |z| = 4.71.
const WORST_DEVIATE: f64 = 4.71;

/// Relative error that the documentation of the references states.
const STATED: f64 = 1e-9;

/// Tensor quadrature in other variables, by tests/oracles/lights.py.
#[test]
fn references_match_the_oracle() {
    for name in ["sphere_light", "triangle_light"] {
        let reference = Registry::builtin().reference(name).expect("registered").1;
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles");
        let mut reader =
            csv::Reader::from_path(folder.join(format!("{name}.csv"))).expect("a committed oracle");
        let (mut worst, mut rows) = (0.0_f64, 0);
        for row in reader.records() {
            let row: Vec<f64> =
                row.expect("a row").iter().map(|text| text.parse().expect("a number")).collect();
            let (value, point) = row.split_last().expect("columns");
            let got = reference.value(point).expect("in the domain");
            let error = ((got - value) / value).abs();
            assert!(error <= STATED, "{name} at {point:?}: {got:e} against {value:e}");
            (worst, rows) = (worst.max(error), rows + 1);
        }
        println!("{name}: largest relative error {worst:.1e} over {rows} rows");
        assert!(rows >= 50);
    }
}

#[test]
fn references_agree_with_monte_carlo() {
    for (kind, pair) in [("spheres", sphere_pair as fn(u64) -> Pair), ("polygons", polygon_pair)] {
        let pairs: Vec<Pair> = (0..400).into_par_iter().map(pair).collect();
        let (worst, case, mean_square, count) = z_test(&pairs);
        println!(
            "{kind}: {count} configurations, largest |z| {worst:.2}, mean z^2 {mean_square:.3}"
        );
        assert!(count >= 250, "only {count} {kind}");
        assert!(worst <= WORST_DEVIATE, "{case}");
        // χ²/n of n ≥ 250: standard deviation at most 0.09, four of them.
        assert!((mean_square - 1.0).abs() <= 0.36, "{kind}: mean z^2 {mean_square}");
    }
}

/// Where the integral does not converge there is an error; regions and hard cases have values everywhere.
#[test]
fn values_converge_or_are_refused() {
    let effect = Registry::builtin().effect("area_light").expect("registered");
    for region in effect.regions.iter().chain(effect.hard_cases) {
        let table = (region.points)();
        let references = ["sphere_light", "triangle_light"]
            .map(|name| Registry::builtin().reference(name).expect("registered").1);
        let columns = |reference: &Reference| -> Option<Vec<Vec<f64>>> {
            let names = reference.arguments.iter();
            names.map(|a| table.column(a.name).map(|column| column.values.clone())).collect()
        };
        for reference in references {
            let Some(columns) = columns(reference) else { continue };
            let count = columns[0].len();
            let refused: Vec<String> = (0..count)
                .into_par_iter()
                .filter_map(|row| {
                    let point: Vec<f64> = columns.iter().map(|column| column[row]).collect();
                    match reference.value(&point) {
                        Ok(value) => {
                            assert!(value.is_finite(), "{point:?}: {value}");
                            None
                        }
                        Err(error) => Some(format!("{row}: {error}")),
                    }
                })
                .collect();
            println!(
                "{}: {} of {count} refused, {:?}",
                region.name,
                refused.len(),
                refused.first()
            );
            // Its page judges forms on every one.
            assert!(refused.is_empty(), "{}: {refused:?}", region.name);
        }
    }
}

fn reference_of(form: &FormEntry) -> &str {
    form.reference.as_deref().expect("a reference")
}

/// Forms of the two lights, with the hard cases of their reference.
fn forms() -> Vec<(&'static FormEntry, Vec<Vec<f32>>)> {
    let registry = Registry::builtin();
    let effect = registry.effect("area_light").expect("registered");
    let lights = registry.forms_of(effect).filter(|form| reference_of(form).ends_with("_light"));
    lights
        .map(|form| {
            let reference = registry.reference(reference_of(form)).expect("registered").1;
            let tables = effect.hard_cases.iter().map(|cases| (cases.points)());
            let columns = tables
                .filter(|table| reference.arguments.iter().all(|a| table.column(a.name).is_some()))
                .map(|table| {
                    let column = |name: &str| {
                        let values = table.column(name).map(|column| &column.values);
                        values.into_iter().flatten().map(|&v| v as f32).collect::<Vec<f32>>()
                    };
                    reference.arguments.iter().map(|a| column(a.name)).collect::<Vec<_>>()
                })
                .next()
                .expect("a set of hard cases");
            (form, columns)
        })
        .collect()
}

/// A form whose text is not that of the band it takes its constants from would mix constants of two.
#[test]
fn constants_are_those_of_the_band() {
    let names = |form: &str| -> Vec<String> {
        let form = Registry::builtin().form(form).expect("registered").load().expect("a form");
        let mut names: Vec<String> = form.parameters().iter().map(|p| p.name.clone()).collect();
        names.sort();
        names
    };
    for (entry, _) in forms() {
        let bands = [("_lean", "lean"), ("_medium", "medium"), ("_printed", "printed")];
        let band = bands.iter().find(|(end, _)| entry.name.ends_with(end));
        let band = band.map_or("printed_large", |(_, band)| band);
        assert_eq!(names(&entry.name), names(&format!("area_light/band_{band}")), "{}", entry.name);
    }
}

/// Whether the shaded point lies on the surface of the sphere to 1e-6, where the light jumps from one
/// half to all of the hemisphere.
fn on_surface(columns: &[Vec<f32>], row: usize) -> bool {
    let [_, _, _, _, x, y, z, radius] = columns else { return false };
    let [x, y, z, radius] = [x, y, z, radius].map(|column| f64::from(column[row]));
    (x.hypot(y).hypot(z) / radius - 1.0).abs() < 1e-6
}

/// The most that the lobe can hold.
fn natural_scale(columns: &[Vec<f32>], row: usize) -> f64 {
    let [kw, ks] = [0, 1].map(|k| f64::from(columns[k][row]));
    PI.sqrt() / ks * TAU / (kw + PI)
}

/// Largest relative error of f32 against f64 and largest error over `natural`, with their cases.
struct Worst {
    relative: (f64, usize),
    natural: (f64, usize),
}

#[test]
fn forms_hold_on_the_hard_cases() {
    let device = match Device::open() {
        Ok(device) => Some(device),
        Err(error) if required() => panic!("{error}"),
        Err(error) => {
            println!("device skipped: {error}");
            None
        }
    };
    let mut faults = Vec::new();
    for (entry, columns) in forms() {
        let form = entry.load().expect("a form");
        let defaults: Vec<f64> =
            form.parameters().iter().map(|p| p.default.expect("a default")).collect();
        let defaults_f32: Vec<f32> = defaults.iter().map(|v| *v as f32).collect();
        let singles: Vec<&[f32]> = columns.iter().map(Vec::as_slice).collect();
        let doubles: Vec<Vec<f64>> =
            columns.iter().map(|c| c.iter().map(|&v| f64::from(v)).collect()).collect();
        let doubles: Vec<&[f64]> = doubles.iter().map(Vec::as_slice).collect();
        let exact = form.eval_f64(&defaults, &doubles).expect("values").swap_remove(0);
        let single = form.eval_f32(&defaults_f32, &singles).expect("values").swap_remove(0);
        let mut runs = vec![("lanes", single)];
        if let Some(device) = &device {
            let kernel = device.compile(&form, &defaults_f32).expect("a kernel");
            runs.push(("device", kernel.evaluate(&columns).expect("values").swap_remove(0)));
        }
        for (where_run, values) in runs {
            let mut worst = Worst { relative: (0.0, 0), natural: (0.0, 0) };
            let (mut odd, mut below) = (0, 0);
            for (row, (&value, &exact)) in values.iter().zip(&exact).enumerate() {
                let value = f64::from(value);
                odd += usize::from(!value.is_finite() || !exact.is_finite());
                below += usize::from(value < 0.0);
                if on_surface(&columns, row) {
                    continue;
                }
                let error = (value - exact).abs();
                let scale = natural_scale(&columns, row);
                if exact > 1e-6 * scale && error / exact > worst.relative.0 {
                    worst.relative = (error / exact, row);
                }
                if error / scale > worst.natural.0 {
                    worst.natural = (error / scale, row);
                }
            }
            let case = |row: usize| {
                columns
                    .iter()
                    .map(|column| format!("{:e}", column[row]))
                    .collect::<Vec<_>>()
                    .join(" ")
            };
            // What rounding the arguments may change: the sum over arguments moved by half an ulp.
            let by_rounding = |row: usize| {
                let value = |moved: usize, by: f64| {
                    let point: Vec<[f64; 1]> = columns
                        .iter()
                        .enumerate()
                        .map(|(at, c)| [f64::from(c[row]) * if at == moved { by } else { 1.0 }])
                        .collect();
                    let point: Vec<&[f64]> = point.iter().map(|v| v.as_slice()).collect();
                    form.eval_f64(&defaults, &point).expect("values")[0][0]
                };
                let half_ulp = 0.5_f64.powi(24);
                let change = |moved: usize| {
                    let sides = [1.0 + half_ulp, 1.0 - half_ulp];
                    sides
                        .map(|by| (value(moved, by) - exact[row]).abs())
                        .into_iter()
                        .fold(0.0, f64::max)
                };
                (0..columns.len()).map(change).sum::<f64>()
            };
            println!(
                "{} {where_run}: {} cases, {odd} not finite, {below} negative, relative {:.2e} (rounding {:.2e}) \
                 at {} [{}], of the lobe {:.2e} (rounding {:.2e}) at {} [{}]",
                entry.name,
                values.len(),
                worst.relative.0,
                by_rounding(worst.relative.1) / exact[worst.relative.1],
                worst.relative.1,
                case(worst.relative.1),
                worst.natural.0,
                by_rounding(worst.natural.1) / natural_scale(&columns, worst.natural.1),
                worst.natural.1,
                case(worst.natural.1),
            );
            if odd > 0 {
                faults.push(format!("{} {where_run}: {odd} not finite", entry.name));
            }
            if below > 0 && !entry.name.contains("printed") && !entry.name.contains("exact") {
                faults.push(format!("{} {where_run}: {below} negative", entry.name));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
