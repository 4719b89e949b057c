//! `list`: what there is, with one-line descriptions.

use clap::{Args, ValueEnum};
use serde_json::{Map, Value};

use super::Ending;
use super::context::Context;
use super::output::name;
use crate::document::{PrintedColumn, PrintedTable, Section, number};
use crate::effect::Reference;
use crate::gate::{self, Gate};
use crate::render::Scene;

/// List what there is: effects, references, forms, simulators, data, scenes, fits and gates
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  striae list\n  striae list forms --json")]
pub(super) struct Arguments {
    /// What to list [default: everything]
    kind: Option<Kind>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Physical things, one module each
    Effects,
    /// Exact quantities, for `eval` and as targets of fits
    References,
    /// Approximations, as registered by the effects
    Forms,
    /// What `simulate` makes tables of
    Simulators,
    /// Sets of measured data
    Data,
    /// What `render` renders
    Scenes,
    /// Specs and the state of their results
    Fits,
    /// Budgets in fits/gates.toml
    Gates,
}

/// One list: a header, and a row per thing.
#[derive(Debug)]
struct Listing {
    title: String,
    header: &'static [&'static str],
    rows: Vec<Vec<String>>,
}

impl Listing {
    fn section(&self) -> Section {
        let caption = format!("{} ({})", self.title, self.rows.len());
        let table = PrintedTable::over(caption, &self.rows).columns(
            self.header.iter().enumerate(),
            |(_, title)| PrintedColumn::text(**title),
            |row, (at, _)| row[*at].as_str(),
        );
        Section::default().block(table)
    }

    fn json(&self) -> Value {
        let object = |row: &Vec<String>| {
            let pairs = self.header.iter().zip(row);
            Value::Object(pairs.map(|(k, v)| ((*k).to_owned(), v.as_str().into())).collect())
        };
        Value::Array(self.rows.iter().map(object).collect())
    }
}

/// Prints one list, or all of them.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let kinds = match &arguments.kind {
        Some(kind) => std::slice::from_ref(kind),
        None => Kind::value_variants(),
    };
    let optional = arguments.kind.is_none() && !context.has_project();
    let mut listings = Vec::new();
    for kind in kinds {
        if !(optional && kind.needs_project()) {
            listings.push(kind.listing(context)?);
        }
    }
    let json = match listings.as_slice() {
        [one] => one.json(),
        many => {
            Value::Object(many.iter().map(|l| (l.title.clone(), l.json())).collect::<Map<_, _>>())
        }
    };
    context.output.sections(&json, || listings.iter().map(Listing::section).collect())
}

impl Kind {
    fn needs_project(self) -> bool {
        matches!(self, Self::Data | Self::Scenes | Self::Fits | Self::Gates)
    }

    fn listing(self, context: &Context) -> anyhow::Result<Listing> {
        let project = match self.needs_project() {
            true => context.project()?,
            false => &context.project_or_here(),
        };
        let registry = project.registry();
        let (header, rows): (&[&str], Vec<Vec<String>>) = match self {
            Self::Effects => {
                let rows = registry.effects().iter().map(|of| row([of.name, of.title]));
                (&["name", "title"], rows.collect())
            }
            Self::References => (
                &["name", "arguments", "description", "accuracy", "source"],
                registry.references().map(reference).collect(),
            ),
            Self::Forms => {
                let rows = registry.forms().map(|of| {
                    let reference = of.reference.as_deref().unwrap_or_default();
                    row([&of.name, &of.function, reference, &of.description, &of.citation])
                });
                (&["name", "function", "reference", "description", "citation"], rows.collect())
            }
            Self::Simulators => {
                let rows = registry.simulators().map(|of| {
                    let settings: Vec<&str> = of.parameters.iter().map(|p| p.name).collect();
                    row([of.name, of.description, &settings.join(", ")])
                });
                (&["name", "description", "settings"], rows.collect())
            }
            Self::Data => {
                let rows = super::data::sets(&project.data())?.into_iter().map(|set| {
                    let state = set.fault.unwrap_or_else(|| "complete".to_owned());
                    row([&set.name, &set.files.to_string(), &state, &set.title])
                });
                (&["name", "files", "source", "description"], rows.collect())
            }
            Self::Scenes => {
                let scenes = project.scenes()?.into_iter().map(|path| {
                    let of = Scene::read(&path)?;
                    let names: Vec<&str> =
                        of.approximations.iter().map(|of| of.name.as_str()).collect();
                    Ok(row([&of.name, &names.join(", "), &of.description]))
                });
                let rows = scenes.collect::<anyhow::Result<_>>()?;
                (&["name", "approximations", "description"], rows)
            }
            Self::Fits => {
                let specs = project.specs()?.into_iter();
                let rows = specs.map(|of| row([&of.name, &of.state(), &of.description()]));
                (&["name", "result", "description"], rows.collect())
            }
            Self::Gates => {
                let file = project.gates();
                let gates = if file.exists() { gate::read(&file)? } else { Vec::new() };
                (
                    &["subject", "metric", "precision", "domain", "limit", "why"],
                    gates.iter().map(budget).collect(),
                )
            }
        };
        Ok(Listing { title: name(self), header, rows })
    }
}

fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

fn reference(of: &Reference) -> Vec<String> {
    let arguments = of.arguments.iter();
    let arguments: Vec<String> =
        arguments.map(|of| format!("{} [{}] in {}", of.name, of.unit, of.domain)).collect();
    row([of.name, &arguments.join(", "), of.description, of.accuracy, of.source])
}

fn budget(of: &Gate) -> Vec<String> {
    let domain = of.domain.as_ref().map_or_else(|| "as fitted".to_owned(), ToString::to_string);
    let (precision, limit) = (of.precision.to_string(), number(of.limit, 6));
    row([&of.subject, of.metric.name(), &precision, &domain, &limit, &of.why])
}
