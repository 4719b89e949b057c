// A triangle as the directions on the inner side of the planes through its edges and the shaded
// point, and its slices.
//
// On the slice w = (x, c cos phi, c sin phi) the plane N.w = 0 is crossed at
//   y = (-N_x N_y x -+ N_z root)/m^2, root = sqrt((m c)^2 - (N_x x)^2), m^2 = N_y^2 + N_z^2:
// both roots without a division by one that may vanish. Where N points up, what it keeps of the slice
// is one interval; where it points down, what it takes away is one. A projected triangle has
// hollow sides, so that up to four intervals may remain.

struct Light {
    // Vertices, the largest component 1.
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
    // Inward normals of the planes through a and b, b and c, c and a, the largest component 1; all 0
    // if nothing is seen.
    side_a: vec3<f32>,
    side_b: vec3<f32>,
    side_c: vec3<f32>,
    // 1 if the vertices go round counter-clockwise, -1 if not.
    orientation: f32,
}

// Interval of y on the slice with N.w >= 0, N_z >= 0; empty as (c, -c).
fn side_interval(n: vec3<f32>, x: f32, c: f32) -> vec2<f32> {
    let square = n.y * n.y + n.z * n.z;
    let m = sqrt(square);
    let along = n.x * x;
    let room = m * c - abs(along);
    if !(room > 0.0) || square < 1e-30 {
        return select(vec2<f32>(c, -c), vec2<f32>(-c, c), along > 0.0);
    }
    let root = sqrt(room * (m * c + abs(along)));
    let right = vec2<f32>(n.z * root - along * n.y, -n.y * root - along * n.z);
    let left = vec2<f32>(-n.z * root - along * n.y, n.y * root - along * n.z);
    // An end below the horizon: the interval goes on to the rim.
    return vec2<f32>(
        select(max(left.x / square, -c), -c, left.y < 0.0),
        select(min(right.x / square, c), c, right.y < 0.0));
}

fn slice_band(kw: f32, view_y: f32, light: Light, x: f32) -> f32 {
    let square = (1.0 - x) * (1.0 + x);
    if !(square > 0.0) {
        return 0.0;
    }
    let c = sqrt(square);
    var kept = vec2<f32>(-c, c);
    // Taken away, in order of where they begin; 2 is beyond every slice.
    var next = vec2<f32>(2.0, 2.0);
    var later = next;
    var last = next;
    var side = light.side_a;
    for (var i = 0u; i < 3u; i++) {
        if side.z >= 0.0 {
            let interval = side_interval(side, x, c);
            kept = vec2<f32>(max(kept.x, interval.x), min(kept.y, interval.y));
        } else {
            let taken = side_interval(-side, x, c);
            if taken.x < taken.y {
                last = select(later, max(taken, vec2<f32>(-2.0, -2.0)), taken.x >= later.x);
                let second = select(taken, later, taken.x >= later.x);
                later = select(next, second, second.x >= next.x);
                next = select(second, next, second.x >= next.x);
            }
        }
        side = select(light.side_c, light.side_b, i == 0u);
    }
    var total = 0.0;
    var cursor = kept.x;
    for (var i = 0u; i < 4u; i++) {
        let end = min(next.x, kept.y);
        if cursor < end {
            total += sinc_squared_band(kw * (cursor + view_y), kw * (end + view_y));
        }
        cursor = max(cursor, next.y);
        next = later;
        later = last;
        last = vec2<f32>(2.0, 2.0);
    }
    return total / kw;
}
