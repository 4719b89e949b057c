// NIST StRD: two Gaussians on a decaying baseline, Gauss1 and Gauss2. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;
override b4: f32;
override b5: f32;
override b6: f32;
override b7: f32;
override b8: f32;

fn model(x: f32) -> f32 {
    let left = (x - b4) / b5;
    let right = (x - b7) / b8;
    return b1 * exp(-b2 * x) + b3 * exp(-left * left) + b6 * exp(-right * right);
}
