// NIST StRD: y = b1 (1 - (1 + 2 b2 x)^(-1/2)). Parameters are named as NIST names them.
override b1: f32;
override b2: f32;

fn model(x: f32) -> f32 {
    return b1 * (1.0 - 1.0 / sqrt(1.0 + 2.0 * b2 * x));
}
