//! The kernel that is counted on NVIDIA's GPUs: the form as naga writes it in Metal's language, which is C++,
//! under a header that gives CUDA what it names.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::kernel::{EVALUATIONS, multiplier, step};
use crate::form::emit::{Emitted, Language, TableStyle, emit_with_tables};
use crate::form::{Form, ScalarType};

/// What Metal names, in CUDA.
const HEADER: &str = include_str!("metal.cuh");

/// The kernel called `kernel` with the form evaluated; without it if `constants` are none.
pub(super) fn text(form: &Form, constants: Option<&[f32]>) -> Result<String, String> {
    let types = form.input_types();
    if types.iter().any(|scalar| *scalar != ScalarType::F32) {
        return Err("integer arguments are not counted on NVIDIA's targets yet".to_owned());
    }
    let mut body = String::new();
    let evaluation = match constants {
        None => "value".to_owned(),
        Some(constants) => {
            let names = form.parameters().iter().map(|parameter| parameter.name.clone());
            let values: BTreeMap<String, f32> = names.zip(constants.iter().copied()).collect();
            let emitted = emit_with_tables(form, &values, Language::Msl, TableStyle::Baked, "");
            let Emitted::Text(metal) = emitted.map_err(|error| error.to_string())? else {
                return Err("no text was written".to_owned());
            };
            let lines = metal.lines().filter(|line| !line.starts_with(['#', '/']));
            body = lines.filter(|line| !line.starts_with("using ")).map(as_cuda).collect();
            format!("{}({})", last_function(&metal)?, arguments(form))
        }
    };
    let (mut starts, mut steps, mut inputs) = (String::new(), String::new(), String::new());
    for at in 0..types.len() {
        let (multiplier, (growth, shift)) = (multiplier(at), step(at));
        // Writing to a String cannot fail.
        let _ = writeln!(starts, "float v{at} = float((id * {multiplier}u) >> 9) * 1.1920929e-7f;");
        let _ = writeln!(steps, "v{at} = fmaf(v{at}, {growth:?}f, {shift:?}f);");
        let _ = write!(inputs, " + v{at}");
    }
    let outputs = form.result_components();
    let parts: Vec<String> = match (constants, outputs) {
        (_, 1) => vec!["value".to_owned()],
        (None, _) => vec!["value".to_owned(); outputs],
        (Some(_), _) => {
            ["x", "y", "z"].iter().take(outputs).map(|c| format!("value.{c}")).collect()
        }
    };
    let (mut sums, mut total) = (String::new(), String::new());
    let mut turn = steps;
    let first = if types.is_empty() { "1.0f" } else { "v0" };
    let value = if constants.is_some() { evaluation.as_str() } else { first };
    let _ = writeln!(turn, "{{ auto value = {value};");
    for (at, part) in parts.iter().enumerate() {
        let _ = writeln!(sums, "float sum{at} = {at}.0f;");
        let _ = writeln!(turn, "sum{at} += {part};");
        let _ = write!(total, "sum{at} + ");
    }
    turn.push_str("}\n");
    let turns = turn.repeat(EVALUATIONS as usize);
    Ok(format!(
        "{HEADER}{body}\nextern \"C\" __global__ void kernel(float* outputs) {{\n\
         unsigned id = blockIdx.x * 64u + threadIdx.x;\n{starts}{sums}{turns}\
         outputs[id] = {total}0.0f{inputs};\n}}\n"
    ))
}

/// The inputs as the arguments of the form.
fn arguments(form: &Form) -> String {
    let mut column = 0;
    let argument = |count: usize| {
        let scalars: Vec<String> = (column..column + count).map(|at| format!("v{at}")).collect();
        column += count;
        match count {
            1 => scalars.join(""),
            _ => format!("metal::float{count}({})", scalars.join(", ")),
        }
    };
    let all: Vec<String> = form.arguments().iter().map(|of| of.components).map(argument).collect();
    all.join(", ")
}

/// The name of the last function of a text, which is the form: callees stand before it.
fn last_function(metal: &str) -> Result<&str, String> {
    let opens = |line: &&str| !line.starts_with(' ') && line.ends_with('(');
    let line = metal.lines().rfind(opens);
    let name = line.and_then(|line| line.trim_end_matches('(').split_whitespace().next_back());
    name.ok_or_else(|| "no function was written".to_owned())
}

/// A line of Metal in CUDA: there a number without a suffix is a double, and a swizzle is a function. Loops are
/// asked to be unrolled.
fn as_cuda(line: &str) -> String {
    let mut text = String::with_capacity(line.len() + 8);
    if line.trim_start().starts_with("while(true)") {
        text.push_str("#pragma unroll 64\n");
    }
    let mut rest = line;
    while let Some(first) = rest.chars().next() {
        let in_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let number = |c: char| in_word(c) || c == '.';
        let end =
            |inside: fn(char) -> bool, of: &str| of.find(|c: char| !inside(c)).unwrap_or(of.len());
        let length = if first.is_ascii_digit() {
            // Exponents may carry a sign.
            let mut length = rest.find(|c: char| !number(c)).unwrap_or(rest.len());
            if rest[..length].ends_with('e') && !rest.starts_with("0x") {
                length += 1;
                length += end(|c| c.is_ascii_digit(), &rest[length..]);
            }
            length
        } else if in_word(first) {
            rest.find(|c: char| !in_word(c)).unwrap_or(rest.len())
        } else if first == '.' {
            1 + rest[1..].find(|c: char| !in_word(c)).unwrap_or(rest.len() - 1)
        } else {
            first.len_utf8()
        };
        let (word, after) = rest.split_at(length.min(rest.len()));
        text.push_str(word);
        let float = first.is_ascii_digit() && word.contains('.') && !word.ends_with('f');
        let swizzle =
            first == '.' && word.len() > 2 && word[1..].chars().all(|c| "xyzw".contains(c));
        text.push_str(if float {
            "f"
        } else if swizzle {
            "()"
        } else {
            ""
        });
        rest = after;
    }
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_single_and_swizzles_are_calls() {
        for (metal, cuda) in [
            ("x = 1.0 + a_2.xy * 3u;", "x = 1.0f + a_2.xy() * 3u;\n"),
            ("y = 1.5e-7 + v.x - 0.25f;", "y = 1.5e-7f + v.x - 0.25f;\n"),
            ("t = a.inner[12] * -2.0", "t = a.inner[12] * -2.0f\n"),
        ] {
            assert_eq!(as_cuda(metal), cuda);
        }
    }
}
