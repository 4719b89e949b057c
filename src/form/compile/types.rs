//! Types as runs of scalars.

use naga::{Handle, ScalarKind, Type, TypeInner};

use super::Compiler;
use crate::form::FormError;
use crate::form::program::Kind;

/// Arrays and structs of more scalars than this are refused.
const MAX_SCALARS: usize = 65_536;

impl Compiler<'_> {
    /// Kind of a scalar type of the widths that forms have.
    pub(super) fn kind(&self, scalar: naga::Scalar) -> Result<Kind, FormError> {
        match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) => Ok(Kind::F),
            (ScalarKind::Sint | ScalarKind::Uint, 4) => Ok(Kind::I),
            (ScalarKind::Bool, _) => Ok(Kind::B),
            _ => {
                let what = format!("the type `{}`", self.type_name(&TypeInner::Scalar(scalar)));
                Err(self.unsupported(self.here, what))
            }
        }
    }

    /// The scalars of a type, in order.
    pub(super) fn kinds(&self, inner: &TypeInner) -> Result<Vec<Kind>, FormError> {
        match *inner {
            TypeInner::Scalar(scalar) => Ok(vec![self.kind(scalar)?]),
            TypeInner::Vector { size, scalar } => Ok(vec![self.kind(scalar)?; size as usize]),
            TypeInner::Array { base, size: naga::ArraySize::Constant(length), .. } => {
                let element = self.kinds(&self.module.types[base].inner)?;
                let length = length.get() as usize;
                if element.len().saturating_mul(length) > MAX_SCALARS {
                    let what = format!("an array of more than {MAX_SCALARS} scalars");
                    return Err(self.too_large(self.here, what));
                }
                Ok(element.repeat(length))
            }
            TypeInner::Struct { ref members, .. } => {
                let mut kinds = Vec::new();
                for member in members {
                    kinds.extend(self.kinds(&self.module.types[member.ty].inner)?);
                    if kinds.len() > MAX_SCALARS {
                        let what = format!("a struct of more than {MAX_SCALARS} scalars");
                        return Err(self.too_large(self.here, what));
                    }
                }
                Ok(kinds)
            }
            _ => Err(self.unsupported(self.here, format!("the type `{}`", self.type_name(inner)))),
        }
    }

    pub(super) fn kinds_of(&self, ty: Handle<Type>) -> Result<Vec<Kind>, FormError> {
        self.kinds(&self.module.types[ty].inner)
    }

    /// What a pointer points at, or the type itself.
    pub(super) fn pointee(&self, inner: &TypeInner) -> TypeInner {
        match inner.pointer_base_type() {
            Some(base) => base.inner_with(&self.module.types).clone(),
            None => inner.clone(),
        }
    }

    /// Offset and count of the scalars of element or member `index`.
    pub(super) fn element(
        &self,
        inner: &TypeInner,
        index: usize,
    ) -> Result<(usize, usize), FormError> {
        if let TypeInner::Struct { members, .. } = inner {
            let mut offset = 0;
            for (at, member) in members.iter().enumerate() {
                let count = self.kinds_of(member.ty)?.len();
                if at == index {
                    return Ok((offset, count));
                }
                offset += count;
            }
        }
        let (stride, length) = self.stride(inner)?;
        if index >= length {
            return Err(self.unsupported(self.here, format!("index {index} of {length} elements")));
        }
        Ok((index * stride, stride))
    }

    /// Scalars per element, and number of elements, of an array or a vector.
    pub(super) fn stride(&self, inner: &TypeInner) -> Result<(usize, usize), FormError> {
        match *inner {
            TypeInner::Vector { size, .. } => Ok((1, size as usize)),
            TypeInner::Array { base, size: naga::ArraySize::Constant(length), .. } => {
                Ok((self.kinds_of(base)?.len(), length.get() as usize))
            }
            _ => {
                let what = format!("indexing a value of type `{}`", self.type_name(inner));
                Err(self.unsupported(self.here, what))
            }
        }
    }

    /// The type as a user would write it.
    pub(super) fn type_name(&self, inner: &TypeInner) -> String {
        let scalar = |scalar: naga::Scalar| {
            let letter = match scalar.kind {
                ScalarKind::Bool => return "bool".to_owned(),
                ScalarKind::Float | ScalarKind::AbstractFloat => 'f',
                ScalarKind::Uint => 'u',
                ScalarKind::Sint | ScalarKind::AbstractInt => 'i',
            };
            format!("{letter}{}", u32::from(scalar.width) * 8)
        };
        match *inner {
            TypeInner::Scalar(s) => scalar(s),
            TypeInner::Vector { size, scalar: s } => format!("vec{}<{}>", size as u8, scalar(s)),
            TypeInner::Matrix { columns, rows, scalar: s } => {
                format!("mat{}x{}<{}>", columns as u8, rows as u8, scalar(s))
            }
            TypeInner::Atomic(s) => format!("atomic<{}>", scalar(s)),
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => "ptr".into(),
            TypeInner::Array { base, size, .. } => {
                let base = self.type_name(&self.module.types[base].inner);
                match size {
                    naga::ArraySize::Constant(length) => format!("array<{base}, {length}>"),
                    _ => format!("array<{base}>"),
                }
            }
            TypeInner::Struct { .. } => "struct".into(),
            TypeInner::Image { .. } => "texture".into(),
            TypeInner::Sampler { .. } => "sampler".into(),
            TypeInner::AccelerationStructure { .. } => "acceleration_structure".into(),
            TypeInner::RayQuery { .. } => "ray_query".into(),
            TypeInner::BindingArray { .. } => "binding_array".into(),
            TypeInner::CooperativeMatrix { .. } => "coop_mat".into(),
        }
    }
}
