// NIST StRD: three decays, Lanczos1 and Lanczos3. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;
override b4: f32;
override b5: f32;
override b6: f32;

fn model(x: f32) -> f32 {
    return b1 * exp(-b2 * x) + b3 * exp(-b4 * x) + b5 * exp(-b6 * x);
}
