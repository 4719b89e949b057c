// NIST StRD: Rat42, logistic growth. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;

fn model(x: f32) -> f32 {
    return b1 / (1.0 + exp(b2 - b3 * x));
}
