//! `list`: what there is, with one-line descriptions.

use clap::{Args, ValueEnum};
use serde::Serialize;
use serde_json::{Map, Value};

use super::Ending;
use super::context::Context;
use crate::document::{Cell, Column, Section, Table, number};
use crate::gate;
use crate::registry::Registry;
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
#[derive(Debug, Serialize)]
struct Listing {
    title: &'static str,
    header: &'static [&'static str],
    rows: Vec<Vec<String>>,
}

impl Listing {
    fn section(&self) -> Section {
        let caption = format!("{} ({})", self.title, self.rows.len());
        let table = Table::over(caption, &self.rows).columns(
            self.header.iter().enumerate(),
            |(_, title)| Column::text(**title),
            |row, (at, _)| Cell::text(row[*at].as_str()),
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
        many => Value::Object(
            many.iter().map(|l| (l.title.to_owned(), l.json())).collect::<Map<_, _>>(),
        ),
    };
    context.output.sections(&json, || listings.iter().map(Listing::section).collect())?;
    Ok(Ending::Done)
}

impl Kind {
    fn needs_project(self) -> bool {
        matches!(self, Self::Data | Self::Scenes | Self::Fits | Self::Gates)
    }

    fn listing(self, context: &Context) -> anyhow::Result<Listing> {
        let project = context.project_or_here();
        let registry = project.registry();
        Ok(match self {
            Self::Effects => effects(registry),
            Self::References => references(registry),
            Self::Forms => forms(registry),
            Self::Simulators => simulators(registry),
            Self::Data => data(context)?,
            Self::Scenes => scenes(context)?,
            Self::Fits => fits(context)?,
            Self::Gates => gates(context)?,
        })
    }
}

fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

fn effects(registry: &Registry) -> Listing {
    let rows = registry.effects().iter().map(|effect| row([effect.name, effect.title])).collect();
    Listing { title: "effects", header: &["name", "title"], rows }
}

fn references(registry: &Registry) -> Listing {
    let rows = registry.references().map(|reference| {
        let arguments = reference.arguments.iter();
        let arguments: Vec<String> =
            arguments.map(|a| format!("{} [{}] in {}", a.name, a.unit, a.domain)).collect();
        row([
            reference.name,
            &arguments.join(", "),
            reference.description,
            reference.accuracy,
            reference.source,
        ])
    });
    Listing {
        title: "references",
        header: &["name", "arguments", "description", "accuracy", "source"],
        rows: rows.collect(),
    }
}

fn forms(registry: &Registry) -> Listing {
    let rows = registry.forms().map(|form| {
        let reference = form.reference.as_deref().unwrap_or_default();
        row([&form.name, &form.function, reference, &form.description, &form.citation])
    });
    Listing {
        title: "forms",
        header: &["name", "function", "reference", "description", "citation"],
        rows: rows.collect(),
    }
}

fn simulators(registry: &Registry) -> Listing {
    let rows = registry.simulators().map(|simulator| {
        let settings: Vec<&str> = simulator.parameters.iter().map(|p| p.name).collect();
        row([simulator.name, simulator.description, &settings.join(", ")])
    });
    Listing {
        title: "simulators",
        header: &["name", "description", "settings"],
        rows: rows.collect(),
    }
}

fn data(context: &Context) -> anyhow::Result<Listing> {
    let project = context.project()?;
    let rows = super::data::sets(&project.data())?
        .into_iter()
        .map(|set| {
            let state = set.fault.unwrap_or_else(|| "complete".to_owned());
            row([&set.name, &set.files.to_string(), &state, &set.title])
        })
        .collect();
    Ok(Listing { title: "data", header: &["name", "files", "source", "description"], rows })
}

fn scenes(context: &Context) -> anyhow::Result<Listing> {
    let mut rows = Vec::new();
    for path in context.project()?.scenes()? {
        let scene = Scene::read(&path)?;
        let names: Vec<&str> = scene.approximations.iter().map(|of| of.name.as_str()).collect();
        rows.push(row([&scene.name, &names.join(", "), &scene.description]));
    }
    Ok(Listing { title: "scenes", header: &["name", "approximations", "description"], rows })
}

fn fits(context: &Context) -> anyhow::Result<Listing> {
    let rows = context
        .project()?
        .specs()?
        .into_iter()
        .map(|spec| row([&spec.name, &spec.state(), &spec.description()]))
        .collect();
    Ok(Listing { title: "fits", header: &["name", "result", "description"], rows })
}

fn gates(context: &Context) -> anyhow::Result<Listing> {
    let file = context.project()?.gates();
    let gates = if file.exists() { gate::read(&file)? } else { Vec::new() };
    let gates = gates.into_iter().map(|gate| {
        let domain = gate.domain.map_or_else(|| "as fitted".to_owned(), |d| d.to_string());
        let limit = number(gate.limit, 6);
        row([
            &gate.subject,
            gate.metric.name(),
            &gate.precision.to_string(),
            &domain,
            &limit,
            &gate.why,
        ])
    });
    Ok(Listing {
        title: "gates",
        header: &["subject", "metric", "precision", "domain", "limit", "why"],
        rows: gates.collect(),
    })
}
