// NIST StRD: quantum defects. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;
override b4: f32;

fn model(x: f32) -> f32 {
    // A literal of pi would be an f32. The argument keeps 4 atan(1) from being folded into one, so
    // that a lane of f64 computes it in f64.
    let pi = 4.0 * atan(1.0 + 0.0 * x);
    return b1 - b2 * x - atan(b3 / (x - b4)) / pi;
}
