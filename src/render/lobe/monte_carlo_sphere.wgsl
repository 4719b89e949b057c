// One pass of Monte Carlo over spheres: directions uniform in the cone that the sphere fills. The
// mean of  solid angle * cos theta_i * diffraction  is the integral over direction cosines.
fn radiance(view: vec2<f32>, pixel: f32, first_draw: f32) -> vec3<f32> {
    var colour = vec3<f32>(0.0);
    for (var draw = 0u; draw < SCENE_DRAWS; draw++) {
        for (var light = 0u; light < SCENE_LIGHTS; light++) {
            let u = random_pair(u32(pixel), u32(first_draw) + draw, SCENE_FIRST_LIGHT + light, SCENE_SEED);
            // 1 - cos of the angle from the axis, uniform up to that of the cone.
            let q = u.x * scene_cone(light);
            let radius = sqrt(q * (2.0 - q));
            let angle = (2.0 * u.y - 1.0) * 3.141592653589793;
            let direction = (1.0 - q) * scene_axis(light)
                + radius * cos(angle) * scene_tangent(light)
                + radius * sin(angle) * scene_bitangent(light);
            let measure = scene_cone(light) * 6.283185307179586 * max(direction.z, 0.0);
            let xi = direction.xy + view;
            for (var wave = 0u; wave < SCENE_WAVES; wave++) {
                let lobe = measure * diffraction(scene_kw(wave), scene_ks(wave), xi);
                colour += lobe * (scene_weight(wave) * scene_radiance(light));
            }
        }
    }
    return colour / f32(SCENE_DRAWS);
}
