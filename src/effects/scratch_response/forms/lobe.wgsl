const PI: f32 = 3.141592653589793;

// sin^2(pi x), from the distance of x to the nearest integer: WGSL promises little for its sine of
// large arguments.
fn sine_square(turns: f32) -> f32 {
    let sine = sin(PI * (turns - round(turns)));
    return sine * sine;
}

// (sin(pi x)/(pi x))^2; the series below 1/100 leaves out 2e-11.
fn sinc_square(turns: f32) -> f32 {
    let square = PI * PI * turns * turns;
    let near = square < 0.000987;
    return select(sine_square(turns) / select(square, 1.0, near),
        1.0 - square * (0.3333333333 - 0.0444444444 * square), near);
}

// |D|^2 = 2 - 2 cos(2 pi mu_sum D/lambda), eq. 11; mu_sum = 2 for small angles.
fn depth_square(depth_um: f32, wavelength_um: f32, mu_sum: f32) -> f32 {
    return 4.0 * sine_square(mu_sum * depth_um / wavelength_um);
}

// exp(-u^2)
fn gaussian(u: f32) -> f32 {
    return exp(-u * u);
}

// W^2 sinc^2 |D|^2 times what an infinite scratch has at xi_1 = s_b = 0: the profile of the scratch.
fn profile(width_um: f32, wavelength_um: f32, xi_across: f32, depth_square: f32) -> f32 {
    let width = width_um / wavelength_um;
    return 2.0 * width * width * sinc_square(width * xi_across) * depth_square;
}
