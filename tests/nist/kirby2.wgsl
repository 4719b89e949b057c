// NIST StRD: quadratic over quadratic. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;
override b4: f32;
override b5: f32;

fn model(x: f32) -> f32 {
    return (b1 + b2 * x + b3 * x * x) / (1.0 + b4 * x + b5 * x * x);
}
