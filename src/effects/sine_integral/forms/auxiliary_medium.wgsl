// approximates: sine_integral
// about: auxiliary functions rational in |x| over a cubic, 6 constants, no branch
// cites: striae; the structure of Abramowitz & Stegun 5.2.8

// As auxiliary_small.wgsl, one degree higher:
//   f = (pi/2 + f_a u + d_c u^2) / d,  g = (g_a + g_b u) / d,  d = 1 + d_a u + d_b u^2 + d_c u^3.

const HALF_PI: f32 = 1.5707963267948966;
// One multiplication reduces the phase: see auxiliary_small.wgsl.
const TURNS_PER_RADIAN: f32 = 0.15915494309189535;
// Past it, where the tail is below 1e-6, the phase stands still; no overflow, no NaN at infinity.
const LAST_PHASE: f32 = 1e6;

override d_a: f32 = 2.4366898;
override d_b: f32 = 1.3488207;
override d_c: f32 = 0.24378761;
override f_a: f32 = 1.3758976;
override g_a: f32 = 1.4494745;
override g_b: f32 = 0.23568740;

fn sine_integral(x: f32) -> f32 {
    let u = min(abs(x), LAST_PHASE);
    let turns = u * TURNS_PER_RADIAN;
    let turn = turns - round(turns);
    let rest = 0.5 - abs(turn);
    let p = 0.25 - abs(turn);
    let z = p * p;
    // sin(2 pi p) on [-1/4, 1/4], maximal error 5.9e-7 at its ends.
    let cosine = p * (6.283164044 + z * (-41.337142354 + z * (81.340768243 - z * 70.993426414)));
    // cos(2 pi p) on [-1/4, 1/4], maximal error 7.8e-6 near p = 0.21.
    let sine = turn * rest * (15.999874923 + z * (-59.767308485 + z * 77.939304389));
    let denominator = 1.0 + u * (d_a + u * (d_b + u * d_c));
    let f = HALF_PI + u * (f_a + u * d_c);
    let g = g_a + u * g_b;
    return sign(x) * (HALF_PI - (f * cosine + g * sine) / denominator);
}
