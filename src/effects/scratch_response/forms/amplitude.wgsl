// uses: lobe

// exp(2 pi i x)
fn unit_phase(turns: f32) -> vec2<f32> {
    let phase = 2.0 * PI * (turns - round(turns));
    return vec2<f32>(cos(phase), sin(phase));
}

// sin(pi x)/(pi x)
fn sinc_turns(turns: f32) -> f32 {
    let nearest = round(turns);
    let sign = 1.0 - 2.0 * abs(nearest - 2.0 * round(0.5 * nearest));
    let phase = PI * turns;
    let near = abs(turns) < 0.01;
    let sine = sign * sin(PI * (turns - nearest));
    return select(sine / select(phase, 1.0, near),
        1.0 - phase * phase * (0.1666666667 - 0.0083333333 * phase * phase), near);
}

// S/(sqrt(pi) sigma lambda) of an infinite scratch:
// D = 1 - exp(2 pi i t) = -2i sin(pi t) exp(i pi t), t = mu_sum D/lambda.
fn lobe_amplitude(width_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32, xi_across: f32,
    offset_um: f32, depth_um: f32, mu_sum: f32) -> vec2<f32> {
    let width = width_um / wavelength_um;
    let magnitude = 1.414213562 * width * sinc_turns(width * xi_across)
        * gaussian(0.7071067812 * offset_um / sigma_um)
        * gaussian(4.442882938 * sigma_um / wavelength_um * xi_along);
    let turns = mu_sum * depth_um / wavelength_um;
    let whole = turns - round(turns);
    let away = unit_phase(-offset_um * xi_across / wavelength_um);
    let back = unit_phase(whole - offset_um * xi_across / wavelength_um);
    return magnitude * (away - back);
}
