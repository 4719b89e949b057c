// NIST StRD: ultrasonic calibration, Chwirut1 and Chwirut2. Parameters are named as NIST names them.
override b1: f32;
override b2: f32;
override b3: f32;

fn model(x: f32) -> f32 {
    return exp(-b1 * x) / (b2 + b3 * x);
}
