//! Claims of toisoul2017.
use crate::effects::registry::{Finding, FittedConstants};
pub(super) fn findings(_: &FittedConstants) -> Vec<Finding> { Vec::new() }
