//! From a spec to a result.

use std::collections::BTreeMap;
use std::path::PathBuf;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::assemble::Assembly;
use super::error::FitError;
use super::inherit::inherit;
use super::loss::{Loss, factors};
use super::model::{FormModel, Model, Origin};
use super::outcome::{
    FamilyOutcome, Outcome, ParameterOutcome, Provenance, Residuals, StartOutcome, Status,
};
use super::problem::Problem;
use super::round_to_f32::{Shipped, round_to_f32};
use super::solve::{Ending, Solution, solve_from, starts};
use super::spec::{FormChoice, Spec, Target, Weighting};
use super::statistics::equioscillations;
use super::target::{Noise, Points, read_table};
use super::worth::Worth;
use crate::effect::{Effect, Reference, ReferenceValues};
use crate::form::Form;
use crate::registry::Registry;
use crate::table::store::sha256_hex;

/// Where a fit finds what its spec names: the project's folder, the registry, and values of
/// references that several fits of a run share.
#[derive(Debug)]
pub struct Context {
    /// The project's root: `fits/`, `data/measured` and relative paths of specs are below it.
    pub root: PathBuf,
    /// References, forms and families by name.
    pub registry: Registry,
    /// Values of references at fitted points.
    pub values: ReferenceValues,
}

impl Context {
    /// A context at `root` in which nothing has been evaluated.
    pub fn new(root: impl Into<PathBuf>, registry: &Registry) -> Self {
        Self { root: root.into(), registry: registry.clone(), values: ReferenceValues::default() }
    }
}

/// The result of a spec.
#[derive(Debug, Clone, PartialEq)]
pub enum FitResult {
    /// One fit.
    Single(Box<Outcome>),
    /// One fit per member of a family.
    Family(FamilyOutcome),
}

/// Runs a spec. The result is the same to the byte for every number of threads.
///
/// # Errors
/// [`FitError`] if the spec, the form and the target do not go together. A fit that ran and did not
/// converge is not an error: see [`Status`].
pub fn run_spec(spec: &Spec, context: &Context) -> Result<FitResult, FitError> {
    spec.check()?;
    let form = load_form(spec, context)?;
    let spec = &inherit(spec, &form, context)?;
    let fit = Fit::new(spec, &form)?;
    match &spec.target {
        Target::Reference(name) => {
            let (effect, reference) = context.registry.reference(name).ok_or_else(|| {
                unknown("reference", name, context.registry.references().map(|r| r.name))
            })?;
            let points = match &spec.region {
                Some(region) => fit.points_in(reference, effect, region, &context.values)?,
                None => fit.points_of(reference, &spec.domain, "domain")?,
            };
            let mut outside = BTreeMap::new();
            for (region, domain) in &spec.outside {
                let points = fit.points_of(reference, domain, &format!("outside.{region}"))?;
                outside.insert(region.clone(), points);
            }
            fit.single(&spec.name, reference.name, &points, &outside)
        }
        Target::File { path, column, weight } => {
            let table = read_table(&context.root, path)?;
            let label = path.display().to_string();
            fit.table(&label, &table, column, weight)
        }
        Target::Table { label, table, column, weight } => fit.table(label, table, column, weight),
        Target::Family(name) => fit.family(name, context),
    }
}

/// Loads the form of a spec.
///
/// # Errors
/// [`FitError::Unknown`], [`FitError::Io`] or [`FitError::Form`].
pub fn load_form(spec: &Spec, context: &Context) -> Result<Form, FitError> {
    match &spec.form {
        FormChoice::Registered(name) => {
            let registry = &context.registry;
            let entry = registry
                .form(name)
                .ok_or_else(|| unknown("form", name, registry.forms().map(|f| &f.name)))?;
            Ok(entry.load()?)
        }
        FormChoice::File { path, function } => {
            let origin = path.display().to_string();
            let source = std::fs::read_to_string(context.root.join(path))
                .map_err(|source| FitError::Io { path: origin.clone(), source })?;
            Ok(Form::parse(&origin, &source, function)?)
        }
        FormChoice::Text { origin, source, function } => Ok(Form::parse(origin, source, function)?),
    }
}

fn unknown<N: AsRef<str>>(
    kind: &'static str,
    name: &str,
    known: impl Iterator<Item = N>,
) -> FitError {
    let known: Vec<String> = known.map(|name| name.as_ref().to_owned()).collect();
    FitError::Unknown { kind, name: name.to_owned(), known: known.join(", ") }
}

/// A spec with its form and its parameters.
struct Fit<'a> {
    spec: &'a Spec,
    form: &'a Form,
    assembly: Assembly,
    inputs: Vec<String>,
}

impl<'a> Fit<'a> {
    fn new(spec: &'a Spec, form: &'a Form) -> Result<Self, FitError> {
        let assembly = Assembly::new(spec, form)?;
        if let Some(objection) = spec.solver.objection(spec.loss, assembly.free.len()) {
            return Err(spec.fault("solver.kind", objection));
        }
        Ok(Self { spec, form, assembly, inputs: form.input_columns() })
    }

    /// The outputs of the form that `points` have a target for: all of them for as many, else the one that
    /// the spec names.
    fn outputs(&self, points: &Points) -> Result<Vec<usize>, FitError> {
        let names = self.form.output_columns();
        if points.outputs > 1 {
            if self.spec.output.is_none() && names.len() == points.outputs {
                return Ok((0..names.len()).collect());
            }
            let what =
                format!("{} targets need as many outputs: {}", points.outputs, names.join(", "));
            return Err(self.spec.fault("output", what));
        }
        let output = match &self.spec.output {
            Some(name) => names.iter().position(|output| output == name),
            None => (names.len() == 1).then_some(0),
        };
        let wrong = || self.spec.fault("output", format!("expected one of {}", names.join(", ")));
        Ok(vec![output.ok_or_else(wrong)?])
    }

    fn points_of(
        &self,
        reference: &'static Reference,
        domain: &super::spec::Domain,
        key: &str,
    ) -> Result<Points, FitError> {
        Points::of_reference(self.spec, reference, &self.inputs, domain, key)
    }

    /// The points that `region` of `effect` gives to fits.
    fn points_in(
        &self,
        reference: &'static Reference,
        effect: &Effect,
        region: &str,
        values: &ReferenceValues,
    ) -> Result<Points, FitError> {
        let fitted = effect.regions.iter().filter_map(|r| Some((r.name, r.fitted?)));
        let found = fitted.clone().find(|(name, _)| *name == region);
        let Some((name, points)) = found else {
            let known: Vec<&str> = fitted.map(|(name, _)| name).collect();
            let what = format!(
                "{} has no region `{region}` with points to fit; it has {}",
                effect.name,
                if known.is_empty() { "none".to_owned() } else { known.join(", ") }
            );
            return Err(self.spec.fault("region", what));
        };
        Points::of_region(name, &points(), reference, values, &self.inputs, self.spec.loss)
    }

    fn single(
        &self,
        name: &str,
        target: &str,
        points: &Points,
        outside: &BTreeMap<String, Points>,
    ) -> Result<FitResult, FitError> {
        Ok(FitResult::Single(Box::new(self.outcome(name, target, points, outside)?)))
    }

    fn table(
        &self,
        label: &str,
        table: &crate::table::Table,
        column: &str,
        weight: &Weighting,
    ) -> Result<FitResult, FitError> {
        let (loss, noise) = (self.spec.loss, Noise::Measured);
        let points = Points::of_table(label, table, &self.inputs, column, weight, loss, noise)?;
        self.single(&self.spec.name, label, &points, &BTreeMap::new())
    }

    fn family(&self, name: &str, context: &Context) -> Result<FitResult, FitError> {
        let registry = &context.registry;
        let (_, family) = registry
            .family(name)
            .ok_or_else(|| unknown("family", name, registry.families().map(|f| f.name)))?;
        let members = (family.members)(&context.root.join("data/measured"), false)?;
        let outcomes: Vec<Outcome> = members
            .par_iter()
            .map(|member| {
                let points = Points::of_table(
                    &member.label,
                    &member.table,
                    &self.inputs,
                    "value",
                    &Weighting::Equal,
                    self.spec.loss,
                    Noise::Exact,
                )?;
                let name = format!("{}#{}", self.spec.name, member.label);
                self.outcome(&name, family.name, &points, &BTreeMap::new())
            })
            .collect::<Result<_, FitError>>()?;
        let hashes: String =
            outcomes.iter().map(|outcome| outcome.provenance.data_sha256.as_str()).collect();
        Ok(FitResult::Family(FamilyOutcome {
            schema: 1,
            name: self.spec.name.clone(),
            form: self.form_name(),
            family: family.name.to_owned(),
            members: outcomes,
            provenance: self.provenance(sha256_hex(hashes.as_bytes())),
        }))
    }

    fn form_name(&self) -> String {
        match &self.spec.form {
            FormChoice::Registered(name) => name.clone(),
            _ => self.form.origin().to_owned(),
        }
    }

    fn provenance(&self, data_sha256: String) -> Provenance {
        let spec = self.spec;
        let text = if spec.text.is_empty() { &spec.command } else { &spec.text };
        Provenance {
            striae: env!("CARGO_PKG_VERSION").to_owned(),
            spec_sha256: sha256_hex(text.as_bytes()),
            data_sha256,
            seed: spec.seed,
            command: spec.command.clone(),
        }
    }

    fn outcome(
        &self,
        name: &str,
        target: &str,
        points: &Points,
        outside: &BTreeMap<String, Points>,
    ) -> Result<Outcome, FitError> {
        let (spec, assembly) = (self.spec, &self.assembly);
        points.require_rows(assembly.free.len())?;
        let outputs = self.outputs(points)?;
        let model = self.model(points, &outputs)?;
        let factors = factors(spec.loss, &points.target, points.weights.as_deref());
        let solutions = self.solutions(points, &outputs, &factors)?;
        let evaluations = solutions.iter().map(|(_, s)| s.evaluations).sum();
        let start_outcomes = solutions.iter().map(|(start, s)| self.start_outcome(start, s));
        let start_outcomes: Vec<StartOutcome> = start_outcomes.collect();
        let Some((start, solution)) = best(solutions) else {
            return Err(spec.fault("solver.multi_start", "no start".into()));
        };

        let linear = model.linearise(&solution.constants)?;
        let residuals = DVector::from_iterator(
            factors.len(),
            linear.values.iter().zip(&points.target).zip(&factors).map(|((v, t), f)| (v - t) * f),
        );
        let entries = linear
            .derivatives
            .iter()
            .flat_map(|column| column.iter().zip(&factors).map(|(d, f)| d * f));
        let jacobian = DMatrix::from_iterator(factors.len(), assembly.free.len(), entries);
        let shipped = Shipped {
            form: self.form,
            origins: &assembly.origins,
            inputs: single_columns(&points.columns),
            outputs: &outputs,
            target: &points.target,
            factors: &factors,
            loss: spec.loss,
            bounds: &assembly.bounds,
        };
        let (constants_single, _) = round_to_f32(&shipped, &solution.constants, &jacobian)?;
        let scale =
            points.target.iter().zip(&factors).map(|(t, f)| (t * f).abs()).fold(0.0, f64::max);
        let worth = Worth::new(spec.loss, points, &solution, &jacobian, &residuals, scale);
        let finite = solution.constants.iter().chain(&linear.values).all(|x| x.is_finite());
        let parameters = self.parameters(&start, &solution, &constants_single, &worth);
        let measured = |values: &[f32], points: &Points| {
            let values: Vec<f64> = values.iter().map(|v| f64::from(*v)).collect();
            Residuals::measure(&points.columns, &points.names, &values, &points.target)
        };
        let mut beyond = BTreeMap::new();
        for (region, points) in outside {
            let there = Shipped {
                inputs: single_columns(&points.columns),
                target: &points.target,
                ..shipped
            };
            beyond.insert(region.clone(), measured(&there.values(&constants_single)?, points));
        }
        Ok(Outcome {
            schema: 1,
            name: name.to_owned(),
            form: self.form_name(),
            function: self.form.function().to_owned(),
            target: target.to_owned(),
            status: status(&solution, finite, worth.spread.condition.is_none()),
            solver: solution.solver.clone(),
            loss: spec.loss.name().to_owned(),
            iterations: solution.iterations,
            evaluations,
            parameters,
            correlation: worth.spread.correlation.clone(),
            correlation_order: worth.varying.iter().map(|i| assembly.free[*i].clone()).collect(),
            condition: worth.spread.condition,
            equioscillations: (spec.loss == Loss::Minimax && points.columns.len() == 1)
                .then(|| equioscillations(&points.columns[0], residuals.as_slice())),
            residuals: Residuals::measure(
                &points.columns,
                &points.names,
                &linear.values,
                &points.target,
            ),
            residuals_f32: measured(&shipped.values(&constants_single)?, points),
            outside: beyond,
            starts: start_outcomes,
            provenance: self.provenance(points.fingerprint(self.form.source())),
        })
    }

    fn model<'p>(
        &'p self,
        points: &'p Points,
        outputs: &'p [usize],
    ) -> Result<FormModel<'p>, FitError> {
        let origins = &self.assembly.origins;
        Ok(FormModel::new(self.form, &points.columns, outputs, origins)?)
    }

    /// The solution from each start, in order.
    fn solutions(
        &self,
        points: &Points,
        outputs: &[usize],
        factors: &[f64],
    ) -> Result<Vec<(Vec<f64>, Solution)>, FitError> {
        let (spec, assembly) = (self.spec, &self.assembly);
        starts(&assembly.start, &assembly.bounds, spec.multi_start, spec.seed)
            .into_par_iter()
            .map(|start| {
                let model = self.model(points, outputs)?;
                let problem = Problem::new(
                    &model,
                    &points.target,
                    factors.to_vec(),
                    spec.loss,
                    &assembly.bounds,
                    &start,
                );
                let solution = solve_from(&problem, spec.solver, spec.max_iterations)?;
                Ok((start, solution))
            })
            .collect()
    }

    fn start_outcome(&self, start: &[f64], solution: &Solution) -> StartOutcome {
        let finite = solution.cost.is_finite();
        StartOutcome {
            start: self.assembly.free.iter().cloned().zip(start.iter().copied()).collect(),
            cost: finite.then_some(solution.cost),
            status: status(solution, finite, false),
            solver: solution.solver.clone(),
        }
    }

    fn parameters(
        &self,
        start: &[f64],
        solution: &Solution,
        single: &[f32],
        worth: &Worth,
    ) -> BTreeMap<String, ParameterOutcome> {
        let assembly = &self.assembly;
        let parameter = |(index, name): (usize, &String)| {
            let shipped = assembly.value(index, single, |value| value as f32);
            let (bounds, stderr) = match assembly.origins[index] {
                Origin::Fixed(_) => (Default::default(), Err("fixed")),
                Origin::Free(free) => (assembly.bounds[free], worth.stderr(free)),
            };
            let outcome = ParameterOutcome {
                value: assembly.value(index, &solution.constants, |value| value),
                f32: shipped,
                f32_hex: format!("0x{:08x}", shipped.to_bits()),
                start: assembly.value(index, start, |value| value),
                lower: bounds.lower,
                upper: bounds.upper,
                role: assembly.roles[index].clone(),
                stderr: stderr.ok(),
                why_no_stderr: stderr.err().map(str::to_owned),
            };
            (name.clone(), outcome)
        };
        assembly.names.iter().enumerate().map(parameter).collect()
    }
}

fn single_columns(columns: &[Vec<f64>]) -> Vec<Vec<f32>> {
    columns.iter().map(|column| column.iter().map(|x| *x as f32).collect()).collect()
}

/// The solution with the lowest cost; of equals (to 1e-9) one that converged, then the first.
fn best(solutions: Vec<(Vec<f64>, Solution)>) -> Option<(Vec<f64>, Solution)> {
    let better = |new: &Solution, old: &Solution| {
        let lower = new.cost < old.cost * (1.0 - 1e-9) || !old.cost.is_finite();
        let as_low = new.cost <= old.cost * (1.0 + 1e-9);
        let converges = new.ending == Ending::Converged && old.ending != Ending::Converged;
        new.cost.is_finite() && (lower || as_low && converges)
    };
    solutions.into_iter().reduce(|old, new| if better(&new.1, &old.1) { new } else { old })
}

fn status(solution: &Solution, finite: bool, singular: bool) -> Status {
    match solution.ending {
        Ending::NonFinite => Status::NonFinite,
        _ if !finite || !solution.cost.is_finite() => Status::NonFinite,
        _ if singular => Status::Singular,
        Ending::IterationLimit => Status::HitIterationLimit,
        Ending::Stalled => Status::Stalled,
        Ending::Converged if !solution.at_bound.is_empty() => Status::AtBound,
        Ending::Converged => Status::Converged,
    }
}
