// The light that a surface with a diffraction table sends to the eye, as a sum over the taps of the table.
//
// With h = incident + view, projected on the surface: h.u = (incident - reflection).u for every u in
// the surface, so that a tap at (along, across) comes from the direction whose projection is that of
// the reflection plus the tap. The normal component follows from the unit length; a tap beyond the
// horizon gives nothing.
//
// environment and constants: as in sphere_map.wgsl.
// taps: per tap the displacement along the first and along the second direction of the surface,
// the width of its cell, then R, G, B weights (table times area of the cell).
// order_growth: what orders are at w over what they are in the table, at GROWTH_STEPS steps over [0, 2].
// ORDER_TOTAL: share of the light that the table returns. What its orders do not is the mirror's.

@group(1) @binding(2) var<storage, read> order_growth: array<vec3<f32>>;

// What one tap adds to ORDER_TOTAL times the light from the mirror direction. mirror: the reflection
// along and beside the first direction; mu_o: its cosine; mirrored: the light from there.
fn from_tap(
    tap: u32,
    mirror: vec2<f32>,
    mu_o: f32,
    mirrored: vec3<f32>,
    along: vec3<f32>,
    beside: vec3<f32>,
    normal: vec3<f32>,
) -> vec3<f32> {
    let at = 6u * tap;
    let u = mirror.x + taps[at];
    let v = mirror.y + taps[at + 1u];
    let square = u * u + v * v;
    if (square < 1.0) {
        let mu_i = sqrt(1.0 - square);
        let place = clamp(0.5 * (mu_o + mu_i), 0.0, 1.0) * f32(GROWTH_STEPS);
        let node = min(u32(place), GROWTH_STEPS - 1u);
        let growth = mix(order_growth[node], order_growth[node + 1u], place - f32(node));
        let incident = along * u + beside * v + normal * mu_i;
        let weight = vec3<f32>(taps[at + 3u], taps[at + 4u], taps[at + 5u]);
        return weight * growth * (radiance(incident, 0) - mirrored);
    }
    return vec3<f32>(0.0, 0.0, 0.0);
}

fn surface_sum(
    reflection: vec3<f32>,
    normal: vec3<f32>,
    along: vec3<f32>,
    first: f32,
) -> vec3<f32> {
    let beside = cross(normal, along);
    let mirror = vec2<f32>(dot(reflection, along), dot(reflection, beside));
    let mu_o = dot(reflection, normal);
    let mirrored = radiance(reflection, 0);
    let begin = u32(first);
    let end = min(begin + u32(tap_block), u32(tap_count));
    var sum = vec3<f32>(0.0, 0.0, 0.0);
    if (begin == 0u) {
        sum = ORDER_TOTAL * mirrored;
    }
    for (var tap = begin; tap < end; tap += 1u) {
        sum += from_tap(tap, mirror, mu_o, mirrored, along, beside, normal);
    }
    return sum;
}
