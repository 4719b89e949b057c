//! The points and values that a form is fitted to.

use super::error::FitError;
use super::loss::Loss;
use super::outcome::Residuals;
use super::sampling::{MOST_POINTS, tensor_product};
use super::spec::{SampledDomain, Spec, Weighting};
use crate::effect::{NoValue, Reference, ReferenceValues};
use crate::table::{Column, Table};

/// Column of a region's points that holds weights.
const WEIGHT: &str = "weight";

/// Whether the target carries noise that the residuals can be held against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Noise {
    /// A measured table: the residuals estimate its noise.
    Measured,
    /// An exact target: residuals are the model's error, not noise.
    Exact,
}

/// Points with the values wanted there.
#[derive(Debug, Clone, PartialEq)]
pub struct Points {
    /// Path or name of what they are from.
    pub label: String,
    /// Names of the inputs, those of the form in its order.
    pub names: Vec<String>,
    /// One column per input.
    pub columns: Vec<Vec<f64>>,
    /// The values wanted; of several outputs all rows of the first before those of the next.
    pub target: Vec<f64>,
    /// How many outputs have a target.
    pub outputs: usize,
    /// Weights of the squared residuals.
    pub weights: Option<Vec<f64>>,
    /// What the residuals mean.
    pub noise: Noise,
}

impl Points {
    /// `reference` over `domain`, at points rounded to f32: a form is called with f32, and its error
    /// is measured against the reference at that number.
    ///
    /// # Errors
    /// [`FitError::Spec`] at `key` if the domain misses an argument or has an unknown one;
    /// [`FitError::Domain`] where the reference has no value.
    pub fn of_reference(
        spec: &Spec,
        reference: &'static Reference,
        inputs: &[String],
        domain: &SampledDomain,
        key: &str,
    ) -> Result<Self, FitError> {
        let arguments: Vec<&str> = reference.arguments.iter().map(|q| q.name).collect();
        let known = |name: &str| arguments.contains(&name) || inputs.iter().any(|i| i == name);
        if let Some(stray) = domain.keys().find(|name| !known(name)) {
            let what = format!(
                "neither {} nor the form has this argument; expected {}",
                reference.name,
                arguments.join(", ")
            );
            return Err(spec.fault(&format!("{key}.{stray}"), what));
        }
        let mut names: Vec<String> = arguments.iter().map(|a| (*a).to_owned()).collect();
        names.extend(inputs.iter().filter(|i| !arguments.contains(&i.as_str())).cloned());
        let mut axes = Vec::with_capacity(names.len());
        for name in &names {
            let axis =
                domain.get(name).ok_or_else(|| spec.fault(key, format!("`{name}` is missing")))?;
            axes.push(axis.points().iter().map(|x| f64::from(*x as f32)).collect());
        }
        let product = axes.iter().try_fold(1, |rows: usize, axis: &Vec<f64>| {
            rows.checked_mul(axis.len()).filter(|rows| *rows <= MOST_POINTS)
        });
        if product.is_none() {
            return Err(
                spec.fault(key, format!("the arguments make more than {MOST_POINTS} points"))
            );
        }
        let columns = tensor_product(&axes);
        let arguments: Vec<&[f64]> =
            columns.iter().take(reference.arguments.len()).map(Vec::as_slice).collect();
        let target = match arguments.is_empty() {
            true => Vec::new(),
            false => reference.over(&arguments).map_err(|error| outside(reference, error))?,
        };
        let column_of = |input: &String| {
            let index = names.iter().position(|name| name == input);
            index.and_then(|index| columns.get(index)).cloned().unwrap_or_default()
        };
        let points = Self {
            label: reference.name.to_owned(),
            columns: inputs.iter().map(column_of).collect(),
            names: inputs.to_vec(),
            target,
            outputs: reference.outputs().len(),
            weights: None,
            noise: Noise::Exact,
        };
        points.check(spec.loss)?;
        Ok(points)
    }

    /// `reference` at the points of a region, rounded to f32; a column `weight` holds weights.
    ///
    /// # Errors
    /// [`FitError::Unusable`] for a column that is not there and for numbers that are not finite;
    /// [`FitError::Domain`] where the reference has no value.
    pub fn of_region(
        region: &'static str,
        points: &Table,
        reference: &'static Reference,
        values: &ReferenceValues,
        inputs: &[String],
        loss: Loss,
    ) -> Result<Self, FitError> {
        let mut table = points.clone();
        for column in table.columns.iter_mut().filter(|column| column.name != WEIGHT) {
            column.values.iter_mut().for_each(|value| *value = f64::from(*value as f32));
        }
        let columns = reference
            .arguments
            .iter()
            .map(|argument| table.require(argument.name).map(|column| column.values.as_slice()))
            .collect::<Result<Vec<_>, _>>()?;
        let target = values
            .at(reference, region, &columns)
            .map_err(|error| outside(reference, error))?
            .to_vec();
        let rows = table.rows().max(1);
        let names: Vec<String> =
            reference.outputs().iter().map(|o| format!("target {o}")).collect();
        for (name, values) in names.iter().zip(target.chunks(rows)) {
            table.columns.push(Column::new(name, "1", values.to_vec()));
        }
        let weight = match table.column(WEIGHT) {
            Some(_) => Weighting::Column(WEIGHT.to_owned()),
            None => Weighting::Equal,
        };
        Self::of_table(region, &table, inputs, &names.join(","), &weight, loss, Noise::Exact)
    }

    /// The rows of a table: the form's `inputs` and `column` are among its columns.
    ///
    /// # Errors
    /// [`FitError::Data`] for a column that is not there, [`FitError::Unusable`] for numbers that are
    /// not finite and weights that make no sense, by row.
    pub fn of_table(
        label: &str,
        table: &Table,
        inputs: &[String],
        column: &str,
        weight: &Weighting,
        loss: Loss,
        noise: Noise,
    ) -> Result<Self, FitError> {
        let named = |name: &str| -> Result<Vec<f64>, FitError> {
            let lacking =
                || format!("there is no column `{name}`; it has {}", table.names().join(", "));
            let column = table.column(name).ok_or_else(|| unusable(label, lacking()))?;
            Ok(column.values.clone())
        };
        // `y,z`: a target for each of several outputs.
        let targets: Vec<&str> = column.split(',').map(str::trim).collect();
        let joined = |columns: Vec<Vec<f64>>| columns.concat();
        let weights = match weight {
            Weighting::Equal => None,
            Weighting::Column(name) => {
                Some((name.clone(), joined(vec![named(name)?; targets.len()])))
            }
            Weighting::Uncertainty => {
                let of = |name: &&str| table.column(name)?.uncertainty.as_ref();
                let known: Vec<&Vec<f64>> = targets.iter().filter_map(of).collect();
                if !known.is_empty() && known.len() != targets.len() {
                    let what = format!("some of {column} have an uncertainty and some have none");
                    return Err(unusable(label, what));
                }
                let weight = |u: &&Vec<f64>| u.iter().map(|u| 1.0 / (u * u)).collect();
                let name = format!("u({column}), as weight");
                (!known.is_empty()).then(|| (name, joined(known.iter().map(weight).collect())))
            }
        };
        let target = targets.iter().map(|name| named(name)).collect::<Result<_, _>>()?;
        let points = Self {
            label: label.to_owned(),
            columns: inputs.iter().map(|input| named(input)).collect::<Result<_, _>>()?,
            names: inputs.to_vec(),
            target: joined(target),
            outputs: targets.len(),
            weights: weights.as_ref().map(|(_, values)| values.clone()),
            noise,
        };
        if let Some((name, values)) = &weights {
            if let Some(row) = values.iter().position(|w| !(w.is_finite() && *w >= 0.0)) {
                let what = format!("expected a finite weight ≥ 0, got {}", values[row]);
                return Err(points.fault(row, name, &what));
            }
            if values.iter().all(|w| *w == 0.0) {
                return Err(unusable(label, format!("column `{name}`: every weight is 0")));
            }
        }
        points.check(loss)?;
        Ok(points)
    }

    /// Residuals of `values` against the target.
    pub fn residuals(&self, values: &[f64]) -> Residuals {
        Residuals::measure(&self.columns, &self.names, values, &self.target)
    }

    /// Numbers that cannot be fitted to.
    fn check(&self, loss: Loss) -> Result<(), FitError> {
        let inputs = self.names.iter().map(String::as_str).zip(&self.columns);
        for (name, column) in inputs.chain([("target", &self.target)]) {
            if let Some(row) = column.iter().position(|x| !x.is_finite()) {
                let what = format!("expected a finite number, got {}", column[row]);
                return Err(self.fault(row, name, &what));
            }
        }
        if loss == Loss::Relative
            && let Some(row) = self.target.iter().position(|x| *x == 0.0)
        {
            return Err(self.fault(row, "target", "the relative loss has no value where it is 0"));
        }
        Ok(())
    }

    fn fault(&self, row: usize, column: &str, what: &str) -> FitError {
        let rows = self.target.len() / self.outputs.max(1);
        let row = row % rows.max(1) + 1;
        unusable(&self.label, format!("row {row}, column `{column}`: {what}"))
    }

    /// Checks that there are at least as many rows as free parameters.
    ///
    /// # Errors
    /// [`FitError::Unusable`] with both numbers.
    pub fn require_rows(&self, free: usize) -> Result<(), FitError> {
        let rows = self.target.len();
        if rows >= free.max(1) {
            return Ok(());
        }
        let what = format!("{free} free parameters need at least as many rows, got {rows}");
        Err(unusable(&self.label, what))
    }

    /// SHA-256 over the numbers and the text of the form.
    pub fn fingerprint(&self, form: &str) -> String {
        let columns = self.columns.iter().chain([&self.target]).chain(&self.weights);
        let mut bytes: Vec<u8> = columns.flatten().flat_map(|x| x.to_le_bytes()).collect();
        bytes.extend_from_slice(form.as_bytes());
        crate::table::store::sha256_hex(&bytes)
    }
}

fn unusable(origin: &str, what: String) -> FitError {
    FitError::Unusable { origin: origin.to_owned(), what }
}

fn outside(reference: &Reference, NoValue { source, .. }: NoValue) -> FitError {
    FitError::Domain { reference: reference.name.to_owned(), source }
}
