// uses: band_phase

// A rule of five nodes for bands up to one period: mean = sum of w sinc^2(t/2), all terms of one sign.
// The rule of Gauss (0.5385, 0.9062, weights 0.2393, 0.1185) has errors to 3.1e-5; these are fitted to
// bands.
override node_a: f32 = 0.53162235;
override node_b: f32 = 0.90320474;
override weight_a: f32 = 0.23867536;
override weight_b: f32 = 0.12161579;

// As in rule_of_four.wgsl, with a longer polynomial.
fn sinc_squared(middle: Middle, offset: f32) -> f32 {
    let phase = middle.phase + offset;
    let z = phase * phase;
    // sin(p/2) / (p/2) / (1 - z / (4 pi^2)) on |p| <= 2 pi, relative error 3.8e-7.
    let lobe = (1.0 - z * 0.025330295910584444)
        * (1.0 + z * (-0.016336100250553445 + z * (0.00010696604244952699
        + z * (-3.8457505333e-7 + z * 7.7174739102e-10))));
    let sinc = lobe * select(phase / (middle.at + offset), 1.0, middle.central);
    return sinc * sinc;
}

fn mean_sinc_squared(middle: Middle, half_width: f32) -> f32 {
    let inner = node_a * half_width;
    let outer = node_b * half_width;
    return (1.0 - 2.0 * (weight_a + weight_b)) * sinc_squared(middle, 0.0)
        + weight_a * (sinc_squared(middle, inner) + sinc_squared(middle, -inner))
        + weight_b * (sinc_squared(middle, outer) + sinc_squared(middle, -outer));
}
