//! Numbers that a form reads from a storage buffer.

use std::sync::Arc;

use naga::{AddressSpace, ArraySize, Module, StorageAccess, TypeInner};

use super::FormError;

/// Bind group of the tables of a form.
pub const GROUP: u32 = 1;

/// The numbers of a storage buffer that the text of a form declares.
#[derive(Debug, Clone, PartialEq)]
pub struct DataTable {
    /// Name of the variable.
    pub name: String,
    /// Its numbers.
    pub values: Arc<[f32]>,
}

impl DataTable {
    /// A table called `name`.
    pub fn new(name: &str, values: impl Into<Arc<[f32]>>) -> Self {
        Self { name: name.to_owned(), values: values.into() }
    }
}

/// Checks that the text declares every table, read-only, in group 1, at the binding of its place.
pub(super) fn check(origin: &str, module: &Module, tables: &[DataTable]) -> Result<(), FormError> {
    for (place, table) in tables.iter().enumerate() {
        let fault = |what: &str| FormError::Table {
            origin: origin.to_owned(),
            table: table.name.clone(),
            what: what.to_owned(),
        };
        let (_, variable) = module
            .global_variables
            .iter()
            .find(|(_, variable)| variable.name.as_deref() == Some(table.name.as_str()))
            .ok_or_else(|| fault("is not declared in the text"))?;
        if variable.space != (AddressSpace::Storage { access: StorageAccess::LOAD }) {
            return Err(fault("is not `var<storage, read>`"));
        }
        let is_list = match module.types[variable.ty].inner {
            TypeInner::Array { base, size: ArraySize::Dynamic, .. } => {
                module.types[base].inner == TypeInner::Scalar(naga::Scalar::F32)
            }
            _ => false,
        };
        if !is_list {
            return Err(fault("is not of type `array<f32>`"));
        }
        let bound = variable.binding.as_ref().map(|binding| (binding.group, binding.binding));
        if bound != Some((GROUP, place as u32)) {
            return Err(fault(&format!("is not bound as @group({GROUP}) @binding({place})")));
        }
        if table.values.is_empty() {
            return Err(fault("has no numbers"));
        }
    }
    Ok(())
}
