//! The parameters of a spec brought together with those of a form.

use std::collections::BTreeMap;

use super::bounds::Bounds;
use super::error::FitError;
use super::model::Origin;
use super::spec::{ParameterChoice, Spec, Unnamed, start_fault};
use crate::form::Form;

/// What becomes of every `override` of a form.
#[derive(Debug, Clone)]
pub(super) struct Assembly {
    /// Names, in the order of the form.
    pub(super) names: Vec<String>,
    /// Where their values come from, in the order of the form.
    pub(super) origins: Vec<Origin>,
    /// `free`, `fixed` or `tied to …`, in the order of the form.
    pub(super) roles: Vec<String>,
    /// Names of the free constants.
    pub(super) free: Vec<String>,
    /// Their starts.
    pub(super) start: Vec<f64>,
    /// Their bounds.
    pub(super) bounds: Vec<Bounds>,
}

impl Assembly {
    /// Resolves every parameter.
    ///
    /// # Errors
    /// [`FitError::Spec`] for a parameter that only one of spec and form has, a start outside its
    /// bounds, a missing start, and if
    /// nothing is free in a fit that was not asked for by a file.
    pub(super) fn new(spec: &Spec, form: &Form) -> Result<Self, FitError> {
        let known: Vec<&str> = form.parameters().iter().map(|p| p.name.as_str()).collect();
        if let Some(stray) = spec.parameters.keys().find(|name| !known.contains(&name.as_str())) {
            let what = format!(
                "`{}` of {} has no such override; it has {}",
                form.function(),
                form.origin(),
                if known.is_empty() { "none".to_owned() } else { known.join(", ") }
            );
            return Err(spec.fault(&format!("parameters.{stray}"), what));
        }
        let mut assembly = Self {
            names: known.iter().map(|name| (*name).to_owned()).collect(),
            origins: vec![Origin::Fixed(f64::NAN); known.len()],
            roles: vec![String::new(); known.len()],
            free: Vec::new(),
            start: Vec::new(),
            bounds: Vec::new(),
        };
        let mut tied = BTreeMap::new();
        for (index, parameter) in form.parameters().iter().enumerate() {
            let unnamed = match (spec.unnamed, parameter.default) {
                (Unnamed::Fixed, Some(default)) => ParameterChoice::Fixed(default),
                _ => ParameterChoice::Free { start: None, lower: None, upper: None },
            };
            match spec.parameters.get(&parameter.name).unwrap_or(&unnamed) {
                ParameterChoice::Fixed(value) => {
                    assembly.origins[index] = Origin::Fixed(*value);
                    assembly.roles[index] = "fixed".to_owned();
                }
                ParameterChoice::Tied(other) => {
                    tied.insert(index, other.clone());
                    assembly.roles[index] = format!("tied to {other}");
                }
                ParameterChoice::Free { start, lower, upper } => {
                    let key = format!("parameters.{}", parameter.name);
                    let start = start.or(parameter.default).ok_or_else(|| {
                        let what = "the override has no default and the spec gives no start";
                        spec.fault(&key, what.to_owned())
                    })?;
                    if let Some(fault) = start_fault(start, *lower, *upper) {
                        return Err(spec.fault(&key, format!("start: {fault}")));
                    }
                    assembly.origins[index] = Origin::Free(assembly.free.len());
                    assembly.roles[index] = "free".to_owned();
                    assembly.free.push(parameter.name.clone());
                    assembly.start.push(start);
                    assembly.bounds.push(Bounds { lower: *lower, upper: *upper });
                }
            }
        }
        for (index, other) in tied {
            let owner = known.iter().position(|name| *name == other).filter(|o| *o != index);
            let Some(owner) = owner else {
                let key = format!("parameters.{}.tied", assembly.names[index]);
                return Err(spec.fault(&key, format!("there is no other override `{other}`")));
            };
            assembly.origins[index] = assembly.origins[owner];
        }
        // A spec may ask for the residuals of printed constants; a user who fits expects a fit.
        if assembly.free.is_empty() && spec.unnamed == Unnamed::Free {
            return Err(spec.fault("parameters", "nothing is free: there is nothing to fit".into()));
        }
        Ok(assembly)
    }

    /// The value of an `override` for given constants.
    pub(super) fn value<T: Copy>(&self, index: usize, constants: &[T], fixed: fn(f64) -> T) -> T {
        self.origins.get(index).map_or(fixed(f64::NAN), |origin| origin.value(constants, fixed))
    }
}
