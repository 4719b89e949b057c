//! What is shown of the lights: error against the size of the light, the width of the lobe and the
//! direction of an edge, the cheapest form for an error, and the hard cases.

use super::columns::{SPHERE as SPHERE_COLUMNS, sphere_row, triangle_row};
use super::draws::{Draw, limbs};
use super::hard_exhibit::hard_cases;
use super::measured::{Loaded, Points, relative_l2};
use super::regions::{KS, REGIONS};
use super::{SPHERE, TRIANGLE};
use crate::effect::exhibit::{
    Exhibit, ExhibitAxis, ExhibitCell, ExhibitError, ExhibitPlot, ExhibitSeries, ExhibitTable,
    Stroke,
};
use crate::effect::{FittedConstants, Reference};

/// What is done across the slices, in order of the number of slices.
const ACROSS: [(&str, &str, Stroke); 8] = [
    ("line_printed", "single line, published Si", Stroke::Dashed),
    ("line_medium", "single line", Stroke::Line),
    ("hermite_three_medium", "3 Gauss-Hermite", Stroke::Line),
    ("covered_three_medium", "3 where covered", Stroke::Strong),
    ("hermite_five_medium", "5 Gauss-Hermite", Stroke::Line),
    ("covered_five_medium", "5 where covered", Stroke::Strong),
    ("covered_split_medium", "6 where covered", Stroke::Strong),
    ("hermite_seven_medium", "7 Gauss-Hermite", Stroke::Line),
];
/// Draws per abscissa of a plot.
const DRAWS: usize = 60;

/// Everything shown of the lights.
pub(in super::super) fn exhibits(fitted: &FittedConstants) -> Result<Vec<Exhibit>, ExhibitError> {
    Ok(vec![sweeps(fitted)?, cheapest(fitted)?, hard_cases(fitted)?])
}

fn sweeps(fitted: &FittedConstants) -> Result<Exhibit, ExhibitError> {
    let radii: Vec<f64> = (0..9).map(|i| 1e-3 * 10_f64.powf(f64::from(i) * 0.36)).collect();
    let by_radius = plot(
        fitted,
        ("sphere", &SPHERE),
        ("light-angular-radius", "Error against the angular radius of a sphere"),
        "k sigma = 250, the origin line anywhere across the sphere",
        ExhibitAxis { label: "angular radius", unit: "rad", log: true },
        &radii,
        |draw, radius| {
            let axis = draw.direction(0.2, 1.0);
            sphere_across(draw, axis, 250.0, radius)
        },
    )?;
    let lobes: Vec<f64> = (0..9).map(|i| 10.0 * 10_f64.powf(f64::from(i) * 0.3)).collect();
    let by_ks = plot(
        fitted,
        ("sphere", &SPHERE),
        ("light-coherence", "Error against the width of the lobe"),
        "angular radius 0.05 rad, the origin line anywhere across the sphere",
        ExhibitAxis { label: "k sigma", unit: "1", log: true },
        &lobes,
        |draw, ks| {
            let axis = draw.direction(0.2, 1.0);
            sphere_across(draw, axis, ks, 0.05)
        },
    )?;
    let angles: Vec<f64> = (0..9).map(|i| 2.0 + 10.5 * f64::from(i)).collect();
    let by_angle = plot(
        fitted,
        ("triangle", &TRIANGLE),
        ("light-edge-angle", "Error against the angle of an edge through the lobe"),
        "k sigma = 250, a large triangle with an edge through the mirror direction, at this angle to the \
         origin line",
        ExhibitAxis { label: "angle", unit: "deg", log: false },
        &angles,
        |draw, angle| edge_through(draw, 250.0, angle.to_radians()),
    )?;
    Ok(Exhibit {
        title: "Across the lobe: one slice or several".into(),
        text: vec![
            "velinov2018 integrates a light along the single line xi_1 = 0, since the Gaussian across it \
             is narrow (eq. 26). Relative L2 error of that line, of Gauss-Hermite nodes and of \
             Gauss-Legendre nodes placed in what the light covers of the Gaussian, over 60 draws of \
             light, view and scratch per abscissa, in f32."
                .into(),
        ],
        plots: vec![by_radius, by_ks, by_angle],
        tables: Vec::new(),
    })
}

fn plot<const N: usize>(
    fitted: &FittedConstants,
    (light, reference): (&str, &Reference),
    (stem, title): (&'static str, &str),
    caption: &str,
    x: ExhibitAxis,
    abscissae: &[f64],
    row: impl Fn(&mut Draw, f64) -> [f64; N],
) -> Result<ExhibitPlot, ExhibitError> {
    let mut draw = Draw::new(51);
    let rows: Vec<[f64; N]> =
        (0..abscissae.len() * DRAWS).map(|at| row(&mut draw, abscissae[at / DRAWS])).collect();
    let columns = (0..N).map(|k| rows.iter().map(|row| f64::from(row[k] as f32)).collect());
    let points = Points { columns: columns.collect() };
    let exact = points.exact(reference)?;
    let mut series = Vec::new();
    for (across, name, stroke) in ACROSS.into_iter().filter(|(across, ..)| has(light, across)) {
        let values = Loaded::new(&format!("{light}_{across}"), fitted)?.single(&points)?;
        let errors = values.chunks(DRAWS).zip(exact.chunks(DRAWS)).map(|(v, e)| relative_l2(v, e));
        series.push(ExhibitSeries {
            name: name.into(),
            points: abscissae.iter().copied().zip(errors).collect(),
            stroke,
        });
    }
    let y = ExhibitAxis { label: "relative L2 error", unit: "1", log: true };
    Ok(ExhibitPlot { stem, title: title.into(), caption: caption.into(), x, y, series })
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
const CANDIDATES: [&str; 7] = [
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

fn cheapest(fitted: &FittedConstants) -> Result<Exhibit, ExhibitError> {
    let mut columns: Vec<(String, &'static str)> =
        vec![("regime".into(), ""), ("k sigma".into(), "1")];
    columns.extend(ASKED.iter().map(|(_, words)| ((*words).to_owned(), "")));
    columns.push(("single line, published Si".into(), "1"));
    columns.extend(CANDIDATES.iter().map(|name| ((*name).replace("_medium", ""), "1")));
    let mut rows = Vec::new();
    for region in &REGIONS {
        let Some(fitted_points) = region.fitted else { continue };
        let points = Points::new(fitted_points());
        let (light, reference) = if points.columns.len() == SPHERE_COLUMNS.len() {
            ("sphere", &SPHERE)
        } else {
            ("triangle", &TRIANGLE)
        };
        let exact = points.exact(reference)?;
        let values = std::iter::once("line_printed")
            .chain(CANDIDATES)
            .map(|name| {
                let known =
                    has(light, name).then(|| Loaded::new(&format!("{light}_{name}"), fitted));
                known.transpose()?.map(|form| form.single(&points)).transpose()
            })
            .collect::<Result<Vec<_>, _>>()?;
        for ks in KS {
            let here: Vec<usize> =
                (0..exact.len()).filter(|&row| points.columns[1][row] == ks).collect();
            let pick = |all: &[f64]| here.iter().map(|&row| all[row]).collect::<Vec<f64>>();
            let errors: Vec<Option<f64>> = values
                .iter()
                .map(|all| all.as_ref().map(|all| relative_l2(&pick(all), &pick(&exact))))
                .collect();
            let mut row = vec![ExhibitCell::Text(region.name.into()), ExhibitCell::Number(ks)];
            row.extend(ASKED.iter().map(|(limit, _)| {
                let mut candidates = CANDIDATES.iter().zip(errors.iter().skip(1));
                let found =
                    candidates.find(|(_, error)| error.is_some_and(|error| error <= *limit));
                ExhibitCell::Text(found.map_or("none".into(), |(name, _)| format!("`{name}`")))
            }));
            row.extend(errors.into_iter().map(|error| {
                error.map_or(ExhibitCell::Text("no such form".into()), ExhibitCell::Number)
            }));
            rows.push(row);
        }
    }
    let caption = "Cheapest form, by the number of slices, that stays below an error, and the relative L2 error of \
                   each: 80 draws per row, in f32"
        .into();
    Ok(Exhibit {
        title: "The cheapest form for an error, by regime".into(),
        text: vec!["Costs in time are those that `striae bench` measures.".into()],
        plots: Vec::new(),
        tables: vec![ExhibitTable { caption, columns, rows }],
    })
}
