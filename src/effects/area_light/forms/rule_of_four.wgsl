// uses: band_phase

// A rule of four nodes for bands up to one period: mean = sum of w sinc^2(t/2), all terms of one sign.
// The rule of Gauss has nodes 0.3400, 0.8611 and a first weight of 0.3261 (errors to 1.1e-3); these are
// fitted to bands.
override node_a: f32 = 0.33190098;
override node_b: f32 = 0.854897;
override weight_a: f32 = 0.32023302;

// sinc^2(t/2) at `offset` from the middle, |offset| <= pi: the sinc of the phase, whose zeros at +-2 pi
// a factor carries, times phase / t.
fn sinc_squared(middle: Middle, offset: f32) -> f32 {
    let phase = middle.phase + offset;
    let z = phase * phase;
    // sin(p/2) / (p/2) / (1 - z / (4 pi^2)) on |p| <= 2 pi, relative error 2.4e-5.
    let lobe = (1.0 - z * 0.025330295910584444)
        * (1.0 + z * (-0.01632575251887233 + z * (0.00010549787459122902 - z * 3.2375313e-7)));
    let sinc = lobe * select(phase / (middle.at + offset), 1.0, middle.central);
    return sinc * sinc;
}

fn mean_sinc_squared(middle: Middle, half_width: f32) -> f32 {
    let inner = node_a * half_width;
    let outer = node_b * half_width;
    return weight_a * (sinc_squared(middle, inner) + sinc_squared(middle, -inner))
        + (0.5 - weight_a) * (sinc_squared(middle, outer) + sinc_squared(middle, -outer));
}
