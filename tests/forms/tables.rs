//! Typed tables given beside a text: on lanes, in messages, and emitted.

use std::collections::BTreeMap;

use striae::form::emit::{Emitted, Language, TableStyle, emit_with_tables};
use striae::form::{DataTable, Form};

use crate::external;

const TEXT: &str = "
// The colours; not the end of a declaration: }
@group(1) @binding(0) var<storage, read> colours: array<vec3<f32>>;
@group(1)
@binding(1) var<storage, read> packed: array<u32>; @group(1) @binding(2) var<storage, read> shift: array<i32, 3>;
override gain: f32 = 2.0;
fn f(i: i32, j: u32) -> vec3<f32> {
    let pair = unpack2x16float(packed[j]);
    let colour = colours[i];
    return gain * colour + vec3(pair, f32(shift[1]) + colours[j][u32(i)] + colours[0].z);
}";

const COLOURS: [[f32; 3]; 4] =
    [[0.1, 0.2, 0.3], [1.0e-30, -0.0, 5.0], [f32::MIN_POSITIVE / 8.0, 7.0, 8.0], [9.0, 10.0, 11.0]];

fn tables() -> Vec<DataTable> {
    vec![
        DataTable::vectors("colours", &COLOURS),
        // Pairs of f16: 1.5 and -2, 65504 and 0.1, 1e-7 and 0.
        DataTable::unsigned("packed", [0xc000_3e00, 0x2e66_7bff, 0x0000_0002]),
        DataTable::signed("shift", &[i32::MAX, i32::MIN, -4]),
    ]
}

fn form() -> Form {
    Form::parse_with("tables.wgsl", TEXT, "f", tables()).expect("loads")
}

#[test]
fn lanes_read_them() {
    let form = form();
    // 0.1 rounds to 0x2e66, 1e-7 to two units of 2^-24.
    let halves = [1.5, -2.0, 65504.0, 1638.0 * 2.0_f32.powi(-14), 2.0_f32.powi(-23), 0.0];
    let (i, j) = ([0.0, 1.0, 2.0, 1.0], [0.0, 1.0, 2.0, 2.0]);
    let single = form.eval_f32(&[2.0], &[&i, &j]).expect("evaluates");
    for row in 0..4 {
        let (i, j) = (i[row] as usize, j[row] as usize);
        let c = COLOURS[i];
        let expected = [
            2.0 * c[0] + halves[2 * j],
            2.0 * c[1] + halves[2 * j + 1],
            2.0 * c[2] + (i32::MIN as f32 + COLOURS[j][i] + 0.3),
        ];
        assert_eq!([0, 1, 2].map(|component| single[component][row]), expected, "{row}");
    }
    // Beyond the end the last entry, and a negative index is beyond the end.
    let beyond = form.eval_f32(&[2.0], &[&[-1.0], &[0.0]]).expect("evaluates");
    assert_eq!(beyond[0][0], 2.0 * 9.0 + 1.5);
    let double = form.eval_f64(&[2.0], &[&[1.0], &[1.0]]).expect("evaluates");
    assert_eq!(double[0][0], 2.0 * f64::from(1.0e-30_f32) + 65504.0);
    let dual = form.eval_dual(&[2.0], &[0], &[&[0.0, 3.0], &[1.0, 1.0]]).expect("evaluates");
    let exact = |row: usize, c: usize| f64::from(COLOURS[row][c]);
    for component in 0..3 {
        let derivatives = [exact(0, component), exact(3, component)];
        assert_eq!(dual.derivatives[component], [derivatives], "{component}");
    }
}

#[test]
fn what_the_text_does_not_declare_so_is_refused() {
    for (place, table, what) in [
        (0, DataTable::new("colours", [1.0]), "is not of type `array<f32>`"),
        (0, DataTable::vectors("colours", &[[1.0; 4]]), "is not of type `array<vec4<f32>>`"),
        (1, DataTable::signed("packed", &[1]), "is not of type `array<i32>`"),
        (2, DataTable::unsigned("shift", vec![1, 2, 3]), "is not of type `array<u32>`"),
        (2, DataTable::signed("shift", &[1, 2]), "is not of type `array<i32>`"),
        (1, DataTable::unsigned("packed", vec![]), "has no numbers"),
    ] {
        let mut tables = tables();
        tables[place] = table;
        let error = Form::parse_with("t.wgsl", TEXT, "f", tables).expect_err(what).to_string();
        assert!(error.starts_with("t.wgsl: table `") && error.ends_with(what), "{error}");
    }
}

fn emitted(form: &Form, language: Language, style: TableStyle) -> Emitted {
    let gain = form.parameters().iter().map(|parameter| (parameter.name.clone(), 0.1_f32));
    let values: BTreeMap<String, f32> = gain.collect();
    emit_with_tables(form, &values, language, style, "made for a test").expect("emits")
}

fn text(form: &Form, language: Language, style: TableStyle) -> String {
    String::from_utf8(emitted(form, language, style).as_bytes().to_vec()).expect("text")
}

/// Small tables are baked: the text needs nothing beside it and gives the same bits.
#[test]
fn baked_tables_read_back_to_the_same_bits() {
    let form = form();
    let wgsl = text(&form, Language::Wgsl, TableStyle::BySize);
    assert!(
        !wgsl.contains("@group") && wgsl.contains("const colours: array<vec3<f32>, 4>"),
        "{wgsl}"
    );
    assert!(!wgsl.contains("Table"), "{wgsl}");
    let again = Form::parse("emitted.wgsl", &wgsl, "f").expect("parses again");
    let (i, j) = ([0.0, 1.0, 2.0, 1.0], [0.0, 1.0, 2.0, 2.0]);
    let before = form.eval_f32(&[0.1], &[&i, &j]).expect("evaluates");
    let after = again.eval_f32(&[], &[&i, &j]).expect("evaluates");
    assert_eq!(before, after);
    for (style, baked) in [(TableStyle::Baked, true), (TableStyle::Bound, false)] {
        let long = "@group(1) @binding(0) var<storage, read> t: array<f32>;\n\
                    fn f(i: u32) -> f32 { return t[i]; }";
        let numbers = vec![0.5; 32];
        let form = |numbers: &[f32]| {
            Form::parse_with("t.wgsl", long, "f", vec![DataTable::new("t", numbers)])
                .expect("loads")
        };
        let wgsl = |style| text(&form(&numbers), Language::Wgsl, style);
        assert_eq!(wgsl(style).contains("const t"), baked);
        assert!(wgsl(TableStyle::BySize).contains("@group(1) @binding(0)"));
        let values = BTreeMap::new();
        let bad = emit_with_tables(&form(&[f32::NAN]), &values, Language::Wgsl, style, "");
        assert_eq!(bad.is_err(), baked, "{bad:?}");
    }
}

/// Bound tables are declared where the engine binds them, and named in the header.
#[test]
fn bound_tables_are_declared_in_every_language() {
    let form = form();
    for style in [TableStyle::Bound, TableStyle::Baked] {
        for language in Language::ALL {
            let emitted = emitted(&form, language, style);
            if let Emitted::Binary(bytes) = &emitted {
                let options = naga::front::spv::Options::default();
                let module =
                    naga::front::spv::parse_u8_slice(bytes, &options).expect("naga reads it");
                let bound = module.global_variables.iter().filter(|(_, v)| v.binding.is_some());
                assert_eq!(bound.count(), if style == TableStyle::Bound { 3 } else { 0 });
                external("spirv-val", &[], bytes, ".spv");
                continue;
            }
            let mut text = String::from_utf8(emitted.as_bytes().to_vec()).expect("text");
            let header = "// Table colours: 4 entries of vec3<f32>, group 1, binding 0\n";
            assert_eq!(text.contains(header), style == TableStyle::Bound, "{text}");
            let declared = match language {
                Language::Wgsl => "@group(1) @binding(1) \nvar<storage> packed: array<u32>;",
                Language::Glsl => "layout(std430, binding = 1) readonly buffer",
                Language::Hlsl => "ByteAddressBuffer packed : register(t1, space1);",
                _ => "device type_4 const& packed",
            };
            assert_eq!(text.contains(declared), style == TableStyle::Bound, "{text}");
            match language {
                Language::Glsl => {
                    external("glslangValidator", &["-S", "comp"], text.as_bytes(), ".comp");
                }
                Language::Hlsl => {
                    text.push_str("\n[numthreads(1, 1, 1)] void main() {}\n");
                    let arguments = ["-D", "-S", "comp", "-e", "main", "-V", "-o", "/dev/null"];
                    external("glslangValidator", &arguments, text.as_bytes(), ".hlsl");
                }
                _ => {}
            }
        }
    }
}
