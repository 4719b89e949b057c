//! A fit as solvers see it: residuals and their Jacobian in unbounded variables.

use std::cell::{Cell, RefCell};

use nalgebra::{DMatrix, DVector};

use super::bounds::{Bounds, Transform};
use super::loss::Loss;
use super::model::FormModel;
use crate::form::FormError;

/// The best point that has been seen.
#[derive(Debug, Clone)]
pub struct Best {
    /// Variables.
    pub variables: DVector<f64>,
    /// Its cost, finite.
    pub cost: f64,
}

/// Residuals of a [`FormModel`] against a target, in one unbounded variable per free constant.
///
/// The constants in `pinned` keep their value; the others are the variables, in order. Every
/// evaluation is counted and the best point is remembered, whatever the solver does with it.
pub struct Problem<'a> {
    model: &'a FormModel<'a>,
    target: &'a [f64],
    pub(super) factors: Vec<f64>,
    pub(super) loss: Loss,
    /// One per free constant.
    pub(super) transforms: Vec<Transform>,
    constants: Vec<f64>,
    active: Vec<usize>,
    evaluations: Cell<u64>,
    best: RefCell<Option<Best>>,
}

impl<'a> Problem<'a> {
    /// `factors` multiply the residuals ([`super::loss::factors`]); `bounds` and `start` have one
    /// entry per free constant, the start within the bounds.
    pub fn new(
        model: &'a FormModel<'a>,
        target: &'a [f64],
        factors: Vec<f64>,
        loss: Loss,
        bounds: &[Bounds],
        start: &[f64],
    ) -> Self {
        let transforms =
            bounds.iter().zip(start).map(|(b, s)| Transform::new(*b, *s)).collect::<Vec<_>>();
        Self {
            model,
            target,
            factors,
            loss,
            transforms,
            constants: start.to_vec(),
            active: (0..start.len()).collect(),
            evaluations: Cell::new(0),
            best: RefCell::new(None),
        }
    }

    /// This problem with other factors and another loss.
    pub fn with_loss(&self, loss: Loss, factors: Vec<f64>) -> Self {
        Self { loss, factors, ..self.fresh() }
    }

    /// This problem from `constants`, of which those in `pinned` do not vary.
    pub fn pinned(&self, constants: Vec<f64>, pinned: &[usize]) -> Self {
        let active = (0..constants.len()).filter(|i| !pinned.contains(i)).collect();
        Self { constants, active, ..self.fresh() }
    }

    /// This problem from `constants`, without bounds.
    pub fn unbounded(&self, constants: Vec<f64>) -> Self {
        let transforms = vec![Transform::Identity; constants.len()];
        Self { constants, transforms, ..self.fresh() }
    }

    /// This problem, with nothing counted and nothing remembered.
    pub fn fresh(&self) -> Self {
        Self {
            model: self.model,
            target: self.target,
            factors: self.factors.clone(),
            loss: self.loss,
            transforms: self.transforms.clone(),
            constants: self.constants.clone(),
            active: self.active.clone(),
            evaluations: Cell::new(0),
            best: RefCell::new(None),
        }
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.active.len()
    }
    /// Number of points.
    pub fn points(&self) -> usize {
        self.target.len()
    }
    /// Norm of the target with its factors: what a residual is small against.
    pub fn magnitude(&self) -> f64 {
        let square = |(y, f): (&f64, &f64)| (y * f) * (y * f);
        self.target.iter().zip(&self.factors).map(square).sum::<f64>().sqrt()
    }
    /// Evaluations over all points so far.
    pub fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }
    /// Adds the evaluations of a problem derived from this one.
    pub fn count(&self, evaluations: u64) {
        self.evaluations.set(self.evaluations.get() + evaluations);
    }
    /// The best point seen, if any had a finite cost.
    pub fn best(&self) -> Option<Best> {
        self.best.borrow().clone()
    }

    /// The variables of the start.
    pub fn start(&self) -> DVector<f64> {
        let variable = |i: &usize| self.transforms[*i].variable(self.constants[*i]);
        DVector::from_iterator(self.active.len(), self.active.iter().map(variable))
    }

    /// All free constants, pinned ones included, for given variables.
    pub fn constants(&self, variables: &DVector<f64>) -> Vec<f64> {
        let mut constants = self.constants.clone();
        for (i, u) in self.active.iter().zip(variables.iter()) {
            constants[*i] = self.transforms[*i].constant(*u);
        }
        constants
    }

    /// Residuals with their factors, before the loss.
    ///
    /// # Errors
    /// [`FormError`] from the model.
    pub fn residuals(&self, variables: &DVector<f64>) -> Result<Vec<f64>, FormError> {
        self.evaluations.set(self.evaluations.get() + 1);
        let mut values = self.model.values(&self.constants(variables))?;
        self.weigh(&mut values);
        self.remember(variables, self.loss.cost(&values));
        Ok(values)
    }

    /// The cost at `variables`; not finite where the form is not.
    ///
    /// # Errors
    /// [`FormError`] from the model.
    pub fn cost(&self, variables: &DVector<f64>) -> Result<f64, FormError> {
        Ok(self.loss.cost(&self.residuals(variables)?))
    }

    /// Pseudo-residuals ([`Loss::pseudo`]) and their Jacobian by the variables.
    ///
    /// # Errors
    /// [`FormError`] from the model.
    pub fn linearise(
        &self,
        variables: &DVector<f64>,
    ) -> Result<(DVector<f64>, DMatrix<f64>), FormError> {
        self.evaluations.set(self.evaluations.get() + 1);
        let mut linear = self.model.linearise(&self.constants(variables))?;
        self.weigh(&mut linear.values);
        self.remember(variables, self.loss.cost(&linear.values));
        let mut entries = Vec::with_capacity(self.points() * self.variables());
        for i in &self.active {
            entries.extend(linear.derivatives[*i].iter().zip(&self.factors).map(|(d, f)| d * f));
        }
        let mut residuals = DVector::from_vec(linear.values);
        let mut jacobian = DMatrix::from_vec(self.points(), self.variables(), entries);
        for (column, (i, u)) in self.active.iter().zip(variables.iter()).enumerate() {
            let slope = self.transforms[*i].slope(*u);
            if slope != 1.0 {
                jacobian.column_mut(column).scale_mut(slope);
            }
        }
        if matches!(self.loss, Loss::Huber { .. }) {
            for (row, r) in residuals.iter_mut().enumerate() {
                let (pseudo, slope) = self.loss.pseudo(*r);
                *r = pseudo;
                jacobian.row_mut(row).scale_mut(slope);
            }
        }
        Ok((residuals, jacobian))
    }

    fn weigh(&self, values: &mut [f64]) {
        for ((value, target), factor) in values.iter_mut().zip(self.target).zip(&self.factors) {
            *value = (*value - target) * factor;
        }
    }

    fn remember(&self, variables: &DVector<f64>, cost: f64) {
        let mut best = self.best.borrow_mut();
        if cost.is_finite() && best.as_ref().is_none_or(|b| cost < b.cost) {
            *best = Some(Best { variables: variables.clone(), cost });
        }
    }
}
