//! A fitted form as text or SPIR-V for the user's engine, its constants baked in.
//!
//! The overrides become constants of the same name, so that they stay visible; the function, what
//! it calls and the constants that they reach are written, nothing else of the file. Written f32
//! constants read back to the same bits. naga appends an underscore to names that end in a digit.

use std::collections::{BTreeMap, HashSet};

use naga::back::{glsl, hlsl, msl, spv, wgsl};
use naga::compact::{KeepUnused, compact};
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Constant, Expression, Handle, Literal, Module, ShaderStage, Span, Statement};

use super::lanes::override_values;
use super::{Form, FormError, LEAST_TABLE_ENTRIES, TABLE_GROUP, load};

/// A language that forms can be emitted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Language {
    /// WebGPU Shading Language: the function alone.
    Wgsl,
    /// GLSL 4.50. A `main` that calls the function stands at the end, because a GLSL file is not
    /// complete without one; leave it out when copying.
    Glsl,
    /// HLSL, shader model 5.1: the function alone.
    Hlsl,
    /// Metal Shading Language: the function alone.
    Msl,
    /// SPIR-V 1.0 with names, and a compute entry point `main` that calls the function.
    Spirv,
}

impl Language {
    /// Every language, in the order of the documentation.
    pub const ALL: [Self; 5] = [Self::Wgsl, Self::Glsl, Self::Hlsl, Self::Msl, Self::Spirv];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::Msl => "msl",
            Self::Spirv => "spirv",
        }
    }
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Emitted {
    /// Source text.
    Text(String),
    /// SPIR-V words, little-endian.
    Binary(Vec<u8>),
}

impl Emitted {
    /// The bytes of the file.
    pub fn as_bytes(&self) -> &[u8] {
        match self {
            Self::Text(text) => text.as_bytes(),
            Self::Binary(bytes) => bytes,
        }
    }
}

/// How the tables given beside a text are written. Constant arrays of the text stay what they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TableStyle {
    /// Baked if each has fewer than [`LEAST_TABLE_ENTRIES`] entries, else bound.
    #[default]
    BySize,
    /// As read-only storage buffers at the bindings of the text, which the engine fills. In Metal
    /// they are arguments of the function.
    Bound,
    /// As constant arrays with their numbers.
    Baked,
}

/// Writes `form` in `language` with its parameters set to `values`; a parameter that `values` does
/// not name keeps its default. `header` goes on top of text output as comment lines.
///
/// # Errors
/// [`FormError::Emit`] if a value is missing, not finite or names no parameter, or if the
/// language cannot express the form.
pub fn emit(
    form: &Form,
    values: &BTreeMap<String, f32>,
    language: Language,
    header: &str,
) -> Result<Emitted, FormError> {
    emit_with_tables(form, values, language, TableStyle::default(), header)
}

/// Writes `form` as [`emit`] does, with the tables given beside its text in the style asked for.
///
/// # Errors
/// As [`emit`]; [`FormError::Emit`] also if a table to bake holds what no text can.
pub fn emit_with_tables(
    form: &Form,
    values: &BTreeMap<String, f32>,
    language: Language,
    tables: TableStyle,
    header: &str,
) -> Result<Emitted, FormError> {
    let refuse = |what: String| FormError::Emit {
        origin: form.origin().to_owned(),
        function: form.function().to_owned(),
        language: language.name().to_owned(),
        what,
    };
    let given = form.given_tables();
    let bake = match tables {
        TableStyle::BySize => given.iter().all(|table| table.len() < LEAST_TABLE_ENTRIES),
        TableStyle::Bound => false,
        TableStyle::Baked => true,
    };
    if bake && !given.is_empty() {
        let text = form.baked_source().map_err(refuse)?;
        let baked = Form::parse(form.origin(), &text, form.function())?;
        return emit_with_tables(&baked, values, language, tables, header);
    }
    let bound = given.iter().enumerate().map(|(binding, table)| {
        let (name, entry, entries) = (table.name(), table.entry_type(), table.len());
        format!(
            "\nTable {name}: {entries} entries of {entry}, group {TABLE_GROUP}, binding {binding}"
        )
    });
    let header = &format!("{header}{}", bound.collect::<String>());
    let parameters = parameter_values(form, values).map_err(refuse)?;
    load::guarded(form.origin(), || {
        let module = baked(form, &parameters).map_err(refuse)?;
        write(&module, language, header).map_err(|error| refuse(error.to_string()))
    })
}

/// One value per parameter, in the form's order.
fn parameter_values(form: &Form, values: &BTreeMap<String, f32>) -> Result<Vec<f32>, String> {
    let known = |name: &String| form.parameters().iter().any(|p| p.name == *name);
    if let Some(unknown) = values.keys().find(|name| !known(name)) {
        return Err(format!("there is no parameter `{unknown}`"));
    }
    form.parameters()
        .iter()
        .map(|parameter| {
            let name = &parameter.name;
            let default = parameter.default.map(|value| value as f32);
            match values.get(name).copied().or(default) {
                Some(value) if value.is_finite() => Ok(value),
                Some(value) => Err(format!("parameter `{name}` is {value}, not a finite number")),
                None => Err(format!("parameter `{name}` has neither a value nor a default")),
            }
        })
        .collect()
}

/// The form's module with constants for overrides, reduced to what the function reaches, and with
/// an entry point that calls it.
fn baked(form: &Form, parameters: &[f32]) -> Result<Module, String> {
    let mut module = form.module().clone();
    let mut constants = BTreeMap::new();
    for (handle, literal) in override_values(form, parameters) {
        if let Literal::F32(value) = literal
            && !value.is_finite()
        {
            let name = module.overrides[handle].name.as_deref().unwrap_or("?");
            return Err(format!("`{name}` comes out as {value}, not a finite number"));
        }
        let init = module.global_expressions.append(Expression::Literal(literal), Span::UNDEFINED);
        let item = &module.overrides[handle];
        let constant = Constant { name: item.name.clone(), ty: item.ty, init };
        constants.insert(handle.index(), module.constants.append(constant, Span::UNDEFINED));
    }
    for (_, function) in module.functions.iter_mut() {
        for (_, expression) in function.expressions.iter_mut() {
            if let Expression::Override(handle) = *expression
                && let Some(&constant) = constants.get(&handle.index())
            {
                *expression = Expression::Constant(constant);
            }
        }
    }
    module.entry_points = vec![entry_point(&module, form.function())?];
    compact(&mut module, KeepUnused::No);
    // Compaction keeps every named constant; those that are not reached lose their names first.
    let reached = reached_constants(&module);
    for (handle, constant) in module.constants.iter_mut() {
        if !reached.contains(&handle) {
            constant.name = None;
        }
    }
    compact(&mut module, KeepUnused::No);
    Ok(module)
}

/// A compute entry point whose body is one call of `function` with zeros.
fn entry_point(module: &Module, function: &str) -> Result<naga::EntryPoint, String> {
    let (handle, callee) = module
        .functions
        .iter()
        .find(|(_, f)| f.name.as_deref() == Some(function))
        .ok_or_else(|| format!("there is no function `{function}`"))?;
    let mut main = naga::Function::default();
    let mut arguments = Vec::with_capacity(callee.arguments.len());
    for argument in &callee.arguments {
        let zero = Expression::ZeroValue(argument.ty);
        arguments.push(main.expressions.append(zero, Span::UNDEFINED));
    }
    let result = main.expressions.append(Expression::CallResult(handle), Span::UNDEFINED);
    let call = Statement::Call { function: handle, arguments, result: Some(result) };
    main.body.push(call, Span::UNDEFINED);
    Ok(naga::EntryPoint {
        name: "main".into(),
        stage: ShaderStage::Compute,
        early_depth_test: None,
        workgroup_size: [1, 1, 1],
        workgroup_size_overrides: None,
        function: main,
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    })
}

/// The constants that functions use, directly or through other constants and private variables.
fn reached_constants(module: &Module) -> HashSet<Handle<Constant>> {
    let mut reached = HashSet::new();
    let mut globals: Vec<Handle<Expression>> =
        module.global_variables.iter().filter_map(|(_, variable)| variable.init).collect();
    for (_, function) in module.functions.iter() {
        for (_, expression) in function.expressions.iter() {
            if let Expression::Constant(constant) = *expression
                && reached.insert(constant)
            {
                globals.push(module.constants[constant].init);
            }
        }
    }
    while let Some(handle) = globals.pop() {
        match &module.global_expressions[handle] {
            &Expression::Constant(constant) if reached.insert(constant) => {
                globals.push(module.constants[constant].init);
            }
            Expression::Compose { components, .. } => globals.extend(components),
            &Expression::Splat { value, .. } => globals.push(value),
            _ => {}
        }
    }
    reached
}

fn validate(module: &Module) -> Result<ModuleInfo, String> {
    Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(module)
        .map_err(|error| error.emit_to_string(""))
}

fn write(
    module: &Module,
    language: Language,
    header: &str,
) -> Result<Emitted, Box<dyn std::error::Error>> {
    let info = &validate(module)?;
    let stage = ShaderStage::Compute;
    if language == Language::Spirv {
        let options = spv::Options {
            flags: spv::WriterFlags::DEBUG,
            force_loop_bounding: false,
            bounds_check_policies: BoundsCheckPolicies::default(),
            ..spv::Options::default()
        };
        let pipeline = spv::PipelineOptions { shader_stage: stage, entry_point: "main".into() };
        let words = spv::write_vec(module, info, &options, Some(&pipeline))?;
        return Ok(Emitted::Binary(words.iter().flat_map(|word| word.to_le_bytes()).collect()));
    }
    if language == Language::Glsl {
        let options = glsl::Options {
            version: glsl::Version::Desktop(450),
            writer_flags: glsl::WriterFlags::empty(),
            binding_map: bindings(module),
            ..glsl::Options::default()
        };
        let pipeline = glsl::PipelineOptions {
            shader_stage: stage,
            entry_point: "main".into(),
            multiview: None,
        };
        let mut text = String::new();
        let policies = BoundsCheckPolicies::default();
        glsl::Writer::new(&mut text, module, info, &options, &pipeline, policies)?.write()?;
        let note = "`main` only completes the file: leave it out when copying the function.";
        return Ok(Emitted::Text(commented(&format!("{header}\n{note}"), &text)));
    }
    let mut module = module.clone();
    module.entry_points.clear();
    let info = &validate(&module)?;
    let module = &module;
    let text = match language {
        Language::Hlsl => {
            let options = hlsl::Options { force_loop_bounding: false, ..hlsl::Options::default() };
            let mut text = String::new();
            hlsl::Writer::new(&mut text, &options, &hlsl::PipelineOptions::default())
                .write(module, info, None)?;
            braced_arrays(&text)
        }
        Language::Msl => {
            let options = msl::Options {
                lang_version: (2, 0),
                force_loop_bounding: false,
                ..msl::Options::default()
            };
            msl::write_string(module, info, &options, &msl::PipelineOptions::default())?.0
        }
        Language::Wgsl | Language::Glsl | Language::Spirv => {
            wgsl::write_string(module, info, wgsl::WriterFlags::empty())?
        }
    };
    Ok(Emitted::Text(commented(header, &text)))
}

/// The bindings of the module as those of GLSL, which has no groups.
fn bindings(module: &Module) -> glsl::BindingMap {
    let bound = module.global_variables.iter().filter_map(|(_, variable)| variable.binding);
    bound.filter_map(|bound| Some((bound, u8::try_from(bound.binding).ok()?))).collect()
}

/// HLSL with braces around the elements of constant arrays.
///
/// naga writes a function of as many arguments as the array has elements and initialises the
/// array with a call of it, which glslang takes for recursion and nobody can read.
fn braced_arrays(text: &str) -> String {
    const CONSTRUCTOR: &str = "Constructarray";
    let mut braced = String::with_capacity(text.len());
    for line in text.lines() {
        let mut rest = line;
        let mut open = Vec::new();
        while line.starts_with("static const ")
            && let Some(at) = rest.find(['(', ')'])
        {
            let (before, bracket) = rest.split_at(at);
            let array = before.rfind(CONSTRUCTOR).filter(|_| bracket.starts_with('('));
            let closes_array = bracket.starts_with(')') && open.pop() == Some(true);
            braced.push_str(&before[..array.unwrap_or(before.len())]);
            if bracket.starts_with('(') {
                open.push(array.is_some());
            }
            braced.push_str(match (array, closes_array) {
                (Some(_), _) => "{",
                (None, true) => "}",
                (None, false) => &bracket[..1],
            });
            rest = &bracket[1..];
        }
        braced.push_str(rest);
        braced.push('\n');
    }
    // The constructors that no expression calls any more.
    let mut kept = String::with_capacity(braced.len());
    for block in braced.split_inclusive("\n\n") {
        let name = block
            .strip_prefix("typedef ")
            .and_then(|rest| rest.split_once(" ret_"))
            .and_then(|(_, rest)| rest.split_once('['))
            .map(|(name, _)| name);
        let called = name.is_none_or(|name| braced.matches(&format!("{name}(")).count() > 1);
        if called {
            kept.push_str(block);
        }
    }
    kept
}

/// `text` under `header`, one comment line per line.
fn commented(header: &str, text: &str) -> String {
    let mut commented = String::new();
    for line in header.lines().filter(|_| !header.trim().is_empty()) {
        commented.push_str(format!("// {line}").trim_end());
        commented.push('\n');
    }
    // `#version` must come first in GLSL.
    match text.strip_prefix("#version").and_then(|rest| rest.split_once('\n')) {
        Some((version, rest)) => format!("#version{version}\n{commented}{rest}"),
        None => format!("{commented}{text}"),
    }
}
