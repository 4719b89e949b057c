//! An effect of one's own, judged and reported like those that are built in.
//!
//! `cargo run --example own_effect [DIR]` registers Smith's masking of GGX beside the built-in effects,
//! makes a project of the folder (a temporary one without it), fits a form there, judges what it finds,
//! writes the report to `DIR/reports/latest` and prints it.
//!
//! The masking function G₁ is the part of a rough surface's microfacets that is seen from a direction. By
//! Smith's assumption it is fixed by the distribution of slopes alone: what is seen, projected, must add up
//! to the surface, μ = G₁ ∫ max(0, ω·h) D(h) dh. Every microfacet model evaluates it for light and view.
//!
//! | symbol | name | unit | meaning |
//! |---|---|---|---|
//! | μ | `mu` | 1 | cosine between the direction and the mean normal |
//! | α | `alpha` | 1 | roughness of GGX, the slope within which half of the microfacets lie |
//! | k | `slope` α | 1 | Schlick's constant, proportional to α |

use std::error::Error;
use std::path::Path;

use striae::document::text::{self, Layout};
use striae::document::{Cell, Column, Page, Section, Table};
use striae::effect::claim::REPORT;
use striae::effect::{
    Candidates, Claim, ClaimError, DomainError, Effect, Evaluate, FormText, FormValues, Found, Law,
    Quantity, Reference, Region, arguments, points,
};
use striae::fit::{FitResult, Spec};
use striae::gate::Check;
use striae::numeric::measured::Measured;
use striae::numeric::statistics::rms;
use striae::project::Project;
use striae::registry::Registry;
use striae::run::{self, Job, Run, Studied};
use striae::table;

/// The effect: everything that the built-in ones are made of, in one value.
pub(crate) const EFFECT: Effect = Effect {
    name: "masking",
    title: "Smith masking of GGX",
    description: "The part of a rough surface's microfacets that is seen from a direction. Every \
                  microfacet model evaluates it for the light and for the view.",
    references: &[SMITH_MASKING],
    forms: || vec![FormText::new("examples/own_effect.rs/schlick.wgsl", SCHLICK)],
    regions: &[EVERY_ROUGHNESS],
    hard_cases: &[GRAZING],
    laws: &[END_POINTS],
    baselines: &["masking/schlick"],
    claims: &[HALF_OF_ALPHA],
    exhibits,
    ..Effect::EMPTY
};

const MU: Quantity = Quantity { name: "mu", unit: "1", domain: "[0, 1]" };
const ALPHA: Quantity = Quantity { name: "alpha", unit: "1", domain: "(0, 1]" };

const SMITH_MASKING: Reference = Reference {
    name: "smith_masking",
    description: "part of the microfacets of GGX that is seen from a direction",
    arguments: &[MU, ALPHA],
    unit: "1",
    accuracy: "relative error <= 1e-14 (tests/own_effect.rs, which integrates over the visible slopes)",
    source: "Walter et al., Microfacet models for refraction, EGSR 2007, eq. 34",
    evaluate: Evaluate::Scalar(|point| {
        let [mu, alpha] = arguments(point)?;
        smith_masking(mu, alpha)
    }),
};

/// Smith's masking function of GGX: G₁ = 2 / (1 + √(1 + α² tan² θ)), without the division by μ = cos θ.
///
/// # Errors
/// [`DomainError`] if `mu` is outside [0, 1] or `alpha` outside (0, 1].
pub(crate) fn smith_masking(mu: f64, alpha: f64) -> Result<f64, DomainError> {
    let outside = |Quantity { name, domain, .. }: Quantity, got| DomainError {
        quantity: name,
        expected: domain,
        got,
    };
    if !(0.0..=1.0).contains(&mu) {
        return Err(outside(MU, mu));
    }
    if !(alpha > 0.0 && alpha <= 1.0) {
        return Err(outside(ALPHA, alpha));
    }
    // (1 − μ)(1 + μ) keeps sin² θ exact where μ is close to 1; hypot neither overflows nor cancels.
    let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
    Ok(2.0 * mu / (mu + mu.hypot(alpha * sine)))
}

/// The approximation: its text says what it is, as in a file of `forms/`.
const SCHLICK: &str = "\
// approximates: smith_masking
// about: a rational function of the cosine, its constant proportional to the roughness
// cites: Schlick 1994 eq. 19; Karis 2013 for the factor 1/2

override slope: f32 = 0.5;

fn smith_masking(mu: f32, alpha: f32) -> f32 {
    let k = slope * alpha;
    return mu / (mu * (1.0 - k) + k);
}
";

const EVERY_ROUGHNESS: Region = Region {
    name: "every roughness",
    description: "cosines and roughnesses on the middles of a grid of 60 by 40 cells: none of them fitted",
    points: || {
        let middle = |i: u32, of: u32| (f64::from(i) + 0.5) / f64::from(of);
        let row = |i: u32| move |j: u32| [middle(i, 60), middle(j, 40)];
        let rows: Vec<[f64; 2]> = (0..60).flat_map(|i| (0..40).map(row(i))).collect();
        table_of(&rows, "every roughness")
    },
    ..Region::EMPTY
};

const GRAZING: Region = Region {
    name: "grazing",
    description: "cosines of 0, subnormal, tiny and 1 with their neighbours, at roughnesses from mirror to 1",
    points: || {
        let tiny = [0.0, 1e-45, 1e-38, 1e-20, 1e-6, 1e-3];
        let one = [1.0 - f64::from(f32::EPSILON) / 2.0, 1.0];
        let roughness = [1e-4, 1e-2, 0.5, 1.0];
        let mu = tiny.into_iter().chain(one);
        let rows: Vec<[f64; 2]> = mu.flat_map(|mu| roughness.map(|alpha| [mu, alpha])).collect();
        table_of(&rows, "grazing")
    },
    ..Region::EMPTY
};

fn table_of(rows: &[[f64; 2]], origin: &str) -> table::Table {
    points::rounded(points::of_rows([("mu", "1"), ("alpha", "1")], rows, origin.to_owned()))
}

const END_POINTS: Law = Law {
    name: "end points",
    description: "nothing is seen at grazing and everything from above: largest |G1(0)| and \
                  |G1(1) - 1| over 64 roughnesses. The tolerance is 2 ulp of 1, from 1 - k and its sum.",
    violation: |form: FormValues| {
        let alphas = (1..=64).map(|i| f64::from(i) / 64.0);
        let rows: Vec<[f64; 2]> = alphas.flat_map(|alpha| [[0.0, alpha], [1.0, alpha]]).collect();
        let values = form(&table_of(&rows, "end points"));
        Law::worst(values.iter().zip(&rows).map(|(v, [mu, _])| (f64::from(*v) - mu).abs()))
    },
    tolerance: 2.4e-7,
    ..Law::EMPTY
};

const HALF_OF_ALPHA: Claim<Candidates> = Claim {
    name: "half_of_alpha",
    place: "Karis, Real shading in Unreal Engine 4, SIGGRAPH 2013",
    printed: "k = alpha/2, so as to better fit the Smith model for GGX",
    command: REPORT,
    check: |candidates| {
        let half = root_mean_square(candidates, "masking/schlick")?;
        let best = root_mean_square(candidates, "masking/refit")?;
        let found = format!("RMS error {half:.4} with 1/2, {best:.4} at the least squares");
        let verdict = if half <= 1.1 * best { "holds" } else { "differs" };
        Ok(Found::new(found, verdict))
    },
};

/// RMS error of a candidate over [`EVERY_ROUGHNESS`].
fn root_mean_square(candidates: &Candidates, name: &str) -> Result<f64, ClaimError> {
    Ok(rms(&errors(candidates, name, &(EVERY_ROUGHNESS.points)())?))
}

/// Candidate minus reference, in f32 with the constants that ship.
fn errors(
    candidates: &Candidates,
    name: &str,
    points: &table::Table,
) -> Result<Vec<f64>, ClaimError> {
    let values = candidates.get(name)?.values_f32_at(points)?;
    let error = |(row, value): (usize, &f32)| {
        let at: Vec<f64> = points.columns.iter().map(|column| column.values[row]).collect();
        Ok(f64::from(*value) - SMITH_MASKING.value(&at)?)
    };
    values.iter().enumerate().map(error).collect()
}

/// What the page shows beyond what every page does: the error roughness by roughness.
fn exhibits(candidates: &Candidates) -> Result<Vec<Section>, ClaimError> {
    let mut rows = Vec::new();
    for alpha in [0.1, 0.25, 0.5, 0.75, 1.0] {
        let cosines = (0..200).map(|i| (f64::from(i) + 0.5) / 200.0);
        let line = table_of(&cosines.map(|mu| [mu, alpha]).collect::<Vec<_>>(), "one roughness");
        let of = |name| Ok::<_, ClaimError>(rms(&errors(candidates, name, &line)?));
        rows.push((alpha, of("masking/schlick")?, of("masking/refit")?));
    }
    let table = Table::over("RMS error over 200 cosines.", rows)
        .column(Column::number("alpha", "1"), |(alpha, ..)| Cell::number(*alpha, 3))
        .column(Column::number("k = alpha/2", "1"), |(_, half, _)| Cell::number(*half, 3))
        .column(Column::number("refitted", "1"), |(.., refit)| Cell::number(*refit, 3));
    Ok(vec![Section::new("Error by roughness").block(table)])
}

/// A fit of the form's constant, as it stands in a project.
const REFIT: &str = r#"description = "Schlick's constant over every roughness"
form = "masking/schlick"
target = "smith_masking"

[domain]
mu = { from = 0.0, to = 1.0, count = 61 }
alpha = { from = 0.025, to = 1.0, count = 40 }

[parameters]
slope = { start = 0.5, lower = 0.0, upper = 1.0 }
"#;

/// What was made of the effect in a project.
pub(crate) struct Made {
    /// The fit.
    pub(crate) fitted: FitResult,
    /// What was measured.
    pub(crate) studied: Studied,
    /// Verdicts of the project's gates, if it has any, and whether its constants come out again.
    pub(crate) check: Check,
    /// The index and the page of the effect, as written.
    pub(crate) pages: Vec<Page>,
    /// The files of the report.
    pub(crate) files: Vec<std::path::PathBuf>,
}

/// Registers the effect, and fits, judges and reports it in the project at `root`.
pub(crate) fn make(root: &Path) -> Result<Made, Box<dyn Error>> {
    let registry = Registry::builtin().clone().with_effect(&EFFECT)?;
    let spec = root.join("fits/masking/refit.toml");
    std::fs::create_dir_all(root.join("fits/masking"))?;
    std::fs::write(&spec, REFIT)?;
    let project = Project::open(root, &registry)?;

    // Without a device everything else is measured; with one (`run::device`) parity and cost are too.
    let run = Run::new(&project, Measured::NotMeasured("not asked for".to_owned()));
    let job = Job { spec: Spec::read(&spec)?, result: spec.with_extension("json") };
    let fitted = run::fit(&[job], &run.fits, &|_| ()).remove(0)?;
    let studied = run.studies(&[&EFFECT], &|_| ())?;
    let check = run.check_if_gated()?;
    let pages = run.effect_pages(&studied, &check)?;
    let files = run.report_on(&studied, &project.report(), &check, &|_| ())?.files;
    let [studied] = <[Studied; 1]>::try_from(studied).map_err(|_| "one effect was asked for")?;
    Ok(Made { fitted, studied, check, pages, files })
}

fn main() -> Result<(), Box<dyn Error>> {
    let temporary = tempfile::tempdir()?;
    let root = std::env::args_os().nth(1);
    let made = make(root.as_deref().map_or(temporary.path(), Path::new))?;
    for page in &made.pages {
        println!("{}\n", page.title);
        println!("{}", text::sections(&page.sections, Layout::terminal(100, false)));
    }
    for outcome in made.fitted.outcomes() {
        println!("{} is {}", outcome.name, outcome.status.words());
    }
    let (judged, files) = (made.studied.subjects.len(), made.files.len());
    println!("{judged} candidates judged, {files} files written");
    println!("what is held passes: {}", made.check.passed());
    Ok(())
}
