//! argmin's Brent minimisation, for one variable.

use argmin::core::{CostFunction, IterState};
use argmin::solver::brent::BrentOpt;
use nalgebra::DVector;

use super::attempt::{Attempt, BY_COST, BY_DERIVATIVES};
use super::scaled::{Scaled, give_up, iterations};
use crate::fit::problem::Problem;
use crate::form::FormError;

type Iteration = IterState<f64, (), (), (), (), f64>;

/// Most growths of the bracket.
const GROWTHS: u32 = 60;
/// Golden-section growth of a bracket.
const GROWTH: f64 = 1.618_033_988_749_895;

/// The cost along the only variable.
struct Line<'p, 'a>(Scaled<'p, 'a>);

impl CostFunction for Line<'_, '_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, z: &f64) -> Result<f64, argmin::core::Error> {
        self.0.cost(&DVector::from_element(1, *z))
    }
}

/// Runs Brent's method about `start`; `problem` has one variable.
pub(super) fn solve(
    problem: &Problem,
    start: &DVector<f64>,
    max_iterations: u64,
) -> Result<Attempt, FormError> {
    let line = Line(Scaled::columns(problem, start.clone())?);
    let cost = problem.best().map_or(1.0, |best| best.cost);
    let Some((low, high)) = give_up(bracket(&line, (2.0 * cost).sqrt().max(1e-12)))? else {
        return Attempt::judged(problem, start, 0, false, BY_DERIVATIVES);
    };
    let solver = BrentOpt::new(low, high).set_tolerance(1e-10, 1e-14 * (high - low));
    let begin = |state: Iteration| state.max_iters(max_iterations);
    let iterations = iterations(line, solver, begin)?.unwrap_or(0);
    Attempt::judged(problem, start, iterations, iterations >= max_iterations, BY_COST)
}

/// An interval about 0 that holds a minimum: grown downhill until the cost rises again.
fn bracket(line: &Line, step: f64) -> Result<(f64, f64), argmin::core::Error> {
    let here = line.cost(&0.0)?;
    let (mut at, mut cost) = (step, line.cost(&step)?);
    if cost > here {
        (at, cost) = (-step, line.cost(&-step)?);
        if cost > here {
            return Ok((-step, step));
        }
    }
    let mut behind = 0.0;
    for _ in 0..GROWTHS {
        let next = at + (at - behind) * GROWTH;
        let further = line.cost(&next)?;
        if further >= cost {
            return Ok((next.min(behind), next.max(behind)));
        }
        (behind, at, cost) = (at, next, further);
    }
    Ok((at.min(behind), at.max(behind)))
}
