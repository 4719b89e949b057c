//! Properties that a mean over a footprint has, whatever the error of a form.

use super::regions::{HALF_EXTENTS, hard_offsets, table};
use crate::effect::{FormValues, Law, Violation};

/// Laws of the effect, by name.
pub(super) const LAWS: &[(&str, Violation)] = &[
    ("even", oddness),
    ("range", excess),
    ("falls", largest_rise),
    ("point footprint", |form| point_footprint(form, 1.0)),
    ("point footprint (coverage)", |form| point_footprint(form, 0.5)),
    ("large footprint", |form| large_footprint(form, std::f64::consts::FRAC_2_SQRT_PI)),
    ("large footprint (coverage)", |form| {
        large_footprint(form, (8.0 / std::f64::consts::PI).sqrt())
    }),
];

/// Values at (h, s), where A_P/A_C counts of a circle and of an ellipse 8 times as long as wide.
fn values(form: FormValues<'_>, h: &[f32], s: &[f32]) -> [Vec<f32>; 2] {
    [1.0, 8.0].map(|elongation| {
        let row = |(h, s): (&f32, &f32)| [*h, *s, elongation * h * h].map(f64::from);
        let rows: Vec<[f64; 3]> = h.iter().zip(s).map(row).collect();
        form(&table(["h", "s", "area_ratio"], &rows, "laws"))
    })
}

fn hard_points() -> (Vec<f32>, Vec<f32>) {
    let pairs = HALF_EXTENTS.iter().flat_map(|&h| hard_offsets(h).into_iter().map(move |s| (h, s)));
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
    use super::super::EFFECT;
    use super::super::line::Mean;
    use super::super::reference::{coverage, response};
    use crate::effects::assert_laws_bite;
    use crate::table::Table;

    fn exact(points: &Table, mean: Mean) -> Vec<f32> {
        let [h, s] = [0, 1].map(|at| points.columns[at].values.iter());
        h.zip(s).map(|(&h, &s)| mean(h, s).expect("in the domain") as f32).collect()
    }

    #[test]
    fn the_exact_means_keep_every_law_and_others_are_found() {
        let tilted = |points: &Table| {
            points.columns[1].values.iter().map(|s| (1.1 + 0.1 * s) as f32).collect()
        };
        for (reference, mean) in
            [("footprint_response", response as Mean), ("footprint_coverage", coverage)]
        {
            let laws = EFFECT.laws.iter().filter(|law| law.references.contains(&reference));
            assert_laws_bite(laws, &|points| exact(points, mean), &tilted);
        }
    }
}
