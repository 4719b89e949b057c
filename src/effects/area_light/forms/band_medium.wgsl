// approximates: sinc_squared_band
// about: up to one period a fitted rule of four nodes, beyond it the complement over a quartic; 13 constants
// cites: striae
// uses: complement, rule_of_four

// B(x0, x1), the integral of sinc^2(t/2), without cancellation. Up to one period a quadrature rule whose
// terms all have one sign; beyond it 2 (H(a) - H(b)), or 2 (pi - H(a) - H(b)) across 0, with
//   H(u) = 1/(u + shift) + (n_a + n_b u + n_c u^2 + (c_a + c_b u) cos u + (s_a + s_b u + d_d u^2) sin u) / d,
//   d = 1 + d_a u + d_b u^2 + d_c u^3 + d_d u^4,
// where n_a makes H(0) = pi/2, and n_c makes the tail 1/u + sin(u)/u^2, as it is.

const HALF_TURN: f32 = 3.141592653589793;

override shift: f32 = 1.616638;
override n_b: f32 = 1.3374003;
override c_a: f32 = -2.4102316;
override c_b: f32 = -0.4198889;
override s_a: f32 = 1.6922369;
override s_b: f32 = 1.1839998;
override d_a: f32 = 2.8632348;
override d_b: f32 = 3.458309;
override d_c: f32 = 1.1675842;
override d_d: f32 = 0.21049008;

fn excess(u: f32) -> f32 {
    let turns = u * TURNS_PER_RADIAN;
    let turn = turns - round(turns);
    let rest = 0.5 - abs(turn);
    let p = 0.25 - abs(turn);
    let z = p * p;
    // As in sine_integral/auxiliary_medium.wgsl: maximal errors 5.9e-7 and 7.8e-6.
    let cosine = p * (6.283164044 + z * (-41.337142354 + z * (81.340768243 - z * 70.993426414)));
    let sine = turn * rest * (15.999874923 + z * (-59.767308485 + z * 77.939304389));
    let steady = (0.5 * HALF_TURN - 1.0 / shift - c_a) + u * (n_b + u * (shift * d_d));
    let denominator = 1.0 + u * (d_a + u * (d_b + u * (d_c + u * d_d)));
    return (steady + (c_a + u * c_b) * cosine + (s_a + u * (s_b + u * d_d)) * sine) / denominator;
}
