// approximates: sinc_squared_band
// about: up to one period a fitted rule of four nodes, beyond it the complement over a cubic; 9 constants
// cites: striae
// uses: complement, rule_of_four

// As band_medium.wgsl, one degree lower beyond one period:
//   H(u) = 1/(u + shift) + (n_a + n_b u + c_a cos u + (s_a + d_c u) sin u) / d,
//   d = 1 + d_a u + d_b u^2 + d_c u^3, n_b = shift d_c.

const HALF_TURN: f32 = 3.141592653589793;

override shift: f32 = 0.2576085;
override c_a: f32 = -3.4354086;
override s_a: f32 = 2.8754253;
override d_a: f32 = 5.1306996;
override d_b: f32 = 3.47626;
override d_c: f32 = 1.3593905;

fn excess(u: f32) -> f32 {
    let turns = u * TURNS_PER_RADIAN;
    let turn = turns - round(turns);
    let rest = 0.5 - abs(turn);
    let p = 0.25 - abs(turn);
    let z = p * p;
    // As in sine_integral/auxiliary_small.wgsl: maximal errors 6.8e-5 and 7.3e-4.
    let cosine = p * (6.281280067 + z * (-41.0952419 + z * 73.5855022));
    let sine = turn * rest * (15.988282007 - z * 56.818491412);
    let steady = (0.5 * HALF_TURN - 1.0 / shift - c_a) + u * (shift * d_c);
    let denominator = 1.0 + u * (d_a + u * (d_b + u * d_c));
    return (steady + c_a * cosine + (s_a + u * d_c) * sine) / denominator;
}
