// NIST StRD: MGH17. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;
override b4: f32;
override b5: f32;

fn model(x: f32) -> f32 {
    return b1 + b2 * exp(-x * b4) + b3 * exp(-x * b5);
}
