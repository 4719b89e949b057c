// The sum over a diffraction table at a point of a surface by Monte Carlo: cells of the table drawn in proportion to
// their weight. Taps as in surface_sum.wgsl, with weights over the probability of a draw.
//
// alias_table: per cell the chance that it stands for itself, and the cell that does otherwise.

@group(1) @binding(3) var<storage, read> alias_table: array<vec2<f32>>;

fn surface_samples(
    reflection: vec3<f32>,
    normal: vec3<f32>,
    along: vec3<f32>,
    pixel: f32,
    first_draw: f32,
) -> vec3<f32> {
    let beside = cross(normal, along);
    let mirror = vec2<f32>(dot(reflection, along), dot(reflection, beside));
    let mu_o = dot(reflection, normal);
    let mirrored = radiance(reflection, 0);
    let cells = u32(tap_count);
    var sum = vec3<f32>(0.0, 0.0, 0.0);
    for (var draw = 0u; draw < SAMPLE_DRAWS; draw++) {
        let u = random_pair(u32(pixel), u32(first_draw) + draw, 0u, SAMPLE_SEED);
        let cell = min(u32(u.x * tap_count), cells - 1u);
        let entry = alias_table[cell];
        let tap = select(u32(entry.y), cell, u.y <= entry.x);
        sum += from_tap(tap, mirror, mu_o, mirrored, along, beside, normal);
    }
    return ORDER_TOTAL * mirrored + sum / f32(SAMPLE_DRAWS);
}
