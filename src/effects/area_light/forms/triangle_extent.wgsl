// Range of w_x along the part above the horizon of the edge from a to b, n along a x b; empty as
// (2, -2).
fn edge_extent(a: vec3<f32>, b: vec3<f32>, n: vec3<f32>) -> vec2<f32> {
    if max(a.z, b.z) < 0.0 {
        return vec2<f32>(2.0, -2.0);
    }
    let step = b - a;
    let part = clamp(a.z / select(step.z, -1e-30, abs(step.z) < 1e-30), -1.0, 1.0);
    let crossing = a - step * part;
    let begin = select(a, crossing, a.z < 0.0);
    let to = select(b, crossing, b.z < 0.0);
    let start = begin.x / max(length(begin), 1e-20);
    let end = to.x / max(length(to), 1e-20);
    // dw_x along the edge, up to a positive factor: where it changes sign w_x is extremal.
    let leaving = n.y * begin.z - n.z * begin.y;
    let arriving = n.y * to.z - n.z * to.y;
    let top = sqrt((n.y * n.y + n.z * n.z) / max(dot(n, n), 1e-30));
    return vec2<f32>(
        select(min(start, end), -top, leaving < 0.0 && arriving > 0.0),
        select(max(start, end), top, leaving > 0.0 && arriving < 0.0));
}

// Range of w_x: that of the edges, up to a pole that is inside.
fn extent(light: Light) -> vec2<f32> {
    let first = edge_extent(light.a, light.b, light.orientation * light.side_a);
    let second = edge_extent(light.b, light.c, light.orientation * light.side_b);
    let third = edge_extent(light.c, light.a, light.orientation * light.side_c);
    let low = min(min(first.x, second.x), third.x);
    let high = max(max(first.y, second.y), third.y);
    let nearest = min(min(light.side_a.x, light.side_b.x), light.side_c.x);
    let farthest = max(max(light.side_a.x, light.side_b.x), light.side_c.x);
    return vec2<f32>(select(low, -1.0, farthest < 0.0), select(high, 1.0, nearest > 0.0));
}
