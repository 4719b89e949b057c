//! From a spec to a result.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::assemble::Assembly;
use super::context::Context;
use super::error::FitError;
use super::loss::{Loss, factors};
use super::model::{FormModel, Origin};
use super::outcome::{
    FamilyOutcome, FitProvenance, Outcome, ParameterOutcome, StartOutcome, Status,
};
use super::problem::Problem;
use super::result_file::FitResult;
use super::round_to_f32::{Shipped, round_to_f32};
use super::solve::{Solution, Termination, solve_from, starts};
use super::spec::{FormChoice, SampledDomain, Spec, Target, Weighting};
use super::statistics::{Worth, equioscillations};
use super::target::{Noise, Points};
use crate::effect::{Effect, Reference, ReferenceValues};
use crate::form::Form;
use crate::table::Table;
use crate::table::store::sha256_hex;

/// Runs a spec. The result is the same to the byte for every number of threads.
///
/// # Errors
/// [`FitError`] if the spec, the form and the target do not go together. A fit that ran and did not
/// converge is not an error: see [`Status`].
pub fn run_spec(spec: &Spec, context: &Context) -> Result<FitResult, FitError> {
    spec.check()?;
    let form = context.form(&spec.form)?;
    let spec = &context.inherit(spec, &form)?;
    let fit = Fit::new(spec, &form)?;
    let (label, points, outside) = match &spec.target {
        Target::Family(name) => return fit.family(name, context),
        Target::Reference(name) => fit.of_reference(name, context)?,
        Target::File { path, column, weight } => {
            let table = Table::read_csv(context.root.join(path))?;
            fit.of_table(&path.display().to_string(), &table, column, weight)?
        }
        Target::Table { label, table, column, weight } => {
            fit.of_table(label, table, column, weight)?
        }
    };
    let outcome = fit.outcome(&spec.name, &label, &points, &outside)?;
    Ok(FitResult::Single(Box::new(outcome)))
}

/// Name of what is fitted to, the points, and those of the regions beyond them.
type Aims = (String, Points, BTreeMap<String, Points>);

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

    /// The points of a reference, by the name of what is fitted to, and those beyond them.
    fn of_reference(&self, name: &str, context: &Context) -> Result<Aims, FitError> {
        let Self { spec, inputs, .. } = self;
        let (effect, reference) = context.reference(name)?;
        let sampled = |domain: &SampledDomain, key: &str| {
            Points::of_reference(spec, reference, inputs, domain, key)
        };
        let points = match &spec.region {
            Some(region) => self.points_in(reference, effect, region, &context.values)?,
            None => sampled(&spec.domain, "domain")?,
        };
        let beyond = |(region, domain): (&String, &SampledDomain)| {
            Ok((region.clone(), sampled(domain, &format!("outside.{region}"))?))
        };
        let outside = spec.outside.iter().map(beyond).collect::<Result<_, FitError>>()?;
        Ok((reference.name.to_owned(), points, outside))
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

    /// The rows of a measured table.
    fn of_table(
        &self,
        label: &str,
        table: &Table,
        column: &str,
        weight: &Weighting,
    ) -> Result<Aims, FitError> {
        let (loss, noise) = (self.spec.loss, Noise::Measured);
        let points = Points::of_table(label, table, &self.inputs, column, weight, loss, noise)?;
        Ok((label.to_owned(), points, BTreeMap::new()))
    }

    fn family(&self, name: &str, context: &Context) -> Result<FitResult, FitError> {
        let family = context.family(name)?;
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

    fn provenance(&self, data_sha256: String) -> FitProvenance {
        let spec = self.spec;
        let text = if spec.text.is_empty() { &spec.command } else { &spec.text };
        FitProvenance {
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
        let model = FormModel::new(self.form, &points.columns, &outputs, &assembly.origins)?;
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
        let constants_single = round_to_f32(&shipped, &solution.constants, &jacobian)?;
        let scale =
            points.target.iter().zip(&factors).map(|(t, f)| (t * f).abs()).fold(0.0, f64::max);
        let worth = Worth::new(spec.loss, points, &solution, &jacobian, &residuals, scale);
        let finite = solution.constants.iter().chain(&linear.values).all(|x| x.is_finite());
        let parameters = self.parameters(&start, &solution, &constants_single, &worth);
        let measured = |values: &[f32], points: &Points| {
            points.residuals(&values.iter().map(|v| f64::from(*v)).collect::<Vec<f64>>())
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
            status: status(&solution, finite, worth.covariance.is_none()),
            solver: solution.solver.clone(),
            loss: spec.loss.name().to_owned(),
            iterations: solution.iterations,
            evaluations,
            parameters,
            correlation: worth.covariance.as_ref().map(|of| of.correlation.clone()),
            correlation_order: worth.varying.iter().map(|i| assembly.free[*i].clone()).collect(),
            condition: worth.covariance.as_ref().map(|of| of.condition),
            equioscillations: (spec.loss == Loss::Minimax && points.columns.len() == 1)
                .then(|| equioscillations(&points.columns[0], residuals.as_slice())),
            residuals: points.residuals(&linear.values),
            residuals_f32: measured(&shipped.values(&constants_single)?, points),
            outside: beyond,
            starts: start_outcomes,
            provenance: self.provenance(points.fingerprint(self.form.source())),
        })
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
                let model = FormModel::new(self.form, &points.columns, outputs, &assembly.origins)?;
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
        let converges =
            new.termination == Termination::Converged && old.termination != Termination::Converged;
        new.cost.is_finite() && (lower || as_low && converges)
    };
    solutions.into_iter().reduce(|old, new| if better(&new.1, &old.1) { new } else { old })
}

fn status(solution: &Solution, finite: bool, singular: bool) -> Status {
    match solution.termination {
        Termination::NonFinite => Status::NonFinite,
        _ if !finite || !solution.cost.is_finite() => Status::NonFinite,
        _ if singular => Status::Singular,
        Termination::IterationLimit => Status::HitIterationLimit,
        Termination::Stalled => Status::Stalled,
        Termination::Converged if !solution.at_bound.is_empty() => Status::AtBound,
        Termination::Converged => Status::Converged,
    }
}
