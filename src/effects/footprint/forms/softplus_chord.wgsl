// As soft_chord.wgsl, with the softplus itself, S(x) = ln(1 + exp x).

override q_c: f32 = 0.8879;
override q_d: f32 = 0.8037;
override a_a: f32 = -2.5;
override a_c: f32 = -0.1647;
override a_d: f32 = -0.2899;
override a_e: f32 = 1.6132;
override b_a: f32 = 2.0091;
override c_a: f32 = 12.0;
override c_c: f32 = 1.6055;

// asymptote: h^2 times the square of the mean at s = 0, for large h.
fn soft_chord(h: f32, s: f32, asymptote: f32) -> f32 {
    let square = h * h;
    let r = 1.0 / (1.0 + square * (q_c + h * q_d));
    let a = a_a + square * (a_c + h * (a_d + h * a_e));
    let b = b_a + square * a_e;
    let c = c_a + square * (c_c + h * (asymptote * q_d * q_d * q_d / a_e));
    let x = r * (a - s * s * b);
    // Far outside 1 + exp(-|x|) rounds to 1; the floor keeps the slope of the root finite there.
    let soft = max(max(x, 0.0) + log(1.0 + exp(-abs(x))), 1e-30);
    return r * sqrt(c * soft);
}
