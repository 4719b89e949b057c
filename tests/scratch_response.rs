//! Scratch references against an oracle made with mpmath, and against the Fourier integral itself.

use std::f64::consts::PI;
use std::path::Path;

use striae::effect::DomainError;
use striae::effects::scratch_response::{
    Coherence, Directions, StraightScratch, along_factor, sinc_pi, svbrdf,
};
use striae::numeric::quadrature::GaussLegendre;
use striae::registry::Registry;

/// Error stated in the documentation of the references, of the largest value over all directions.
const STATED: f64 = 1e-12;

/// Rows of the oracle, by column name.
fn oracle() -> (Vec<String>, Vec<Vec<f64>>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles/scratch_response.csv");
    let mut reader = csv::Reader::from_path(&path).expect("the oracle is committed");
    let names = reader.headers().expect("a header").iter().map(str::to_owned).collect();
    let rows = reader
        .records()
        .map(|row| {
            let row = row.expect("an oracle is well-formed");
            row.iter().map(|field| field.parse().expect("an oracle holds numbers")).collect()
        })
        .collect();
    (names, rows)
}

fn evaluate(name: &str, names: &[String], row: &[f64]) -> Result<f64, DomainError> {
    let (_, reference) = Registry::builtin().reference(name).expect("registered");
    let arguments: Vec<f64> = reference
        .arguments
        .iter()
        .map(|argument| row[names.iter().position(|n| n == argument.name).expect("a column")])
        .collect();
    reference.value(&arguments)
}

/// Largest error of a reference over the oracle, relative to `peak` of a row.
fn largest_error(name: &str, column: &str, peak: impl Fn(&dyn Fn(&str) -> f64) -> f64) -> f64 {
    let (names, rows) = oracle();
    assert!(rows.len() >= 400, "only {} rows", rows.len());
    rows.iter().fold(0.0, |worst, row| {
        let at = |name: &str| row[names.iter().position(|n| n == name).expect("a column")];
        let value = evaluate(name, &names, row).expect("inside its domain");
        // A scratch that the window hides to below 1e-300 has no relative error.
        let peak = peak(&at).max(1e-300);
        let error = (value - at(column)).abs() / peak;
        assert!(!error.is_nan(), "{name}: {value} at {row:?}");
        if error > worst {
            println!("{name}: {error:e} at {row:?}");
        }
        error.max(worst)
    })
}

/// Largest reflectance of an infinite scratch over directions, |𝒟| = 2.
fn infinite_peak(width: f64, wavelength: f64, offset_over_sigma: f64) -> f64 {
    8.0 * (width / wavelength).powi(2) * (-offset_over_sigma.powi(2)).exp()
}

fn mirror_peak(at: &dyn Fn(&str) -> f64) -> f64 {
    4.0 * PI * (at("sigma_um") / at("wavelength_um")).powi(2)
}

#[test]
fn scratch_reflectance_matches_mpmath() {
    let error = largest_error("scratch_reflectance", "scratch", |at| at("peak"));
    assert!(error <= STATED, "{error:e}");
}

#[test]
fn scratched_mirror_reflectance_matches_mpmath() {
    let error =
        largest_error("scratched_mirror_reflectance", "mirror", |at| at("peak") + mirror_peak(at));
    assert!(error <= STATED, "{error:e}");
}

#[test]
fn scratch_pair_reflectance_matches_mpmath() {
    let error = largest_error("scratch_pair_reflectance", "pair", |at| {
        let of = |width: &str, offset: &str| {
            infinite_peak(at(width), at("wavelength_um"), at(offset) / at("sigma_um"))
        };
        of("width_um", "offset_um").max(of("second_width_um", "second_offset_um"))
    });
    assert!(error <= STATED, "{error:e}");
}

#[test]
fn scratch_density_matches_mpmath() {
    let error = largest_error("scratch_density", "density", |at| {
        let s = at("offset_um") / at("sigma_um");
        (2.0 / PI).sqrt() * at("width_um") / at("sigma_um") * (-0.5 * s * s).exp()
    });
    assert!(error <= STATED, "{error:e}");
}

/// The Fourier integral along a scratch by quadrature, and the one across it: eq. 3 and 5 without erf
/// and without sinc.
#[test]
fn factors_match_the_windowed_fourier_integral() {
    let rule = GaussLegendre::new(32);
    let mut worst = 0.0_f64;
    for q in [0.0, 0.3, 1.0, 4.0, 12.0, 40.0, 300.0] {
        for (begin, end) in [
            (-12.0, 12.0),
            (0.0, 12.0),
            (-1.0, 0.5),
            (-0.3, 0.3),
            (1.0, 1.2),
            (2.0, 9.0),
            (-12.0, -0.7),
        ] {
            let panels = 8 + (q * (end - begin)) as usize;
            let part = |f: fn(f64) -> f64| {
                let integrand = |t: f64| (-0.5 * t * t).exp() * f(q * t);
                rule.integral_in_panels(integrand, begin, end, panels) / (2.0 * PI).sqrt()
            };
            let value = along_factor(q, begin, end);
            let error = (value.re - part(f64::cos)).abs().max((value.im + part(f64::sin)).abs());
            worst = worst.max(error);
        }
    }
    println!("along: {worst:e}");
    // Measured 4e-15, of an infinite scratch's 1.
    assert!(worst <= 1e-13, "{worst:e}");
    for x in [0.0, 1e-12, 1e-4, 0.3, 0.999_999, 1.0, 2.5, 17.0, 105.3] {
        let across =
            rule.integral_in_panels(|b| (2.0 * PI * x * b).cos(), -0.5, 0.5, 8 + 2 * x as usize);
        assert!((sinc_pi(x) - across).abs() < 1e-14, "{x}: {:e}", sinc_pi(x) - across);
    }
}

/// Eq. 1 against the two-dimensional integral of the phase surface itself: what is left is the window
/// across the scratch, which eq. 3 takes at its centre line, of order (W/σ)².
#[test]
fn svbrdf_is_the_transform_of_a_phase_surface() {
    let rule = GaussLegendre::new(24);
    let light = Coherence { wavelength_um: 0.55, sigma_um: 10.0 };
    let mut errors = Vec::new();
    for width_um in [0.5, 0.25] {
        let scratch = StraightScratch {
            position_um: [0.0, 3.0],
            direction_rad: 0.0,
            begin_um: -4.0,
            end_um: 30.0,
            width_um,
            depth_um: 0.2,
        };
        let k = 2.0 * PI / light.wavelength_um;
        let worst = [[0.0, 0.0], [0.004, 0.01], [0.01, -0.02], [0.0, 0.3]].map(|xi| {
            let directions = Directions { xi, mu_sum: 1.9 };
            // ∫ w exp(iφ) exp(−ikξ·x): the plane less the scratch, plus the scratch with its phase.
            let line = |f: fn(f64) -> f64, q: f64, from: f64, to: f64| {
                let window = |x: f64| (-0.5 * (x / light.sigma_um).powi(2)).exp() * f(k * q * x);
                rule.integral_in_panels(window, from, to, 200)
            };
            let complex = |q: f64, from: f64, to: f64| {
                nalgebra::Complex::new(line(f64::cos, q, from, to), -line(f64::sin, q, from, to))
            };
            let plane = complex(xi[0], -90.0, 90.0) * complex(xi[1], -90.0, 90.0);
            let half = 0.5 * width_um;
            let inside = complex(xi[0], -4.0, 30.0) * complex(xi[1], 3.0 - half, 3.0 + half);
            let phase = 2.0 * PI * 1.9 * scratch.depth_um / light.wavelength_um;
            let floor = nalgebra::Complex::new(phase.cos(), phase.sin());
            let scale = (PI.sqrt() * light.sigma_um * light.wavelength_um).recip();
            let field = (plane - inside + inside * floor) * scale;
            let amplitude = scratch.amplitude(light, directions).norm() + plane.norm() * scale;
            (svbrdf(&[scratch], light, directions).sqrt() - field.norm()).abs() / amplitude
        });
        errors.push(worst.into_iter().fold(0.0, f64::max));
    }
    println!("of the amplitude: {errors:?}");
    assert!(errors[0] < 3e-3 && errors[1] < errors[0]);
}

#[test]
fn outside_a_domain_the_argument_is_named() {
    let (names, rows) = oracle();
    let faults = [
        ("width_um", 0.0),
        ("depth_um", -1.0),
        ("wavelength_um", f64::NAN),
        ("end_um", -1e9),
        ("mu_sum", 2.1),
    ];
    for (quantity, value) in faults {
        let mut row = rows[0].clone();
        row[names.iter().position(|n| n == "begin_um").expect("a column")] = 0.0;
        row[names.iter().position(|n| n == quantity).expect("a column")] = value;
        let error = evaluate("scratch_reflectance", &names, &row).expect_err("outside");
        assert_eq!(error.quantity, quantity);
    }
}
