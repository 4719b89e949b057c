// A chord with a soft rim. Its square is a parabola in s inside the footprint and a Gaussian outside:
//   c S(x), x = a - b s^2, S(x) = max(x, 0) + w (w_a + w_b w), w = exp(-|x|),
// a softplus without its logarithm; w_b makes the slope of S continuous at 0. a, b and c are rational in h over the
// powers of one cubic, and even in h to the second order. For large h they must give the chord
// sqrt(asymptote (h^2 - s^2)) / h^2: a/b -> h^2 makes their first coefficients equal, and a c -> asymptote / h^2
// fixes that of c.

override q_c: f32 = 0.8907584;
override q_d: f32 = 0.80966;
override a_a: f32 = -1.5043825;
override a_c: f32 = -0.1700259;
override a_d: f32 = -0.29256126;
override a_e: f32 = 1.6233449;
override b_a: f32 = 2.009548;
override c_a: f32 = 6.4241548;
override c_c: f32 = 1.6235865;
override w_a: f32 = 0.7225953;

// asymptote: h^2 times the square of the mean at s = 0, for large h.
fn soft_chord(h: f32, s: f32, asymptote: f32) -> f32 {
    let square = h * h;
    let r = 1.0 / (1.0 + square * (q_c + h * q_d));
    let a = a_a + square * (a_c + h * (a_d + h * a_e));
    let b = b_a + square * a_e;
    let c = c_a + square * (c_c + h * (asymptote * q_d * q_d * q_d / a_e));
    let x = r * (a - s * s * b);
    let w = exp(-abs(x));
    let soft = max(x, 0.0) + w * (w_a + w * (0.25 - 0.5 * w_a));
    return r * sqrt(c * soft);
}
