//! What is shown of the lights: error against the size of the light, the width of the lobe and the
//! direction of an edge, the cheapest form for an error, and the hard cases.

use super::draws::{Draw, limbs, sphere_row, table, triangle_row};
use super::errors::{exact, light_of, named, relative_l2, single};
use super::hard_exhibit::hard_cases;
use super::regions::{KS, REGIONS};
use super::{SPHERE, TRIANGLE};
use crate::document::plot::Series;
use crate::document::{Cell, Section};
use crate::effect::{Candidates, ClaimError, Exhibit};
use crate::effects::area_light::TEXTS;

/// What is done across the slices, in order of the number of slices.
const ACROSS: [(&str, &str); 8] = [
    ("line_printed", "single line, published Si"),
    ("line_medium", "single line"),
    ("hermite_three_medium", "3 Gauss-Hermite"),
    ("covered_three_medium", "3 where covered"),
    ("hermite_five_medium", "5 Gauss-Hermite"),
    ("covered_five_medium", "5 where covered"),
    ("covered_split_medium", "6 where covered"),
    ("hermite_seven_medium", "7 Gauss-Hermite"),
];
/// Draws per abscissa of a plot.
const DRAWS: usize = 60;

/// Everything shown of the lights.
pub(in super::super) fn exhibits(candidates: &Candidates) -> Result<Vec<Section>, ClaimError> {
    Ok(vec![sweeps(candidates)?, cheapest(candidates)?, hard_cases(candidates)?])
}

fn sweeps(candidates: &Candidates) -> Result<Section, ClaimError> {
    let radii: Vec<f64> = (0..9).map(|i| 1e-3 * 10_f64.powf(f64::from(i) * 0.36)).collect();
    let by_radius = curves(candidates, SPHERE, &radii, |draw, radius| {
        let axis = draw.direction(0.2, 1.0);
        sphere_across(draw, axis, 250.0, radius)
    })?;
    let lobes: Vec<f64> = (0..9).map(|i| 10.0 * 10_f64.powf(f64::from(i) * 0.3)).collect();
    let by_ks = curves(candidates, SPHERE, &lobes, |draw, ks| {
        let axis = draw.direction(0.2, 1.0);
        sphere_across(draw, axis, ks, 0.05)
    })?;
    let angles: Vec<f64> = (0..9).map(|i| 2.0 + 10.5 * f64::from(i)).collect();
    let by_angle = curves(candidates, TRIANGLE, &angles, |draw, angle| {
        edge_through(draw, 250.0, angle.to_radians())
    })?;
    let exhibit = Exhibit::of(TEXTS, "sweeps", &[]);
    Ok(exhibit.figure(by_radius).figure(by_ks).figure(by_angle).section())
}

/// Errors of what is done across the slices, over draws of a light for every abscissa.
fn curves<const N: usize>(
    candidates: &Candidates,
    reference: &str,
    abscissae: &[f64],
    row: impl Fn(&mut Draw, f64) -> [f64; N],
) -> Result<Vec<Series>, ClaimError> {
    let mut draw = Draw::new(51);
    let rows: Vec<[f64; N]> =
        (0..abscissae.len() * DRAWS).map(|at| row(&mut draw, abscissae[at / DRAWS])).collect();
    let points = table(reference, &rows, "draws for a figure");
    let (light, reference) = light_of(&points);
    let exact = exact(reference, &points)?;
    let curve = |(across, name): (&str, &str)| {
        let values = single(named(candidates, light, across)?, &points)?;
        let errors = values.chunks(DRAWS).zip(exact.chunks(DRAWS)).map(|(v, e)| relative_l2(v, e));
        let curve = abscissae.iter().copied().zip(errors);
        Ok(match across {
            "line_printed" => Series::dashed(name, curve),
            _ if across.starts_with("covered") => Series::line(name, curve).strong(),
            _ => Series::line(name, curve),
        })
    };
    ACROSS.into_iter().filter(|(across, _)| has(light, across)).map(curve).collect()
}

/// Whether there is such a form: only triangles have a middle vertex.
fn has(light: &str, across: &str) -> bool {
    light == "triangle" || across != "covered_split_medium"
}

/// A sphere with the origin line anywhere across it.
fn sphere_across(draw: &mut Draw, axis: [f64; 3], ks: f64, half_angle: f64) -> [f64; 8] {
    let [low, high] = limbs(axis, half_angle);
    let view_x = -draw.between(low, high);
    let view = [view_x, draw.view_y(view_x)];
    sphere_row(draw.kw(), ks, view, axis, half_angle.sin())
}

/// A triangle of sides of some 0.6 to one side of an edge through the mirror direction of the view.
fn edge_through(draw: &mut Draw, ks: f64, angle: f64) -> [f64; 13] {
    let [x, y, z] = draw.direction(0.5, 1.0);
    let side = draw.sign();
    let at = |along: f64, beside: f64| {
        let (sine, cosine) = angle.sin_cos();
        [x + side * (along * sine + beside * cosine), y + along * cosine - beside * sine, z]
    };
    let vertices =
        [at(-draw.between(0.2, 0.4), 0.0), at(draw.between(0.2, 0.4), 0.0), at(0.0, 0.5)];
    triangle_row(draw.kw(), ks, [-x, -y], vertices)
}

/// Forms in order of their number of slices: the first that reaches an error is the cheapest.
const SLICES: [&str; 7] = [
    "line_medium",
    "covered_three_medium",
    "hermite_three_medium",
    "covered_five_medium",
    "hermite_five_medium",
    "covered_split_medium",
    "hermite_seven_medium",
];
/// Errors asked for.
const ASKED: [f64; 3] = [0.1, 0.01, 0.001];

fn cheapest(candidates: &Candidates) -> Result<Section, ClaimError> {
    let columns = SLICES.map(|name| (name.replace("_medium", ""), "1".to_owned()));
    let mut rows = Vec::new();
    for (region, _, fitted) in REGIONS {
        let Some(fitted) = fitted else { continue };
        let points = fitted();
        let (light, reference) = light_of(&points);
        let exact = exact(reference, &points)?;
        let values = std::iter::once("line_printed")
            .chain(SLICES)
            .map(|name| {
                let known = has(light, name).then(|| named(candidates, light, name));
                known.transpose()?.map(|candidate| single(candidate, &points)).transpose()
            })
            .collect::<Result<Vec<_>, _>>()?;
        for ks in KS {
            let here: Vec<usize> =
                (0..exact.len()).filter(|&row| points.columns[1].values[row] == ks).collect();
            let pick = |all: &[f64]| here.iter().map(|&row| all[row]).collect::<Vec<f64>>();
            let errors: Vec<Option<f64>> = values
                .iter()
                .map(|all| all.as_ref().map(|all| relative_l2(&pick(all), &pick(&exact))))
                .collect();
            let mut row = vec![Cell::text(*region), ks.into()];
            row.extend(ASKED.map(|limit| {
                let mut known = SLICES.iter().zip(errors.iter().skip(1));
                let found = known.find(|(_, error)| error.is_some_and(|error| error <= limit));
                Cell::text(found.map_or("none".into(), |(name, _)| format!("`{name}`")))
            }));
            row.extend(errors.into_iter().map(|e| e.map_or("no such form".into(), Cell::from)));
            rows.push(row);
        }
    }
    Ok(Exhibit::of(TEXTS, "cheapest", &[]).wider_table(columns, rows).section())
}
