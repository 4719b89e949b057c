// NIST StRD: monomolecular adsorption, y = b1 (1 - exp(-b2 x)). Parameters are named as NIST names them.
override b1: f32;
override b2: f32;

fn model(x: f32) -> f32 {
    return b1 * (1.0 - exp(-b2 * x));
}
