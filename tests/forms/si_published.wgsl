// Si(x) approximately, velinov2018 eq. 29 with its published constants.
override a_zero: f32 = 0.66142739;
override b_zero: f32 = 0.38272292;

fn si(x: f32) -> f32 {
    let s = sign(x);
    let d = x - s * b_zero;
    let e = 1.0 + d * d;
    return 1.5707963267948966 * tanh(x) - a_zero * x / e + s * (1.0 - cos(x)) / (1.0 + abs(x));
}
