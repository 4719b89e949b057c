// Counter-based random numbers: pcg4d (Jarzynski & Olano 2020, Hash functions for GPU rendering).
// The same counter gives the same bits everywhere, in any order.
fn random_pair(pixel: u32, draw: u32, light: u32, seed: u32) -> vec2<f32> {
    var x = pixel * 1664525u + 1013904223u;
    var y = draw * 1664525u + 1013904223u;
    var z = light * 1664525u + 1013904223u;
    var w = seed * 1664525u + 1013904223u;
    x += y * w;
    y += z * x;
    z += x * y;
    w += y * z;
    x ^= x >> 16u;
    y ^= y >> 16u;
    z ^= z >> 16u;
    w ^= w >> 16u;
    x += y * w;
    y += z * x;
    z += x * y;
    w += y * z;
    // 24 bits each, at the middle of their interval, rounded: in (0, 1].
    let scale = 5.9604644775390625e-8;
    return vec2<f32>(
        (f32(x >> 8u) + 0.5) * scale,
        (f32(y >> 8u) + 0.5) * scale,
    );
}
