//! Forms: approximations written once, as WGSL functions.
//!
//! A [`Form`] is one named function of scalars or vectors returning a scalar or a vector. What may
//! be fitted in it is a module-scope `override` constant. naga parses and validates the text; the
//! same module is evaluated on the CPU over lanes of f64, f32 or dual numbers ([`Form::eval_f64`],
//! [`Form::eval_f32`], [`Form::eval_dual`]), run on the device (`crate::gpu`) and emitted for the
//! user's engine ([`emit`]).
//!
//! # What the lanes compute
//!
//! - Literals are f32, as WGSL says: naga has rounded them, and f64 lanes widen that value.
//! - `min`, `max` and `clamp` give NaN if an operand is NaN (WGSL leaves it open), so that a NaN
//!   is seen and not hidden. `pow` of a negative base is NaN, as it is on devices.
//! - An index outside an array or a vector is taken as unsigned and at most the last element.
//! - A bitcast in f64 lanes rounds to f32 first; its derivative is zero.
//! - Functions that WGSL defines by a formula (`mix`, `smoothstep`, `reflect` …) follow it in its
//!   order; `dot` adds from the first component to the last.
//!
//! # Example
//!
//! ```
//! use striae::form::Form;
//!
//! let text = "
//!     override slope: f32 = 0.5;
//!     fn masking(mu: f32, alpha: f32) -> f32 {
//!         let k = slope * alpha;
//!         return mu / (mu * (1.0 - k) + k);
//!     }";
//! let form = Form::parse("masking.wgsl", text, "masking")?;
//! assert_eq!(form.parameters()[0].default, Some(0.5));
//! assert_eq!(form.input_columns(), ["mu", "alpha"]);
//!
//! // One slice per input; one list of values per output.
//! let values = form.eval_f64(&[0.5], &[&[0.0, 0.5, 1.0], &[1.0, 1.0, 1.0]])?;
//! assert_eq!(values, [[0.0, 0.5 / 0.75, 1.0]]);
//! # Ok::<(), striae::form::FormError>(())
//! ```

mod compile;
mod cost;
mod data_table;
pub mod emit;
mod error;
mod half;
mod input;
pub mod lanes;
mod load;
mod operation;
mod program;

use std::collections::BTreeMap;
use std::sync::Arc;

pub use cost::OpCount;
pub use data_table::{DataTable, GROUP as TABLE_GROUP, LEAST_ENTRIES as LEAST_TABLE_ENTRIES};
pub use error::FormError;
pub use input::{Input, ScalarType};
pub(crate) use load::guarded;
pub use load::{MAX_BRACKET_NESTING, MAX_ELSE, MAX_OPERATORS, MAX_SOURCE_BYTES};

use data_table::Tables;
use lanes::{DualEvaluator, Evaluator};

/// What a user may fit in a form: an `override` constant of type f32.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name of the `override`.
    pub name: String,
    /// Initial value written in the text, if there is one.
    pub default: Option<f64>,
}

/// An argument of a form's function.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Argument {
    /// Name in the text.
    pub name: String,
    /// Type of its scalars.
    pub scalar: ScalarType,
    /// Number of scalar components: 1 for a scalar, 2 to 4 for a vector.
    pub components: usize,
}

/// A loaded form. Cheap to clone; can be used from many threads at once.
#[derive(Debug, Clone)]
pub struct Form {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    origin: String,
    source: String,
    function: String,
    tables: Tables,
    module: naga::Module,
    compiled: compile::Compiled,
}

impl Form {
    /// Parses and validates `source`, and compiles `function` for the lanes.
    ///
    /// `origin` names the file in diagnostics. The parameters are the f32 `override` constants
    /// that the function reaches, also through its callees and through other overrides; an
    /// override whose value depends on others follows them, one of another type keeps its value.
    ///
    /// # Errors
    /// [`FormError::Invalid`] if the text does not parse or validate, [`FormError::NoFunction`],
    /// [`FormError::Unsupported`] for what forms cannot use, [`FormError::TooLarge`] beyond the
    /// stated limits.
    pub fn parse(origin: &str, source: &str, function: &str) -> Result<Self, FormError> {
        Self::parse_with(origin, source, function, Vec::new())
    }

    /// Parses a text that reads storage buffers: `tables` gives the numbers of each
    /// `@group(1) @binding(i) var<storage, read> NAME: array<T>`, in the order of the bindings. T is
    /// f32, i32, u32 or a vector of them. On the device they are buffers, as in an engine; lanes
    /// read the same numbers.
    ///
    /// # Errors
    /// As [`Form::parse`]; [`FormError::Table`] if a table is not declared so, or is empty.
    pub fn parse_with(
        origin: &str,
        source: &str,
        function: &str,
        tables: Vec<DataTable>,
    ) -> Result<Self, FormError> {
        let (module, tables, compiled) = load::guarded(origin, || {
            let (module, info) = load::module(origin, source)?;
            let tables = Tables::of(origin, source, &module, tables)?;
            let compiled = compile::compile(origin, source, &module, &info, function, &tables)?;
            Ok((module, tables, compiled))
        })?;
        let inner = Inner {
            origin: origin.to_owned(),
            source: source.to_owned(),
            function: function.to_owned(),
            tables,
            module,
            compiled,
        };
        Ok(Self { inner: Arc::new(inner) })
    }

    /// File the text came from, as given to [`Form::parse`].
    pub fn origin(&self) -> &str {
        &self.inner.origin
    }
    /// The text, unchanged.
    pub fn source(&self) -> &str {
        &self.inner.source
    }
    /// The tables, in the order of their bindings on the device: those given beside the text, then
    /// the constant arrays of the text from [`LEAST_TABLE_ENTRIES`] entries on.
    pub fn tables(&self) -> &[DataTable] {
        &self.inner.tables.list
    }
    /// The tables given beside the text.
    fn given_tables(&self) -> &[DataTable] {
        let Tables { list, given, .. } = &self.inner.tables;
        list.get(..*given).unwrap_or_default()
    }
    /// The text with the given tables as constant arrays, or why one of them cannot be.
    fn baked_source(&self) -> Result<String, String> {
        self.inner.tables.baked(&self.inner.source, &self.inner.module)
    }
    /// The text with a storage buffer for each of [`Form::tables`]; lines keep their numbers.
    pub(crate) fn device_source(&self) -> &str {
        self.inner.tables.device_text.as_deref().unwrap_or(&self.inner.source)
    }
    /// Name of the function.
    pub fn function(&self) -> &str {
        &self.inner.function
    }
    /// The `override` constants that the function reaches, in the order of the text.
    pub fn parameters(&self) -> &[Parameter] {
        &self.inner.compiled.parameters
    }
    /// The arguments, in order.
    pub fn arguments(&self) -> &[Argument] {
        &self.inner.compiled.arguments
    }
    /// Number of scalar components of the result, 1 to 4.
    pub fn result_components(&self) -> usize {
        self.inner.compiled.result_components
    }
    /// One column name per scalar input: `x` for a scalar, `p_x`, `p_y` … for a vector.
    pub fn input_columns(&self) -> Vec<String> {
        self.arguments().iter().flat_map(|a| columns(&a.name, a.components)).collect()
    }
    /// Type of every scalar input, in the order of [`Form::input_columns`].
    pub fn input_types(&self) -> Vec<ScalarType> {
        self.scalars().collect()
    }
    /// One column name per scalar output: `value`, or `value_x`, `value_y` …
    pub fn output_columns(&self) -> Vec<String> {
        columns("value", self.result_components())
    }

    /// Evaluates in f64. `parameters` in the order of [`Form::parameters`]; `inputs` one slice per
    /// entry of [`Form::input_columns`], all of one length; returns one vector per output column.
    ///
    /// # Errors
    /// [`FormError::Shape`] if a count does not fit, [`FormError::Input`] if an integer argument
    /// does not take a number exactly, [`FormError::Unbounded`] if a loop does not end within [`lanes::MAX_LOOP_ITERATIONS`] or [`lanes::MAX_CHUNK_COST`].
    pub fn eval_f64(
        &self,
        parameters: &[f64],
        inputs: &[&[f64]],
    ) -> Result<Vec<Vec<f64>>, FormError> {
        let mut values = Vec::new();
        Evaluator::<f64>::new(self).eval_into(parameters, inputs, &mut values)?;
        Ok(values)
    }

    /// Evaluates in f32, correctly rounded elementary functions, in the order of the text.
    ///
    /// # Errors
    /// As [`Form::eval_f64`].
    pub fn eval_f32(
        &self,
        parameters: &[f32],
        inputs: &[&[f32]],
    ) -> Result<Vec<Vec<f32>>, FormError> {
        let mut values = Vec::new();
        Evaluator::<f32>::new(self).eval_into(parameters, inputs, &mut values)?;
        Ok(values)
    }

    /// Evaluates in f32 at columns of any type: what f32 does not hold exactly, as large integers,
    /// comes in a column of its own type or of f64.
    ///
    /// # Errors
    /// As [`Form::eval_f64`].
    pub fn eval_f32_inputs(
        &self,
        parameters: &[f32],
        inputs: &[Input<'_>],
    ) -> Result<Vec<Vec<f32>>, FormError> {
        let mut values = Vec::new();
        Evaluator::<f32>::new(self).eval_into(parameters, inputs, &mut values)?;
        Ok(values)
    }

    /// Evaluates in f64 with exact derivatives by the parameters whose indices are in `free`.
    ///
    /// # Errors
    /// As [`Form::eval_f64`]; [`FormError::Shape`] also if `free` names no parameter or one twice.
    pub fn eval_dual(
        &self,
        parameters: &[f64],
        free: &[usize],
        inputs: &[&[f64]],
    ) -> Result<Dual, FormError> {
        let mut dual = Dual { values: Vec::new(), derivatives: Vec::new() };
        DualEvaluator::new(self, free)?.eval_into(parameters, inputs, &mut dual)?;
        Ok(dual)
    }

    /// Static count of operations.
    pub fn op_count(&self) -> OpCount {
        OpCount::of(self.program())
    }

    pub(crate) fn module(&self) -> &naga::Module {
        &self.inner.module
    }

    /// Where the value is of every override that the function reaches.
    fn overrides(&self) -> &BTreeMap<naga::Handle<naga::Override>, program::Reg> {
        &self.inner.compiled.overrides
    }

    pub(crate) fn program(&self) -> &program::Program {
        &self.inner.compiled.program
    }

    fn scalars(&self) -> impl Iterator<Item = ScalarType> {
        self.arguments().iter().flat_map(|a| std::iter::repeat_n(a.scalar, a.components))
    }

    /// Type of scalar input `at`.
    pub(crate) fn input_type(&self, at: usize) -> ScalarType {
        self.scalars().nth(at).unwrap_or(ScalarType::F32)
    }

    /// The bits of scalar input `at`, which is of type `scalar`, in one row of its column.
    pub(crate) fn word(
        &self,
        at: usize,
        scalar: ScalarType,
        column: Input<'_>,
        row: usize,
    ) -> Result<u32, FormError> {
        let got = column.at(row);
        scalar.word(got).ok_or_else(|| FormError::Input {
            origin: self.origin().to_owned(),
            function: self.function().to_owned(),
            argument: self.input_column(at),
            row,
            expected: scalar.numbers(),
            got,
        })
    }

    /// Name of scalar input `at`.
    fn input_column(&self, at: usize) -> String {
        self.input_columns().into_iter().nth(at).unwrap_or_default()
    }

    fn shape_error(&self, what: String) -> FormError {
        FormError::Shape {
            origin: self.origin().to_owned(),
            function: self.function().to_owned(),
            what,
        }
    }
}

/// `name`, or `name_x`, `name_y` … for a vector.
fn columns(name: &str, components: usize) -> Vec<String> {
    if components == 1 {
        return vec![name.to_owned()];
    }
    ["x", "y", "z", "w"].iter().take(components).map(|c| format!("{name}_{c}")).collect()
}

/// Values with their derivatives by the free parameters.
#[derive(Debug, Clone)]
pub struct Dual {
    /// `values[output][point]`.
    pub values: Vec<Vec<f64>>,
    /// `derivatives[output][free parameter][point]`.
    pub derivatives: Vec<Vec<Vec<f64>>>,
}
