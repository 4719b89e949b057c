//! What is shown of the lights: error against the size of the light, the width of the lobe and the
//! direction of an edge, the cheapest form for an error, and the hard cases.

use super::columns::{sphere_row, table, triangle_row};
use super::draws::{Draw, limbs};
use super::errors::{exact, light_of, named, relative_l2, single};
use super::hard_exhibit::hard_cases;
use super::regions::{KS, REGIONS};
use super::{SPHERE, TRIANGLE};
use crate::document::plot::{Plot, PlotAxis, Series};
use crate::document::{Cell, Figure, PrintedTable, Section};
use crate::effect::{Candidates, ClaimError};

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
    let by_radius = figure(
        candidates,
        SPHERE,
        ("light-angular-radius", "k sigma = 250, the origin line anywhere across the sphere"),
        ("Error against the angular radius of a sphere", PlotAxis::log("angular radius", "rad")),
        &radii,
        |draw, radius| {
            let axis = draw.direction(0.2, 1.0);
            sphere_across(draw, axis, 250.0, radius)
        },
    )?;
    let lobes: Vec<f64> = (0..9).map(|i| 10.0 * 10_f64.powf(f64::from(i) * 0.3)).collect();
    let by_ks = figure(
        candidates,
        SPHERE,
        ("light-coherence", "angular radius 0.05 rad, the origin line anywhere across the sphere"),
        ("Error against the width of the lobe", PlotAxis::log("k sigma", "1")),
        &lobes,
        |draw, ks| {
            let axis = draw.direction(0.2, 1.0);
            sphere_across(draw, axis, ks, 0.05)
        },
    )?;
    let angles: Vec<f64> = (0..9).map(|i| 2.0 + 10.5 * f64::from(i)).collect();
    let by_angle = figure(
        candidates,
        TRIANGLE,
        (
            "light-edge-angle",
            "k sigma = 250, a large triangle with an edge through the mirror direction, at this angle to the \
             origin line",
        ),
        ("Error against the angle of an edge through the lobe", PlotAxis::linear("angle", "deg")),
        &angles,
        |draw, angle| edge_through(draw, 250.0, angle.to_radians()),
    )?;
    Ok(Section::new("Across the lobe: one slice or several")
        .paragraph(
            "velinov2018 integrates a light along the single line xi_1 = 0, since the Gaussian across it \
             is narrow (eq. 26). Relative L2 error of that line, of Gauss-Hermite nodes and of \
             Gauss-Legendre nodes placed in what the light covers of the Gaussian, over 60 draws of \
             light, view and scratch per abscissa, in f32.",
        )
        .block(by_radius)
        .block(by_ks)
        .block(by_angle))
}

fn figure<const N: usize>(
    candidates: &Candidates,
    of: &str,
    (stem, caption): (&str, &str),
    (title, x): (&str, PlotAxis),
    abscissae: &[f64],
    row: impl Fn(&mut Draw, f64) -> [f64; N],
) -> Result<Figure, ClaimError> {
    let mut draw = Draw::new(51);
    let rows: Vec<[f64; N]> =
        (0..abscissae.len() * DRAWS).map(|at| row(&mut draw, abscissae[at / DRAWS])).collect();
    let points = table(of, &rows, stem);
    let (light, reference) = light_of(&points);
    let exact = exact(reference, &points)?;
    let mut plot = Plot::new(title, x, PlotAxis::log("relative L2 error", "1"));
    for (across, name) in ACROSS.into_iter().filter(|(across, _)| has(light, across)) {
        let values = single(named(candidates, light, across)?, &points)?;
        let errors = values.chunks(DRAWS).zip(exact.chunks(DRAWS)).map(|(v, e)| relative_l2(v, e));
        let curve = abscissae.iter().copied().zip(errors);
        plot = plot.series(match across {
            "line_printed" => Series::dashed(name, curve),
            _ if across.starts_with("covered") => Series::line(name, curve).strong(),
            _ => Series::line(name, curve),
        });
    }
    Ok(Figure::new(stem, caption, plot))
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
const ASKED: [(f64, &str); 3] = [(0.1, "10 %"), (0.01, "1 %"), (0.001, "0.1 %")];

fn cheapest(candidates: &Candidates) -> Result<Section, ClaimError> {
    let mut columns = vec![("regime".to_owned(), ""), ("k sigma".to_owned(), "1")];
    columns.extend(ASKED.map(|(_, words)| (words.to_owned(), "")));
    columns.push(("single line, published Si".to_owned(), "1"));
    columns.extend(SLICES.map(|name| (name.replace("_medium", ""), "1")));
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
            row.extend(ASKED.map(|(limit, _)| {
                let mut known = SLICES.iter().zip(errors.iter().skip(1));
                let found = known.find(|(_, error)| error.is_some_and(|error| error <= limit));
                Cell::text(found.map_or("none".into(), |(name, _)| format!("`{name}`")))
            }));
            row.extend(errors.into_iter().map(|e| e.map_or("no such form".into(), Cell::from)));
            rows.push(row);
        }
    }
    let caption = "Cheapest form, by the number of slices, that stays below an error, and the relative L2 error of \
                   each: 80 draws per row, in f32";
    Ok(Section::new("The cheapest form for an error, by regime")
        .paragraph("Costs in time are those that `striae bench` measures.")
        .block(PrintedTable::of_rows(caption, columns, rows)))
}
