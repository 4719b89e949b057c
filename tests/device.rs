//! Forms on the device: exactness, sizes, error paths and timing.
//!
//! Without an adapter these tests print a notice and pass; with `STRIAE_REQUIRE_GPU=1` they fail.

use exr::prelude::f16;
use std::f32::consts::PI;
use std::time::{Duration, Instant};
use striae::form::{DataTable, Form, FormError, Input};
use striae::gpu::{
    Device, GpuError, TimedForm, Timing, TimingOptions, list_adapters, required, time,
};
use striae::numeric::measured::Measured;
use striae::registry::Registry;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The device, or `None` with a notice where there is none and none is required.
fn device() -> Result<Option<Device>, Box<dyn std::error::Error>> {
    match Device::open() {
        Ok(device) => Ok(Some(device)),
        Err(error) if required() => Err(error.into()),
        Err(error) => {
            println!("skipped: {error}");
            Ok(None)
        }
    }
}

/// `count` numbers spread evenly over [low, high].
fn spread(low: f32, high: f32, count: usize) -> Vec<f32> {
    let last = (count - 1) as f64;
    let width = f64::from(high) - f64::from(low);
    (0..count).map(|i| (f64::from(low) + width * i as f64 / last) as f32).collect()
}

/// Distance of two finite numbers of one sign, in units of the last place.
fn ulps(a: f32, b: f32) -> u32 {
    let ordered = |v: f32| {
        let bits = v.to_bits() as i32;
        if bits < 0 { i32::MIN.wrapping_sub(bits) } else { bits }
    };
    ordered(a).abs_diff(ordered(b))
}

/// One vector per output column.
type Columns = Vec<Vec<f32>>;

/// Results of the device and of the f32 lanes.
fn both(
    device: &Device,
    source: &str,
    parameters: &[f32],
    inputs: &[Vec<f32>],
) -> Result<(Columns, Columns), Box<dyn std::error::Error>> {
    let form = Form::parse("test.wgsl", source, "f")?;
    let slices: Vec<&[f32]> = inputs.iter().map(Vec::as_slice).collect();
    let lanes = form.eval_f32(parameters, &slices)?;
    Ok((device.compile(&form, parameters)?.evaluate(inputs)?, lanes))
}

#[test]
fn sums_differences_and_products_are_exact() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let a = spread(-1e3, 1e3, 4001);
    let b: Vec<f32> = spread(0.37, 5e-3, 4001);
    for operator in ["+", "-", "*"] {
        let source = format!("fn f(a: f32, b: f32) -> f32 {{ return a {operator} b; }}");
        let (got, lanes) = both(&device, &source, &[], &[a.clone(), b.clone()])?;
        for (i, (got, lanes)) in got[0].iter().zip(&lanes[0]).enumerate() {
            assert_eq!(got.to_bits(), lanes.to_bits(), "{:e} {operator} {:e}", a[i], b[i]);
        }
    }
    Ok(())
}

/// WGSL grants division 2.5 ulp for divisors in [2^-126, 2^126].
#[test]
fn quotients_are_within_what_wgsl_grants() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let a = spread(-1e3, 1e3, 4001);
    let b: Vec<f32> = spread(0.37, 5e3, 4001);
    let source = "fn f(a: f32, b: f32) -> f32 { return a / b; }";
    let (got, lanes) = both(&device, source, &[], &[a, b])?;
    let worst = got[0].iter().zip(&lanes[0]).map(|(&got, &lanes)| ulps(got, lanes)).max();
    println!("{}: division, worst {worst:?} ulp", device.description());
    assert!(worst <= Some(2), "{worst:?} ulp");
    Ok(())
}

#[test]
fn vectors_are_columns() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let source = "fn f(p: vec2<f32>, s: f32, q: vec3<f32>) -> vec3<f32> {\n\
                  return q + s * vec3<f32>(p.y, p.x, 1.0);\n}";
    let columns: Vec<Vec<f32>> =
        (0..6).map(|c| (0..100).map(|i| (8 * i + c) as f32).collect()).collect();
    let (got, lanes) = both(&device, source, &[], &columns)?;
    // Small integers: exact with or without contraction.
    assert_eq!(got, lanes);
    assert_eq!([got[0][1], got[1][1], got[2][1]], [101.0, 92.0, 23.0]);
    Ok(())
}

const POLYNOMIAL: &str = "
const COEFFICIENTS = array<f32, 4>(1.0, -2.0, 0.5, 0.25);
fn f(x: f32) -> f32 {
    var coefficients = COEFFICIENTS;
    var sum = 0.0;
    for (var i = 3; i >= 0; i--) { sum = sum * x + coefficients[i]; }
    if (x < 0.0) { return -sum; }
    return sum;
}";

#[test]
fn loops_branches_and_tables_work() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    // Eighths up to 4: every step of the polynomial is exact.
    let x: Vec<f32> = (-32..=32).map(|i| i as f32 / 8.0).collect();
    let (got, lanes) = both(&device, POLYNOMIAL, &[], &[x])?;
    assert_eq!(got, lanes);
    Ok(())
}

/// Tables lie in buffers: their forms compile at once and return what the lanes return.
#[test]
fn lookups_compile_and_agree_with_the_lanes() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let mut x = spread(-10.0, 10.0, 20_001);
    x.extend(spread(10.0, 1e4, 10_001));
    for name in ["lookup_64", "lookup_256", "lookup_1024"] {
        let entry = Registry::builtin().form(&format!("sine_integral/{name}")).ok_or(name)?;
        let form = entry.load()?;
        let lanes = form.eval_f32(&[], &[&x])?;
        let start = Instant::now();
        let got = device.compile(&form, &[])?.evaluate(std::slice::from_ref(&x))?;
        let elapsed = start.elapsed();
        let pairs = x.iter().zip(got[0].iter().zip(&lanes[0]));
        let worst = pairs.map(|(&x, (&got, &lanes))| (ulps(got, lanes), x)).max_by_key(|w| w.0);
        println!("{name}: compiled and run in {elapsed:?}, worst (ulp, x) {worst:?}");
        assert!(worst.is_some_and(|(ulps, _)| ulps <= 4), "{name}: {worst:?}");
        // Copied into function memory the largest table took minutes: a bound on hanging, not on speed.
        assert!(elapsed < Duration::from_secs(60), "{name}: {elapsed:?}");
    }
    Ok(())
}

#[test]
fn parameters_are_set_by_name_and_by_id() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let source = "override a: f32 = 1.0;\n@id(3) override b: f32;\noverride n: i32 = 2;\n\
                  override unused: f32;\n\
                  fn f(x: f32) -> f32 { return a * x + b * f32(n); }";
    let form = Form::parse("test.wgsl", source, "f")?;
    let values: Vec<f32> = form
        .parameters()
        .iter()
        .map(|parameter| if parameter.name == "a" { 3.0 } else { 0.5 })
        .collect();
    let got = device.compile(&form, &values)?.evaluate(&[vec![1.0, 2.0]])?;
    assert_eq!(got, [[4.0, 7.0]]);
    assert_eq!(got, form.eval_f32(&values, &[&[1.0, 2.0]])?);
    let wrong = device.compile(&form, &[]).map(|_| ());
    assert!(matches!(wrong, Err(GpuError::ParameterCount { got: 0, .. })), "{wrong:?}");
    Ok(())
}

/// More than one chunk, and more workgroups than one dimension of a dispatch holds.
#[test]
fn millions_of_points_are_evaluated_in_order() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let x: Vec<f32> = (0..5_000_001_u32).map(|i| i as f32).collect();
    let source = "fn f(x: f32) -> vec2<f32> { return vec2<f32>(x + 1.0, -x); }";
    let form = Form::parse("test.wgsl", source, "f")?;
    let kernel = device.compile(&form, &[])?;
    let got = kernel.evaluate(std::slice::from_ref(&x))?;
    assert_eq!([got[0].len(), got[1].len()], [x.len(), x.len()]);
    for (i, &x) in x.iter().enumerate() {
        assert_eq!([got[0][i], got[1][i]], [x + 1.0, -x]);
    }
    assert_eq!(kernel.evaluate(&[vec![]])?, [vec![0.0_f32; 0], vec![]]);
    Ok(())
}

#[test]
fn columns_that_do_not_fit_are_refused() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let form = Form::parse("test.wgsl", "fn f(a: f32, b: f32) -> f32 { return a + b; }", "f")?;
    let kernel = device.compile(&form, &[])?;
    let missing = kernel.evaluate(&[vec![1.0]]);
    assert!(matches!(missing, Err(GpuError::ColumnCount { expected: 2, got: 1, .. })));
    let ragged = kernel.evaluate(&[vec![1.0], vec![]]);
    assert!(matches!(ragged, Err(GpuError::RowCount { column: 1, expected: 1, got: 0, .. })));
    Ok(())
}

/// A parameter may turn a form into one that the compiler refuses: the error is a value.
#[test]
fn a_form_that_does_not_compile_is_an_error() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let source = "override a: f32 = 1.0;\nfn f(x: f32) -> f32 { return x * a; }";
    let form = Form::parse("test.wgsl", source, "f")?;
    let error = device.compile(&form, &[f32::NAN]).map(|_| ());
    let Err(GpuError::Compile { origin, report, .. }) = error else {
        return Err(format!("{error:?}").into());
    };
    println!("{origin}: {report}");
    // The device is still good after an error.
    assert_eq!(device.compile(&form, &[2.0])?.evaluate(&[vec![4.0]])?, [[8.0]]);
    Ok(())
}

/// Prints how far the device's elementary functions are from the correctly rounded ones; WGSL
/// grants sin and cos 2^-11 absolute on [-π, π] and exp (3 + 2|x|) ulp.
#[test]
fn elementary_functions_are_near_the_correctly_rounded_ones() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    println!("{}", device.description());
    for (name, bound) in [("sin", PI), ("cos", PI), ("exp", 10.0), ("tanh", 5.0)] {
        let x = spread(-bound, bound, 100_001);
        let source = format!("fn f(x: f32) -> f32 {{ return {name}(x); }}");
        let (got, lanes) = both(&device, &source, &[], std::slice::from_ref(&x))?;
        let (mut absolute, mut relative) = ((0.0_f32, 0.0_f32), (0.0_f32, 0.0_f32));
        for ((&x, &got), &exact) in x.iter().zip(&got[0]).zip(&lanes[0]) {
            let error = (got - exact).abs();
            assert!(error.is_finite(), "{name}({x}) = {got}");
            if error > absolute.0 {
                absolute = (error, x);
            }
            if error / exact.abs() > relative.0 {
                relative = (error / exact.abs(), x);
            }
        }
        println!(
            "{name:5} on ±{bound}: absolute {:.2e} at {}, relative {:.2e} at {}",
            absolute.0, absolute.1, relative.0, relative.1
        );
        if matches!(name, "sin" | "cos") {
            assert!(absolute.0 <= 2.0_f32.powi(-11), "{name}: {absolute:?}");
        }
        if name == "exp" {
            assert!(relative.0 <= 23.0 * f32::EPSILON, "{name}: {relative:?}");
        }
    }
    Ok(())
}

/// velinov2018 eq. 29, as published.
const PUBLISHED: &str = "
override a: f32 = 0.66142739;
override b: f32 = 0.38272292;
fn f(x: f32) -> f32 {
    let s = sign(x);
    let d = x - s * b;
    return 1.5707963 * tanh(x) - a * x / (1.0 + d * d) + s * (1.0 - cos(x)) / (1.0 + abs(x));
}";

/// Abramowitz & Stegun 5.2.38 and 5.2.39, with the series below 1.
const RATIONAL: &str = "
fn f(x: f32) -> f32 {
    let t = x * x;
    if (t < 1.0) {
        return x * (1.0 + t * (-1.0 / 18.0 + t * (1.0 / 600.0 + t * (-1.0 / 35280.0))));
    }
    let u = abs(x);
    let fn_ = (((t + 38.027264) * t + 265.187033) * t + 335.677320) * t + 38.102495;
    let fd = (((t + 40.021433) * t + 322.624911) * t + 570.236280) * t + 157.105423;
    let gn = (((t + 42.242855) * t + 302.757865) * t + 352.018498) * t + 21.821899;
    let gd = (((t + 48.196927) * t + 482.485984) * t + 1114.978885) * t + 449.690326;
    return sign(x) * (1.5707963 - fn_ / (u * fd) * cos(u) - gn / (t * gd) * sin(u));
}";

#[test]
fn costs_are_measured_against_the_empty_loop() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let published = Form::parse("published.wgsl", PUBLISHED, "f")?;
    let rational = Form::parse("rational.wgsl", RATIONAL, "f")?;
    let product =
        Form::parse("p.wgsl", "fn f(p: vec3<f32>) -> f32 { return p.x * p.y + p.z; }", "f")?;
    let wide = [spread(-10.0, 10.0, 20_000)];
    let wide = [Input::from(&wide[0])];
    let three = [wide[0]; 3];
    let counter: Vec<u32> = (0..20_000).map(|i| i * 200_003).collect();
    let counters = [Input::from(&counter), wide[0]];
    let random = Form::parse("pcg.wgsl", PCG, "f")?;
    let published_values = [0.66142739_f64 as f32, 0.38272292_f64 as f32];
    let form = |name, form, parameters, inputs| TimedForm { name, form, parameters, inputs };
    let forms = [
        form("published", &published, &published_values[..], &wide[..]),
        form("rational", &rational, &[], &wide),
        form("product", &product, &[], &three),
        form("random", &random, &[], &counters),
        form("mistaken", &published, &[], &wide),
    ];
    let options = TimingOptions { baseline: Some("published".to_owned()), ..Default::default() };
    let start = Instant::now();
    let timings = time(&device, &forms, &options)?;
    println!("{}: {:.2} s in all", device.description(), start.elapsed().as_secs_f64());
    for timing in &timings {
        print(timing);
    }
    let net = |name: &str| {
        let timing = timings.iter().find(|timing| timing.name == name)?;
        timing.cost.value().map(|measurement| measurement.net_ns.median)
    };
    // Some sixty operations cost more than nothing, and more than two.
    assert!(net("published") > Some(0.0) && net("published") > net("product"));
    assert!(net("rational") > Some(0.0));
    assert!(net("random") > Some(0.0));
    assert_eq!(net("mistaken"), None);
    Ok(())
}

/// No form compiles in no time; the same device still times them with time enough.
#[test]
fn a_form_that_takes_too_long_is_not_measured() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let form = Form::parse("rational.wgsl", RATIONAL, "f")?;
    let x = spread(-10.0, 10.0, 1000);
    let inputs = [Input::from(&x)];
    let timed = TimedForm { name: "rational", form: &form, parameters: &[], inputs: &inputs };
    let options = TimingOptions { rounds: 9, budget_s: 0.5, ..Default::default() };
    let hasty = TimingOptions { compile_limit_s: 0.0, ..options.clone() };
    let timings = time(&device, &[timed, timed], &hasty)?;
    assert_eq!(timings.len(), 2);
    for timing in timings {
        let Measured::NotMeasured(reason) = timing.cost else {
            return Err(format!("{timing:?}").into());
        };
        assert_eq!(reason, "the device did not compile and run it once within 0.0 s");
    }
    let timings = time(&device, &[timed], &options)?;
    assert!(timings[0].cost.value().is_some(), "{timings:?}");
    Ok(())
}

/// PCG-RXS-M-XS of a counter and a stream, as the top 24 bits of it on [0, 1): O'Neill,
/// "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms", 2014.
const PCG: &str = "
fn pcg(seed: u32) -> u32 {
    let state = seed * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}
fn f(counter: u32, scale: f32) -> f32 {
    return f32(pcg(counter) >> 8u) * exp2(-24.0) * scale;
}";

/// Integers go to the device whole: the hash of every counter is that of the lanes, to the bit.
#[test]
fn integer_arguments_are_exact_on_the_device() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let source = PCG.replace(" * exp2(-24.0) * scale", " + scale");
    let form = Form::parse("pcg.wgsl", &source, "f")?;
    let counters: Vec<u32> = (0..4096_u32).map(|i| u32::MAX - i * 1_048_573).collect();
    let zeros = vec![0.0_f32; counters.len()];
    let inputs = [Input::from(&counters), Input::from(&zeros)];
    let kernel = device.compile(&form, &[])?;
    let got = kernel.evaluate_inputs(&inputs)?;
    assert_eq!(got, form.eval_f32_inputs(&[], &inputs)?);
    // A column of f64 holds every u32 too.
    let wide: Vec<f64> = counters.iter().map(|&counter| counter.into()).collect();
    assert_eq!(got, kernel.evaluate_inputs(&[Input::from(&wide), inputs[1]])?);
    let distinct: std::collections::BTreeSet<u32> = got[0].iter().map(|v| v.to_bits()).collect();
    assert!(distinct.len() > 4000, "{}", distinct.len());
    let refused = kernel.evaluate(&[vec![1.0, 2.5], vec![0.0; 2]]);
    let Err(GpuError::Form(error @ FormError::Input { row: 1, .. })) = refused else {
        return Err(format!("{refused:?}").into());
    };
    let text = "pcg.wgsl: function `f`: argument `counter`, row 1: expected a whole number from 0 \
                to 4294967295, got 2.5";
    assert_eq!(error.to_string(), text);
    Ok(())
}

/// Tables of every type beside a constant array of the text: one list for lanes and device.
#[test]
fn typed_tables_agree_with_the_lanes() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let constants: Vec<String> = (0..40).map(|i| format!("{i}.25")).collect();
    let source = format!(
        "@group(1) @binding(0) var<storage, read> quads: array<vec4<f32>>;\n\
         @group(1) @binding(1) var<storage, read> triples: array<vec3<f32>>;\n\
         @group(1) @binding(2) var<storage, read> halves: array<u32>;\n\
         @group(1) @binding(3) var<storage, read> steps: array<i32>;\n\
         const LONG = array<f32, 40>({});\n\
         fn f(i: i32, at: vec2<u32>) -> vec3<f32> {{\n\
         let pair = unpack2x16float(halves[at.x]);\n\
         return triples[i] * pair.x + quads[at.y].wyx + vec3(f32(steps[i]), LONG[at.x], pair.y);\n}}",
        constants.join(", ")
    );
    let quads: Vec<[f32; 4]> = (0..50).map(|i| [0, 1, 2, 3].map(|c| (4 * i + c) as f32)).collect();
    let triples: Vec<[f32; 3]> = (0..40).map(|i| [0, 1, 2].map(|c| (3 * i + c) as f32)).collect();
    // The first eight are sixteenths that f16 holds, then its smallest number and its largest.
    let halves: Vec<f32> = (0..60)
        .map(|i| match i {
            0..50 => i as f32 / 16.0,
            50..55 => 2.0_f32.powi(-24),
            _ => -65504.0,
        })
        .collect();
    let half = |value: f32| u32::from(f16::from_f32(value).to_bits());
    let pair = |pair: &[f32]| half(pair[0]) | half(pair[1]) << 16;
    let steps: Vec<i32> = (0..40).map(|i| i * i - 300).collect();
    let tables = vec![
        DataTable::vectors("quads", &quads),
        DataTable::vectors("triples", &triples),
        DataTable::unsigned("halves", halves.chunks(2).map(pair).collect::<Vec<u32>>()),
        DataTable::signed("steps", &steps),
    ];
    let form = Form::parse_with("tables.wgsl", &source, "f", tables)?;
    let names: Vec<&str> = form.tables().iter().map(DataTable::name).collect();
    assert_eq!(names, ["quads", "triples", "halves", "steps", "LONG"]);
    assert_eq!(form.input_columns(), ["i", "at_x", "at_y"]);
    let rows = || 0..40_u32;
    let i: Vec<i32> = rows().map(|row| row as i32).collect();
    let first: Vec<u32> = rows().map(|row| row * 7 % 30).collect();
    let second: Vec<u32> = rows().map(|row| row * 11 % 50).collect();
    let inputs = [Input::from(&i), Input::from(&first), Input::from(&second)];
    let lanes = form.eval_f32_inputs(&[], &inputs)?;
    assert_eq!(device.compile(&form, &[])?.evaluate_inputs(&inputs)?, lanes);
    // Row 2: triples[2] = (6, 7, 8), halves[14] = (28, 29) / 16, quads[22] = (88, 89, 90, 91).
    let expected =
        [6.0 * 1.75 + 91.0 - 296.0, 7.0 * 1.75 + 89.0 + 14.25, 8.0 * 1.75 + 88.0 + 1.8125];
    assert_eq!([lanes[0][2], lanes[1][2], lanes[2][2]], expected);
    Ok(())
}

/// A kernel is compiled once per device, whatever the numbers of its tables.
#[test]
fn a_kernel_is_compiled_once() -> Outcome {
    let Some(device) = device()? else { return Ok(()) };
    let text = "@group(1) @binding(0) var<storage, read> t: array<f32>;\n\
                override gain: f32 = 2.0;\nfn f(x: f32) -> f32 { return gain * t[u32(x)]; }";
    let with = |numbers: [f32; 2]| {
        Form::parse_with("t.wgsl", text, "f", vec![DataTable::new("t", numbers)])
    };
    let evaluate = |form: &Form, gain: f32| {
        device
            .compile(form, &[gain])?
            .evaluate(&[vec![0.0, 1.0]])
            .map(|mut columns| columns.remove(0))
    };
    let form = with([1.0, 3.0])?;
    assert_eq!(evaluate(&form, 2.0)?, [2.0, 6.0]);
    assert_eq!(evaluate(&form, 2.0)?, [2.0, 6.0]);
    assert_eq!(evaluate(&with([5.0, 7.0])?, 2.0)?, [10.0, 14.0]);
    let count = device.pipelines();
    assert_eq!((count.made, count.reused), (1, 2));
    assert_eq!(evaluate(&form, 4.0)?, [4.0, 12.0]);
    assert_eq!(device.pipelines().made, 2);
    Ok(())
}

fn print(timing: &Timing) {
    match &timing.cost {
        Measured::Value(measured) => {
            let (net, empty) = (measured.net_ns, measured.empty_ns.median);
            println!(
                "{:10} net {:.3} ns [{:.3}, {:.3}], empty loop {empty:.3} ns, ratio {:?}, {:?}",
                timing.name,
                net.median,
                net.p25,
                net.p75,
                measured.ratio.map(|ratio| [ratio.p25, ratio.median, ratio.p75]),
                measured.clock,
            );
        }
        Measured::NotMeasured(reason) => println!("{:10} not measured: {reason}", timing.name),
    }
}

#[test]
fn adapters_are_listed_with_one_preferred() -> Outcome {
    let adapters = list_adapters();
    println!("{}", serde_json::to_string_pretty(&adapters)?);
    if let Some(device) = device()? {
        let preferred: Vec<_> = adapters.iter().filter(|adapter| adapter.preferred).collect();
        assert_eq!(preferred.len(), 1);
        assert_eq!(&preferred[0].description, device.description());
    }
    Ok(())
}
