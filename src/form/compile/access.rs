//! Variables, indexing and constants.

use naga::{
    AddressSpace, Arena, BinaryOperator, Expression, Handle, MathFunction, ScalarKind, TypeInner,
};

use super::Compiler;
use super::body::Frame;
use super::value::{Place, Scalar, Value};
use crate::form::FormError;
use crate::form::operation::Op;
use crate::form::program::{Instr, Kind, Reg};

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
            let mut frame = Frame::global(self.module);
            let (regs, initial) = self.variable(&mut frame, &kinds, variable.init)?;
            self.initial.extend(stores(&regs, &initial));
            self.globals.insert(handle, regs);
        }
        Ok(Value::Place(Place::whole(self.globals[&handle].clone())))
    }

    /// New registers of a variable, and those of its initial value.
    pub(super) fn variable(
        &mut self,
        frame: &mut Frame<'m>,
        kinds: &[Kind],
        init: Option<Handle<Expression>>,
    ) -> Result<(Vec<Reg>, Vec<Reg>), FormError> {
        let regs = kinds.iter().map(|&kind| self.new_reg(kind)).collect();
        let initial = match init {
            Some(init) => self.regs_of(frame, init)?,
            None => self.scalars(kinds.iter().copied().map(Scalar::zero)),
        };
        Ok((regs, initial))
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
    pub(super) fn load(&mut self, place: &Place) -> Result<Vec<Reg>, FormError> {
        let mut loaded = Vec::with_capacity(place.count);
        for component in place.offset..place.offset + place.count {
            let to = self.new_reg(place.regs[component].kind);
            self.push(match place.index {
                None => Instr::Move { to, from: place.regs[component].slot },
                Some(index) => {
                    Instr::Gather { to, from: place.slots(component), index: index.slot }
                }
            })?;
            loaded.push(to);
        }
        Ok(loaded)
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
        let inner = self.pointee(inner);
        let (at, length) = self.element(&inner, index)?;
        Ok(match base {
            Value::Regs(regs) => Value::Regs(regs[at..at + length].to_vec()),
            Value::Array(scalars) => {
                let scalars = scalars[at..at + length].to_vec();
                match inner {
                    TypeInner::Array { base, .. } if self.is_array(base) => Value::Array(scalars),
                    _ => Value::Regs(self.scalars(scalars)),
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
        index: Reg,
    ) -> Result<Value, FormError> {
        let inner = self.pointee(inner);
        let (stride, length) = match base {
            Value::Table { length, count, .. } => (count as usize, length as usize),
            _ => self.stride(&inner)?,
        };
        let last = self.integer((length as u32).saturating_sub(1));
        let mut at = self.op(Op::Math(MathFunction::Min, ScalarKind::Uint), &[index, last])?;
        if stride != 1 {
            let stride = self.integer(stride as u32);
            at = self.op(Op::Binary(BinaryOperator::Multiply, ScalarKind::Uint), &[at, stride])?;
        }
        let (count, sum) = (stride as u32, Op::Binary(BinaryOperator::Add, ScalarKind::Uint));
        Ok(match base {
            Value::Regs(regs) => {
                let place = Place { regs, offset: 0, count: stride, index: Some(at) };
                self.one_kind(&place.regs)?;
                Value::Regs(self.load(&place)?)
            }
            Value::Array(scalars) => {
                let (table, kind) = self.table(&scalars).ok_or_else(|| self.mixed())?;
                Value::Row { table, kind, index: at, offset: 0, count }
            }
            Value::Row { table, kind, index, offset, .. } => {
                let index = self.op(sum, &[index, at])?;
                Value::Row { table, kind, index, offset, count }
            }
            Value::Place(place) => {
                self.one_kind(&place.regs)?;
                let index = match place.index {
                    Some(index) => self.op(sum, &[index, at])?,
                    None => at,
                };
                Value::Place(Place { count: stride, index: Some(index), ..place })
            }
            Value::Table { table, kind, count, .. } => {
                Value::Row { table, kind, index: at, offset: 0, count }
            }
        })
    }

    fn one_kind(&self, regs: &[Reg]) -> Result<(), FormError> {
        let mixed = regs.windows(2).any(|pair| pair[0].kind != pair[1].kind);
        if mixed { Err(self.mixed()) } else { Ok(()) }
    }

    fn mixed(&self) -> FormError {
        self.unsupported(self.here, "a run-time index into structs of mixed types")
    }
}

/// Copies of registers for the active lanes.
pub(super) fn stores(to: &[Reg], from: &[Reg]) -> impl Iterator<Item = Instr> {
    to.iter().zip(from).map(|(&to, from)| Instr::Store { to, from: from.slot })
}

/// `None` for literals of types that forms do not have.
pub(super) fn scalar_of(literal: naga::Literal) -> Option<Scalar> {
    let (kind, bits) = match literal {
        naga::Literal::F32(value) => (Kind::F, value.to_bits()),
        naga::Literal::I32(value) => (Kind::I, value as u32),
        naga::Literal::U32(value) => (Kind::I, value),
        naga::Literal::Bool(value) => (Kind::B, value.into()),
        _ => return None,
    };
    Some(Scalar { kind, bits })
}
