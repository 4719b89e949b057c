// NIST StRD: energy against temperature, y = b1 x^b2. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;

fn model(x: f32) -> f32 {
    return b1 * pow(x, b2);
}
