// approximates: sine_integral
// about: odd polynomial to 3, auxiliary functions rational in |x| over a quartic beyond, 15 constants, to f32
//     rounding
// cites: striae; the structure of Abramowitz & Stegun 5.2.8
// uses: phase

// Si(x) to f32 rounding. Below SWITCH an odd polynomial whose first term is x itself, so that the
// relative error is small down to 0; above it sgn(x) (pi/2 - f cos u - g sin u), u = |x|, with
// auxiliary functions (A&S 5.2.8) rational in u over one denominator:
//   f = (f_a + f_b u + f_c u^2 + d_d u^3) / d,  g = (g_a + g_b u + g_c u^2) / d,
//   d = 1 + d_a u + d_b u^2 + d_c u^3 + d_d u^4.
// A&S 5.2.38-39 reach 5e-7 above 1 with sixteen constants and two denominators; f and g have their
// singularities on u <= 0 only, so that powers of u serve them better than powers of 1/u^2.

const HALF_PI: f32 = 1.5707963267948966;
const SWITCH: f32 = 3.0;
// Past it, where the tail is below 1e-6, the phase stands still; no overflow, no NaN at infinity.
const LAST_PHASE: f32 = 1e6;

override p_a: f32 = -0.055555529;
override p_b: f32 = 0.0016666319;
override p_c: f32 = -2.8328787e-5;
override p_d: f32 = 3.0289832e-7;
override p_e: f32 = -1.9567224e-9;
override d_a: f32 = 2.1658238;
override d_b: f32 = 2.0435615;
override d_c: f32 = 0.51179412;
override d_d: f32 = 0.10125287;
override f_a: f32 = 1.1255984;
override f_b: f32 = 1.8405115;
override f_c: f32 = 0.51182036;
override g_a: f32 = 1.3333579;
override g_b: f32 = 0.51674637;
override g_c: f32 = 0.10116735;

fn sine_integral(x: f32) -> f32 {
    let u = min(abs(x), LAST_PHASE);
    let square = u * u;
    let series = p_a + square * (p_b + square * (p_c + square * (p_d + square * p_e)));
    let near = u + u * square * series;
    let wave = cosine_and_sine(u);
    let denominator = 1.0 + u * (d_a + u * (d_b + u * (d_c + u * d_d)));
    let f = f_a + u * (f_b + u * (f_c + u * d_d));
    let g = g_a + u * (g_b + u * g_c);
    let far = HALF_PI - (f * wave.x + g * wave.y) / denominator;
    return sign(x) * select(far, near, u < SWITCH);
}
