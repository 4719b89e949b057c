// approximates: footprint_end
// about: soft chord times a ramp of two square roots, 2 constants of its own
// cites: striae
// uses: soft_chord, response

// A scratch that begins inside the footprint: the response of one without end times a smooth ramp.
//
// Where the Gaussian weighs the footprint, u has about the mean h s / (2 + h^2) and the variance 1/(4 + 2 h^2): a
// product of the Gaussians of both. The coordinate along the scratch then spreads like a uniform one of half-length
// sqrt(l^2 (1 - mean^2 - variance) + 3 m^2 variance), and Phi^2 is a step at `onset` blurred by `blur`: the
// distribution of the larger of two normal deviates, of mean 1/sqrt(pi). The mean of a uniform over a blurred step
// is a difference of two hyperbolas, here without cancellation.

override onset: f32 = 0.5641896;
override blur: f32 = 1.5;

fn footprint_end(half_extent: f32, half_length: f32, shear: f32, offset: f32, end: f32) -> f32 {
    let spread = 1.0 / (2.0 + half_extent * half_extent);
    let across = clamp(half_extent * offset * spread, -1.0, 1.0);
    let chord_part = half_length * half_length * max(1.0 - across * across - 0.5 * spread, 0.0);
    let reach = sqrt(chord_part + 1.5 * shear * shear * spread);
    let past_end = shear * across - end - onset;
    let near = past_end - reach;
    let far = past_end + reach;
    let ramp = 0.5 + past_end / (sqrt(far * far + blur) + sqrt(near * near + blur));
    return ramp * footprint_response(half_extent, offset);
}
