// approximates: sinusoid_zero_order
// about: square of a quintic in a^2, 5 constants
// cites: striae

// J_0 as a polynomial in the square of the phase, 1 without relief, up to one turn; squared, so that it cannot be
// negative. Beyond one turn, past its second zero, it stays at its last value.

override c_a: f32 = -0.2497057;
override c_b: f32 = 0.01547516;
override c_c: f32 = -0.0004126789;
override c_d: f32 = 5.489427e-6;
override c_e: f32 = -3.111225e-8;

const TURN_SQUARED: f32 = 39.47841760435743;

fn sinusoid_zero_order(phase: f32) -> f32 {
    let s = min(phase * phase, TURN_SQUARED);
    let amplitude = 1.0 + s * (c_a + s * (c_b + s * (c_c + s * (c_d + s * c_e))));
    return amplitude * amplitude;
}
