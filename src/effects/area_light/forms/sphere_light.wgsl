// uses: sphere

fn sphere_light(kw: f32, ks: f32, view: vec2<f32>, centre: vec3<f32>, radius: f32) -> f32 {
    // Any unit of length: nothing overflows if the largest number is 1.
    let largest = abs(centre);
    let unit = max(max(largest.x, largest.y), max(largest.z, radius));
    let p = centre / unit;
    let square = dot(p, p);
    let r = radius / unit;
    // From inside a sphere all is lit: a cone of a right angle around the normal.
    var light = cone(vec3<f32>(0.0, 0.0, 1.0), 1.0, 0.0);
    if square > r * r {
        let distance = sqrt(square);
        let sine = min(r / distance, 1.0);
        light = cone(p / distance, sine, sqrt((1.0 - sine) * (1.0 + sine)));
    }
    return lobe_integral(kw, ks, view, light);
}
