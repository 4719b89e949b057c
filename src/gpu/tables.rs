//! The tables of a form, held where an engine would hold them: in a buffer, not in the text.
//!
//! A module-scope `const NAME = array<f32, N>(…)` that is indexed by a value known only at run
//! time has no address in WGSL. Compilers copy it into the memory of every invocation first, and
//! drivers need minutes to compile that copy for a few hundred entries. From [`LEAST_ENTRIES`] on,
//! the kernel's text therefore declares a read-only storage buffer of the same name and type, and
//! the entries are uploaded. A read of the table is then a load from the device's memory. Its
//! values are the same bits; only an index outside the table may differ, where WGSL lets a buffer
//! return any of its elements or 0.

use super::device::Device;
use super::error::GpuError;
use std::cmp::Reverse;
use std::ops::Range;
use std::sync::Arc;
use wgpu::util::DeviceExt;

/// Entries from which an array is worth a buffer; compilers handle smaller ones in registers.
const LEAST_ENTRIES: usize = 32;

/// Most tables of a kernel. WebGPU guarantees 8 storage buffers, and a kernel has two others.
const MOST_TABLES: usize = 6;

/// Bind group of the tables.
const GROUP: u32 = crate::form::TABLE_GROUP;

/// A text whose tables are declared as buffers, and their entries in the order of the bindings.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lifted {
    pub(super) text: String,
    pub(super) tables: Vec<Arc<[f32]>>,
}

/// Moves the tables of `source`, of which `module` is the parsed form, into buffers: the largest
/// [`MOST_TABLES`] of them. Lines keep their numbers. A text that uses a table where WGSL wants a
/// constant is returned as it is.
pub(super) fn lift(module: &naga::Module, source: &str) -> Lifted {
    let unchanged = || Lifted { text: source.to_owned(), tables: Vec::new() };
    let bound = |variable: &naga::GlobalVariable| {
        variable.binding.as_ref().is_some_and(|binding| binding.group == GROUP)
    };
    if module.global_variables.iter().any(|(_, variable)| bound(variable)) {
        // The text has buffers of its own there.
        return unchanged();
    }
    let mut found: Vec<Table<'_>> = module
        .constants
        .iter()
        .filter_map(|(handle, constant)| {
            let range = module.constants.get_span(handle).to_range()?;
            Table::of(module, constant, range, source)
        })
        .collect();
    found.sort_by_key(|table| Reverse(table.entries.len()));
    found.truncate(MOST_TABLES);
    found.sort_by_key(|table| table.range.start);
    let mut text = String::with_capacity(source.len());
    let mut end = 0;
    for (binding, table) in found.iter().enumerate() {
        text.push_str(source.get(end..table.range.start).unwrap_or_default());
        text.push_str(&table.declaration(binding));
        end = table.range.end;
    }
    text.push_str(source.get(end..).unwrap_or_default());
    if found.is_empty() || naga::front::wgsl::parse_str(&text).is_err() {
        return unchanged();
    }
    Lifted { text, tables: found.into_iter().map(|table| table.entries.into()).collect() }
}

/// A constant array in a text.
struct Table<'a> {
    name: &'a str,
    entries: Vec<f32>,
    /// Where its declaration stands, from `const` to `;`.
    range: Range<usize>,
    lines: usize,
}

impl<'a> Table<'a> {
    fn of(
        module: &naga::Module,
        constant: &'a naga::Constant,
        range: Range<usize>,
        source: &str,
    ) -> Option<Self> {
        let naga::TypeInner::Array { base, .. } = module.types[constant.ty].inner else {
            return None;
        };
        if module.types[base].inner != naga::TypeInner::Scalar(naga::Scalar::F32) {
            return None;
        }
        let naga::Expression::Compose { components, .. } =
            &module.global_expressions[constant.init]
        else {
            return None;
        };
        if components.len() < LEAST_ENTRIES {
            return None;
        }
        let declaration = source.get(range.clone())?;
        if !(declaration.starts_with("const") && declaration.ends_with(';')) {
            return None;
        }
        Some(Self {
            name: constant.name.as_deref()?,
            entries: components
                .iter()
                .map(|entry| literal(module, *entry))
                .collect::<Option<_>>()?,
            range,
            lines: declaration.matches('\n').count(),
        })
    }

    fn declaration(&self, binding: usize) -> String {
        format!(
            "@group({GROUP}) @binding({binding}) var<storage, read> {}: array<f32, {}>;{}",
            self.name,
            self.entries.len(),
            "\n".repeat(self.lines)
        )
    }
}

/// Value of a constant f32 expression.
fn literal(module: &naga::Module, expression: naga::Handle<naga::Expression>) -> Option<f32> {
    match module.global_expressions[expression] {
        naga::Expression::Literal(naga::Literal::F32(value)) => Some(value),
        naga::Expression::Constant(named) => literal(module, module.constants[named].init),
        _ => None,
    }
}

/// Tables on the device.
#[derive(Debug)]
pub(super) struct BoundTables {
    pub(super) layout: wgpu::PipelineLayout,
    group: wgpu::BindGroup,
}

impl BoundTables {
    /// Uploads `tables`, one buffer each.
    pub(super) fn new(device: &Device, tables: &[Arc<[f32]>]) -> Result<Self, GpuError> {
        device.guarded(|| {
            let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..)
                .zip(tables)
                .map(|(binding, _)| wgpu::BindGroupLayoutEntry {
                    binding,
                    visibility: wgpu::ShaderStages::COMPUTE,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Storage { read_only: true },
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                })
                .collect();
            let bindings = device.raw.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("tables"),
                entries: &entries,
            });
            let buffers: Vec<wgpu::Buffer> = tables
                .iter()
                .map(|entries| {
                    device.raw.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                        label: Some("table"),
                        contents: bytemuck::cast_slice(entries),
                        usage: wgpu::BufferUsages::STORAGE,
                    })
                })
                .collect();
            let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
                .zip(&buffers)
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let group = device.raw.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("tables"),
                layout: &bindings,
                entries: &entries,
            });
            let layout = device.raw.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("striae with tables"),
                bind_group_layouts: &[Some(&device.bindings), Some(&bindings)],
                immediate_size: 0,
            });
            Self { layout, group }
        })
    }

    /// Makes the tables visible to the dispatches of `pass`.
    pub(super) fn set(&self, pass: &mut wgpu::ComputePass<'_>) {
        pass.set_bind_group(GROUP, &self.group, &[]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `const name = array<f32, count>(0.5, 1.5, …)`, four entries a line.
    fn table(name: &str, count: usize) -> String {
        let entries: Vec<String> = (0..count).map(|i| format!("{i}.5")).collect();
        let lines: Vec<String> = entries.chunks(4).map(|line| line.join(", ")).collect();
        format!("const {name} = array<f32, {count}>(\n{}\n);", lines.join(",\n"))
    }

    fn lifted(source: &str) -> Result<Lifted, naga::front::wgsl::ParseError> {
        Ok(lift(&naga::front::wgsl::parse_str(source)?, source))
    }

    #[test]
    fn large_tables_become_buffers_and_lines_stay() -> Result<(), naga::front::wgsl::ParseError> {
        let (long, short) = (table("LONG", 40), table("SHORT", 31));
        let source = format!(
            "// é\n{short}\n{long}\nfn f(x: f32) -> f32 {{ return LONG[u32(x)] + SHORT[u32(x)]; }}"
        );
        let lifted = lifted(&source)?;
        let expected: Vec<f32> = (0..40).map(|i| i as f32 + 0.5).collect();
        assert_eq!(lifted.tables, [expected.into()]);
        let declaration =
            "@group(1) @binding(0) var<storage, read> LONG: array<f32, 40>;".to_owned();
        let lines = "\n".repeat(long.matches('\n').count());
        assert_eq!(lifted.text, source.replace(&long, &(declaration + &lines)));
        Ok(())
    }

    #[test]
    fn named_entries_are_looked_up() -> Result<(), naga::front::wgsl::ParseError> {
        let entries = vec!["A"; 32].join(", ");
        let source = format!(
            "const A: f32 = -0.25; const T = array<f32, 32>({entries});\n\
             fn f(x: f32) -> f32 {{ return T[u32(x)]; }}"
        );
        assert_eq!(lifted(&source)?.tables, [vec![-0.25_f32; 32].into()]);
        Ok(())
    }

    #[test]
    fn a_table_that_a_constant_needs_stays() -> Result<(), naga::front::wgsl::ParseError> {
        let source = format!(
            "{}\nconst FIRST = T[0];\nfn f(x: f32) -> f32 {{ return T[u32(x)] + FIRST; }}",
            table("T", 64)
        );
        assert_eq!(lifted(&source)?, Lifted { text: source.clone(), tables: vec![] });
        Ok(())
    }

    #[test]
    fn no_more_tables_than_bindings() -> Result<(), naga::front::wgsl::ParseError> {
        let tables: String = (0..8).map(|i| table(&format!("T{i}"), 32 + i) + "\n").collect();
        let sum: Vec<String> = (0..8).map(|i| format!("T{i}[u32(x)]")).collect();
        let source = format!("{tables}fn f(x: f32) -> f32 {{ return {}; }}", sum.join(" + "));
        let lengths: Vec<usize> = lifted(&source)?.tables.iter().map(|table| table.len()).collect();
        assert_eq!(lengths, [34, 35, 36, 37, 38, 39]);
        Ok(())
    }
}
