// The integral of eq. 3 of toisoul2017 at a point of a surface, as a sum over taps of a table.
//
// With h = incident + view, projected on the surface: h.u = (incident - reflection).u for every u in
// the surface, so that a tap at (along, across) comes from the direction whose projection is that of
// the reflection plus the tap. The normal component follows from the unit length; a tap beyond the
// horizon gives nothing.
//
// environment and constants: as in sphere_map.wgsl.
// taps: per tap the displacement along the first and along the second direction of the surface,
// the width of its cell, then R, G, B weights (table times area of the cell).

// What one tap adds. mirror: the reflection along and beside the first direction; mu_o: its cosine.
fn from_tap(
    tap: u32,
    mirror: vec2<f32>,
    mu_o: f32,
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
        // The mean of 1/mu_i over the ring of the cell: finite up to the horizon.
        let radius = sqrt(square);
        let cell = taps[at + 2u];
        let inner = max(radius - 0.5 * cell, 0.0);
        let outer = min(radius + 0.5 * cell, 1.0);
        let per_mu = 2.0 / (sqrt(1.0 - inner * inner) + sqrt(1.0 - outer * outer));
        // view = 2 (reflection . normal) normal - reflection.
        let cosine = mu_o * mu_i - mirror.x * u - mirror.y * v;
        let geometry = (1.0 + cosine) * (1.0 + cosine) / (4.0 * mu_o);
        let incident = along * u + beside * v + normal * mu_i;
        let weight = vec3<f32>(taps[at + 3u], taps[at + 4u], taps[at + 5u]);
        return weight * (geometry * per_mu) * radiance(incident, 0);
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
    let mu_o = max(dot(reflection, normal), 1e-4);
    let begin = u32(first);
    let end = min(begin + u32(tap_block), u32(tap_count));
    var sum = vec3<f32>(0.0, 0.0, 0.0);
    for (var tap = begin; tap < end; tap += 1u) {
        sum += from_tap(tap, mirror, mu_o, along, beside, normal);
    }
    return sum;
}
