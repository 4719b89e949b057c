// uses: triangle

fn largest(v: vec3<f32>) -> f32 {
    let magnitude = abs(v);
    return max(max(magnitude.x, magnitude.y), magnitude.z);
}

// a x b, the largest component 1 (or 0), from the difference of the two: nothing cancels for
// small lights.
fn side(a: vec3<f32>, step: vec3<f32>, orientation: f32) -> vec3<f32> {
    let normal = cross(a, step);
    return normal * (orientation / max(largest(normal), 1e-30));
}

fn triangle_light(
    kw: f32, ks: f32, view: vec2<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>
) -> f32 {
    // Any unit of length: nothing overflows if the largest number is 1.
    let unit = 1.0 / max(max(largest(a), largest(b)), max(largest(c), 1e-30));
    let begin = a * unit;
    let over = b * unit;
    let to = c * unit;
    let volume = dot(begin, cross(over - begin, to - begin));
    let orientation = sign(volume);
    let light = Light(
        begin, over, to,
        side(begin, over - begin, orientation),
        side(over, to - over, orientation),
        side(to, begin - to, orientation),
        orientation);
    return lobe_integral(kw, ks, view, light);
}
