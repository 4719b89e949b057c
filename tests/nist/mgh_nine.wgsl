// NIST StRD: MGH09. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;
override b4: f32;

fn model(x: f32) -> f32 {
    return b1 * (x * x + x * b2) / (x * x + x * b3 + b4);
}
