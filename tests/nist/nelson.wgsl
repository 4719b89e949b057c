// NIST StRD: the logarithm of the breakdown strength. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;

fn model(x1: f32, x2: f32) -> f32 {
    return b1 - b2 * x1 * exp(-b3 * x2);
}
