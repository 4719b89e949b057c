// A sphere as the cone of directions under which it is seen, and its slices.
//
// With the axis at latitude beta_0 and azimuth phi_0 about x, the slice at w_x = sin beta is covered for
//   sin^2((phi - phi_0)/2) <= (4 sin^2(alpha/2) - chord^2) / (4 c rho),
// c = cos beta, rho = cos beta_0, chord^2 = (x - p_x)^2 + (c - rho)^2: nothing cancels for small
// lights but x - p_x.

struct Light {
    axis: vec3<f32>,
    // Sine and cosine of the half-angle alpha, and 4 sin^2(alpha/2).
    sine: f32,
    cosine: f32,
    haversine: f32,
}

// `sine`, `cosine`: of the half-angle.
fn cone(axis: vec3<f32>, sine: f32, cosine: f32) -> Light {
    return Light(axis, sine, cosine, 2.0 * sine * sine / (1.0 + cosine));
}

fn slice_band(kw: f32, view_y: f32, light: Light, x: f32) -> f32 {
    let square = (1.0 - x) * (1.0 + x);
    if !(square > 0.0) {
        return 0.0;
    }
    let c = sqrt(square);
    let rho = length(light.axis.yz);
    let offset = x - light.axis.x;
    let drop = offset * (light.axis.x + x) / (c + rho);
    let above = light.haversine - offset * offset - drop * drop;
    if !(above > 0.0) {
        return 0.0;
    }
    let part = min(above / max(4.0 * c * rho, 1e-20), 1.0);
    // Azimuths phi_0 - half and phi_0 + half, as (y, z)/c.
    let half = vec2<f32>(1.0 - 2.0 * part, 2.0 * sqrt(part * (1.0 - part)));
    let middle = light.axis.yz / max(rho, 1e-20);
    let right = vec2<f32>(
        middle.x * half.x + middle.y * half.y, middle.y * half.x - middle.x * half.y);
    let left = vec2<f32>(
        middle.x * half.x - middle.y * half.y, middle.y * half.x + middle.x * half.y);
    // What the horizon leaves: one interval if the axis points up, else one from each side.
    var first = vec2<f32>(select(left.x, -1.0, left.y < 0.0), select(right.x, 1.0, right.y < 0.0));
    var second = vec2<f32>(1.0, 1.0);
    if light.axis.z < 0.0 {
        first = vec2<f32>(-1.0, select(-1.0, right.x, right.y > 0.0));
        second = vec2<f32>(select(1.0, left.x, left.y > 0.0), 1.0);
    }
    if part >= 1.0 {
        first = vec2<f32>(-1.0, 1.0);
        second = vec2<f32>(1.0, 1.0);
    }
    var total = 0.0;
    for (var i = 0u; i < 2u; i++) {
        if first.x < first.y {
            total += sinc_squared_band(kw * (c * first.x + view_y), kw * (c * first.y + view_y));
        }
        first = second;
    }
    return total / kw;
}
