// approximates: sine_integral
// about: auxiliary functions rational in |x| over a quintic that shares the numerator of f, 8 constants, no
//     branch, to a few ulp of f32
// cites: striae; the structure of Abramowitz & Stegun 5.2.8

// As auxiliary_medium.wgsl, two degrees higher, to a few ulp of f32:
//   f = (pi/2 + f_a u + f_b u^2 + d_d u^3 + d_e u^4) / d,
//   g = (g_a + g_b u + g_c u^2 + d_e u^3) / d,
//   d = 1 + (d_a + pi/2) u + (f_a + 2 d_d) u^2 + (f_b + 2 d_e) u^3 + d_d u^4 + d_e u^5.
// f = 1/u - 2/u^3 + O(1/u^4) and g = 1/u^2 + O(1/u^3) as A&S 5.2.34-35 want it, so d shares what it has
// with the numerator of f: eight constants do what fifteen do in auxiliary_large.wgsl.

const HALF_PI: f32 = 1.5707963267948966;
// One multiplication reduces the phase: see auxiliary_small.wgsl.
const TURNS_PER_RADIAN: f32 = 0.15915494309189535;
// Past it, where the tail is below 1e-6, the phase stands still; no overflow, no NaN at infinity.
const LAST_PHASE: f32 = 1e6;

override d_a: f32 = 2.1824617;
override d_d: f32 = 0.20693259;
override d_e: f32 = 0.0139641045;
override f_a: f32 = 3.0069232;
override f_b: f32 = 1.2199965;
override g_a: f32 = 1.8886913;
override g_b: f32 = 1.1854653;
override g_c: f32 = 0.20629999;

fn sine_integral(x: f32) -> f32 {
    let u = min(abs(x), LAST_PHASE);
    let turns = u * TURNS_PER_RADIAN;
    let turn = turns - round(turns);
    let rest = 0.5 - abs(turn);
    let p = 0.25 - abs(turn);
    let z = p * p;
    // sin(2 pi p) on [-1/4, 1/4], maximal error 3.3e-9 at its ends.
    let cosine = p * (6.28318516 + z * (-41.34165503 + z * (81.60100406
        + z * (-76.54978199 + z * 39.53670301))));
    // cos(2 pi p) on [-1/4, 1/4], maximal error 5.3e-8 near p = 0.21.
    let sine = turn * rest * (15.99999916 + z * (-59.82669477
        + z * (81.72048108 - z * 56.14480822)));
    let shared_tail = u * (d_d + u * d_e);
    let f = HALF_PI + u * (f_a + u * (f_b + shared_tail));
    let g = g_a + u * (g_b + u * (g_c + u * d_e));
    let denominator = 1.0 + u * (d_a + 2.0 * shared_tail + f);
    return sign(x) * (HALF_PI - (f * cosine + g * sine) / denominator);
}
