// approximates: sinusoid_first_order
// about: square of a times a quintic in a^2, 5 constants
// cites: striae

// J_1 over the phase as a polynomial in its square, 1/2 without relief, up to one turn; squared. Beyond one turn it
// stays at its last value.

override c_a: f32 = -0.06244491;
override c_b: f32 = 0.002585058;
override c_c: f32 = -5.204744e-5;
override c_d: f32 = 5.631698e-7;
override c_e: f32 = -2.743538e-9;

const TURN: f32 = 6.283185307179586;

fn sinusoid_first_order(phase: f32) -> f32 {
    let a = min(phase, TURN);
    let s = a * a;
    let amplitude = a * (0.5 + s * (c_a + s * (c_b + s * (c_c + s * (c_d + s * c_e)))));
    return amplitude * amplitude;
}
