//! A thousand seeded mutations of good files: no panic, no hang, and errors that name the file.

use rand::{Rng, SeedableRng, seq::IndexedRandom};
use rand_chacha::ChaCha8Rng;
use striae::form::Form;

use crate::SI;

const LOOPS: &str = include_str!("loops.wgsl");

/// Tokens that mutations insert.
const TOKENS: &[&str] = &[
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    ";",
    ",",
    "+",
    "-",
    "*",
    "/",
    "%",
    "=",
    "==",
    "<",
    ">",
    "&&",
    "||",
    "!",
    "~",
    "&",
    "|",
    "^",
    "<<",
    ">>",
    ".",
    ":",
    "->",
    "@",
    "0",
    "1.0",
    "1e39",
    "0x7fffffff",
    "4294967295u",
    "-2147483648",
    "f32",
    "i32",
    "u32",
    "f16",
    "vec3<f32>",
    "array<f32, 0>",
    "array<f32, 1000000000>",
    "loop",
    "while true",
    "for (;;)",
    "if",
    "else",
    "switch",
    "case",
    "default",
    "break",
    "continue",
    "return",
    "fn",
    "let",
    "var",
    "const",
    "override",
    "struct",
    "ptr<function, f32>",
    "texture_2d<f32>",
    "\u{0}",
    "\u{fffd}",
    "/*",
    "*/",
    "//",
    "\n",
    "\u{202e}",
];

fn mutate(source: &str, rng: &mut ChaCha8Rng) -> String {
    let mut characters: Vec<char> = source.chars().collect();
    for _ in 0..rng.random_range(1..=4) {
        let at = rng.random_range(0..=characters.len());
        let length = rng.random_range(0..=12).min(characters.len() - at);
        match rng.random_range(0..6) {
            0 => drop(characters.drain(at..at + length)),
            1 => characters.truncate(at),
            2 => {
                let copied: Vec<char> = characters[at..at + length].to_vec();
                let to = rng.random_range(0..=characters.len());
                characters.splice(to..to, copied);
            }
            3 if at < characters.len() => {
                characters[at] = char::from(rng.random_range(0..128_u8));
            }
            _ => {
                let token = TOKENS.choose(rng).copied().unwrap_or(";");
                characters.splice(at..at, token.chars());
            }
        }
    }
    characters.into_iter().collect()
}

#[test]
fn a_thousand_mutations() {
    let mut rng = ChaCha8Rng::seed_from_u64(0x5eed_f0e5);
    let xs: Vec<f64> = (0..20).map(|i| f64::from(i) * 0.7 - 5.0).collect();
    let singles: Vec<f32> = xs.iter().map(|&x| x as f32).collect();
    let (mut loaded, mut slowest) = (0, 0.0_f64);
    for round in 0..1200 {
        let (source, function) = if round % 2 == 0 { (SI, "si") } else { (LOOPS, "f") };
        let text = mutate(source, &mut rng);
        let started = std::time::Instant::now();
        match Form::parse("mutated.wgsl", &text, function) {
            Ok(form) => {
                loaded += 1;
                let columns = form.input_columns().len();
                let parameters = form.parameters().len();
                let free: Vec<usize> = (0..parameters).collect();
                let errors = [
                    form.eval_f64(&vec![0.6; parameters], &vec![&xs[..]; columns]).err(),
                    form.eval_f32(&vec![0.6; parameters], &vec![&singles[..]; columns]).err(),
                    form.eval_dual(&vec![0.6; parameters], &free, &vec![&xs[..]; columns]).err(),
                ];
                for error in errors.into_iter().flatten() {
                    assert!(error.to_string().contains("mutated.wgsl:"), "{error}");
                }
            }
            Err(error) => {
                let report = error.to_string();
                assert!(report.contains("mutated.wgsl"), "{report}\n{text}");
                assert!(!report.contains("front end failed"), "naga panicked on:\n{text}");
            }
        }
        slowest = slowest.max(started.elapsed().as_secs_f64());
    }
    println!("{loaded} of 1200 still load; slowest {slowest:.3} s");
    assert!(loaded > 50, "the mutations are too coarse: {loaded} load");
    // A bound on hanging, not on speed: machines are shared.
    assert!(slowest < 60.0, "slowest {slowest} s");
}
