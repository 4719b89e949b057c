//! What a project holds for a gate to judge: specs, committed results, points with true values.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::scene::Scenes;
use super::subject::{Instance, Lever, Subject};
use super::{Domain, Gate, GateError, Refits, committed};
use crate::effect::{Effect, Member, Reference, Yardstick};
use crate::fit::outcome::Outcome;
use crate::fit::sampling::Axis;
use crate::fit::spec::Target as SpecTarget;
use crate::fit::{FitResult, Spec};
use crate::registry;
use crate::table::{Column, Table};
use crate::validate::accuracy::{Judged, Shipped, Target};
use crate::validate::regions::judged;
use crate::validate::sampling::{self, Interval};

/// A project as gates see it.
#[derive(Debug)]
pub struct Evidence {
    root: PathBuf,
    refits: Refits,
    families: BTreeMap<&'static str, Vec<Member>>,
    scenes: Scenes,
}

/// A subject, or why the gate fails without being measured.
pub(super) type Found<T> = Result<T, String>;

impl Evidence {
    /// The project in the folder `root`, which holds `fits/` and `data/measured/`. `refits` tell
    /// results that are stale.
    pub fn new(root: PathBuf, refits: Refits) -> Self {
        Self { root, refits, families: BTreeMap::new(), scenes: Scenes::default() }
    }

    /// The project's folder.
    pub(super) fn root(&self) -> &std::path::Path {
        &self.root
    }

    /// The scenes named so far.
    pub(super) fn scenes(&mut self) -> &mut Scenes {
        &mut self.scenes
    }

    /// The spec that a gate's subject names, with the label of the member if it names one.
    pub(super) fn spec<'g>(&self, gate: &'g Gate) -> Result<(Spec, Option<&'g str>), GateError> {
        let (fit, member) = gate
            .subject
            .split_once('#')
            .map_or((gate.subject.as_str(), None), |(fit, member)| (fit, Some(member)));
        let path = self.root.join("fits").join(format!("{fit}.toml"));
        if fit.contains("..") || !path.is_file() {
            return Err(GateError::UnknownSubject {
                gate: gate.index,
                line: gate.line,
                subject: gate.subject.clone(),
            });
        }
        Ok((Spec::read(&path)?, member))
    }

    /// The committed results of `spec`, all of its members or the one called `member`; or why they
    /// cannot stand for it.
    pub(super) fn results(
        &self,
        gate: &Gate,
        spec: &Spec,
        member: Option<&str>,
    ) -> Result<Found<Vec<Outcome>>, GateError> {
        let refit = self.refits.get(&spec.name);
        let outcomes = match committed::result(&self.root, spec, refit)? {
            Ok(FitResult::Single(outcome)) => vec![*outcome],
            Ok(FitResult::Family(family)) => family.members,
            Err(reason) => return Ok(Err(reason)),
        };
        let outcomes: Vec<Outcome> = match member {
            None => outcomes,
            Some(label) => {
                let known: Vec<String> =
                    outcomes.iter().map(|outcome| label_of(outcome).to_owned()).collect();
                let found: Vec<Outcome> =
                    outcomes.into_iter().filter(|outcome| label_of(outcome) == label).collect();
                if found.is_empty() {
                    return Err(GateError::UnknownMember {
                        gate: gate.index,
                        line: gate.line,
                        subject: gate.subject.clone(),
                        known: known.join(", "),
                    });
                }
                found
            }
        };
        let bad: Vec<String> = outcomes
            .iter()
            .filter(|outcome| !committed::stands(outcome.status))
            .map(|outcome| format!("{} is {}", outcome.name, outcome.status.words()))
            .collect();
        Ok(if bad.is_empty() { Ok(outcomes) } else { Err(bad.join("; ")) })
    }

    /// Forms, constants and held-out points of a gate.
    pub(super) fn subject(&mut self, gate: &Gate) -> Result<Found<Subject>, GateError> {
        let (spec, member) = self.spec(gate)?;
        let outcomes = match self.results(gate, &spec, member)? {
            Ok(outcomes) => outcomes,
            Err(reason) => return Ok(Err(reason)),
        };
        let mut instances = Vec::new();
        for outcome in &outcomes {
            let shipped = Shipped::of(outcome, &self.root)?;
            let target = self.target(gate, &spec, outcome, &shipped)?;
            let label = outcome.name.contains('#').then(|| label_of(outcome).to_owned());
            let levers = levers(outcome, &shipped);
            instances.push(Instance { label, shipped, target, levers });
        }
        Ok(Ok(Subject { instances }))
    }

    fn target(
        &mut self,
        gate: &Gate,
        spec: &Spec,
        outcome: &Outcome,
        shipped: &Shipped,
    ) -> Result<Target, GateError> {
        match &spec.target {
            SpecTarget::Reference(name) => {
                let (effect, reference) = registry::reference(name)
                    .ok_or_else(|| gate.fault(format!("its target `{name}` is no reference")))?;
                let judged = match (&gate.domain, &spec.region) {
                    (Some(Domain::Region(name)), _) | (None, Some(name)) => {
                        region(gate, effect, reference, name)?
                    }
                    _ => {
                        let points = reference_points(gate, spec, effect, reference)?;
                        Arc::new(Judged::new(reference, points, None, Yardstick::MaxAbs)?)
                    }
                };
                Ok(judged.target(&shipped.form)?)
            }
            SpecTarget::Family(name) => {
                let label = label_of(outcome);
                let members = self.members(gate, name)?;
                let member =
                    members.iter().find(|member| member.label == label).ok_or_else(|| {
                        gate.fault(format!("the family `{name}` has no member `{label}`"))
                    })?;
                let rows = rows_inside(gate, &member.table)?;
                Ok(Target::of_table(&rows, &shipped.form)?)
            }
            SpecTarget::File { path, column, .. } => {
                let table = Table::read_csv(self.root.join(path))?;
                let mut rows = rows_inside(gate, &table)?;
                rename(&mut rows, column)?;
                Ok(Target::of_table(&rows, &shipped.form)?)
            }
            SpecTarget::Table { label, .. } => {
                Err(gate.fault(format!("its table `{label}` is in no file")))
            }
        }
    }

    fn members(&mut self, gate: &Gate, name: &str) -> Result<&[Member], GateError> {
        let (_, family) = registry::family(name)
            .ok_or_else(|| gate.fault(format!("its target `{name}` is no family")))?;
        if !self.families.contains_key(family.name) {
            let members = (family.members)(&self.root.join("data/measured"), true)?;
            self.families.insert(family.name, members);
        }
        Ok(self.families.get(family.name).map_or(&[], Vec::as_slice))
    }
}

/// The part of `effect/name#label` after the `#`; empty for a single fit.
pub(super) fn label_of(outcome: &Outcome) -> &str {
    outcome.name.split_once('#').map_or("", |(_, label)| label)
}

/// The free constants; the fixed ones where nothing is free; the output where there are none.
fn levers(outcome: &Outcome, shipped: &Shipped) -> Vec<Lever> {
    let parameters = shipped.form.parameters();
    let role = |name: &str| outcome.parameters.get(name).map_or("", |p| p.role.as_str());
    let with = |wanted: &str| -> Vec<Lever> {
        let places = |owner: &str| {
            let tied = format!("tied to {owner}");
            let moves = |name: &str| name == owner || role(name) == tied;
            (0..).zip(parameters).filter(|(_, p)| moves(&p.name)).map(|(at, _)| at).collect()
        };
        let owners = parameters.iter().filter(|parameter| role(&parameter.name) == wanted);
        let lever = |name: &String| Lever::Constant { places: places(name), name: name.clone() };
        owners.map(|parameter| lever(&parameter.name)).collect()
    };
    let free = with("free");
    let levers = if free.is_empty() { with("fixed") } else { free };
    if levers.is_empty() { vec![Lever::Output] } else { levers }
}

/// Points of a gate on a reference over a box.
fn reference_points(
    gate: &Gate,
    spec: &Spec,
    effect: &Effect,
    reference: &Reference,
) -> Result<Table, GateError> {
    let mut constants: Vec<(&str, f64)> = Vec::new();
    let domain = match &gate.domain {
        Some(Domain::Box(domain)) => domain.clone(),
        _ => {
            let interval = |(argument, axis): (&String, &Axis)| {
                let points = axis.points();
                let from = points.iter().copied().fold(f64::INFINITY, f64::min);
                let to = points.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                (from < to).then(|| Interval { argument: argument.clone(), from, to })
            };
            sampling::Domain { intervals: spec.domain.iter().filter_map(interval).collect() }
        }
    };
    for Interval { argument, .. } in &domain.intervals {
        if !reference.arguments.iter().any(|known| known.name == argument) {
            let known: Vec<&str> = reference.arguments.iter().map(|known| known.name).collect();
            return Err(gate.fault(format!(
                "domain: `{argument}` is no argument of {}; they are {}",
                reference.name,
                known.join(", ")
            )));
        }
    }
    for argument in reference.arguments {
        if domain.intervals.iter().any(|interval| interval.argument == argument.name) {
            continue;
        }
        let Some(Axis::Constant(value)) = spec.domain.get(argument.name) else {
            return Err(gate.fault(format!("domain: no interval for `{}`", argument.name)));
        };
        constants.push((argument.name, *value));
    }
    let hard_cases: Vec<Table> = effect.hard_cases.iter().map(|set| (set.points)()).collect();
    let mut points = sampling::points(&domain, &hard_cases);
    let rows = points.rows();
    for (name, value) in constants {
        points.columns.push(Column::new(name, "1", vec![value; rows]));
    }
    Ok(points)
}

/// A region or a set of hard cases that the effect names, with the values of `reference`.
fn region(
    gate: &Gate,
    effect: &Effect,
    reference: &'static Reference,
    name: &str,
) -> Result<Arc<Judged>, GateError> {
    let region = effect
        .regions
        .iter()
        .chain(effect.hard_cases)
        .find(|region| region.name == name)
        .ok_or_else(|| {
            let all = effect.regions.iter().chain(effect.hard_cases);
            let known: Vec<&str> = all.map(|region| region.name).collect();
            gate.fault(format!(
                "domain: {} has no region `{name}`; it has {}",
                effect.name,
                known.join(", ")
            ))
        })?;
    judged(region, reference)?
        .ok_or_else(|| gate.fault(format!("domain: {name} has no points for {}", reference.name)))
}

/// The rows of a table that lie in the gate's domain; all of them without one.
fn rows_inside(gate: &Gate, table: &Table) -> Result<Table, GateError> {
    let intervals = match &gate.domain {
        None => return Ok(table.clone()),
        Some(Domain::Box(domain)) => &domain.intervals,
        Some(Domain::Region(name)) => {
            return Err(gate.fault(format!("domain: a table has no region `{name}`")));
        }
    };
    let mut keep = vec![true; table.rows()];
    for interval in intervals {
        let column = table.require(&interval.argument)?;
        for (keep, value) in keep.iter_mut().zip(&column.values) {
            *keep &= (interval.from..=interval.to).contains(value);
        }
    }
    let kept = |values: &[f64]| -> Vec<f64> {
        values.iter().zip(&keep).filter(|(_, keep)| **keep).map(|(value, _)| *value).collect()
    };
    let mut inside = table.clone();
    for column in &mut inside.columns {
        column.values = kept(&column.values);
        column.uncertainty = None;
    }
    if inside.rows() == 0 {
        return Err(gate.fault(format!("domain: no row of {} lies in it", table.origin)));
    }
    Ok(inside)
}

/// Gives the target column the name that [`Target::of_table`] looks for.
fn rename(table: &mut Table, column: &str) -> Result<(), GateError> {
    table.require(column)?;
    table.columns.retain(|other| other.name == column || other.name != "value");
    for other in &mut table.columns {
        if other.name == column {
            other.name = "value".to_owned();
        }
    }
    Ok(())
}
