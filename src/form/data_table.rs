//! Tables that a form looks up: typed numbers of a storage buffer.
//!
//! A text declares one as `@group(1) @binding(i) var<storage, read> NAME: array<T>`, and its numbers
//! are given beside the text; or it writes `const NAME = array<T, N>(…)`. The second kind has no
//! address in WGSL: compilers copy it into the memory of every invocation, and drivers need minutes
//! to compile that copy for a few hundred entries. From [`LEAST_ENTRIES`] on it is therefore lifted
//! when the form is loaded: the text for the device declares a buffer of the same name and type in
//! its place. Lanes, device and emission read one list of tables ([`Form::tables`]), whichever way
//! each of them stands in the text. Values are the same bits; only an index outside a table may
//! differ, where WGSL lets a buffer return any of its elements or 0.
//!
//! [`Form::tables`]: super::Form::tables

use std::cmp::Reverse;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use naga::{
    AddressSpace, ArraySize, Expression, Handle, Literal, Module, StorageAccess, TypeInner,
};

use super::program::Kind;
use super::{FormError, ScalarType, load};

/// Bind group of the tables of a form.
pub const GROUP: u32 = 1;

/// Entries from which an array is worth a buffer; compilers handle smaller ones in registers.
pub const LEAST_ENTRIES: usize = 32;

/// Most tables of a form: WebGPU guarantees 8 storage buffers, and a kernel has two others.
const MOST_TABLES: usize = 6;

/// The numbers of a storage buffer of a form: entries of 1 to 4 scalars of one type.
#[derive(Debug, Clone, PartialEq)]
pub struct DataTable {
    name: String,
    scalar: ScalarType,
    components: usize,
    words: Arc<[u32]>,
}

impl DataTable {
    /// `array<f32>`.
    pub fn new(name: &str, values: impl AsRef<[f32]>) -> Self {
        let words = values.as_ref().iter().map(|value| value.to_bits()).collect();
        Self { name: name.to_owned(), scalar: ScalarType::F32, components: 1, words }
    }

    /// `array<vec2<f32>>`, `array<vec3<f32>>` or `array<vec4<f32>>`, by the length of an entry.
    pub fn vectors<const N: usize>(name: &str, values: &[[f32; N]]) -> Self {
        Self { components: N, ..Self::new(name, values.as_flattened()) }
    }

    /// `array<u32>`.
    pub fn unsigned(name: &str, values: impl Into<Arc<[u32]>>) -> Self {
        let words = values.into();
        Self { name: name.to_owned(), scalar: ScalarType::U32, components: 1, words }
    }

    /// `array<i32>`.
    pub fn signed(name: &str, values: &[i32]) -> Self {
        let words: Vec<u32> = values.iter().map(|&value| value as u32).collect();
        Self { scalar: ScalarType::I32, ..Self::unsigned(name, words) }
    }

    /// Name of the variable.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// Type of the scalars of an entry.
    pub fn scalar(&self) -> ScalarType {
        self.scalar
    }
    /// Scalars of an entry, 1 to 4.
    pub fn components(&self) -> usize {
        self.components
    }
    /// Number of entries.
    pub fn len(&self) -> usize {
        self.words.len() / self.components.max(1)
    }
    /// Whether there are no entries.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// The bits of the scalars, entry after entry.
    pub(crate) fn words(&self) -> &Arc<[u32]> {
        &self.words
    }

    /// Type of an entry, as WGSL writes it.
    pub(crate) fn entry_type(&self) -> String {
        self.scalar.wgsl(self.components)
    }

    /// The content of the buffer: an entry of three scalars takes the room of four.
    pub(crate) fn buffer_words(&self) -> Vec<u32> {
        let padding = if self.components == 3 { &[0_u32][..] } else { &[] };
        let entries = self.words.chunks(self.components.max(1));
        entries.flat_map(|entry| entry.iter().chain(padding).copied()).collect()
    }

    /// The declaration as a constant array; the numbers read back to the same bits.
    fn constant(&self) -> Result<String, String> {
        let scalar = |&word: &u32| match self.scalar {
            ScalarType::U32 => Ok(format!("{word}u")),
            // The least number has no literal of its own: its digits alone are out of range.
            ScalarType::I32 if word as i32 == i32::MIN => Ok("(-2147483647i - 1i)".to_owned()),
            ScalarType::I32 => Ok(format!("{}i", word as i32)),
            ScalarType::F32 => match f32::from_bits(word) {
                value if value.is_finite() => Ok(format!("{value:e}f")),
                value => Err(format!("table `{}` holds {value}, which no text can", self.name)),
            },
        };
        let entry = self.entry_type();
        let entries = self
            .words
            .chunks(self.components.max(1))
            .map(|words| {
                let scalars = words.iter().map(scalar).collect::<Result<Vec<_>, _>>()?.join(", ");
                Ok(if words.len() == 1 { scalars } else { format!("{entry}({scalars})") })
            })
            .collect::<Result<Vec<_>, String>>()?;
        let (name, length, entries) = (&self.name, self.len(), entries.join(", "));
        Ok(format!("const {name} = array<{entry}, {length}>({entries});"))
    }
}

/// The tables of a form, and its text as the device takes it.
#[derive(Debug)]
pub(super) struct Tables {
    /// Those given beside the text, then those lifted out of it, in the order of their bindings.
    pub(super) list: Vec<DataTable>,
    /// How many of them are given.
    pub(super) given: usize,
    /// The text with every table of the list in a buffer, where that is not the text itself. Lines
    /// keep their numbers.
    pub(super) device_text: Option<String>,
}

impl Tables {
    /// Checks what is `given` against the text, and lifts its large constant arrays: the largest,
    /// up to [`MOST_TABLES`] in all. None is lifted out of a text that uses one where WGSL wants a
    /// constant, or that binds something else in group 1.
    pub(super) fn of(
        origin: &str,
        source: &str,
        module: &Module,
        given: Vec<DataTable>,
    ) -> Result<Self, FormError> {
        for (place, table) in given.iter().enumerate() {
            declared(module, place, table).map_err(|what| FormError::Table {
                origin: origin.to_owned(),
                table: table.name.clone(),
                what,
            })?;
        }
        let count = given.len();
        let mut tables = Self { list: given, given: count, device_text: None };
        let in_group = |variable: &&naga::GlobalVariable| {
            variable.binding.as_ref().is_some_and(|binding| binding.group == GROUP)
        };
        let bound = module.global_variables.iter().map(|(_, variable)| variable).filter(in_group);
        if bound.count() != count {
            return Ok(tables);
        }
        let mut found: Vec<(Range<usize>, DataTable)> = module
            .constants
            .iter()
            .filter_map(|(handle, constant)| {
                let range = module.constants.get_span(handle).to_range()?;
                let declaration = source.get(range.clone())?;
                let plain = declaration.starts_with("const") && declaration.ends_with(';');
                plain.then_some((range, constant_table(module, constant)?))
            })
            .collect();
        found.sort_by_key(|(_, table)| Reverse(table.words.len()));
        found.truncate(MOST_TABLES.saturating_sub(count));
        found.sort_by_key(|(range, _)| range.start);
        let declarations = found.iter().enumerate().map(|(at, (range, table))| {
            let (binding, name, length) = (count + at, &table.name, table.len());
            let lines = source.get(range.clone()).unwrap_or_default().matches('\n').count();
            let declaration = format!(
                "@group({GROUP}) @binding({binding}) var<storage, read> {name}: array<{}, {length}>;{}",
                table.entry_type(),
                "\n".repeat(lines)
            );
            (range.clone(), declaration)
        });
        let text = replaced(source, declarations);
        if !found.is_empty() && naga::front::wgsl::parse_str(&text).is_ok() {
            tables.list.extend(found.into_iter().map(|(_, table)| table));
            tables.device_text = Some(text);
        }
        Ok(tables)
    }

    /// Where the list holds the constant arrays of the text, by kind and bits.
    pub(super) fn constants(&self) -> HashMap<(Kind, Arc<[u32]>), u32> {
        let lifted = self.list.iter().enumerate().skip(self.given);
        let entry = |(at, table): (usize, &DataTable)| {
            ((table.scalar.into(), Arc::clone(&table.words)), at as u32)
        };
        lifted.map(entry).collect()
    }

    /// `source` with the given tables as constant arrays in place of their declarations.
    pub(super) fn baked(&self, source: &str, module: &Module) -> Result<String, String> {
        let mut declarations = Vec::with_capacity(self.given);
        for table in self.list.iter().take(self.given) {
            let range = variable(module, &table.name)
                .and_then(|handle| module.global_variables.get_span(handle).to_range())
                .ok_or_else(|| format!("table `{}` has no place in the text", table.name))?;
            let start = load::start_of_declaration(source, range.start);
            declarations.push((start..range.end, table.constant()?));
        }
        declarations.sort_by_key(|(range, _)| range.start);
        Ok(replaced(source, declarations.into_iter()))
    }
}

/// `source` with texts in place of some of its parts, which are in ascending order.
fn replaced(source: &str, parts: impl Iterator<Item = (Range<usize>, String)>) -> String {
    let mut text = String::with_capacity(source.len());
    let mut end = 0;
    for (range, part) in parts {
        text.push_str(source.get(end..range.start).unwrap_or_default());
        text.push_str(&part);
        end = range.end;
    }
    text.push_str(source.get(end..).unwrap_or_default());
    text
}

fn variable(module: &Module, name: &str) -> Option<Handle<naga::GlobalVariable>> {
    let mut variables = module.global_variables.iter();
    variables.find(|(_, v)| v.name.as_deref() == Some(name)).map(|(handle, _)| handle)
}

/// Checks that the text declares `table` read-only, in group 1, at the binding of its place.
fn declared(module: &Module, place: usize, table: &DataTable) -> Result<(), String> {
    let handle = variable(module, &table.name).ok_or("is not declared in the text")?;
    let variable = &module.global_variables[handle];
    if variable.space != (AddressSpace::Storage { access: StorageAccess::LOAD }) {
        return Err("is not `var<storage, read>`".to_owned());
    }
    let of_its_type = match module.types[variable.ty].inner {
        TypeInner::Array { base, size, .. } => {
            let sized = match size {
                ArraySize::Dynamic => true,
                ArraySize::Constant(length) => length.get() as usize == table.len(),
                ArraySize::Pending(_) => false,
            };
            let entry = ScalarType::of(&module.types[base].inner);
            sized && entry == Some((table.scalar, table.components))
        }
        _ => false,
    };
    if !of_its_type {
        return Err(format!("is not of type `array<{}>`", table.entry_type()));
    }
    let bound = variable.binding.as_ref().map(|binding| (binding.group, binding.binding));
    if bound != Some((GROUP, place as u32)) {
        return Err(format!("is not bound as @group({GROUP}) @binding({place})"));
    }
    if table.is_empty() {
        return Err("has no numbers".to_owned());
    }
    Ok(())
}

/// A constant array of entries enough for a buffer.
fn constant_table(module: &Module, constant: &naga::Constant) -> Option<DataTable> {
    let TypeInner::Array { base, size: ArraySize::Constant(length), .. } =
        module.types[constant.ty].inner
    else {
        return None;
    };
    let (scalar, components) = ScalarType::of(&module.types[base].inner)?;
    if (length.get() as usize) < LEAST_ENTRIES {
        return None;
    }
    let mut words = Vec::new();
    literals(module, constant.init, &mut words)?;
    Some(DataTable { name: constant.name.clone()?, scalar, components, words: words.into() })
}

/// Appends the bits of a constant expression that is written out; `None` for any other.
fn literals(module: &Module, handle: Handle<Expression>, words: &mut Vec<u32>) -> Option<()> {
    match module.global_expressions[handle] {
        Expression::Literal(Literal::F32(value)) => words.push(value.to_bits()),
        Expression::Literal(Literal::I32(value)) => words.push(value as u32),
        Expression::Literal(Literal::U32(value)) => words.push(value),
        Expression::Constant(named) => literals(module, module.constants[named].init, words)?,
        Expression::Splat { size, value } => {
            (0..size as u8).try_for_each(|_| literals(module, value, words))?;
        }
        Expression::Compose { ref components, .. } => {
            components.iter().try_for_each(|&part| literals(module, part, words))?;
        }
        _ => return None,
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::Form;

    /// `const name = array<f32, count>(0.5, 1.5, …)`, four entries a line.
    fn table(name: &str, count: usize) -> String {
        let entries: Vec<String> = (0..count).map(|i| format!("{i}.5")).collect();
        let lines: Vec<String> = entries.chunks(4).map(|line| line.join(", ")).collect();
        format!("const {name} = array<f32, {count}>(\n{}\n);", lines.join(",\n"))
    }

    fn form(source: &str) -> Result<Form, FormError> {
        Form::parse("f.wgsl", source, "f")
    }

    #[test]
    fn large_tables_become_buffers_and_lines_stay() -> Result<(), FormError> {
        let (long, short) = (table("LONG", 40), table("SHORT", 31));
        let source = format!(
            "// é\n{short}\n{long}\nfn f(x: f32) -> f32 {{ return LONG[u32(x)] + SHORT[u32(x)]; }}"
        );
        let form = form(&source)?;
        let expected: Vec<f32> = (0..40).map(|i| i as f32 + 0.5).collect();
        assert_eq!(form.tables(), [DataTable::new("LONG", expected)]);
        let declaration =
            "@group(1) @binding(0) var<storage, read> LONG: array<f32, 40>;".to_owned();
        let lines = "\n".repeat(long.matches('\n').count());
        assert_eq!(form.device_source(), source.replace(&long, &(declaration + &lines)));
        // The lanes read the numbers of the list, and the short array's beside them.
        let program = form.program();
        assert_eq!(program.tables.len(), 2);
        assert!(Arc::ptr_eq(&program.tables[0], form.tables()[0].words()));
        Ok(())
    }

    #[test]
    fn entries_are_of_any_type_and_may_be_named() -> Result<(), FormError> {
        let named = vec!["A"; 32].join(", ");
        let vectors = ["vec3(1.0, 2.0, A)", "vec3(A)"].repeat(16).join(", ");
        let source = format!(
            "const A: f32 = -0.25; const T = array<f32, 32>({named});\n\
             const N = array<i32, 32>({}); const V = array<vec3<f32>, 32>({vectors});\n\
             fn f(x: f32) -> f32 {{ return T[u32(x)] + V[u32(x)].y + f32(N[u32(x)]); }}",
            vec!["-3"; 32].join(", ")
        );
        let form = form(&source)?;
        let rows = [[1.0, 2.0, -0.25], [-0.25; 3]].repeat(16);
        let expected = [
            DataTable::new("T", [-0.25; 32]),
            DataTable::signed("N", &[-3; 32]),
            DataTable::vectors("V", &rows),
        ];
        assert_eq!(form.tables(), expected);
        assert_eq!(form.eval_f32(&[], &[&[0.0, 1.0]])?, [[-1.25, -3.5]]);
        assert_eq!(
            form.tables()[2].buffer_words()[..4],
            [1.0_f32, 2.0, -0.25, 0.0].map(f32::to_bits)
        );
        Ok(())
    }

    #[test]
    fn a_table_that_a_constant_needs_stays() -> Result<(), FormError> {
        let source = format!(
            "{}\nconst FIRST = T[0];\nfn f(x: f32) -> f32 {{ return T[u32(x)] + FIRST; }}",
            table("T", 64)
        );
        let form = form(&source)?;
        assert_eq!((form.device_source(), form.tables()), (source.as_str(), &[][..]));
        Ok(())
    }

    #[test]
    fn no_more_tables_than_bindings() -> Result<(), FormError> {
        let tables: String = (0..8).map(|i| table(&format!("T{i}"), 32 + i) + "\n").collect();
        let sum: Vec<String> = (0..8).map(|i| format!("T{i}[u32(x)]")).collect();
        let source = format!("{tables}fn f(x: f32) -> f32 {{ return {}; }}", sum.join(" + "));
        let lengths: Vec<usize> = form(&source)?.tables().iter().map(DataTable::len).collect();
        assert_eq!(lengths, [34, 35, 36, 37, 38, 39]);
        Ok(())
    }
}
