//! What a project holds for a gate to judge: candidates with their levers, and points with true values,
//! each made once.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;
use std::sync::Arc;

use super::cost::CostRatios;
use super::subject::{Instance, Lever, Subject};
use super::{Domain, Gate, GateError, Metric, Refits, ShippedConstants, Sources, reproduce};
use crate::effect::{Candidate, Effect, Member, Reference, Yardstick};
use crate::fit::Spec;
use crate::fit::outcome::Outcome;
use crate::fit::sampling::Sampling;
use crate::fit::spec::Target;
use crate::project::{Approximated, Subject as Standing};
use crate::table::{Column, Table};
use crate::validate::accuracy::{GroundTruth, Judged};
use crate::validate::regions::Atlas;
use crate::validate::sampling::{self, Interval};

/// The evidence of one check.
#[derive(Debug)]
pub(super) struct Evidence<'r> {
    pub(super) of: Sources<'r>,
    refits: Refits,
    families: BTreeMap<&'static str, Vec<Member>>,
    judged: BTreeMap<(&'static str, String), Arc<Judged>>,
    standing: BTreeMap<String, Found<Arc<Standing>>>,
    pub(super) costs: CostRatios,
}

/// Something, or why a gate on it fails.
pub(super) type Found<T> = Result<T, String>;

impl<'r> Evidence<'r> {
    pub(super) fn new(of: Sources<'r>, refits: Refits) -> Self {
        let (families, judged) = (BTreeMap::new(), BTreeMap::new());
        let (standing, costs) = (BTreeMap::new(), CostRatios::new());
        Self { of, refits, families, judged, standing, costs }
    }

    /// Fits that the subject of a gate takes its constants from.
    pub(super) fn sources(&self, gate: &Gate) -> Vec<String> {
        let (name, _) = parted(&gate.subject);
        let standing = self.standing.get(name).and_then(|found| found.as_ref().ok());
        match standing.and_then(|standing| standing.fitted.as_ref()) {
            Some(fitted) => fitted.spec.constants.clone(),
            None => {
                let entry = self.of.project.registry().form(name);
                entry.map_or_else(Vec::new, |entry| entry.constants_of.clone())
            }
        }
    }

    /// Form, constants, levers and held-out points of a gate; no points for a drift.
    pub(super) fn subject(&mut self, gate: &Gate) -> Result<Found<Subject>, GateError> {
        let (name, member) = parted(&gate.subject);
        let standing = match self.standing(gate, name)? {
            Ok(standing) => standing,
            Err(reason) => return Ok(Err(reason)),
        };
        let own_label = |name: &str| name.split_once('#').map_or("", |(_, label)| label).to_owned();
        let labelled: Vec<(String, &Candidate)> =
            match (&standing.approximates, &standing.candidates[..]) {
                (Approximated::Family(family), [one]) if standing.fitted.is_none() => {
                    let members = self.members(gate, family)?;
                    members.iter().map(|member| (member.label.clone(), one)).collect()
                }
                (_, all) => all.iter().map(|one| (own_label(&one.name), one)).collect(),
            };
        let labels: Vec<&str> = labelled.iter().map(|(label, _)| label.as_str()).collect();
        if member.is_some_and(|wanted| !labels.contains(&wanted)) {
            return Err(gate.no_member(&labels.join(", ")));
        }
        let outcomes = standing.fitted.as_ref().map_or(&[][..], |fitted| fitted.result.outcomes());
        let mut instances = Vec::new();
        for (at, (label, candidate)) in labelled.iter().enumerate() {
            if member.is_some_and(|wanted| wanted != label) {
                continue;
            }
            let target = match gate.metric {
                Metric::Drift => GroundTruth::none(),
                _ => self.target(gate, &standing, label, candidate)?,
            };
            gate.fits(&target)?;
            instances.push(Instance {
                label: (!label.is_empty()).then(|| label.clone()),
                candidate: (*candidate).clone(),
                target,
                levers: levers(outcomes.get(at), candidate),
            });
        }
        let shipped = match gate.metric {
            Metric::Drift if instances.len() != 1 => {
                Err("a family ships no single set of constants; name a member".to_owned())
            }
            Metric::Drift => self.shipped(gate).map(Some),
            _ => Ok(None),
        };
        Ok(shipped.map(|shipped| Subject { instances, shipped }))
    }

    /// The constants in the file of a gate on their drift.
    fn shipped(&self, gate: &Gate) -> Found<ShippedConstants> {
        let file = gate.shipped.as_deref().unwrap_or(Path::new(""));
        let shown = file.display().to_string();
        let text = std::fs::read_to_string(self.of.project.root().join(file));
        let text = text.map_err(|error| format!("{shown}: {error}"))?;
        Ok(ShippedConstants::read(&shown, &text))
    }

    /// The candidates called `name`: the committed result of a spec, where it stands, or a registered
    /// form by itself.
    pub(super) fn standing(
        &mut self,
        gate: &Gate,
        name: &str,
    ) -> Result<Found<Arc<Standing>>, GateError> {
        if let Some(known) = self.standing.get(name) {
            return Ok(known.clone());
        }
        let path = self.of.project.fits().join(format!("{name}.toml"));
        let found = if !name.contains("..") && path.is_file() {
            self.fitted(Spec::read(&path)?)?
        } else {
            let unknown = || gate.unknown(format!("there is no spec and no form `{name}`"));
            let entry = self.of.project.registry().form(name).ok_or_else(unknown)?;
            Ok(self.of.project.subject_of_form(entry)?.ok_or_else(unknown)?)
        };
        let found = found.map(Arc::new);
        self.standing.insert(name.to_owned(), found.clone());
        Ok(found)
    }

    fn fitted(&self, spec: Spec) -> Result<Found<Standing>, GateError> {
        let refit = self.refits.get(&spec.name);
        let result = match reproduce::committed(self.of.project.root(), &spec, refit)? {
            Ok(result) => result,
            Err(reason) => return Ok(Err(reason)),
        };
        let bad: Vec<String> = result
            .outcomes()
            .iter()
            .filter(|outcome| !reproduce::stands(outcome.status))
            .map(|outcome| format!("{} is {}", outcome.name, outcome.status.words()))
            .collect();
        if !bad.is_empty() {
            return Ok(Err(bad.join("; ")));
        }
        Ok(Ok(self.of.project.subject_of(spec, result)?))
    }

    fn target(
        &mut self,
        gate: &Gate,
        standing: &Standing,
        label: &str,
        candidate: &Candidate,
    ) -> Result<GroundTruth, GateError> {
        match &standing.approximates {
            Approximated::Reference(name) => Ok(self
                .judged(gate, standing.fitted.as_ref().map(|fitted| &fitted.spec), name)?
                .target(&candidate.form)?),
            Approximated::Family(name) => {
                let members = self.members(gate, name)?;
                let member =
                    members.iter().find(|member| member.label == label).ok_or_else(|| {
                        gate.fault(format!("the family `{name}` has no member `{label}`"))
                    })?;
                let rows = rows_inside(gate, &member.table)?;
                Ok(GroundTruth::of_table(&rows, &candidate.form)?)
            }
            Approximated::Table => match standing.fitted.as_ref().map(|fitted| &fitted.spec.target)
            {
                Some(Target::File { path, column, .. }) => {
                    let table = Table::read_csv(self.of.project.root().join(path))?;
                    let mut rows = rows_inside(gate, &table)?;
                    rename(&mut rows, column)?;
                    Ok(GroundTruth::of_table(&rows, &candidate.form)?)
                }
                _ => Err(gate.fault("its table is in no file".to_owned())),
            },
        }
    }

    /// The points of a gate on the reference called `name`, with its values.
    fn judged(
        &mut self,
        gate: &Gate,
        spec: Option<&Spec>,
        name: &str,
    ) -> Result<Arc<Judged>, GateError> {
        let found = self.of.project.registry().reference(name);
        let (effect, reference) =
            found.ok_or_else(|| gate.fault(format!("its target `{name}` is no reference")))?;
        match (&gate.domain, spec.and_then(|spec| spec.region.as_ref())) {
            (Some(Domain::Region(name)), _) | (None, Some(name)) => {
                return region(gate, effect, reference, name, self.of.atlas);
            }
            _ => {}
        }
        // All that the points are made of.
        let key =
            (reference.name, format!("{:?} {:?}", gate.domain, spec.map(|spec| &spec.domain)));
        if let Some(known) = self.judged.get(&key) {
            return Ok(Arc::clone(known));
        }
        let points = reference_points(gate, spec, effect, reference)?;
        let judged = Arc::new(Judged::new(reference, points, None, Yardstick::MaxAbs)?);
        self.judged.insert(key, Arc::clone(&judged));
        Ok(judged)
    }

    /// Held-out members of a family, made once.
    fn members(&mut self, gate: &Gate, name: &str) -> Result<&[Member], GateError> {
        let found = self.of.project.registry().family(name);
        let (_, family) =
            found.ok_or_else(|| gate.fault(format!("its target `{name}` is no family")))?;
        Ok(match self.families.entry(family.name) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert((family.members)(&self.of.project.data(), true)?),
        })
    }
}

/// `effect/name` and the label of `effect/name#label`.
pub(super) fn parted(subject: &str) -> (&str, Option<&str>) {
    subject.split_once('#').map_or((subject, None), |(name, member)| (name, Some(member)))
}

/// The free constants; those that were given where nothing is free; the output where there are none.
fn levers(outcome: Option<&Outcome>, candidate: &Candidate) -> Vec<Lever> {
    let parameters = candidate.form.parameters();
    let role = |name: &str| {
        let fitted = outcome.and_then(|outcome| outcome.parameters.get(name));
        fitted.map_or("fixed", |parameter| parameter.role.as_str())
    };
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
    spec: Option<&Spec>,
    effect: &Effect,
    reference: &Reference,
) -> Result<Table, GateError> {
    let mut constants: Vec<(&str, f64)> = Vec::new();
    let domain = match &gate.domain {
        Some(Domain::Box(domain)) => domain.clone(),
        _ => {
            let interval = |(argument, axis): (&String, &Sampling)| {
                let points = axis.points();
                let from = points.iter().copied().fold(f64::INFINITY, f64::min);
                let to = points.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                (from < to).then(|| Interval { argument: argument.clone(), from, to })
            };
            let axes = spec.into_iter().flat_map(|spec| &spec.domain);
            sampling::ArgumentBox { intervals: axes.filter_map(interval).collect() }
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
        let axis = spec.and_then(|spec| spec.domain.get(argument.name));
        let Some(Sampling::Constant(value)) = axis else {
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
    atlas: &Atlas,
) -> Result<Arc<Judged>, GateError> {
    let all = || effect.regions.iter().chain(effect.hard_cases);
    let region = all().find(|region| region.name == name).ok_or_else(|| {
        let known = all().map(|region| region.name).collect::<Vec<_>>().join(", ");
        gate.fault(format!("domain: {} has no region `{name}`; it has {known}", effect.name))
    })?;
    atlas
        .judged(region, reference)?
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
    let mut inside = table.clone();
    for column in &mut inside.columns {
        let mut keep = keep.iter();
        column.values.retain(|_| keep.next().is_some_and(|keep| *keep));
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
