// approximates: sine_integral
// about: tanh, a Lorentzian tail and a cosine, 2 constants
// cites: velinov2018 eq. 29

// Si(x), Velinov, Werner & Hullin 2018, eq. 29, as printed:
//   pi/2 tanh(x) - a x / (1 + (x - sgn(x) b)^2) + sgn(x) (1 - cos x) / (1 + |x|)
// with a = `tail` and b = `offset`. The tail it leaves is pi/2 + (1 - a - cos x) / x where that of
// Si is pi/2 - cos(x) / x: free of bias only if a = 1.
//
// WGSL lets tanh be computed as sinh / cosh: on such a device large |x| may give NaN. And it grants
// cos no accuracy outside [-pi, pi].

const HALF_PI: f32 = 1.5707963267948966;

override tail: f32 = 0.66142739;
override offset: f32 = 0.38272292;

fn sine_integral(x: f32) -> f32 {
    let side = sign(x);
    let shifted = x - side * offset;
    return HALF_PI * tanh(x)
        - tail * x / (1.0 + shifted * shifted)
        + side * (1.0 - cos(x)) / (1.0 + abs(x));
}
