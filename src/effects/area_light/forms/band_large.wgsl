// approximates: sinc_squared_band
// about: up to one period a fitted rule of five nodes, beyond it the complement over a sextic; 19 constants
// cites: striae
// uses: complement, rule_of_five

// As band_medium.wgsl, two degrees higher beyond one period:
//   H(u) = 1/(u + shift) + (n + c cos u + s sin u) / d, with polynomials in u
//   n = n_a + n_b u + n_c u^2 + n_d u^3 + n_e u^4, c = c_a + c_b u + c_c u^2 + c_d u^3,
//   s = s_a + s_b u + s_c u^2 + d_e u^3 + d_f u^4, d = 1 + d_a u + d_b u^2 + d_c u^3 + d_d u^4 + d_e u^5 + d_f u^6.
// The tail is 1/u + sin(u)/u^2 - 2 cos(u)/u^3 + O(1/u^4), as it is: s ends as d does, c_d = -2 d_f,
// n_e = shift d_f and n_d = shift (d_e - shift d_f).

const HALF_TURN: f32 = 3.141592653589793;

override shift: f32 = 2.6320724;
override n_b: f32 = 7.1989374;
override n_c: f32 = 2.652562;
override c_a: f32 = -5.894213;
override c_b: f32 = -2.5529535;
override c_c: f32 = -0.3642335;
override s_a: f32 = 2.7261097;
override s_b: f32 = 4.296992;
override s_c: f32 = 1.3365185;
override d_a: f32 = 6.489201;
override d_b: f32 = 9.9883795;
override d_c: f32 = 5.3817873;
override d_d: f32 = 1.4067125;
override d_e: f32 = 0.18225363;
override d_f: f32 = 0.011676236;

fn excess(u: f32) -> f32 {
    let turns = round(u * TURNS_PER_RADIAN);
    let turn = ((u - turns * TURN_HIGH) - turns * TURN_LOW) * TURNS_PER_RADIAN;
    let rest = 0.5 - abs(turn);
    let p = 0.25 - abs(turn);
    let z = p * p;
    // As in sine_integral/auxiliary_lean.wgsl: maximal errors 3.3e-9 and 5.3e-8.
    let cosine = p * (6.28318516 + z * (-41.34165503 + z * (81.60100406
        + z * (-76.54978199 + z * 39.53670301))));
    let sine = turn * rest * (15.99999916 + z * (-59.82669477
        + z * (81.72048108 - z * 56.14480822)));
    let steady = (0.5 * HALF_TURN - 1.0 / shift - c_a)
        + u * (n_b + u * (n_c + u * shift * (d_e + d_f * (u - shift))));
    let with_cosine = c_a + u * (c_b + u * (c_c + u * (-2.0 * d_f)));
    let with_sine = s_a + u * (s_b + u * (s_c + u * (d_e + u * d_f)));
    let denominator = 1.0 + u * (d_a + u * (d_b + u * (d_c + u * (d_d + u * (d_e + u * d_f)))));
    return (steady + with_cosine * cosine + with_sine * sine) / denominator;
}
