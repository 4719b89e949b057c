//! Variables, indexing and constants.

use naga::{AddressSpace, Arena, Expression, Handle, TypeInner};

use super::Compiler;
use super::body::Frame;
use super::value::{Place, Scalar, Value};
use crate::form::FormError;
use crate::form::operation::I2;
use crate::form::program::{Instr, Kind, Reg, Slot};

impl<'m> Compiler<'m> {
    /// The scalars of a module-scope constant expression; `None` if it depends on an override.
    pub(super) fn constant_global(&self, handle: Handle<Expression>) -> Option<Vec<Scalar>> {
        self.constant(&self.module.global_expressions, handle)
    }

    /// The scalars of a constant expression of a function or of the module.
    fn constant(
        &self,
        expressions: &Arena<Expression>,
        handle: Handle<Expression>,
    ) -> Option<Vec<Scalar>> {
        match expressions[handle] {
            Expression::Literal(literal) => Some(vec![scalar_of(literal)?]),
            Expression::Constant(constant) => {
                self.constant_global(self.module.constants[constant].init)
            }
            Expression::ZeroValue(ty) => {
                Some(self.kinds_of(ty).ok()?.into_iter().map(Scalar::zero).collect())
            }
            Expression::Splat { size, value } => {
                Some(self.constant(expressions, value)?.repeat(size as usize))
            }
            Expression::Compose { ref components, .. } => {
                let mut scalars = Vec::new();
                for &component in components {
                    scalars.extend(self.constant(expressions, component)?);
                }
                Some(scalars)
            }
            _ => None,
        }
    }

    /// An array that is known at compile time, if `handle` is one.
    pub(super) fn constant_array(
        &self,
        frame: &Frame<'m>,
        handle: Handle<Expression>,
    ) -> Option<Value> {
        let ty = match frame.expressions[handle] {
            Expression::Compose { ty, .. } | Expression::ZeroValue(ty) => ty,
            Expression::Constant(constant) => self.module.constants[constant].ty,
            _ => return None,
        };
        let TypeInner::Array { .. } = self.module.types[ty].inner else { return None };
        Some(Value::Array(self.constant(frame.expressions, handle)?))
    }

    /// The registers of a `var<private>`; its initial value is stored at the start of the program.
    pub(super) fn global(
        &mut self,
        handle: Handle<naga::GlobalVariable>,
    ) -> Result<Value, FormError> {
        let variable = &self.module.global_variables[handle];
        let span = self.module.global_variables.get_span(handle);
        let name = variable.name.as_deref().unwrap_or("?");
        if let Some(table) = self.given(variable) {
            return Ok(table);
        }
        if variable.space != AddressSpace::Private {
            let what = match (variable.space, &self.module.types[variable.ty].inner) {
                (AddressSpace::Uniform, _) => "a uniform buffer",
                (AddressSpace::Storage { .. }, _) => "a storage buffer",
                (AddressSpace::WorkGroup, _) => "a workgroup variable",
                (_, TypeInner::Image { .. }) => "a texture",
                (_, TypeInner::Sampler { .. }) => "a sampler",
                _ => "this address space",
            };
            return Err(self.unsupported(span, format!("`{name}`: {what}")));
        }
        if !self.globals.contains_key(&handle) {
            let kinds = self.kinds_of(variable.ty)?;
            let regs: Vec<Reg> = kinds.iter().map(|&kind| self.new_reg(kind)).collect();
            let initial = match variable.init {
                Some(init) => {
                    let mut frame = Frame::global(self.module);
                    let value = self.value(&mut frame, init)?;
                    self.regs(value)?
                }
                None => kinds.iter().map(|&kind| self.scalar(Scalar::zero(kind))).collect(),
            };
            let stores = regs.iter().zip(&initial).map(|(&to, &from)| Instr::Store { to, from });
            self.initial.extend(stores);
            self.globals.insert(handle, regs);
        }
        let regs = self.globals[&handle].clone();
        Ok(Value::Place(Place { count: regs.len(), regs, offset: 0, index: None }))
    }

    /// The table of a storage buffer whose numbers are given beside the text.
    fn given(&mut self, variable: &naga::GlobalVariable) -> Option<Value> {
        let name = variable.name.as_deref()?;
        let mut given = self.given.list.iter().take(self.given.given);
        let index = given.position(|table| table.name() == name)?;
        let table = self.given.list.get(index)?;
        let (kind, count) = (table.scalar().into(), table.components() as u32);
        Some(Value::Table { table: index as u32, kind, length: table.len() as u32, count })
    }

    /// The value of a variable now.
    pub(super) fn load(&mut self, place: &Place) -> Result<Value, FormError> {
        let mut loaded = Vec::with_capacity(place.count);
        for component in place.offset..place.offset + place.count {
            let from = place.regs[component];
            let to = self.new_reg(kind_of(from));
            self.push(match place.index {
                None => Instr::Move { to, from },
                Some(index) => Instr::Gather { to, from: place.regs[component..].into(), index },
            })?;
            loaded.push(to);
        }
        Ok(Value::Regs(loaded))
    }

    /// `base[index]` with an index known at compile time.
    pub(super) fn access_index(
        &mut self,
        inner: &TypeInner,
        base: Value,
        index: usize,
    ) -> Result<Value, FormError> {
        if let Value::Table { .. } = base {
            let index = self.integer(index as u32);
            return self.access(inner, base, index);
        }
        let inner = self.pointee(inner).into_owned();
        let (at, length) = self.element(&inner, index)?;
        Ok(match base {
            Value::Regs(regs) => Value::Regs(regs[at..at + length].to_vec()),
            Value::Array(scalars) => {
                let element = match inner {
                    TypeInner::Array { base, .. } => Some(base),
                    _ => None,
                };
                let scalars = scalars[at..at + length].to_vec();
                match element {
                    Some(ty) if self.is_array(ty) => Value::Array(scalars),
                    _ => Value::Regs(scalars.into_iter().map(|s| self.scalar(s)).collect()),
                }
            }
            Value::Row { table, kind, index, offset, .. } => {
                Value::Row { table, kind, index, offset: offset + at as u32, count: length as u32 }
            }
            Value::Place(place) => {
                Value::Place(Place { offset: place.offset + at, count: length, ..place })
            }
            Value::Table { .. } => return Err(self.mixed()),
        })
    }

    fn is_array(&self, ty: Handle<naga::Type>) -> bool {
        matches!(self.module.types[ty].inner, TypeInner::Array { .. })
    }

    /// `base[index]` with an index known at run time, as unsigned and at most the last element:
    /// the rule that wgpu's shaders follow.
    pub(super) fn access(
        &mut self,
        inner: &TypeInner,
        base: Value,
        index: Slot,
    ) -> Result<Value, FormError> {
        let inner = self.pointee(inner).into_owned();
        let (stride, length) = match base {
            Value::Table { length, count, .. } => (count as usize, length as usize),
            _ => self.stride(&inner)?,
        };
        let last = self.integer((length as u32).saturating_sub(1));
        let mut at = self.integer2(I2::MinUnsigned, index, last)?;
        if stride != 1 {
            let stride = self.integer(stride as u32);
            at = self.integer2(I2::Mul, at, stride)?;
        }
        match base {
            Value::Regs(regs) => {
                let place = Place { regs, offset: 0, count: stride, index: Some(at) };
                self.one_kind(&place.regs)?;
                self.load(&place)
            }
            Value::Array(scalars) => {
                let Some((table, kind)) = self.table(&scalars) else {
                    return Err(self.mixed());
                };
                Ok(Value::Row { table, kind, index: at, offset: 0, count: stride as u32 })
            }
            Value::Row { table, kind, index, offset, .. } => {
                let index = self.integer2(I2::Add, index, at)?;
                Ok(Value::Row { table, kind, index, offset, count: stride as u32 })
            }
            Value::Place(place) => {
                self.one_kind(&place.regs)?;
                let index = match place.index {
                    Some(index) => self.integer2(I2::Add, index, at)?,
                    None => at,
                };
                Ok(Value::Place(Place { count: stride, index: Some(index), ..place }))
            }
            Value::Table { table, kind, count, .. } => {
                Ok(Value::Row { table, kind, index: at, offset: 0, count })
            }
        }
    }

    fn one_kind(&self, regs: &[Reg]) -> Result<(), FormError> {
        let mut kinds = regs.iter().map(|&reg| kind_of(reg));
        let first = kinds.next();
        if kinds.all(|kind| Some(kind) == first) { Ok(()) } else { Err(self.mixed()) }
    }

    fn mixed(&self) -> FormError {
        self.unsupported(self.here, "a run-time index into structs of mixed types")
    }
}

pub(super) fn kind_of(reg: Reg) -> Kind {
    match reg {
        Reg::F(_) => Kind::F,
        Reg::I(_) => Kind::I,
        Reg::B(_) => Kind::B,
    }
}

/// `None` for literals of types that forms do not have.
pub(super) fn scalar_of(literal: naga::Literal) -> Option<Scalar> {
    match literal {
        naga::Literal::F32(value) => Some(Scalar::F(value.to_bits())),
        naga::Literal::I32(value) => Some(Scalar::I(value as u32)),
        naga::Literal::U32(value) => Some(Scalar::I(value)),
        naga::Literal::Bool(value) => Some(Scalar::B(value)),
        _ => None,
    }
}
