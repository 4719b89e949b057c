// approximates: sine_integral
// about: auxiliary functions rational in |x| over a quadratic, 3 constants, no branch
// cites: striae; the structure of Abramowitz & Stegun 5.2.8

// Si(x) = sgn(x) (pi/2 - f cos u - g sin u), u = |x|, with auxiliary functions (A&S 5.2.8) rational
// in u over one denominator, for every u and without a branch:
//   f = (pi/2 + d_b u) / d,  g = g_a / d,  d = 1 + d_a u + d_b u^2.
// f(0) = pi/2 makes Si(0) = 0, and f tends to 1/u, so the tail is unbiased. g, which is infinite at
// 0 as -ln u, is not followed there; sin u hides it.

const HALF_PI: f32 = 1.5707963267948966;
// A phase error e changes Si by e f <= e / u, and the phase in turns is rounded to 6e-8 u: the
// result moves by 6e-8 at most, so one multiplication is all the reduction that this form needs.
const TURNS_PER_RADIAN: f32 = 0.15915494309189535;
// Past it, where the tail is below 1e-6, the phase stands still; no overflow, no NaN at infinity.
const LAST_PHASE: f32 = 1e6;

override d_a: f32 = 1.7653310;
override d_b: f32 = 0.7257015;
override g_a: f32 = 1.1017274;

fn sine_integral(x: f32) -> f32 {
    let u = min(abs(x), LAST_PHASE);
    let turns = u * TURNS_PER_RADIAN;
    let turn = turns - round(turns);
    // With w the turn in [-1/2, 1/2] and p = 1/4 - |w|: cos u = sin(2 pi p), and sin u has the sign
    // of w and the magnitude of cos(2 pi p), whose zeros |w| (1/2 - |w|) carries exactly.
    let rest = 0.5 - abs(turn);
    let p = 0.25 - abs(turn);
    let z = p * p;
    // sin(2 pi p) on [-1/4, 1/4], maximal error 6.8e-5 at its ends.
    let cosine = p * (6.281280067 + z * (-41.0952419 + z * 73.5855022));
    // cos(2 pi p) on [-1/4, 1/4], maximal error 7.3e-4 near p = 0.19.
    let sine = turn * rest * (15.988282007 - z * 56.818491412);
    let denominator = 1.0 + u * (d_a + u * d_b);
    return sign(x) * (HALF_PI - ((HALF_PI + d_b * u) * cosine + g_a * sine) / denominator);
}
