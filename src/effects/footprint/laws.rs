//! Properties that a mean over a footprint has, whatever the error of a form.

use super::hard_cases::{HALF_EXTENTS, offsets};
use super::regions::table;
use crate::effect::{FormValues, Law};

/// References of infinite scratches.
const INFINITE: &[&str] = &["footprint_response", "footprint_coverage"];

/// Laws of the effect.
pub(super) const LAWS: &[Law] = &[
    Law {
        name: "even",
        description: "the mean depends on |s|: largest |g(h, s) - g(h, -s)| over the hard cases, \
                      0 to the bit",
        violation: oddness,
        references: INFINITE,
        ..Law::EMPTY
    },
    Law {
        name: "range",
        description: "a mean of values in [0, 1] is in [0, 1]: largest excess over h to 1000. The \
                      tolerance is 1 %: fitted constants may pass 1 by their own error at h = 0",
        violation: excess,
        tolerance: 0.01,
        references: INFINITE,
        known_violations: &[
            ("footprint/eq16", THIN),
            ("footprint/eq16_printed", THIN),
            ("footprint/blend_half_extent", "1.27 at h = 0.5, s = 0: the chord exceeds 1"),
            ("footprint/coverage_blend_half_extent", "the chord exceeds 1 below h = 1.6"),
            ("footprint/soft_chord_camera", CAMERA),
            ("footprint/blend_area", THIN),
            ("footprint/coverage_blend_area", "the chord exceeds 1 below h = 1.6"),
            ("footprint/coverage_eq18", "1.6/h at s = 0, without bound for small footprints"),
        ],
    },
    Law {
        name: "falls",
        description: "the mean falls with |s|: largest rise over 400 steps to h + 6. The tolerance \
                      is 4 ulp of 1 in f32",
        violation: largest_rise,
        tolerance: 5e-7,
        references: INFINITE,
        ..Law::EMPTY
    },
    Law {
        name: "point footprint",
        description: "for h -> 0 the response is exp(-s^2): largest difference at h = 0 and 0.001. \
                      The tolerance is 1 %",
        violation: |form| point_footprint(form, 1.0),
        tolerance: 0.01,
        references: &["footprint_response"],
        known_violations: &[
            ("footprint/eq16_printed", "1/pi of it: the missing factor pi"),
            ("footprint/soft_chord_camera", CAMERA),
        ],
    },
    Law {
        name: "point footprint (coverage)",
        description: "for h -> 0 the coverage is exp(-s^2/2): largest difference at h = 0 and \
                      0.001. The tolerance is 1 %",
        violation: |form| point_footprint(form, 0.5),
        tolerance: 0.01,
        references: &["footprint_coverage"],
        known_violations: &[("footprint/coverage_eq18", "1.6/h, and 0 beside the footprint")],
    },
    Law {
        name: "large footprint",
        description: "for large h the response is 2/(sqrt(pi) h) times the chord: largest relative \
                      difference for |s| <= 0.9 h, h = 1000 and 5000. The tolerance is 0.5 %",
        violation: |form| large_footprint(form, std::f64::consts::FRAC_2_SQRT_PI),
        tolerance: 0.005,
        references: &["footprint_response"],
        known_violations: &[("footprint/matched_gaussian", GAUSSIAN)],
    },
    Law {
        name: "large footprint (coverage)",
        description: "for large h the coverage is sqrt(8/pi)/h times the chord: largest relative \
                      difference for |s| <= 0.9 h, h = 1000 and 5000. The tolerance is 0.5 %",
        violation: |form| large_footprint(form, (8.0 / std::f64::consts::PI).sqrt()),
        tolerance: 0.005,
        references: &["footprint_coverage"],
        known_violations: &[("footprint/coverage_matched_gaussian", GAUSSIAN)],
    },
];

const THIN: &str = "a thin footprint of large area: alpha is 1 and the chord exceeds 1";

const CAMERA: &str = "fitted where cameras are, which see few footprints below h = 0.3";

const GAUSSIAN: &str =
    "a Gaussian stays one: 25 % too high at the centre of a chord, 44 % off at 0.9 h";

/// Values at (h, s), where A_P/A_C counts of a circle and of an ellipse 8 times as long as wide.
fn values(form: FormValues<'_>, h: &[f32], s: &[f32]) -> [Vec<f32>; 2] {
    [1.0, 8.0].map(|elongation| {
        let row = |(h, s): (&f32, &f32)| [*h, *s, elongation * h * h].map(f64::from);
        let rows: Vec<[f64; 3]> = h.iter().zip(s).map(row).collect();
        form(&table(["h", "s", "area_ratio"], &rows, "laws"))
    })
}

fn hard_points() -> (Vec<f32>, Vec<f32>) {
    let pairs = HALF_EXTENTS.iter().flat_map(|&h| offsets(h).into_iter().map(move |s| (h, s)));
    pairs.map(|(h, s)| (h as f32, s as f32)).unzip()
}

fn oddness(form: FormValues<'_>) -> f64 {
    let (h, s) = hard_points();
    let mirrored: Vec<f32> = s.iter().map(|s| -s).collect();
    let (here, there) = (values(form, &h, &s), values(form, &h, &mirrored));
    let difference = |(a, b): (&f32, &f32)| f64::from((a - b).abs());
    Law::worst(here.iter().flatten().zip(there.iter().flatten()).map(difference))
}

fn excess(form: FormValues<'_>) -> f64 {
    let (mut h, mut s) = hard_points();
    // Centres of footprints of every size.
    h.extend((0..=600).map(|i| 0.01 * 10_f32.powf(i as f32 / 120.0)));
    s.resize(h.len(), 0.0);
    let found = values(form, &h, &s);
    Law::worst(found.iter().flatten().map(|&v| f64::from(v - 1.0).max(f64::from(-v))))
}

fn largest_rise(form: FormValues<'_>) -> f64 {
    const STEPS: usize = 400;
    Law::worst(HALF_EXTENTS.into_iter().flat_map(|h| {
        let s: Vec<f32> =
            (0..=STEPS).map(|i| ((h + 6.0) * i as f64 / STEPS as f64) as f32).collect();
        let rise = |pair: &[f32]| f64::from(pair[1]) - f64::from(pair[0]);
        let found = values(form, &vec![h as f32; s.len()], &s);
        found.into_iter().map(|f| Law::worst(f.windows(2).map(rise))).collect::<Vec<_>>()
    }))
}

/// Largest |g(h, s) − exp(−`rate` s²)| at tiny h.
fn point_footprint(form: FormValues<'_>, rate: f64) -> f64 {
    let s = |_| (0..=100).map(|i| 0.05 * i as f32).collect();
    largest(form, [0.0, 1e-3], s, |v, _, s| (v - core_math::exp(-rate * s * s)).abs())
}

/// Largest |g(h, s)/(`centre`/h √(1 − s²/h²)) − 1| at large h.
fn large_footprint(form: FormValues<'_>, centre: f64) -> f64 {
    let s = |h| (0..=90).map(|i| 0.01 * i as f32 * h).collect();
    largest(form, [1000.0, 5000.0], s, |v, h, s| {
        let limit = centre * ((h - s) * (h + s)).sqrt() / (h * h);
        (v / limit - 1.0).abs()
    })
}

/// Largest `difference` of g(h, s), h and s over the offsets of two half-extents.
fn largest(
    form: FormValues<'_>,
    half_extents: [f32; 2],
    offsets: fn(f32) -> Vec<f32>,
    difference: impl Fn(f64, f64, f64) -> f64,
) -> f64 {
    Law::worst(half_extents.into_iter().flat_map(|h| {
        let s = offsets(h);
        let found = values(form, &vec![h; s.len()], &s);
        let all = found.iter().flat_map(|found| found.iter().zip(&s));
        all.map(|(&v, &s)| difference(v.into(), h.into(), s.into())).collect::<Vec<_>>()
    }))
}

#[cfg(test)]
mod tests {
    use super::super::reference::response;
    use super::*;
    use crate::table::Table;

    fn exact(points: &Table) -> Vec<f32> {
        let [h, s] = [0, 1].map(|at| points.columns[at].values.iter());
        h.zip(s).map(|(&h, &s)| response(h, s).expect("in the domain") as f32).collect()
    }

    #[test]
    fn the_exact_response_keeps_every_law() {
        for law in LAWS.iter().filter(|law| law.references.contains(&"footprint_response")) {
            let violation = (law.violation)(&exact);
            println!("{}: {violation:e}", law.name);
            assert!(violation <= law.tolerance, "{}: {violation:e}", law.name);
        }
    }

    #[test]
    fn forms_that_break_them_are_found() {
        let tilted = |points: &Table| {
            points.columns[1].values.iter().map(|s| (1.1 + 0.1 * s) as f32).collect()
        };
        for law in LAWS {
            assert!((law.violation)(&tilted) > law.tolerance, "{}", law.name);
            assert!((law.violation)(&|_| vec![f32::NAN]) > law.tolerance, "{}", law.name);
            assert!((law.violation)(&|_| Vec::new()) > law.tolerance, "{}", law.name);
        }
    }
}
