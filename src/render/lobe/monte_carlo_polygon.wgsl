// One pass of Monte Carlo over triangles: points uniform in area. With n = (b - a) x (c - a), which
// is twice the area long, and p the point at distance d, the solid angle per draw is
// |n . p| / (2 d^3), and cos theta_i is p.z / d.
fn radiance(view: vec2<f32>, pixel: f32, first_draw: f32) -> vec3<f32> {
    var colour = vec3<f32>(0.0);
    for (var draw = 0u; draw < SCENE_DRAWS; draw++) {
        for (var light = 0u; light < SCENE_LIGHTS; light++) {
            let u = random_pair(u32(pixel), u32(first_draw) + draw, SCENE_FIRST_LIGHT + light, SCENE_SEED);
            let a = scene_corner_a(light);
            let ab = scene_corner_b(light) - a;
            let ac = scene_corner_c(light) - a;
            // Uniform in the triangle: the share of the far edge grows with the root.
            let far = sqrt(u.x);
            let point = a + far * (1.0 - u.y) * ab + far * u.y * ac;
            let squared = dot(point, point);
            let direction = point / sqrt(squared);
            let normal = cross(ab, ac);
            let measure = 0.5 * abs(dot(normal, direction)) / squared * max(direction.z, 0.0);
            let xi = direction.xy + view;
            for (var wave = 0u; wave < SCENE_WAVES; wave++) {
                let lobe = measure * diffraction(scene_kw(wave), scene_ks(wave), xi);
                colour += lobe * (scene_weight(wave) * scene_radiance(light));
            }
        }
    }
    return colour / f32(SCENE_DRAWS);
}
